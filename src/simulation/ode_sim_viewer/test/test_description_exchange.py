"""Descriptions that travel to another process and into a world file come back as they were."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from ode_sim import World
from ode_sim.description import load_world, read_model
from ode_sim.description import model as d
from ode_sim.description.exchange import dumps, loads
from ode_sim.description.sdf_writer import light_text, model_text, world_text
from ode_sim_viewer.saving import describe_now
from ode_sim_viewer.simulation import record_world

ROBOT = """<robot name="r"><link name="a"><inertial><mass value="2"/><origin xyz="0 0 .1"/>
<inertia ixx=".1" ixy="0" ixz="0" iyy=".2" iyz="0" izz=".3"/></inertial>
<visual><geometry><box size="1 2 3"/></geometry><material name="m"><color rgba="1 0 0 .5"/></material></visual>
<collision><geometry><sphere radius=".4"/></geometry></collision></link>
<link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><origin xyz="0 0 1" rpy="0 .5 0"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="2" effort="5" velocity="3"/><dynamics damping=".7" friction=".1"/></joint>
<gazebo reference="a"><mu1>0.3</mu1><material>Gazebo/Red</material><sensor name="s" type="ray">
<update_rate>5</update_rate>
<plugin name="p" filename="libp.so"><topicName>scan</topicName></plugin></sensor></gazebo></robot>"""


@pytest.fixture(scope="module")
def robot():
    return read_model(ROBOT)[0]


def test_a_model_comes_back_with_everything(robot):
    back = loads(dumps(robot))
    assert dumps(back) == dumps(robot)
    assert back.joints[0].axes == robot.joints[0].axes and back.links[0].inertial == robot.links[0].inertial
    sensor = back.links[0].sensors[0]
    assert sensor.plugins[0].element.findtext("topicName") == "scan" and isinstance(sensor.element, ET.Element)


def test_what_is_no_description_is_refused():
    with pytest.raises(TypeError, match="set"):
        dumps({"a": {1}})
    for text in ('{"_": "World", "nonsense": 1}', '{"_": "Popen"}', "[", '{"_": "xml", "text": "<a"}'):
        with pytest.raises(ValueError):
            loads(text)


def test_a_written_model_is_read_as_the_same(robot):
    back, problems = read_model(model_text(robot))
    assert not problems
    for ours, theirs in zip(robot.links, back.links):
        np.testing.assert_allclose(theirs.pose.p + theirs.pose.q, ours.pose.p + ours.pose.q, atol=1e-9)
        assert theirs.inertial == ours.inertial and theirs.sensors[0:1] == theirs.sensors[0 : len(ours.sensors)]
        assert [v.geometry for v in theirs.visuals] == [v.geometry for v in ours.visuals]
        assert [v.material.diffuse for v in theirs.visuals] == [v.material.diffuse for v in ours.visuals]
        assert [c.surface for c in theirs.collisions] == [c.surface for c in ours.collisions]
    ours, theirs = robot.joints[0], back.joints[0]
    np.testing.assert_allclose(theirs.axes[0].xyz, ours.axes[0].xyz, atol=1e-9)
    assert (theirs.axes[0].lower, theirs.axes[0].effort, theirs.axes[0].damping) == (-1.0, 5.0, 0.7)
    assert back.links[0].sensors[0].plugins[0].filename == "libp.so"


def test_a_light_is_read_as_the_same():
    from ode_sim.description import read_light

    light = d.Light("lamp", "spot", d.Pose((1.0, 2.0, 3.0)), diffuse=(0.5, 0.25, 1.0, 1.0), range=7.0, spot=(0.2, 0.4, 1.0))
    assert dumps(read_light(light_text(light))[0]) == dumps(light)


def test_a_road_is_saved_as_it_was_read():
    road = """<road name="street"><width>7.5</width><point>0 0 0</point><point>1 2 0.1</point>
        <material><script><uri>file://media/materials/scripts/gazebo.material</uri><name>Gazebo/Lanes_4</name></script></material></road>"""
    world = World.load(f"<sdf version='1.6'><world name='w'>{road}</world></sdf>")
    again = World.load(world_text(describe_now(world)))
    assert len(world.scene.roads) == 1 and not again.problems
    assert [dumps(replace(r, source=d.Source())) for r in again.scene.roads] == [
        dumps(replace(r, source=d.Source())) for r in world.scene.roads
    ]


@pytest.mark.parametrize("name", ["worlds/shapes.world", "worlds/seesaw.world", "worlds/cafe.world"])
def test_a_saved_world_goes_on_where_it_was(name):
    world = World.load(name)
    world.gravity = (0.0, 0.0, -3.0)
    world.step(120)
    text = world_text(describe_now(world))
    again = World.load(text)
    assert not [p for p in again.problems if p.severity == "error"]
    assert list(again.models) == list(world.models) and list(again.lights) == list(world.lights)
    assert again.time == world.time and again.gravity == (0.0, 0.0, -3.0)
    np.testing.assert_allclose(again.link_poses[:, :3], world.link_poses[:, :3], atol=1e-6)
    turned = np.abs(np.sum(again.link_poses[:, 3:] * world.link_poses[:, 3:], axis=1))
    np.testing.assert_allclose(turned, 1.0, atol=1e-6)  # q and -q are the same
    assert load_world(text)[0].scene == world.scene


def test_a_record_of_a_world_knows_its_rows_and_its_lights_of_now():
    world = World.load("worlds/seesaw.world")
    record = loads(dumps(record_world(world, 7)))
    assert record.revision == 7 and [m.name for m in record.models] == list(world.models)
    for model in record.models:
        for name, row in model.links.items():
            assert world.models[model.name].links[name].index == row
