"""The tree of frames, as text and in its window."""

import pytest
import rospy
from geometry_msgs.msg import TransformStamped
from qt_dotgraph.layout import layout
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until
from rqt_tf_tree.dotcode_tf import FramesError, generate_dot, parse

FRAMES = """
base_link:
  parent: 'odom'
  broadcaster: '/gazebo'
  rate: 50.200
  most_recent_transform: 12.5
  oldest_transform: 2.5
  buffer_length: 10.000
tool0:
  parent: 'base_link'
  broadcaster: '/robot_state_publisher'
  rate: 10000.000
  most_recent_transform: 0.0
  oldest_transform: 0.0
  buffer_length: 0.000
"""


def test_edges_say_who_how_often_and_how_old():
    graph = layout(generate_dot(parse(FRAMES), 13.25))
    assert {node.label for node in graph.nodes} == {"odom", "base_link", "tool0", "Recorded at time: 13.25"}
    labels = {(edge.tail, edge.head): edge.label for edge in graph.edges}
    assert labels[("f_odom", "f_base_link")] == (
        "Broadcaster: /gazebo\nAverage rate: 50.2\nBuffer length: 10.0\nMost recent transform: 12.5\nOldest transform: 2.5"
    )
    assert "Average rate: 10000.0" in labels[("f_base_link", "f_tool0")]
    heights = {node.label: node.center[1] for node in graph.nodes}
    assert heights["Recorded at time: 13.25"] > heights["odom"] > heights["base_link"] > heights["tool0"]


@pytest.mark.parametrize("text", ["", "[]", "{}", "null"])
def test_no_frames(text):
    assert "No tf data received" in generate_dot(parse(text), 0)


def test_frames_that_cannot_be_listed_and_loops():
    with pytest.raises(FramesError, match="cannot be listed"):
        parse("a: {\n")
    loop = {"a": {"parent": "b"}, "b": {"parent": "a"}}
    assert len(layout(generate_dot(loop, 0)).nodes) == 3


def transform(parent, child, seconds):
    message = TransformStamped()
    message.header.frame_id, message.child_frame_id, message.header.stamp = parent, child, rospy.Time.from_sec(seconds)
    message.transform.rotation.w = 1
    return message


def drawn(gui):
    return {item.text() for item in gui.plugin.pane.nodes.values()}


def test_window_draws_what_it_hears_and_forgets_it(monkeypatch):
    rospy_without_master()
    monkeypatch.setattr("rqt_tf_tree.tf_tree.LISTEN", 20)
    with open_plugin("rqt_tf_tree") as gui:
        wait_until(lambda: drawn(gui) == {"No tf data received"})
        for seconds in (100, 101):
            gui.plugin._buffer.set_transform(transform("odom", "base", seconds), "/me")
        wait_until(lambda: {"odom", "base"} <= drawn(gui))  # without a click
        assert "Broadcaster: /me" in next(iter(gui.plugin.pane.edges.values()))[0].text()
        gui.plugin._buffer.set_transform(transform("base", "tool", 100), "/me")
        find(gui, "refresh_graph_push_button").click()
        wait_until(lambda: "tool" in drawn(gui))
        find(gui, "clear_buffer_push_button").click()
        wait_until(lambda: drawn(gui) == {"No tf data received"})
    assert errors == []


def test_generator_for_other_packages():
    from types import SimpleNamespace

    from qt_dotgraph.dot_to_qt import DotToQtGenerator
    from qt_dotgraph.pydotfactory import PydotFactory
    from rqt_testing.in_process import application
    from rqt_tf_tree.dotcode_tf import RosTfTreeDotcodeGenerator

    application()
    answers = [
        "{}",
        "base: {parent: map, broadcaster: /b, rate: 10.0, buffer_length: 1.0, most_recent_transform: 5.0, oldest_transform: 4.0}",
    ]
    timer = SimpleNamespace(now=lambda: SimpleNamespace(to_sec=lambda: 7.5))
    generator, factory = RosTfTreeDotcodeGenerator(initial_listen_duration=0), PydotFactory()

    def texts(**more):
        text = generator.generate_dotcode(factory, lambda: SimpleNamespace(frame_yaml=answers[0]), timer, **more)
        nodes, edges = DotToQtGenerator().dotcode_to_qt_items(text, 3)
        return {node.text() for node in nodes.values()}, [edge.text() for items in edges.values() for edge in items]

    assert texts() == ({"No tf data received"}, [])
    answers.pop(0)
    assert texts() == ({"No tf data received"}, [])  # kept until it is refreshed
    names, edges = texts(force_refresh=True)
    assert names == {"map", "base", "Recorded at time: 7.5"}
    assert any("Broadcaster: /b\nAverage rate: 10.0\n" in edge for edge in edges)
