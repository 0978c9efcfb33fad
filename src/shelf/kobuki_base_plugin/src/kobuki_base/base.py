"""libgazebo_ros_kobuki.so: the Kobuki base with its drive, odometry by gyro, and the events of its sensors."""

from __future__ import annotations

import math
from types import ModuleType
from typing import Any

import rospy
from gazebo_plugins.drives.wheels import Command
from gazebo_plugins.ros_side import TfBroadcaster, Topics, diagonal, find_joint, pose_msg
from gazebo_plugins.sensors.imu import Differentiator
from gazebo_ros.plugin import ModelPlugin, PluginError
from geometry_msgs.msg import Quaternion, Vector3
from nav_msgs.msg import Odometry
from node_signals.rates import PeriodAdded
from ode_sim import math3
from ode_sim.description.model import Pose
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Empty

from .senses import SIDES, Bumper, Cliffs, OnFloor, named_sensor, reading

_RATE = 50.0  # Hz, of the real base
_UNKNOWN = 1e6  # variance of what is not measured
_NUMBERS = ("wheel_separation", "wheel_diameter", "torque", "velocity_command_timeout", "cliff_detection_threshold")


def _required(sdf, tag: str):
    if not sdf.has(tag):
        raise PluginError(f"<{tag}> is missing")
    return sdf.get(tag, "")


