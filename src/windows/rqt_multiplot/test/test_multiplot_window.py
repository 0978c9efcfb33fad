"""The window in the container, without display and master; messages are put where rospy would put them."""

import time

import numpy as np
import pytest

from rqt_testing.in_process import errors, find, open_plugin, process_events, rospy_without_master, wait_until  # isort: skip
import genpy
import rosbag
from python_qt_binding.QtCore import QPointF, Qt
from python_qt_binding.QtGui import QImage
from rqt_multiplot import sources
from rqt_multiplot.config import Curve, CurveAxes, CurveAxis, FieldType, Plot, Scale, ScaleType, Style, StyleType, Table, read, write
from rqt_multiplot.curve_dialog import CurveDialog, field_names
from sensor_msgs.msg import JointState
from std_msgs.msg import Header

TODAY = 1_795_000_000.0


@pytest.fixture(autouse=True)
def master():
    rospy_without_master()


def curve(index=0, **more):
    scale = Scale(ScaleType.RELATIVE, relative_minimum=-10.0)
    return Curve(
        title=f"joint {index}",
        axes=CurveAxes(
            CurveAxis("/joints", "sensor_msgs/JointState", FieldType.DATA, "header/stamp", scale),
            CurveAxis("/joints", "sensor_msgs/JointState", FieldType.DATA, f"position/{index}"),
        ),
        **more,
    )


@pytest.fixture
def config(tmp_path):
    table = Table(plots=[[Plot(title="one", curves=[curve(0), curve(1)]), Plot(title="two", curves=[curve(1)])]])
    path = tmp_path / "arm.xml"
    path.write_text(write(table))
    return str(path)


def send(view, times, begin=TODAY):
    for t in times:
        message = JointState(header=Header(stamp=genpy.Time.from_sec(begin + t)), position=[0.1 * t, -0.2 * t])
        for sampler in view._topics._samplers.get("/joints", ()):
            sampler.add("/joints", message, begin + t)
    for panel in view.all_panels:
        panel.update_points()
    process_events()


def test_a_configuration_runs_from_the_command_line(config):
    with open_plugin("rqt_multiplot", ["--multiplot-config", config, "--multiplot-run-all"]) as gui:
        widget = gui.plugin._widget
        assert widget.url == f"file://{config}" and widget.view.table.shape == (1, 2) and not widget.modified
        assert [panel.running for panel in widget.view.all_panels] == [True, True]
        assert widget.windowTitle() == "Multiplot - arm.xml"
        send(widget.view, range(20))
        first = widget.view.panels[0][0]
        assert first.points[1].y[-1] == pytest.approx(-3.8)
        x, y = first.view.shown_range()
        assert x == pytest.approx([TODAY + 9, TODAY + 19]) and y == pytest.approx([-3.8 - 0.03 * 3.8, 1.9 + 0.03 * 1.9])
    assert errors == []


def test_nothing_is_drawn_until_run(config):
    with open_plugin("rqt_multiplot", ["-c", config]) as gui:
        view = gui.plugin._widget.view
        send(view, range(5))
        assert all(len(points) == 0 for panel in view.all_panels for points in panel.points) and not view._topics._subscribers
        find(gui, "run_all").click()
        assert list(view._topics._subscribers) == ["/joints"]  # one for three curves
        send(view, range(5))
        find(gui, "pause_all").click()
        assert not view._topics._subscribers
        assert [len(points) for panel in view.all_panels for points in panel.points] == [5, 5, 5]
        find(gui, "clear_all").click()
        assert [len(points) for panel in view.all_panels for points in panel.points] == [0, 0, 0]


