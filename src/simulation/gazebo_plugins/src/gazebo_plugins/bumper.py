"""libgazebo_ros_bumper.so: gazebo_msgs/ContactsState of a contact sensor, empty ones included."""
from __future__ import annotations

from typing import Dict, List, Tuple

import rospy
from gazebo_msgs.msg import ContactsState, ContactState
from geometry_msgs.msg import Vector3, Wrench
from gazebo_ros import SdfElement
from gazebo_ros.plugin import PluginError, SensorPlugin
from ode_sim import CollisionHandle, math3
from ode_sim.description.urdf_extensions import LUMP

from gazebo_plugins.ros_side import Topics, subscribed

_MOST_STEPS = 100  # contacts of at most so many steps between two messages


def _lumped_as(collision: str, named: str) -> bool:
    """Whether ``named`` is what the conversion from URDF makes of ``CHILD_collision`` in a contact sensor
    (``PARENT_collision_CHILD``), and ``collision`` one of that child in the link it was merged into."""
    _, lumped, own = collision.partition(LUMP)
    child = own.rpartition("_collision")[0]
    return bool(lumped) and named.endswith("_collision_" + child)


class Bumper(SensorPlugin):
    """Positions and normals in the world frame, whatever frameName says; wrenches act on the first collision's link,
    expressed in its frame."""

    def load(self, server, sensor, sdf) -> None:
        self.server, self.sensor, self.world = server, sensor, server.world
        collisions = self._watched()
        self.collisions = {collision.id for collision in collisions}
        for collision in collisions:
            server.world.watch_contacts(collision)
        self.topics = Topics(sdf, sensor.model.name, "C")
        self.frame = self.topics.frame(sdf.text_or("frameName", "world"))
        self.states: List[ContactState] = []
        self.steps = 0
        self.publisher = self.topics.publisher(sdf.text_or("bumperTopicName", "bumper_states"), ContactsState)
        self.wanted = subscribed(self.publisher)
        server.after_step(self.collect)
        sensor.connect(self.measure, self.wanted)

    def _watched(self) -> List[CollisionHandle]:
        """The collisions that ``<contact>`` names; one that is not there is an ERROR line and feels nothing."""
        contact = SdfElement(self.sensor.description.element).child("contact")
        wanted = [child.text for child in contact.children("collision")] if contact else []
        where, own = f"sensor {self.sensor.scoped_name}: <contact><collision>", self.sensor.link.collisions
        there = f"link {self.sensor.link.scoped_name} has {', '.join(own) or 'no collision'}"
        if not wanted:
            raise PluginError(f"{where} is missing; {there}")
        found = []
        for name in wanted:
            meant = [collision for written, collision in own.items() if written == name or _lumped_as(written, name)]
            if not meant:
                rospy.logerr("%s names '%s', which does not exist; %s", where, name, there)
            found += meant
        return found

    def collect(self) -> None:
        """Contacts of this step: one state per colliding pair."""
        if not self.wanted():
            return
        if self.steps == _MOST_STEPS:
            self.states.clear()
            self.steps = 0
        self.steps += 1
        pairs: Dict[Tuple[int, int], list] = {}
        for contact in self.world.contacts():
            first, second = int(contact["collision1"]), int(contact["collision2"])
            if first in self.collisions or second in self.collisions:
                pairs.setdefault((first, second), []).append(contact)
        for (first, second), contacts in pairs.items():
            self.states.append(self._state(first, second, contacts))

    def _state(self, first: int, second: int, contacts) -> ContactState:
        a, b = self.world.collision(first), self.world.collision(second)
        state = ContactState(collision1_name=a.scoped_name, collision2_name=b.scoped_name)
        q_LW = math3.quat_inverse(a.link.pose.q)
        total = [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]
        for contact in contacts:
            force = math3.quat_rotate(q_LW, tuple(contact["force"]))
            torque = math3.quat_rotate(q_LW, tuple(contact["torque"]))
            total = [math3.add(total[0], force), math3.add(total[1], torque)]
            state.wrenches.append(Wrench(Vector3(*force), Vector3(*torque)))
            state.contact_positions.append(Vector3(*contact["position"]))
            state.contact_normals.append(Vector3(*contact["normal"]))
            state.depths.append(float(contact["depth"]))
        state.total_wrench = Wrench(Vector3(*total[0]), Vector3(*total[1]))
        now = self.server.now()
        state.info = (f"Debug:  i:(0/{len(contacts)})     my geom:{a.scoped_name}   other geom:{b.scoped_name}"
                      f"         time:{now.to_sec():.9g}\n")
        return state

    def measure(self, sensor) -> None:
        message = ContactsState()
        message.header.stamp, message.header.frame_id = sensor.measurement_time, self.frame
        message.states, self.states, self.steps = self.states, [], 0
        self.publisher.publish(message)

    def reset(self) -> None:
        self.states, self.steps = [], 0  # contacts of a time that is no more

    def shutdown(self) -> None:
        self.topics.close()
