"""The plot and its bar, in the container, without display and master; numbers are put where rospy would put them."""

import numpy as np
import pytest

from rqt_testing.in_process import application, errors, find, open_plugin, process_events, rospy_without_master, wait_until  # isort: skip
import genpy
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtGui import QImage
from python_qt_binding.QtTest import QTest
from rqt_plot import plot_widget, rosplot
from rqt_plot.data_plot import DataPlot, DataPlotException
from rqt_plot.plot_widget import PlotWidget, could_appear
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, Header

TYPES = {"/speed": "std_msgs/Float64", "/joints": "sensor_msgs/JointState"}


@pytest.fixture(autouse=True)
def topics(monkeypatch):
    """A master with the topics that the test puts into the returned dict."""
    rospy_without_master()
    types = dict(TYPES)
    for module in (rosplot, plot_widget):
        monkeypatch.setattr(module, "topic_types", lambda: dict(types))
    return types


@pytest.fixture
def plot(monkeypatch):
    application()
    monkeypatch.setattr(plot_widget.rospy, "get_time", lambda: 0.0)
    widget = PlotWidget()
    data_plot = DataPlot(widget)
    data_plot.set_autoscale(x=False, y=DataPlot.SCALE_EXTEND | DataPlot.SCALE_VISIBLE)
    data_plot.set_xlim([0, 10])
    widget.switch_data_plot_widget(data_plot)
    widget.resize(800, 500)
    yield widget
    widget.shutdown()


def send(widget, name, times, values):
    rosdata = widget._rosdata[name]
    for time, value in zip(times, values):
        rosdata._ros_cb(JointState(header=Header(stamp=genpy.Time.from_sec(time)), position=[value]))
    widget.update_plot()
    process_events()


def test_command_line_and_title():
    with open_plugin("rqt_plot", ["/speed", "/joints/position[0]:position[1]"]) as gui:
        widget = gui.plugin._widget
        assert widget.topics() == ["/speed/data", "/joints/position[0]", "/joints/position[1]"]
        assert widget.windowTitle() == "PyQtGraph" and not find(gui, "pause_button").isChecked()
    assert errors == []


def test_started_paused_and_empty(tmp_path):
    settings = str(tmp_path / "a.ini")
    with open_plugin("rqt_plot", ["/speed"], settings=settings) as gui:
        find(gui, "autoscroll_checkbox").click()
    with open_plugin("rqt_plot", settings=settings) as gui:
        assert gui.plugin._widget.topics() == ["/speed/data"] and not find(gui, "autoscroll_checkbox").isChecked()
    with open_plugin("rqt_plot", ["-e", "-P"], settings=settings) as gui:
        assert gui.plugin._widget.topics() == [] and find(gui, "pause_button").isChecked()
    assert errors == []


def test_a_topic_that_is_not_there_yet(topics):
    with open_plugin("rqt_plot", ["/later/position[2]", "/later"]) as gui:
        widget = gui.plugin._widget
        assert find(gui, "waiting_label").text() == "waiting for /later/position[2], /later" and not widget._rosdata
        topics["/later"] = "sensor_msgs/JointState"
        wait_until(lambda: list(widget._rosdata) == ["/later/position[2]"])
        assert not find(gui, "waiting_label").isVisible()
    assert [text for text in errors if "plottable" not in text] == []


def test_the_plus_button_says_why(plot):
    wait_until(plot._topics.known.is_set)
    for text, enabled, said in (
        ("/speed", True, "has 1 plottable"),
        ("/joints/position", False, "give an index"),
        ("/joints/posision[0]", False, "no field posision"),
        ("/new/x", True, "starts when it appears"),
        ("/", False, ""),
        ("speed data", False, "does not exist"),
    ):
        plot.topic_edit.setText(text)
        assert plot.subscribe_topic_button.isEnabled() == enabled and said in plot.subscribe_topic_button.toolTip(), text
    plot.topic_edit.setText("/speed")
    plot.subscribe_topic_button.click()
    assert plot.topics() == ["/speed/data"]
    assert not could_appear("/a b") and not could_appear("a") and not could_appear("/a/") and could_appear("/a/b[0]")


def test_window_follows_the_newest_and_grows(plot):
    plot.add_topic("/joints/position[0]")
    send(plot, "/joints/position[0]", [1, 2], [5.0, 6.0])
    assert plot.data_plot.get_xlim() == pytest.approx([-8, 2]) and plot.data_plot.get_ylim() == pytest.approx([4.95, 6.05])
    send(plot, "/joints/position[0]", [30], [100.0])
    assert plot.data_plot.get_xlim() == pytest.approx([20, 30])
    low, high = plot.data_plot.get_ylim()
    assert low == pytest.approx(4.95) and high == pytest.approx(100 + 0.05 * 95.05)
    send(plot, "/joints/position[0]", [60], [50.0])
    assert plot.data_plot.get_ylim() == pytest.approx([low, high])  # grows only
    plot.autoscroll_checkbox.click()
    send(plot, "/joints/position[0]", [90], [50.0])
    assert plot.data_plot.get_xlim() == pytest.approx([50, 60])


def test_pause_loses_nothing_and_clear_forgets(plot):
    plot.add_topic("/joints/position[0]")
    plot.pause_button.click()
    assert not plot._update_plot_timer.isActive()
    send(plot, "/joints/position[0]", [1, 2, 3], [0.0, 1.0, 2.0])
    plot.pause_button.click()
    assert plot._update_plot_timer.isActive() and len(plot.data_plot._get_curve("/joints/position[0]")) == 3
    plot.clear_button.click()
    assert len(plot.data_plot._get_curve("/joints/position[0]")) == 0
    send(plot, "/joints/position[0]", [4], [0.5])
    assert plot.data_plot.get_ylim() == pytest.approx([0.475, 0.525])


