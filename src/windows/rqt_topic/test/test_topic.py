"""Topics, their rows, and what happens while they are monitored."""

import io

import pytest
import rospy
from geometry_msgs.msg import Point32, Polygon, PolygonStamped
from python_qt_binding.QtCore import Qt
from rqt_testing.in_process import application, errors, find, open_plugin, rospy_without_master
from rqt_topic import topic_info
from rqt_topic.topic_widget import TopicWidget, _bandwidth_text
from std_msgs.msg import String


@pytest.fixture
def clock(monkeypatch):
    class Clock:
        now = 100.0

    monkeypatch.setattr(topic_info.time, "monotonic", lambda: Clock.now)
    return Clock


@pytest.fixture
def widget():
    application()
    rospy_without_master()
    widget = TopicWidget()
    widget.set_topics([("/text", "std_msgs/String"), ("/shape", "geometry_msgs/PolygonStamped"), ("/odd", "no_package/Odd")])
    yield widget
    widget.shutdown_plugin()


def row(widget, *names):
    item = widget.tree.invisibleRootItem()
    for name in names:
        item = next(item.child(n) for n in range(item.childCount()) if item.child(n).text(0) == name)
    return item


def send(widget, topic, message):
    raw, buffer = rospy.AnyMsg(), io.BytesIO()
    message.serialize(buffer)
    raw._buff = buffer.getvalue()
    widget._rows[topic][1].message_callback(raw)


def texts(item):
    return [item.text(column) for column in range(5)]


def test_rows(widget):
    assert texts(row(widget, "/text")) == ["/text", "std_msgs/String", "", "", "not monitored"]
    assert row(widget, "/odd").text(4) == 'can not get message class for type "no_package/Odd"'
    field = row(widget, "/shape", "header", "stamp")
    assert field.text(1) == "time" and field.data(0, Qt.ItemDataRole.UserRole) == "/shape/header/stamp"
    assert widget.tree.mimeData([field]).text() == "/shape/header/stamp"
    assert widget._rows["/text"][1]._subscriber is None


def test_rate_bandwidth_and_value(widget, clock):
    item = row(widget, "/text")
    item.setCheckState(0, Qt.CheckState.Checked)
    assert widget._rows["/text"][1]._subscriber is not None
    item.setExpanded(True)
    assert texts(item)[2:] == ["unknown", "unknown", ""]
    for _ in range(200):
        clock.now += 0.1
        send(widget, "/text", String("x" * 96))
    widget.show_values()
    assert texts(item)[2:] == ["1.00KB/s", "10.00", ""]
    assert row(widget, "/text", "data").text(4) == repr("x" * 96)
    clock.now += 90.1  # it has fallen silent
    widget.show_values()
    assert float(item.text(3)) == pytest.approx(1.0, abs=0.02)
    item.setCheckState(0, Qt.CheckState.Unchecked)
    assert widget._rows["/text"][1]._subscriber is None and item.text(4) == "not monitored"


def test_arrays_grow_and_shrink(widget):
    item = row(widget, "/shape")
    item.setCheckState(0, Qt.CheckState.Checked)
    for parent in (item, row(widget, "/shape", "polygon"), row(widget, "/shape", "polygon", "points")):
        parent.setExpanded(True)
    for count in (3, 1):
        send(widget, "/shape", PolygonStamped(polygon=Polygon([Point32(n, float("nan"), 0) for n in range(count)])))
        widget.show_values()
        points = row(widget, "/shape", "polygon", "points")
        points.setExpanded(True)
        widget.show_values()
        assert [points.child(n).text(0) for n in range(points.childCount())] == [f"[{n}]" for n in range(count)]
    points.child(0).setExpanded(True)
    widget.show_values()
    assert row(widget, "/shape", "polygon", "points", "[0]", "y").text(4) == "nan"
    assert row(widget, "/shape", "polygon", "points", "[0]", "x").data(0, Qt.ItemDataRole.UserRole) == "/shape/polygon/points[0]/x"


def test_bytes_of_another_type(widget):
    row(widget, "/shape").setCheckState(0, Qt.CheckState.Checked)
    send(widget, "/shape", String("?"))
    widget.show_values()
    assert row(widget, "/shape").text(4).startswith("not a geometry_msgs/PolygonStamped")


def test_topics_come_and_go_and_change_type(widget):
    row(widget, "/text").setCheckState(0, Qt.CheckState.Checked)
    widget.set_topics([("/text", "std_msgs/String"), ("/shape", "std_msgs/Float64"), ("/new", "std_msgs/Empty")])
    assert row(widget, "/text").checkState(0) == Qt.CheckState.Checked
    assert sorted(widget._rows) == ["/new", "/shape", "/text"] and row(widget, "/shape").text(1) == "std_msgs/Float64"


def test_bandwidth_sorts_by_number(widget):
    assert [_bandwidth_text(value) for value in (12, 3456, 7.89e6, None)] == ["12.00B/s", "3.46KB/s", "7.89MB/s", "unknown"]
    for name, value in (("/text", 9e6), ("/shape", 10.0), ("/odd", 9e3)):
        widget._fill_row(row(widget, name), value, 1.0)
    widget.tree.sortByColumn(2, Qt.SortOrder.AscendingOrder)
    assert [widget.tree.topLevelItem(n).text(0) for n in range(3)] == ["/shape", "/odd", "/text"]


def test_in_the_window():
    rospy_without_master()
    with open_plugin("rqt_topic") as gui:
        gui.plugin.widget.set_topics([("/text", "std_msgs/String")])
        assert find(gui, "topics_tree_widget").topLevelItemCount() == 1
    assert errors == []
