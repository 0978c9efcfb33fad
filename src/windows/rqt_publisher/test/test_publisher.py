"""Publishers: what they send, what they refuse, what is kept."""

import ast
import re

import pytest
from python_qt_binding.QtCore import Qt
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until


@pytest.fixture
def gui(tmp_path):
    rospy_without_master()
    with open_plugin("rqt_publisher", settings=str(tmp_path / "rqt.ini")) as gui:
        yield gui
    assert errors == []


def sent_by(entry):
    sent = []
    entry._publisher.publish = sent.append
    return sent


def row(item, *names):
    for name in names:
        item = next(item.child(n) for n in range(item.childCount()) if item.child(n).text(0) == name)
    return item


def test_added_by_the_boxes_and_published_by_the_timer(gui):
    find(gui, "topic_combo_box").setEditText("turtle1/cmd_vel")
    find(gui, "type_combo_box").setEditText("geometry_msgs/Twist")
    find(gui, "frequency_combo_box").setEditText("100")
    find(gui, "add_publisher_button").click()
    [entry] = gui.plugin.entries
    sent, item = sent_by(entry), gui.plugin.widget.item_of(entry)
    assert [item.text(n) for n in range(3)] == ["/turtle1/cmd_vel", "geometry_msgs/Twist", "100.00"]
    row(item, "linear", "x").setText(3, "i * 0.5")
    item.setCheckState(0, Qt.CheckState.Checked)
    wait_until(lambda: len(sent) > 3)
    item.setCheckState(0, Qt.CheckState.Unchecked)
    assert [message.linear.x for message in sent[:4]] == [0.5, 1.0, 1.5, 2.0]
    count = len(sent)
    item.setText(2, "0")
    item.setCheckState(0, Qt.CheckState.Checked)
    gui.plugin.widget.tree.setCurrentItem(item)
    gui.plugin.widget.row_menu().actions()[0].trigger()
    assert len(sent) == count + 1


def test_a_wrong_expression_is_shown_and_nothing_is_sent(gui):
    entry = gui.plugin.add_publisher("/x", "geometry_msgs/Twist", "10")
    sent, item = sent_by(entry), gui.plugin.widget.item_of(entry)
    row(item, "linear", "x").setText(3, "__import__('os')")
    entry.publish()
    assert sent == [] and find(gui, "error_label").text().startswith("/x: linear/x: name '__import__' is not defined")
    assert row(item, "linear", "x").foreground(3).color().name() == "#ff0000"
    row(item, "linear", "x").setText(3, "2")
    entry.publish()
    assert sent[0].linear.x == 2.0 and find(gui, "error_label").text() == "" and item.text(3) == ""


def test_arrays_grow_by_their_type(gui):
    entry = gui.plugin.add_publisher("/p", "geometry_msgs/Polygon", 1)
    sent, item = sent_by(entry), gui.plugin.widget.item_of(entry)
    points = row(item, "points")
    points.setText(1, "geometry_msgs/Point32[2]")
    assert points.text(1) == "geometry_msgs/Point32[2]" and points.childCount() == 2
    row(points, "[1]", "z").setText(3, "nan")
    entry.publish()
    assert len(sent[0].points) == 2 and sent[0].points[1].z != sent[0].points[1].z


@pytest.mark.parametrize(
    "topic, kind, rate, said",
    [
        ("/x", "no_package/Odd", "1", "cannot import the message type no_package/Odd"),
        ("a b", "std_msgs/String", "1", "no name for a topic"),
        ("", "std_msgs/String", "1", "no name for a topic"),
        ("/x", "std_msgs/String", "often", "number from 0 to 1000 Hz, not often"),
        ("/x", "std_msgs/String", "-1", "not -1"),
        ("/x", "float64", "1", "is no message type"),
        ("/x", "", "1", "is no message type"),
        ("/x", "std_msgs/String[", "1", "is no message type"),
    ],
)
def test_refused_in_one_line(gui, topic, kind, rate, said):
    assert gui.plugin.add_publisher(topic, kind, rate) is None
    assert re.search(said, find(gui, "error_label").text()) and "\n" not in find(gui, "error_label").text()


def test_kept_but_disabled(tmp_path):
    rospy_without_master()
    settings = str(tmp_path / "kept.ini")
    with open_plugin("rqt_publisher", settings=settings) as gui:
        entry = gui.plugin.add_publisher("/p", "geometry_msgs/Polygon", 5)
        points = row(gui.plugin.widget.item_of(entry), "points")
        points.setText(1, "[1]")
        row(points, "[0]", "x").setText(3, "sin(i)")
        gui.plugin.widget.item_of(entry).setCheckState(0, Qt.CheckState.Checked)
    with open_plugin("rqt_publisher", settings=settings) as gui:
        [entry] = gui.plugin.entries
        assert not entry.enabled and entry.rate == 5.0
        assert row(gui.plugin.widget.item_of(entry), "points", "[0]", "x").text(3) == "sin(i)"
        find(gui, "clear_button").click()
        assert gui.plugin.entries == []
    assert errors == []


def test_publishers_of_noetic_come_back_and_go_there(tmp_path):
    """Noetic keeps expressions by the whole path, and counts `i` from 1."""
    rospy_without_master()
    settings = str(tmp_path / "noetic.ini")
    kept = {
        "topic_name": "/turtle1/cmd_vel",
        "type_name": "geometry_msgs/Twist",
        "rate": 2.0,
        "enabled": True,
        "publisher_id": 0,
        "counter": 7,
    }
    kept["expressions"] = {"/turtle1/cmd_vel/linear/x": "2.0", "/turtle1/cmd_vel/angular/z": "1 / i"}
    with open_plugin("rqt_publisher", settings=settings) as gui:
        keeper = Keeper({"publishers": repr([kept])})
        gui.plugin.restore_settings(keeper, keeper)
        [entry] = gui.plugin.entries
        assert not entry.enabled
        sent = []
        entry._publisher.publish = sent.append
        entry.publish()
        entry.publish()
        assert [(message.linear.x, message.angular.z) for message in sent] == [(2.0, 1.0), (2.0, 0.5)]
        gui.plugin.save_settings(keeper, keeper)
        [saved] = ast.literal_eval(keeper.values["publishers"])
        assert kept["expressions"].items() <= saved["expressions"].items()
        assert {**saved, "expressions": None} == {**kept, "enabled": False, "counter": 0, "expressions": None}
    assert errors == []


class Keeper:
    """rqt's settings, in memory."""

    def __init__(self, values):
        self.values = values

    def value(self, key, default=None):
        return self.values.get(key, default)

    def set_value(self, key, value):
        self.values[key] = value
