"""libgazebo_ros_tricycle_drive.so: one steered and driven wheel, two wheels with encoders."""

from __future__ import annotations

import math

import rospy
from gazebo_ros.plugin import ModelPlugin
from node_signals.rates import PeriodAdded
from ode_sim import math3
from sensor_msgs.msg import JointState

from gazebo_plugins.drives.wheels import Command, EncoderOdometry, OdometryPublisher, from_encoders, ground_truth
from gazebo_plugins.ros_side import TfBroadcaster, Topics, find_joint, length

_FASTEST, _HOLDING = 20.0, 10.0  # steering without <steeringSpeed>: rad/s, and its torque in units of <wheelTorque>


class TricycleDrive(ModelPlugin):
    """``linear.x`` is the rim speed of the driven wheel, ``angular.z`` the **steering angle** (rad, within +-pi/2)."""

    rate: float  #: rad/s, of the driven wheel

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        self.topics = Topics(sdf, model.name, "A")
        self.steering = find_joint(model, sdf, "steeringJoint", "front_steering_joint")
        self.driven = find_joint(model, sdf, "actuatedWheelJoint", "front_wheel_joint")
        self.left = find_joint(model, sdf, "encoderWheelLeftJoint", "left_wheel_joint")
        self.right = find_joint(model, sdf, "encoderWheelRightJoint", "right_wheel_joint")
        self.driven_radius = length(sdf, "actuatedWheelDiameter", 0.15) / 2
        self.encoder_radius = length(sdf, "encoderWheelDiameter", 0.15) / 2
        self.encoder_separation = length(sdf, "encoderWheelSeparation", 0.5)
        self.torque = sdf.get("wheelTorque", 5.0)
        self.acceleration = sdf.get("wheelAcceleration", 0.0)
        self.deceleration = sdf.get("wheelDeceleration", self.acceleration)
        self.speed_tolerance = sdf.get("wheelSpeedTolerance", 0.01)
        self.steering_speed = sdf.get("steeringSpeed", 0.0)
        self.angle_tolerance = sdf.get("steeringAngleTolerance", 0.01)
        self.encoders = EncoderOdometry(self.left, self.right, self.encoder_radius, self.encoder_separation) if from_encoders(sdf) else None
        self.publish_wheel_tf = sdf.get("publishWheelTF", False)
        self.gate = PeriodAdded(sdf.get("updateRate", 100.0))
        self.command = Command(self.topics, sdf.text_or("commandTopic", "cmd_vel"))
        self.odometry = OdometryPublisher(self.topics, sdf, "base_link")
        self.joint_states = self.topics.publisher("joint_states", JointState, 1000) if sdf.get("publishWheelJointState", False) else None
        self.reset()
        server.drives(self.steering, self.driven)
        server.before_step(self.step)

    def step(self) -> None:
        now = self.server.now()
        if self.encoders:
            self.encoders.integrate(self.server.world.dt)
        self._steer()
        if self.gate.due(now.to_nsec()):
            self._publish(now)
            self._drive(self.gate.elapsed)

    def _drive(self, elapsed: float) -> None:
        """The driven wheel follows the command; accelerations and the tolerance are those of its rate, in rad."""
        target = self.command.x / self.driven_radius
        error = target - self.rate
        if abs(error) <= self.speed_tolerance or self.acceleration == 0.0:
            self.rate = target
        else:
            limit = self.acceleration if abs(target) > abs(self.rate) else self.deceleration
            self.rate += max(-limit * elapsed, min(limit * elapsed, error))
        self.driven.set_motor(self.rate, self.torque)

    def _steer(self) -> None:
        """A motor, not a position command: what the driven wheel pushes with must reach the frame."""
        angle = max(-math.pi / 2, min(math.pi / 2, self.command.yaw_rate))
        error = angle - self.steering.position()
        if self.steering_speed <= 0.0:
            rate = max(-_FASTEST, min(_FASTEST, error / (5 * self.server.world.dt)))
            self.steering.set_motor(rate, _HOLDING * self.torque)
        else:
            rate = 0.0 if abs(error) < self.angle_tolerance else math.copysign(self.steering_speed, error)
            self.steering.set_motor(rate, self.torque)

    def _publish(self, now: rospy.Time) -> None:
        pose, velocity = (self.encoders.pose, self.encoders.velocity) if self.encoders else ground_truth(self.model)
        self.odometry.publish(now, pose, velocity)
        self.odometry.send_tf(now, pose)
        joints = (self.steering, self.driven, self.left, self.right)
        if self.publish_wheel_tf:
            for joint in joints:
                TfBroadcaster.send(
                    now,
                    self.topics.frame(joint.parent.name),
                    self.topics.frame(joint.name),
                    math3.relative(joint.parent.pose, joint.child.pose),
                )
        if self.joint_states:
            message = JointState()
            message.header.stamp = now
            message.name = [joint.name for joint in joints]
            message.position = [joint.position() for joint in joints]
            message.velocity = [joint.velocity() for joint in joints]
            message.effort = [joint.effort() for joint in joints]
            self.joint_states.publish(message)

    def reset(self) -> None:
        self.command.clear()
        self.rate = 0.0
        if self.encoders:
            self.encoders.reset()
        self._drive(0.0)

    def shutdown(self) -> None:
        self.topics.close()
