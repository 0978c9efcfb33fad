"""libgazebo_ros_bumper.so: gazebo_msgs/ContactsState of a contact sensor, empty ones included."""

from __future__ import annotations

from collections import deque

import numpy as np
import rospy
from gazebo_msgs.msg import ContactsState, ContactState
from gazebo_ros.plugin import PluginError, SensorPlugin
from geometry_msgs.msg import Vector3, Wrench
from ode_sim import CollisionHandle, math3
from ode_sim.description.urdf_extensions import LUMP

from gazebo_plugins.ros_side import Topics, sensor_element, subscribed
from gazebo_plugins.sensors.pair_order import PairOrder

_MOST_STEPS = 100  # a message has the contacts of the last so many steps


def _lumped_as(collision: str, named: str) -> bool:
    """Whether ``named`` is what the conversion from URDF makes of ``CHILD_collision`` in a contact sensor
    (``PARENT_collision_CHILD``), and ``collision`` one of that child in the link it was merged into."""
    _, lumped, own = collision.partition(LUMP)
    child = own.rpartition("_collision")[0]
    return bool(lumped) and named.endswith("_collision_" + child)


class Bumper(SensorPlugin):
    """Positions and normals in the world frame, whatever frameName says; a normal points into the first collision. Wrenches are
    those on the first collision's link, in its axes and about its centre of mass. Which of the two is the first:
    :mod:`gazebo_plugins.sensors.pair_order`; it need not be the sensor's own."""

    def load(self, server, sensor, sdf) -> None:
        self.server, self.sensor, self.world = server, sensor, server.world
        collisions = self._watched()
        self.collisions = {collision.id for collision in collisions}
        for collision in collisions:
            server.world.watch_contacts(collision)
        self.topics = Topics(sdf, sensor.model.name, "C")
        self.frame = self.topics.frame(sdf.text_or("frameName", "world"))
        self.order = PairOrder()
        self.steps: deque[tuple[rospy.Time, list[ContactState]]] = deque(maxlen=_MOST_STEPS)
        self.publisher = self.topics.publisher(sdf.text_or("bumperTopicName", "bumper_states"), ContactsState)
        self.wanted = subscribed(self.publisher)
        server.after_step(self.collect)
        sensor.connect(self.measure, self.wanted)

    def _watched(self) -> list[CollisionHandle]:
        """The collisions that ``<contact>`` names; one that is not there is an ERROR line and feels nothing."""
        contact = sensor_element(self.sensor).child("contact")
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
        self.order.forget()
        pairs: dict[tuple[int, int], list] = {}
        for contact in self.world.contacts():
            pair = int(contact["collision1"]), int(contact["collision2"])
            if not self.collisions.isdisjoint(pair):
                pairs.setdefault(pair, []).append(contact)
        self.steps.append(
            (
                self.server.now(),
                [
                    self._state(self.world.collision(first), self.world.collision(second), contacts)
                    for (first, second), contacts in pairs.items()
                ],
            )
        )

    def _state(self, first: CollisionHandle, second: CollisionHandle, contacts) -> ContactState:
        sign = 1.0
        if not self.order.in_order(first, second):
            first, second, sign = second, first, -1.0
        state = ContactState(collision1_name=first.scoped_name, collision2_name=second.scoped_name)
        q_LW = math3.quat_inverse(first.link.pose.q)
        com = first.link.com()
        total = [(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)]
        for contact in contacts:
            f_W = sign * contact["force"]
            force = math3.quat_rotate(q_LW, tuple(f_W))
            torque = math3.quat_rotate(q_LW, tuple(np.cross(contact["position"] - com, f_W)))
            total = [math3.add(total[0], force), math3.add(total[1], torque)]
            state.wrenches.append(Wrench(Vector3(*force), Vector3(*torque)))
            state.contact_positions.append(Vector3(*contact["position"]))
            state.contact_normals.append(Vector3(*(sign * contact["normal"] + 0.0)))  # + 0.0: no -0.0
            state.depths.append(float(contact["depth"]))
        state.total_wrench = Wrench(Vector3(*total[0]), Vector3(*total[1]))
        return state

    def measure(self, sensor) -> None:
        message = ContactsState()
        message.header.stamp, message.header.frame_id = sensor.measurement_time, self.frame
        told = [(time, state) for time, states in self.steps for state in states]
        self.steps.clear()
        for index, (time, state) in enumerate(told):
            state.info = (
                f"Debug:  i:({index}/{len(told)})     my geom:{state.collision1_name}"
                f"   other geom:{state.collision2_name}         time:{time.secs}.{time.nsecs:09d}\n"
            )
            message.states.append(state)
        self.publisher.publish(message)

    def reset(self) -> None:
        self.steps.clear()  # contacts of a time that is no more

    def shutdown(self) -> None:
        self.topics.close()
