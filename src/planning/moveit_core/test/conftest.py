"""A small robot and its scene."""

import motion
import pytest

URDF = """<robot name="two">
  <link name="base"/><link name="arm"><collision><geometry><box size="0.1 0.1 0.5"/></geometry></collision></link>
  <link name="tip"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" velocity="1" effort="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="arm"/><child link="tip"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="0.5" velocity="1" effort="1"/></joint>
</robot>"""
SRDF = """<robot name="two"><group name="all"><joint name="turn"/><joint name="slide"/></group>
  <virtual_joint name="base_joint" type="planar" parent_frame="odom" child_link="base"/></robot>"""


@pytest.fixture
def scene():
    return motion.PlanningScene(motion.load_model(URDF, SRDF))


@pytest.fixture
def said():
    return []


@pytest.fixture
def editor(scene, said):
    from moveit_core.scene_messages import SceneEditor

    return SceneEditor(scene, said.append)
