"""libgazebo_ros_diff_drive.so: two driven wheels, odometry, wheel transforms."""

from __future__ import annotations

import rospy
from gazebo_ros.plugin import ModelPlugin
from node_signals.rates import PeriodAdded
from ode_sim import math3
from sensor_msgs.msg import JointState

from gazebo_plugins.drives.wheels import Command, EncoderOdometry, OdometryPublisher, from_encoders, ground_truth
from gazebo_plugins.ros_side import TfBroadcaster, Topics, find_joint, length

_AT_TARGET = 0.01  # m/s: a wheel this close to its target is no longer ramped


class DiffDrive(ModelPlugin):
    """Drives left and right wheel from ``cmd_vel``; the last command holds for ever."""

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        self.topics = Topics(sdf, model.name, "A")
        self.left = find_joint(model, sdf, "leftJoint", "left_joint")
        self.right = find_joint(model, sdf, "rightJoint", "right_joint")
        self.separation = length(sdf, "wheelSeparation", 0.34)
        self.radius = length(sdf, "wheelDiameter", 0.15) / 2
        self.torque = sdf.get("wheelTorque", 5.0)
        self.acceleration = sdf.get("wheelAcceleration", 0.0)
        self.encoders = EncoderOdometry(self.left, self.right, self.radius, self.separation) if from_encoders(sdf) else None
        self.publish_odometry_tf = sdf.get("publishOdomTF", True)
        self.publish_wheel_tf = sdf.get("publishWheelTF", False)
        self.gate = PeriodAdded(sdf.get("updateRate", 100.0))
        self.command = Command(self.topics, sdf.text_or("commandTopic", "cmd_vel"))
        self.odometry = OdometryPublisher(self.topics, sdf, "base_footprint") if sdf.get("publishTf", True) else None
        self.joint_states = self.topics.publisher("joint_states", JointState, 1000) if sdf.get("publishWheelJointState", False) else None
        self.ramped = [0.0, 0.0]  # rim speeds as the ramp left them, m/s: left, right
        self.rim_speeds = [0.0, 0.0]  # commanded last
        self._drive()
        server.drives(self.left, self.right)
        server.before_step(self.step)

    def step(self) -> None:
        if self.encoders:
            self.encoders.integrate(self.server.world.dt)
        if self.gate.due(self.server.now().to_nsec()):
            self._publish(self.server.now())
            self._ramp(self.gate.elapsed)
            self._drive()

    def _ramp(self, elapsed: float) -> None:
        """Rim speeds follow the command, limited by wheelAcceleration. As upstream has it both wheels jump to their targets once
        either turns nearly as fast as it should, and the next ramp begins where this one ended, not at the speeds jumped to."""
        half_turn = self.command.yaw_rate * self.separation / 2
        targets = [self.command.x - half_turn, self.command.x + half_turn]
        missing = [target - joint.velocity() * self.radius for target, joint in zip(targets, (self.left, self.right))]
        if self.acceleration == 0.0 or any(abs(speed) < _AT_TARGET for speed in missing):
            self.rim_speeds = targets
            return
        change = self.acceleration * elapsed
        for i, target in enumerate(targets):
            now = self.ramped[i]
            wanted = now + max(-change, min(change, missing[i]))
            # never beyond the target: upstream's ramp of a wheel that is held grows without end
            self.ramped[i] = max(min(now, target), min(max(now, target), wanted))
        self.rim_speeds = list(self.ramped)

    def _drive(self) -> None:
        for joint, speed in zip((self.left, self.right), self.rim_speeds):
            joint.set_motor(speed / self.radius, self.torque)

    def _publish(self, now: rospy.Time) -> None:
        if self.odometry:
            pose, velocity = (self.encoders.pose, self.encoders.velocity) if self.encoders else ground_truth(self.model)
            self.odometry.publish(now, pose, velocity)
            if self.publish_odometry_tf:
                self.odometry.send_tf(now, pose)
        if self.publish_wheel_tf:
            for joint in (self.left, self.right):
                TfBroadcaster.send(
                    now,
                    self.topics.frame(joint.parent.name),
                    self.topics.frame(joint.child.name),
                    math3.relative(self.model.pose, joint.child.pose),
                )
        if self.joint_states:
            self.joint_states.publish(wheel_states(now, [self.right, self.left]))

    def reset(self) -> None:
        self.command.clear()
        self.ramped, self.rim_speeds = [0.0, 0.0], [0.0, 0.0]
        if self.encoders:
            self.encoders.reset()
        self._drive()

    def shutdown(self) -> None:
        self.topics.close()


def wheel_states(now: rospy.Time, joints: list) -> JointState:
    """The positions of ``joints`` (rad), stamped ``now``: no more than these, as this plugin family publishes them."""
    message = JointState()
    message.header.stamp = now
    message.name = [joint.name for joint in joints]
    message.position = [joint.position() for joint in joints]
    return message
