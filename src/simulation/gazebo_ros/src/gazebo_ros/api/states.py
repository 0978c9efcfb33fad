"""~link_states and ~model_states: one message per step while somebody listens."""

from __future__ import annotations

import struct
from collections.abc import Iterable
from typing import Any

import rospy
from gazebo_msgs.msg import LinkStates, ModelStates

from gazebo_ros.api.geometry import entity_twist
from gazebo_ros.server import Server, WallLimit


class _Serialized:
    """Writes itself as names, poses and twists without a message object per entry: at 1 kHz that is what counts."""

    def set(self, entries: Iterable[tuple[bytes, Any]]) -> None:
        """:param entries: (name, model or link handle)"""
        names: list[bytes] = []
        poses: list[float] = []
        twists: list[float] = []
        for name, entity in entries:
            names.append(struct.pack("<I", len(name)) + name)
            pose = entity.pose
            poses += (*pose.p, *pose.q)
            linear, angular = entity_twist(entity)
            twists += (*linear, *angular)
        count = struct.pack("<I", len(names))
        self._data = b"".join(
            (count, *names, count, struct.pack(f"<{len(poses)}d", *poses), count, struct.pack(f"<{len(twists)}d", *twists))
        )

    def serialize(self, buffer) -> None:
        buffer.write(self._data)


class _SerializedLinkStates(_Serialized, LinkStates):
    pass


class _SerializedModelStates(_Serialized, ModelStates):
    pass


class StatePublishers:
    """Pose and twist of everything, world frame, in load order."""

    def __init__(self, server: Server):
        self._server = server
        self._limit = WallLimit(server)
        self._links = rospy.Publisher("~link_states", LinkStates, queue_size=10)
        self._models = rospy.Publisher("~model_states", ModelStates, queue_size=10)
        self._link_message = _SerializedLinkStates()
        self._model_message = _SerializedModelStates()
        server.after_step(self._on_step)
        server.stepped.connect(self._publish)

    def _on_step(self) -> None:
        if (self._links.impl.connections or self._models.impl.connections) and self._limit.due():
            self._publish()

    def _publish(self) -> None:
        models = self._server.world.models.values()
        if self._models.get_num_connections():
            self._model_message.set((model.name.encode(), model) for model in models)
            self._models.publish(self._model_message)
        if self._links.get_num_connections():
            self._link_message.set((link.scoped_name.encode(), link) for model in models for link in model.links.values())
            self._links.publish(self._link_message)
