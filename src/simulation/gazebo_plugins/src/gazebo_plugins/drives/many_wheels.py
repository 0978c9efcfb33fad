"""hector_gazebo_plugins' libdiffdrive_plugin_multi_wheel.so and libdiffdrive_plugin_6w.so: any number of wheels, those of a side turning
alike."""

from __future__ import annotations

from typing import Any

import rospy
from gazebo_ros.plugin import ModelPlugin
from nav_msgs.msg import Odometry
from node_signals.rates import PeriodAdded

from gazebo_plugins.drives.wheels import Command, OdometryPublisher, ground_truth
from gazebo_plugins.ros_side import Topics, find_joint, joint_named, length, required


class _Sides(ModelPlugin):
    """Wheels of two sides, driven from a command."""

    topics: Topics

    def _start(self, server, model, sdf, left: list[Any], right: list[Any], torque: float, topic: str) -> None:
        """:param torque: of each wheel, N m. :param topic: of commands"""
        self.server, self.model = server, model
        self.left, self.right, self.torque = left, right, torque
        self.separation, self.radius = sdf.get("wheelSeparation", 0.34), length(sdf, "wheelDiameter", 0.15) / 2
        self.command = Command(self.topics, topic)
        self._drive()
        server.drives(*left, *right)
        server.before_step(self.step)

    def step(self) -> None:
        raise NotImplementedError

    def _drive(self) -> None:
        half_turn = self.command.yaw_rate * self.separation / 2
        for joints, side in ((self.left, -1), (self.right, 1)):
            for joint in joints:
                joint.set_motor((self.command.x + side * half_turn) / self.radius, self.torque)

    def reset(self) -> None:
        self.command.clear()
        self._drive()

    def shutdown(self) -> None:
        self.topics.close()


class MultiWheelDrive(_Sides):
    """``<leftJoints>`` and ``<rightJoints>`` name the wheels, with blanks between; true odometry."""

    def load(self, server, model, sdf) -> None:
        self.topics = Topics(sdf, model.name, "C")
        left, right = ([joint_named(model, name, tag) for name in required(sdf, tag).split()] for tag in ("leftJoints", "rightJoints"))
        self.gate = PeriodAdded(sdf.get("updateRate", 100.0))
        self.sends_tf, self.sends_message = sdf.get("publishOdometryTf", True), sdf.get("publishOdometryMsg", True)
        self._start(server, model, sdf, left, right, sdf.get("torque", 5.0), sdf.text_or("commandTopic", "cmd_vel"))
        self.odometry = OdometryPublisher(self.topics, sdf, "base_footprint")

    def step(self) -> None:
        now = self.server.now()
        if self.gate.due(now.to_nsec()):
            self._publish(now)
            self._drive()

    def _publish(self, now: rospy.Time) -> None:
        pose, velocity = ground_truth(self.model)
        if self.sends_tf:
            self.odometry.send_tf(now, pose)
        if self.sends_message:
            self.odometry.publish(now, pose, velocity, flat=True)


class SixWheelDrive(_Sides):
    """Six joints, each by its tag. The topic odom is there and stays silent, as in the original."""

    def load(self, server, model, sdf) -> None:
        self.topics = Topics(sdf, model.name, "C")
        left, right = ([self._joint(model, sdf, f"{place}{side}Joint") for place in ("front", "mid", "rear")] for side in ("Left", "Right"))
        self._start(server, model, sdf, left, right, sdf.get("torque", 10.0), sdf.text_or("topicName", "cmd_vel"))
        self.topics.publisher("odom", Odometry)

    @staticmethod
    def _joint(model, sdf, tag: str) -> Any:
        required(sdf, tag)
        return find_joint(model, sdf, tag, "")

    def step(self) -> None:
        self._drive()
