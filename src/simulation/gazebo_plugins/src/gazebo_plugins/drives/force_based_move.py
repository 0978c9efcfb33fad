"""libhector_gazebo_ros_force_based_move.so and the copies of it that omnidirectional robots bring: forces push the base to the
commanded velocity, wheels are there for the looks."""

from __future__ import annotations

import math

import rospy
from gazebo_ros.plugin import ModelPlugin, PluginError
from node_signals.rates import PeriodAdded
from ode_sim import math3
from ode_sim.math3 import Pose

from gazebo_plugins.drives.wheels import Command, OdometryPublisher, ground_truth, yaw_of
from gazebo_plugins.ros_side import Topics

_POSE_VARIANCES = 0.001, 0.001, 1e12, 1e12, 1e12, 100.0
_TWIST_VARIANCES = 0.001, 0.001, 0.001, 1e12, 1e12, 100.0
_STRAIGHT, _SURE, _UNSURE = 1e-4, 0.01, 100.0  # rad/s that are no turn; variance of the yaw without a turn and in one


class ForceBasedMove(ModelPlugin):
    """As hector_gazebo_plugins has it: pushes for ever what it was told last.

    Each step a force of ``x_velocity_p_gain`` (N s/m) times what is missing of the speed, in the base's axes, and a torque of
    ``yaw_velocity_p_gain`` (N m s) times what is missing of the turn rate, at ``<robotBaseFrame>``; never more than brings the
    whole model to that velocity within the step. Odometry adds up the true velocity from where the robot was spawned.
    """

    gain, turn_gain = 10000.0, 100.0
    timeout, holds_after_timeout = math.inf, True
    fastest, fastest_turn = math.inf, math.inf

    last_time: rospy.Time
    place: Pose  #: where the odometry has the base

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        self.topics = Topics(sdf, model.name, "C")
        self.gate = PeriodAdded(sdf.get("odometryRate", 20.0))
        self.link = self._base(sdf.text_or("robotBaseFrame", "base_footprint"))
        self.gains = (
            sdf.get("x_velocity_p_gain", self.gain),
            sdf.get("y_velocity_p_gain", self.gain),
            sdf.get("yaw_velocity_p_gain", self.turn_gain),
        )
        self.limits = (
            sdf.get("max_x_velocity", self.fastest),
            sdf.get("max_y_velocity", self.fastest),
            sdf.get("max_yaw_velocity", self.fastest_turn),
        )
        self.time_limit = sdf.get("cmdVelTimeOut", sdf.get("commandWatchdog", self.timeout))
        self.sends_tf = sdf.get("publishOdometryTf", True)
        self.command = Command(self.topics, sdf.text_or("commandTopic", "cmd_vel"))
        self.odometry = OdometryPublisher(self.topics, sdf, "base_footprint", _POSE_VARIANCES, _TWIST_VARIANCES)
        self.most = self._inertias()
        self.reset()
        server.before_step(self.step)

    def _base(self, name: str):
        """The link pushed; the model's first one where a fixed joint has merged the named one into it."""
        if not self.model.links:
            raise PluginError(f"model {self.model.name} has no link to push")
        return self.model.links.get(name) or next(iter(self.model.links.values()))

    def _inertias(self) -> tuple[float, float, float]:
        """Of the whole model: mass twice, kg, and moment about the vertical axis of the base, kg m^2."""
        links = self.model.links.values()
        centre = self.link.com()
        about = sum(max(link.inertia[:3]) + link.mass * math.hypot(*math3.sub(link.com(), centre)[:2]) ** 2 for link in links)
        mass = sum(link.mass for link in links)
        return mass, mass, about

    def step(self) -> None:
        now = self.server.now()
        pose, velocity = ground_truth(self.model)
        if (now - self.command.received).to_sec() <= self.time_limit:
            self._push(pose, velocity)
        elif self.holds_after_timeout:
            self.command.clear()
            self._push(pose, velocity)
        elapsed = (now - self.last_time).to_sec()
        self.last_time = now
        self._travel(velocity, elapsed)
        if self.gate.due(now.to_nsec()):
            self.odometry.set_yaw_variance(_SURE if abs(velocity[2]) < _STRAIGHT else _UNSURE)
            self.odometry.publish(now, self.place, velocity)
            if self.sends_tf:
                self.odometry.send_tf(now, self.place)

    def _push(self, pose, velocity) -> None:
        wanted = (self.command.x, self.command.y, self.command.yaw_rate)
        dt = self.server.world.dt
        ahead, left, turn = (
            min(gain, most / dt) * (max(-limit, min(limit, aim)) - actual)
            for gain, most, limit, aim, actual in zip(self.gains, self.most, self.limits, wanted, velocity)
        )
        yaw = yaw_of(pose)
        cos, sin = math.cos(yaw), math.sin(yaw)
        self.link.add_force((cos * ahead - sin * left, sin * ahead + cos * left, 0.0))
        self.link.add_torque((0.0, 0.0, turn))

    def _travel(self, velocity, elapsed: float) -> None:
        yaw = yaw_of(self.place) + velocity[2] * elapsed / 2
        cos, sin = math.cos(yaw), math.sin(yaw)
        x, y, _ = self.place.p
        self.place = Pose(
            (x + (cos * velocity[0] - sin * velocity[1]) * elapsed, y + (sin * velocity[0] + cos * velocity[1]) * elapsed, 0.0),
            math3.quat_from_rpy(0.0, 0.0, yaw + velocity[2] * elapsed / 2),
        )

    def reset(self) -> None:
        self.command.clear()
        self.place, self.last_time = Pose(), self.server.now()

    def shutdown(self) -> None:
        self.topics.close()


class NexusMove(ForceBasedMove):
    """nexus_4wd_mecanum_gazebo's copy: weaker, with limits, and stops 0.25 s after the last command."""

    gain, turn_gain = 15.0, 1.0
    timeout = 0.25
    fastest, fastest_turn = 0.6, 0.5


class RidgebackMove(ForceBasedMove):
    """ridgeback_gazebo_plugins' copy stops 0.25 s after the last command."""

    timeout = 0.25


class RobotnikMove(ForceBasedMove):
    """robotnik_gazebo_plugins' copy lets the robot roll 2 s after the last command."""

    timeout, holds_after_timeout = 2.0, False