def test_time_axes_can_be_read(config):
    with open_plugin("rqt_multiplot", ["-c", config, "-r"]) as gui:
        view = gui.plugin._widget.view
        send(view, [0.0, 5.0, 12.5])
        axis = view.panels[0][0].view.x_axis
        ticks = axis.tickValues(TODAY + 2.5, TODAY + 12.5, 500)
        strings = [text for step, values in ticks for text in axis.tickStrings(values, 1.0, step)]
        assert {"4", "6", "8"} <= set(strings) or {"5", "10"} <= set(strings)
        assert axis.labelText == "/joints/header/stamp" + time.strftime(" [s since %Y-%m-%d %H:%M:%S]", time.localtime(TODAY))
        assert view.panels[0][0].view.y_axis.offset == 0.0
        find(gui, "clear_all").click()
        send(view, [1.0, 2.0], begin=0.0)  # simulated time is short enough
        assert axis.offset == 0.0 and axis.labelText == "/joints/header/stamp"


def pixels(image):
    """Red, green, blue, each (h, w)."""
    image = image.convertToFormat(QImage.Format.Format_RGB32)
    bits = image.constBits()
    bits.setsize(image.bytesPerLine() * image.height())
    blue, green, red, _ = np.moveaxis(np.frombuffer(bits, np.uint8).reshape(image.height(), -1, 4), 2, 0)
    return red, green, blue


@pytest.mark.parametrize("style", list(StyleType))
def test_every_style_draws(tmp_path, style):
    path = tmp_path / "a.xml"
    plot = Plot(curves=[curve(0, style=Style(type=style, lines_interpolate=True, pen_width=3))])
    plot.curves[0].color.type, plot.curves[0].color.custom_color = 1, "#ff00ff"
    path.write_text(write(Table(plots=[[plot]])))
    with open_plugin("rqt_multiplot", ["-c", str(path), "-r"]) as gui:
        view = gui.plugin._widget.view
        gui.window.resize(700, 500)
        send(view, range(15), begin=0.0)
        red, green, blue = pixels(view.panels[0][0].view.grab().toImage())
        assert np.count_nonzero((red > 200) & (blue > 200) & (green < 80)) > 60


def test_linked_scales_and_home(config):
    with open_plugin("rqt_multiplot", ["-c", config, "-r"]) as gui:
        view = gui.plugin._widget.view
        send(view, range(20), begin=0.0)
        find(gui, "link_scale").click()
        first, second = view.all_panels
        first.view.setRange(xRange=(1, 2), yRange=(3, 4), padding=0)
        first.view.canvas.sigRangeChangedManually.emit([True, True])
        assert second.view.shown_range() == (pytest.approx([1, 2]), pytest.approx([3, 4]))
        send(view, [25], begin=0.0)
        assert first.view.shown_range()[0] == pytest.approx([1, 2])  # stays where the user is
        first.view.canvas.home.emit()
        assert first.view.shown_range()[0] == second.view.shown_range()[0] == pytest.approx([15, 25])


class Click:
    """As pyqtgraph hands one to items."""

    def __init__(self, x, y, button=Qt.MouseButton.LeftButton, double=False):
        self._pos, self._button, self._double = QPointF(x, y), button, double

    def button(self):
        return self._button

    def double(self):
        return self._double

    def pos(self):
        return self._pos

    def accept(self):
        pass


def test_rubber_band_and_right_click(config):
    with open_plugin("rqt_multiplot", ["-c", config, "-r"]) as gui:
        view = gui.plugin._widget.view
        gui.window.resize(900, 500)
        send(view, range(20), begin=0.0)
        panel = view.panels[0][0]
        canvas, before = panel.view.canvas, panel.view.shown_range()
        corner, other = canvas.mapFromView(QPointF(11, 0)), canvas.mapFromView(QPointF(13, 1))
        canvas.mouseClickEvent(Click(corner.x(), corner.y(), double=True))
        canvas.band_to(other)
        assert canvas.rbScaleBox.isVisible()
        canvas.mouseClickEvent(Click(other.x(), other.y()))
        assert panel.view.shown_range() == (pytest.approx([11, 13]), pytest.approx([0, 1])) and not canvas.rbScaleBox.isVisible()
        canvas.mouseClickEvent(Click(0, 0, Qt.MouseButton.RightButton))
        assert panel.view.shown_range() == (pytest.approx(before[0]), pytest.approx(before[1]))


