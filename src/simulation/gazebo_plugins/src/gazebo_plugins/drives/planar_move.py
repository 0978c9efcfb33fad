"""libgazebo_ros_planar_move.so: the whole model glides over the plane as commanded, without wheels."""

from __future__ import annotations

import math

from gazebo_ros.plugin import ModelPlugin
from node_signals.rates import PeriodAdded
from ode_sim import math3

from gazebo_plugins.drives.wheels import Command, OdometryPublisher, yaw_of
from gazebo_plugins.ros_side import Topics


class PlanarMove(ModelPlugin):
    """Sets the velocity of the model in every step; vertical motion is suppressed, gravity included."""

    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        self.topics = Topics(sdf, model.name, "C")
        rate = sdf.get("odometryRate", 20.0)
        self.gate = PeriodAdded(rate) if rate > 0.0 else None  # neither odometry nor a transform
        self.timeout = sdf.get("cmdTimeout", -1.0)
        self.command = Command(self.topics, sdf.text_or("commandTopic", "cmd_vel"))
        self.odometry = OdometryPublisher(self.topics, sdf, "base_footprint")
        self.last_pose, self.last_time = model.pose, server.now()
        server.before_step(self.step)

    def step(self) -> None:
        now = self.server.now()
        if self.timeout >= 0.0 and (now - self.command.received).to_sec() > self.timeout:
            self.command.clear()
        pose = self.model.pose
        yaw = yaw_of(pose)
        cos, sin = math.cos(yaw), math.sin(yaw)
        x, y = self.command.x, self.command.y
        self._glide((cos * x - sin * y, sin * x + cos * y, 0.0), (0.0, 0.0, self.command.yaw_rate), pose.p)
        if self.gate and self.gate.due(now.to_nsec()):
            elapsed = (now - self.last_time).to_sec()
            dx, dy = ((pose.p[i] - self.last_pose.p[i]) / elapsed for i in range(2))
            turned = math.remainder(yaw - yaw_of(self.last_pose), 2 * math.pi) / elapsed
            self.last_pose, self.last_time = pose, now
            self.odometry.publish(now, pose, (cos * dx + sin * dy, cos * dy - sin * dx, turned), flat=True)
            self.odometry.send_tf(now, pose)

    def _glide(self, linear, angular, origin) -> None:
        """The model moves as one body about its origin, and its wheels turn on: stopped with it in every step, as upstream does,
        motors that start them anew lift the robot at one end. What no longer sinks is freed of its weight: friction with the
        floor would take from the commanded speed."""
        world = self.server.world
        for link in self.model.links.values():
            if abs(link.com_velocity()[2]) < 0.5 * abs(world.gravity[2]) * world.dt and link.gravity:
                link.add_force(math3.scale(world.gravity, -link.mass))
        self.model.move_as_one(linear, angular, origin)

    def reset(self) -> None:
        self.command.clear()
        self.last_pose, self.last_time = self.model.pose, self.server.now()

    def shutdown(self) -> None:
        self.topics.close()
