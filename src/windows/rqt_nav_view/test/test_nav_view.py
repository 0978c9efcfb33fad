"""Map, lines and the mouse, in the container, without display and master."""

import math

import numpy as np
import pytest

from rqt_testing.in_process import errors, find, open_plugin, process_events, rospy_without_master  # isort: skip
import rospy
from geometry_msgs.msg import Point32, PolygonStamped, PoseStamped, TransformStamped
from nav_msgs.msg import OccupancyGrid, Path
from python_qt_binding.QtCore import QPointF, Qt
from python_qt_binding.QtTest import QTest
from rqt_nav_view.geometry import MapError, map_pixels, points_of, transformed, yaw


def grid(width=4, height=3, data=None, resolution=0.5):
    message = OccupancyGrid(data=data if data is not None else [0] * (width * height))
    message.header.frame_id = "map"
    message.info.width, message.info.height, message.info.resolution = width, height, resolution
    message.info.origin.position.x, message.info.origin.position.y = -1.0, 2.0
    message.info.origin.orientation.w = 1.0
    return message


def path(points, frame="map"):
    message = Path()
    message.header.frame_id = frame
    for x, y in points:
        pose = PoseStamped()
        pose.pose.position.x, pose.pose.position.y = x, y
        message.poses.append(pose)
    return message


def test_map_to_pixels():
    assert map_pixels(grid(data=[0, 100, -1, 50] + [0] * 8))[0].tolist() == [255, 0, 200, 128]


@pytest.mark.parametrize(
    "change, said",
    [
        (dict(data=[0] * 11), "4 x 3 cells with 11 values"),
        (dict(width=0, data=[]), "0 x 3"),
        (dict(resolution=0.0), "cells of 0.0 m"),
        (dict(resolution=math.nan), "cells of nan m"),
    ],
)
def test_maps_that_make_no_sense(change, said):
    with pytest.raises(MapError, match=said):
        map_pixels(grid(**change))


def test_points():
    polygon = PolygonStamped()
    polygon.polygon.points = [Point32(0, 0, 0), Point32(1, 0, 0), Point32(math.nan, 0, 0)]
    assert points_of(polygon).tolist() == [[0, 0, 0], [1, 0, 0], [0, 0, 0]]
    transform = TransformStamped().transform
    transform.translation.x, transform.rotation.z, transform.rotation.w = 5.0, math.sin(math.pi / 4), math.cos(math.pi / 4)
    assert np.allclose(transformed(np.array([[1.0, 0.0, 0.0]]), transform), [[5.0, 1.0]])
    assert yaw(transform.rotation) == pytest.approx(math.pi / 2)


@pytest.fixture
def gui():
    rospy_without_master()
    with open_plugin("rqt_nav_view") as gui:
        gui.window.resize(700, 500)
        gui.view = gui.plugin.widget.view
        yield gui


def test_map_and_paths_are_in_place(gui):
    gui.view.map_cb(grid())
    gui.view.line_cb("/move_base/NavFn/plan", path([(-1, 2), (1, 3.5)]))
    process_events()
    rect = gui.view._map_item.sceneBoundingRect()
    assert (rect.left(), rect.top(), rect.width(), rect.height()) == (-1.0, 2.0, 2.0, 1.5)
    line = gui.view._lines["/move_base/NavFn/plan"].path()
    assert (line.elementAt(1).x, line.elementAt(1).y) == (1.0, 3.5)
    # y is up on the screen
    assert gui.view.mapFromScene(QPointF(0, 3)).y() < gui.view.mapFromScene(QPointF(0, 2)).y()
    assert errors == []


def test_lines_of_other_frames_are_moved_or_told(gui):
    gui.view.map_cb(grid())
    process_events()
    for _ in range(3):
        gui.view.line_cb("/move_base/NavFn/plan", path([(0, 0), (1, 0)], "odom"))
    process_events()
    assert len(errors) == 1 and "/move_base/NavFn/plan is not shown" in errors[0]
    transform = TransformStamped()
    transform.header.frame_id, transform.child_frame_id, transform.transform.translation.y = "map", "odom", 3.0
    transform.transform.rotation.w = 1.0
    gui.plugin.widget._tf.set_transform_static(transform, "test")
    gui.view.line_cb("/move_base/NavFn/plan", path([(0, 0), (1, 0)], "odom"))
    process_events()
    assert gui.view._lines["/move_base/NavFn/plan"].path().elementAt(1).y == 3.0


def test_broken_maps_are_told_once(gui):
    for _ in range(2):
        gui.view.map_cb(grid(data=[0]))
    process_events()
    assert len(errors) == 1 and "4 x 3 cells with 1 values" in errors[0]


@pytest.mark.parametrize("button, kind", [("set_goal", "goal"), ("set_pose", "pose")])
def test_a_drag_sets_pose_and_goal(gui, monkeypatch, button, kind):
    sent = []
    monkeypatch.setattr(gui.view._publishers[kind], "publish", sent.append)
    gui.view.map_cb(grid())
    process_events()
    find(gui, button).click()
    begin, end = gui.view.mapFromScene(QPointF(0, 2.5)), gui.view.mapFromScene(QPointF(0, 3.2))
    port = gui.view.viewport()
    QTest.mousePress(port, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, begin)
    QTest.mouseMove(port, end)
    QTest.mouseRelease(port, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, end)
    pose = sent[0].pose.pose if kind == "pose" else sent[0].pose
    assert sent[0].header.frame_id == "map" and (pose.position.x, pose.position.y) == (
        pytest.approx(0, abs=0.02),
        pytest.approx(2.5, abs=0.02),
    )
    assert yaw(pose.orientation) == pytest.approx(math.pi / 2, abs=0.05)
    if kind == "pose":
        assert sent[0].pose.covariance[0] == 0.25 and len(sent[0].pose.covariance) == 36
    QTest.mouseClick(port, Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier, begin)
    assert len(sent) == 1  # one drag only


def test_topics_come_back(tmp_path):
    rospy_without_master()
    settings = str(tmp_path / "a.ini")
    with open_plugin("rqt_nav_view", settings=settings) as gui:
        gui.plugin.widget.show_topics("/other_map", ["/plan"], [])
    with open_plugin("rqt_nav_view", settings=settings) as gui:
        assert (gui.plugin.widget.map_topic, gui.plugin.widget.paths, gui.plugin.widget.polygons) == ("/other_map", ["/plan"], [])
    assert errors == [] and rospy.core.is_initialized()