def test_linked_cursors_and_tracked_points(config):
    with open_plugin("rqt_multiplot", ["-c", config, "-r"]) as gui:
        view = gui.plugin._widget.view
        send(view, range(20), begin=0.0)
        first, second = view.all_panels
        first.view.cursor_moved.emit((12.2, 0.0))
        assert first.view._lines[0].isVisible() and not second.view._lines[0].isVisible()
        find(gui, "link_cursor").click()
        find(gui, "track_points").click()
        first.view.cursor_moved.emit((12.2, 0.0))
        assert second.view._lines[0].isVisible() and "joint 1: 12, -2.4" in second.view._track_label.toPlainText()
        first.view.cursor_moved.emit(None)
        assert not second.view._lines[0].isVisible() and not second.view._tracked.isVisible()


def test_rows_and_columns(config):
    with open_plugin("rqt_multiplot", ["-c", config]) as gui:
        widget = gui.plugin._widget
        kept = widget.view.panels[0][0]
        find(gui, "rows").setValue(3)
        assert widget.view.table.shape == (3, 2) and widget.view.panels[0][0] is kept and widget.modified
        assert widget.windowTitle() == "Multiplot - arm.xml*"
        kept.maximize_button.click()
        assert [panel.isVisible() for panel in widget.view.all_panels] == [True] + [False] * 5
        kept.maximize_button.click()
        find(gui, "columns").setValue(1)
        assert all(panel.isVisible() for panel in widget.view.all_panels) and len(widget.view.all_panels) == 3


def test_save_and_history(config, tmp_path):
    settings = str(tmp_path / "a.ini")
    with open_plugin("rqt_multiplot", ["-c", config], settings=settings) as gui:
        widget = gui.plugin._widget
        find(gui, "link_cursor").click()
        assert widget.save_as(str(tmp_path / "other.xml")) and not widget.modified
        assert read((tmp_path / "other.xml").read_text())[0].link_cursor
        assert not widget.save_as("package://nowhere/a.xml")
        assert "no package 'nowhere'" in errors[-1]
    with open_plugin("rqt_multiplot", settings=settings) as gui:
        assert gui.plugin._widget.get_history() == [f"file://{tmp_path}/other.xml", f"file://{config}"]


def test_changes_that_are_not_saved_come_back(config, tmp_path):
    settings = str(tmp_path / "a.ini")
    with open_plugin("rqt_multiplot", ["-c", config], settings=settings) as gui:
        find(gui, "link_cursor").click()
    with open_plugin("rqt_multiplot", settings=settings) as gui:
        widget = gui.plugin._widget
        assert widget.modified and widget.view.table.link_cursor and widget.url == f"file://{config}"
        assert widget.save() and read(open(config).read())[0].link_cursor
    with open_plugin("rqt_multiplot", settings=settings) as gui:
        assert not gui.plugin._widget.modified and gui.plugin._widget.url == ""
    assert errors == []


@pytest.mark.parametrize("text, said", [("rubbish", "is no XML file"), (None, "No such file"), ("<robot/>", "lacks <rqt_multiplot>")])
def test_configurations_that_cannot_be_read(tmp_path, text, said):
    path = tmp_path / "a.xml"
    if text:
        path.write_text(text)
    with open_plugin("rqt_multiplot", ["-c", str(path)]) as gui:
        assert said in errors[0] and str(path) in errors[0] and said in find(gui, "status").text()
        assert gui.plugin._widget.view.table.shape == (1, 1)


@pytest.fixture
def bag(tmp_path):
    name = str(tmp_path / "a.bag")
    with rosbag.Bag(name, "w") as bag:
        for i in range(1500):
            stamp = genpy.Time.from_sec(TODAY + 0.01 * i)
            bag.write("/joints", JointState(header=Header(stamp=stamp), position=[1.0 * i, 2.0]), stamp)
    return name


