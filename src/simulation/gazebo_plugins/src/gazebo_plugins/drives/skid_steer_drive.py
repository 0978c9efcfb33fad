"""libgazebo_ros_skid_steer_drive.so: four wheels, the two of a side turning alike."""

from __future__ import annotations

from gazebo_ros.plugin import ModelPlugin
from node_signals.rates import PeriodAdded

from gazebo_plugins.drives.wheels import UNKNOWN, Command, OdometryPublisher, ground_truth
from gazebo_plugins.ros_side import Topics, find_joint, length

_WHEELS = (
    ("leftFrontJoint", "left_front_joint", -1),
    ("rightFrontJoint", "right_front_joint", 1),
    ("leftRearJoint", "left_rear_joint", -1),
    ("rightRearJoint", "right_rear_joint", 1),
)


class SkidSteerDrive(ModelPlugin):
    def load(self, server, model, sdf) -> None:
        self.server, self.model = server, model
        self.topics = Topics(sdf, model.name, "C")
        self.wheels = [(find_joint(model, sdf, tag, default), side) for tag, default, side in _WHEELS]
        self.separation = sdf.get("wheelSeparation", 0.4)
        self.radius = length(sdf, "wheelDiameter", 0.15) / 2
        self.torque = sdf.get("torque", 5.0)
        self.broadcast_tf = sdf.get("broadcastTF", False)
        self.gate = PeriodAdded(sdf.get("updateRate", 100.0))
        covariance = (
            sdf.get("covariance_x", 1e-4),
            sdf.get("covariance_y", 1e-4),
            UNKNOWN,
            UNKNOWN,
            UNKNOWN,
            sdf.get("covariance_yaw", 1e-2),
        )
        self.command = Command(self.topics, sdf.text_or("commandTopic", "cmd_vel"))
        self.odometry = OdometryPublisher(self.topics, sdf, "base_footprint", covariance, covariance)
        self._drive()
        server.drives(*(joint for joint, _ in self.wheels))
        server.before_step(self.step)

    def step(self) -> None:
        now = self.server.now()
        if self.gate.due(now.to_nsec()):
            pose, velocity = ground_truth(self.model)
            self.odometry.publish(now, pose, velocity, flat=True)
            if self.broadcast_tf:
                self.odometry.send_tf(now, pose)
            self._drive()

    def _drive(self) -> None:
        half_turn = self.command.yaw_rate * self.separation / 2
        for joint, side in self.wheels:
            joint.set_motor((self.command.x + side * half_turn) / self.radius, self.torque)

    def reset(self) -> None:
        self.command.clear()
        self._drive()

    def shutdown(self) -> None:
        self.topics.close()
