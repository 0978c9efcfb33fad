"""The objects of move_group's planning scene, under the names of the compiled module."""

from __future__ import annotations

from collections.abc import Iterable

from moveit_commander import planning_scene_interface
from moveit_commander.conversions import msg_from_string, msg_to_string
from moveit_msgs.msg import PlanningScene


class PlanningSceneInterface:
    """What stands around the robot; messages are serialised."""

    def __init__(self, ns: str = ""):
        self._scene = planning_scene_interface.PlanningSceneInterface(ns)

    def get_known_object_names(self, with_type: bool = False) -> list[str]:
        return self._scene.get_known_object_names(with_type)

    def get_known_object_names_in_roi(
        self, minx: float, miny: float, minz: float, maxx: float, maxy: float, maxz: float, with_type: bool = False
    ) -> list[str]:
        return self._scene.get_known_object_names_in_roi(minx, miny, minz, maxx, maxy, maxz, with_type)

    def get_object_poses(self, object_ids: Iterable[str]) -> dict[str, bytes]:
        return _serialised(self._scene.get_object_poses(list(object_ids)))

    def get_objects(self, object_ids: Iterable[str] = ()) -> dict[str, bytes]:
        return _serialised(self._scene.get_objects(list(object_ids)))

    def get_attached_objects(self, object_ids: Iterable[str] = ()) -> dict[str, bytes]:
        return _serialised(self._scene.get_attached_objects(list(object_ids)))

    def get_planning_scene(self, components: int) -> bytes:
        return msg_to_string(self._scene.get_planning_scene(components))

    def apply_planning_scene(self, scene: bytes) -> bool:
        message = PlanningScene()
        msg_from_string(message, scene)
        return self._scene.apply_planning_scene(message)

    def clear(self) -> bool:
        """Remove all objects, attached ones too."""
        self._scene.clear()
        return True


def _serialised(messages: dict) -> dict[str, bytes]:
    return {name: msg_to_string(message) for name, message in messages.items()}
