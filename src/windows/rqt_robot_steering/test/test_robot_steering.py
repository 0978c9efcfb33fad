"""Sliders, keys, limits, and what is published."""

import pytest
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtTest import QTest
from python_qt_binding.QtWidgets import QLineEdit, QPushButton
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until


@pytest.fixture
def gui(tmp_path):
    rospy_without_master()
    with open_plugin("rqt_robot_steering", settings=str(tmp_path / "rqt.ini")) as gui:
        gui.sent = []
        gui.plugin._publisher.publish = gui.sent.append
        yield gui
    assert errors == []


def values(gui):
    return [(twist.linear.x, twist.angular.z) for twist in gui.sent]


def test_zero_is_sent_once(gui):
    find(gui, "x_linear_slider").setValue(500)
    wait_until(lambda: len(gui.sent) > 2)
    assert set(values(gui)) == {(0.5, 0.0)}
    find(gui, "stop_push_button").click()
    assert values(gui)[-1] == (0, 0)
    count = len(gui.sent)
    for _ in range(3):
        gui.plugin.publish()
    assert len(gui.sent) == count


def test_stop_is_sent_where_nothing_drives_from_here(gui):
    """Another node may have left the robot driving: each Stop sends a zero, as in Noetic, and so does the window as it opens."""
    wait_until(lambda: gui.sent)
    assert values(gui) == [(0, 0)]
    find(gui, "stop_push_button").click()
    assert values(gui) == [(0, 0)] * 2
    elsewhere = QLineEdit(gui.window)  # the focus is in another part of the window
    button = QPushButton(gui.window)
    for widget in (elsewhere, button):
        widget.show()
    gui.window.activateWindow()
    button.setFocus()
    QTest.keyClick(button, " ")
    assert values(gui) == [(0, 0)] * 3
    QTest.keyClick(button, "W")
    assert gui.plugin.widget.velocities()[0] > 0
    elsewhere.setFocus()
    before = gui.plugin.widget.velocities()
    QTest.keyClicks(elsewhere, "www")
    assert elsewhere.text() == "www" and gui.plugin.widget.velocities() == before


@pytest.mark.parametrize(
    "keys, expected",
    [
        ("wwd", (0.02, -0.01)),
        ("WA", (0.1, 0.1)),
        ("WWWs", (0.29, 0)),
        ("WAx", (0, 0.1)),
        ("WAz", (0.1, 0)),
        ("WA ", (0, 0)),
        ("WWWWWWWWWWWWW", (1.0, 0)),
        ("DDD", (0, -0.3)),
    ],
)
def test_keys(gui, keys, expected):
    gui.window.activateWindow()
    gui.plugin.widget.setFocus()
    for key in keys:
        QTest.keyClick(
            gui.plugin.widget, key.upper(), Qt.KeyboardModifier.ShiftModifier if key.isupper() else Qt.KeyboardModifier.NoModifier
        )
    assert gui.plugin.widget.velocities() == pytest.approx(expected)


def test_limits_cut(gui):
    find(gui, "z_angular_slider").setValue(3000)
    find(gui, "vw_max_spin_box").setValue(0.5)
    assert gui.plugin.widget.velocities() == (0, 0.5)
    assert find(gui, "current_w_label").text() == "0.50 rad/s"


def test_topic(gui):
    gui.plugin.set_topic("no name")
    assert gui.plugin._publisher is None and "no name for a topic" in find(gui, "topic_line_edit").toolTip()
    find(gui, "x_linear_slider").setValue(100)
    gui.plugin.publish()
    gui.plugin.set_topic("/base/cmd_vel")
    assert gui.plugin._publisher.name == "/base/cmd_vel"
    kept = gui.plugin._publisher
    gui.plugin.set_topic("/base/cmd_vel")
    assert gui.plugin._publisher is kept


def test_closing_stops_the_robot():
    rospy_without_master()
    sent = []
    with open_plugin("rqt_robot_steering") as gui:
        gui.plugin._publisher.publish = sent.append
        find(gui, "x_linear_slider").setValue(700)
        gui.plugin.publish()
    assert [twist.linear.x for twist in sent][-2:] == [0.7, 0.0]


def test_kept(tmp_path):
    rospy_without_master()
    settings = str(tmp_path / "kept.ini")
    with open_plugin("rqt_robot_steering", settings=settings) as gui:
        find(gui, "topic_line_edit").setText("/base/cmd_vel")
        find(gui, "vx_max_spin_box").setValue(0.4)
    with open_plugin("rqt_robot_steering", settings=settings) as gui:
        assert find(gui, "topic_line_edit").text() == "/base/cmd_vel" and find(gui, "vx_max_spin_box").value() == 0.4
