"""libgazebo_ros_joint_pose_trajectory.so: joints are put to the points of a trajectory one after the other."""
from __future__ import annotations

import math

import rospy
from gazebo_ros.plugin import ModelPlugin
from trajectory_msgs.msg import JointTrajectory

from gazebo_plugins.ros_side import RateGate, Topics


class JointPoseTrajectory(ModelPlugin):
    """``time_from_start`` of a point is how long to wait **after the point before it**, as upstream has it."""

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        self.topics = Topics(sdf, model.name, "C")
        topic = sdf.get("topicName", "set_joint_trajectory") or "set_joint_trajectory"
        self.topic = self.topics.resolve(topic)
        self.topics.subscriber(topic, JointTrajectory, self._receive, 100)
        self.gate = RateGate(sdf.get("updateRate", 0.0))
        self.points, self.joints, self.next_ns = [], [], 0
        server.before_step(self.step)

    def _receive(self, message: JointTrajectory) -> None:
        unknown = [name for name in message.joint_names if name not in self.model.joints]
        if unknown:
            rospy.logwarn("%s: model %s has no joint %s; the trajectory is ignored", self.topic, self.model.name, ", ".join(unknown))
            return
        if any(len(point.positions) != len(message.joint_names) or not all(map(math.isfinite, point.positions))
               for point in message.points):
            rospy.logwarn("%s: each point needs one finite position per joint; the trajectory is ignored", self.topic)
            return
        self.server.call(lambda: self._start(message))

    def _start(self, message: JointTrajectory) -> None:
        self.joints = [self.model.joints[name] for name in message.joint_names]
        self.points = list(message.points)
        self.next_ns = max(self.server.now().to_nsec(), message.header.stamp.to_nsec())

    def step(self) -> None:
        now = self.server.now()
        if not self.points or not self.gate.open(now) or now.to_nsec() < self.next_ns:
            return
        point = self.points.pop(0)
        for joint, position in zip(self.joints, point.positions):
            joint.set_position(position)
        if self.points:
            self.next_ns += self.points[0].time_from_start.to_nsec()

    def reset(self) -> None:
        self.points = []

    def shutdown(self) -> None:
        self.topics.close()
