"""What is drawn of the messages of sensors, in a page without a browser; and what the tab of topics says of them. No master."""

import types

import numpy as np
import pytest
from gazebo_msgs.msg import ContactsState, ContactState
from geometry_msgs.msg import Vector3, Wrench
from ode_sim import World
from ode_sim.description import model as d
from ode_sim.math3 import Pose, quat_from_rpy
from ode_sim_viewer import LocalSimulation, Page
from ode_sim_viewer.shapes import shape_model
from sensor_msgs.msg import JointState, LaserScan

pytest.importorskip("viser")

from gzclient import sensor_drawing  # noqa: E402
from gzclient.panels import sensors as panel_module  # noqa: E402
from gzclient.panels.topics import TopicsPanel  # noqa: E402

GROUND = d.Model("ground", static=True, links=(d.Link("l"),))


@pytest.fixture
def page(monkeypatch):
    """A box turned upside down above the ground."""
    monkeypatch.setattr(panel_module.rospy, "Subscriber", lambda *_, **__: types.SimpleNamespace(unregister=lambda: None))
    world = World(d.World(models=(GROUND, shape_model("box", d.Box()))))
    world.models["box"].pose = Pose((0.0, 0.0, 2.0), quat_from_rpy(3.141592653589793, 0.0, 0.0))
    page = Page(LocalSimulation(world, paused=True), port=0, panels=(panel_module.SensorsPanel, TopicsPanel))
    while page.frame is None:
        page.turn()
    yield page
    page.close()


def shown(page, kind, topic, message):
    """The source of a topic that was switched on and has told ``message``."""
    source = panel_module._Source(topic, sensor_drawing.KINDS[kind].cls)
    panel = page.panels[-2]
    panel._replace(kind, {topic: source}, True)
    source._take(message)
    panel.on_frame(page.frame)
    return source


def touch(first, second, z):
    """A bumper's message: ``z`` N on ``first`` in the frame of its link."""
    return ContactsState(
        states=[
            ContactState(
                collision1_name=f"{first}::{second}",
                collision2_name="ground::l::c" if first == "box" else "box::link::c",
                wrenches=[Wrench(force=Vector3(z=z))],
                contact_positions=[Vector3(x=0.5)],
            )
        ]
    )


@pytest.mark.parametrize("first, link, z", [("box", "link::c", -50.0), ("ground", "l::c", -50.0)])
def test_a_bumper_shows_the_force_on_the_body_that_can_move(page, first, link, z):
    source = shown(page, "Bumpers", "/bump", touch(first, link, z))
    begin, tip = source.forces._arrows.points[0]
    np.testing.assert_allclose(begin, (0.5, 0.0, 0.0), atol=1e-6)
    np.testing.assert_allclose(tip - begin, (0.0, 0.0, 0.5), atol=1e-6)  # it bears the box: upwards


def test_a_scan_stays_where_it_is_when_all_is_drawn_anew(page):
    scan = LaserScan(angle_increment=0.1, range_min=0.1, range_max=5.0, ranges=[1.0, 2.0])
    scan.header.frame_id = "link"
    source = shown(page, "Laser scans", "/scan", scan)
    assert source.node is not None
    page.drawing.wireframe = True
    page.redraw()
    scan.ranges = [3.0]
    source._take(scan)
    for _ in range(200):  # however late the page hears of the world again
        page.turn()
        page.panels[-2].on_frame(page.frame or page.simulation.frame())
        if source.node is not None and len(source.node.points) == 1:
            break
    np.testing.assert_allclose(source.node.points, [(3.0, 0.0, 0.0)], atol=1e-6)
    assert not source.node._impl.removed


def test_a_field_that_a_message_has_not_leaves_the_line_of_its_topic(page):
    topics = page.panels[-1]
    topics._topic, topics._type = "/joint_states", "sensor_msgs/JointState"
    topics._plot_field("pose[0].position.z")  # of the topic that was looked at before
    message = JointState(name=["a"], position=[1.5])
    topics._take(message)
    topics.on_frame(page.frame)
    assert "/joint_states (sensor_msgs/JointState), 1 messages" in topics._state.content
    assert "there is no pose" in topics._why.content and topics._why.visible and not topics._plots.visible
    topics._plot_field("position[0]")
    topics._take(message)
    topics._take(message)
    topics.on_frame(page.frame)
    assert not topics._why.visible and topics._plots.visible and topics._plot is not None
    topics._plot_field("")
    topics.on_frame(page.frame)
    assert not topics._why.visible and not topics._plots.visible