def test_a_clock_that_is_set_back(plot):
    plot.add_topic("/joints/position[0]")
    send(plot, "/joints/position[0]", [100, 101], [1.0, 2.0])
    send(plot, "/joints/position[0]", [1], [3.0])
    assert plot.data_plot._get_curve("/joints/position[0]").x.tolist() == [1.0]
    assert plot.data_plot.get_xlim() == pytest.approx([-9, 1])


def test_nan_and_infinity_are_gaps(plot):
    plot.add_topic("/joints/position[0]")
    send(plot, "/joints/position[0]", range(1, 7), [0.0, np.nan, np.inf, -np.inf, 1.0, np.nan])
    assert plot.data_plot.get_ylim() == pytest.approx([-0.05, 1.05])
    plot.grab()


def test_shorter_arrays_are_told_once(plot, capfd):
    application()
    errors.clear()
    plot.add_topic("/joints/position[3]")
    for _ in range(3):
        plot._rosdata["/joints/position[3]"]._ros_cb(JointState(position=[1.0]))
        plot.update_plot()
    assert len(errors) == 1 and "/joints/position[3]" in errors[0] and "no such number" in errors[0]


def test_stamps_that_nobody_filled_in_are_those_of_arrival(plot, monkeypatch):
    monkeypatch.setattr(rosplot.rospy, "get_time", lambda: 7.0)
    plot.add_topic("/joints/position[0]")
    send(plot, "/joints/position[0]", [0.0], [1.0])
    plot.add_topic("/speed/data")
    plot._rosdata["/speed/data"]._ros_cb(Float64(2.0))
    plot.update_plot()
    assert plot.data_plot._get_curve("/joints/position[0]").x.tolist() == plot.data_plot._get_curve("/speed/data").x.tolist() == [7.0]


def test_curves_are_removed_by_the_menu(plot):
    plot.add_topic("/joints/position[0]")
    plot.add_topic("/speed")
    plot.add_topic("/absent")
    actions = {action.text(): action for action in plot.remove_topic_button.menu().actions()}
    assert sorted(actions) == ["/absent", "/joints/position[0]", "/speed/data", "All"]
    actions["/speed/data"].trigger()
    assert plot.topics() == ["/joints/position[0]", "/absent"]
    {action.text(): action for action in plot.remove_topic_button.menu().actions()}["All"].trigger()
    assert plot.topics() == [] and not plot._update_plot_timer.isActive()


def blues(widget):
    """Columns with pixels of the first curve's colour, right of the legend."""
    image = widget.grab().toImage().convertToFormat(QImage.Format.Format_RGB32)
    bits = image.constBits()
    bits.setsize(image.bytesPerLine() * image.height())
    blue, _, red, _ = np.moveaxis(np.frombuffer(bits, np.uint8).reshape(image.height(), -1, 4), 2, 0)
    columns = np.flatnonzero(((blue > 200) & (red < 60)).any(axis=0))
    return columns[(columns >= image.width() // 2) & (columns < image.width() - 30)]


def test_a_curve_stays_in_sight_while_the_window_scrolls(plot):
    plot.show()
    plot.add_topic("/joints/position[0]")
    for begin in (1000.0, 1050.0, 2000.0):
        times = begin + np.arange(0, 12, 0.01)
        send(plot, "/joints/position[0]", times, np.sin(times))
        process_events()
        assert len(blues(plot)) > 300


@pytest.mark.parametrize("index, title", [(0, "PyQtGraph"), (1, "MatPlot")])
@pytest.mark.parametrize("markers", [False, True])
def test_both_ways_of_drawing(plot, index, title, markers):
    data_plot = plot.data_plot
    data_plot._switch_data_plot_widget(index, markers_on=markers)
    data_plot.add_curve("c", "curve", [0, 1, 2], [1, 2, 4])
    data_plot.vline(1.5, DataPlot.GREEN)
    data_plot.set_xlim([0, 2])
    data_plot.redraw()
    process_events()
    assert data_plot.getTitle() == title and data_plot.get_xlim() == pytest.approx([0, 2])
    assert data_plot.get_ylim() == pytest.approx([0.85, 4.15])
    assert len(blues(plot)) > 200
    data_plot.remove_curve("c")
    with pytest.raises(DataPlotException):
        data_plot.update_values("c", [1], [1])


def test_twenty_curves_of_ten_seconds_at_a_kilohertz_are_few_points_to_draw(plot):
    x = np.arange(0, 20, 1e-3)
    for i in range(20):
        plot.data_plot.add_curve(str(i), str(i), x, np.sin(x + i))
    plot.data_plot.autoscroll(True)
    plot.data_plot._do_redraw()
    widget = plot.data_plot._data_plot_widget
    drawn = [len(curve.getData()[0]) for curve in widget._curves.values()]
    assert max(drawn) <= 4 * widget.width() and min(drawn) > widget.width()


def test_a_name_typed_and_return(plot):
    plot.show()
    wait_until(plot._topics.known.is_set)
    plot.topic_edit.setFocus()
    for index in range(3):
        plot.topic_edit.selectAll()
        QTest.keyClicks(plot.topic_edit, f"/joints/position[{index}]")
        QTest.keyClick(plot.topic_edit, Qt.Key.Key_Return)
    assert plot.topics() == [f"/joints/position[{index}]" for index in range(3)]