def test_bag_to_picture_and_text(config, bag, tmp_path):
    with open_plugin("rqt_multiplot", ["-c", config]) as gui:
        widget = gui.plugin._widget
        widget.load_bag(bag)
        wait_until(lambda: "1500 messages read" in find(gui, "status").text())
        process_events()
        assert [len(points) for points in widget.view.panels[0][0].points] == [1500, 1500]
        widget.export_text(str(tmp_path / "a.txt"))
        lines = (tmp_path / "a.txt").read_text().splitlines()
        assert lines[0].startswith("# /joints/header/stamp, /joints/position/0, /joints/header/stamp, /joints/position/1")
        assert len(lines) == 1501 and [float(v) for v in lines[101].split(", ")[:4]] == [TODAY + 1, 100.0, TODAY + 1, 2.0]
        widget.export_image(str(tmp_path / "a.png"))
        image = QImage(str(tmp_path / "a.png"))
        assert (image.width(), image.height()) == (1280, 1024)
        red, green, _blue = pixels(image)
        assert np.count_nonzero((red > 200) & (green < 90)) > 200
        widget.export_text("/proc/a.txt")
        widget.load_bag(str(tmp_path / "absent.bag"))
        wait_until(lambda: "No such file" in find(gui, "status").text())


def test_dialogs_change_a_copy(config):
    with open_plugin("rqt_multiplot", ["-c", config]) as gui:
        view = gui.plugin._widget.view
        panel = view.panels[0][0]
        panel.configure_button.click()
        dialog = view._dialogs[-1]
        dialog.title.setText("renamed")
        dialog.list.setCurrentRow(0)
        find(dialog, "copy_curve").click()
        find(dialog, "paste_curve").click()
        find(dialog, "edit_curve").click()
        edit = dialog.curve_dialog
        edit.title.setText("other")
        edit.y.field.setText("velocity/1")
        edit.accept()
        assert panel.plot.title == "one" and len(panel.plot.curves) == 2
        dialog.accept()
        assert panel.plot.title == "renamed" == panel.title.text() and len(panel.plot.curves) == len(panel.points) == 3
        assert [c.title for c in panel.plot.curves] == ["other", "joint 1", "joint 0"] and gui.plugin._widget.modified
    assert errors == []


def test_the_curve_dialog_says_what_a_field_is():
    class Types:
        types = {"/joints": "sensor_msgs/JointState"}

    from rqt_testing.in_process import application

    application()
    dialog = CurveDialog(Curve(), Types())
    dialog.y.topic.setCurrentText("/joints")
    assert dialog.y.type.text() == "sensor_msgs/JointState"
    for text, said in (("position/0", ""), ("position", "an array"), ("posision", "no field posision"), ("name/0", "no number but string")):
        dialog.y.field.setText(text)
        assert said in dialog.y.reason.text() and bool(said) == bool(dialog.y.reason.text())
    dialog.x.receipt.setChecked(True)
    dialog.x.topic.setCurrentText("/joints")
    dialog._swap()
    dialog.accept()
    assert dialog.curve.axes.x_axis.field == "name/0" and dialog.curve.axes.y_axis.field_type == FieldType.RECEIPT_TIME
    assert field_names(JointState) == ["header/seq", "header/stamp", "position/0", "velocity/0", "effort/0"]


def test_types_that_are_not_built_here_are_told(config):
    with open_plugin("rqt_multiplot", ["-c", config, "-r"]) as gui:
        view = gui.plugin._widget.view
        raw = sources.rospy.AnyMsg()
        raw._buff, raw._connection_header = b"", {"type": "nowhere_msgs/Joints"}
        view._topics._receive("/joints", raw)
        for panel in view.all_panels:
            panel.update_points()
        assert "/joints is of type nowhere_msgs/Joints, which is not built here" in find(gui, "status").text()


@pytest.mark.parametrize("option", ["-b", "--multiplot-bag"])
def test_a_bag_is_named_on_the_command_line(tmp_path, option):
    with open_plugin("rqt_multiplot", [option, str(tmp_path / "absent.bag")]) as gui:
        wait_until(lambda: "absent.bag" in find(gui, "status").text())
