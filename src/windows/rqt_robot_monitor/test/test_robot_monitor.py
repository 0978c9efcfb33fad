"""Trees, the timeline, and silence."""

import time

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rqt_testing.in_process import errors, find, open_plugin, process_events, rospy_without_master


@pytest.fixture
def gui():
    rospy_without_master()
    with open_plugin("rqt_robot_monitor") as gui:
        yield gui
    assert errors == []


def message(motor=0, text="fine", more=()):
    statuses = [("/robot", motor), ("/robot/arm", motor), ("/robot/arm/motor", motor), ("/robot/lamp", 1), *more]
    return DiagnosticArray(
        status=[DiagnosticStatus(level=level, name=name, message=text, values=[KeyValue("t", "1")]) for name, level in statuses]
    )


def rows(tree):
    def of(item):
        return {item.child(n).text(0): of(item.child(n)) for n in range(item.childCount())}

    return of(tree.invisibleRootItem())


def test_trees(gui):
    monitor = gui.plugin.widget
    monitor.take(message(2, more=[("/other/x", 99)]))
    assert rows(monitor.trees["all"]) == {"robot": {"arm": {"motor": {}}, "lamp": {}}, "other": {"x": {}}}
    assert set(rows(monitor.trees["errors"])) == {"/robot", "/robot/arm", "/robot/arm/motor", "/other/x"}
    assert rows(monitor.trees["warnings"]) == {"/robot/lamp": {}}
    top = (
        monitor.trees["all"].topLevelItem(0)
        if monitor.trees["all"].topLevelItem(0).text(0) == "robot"
        else monitor.trees["all"].topLevelItem(1)
    )
    top.setExpanded(True)
    monitor.take(message(0))
    assert rows(monitor.trees["all"]) == {"robot": {"arm": {"motor": {}}, "lamp": {}}} and top.isExpanded()
    assert rows(monitor.trees["errors"]) == {}


def test_look_back(gui):
    monitor = gui.plugin.widget
    for number in range(40):
        monitor.take(message(2 if number == 20 else 0, f"message {number}"))
    assert monitor.timeline.levels == [1] * 10 + [2] + [1] * 19
    monitor.look_at(10)
    top = monitor.trees["all"].topLevelItem(0)
    assert top.text(1) == "message 20" and monitor.pause_button.text() == "Resume"
    monitor.take(message(0, "message 40"))
    assert top.text(1) == "message 20" and monitor.timeline.selected == 9
    find(gui, "pause_button").click()
    assert top.text(1) == "message 40"


def test_inspector_follows(gui):
    monitor = gui.plugin.widget
    monitor.take(message())
    dialog = monitor.inspect("/robot/arm/motor")
    assert "Component: motor" in find(dialog, "status_text").toPlainText()
    monitor.take(message(2, "broken"))
    assert "Level: Error\nMessage: broken" in find(dialog, "status_text").toPlainText()
    dialog.close()
    process_events()
    monitor.take(message())


def test_silence(gui):
    monitor = gui.plugin.widget
    assert "diagnostic_aggregator" in monitor.status_label.text()
    monitor.take(message())
    monitor.tell_age(time.monotonic() + 60)
    assert monitor.status_label.text().startswith("all of it is stale")
