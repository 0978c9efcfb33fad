#!/usr/bin/env python3
"""A robot with an arm and a hand controller that do what ``~mode`` says: follow, reject, abort or stall."""

import threading

import actionlib
import rospy
from control_msgs.msg import FollowJointTrajectoryAction, FollowJointTrajectoryResult, GripperCommandAction, GripperCommandResult
from sensor_msgs.msg import JointState

JOINTS = [f"joint_{number}" for number in range(1, 7)]


class Robot:
    """Joint states, and both controllers."""

    def __init__(self):
        self._values = dict(zip(JOINTS, [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]), finger_joint=0.0)
        self._publisher = rospy.Publisher("joint_states", JointState, queue_size=10)
        threading.Thread(target=self._publish, daemon=True).start()
        if rospy.has_param("~late"):  # as between the first and the last topic of an action server that starts, but longer
            self._first = [
                rospy.Publisher(f"{action}/{topic}", kind, queue_size=1)
                for action, kinds in (
                    ("arm_controller/follow_joint_trajectory", FollowJointTrajectoryAction()),
                    ("hand_controller/gripper_action", GripperCommandAction()),
                )
                for topic, kind in (("result", type(kinds.action_result)), ("feedback", type(kinds.action_feedback)))
            ]
            rospy.sleep(rospy.get_param("~late"))
        self._arm = actionlib.SimpleActionServer(
            "arm_controller/follow_joint_trajectory", FollowJointTrajectoryAction, self._follow, auto_start=False
        )
        self._hand = actionlib.SimpleActionServer("hand_controller/gripper_action", GripperCommandAction, self._grip, auto_start=False)
        self._arm.start()
        self._hand.start()

    def _publish(self):
        while not rospy.is_shutdown():
            message = JointState(name=list(self._values), position=list(self._values.values()))
            message.header.stamp = rospy.Time.now()
            self._publisher.publish(message)
            rospy.sleep(0.02)

    def _follow(self, goal):
        rospy.set_param(
            "~goal",
            {
                "joints": goal.trajectory.joint_names,
                "goal_time": goal.goal_time_tolerance.to_sec(),
                "tolerances": {entry.name: entry.position for entry in goal.goal_tolerance},
            },
        )
        mode = rospy.get_param("~mode", "follow")
        if mode == "reject":
            self._arm.set_aborted(FollowJointTrajectoryResult(FollowJointTrajectoryResult.INVALID_JOINTS, "not\nmine"), "no")
            return
        start = rospy.Time.now()
        for point in goal.trajectory.points:
            while rospy.Time.now() < start + point.time_from_start or mode == "stall":
                if self._arm.is_preempt_requested():
                    self._arm.set_preempted(FollowJointTrajectoryResult())
                    return
                rospy.sleep(0.005)
            self._values.update(zip(goal.trajectory.joint_names, point.positions))
            if mode == "abort" and point.time_from_start.to_sec() > 0.2:
                result = FollowJointTrajectoryResult(FollowJointTrajectoryResult.PATH_TOLERANCE_VIOLATED, "joint_1 is late")
                self._arm.set_aborted(result, "path")
                return
        self._arm.set_succeeded(FollowJointTrajectoryResult())

    def _grip(self, goal):
        rospy.set_param("~grip", [goal.command.position, goal.command.max_effort])
        self._values["finger_joint"] = goal.command.position
        self._hand.set_succeeded(GripperCommandResult(position=goal.command.position, reached_goal=True))


if __name__ == "__main__":
    rospy.init_node("pretend_controller")
    Robot()
    rospy.spin()
