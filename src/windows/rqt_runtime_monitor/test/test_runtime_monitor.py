"""Statuses below their levels."""

import time

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rqt_testing.in_process import errors, open_plugin, rospy_without_master


@pytest.fixture
def gui():
    rospy_without_master()
    with open_plugin("rqt_runtime_monitor") as gui:
        gui.plugin._timer.stop()
        yield gui
    assert errors == []


def send(gui, now, *statuses):
    gui.plugin._queue.append(
        DiagnosticArray(
            status=[
                DiagnosticStatus(level=level, name=name, message=text, values=[KeyValue("<load>", "50 %")])
                for name, level, text in statuses
            ]
        )
    )
    gui.plugin.update(now)


def groups(gui):
    tops = [gui.plugin.tree.topLevelItem(n) for n in range(4)]
    return {top.text(0): [top.child(n).text(0) for n in range(top.childCount())] for top in tops}


def test_levels_and_silence(gui):
    now = time.monotonic()
    send(gui, now, ("motor", 0, "fine"), ("arm", 2, "hot"), ("base", 1, "slow"), ("odd", 77, "?"))
    assert groups(gui) == {
        "Stale (0)": [],
        "Errors (2)": ["arm: hot", "odd: ?"],
        "Warnings (1)": ["base: slow"],
        "Messages (1)": ["motor: fine"],
    }
    send(gui, now + 4, ("motor", 2, "<b>broken</b>"))
    assert groups(gui)["Errors (3)"] == ["arm: hot", "motor: <b>broken</b>", "odd: ?"]
    gui.plugin.update(now + 6)
    assert groups(gui)["Stale (3)"] == ["arm: hot", "base: slow", "odd: ?"] and "Errors (1)" in groups(gui)


def test_details_follow(gui):
    send(gui, 1.0, ("motor", 0, "<b>fine</b>"))
    gui.plugin.tree.topLevelItem(3).child(0).setSelected(True)
    assert "Message: <b>fine</b>" in gui.plugin.text.toPlainText() and "<load>: 50 %" in gui.plugin.text.toPlainText()
    send(gui, 2.0, ("motor", 2, "broken"))
    assert "Message: broken" in gui.plugin.text.toPlainText() and "Level: Errors" in gui.plugin.text.toPlainText()
