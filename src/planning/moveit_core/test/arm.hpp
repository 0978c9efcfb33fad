// The robot of these tests: a column that turns, two links, a hand with two fingers that mirror each other.
#pragma once

#include <moveit/robot_model/robot_model.h>

inline moveit::core::RobotModelPtr makeArm()
{
  static const char* const urdf_text = R"(<robot name="arm"><link name="base"/>
    <link name="column"><collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.05" length="0.3"/></geometry></collision></link>
    <link name="upper"><collision><origin xyz="0 0 0.25"/><geometry><box size="0.05 0.05 0.4"/></geometry></collision></link>
    <link name="lower"><collision><origin xyz="0 0 0.2"/><geometry><box size="0.04 0.04 0.3"/></geometry></collision></link>
    <link name="hand"/>
    <link name="left"><collision><geometry><box size="0.02 0.01 0.06"/></geometry></collision></link>
    <link name="right"><collision><geometry><box size="0.02 0.01 0.06"/></geometry></collision></link>
    <joint name="turn" type="continuous"><parent link="base"/><child link="column"/><axis xyz="0 0 1"/>
      <limit velocity="1" effort="1"/></joint>
    <joint name="lift" type="revolute"><parent link="column"/><child link="upper"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
      <limit lower="-2" upper="2" velocity="1.5" effort="1"/></joint>
    <joint name="bend" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0 0.5"/><axis xyz="0 1 0"/>
      <limit lower="-2.5" upper="2.5" velocity="2" effort="1"/></joint>
    <joint name="wrist" type="fixed"><parent link="lower"/><child link="hand"/><origin xyz="0 0 0.4"/></joint>
    <joint name="grip" type="prismatic"><parent link="hand"/><child link="left"/><origin xyz="0 0 0.05"/><axis xyz="0 1 0"/>
      <limit lower="0" upper="0.04" velocity="0.1" effort="1"/></joint>
    <joint name="grip_mirror" type="prismatic"><parent link="hand"/><child link="right"/><origin xyz="0 0 0.05"/>
      <axis xyz="0 -1 0"/><limit lower="0" upper="0.04" velocity="0.1" effort="1"/><mimic joint="grip"/></joint></robot>)";
  static const char* const srdf_text = R"(<robot name="arm">
    <virtual_joint name="stand" type="planar" parent_frame="floor" child_link="base"/>
    <group name="manipulator"><chain base_link="base" tip_link="hand"/></group>
    <group name="fingers"><joint name="grip"/><joint name="grip_mirror"/></group>
    <group_state name="ready" group="manipulator"><joint name="turn" value="0.3"/><joint name="lift" value="0.5"/>
      <joint name="bend" value="1.2"/></group_state>
    <end_effector name="gripper" parent_link="hand" group="fingers" parent_group="manipulator"/>
    <disable_collisions link1="column" link2="upper" reason="Adjacent"/>
    <disable_collisions link1="upper" link2="lower" reason="Adjacent"/>
    <disable_collisions link1="lower" link2="left" reason="Adjacent"/>
    <disable_collisions link1="lower" link2="right" reason="Adjacent"/>
    <disable_collisions link1="left" link2="right" reason="Adjacent"/></robot>)";
  const auto urdf_model = std::make_shared<urdf::Model>();
  urdf_model->initString(urdf_text);
  const auto srdf_model = std::make_shared<srdf::Model>();
  srdf_model->initString(*urdf_model, srdf_text);
  return std::make_shared<moveit::core::RobotModel>(urdf_model, srdf_model);
}