class Kobuki(ModelPlugin):
    """Drives on ``commands/velocity`` and publishes what the base's driver node does, under the base's prefix."""

    def load(self, server, model, sdf) -> None:
        self.server, self.model, self.world = server, model, server.world
        self.wheels = [find_joint(model, sdf, f"{side}_wheel_joint_name", "") for side in ("left", "right")]
        for tag in _NUMBERS:
            _required(sdf, tag)
        self.separation, self.radius = sdf.get("wheel_separation", 0.0), sdf.get("wheel_diameter", 0.0) / 2
        if not (self.separation > 0 and self.radius > 0):
            raise PluginError("<wheel_separation> and <wheel_diameter> must be lengths in m, above 0")
        self.torque, self.timeout = sdf.get("torque", 0.0), sdf.get("velocity_command_timeout", 0.6)
        self.gyro_link, gyro = named_sensor(model, _required(sdf, "imu_name"), ("imu",))
        self.X_LG, self.acceleration = gyro.pose, Differentiator(self.gyro_link, gyro.pose.p)
        self.bumper = Bumper(self.world, model, [wheel.child for wheel in self.wheels])
        self.cliffs = Cliffs(
            self.world,
            model,
            {side: _required(sdf, f"cliff_sensor_{side}_name") for side in SIDES},
            sdf.get("cliff_detection_threshold", 0.04),
        )
        self.on_floor = {side: OnFloor(self.world, wheel.child) for side, wheel in zip(("left", "right"), self.wheels)}
        self.publish_tf = sdf.get("publish_tf", False)
        self.gate = PeriodAdded(sdf.get("update_rate", _RATE) or _RATE)
        self._connect(sdf)
        self.reset()
        server.drives(*self.wheels)
        server.before_step(self.drive)
        server.after_step(self.step)

    def _connect(self, sdf) -> None:
        self.topics = topics = Topics(sdf, self.model.name, "A")
        base = rospy.get_param(topics.resolve("base_prefix"), "mobile_base")
        self.joint_states = topics.publisher("joint_states", JointState)
        self.odometry = topics.publisher("odom", Odometry)
        self.imu = topics.publisher(f"{base}/sensors/imu_data", Imu)
        self.command = Command(topics, f"{base}/commands/velocity")
        self.motors_on = True
        topics.subscriber(f"{base}/commands/reset_odometry", Empty, lambda _: setattr(self, "odometry_reset", True))
        self.kobuki: ModuleType | None = None
        try:
            from kobuki_msgs import msg as kobuki
        except ImportError:
            rospy.logwarn(
                "the Kobuki base of model %s drives, but tells no bumps and cliffs: their messages are in "
                "kobuki_msgs, which is not here (github.com/yujinrobot/kobuki_msgs)",
                self.model.name,
            )
            return
        self.kobuki = kobuki
        topics.subscriber(
            f"{base}/commands/motor_power",
            kobuki.MotorPower,
            lambda message: setattr(self, "motors_on", message.state == kobuki.MotorPower.ON),
        )
        self.bumps = topics.publisher(f"{base}/events/bumper", kobuki.BumperEvent, 10)
        self.edges = topics.publisher(f"{base}/events/cliff", kobuki.CliffEvent, 10)
        self.drops = topics.publisher(f"{base}/events/wheel_drop", kobuki.WheelDropEvent, 10)
        self.core = topics.publisher(f"{base}/sensors/core", kobuki.SensorState)

    def reset(self) -> None:
        self.command.clear()
        self.odometry_reset = True
        self.was_pressed: set[str] = set()
        self.was_cliff: set[str] = set()
        self.was_dropped: set[str] = set()

    def drive(self) -> None:
        late = (self.server.now() - self.command.received).to_sec() > self.timeout
        forward, turn = (0.0, 0.0) if late or not self.motors_on else (self.command.x, self.command.yaw_rate)
        for wheel, side in zip(self.wheels, (-1, 1)):
            wheel.set_motor((forward + side * turn * self.separation / 2) / self.radius, self.torque)

    def step(self) -> None:
        if self.odometry_reset:
            self.odometry_reset, self.place = False, [0.0, 0.0, 0.0]
        q_WG = math3.quat_multiply(self.gyro_link.pose.q, self.X_LG.q)
        q_GW = math3.quat_inverse(q_WG)
        rates = math3.quat_rotate(q_GW, self.gyro_link.angular_velocity())
        speed = self.radius * (self.wheels[0].velocity() + self.wheels[1].velocity()) / 2
        heading = self.place[2] + rates[2] * self.world.dt / 2
        self.place[0] += speed * math.cos(heading) * self.world.dt
        self.place[1] += speed * math.sin(heading) * self.world.dt
        self.place[2] += rates[2] * self.world.dt
        now = self.server.now()
        if not self.gate.due(now.to_nsec()):
            return
        self._publish_joints(now)
        self._publish_odometry(now, speed, rates[2])
        pull = [a - g for a, g in zip(self.acceleration(now.to_nsec()), self.world.gravity)]
        self._publish_imu(now, q_WG, rates, math3.quat_rotate(q_GW, tuple(pull)))
        if self.kobuki is not None:
            self._publish_events(self.kobuki.SensorState(), now)

    def _publish_joints(self, now: rospy.Time) -> None:
        message = JointState(effort=[0.0, 0.0])
        message.name = [wheel.name for wheel in self.wheels]
        message.position = [wheel.position() for wheel in self.wheels]
        message.velocity = [wheel.velocity() for wheel in self.wheels]
        message.header.stamp, message.header.frame_id = now, self.topics.frame("base_link")
        self.joint_states.publish(message)

    def _publish_odometry(self, now: rospy.Time, speed: float, turn: float) -> None:
        message = Odometry()
        message.header.stamp, message.header.frame_id = now, self.topics.frame("odom")
        message.child_frame_id = self.topics.frame("base_footprint")
        pose = Pose((self.place[0], self.place[1], 0.0), math3.quat_from_rpy(0.0, 0.0, self.place[2]))
        message.pose.pose = pose_msg(pose)
        message.pose.covariance = diagonal((0.1, 0.1, _UNKNOWN, _UNKNOWN, _UNKNOWN, 0.05))
        message.twist.twist.linear.x, message.twist.twist.angular.z = speed, turn
        self.odometry.publish(message)
        if self.publish_tf:
            TfBroadcaster.send(now, message.header.frame_id, message.child_frame_id, pose)

    def _publish_imu(self, now: rospy.Time, q_WG, rates, acceleration) -> None:
        message = Imu(orientation=Quaternion(*q_WG), angular_velocity=Vector3(*rates), linear_acceleration=Vector3(*acceleration))
        message.header.stamp, message.header.frame_id = now, self.topics.frame("base_link")
        message.orientation_covariance = message.angular_velocity_covariance = diagonal((_UNKNOWN, _UNKNOWN, 0.05))
        self.imu.publish(message)

    def _publish_events(self, state: Any, now: rospy.Time) -> None:
        """:param state: a kobuki_msgs/SensorState to fill in"""
        pressed, distances = self.bumper.pressed(), self.cliffs.distances()
        cliff = {side for side, distance in distances.items() if self.cliffs.is_cliff(distance)}
        dropped = {side for side, touches in self.on_floor.items() if not touches()}
        for number, side in enumerate(SIDES):
            if (side in pressed) != (side in self.was_pressed):
                self.bumps.publish(bumper=number, state=int(side in pressed))
            if (side in cliff) != (side in self.was_cliff):
                self.edges.publish(sensor=number, state=int(side in cliff), bottom=reading(distances[side]))
            if (side in dropped) != (side in self.was_dropped):
                self.drops.publish(wheel=int(side == "right"), state=int(side in dropped))
            bit = 4 >> number
            state.bumper |= bit * (side in pressed)
            state.cliff |= bit * (side in cliff)
        state.wheel_drop = 2 * ("left" in dropped) + ("right" in dropped)
        self.was_pressed, self.was_cliff, self.was_dropped = pressed, cliff, dropped
        state.header.stamp, state.header.frame_id = now, self.topics.frame("base_link")
        self.core.publish(state)

    def shutdown(self) -> None:
        self.topics.close()
