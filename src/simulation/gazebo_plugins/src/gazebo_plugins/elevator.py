"""libgazebo_ros_elevator.so: a cabin that goes to the floor whose number is sent, and doors that open there."""

from __future__ import annotations

import rospy
from gazebo_ros.plugin import ModelPlugin
from std_msgs.msg import String

from gazebo_plugins.ros_side import Topics, find_joint, required

_SPEED = 1.0  # m/s of the cabin, unless <lift_speed> says otherwise
_DOOR = 1.0  # m that the door slides, m/s that it does so with


class Elevator(ModelPlugin):
    """Closes the door, moves ``<lift_joint>`` to floor times ``<floor_height>``, opens ``<door_joint>`` for
    ``<door_wait_time>`` seconds of sim time, and closes it; until then no other floor is heard. Topic ``elevator`` (std_msgs/String)
    unless ``<topic>`` names another."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        for tag in ("lift_joint", "door_joint"):
            required(sdf, tag)
        self.lift, self.door = (find_joint(model, sdf, tag, "") for tag in ("lift_joint", "door_joint"))
        self.height, self.wait = sdf.get("floor_height", 3.0), sdf.get("door_wait_time", 5.0)
        self.speed = sdf.get("lift_speed", _SPEED)
        self.topics = Topics(sdf, model.name, "C")
        self.topic = sdf.text_or("topic", "elevator")
        self.topics.subscriber(self.topic, String, self._receive, 10)
        self.reset()
        server.drives(self.lift, self.door)
        server.before_step(self.step)

    def reset(self) -> None:
        self.floor, self.open_until_ns, self.busy = 0, 0, False

    def _receive(self, message: String) -> None:
        try:
            floor = int(message.data)
        except ValueError:
            rospy.logwarn("%s: '%s' is no floor number", self.topics.resolve(self.topic), message.data)
            return
        if not self.busy:
            self.floor, self.open_until_ns, self.busy = floor, -1, True  # opens as soon as it is there

    def step(self) -> None:
        dt, target = self.server.world.dt, self.floor * self.height
        there = abs(self.lift.position() - target) < 1e-3
        if there and self.open_until_ns < 0:
            self.open_until_ns = self.server.world.time_ns + round(self.wait * 1e9)
        is_open = there and self.server.world.time_ns < self.open_until_ns
        if there and self.open_until_ns >= 0 and not is_open and self.door.position() < 0.01:
            self.busy = False
        self._approach(self.door, _DOOR if is_open else 0.0, _DOOR * dt)
        if self.door.position() < 0.01 or there:
            self._approach(self.lift, target, self.speed * dt)

    @staticmethod
    def _approach(joint, target: float, most: float) -> None:
        position = joint.position()
        joint.drive_to(position + max(-most, min(most, target - position)))

    def shutdown(self) -> None:
        self.topics.close()
