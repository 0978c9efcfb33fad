"""The node ``goal_marker``.

Topics for RViz's displays: ``goal_marker/update`` (InteractiveMarkers), ``goal_marker/goal``, ``goal_marker/path`` and
``goal_marker/scene`` (MarkerArray). The marker is dragged to where the hand is to go; its menu plans and moves.
"""
from __future__ import annotations

import rospy

import node_signals
from moveit_commander import MoveGroupCommander, RobotCommander
from moveit_ros_visualization.external import ExternalTopics
from moveit_ros_visualization.goal import GoalMarker
from moveit_ros_visualization.path import PathGhost
from moveit_ros_visualization.scene import SceneMarkers


def main() -> int:
    """Run until the node is shut down; the exit code. ``~group`` names the group, default the first that has a tip."""
    node_signals.init_node("goal_marker")
    try:
        robot = RobotCommander()
        name = rospy.get_param("~group", "") or _first_group(robot)
        if not name:
            rospy.logerr("no group of the robot has an end effector link: there is nothing to set a goal for")
            return 1
        group = MoveGroupCommander(name, wait_for_servers=0.0)
    except RuntimeError as error:
        rospy.logerr("%s", error)
        return 1
    goal = GoalMarker(robot, group)
    parts = [goal, ExternalTopics(goal), PathGhost(robot, group.get_end_effector_link()), SceneMarkers()]
    rospy.loginfo("Set the goal of group '%s' with the marker in RViz; its menu (right button) plans and moves", name)
    node_signals.spin()
    for part in parts:
        part.shutdown()
    return 0


def _first_group(robot: RobotCommander) -> str:
    model = robot.model
    solved = [name for name in model.groups if name in robot.description.kinematics]
    return next((name for name in solved or model.groups if model.group(name).tip_link), "")
