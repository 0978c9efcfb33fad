"""A robot as markers, for RViz's MarkerArray display."""

from __future__ import annotations

from collections.abc import Sequence

import lenient_xml
import motion
from geometry_msgs.msg import Vector3
from moveit_core import convert, states
from moveit_msgs.msg import RobotState
from moveit_ros_planning.robot_model import RobotDescription
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray

from .exception import MoveItCommanderException

_GREY = ColorRGBA(0.5, 0.5, 0.5, 1.0)


def robot_markers(description: RobotDescription, state: motion.RobotState, *args) -> MarkerArray:
    """Markers of the visual shapes of ``description`` as ``state`` has its joints, in the planning frame.

    For ``args`` see RobotCommander.get_robot_markers; they change ``state``.
    """
    model, links = description.model, list(description.model.links)
    values: dict[str, float] | None = None
    if args and isinstance(args[0], RobotState):
        states.apply_robot_state(None, state, args[0])
    elif args and isinstance(args[0], dict):
        values = args[0]
        links = list(args[1]) if len(args) > 1 else links
    elif args and isinstance(args[0], str):
        if not model.has_group(args[0]):
            raise MoveItCommanderException(f"There is no group named {args[0]}")
        links, values = list(model.group(args[0]).links), args[1] if len(args) > 1 else None
    elif args:
        raise MoveItCommanderException("Unexpected type")
    if values:
        state.set({str(name): float(value) for name, value in values.items()})
    message, frame = MarkerArray(), model.frame
    for link in links:
        for pose, marker in _visuals(description.urdf, link):
            marker.header.frame_id, marker.ns, marker.id = frame, "robot", len(message.markers)
            marker.pose = convert.pose_message(state.pose(link) * pose)
            message.markers.append(marker)
    return message


def _visuals(urdf: str, link: str) -> list[tuple[motion.Pose, Marker]]:
    root = lenient_xml.fromstring(urdf)
    colours = {entry.get("name"): _colour(entry) for entry in root.findall("material")}
    found = []
    for visual in root.findall(f"./link[@name='{link}']/visual"):
        marker = _shape(visual.find("geometry"))
        if marker is None:
            continue
        material = visual.find("material")
        own = _colour(material) if material is not None else None
        marker.color = own or (colours.get(material.get("name")) if material is not None else None) or _GREY
        found.append((_origin(visual.find("origin")), marker))
    return found


def _shape(geometry) -> Marker | None:
    if geometry is None or not len(geometry):
        return None
    shape, marker = geometry[0], Marker(action=Marker.ADD)
    if shape.tag == "mesh":
        marker.type, marker.mesh_resource = Marker.MESH_RESOURCE, shape.get("filename", "")
        marker.mesh_use_embedded_materials = True
        marker.scale = Vector3(*_numbers(shape.get("scale"), (1.0, 1.0, 1.0)))
    elif shape.tag == "box":
        marker.type, marker.scale = Marker.CUBE, Vector3(*_numbers(shape.get("size"), (1.0, 1.0, 1.0)))
    elif shape.tag == "sphere":
        size = 2 * float(shape.get("radius", 0.5))
        marker.type, marker.scale = Marker.SPHERE, Vector3(size, size, size)
    elif shape.tag == "cylinder":
        size = 2 * float(shape.get("radius", 0.5))
        marker.type, marker.scale = Marker.CYLINDER, Vector3(size, size, float(shape.get("length", 1.0)))
    else:
        return None
    return marker


def _colour(material) -> ColorRGBA | None:
    colour = material.find("color")
    return ColorRGBA(*_numbers(colour.get("rgba"), (0.5, 0.5, 0.5, 1.0))) if colour is not None else None


def _origin(element) -> motion.Pose:
    if element is None:
        return motion.Pose.identity()
    return motion.Pose.from_rpy(_numbers(element.get("xyz"), (0.0,) * 3), _numbers(element.get("rpy"), (0.0,) * 3))


def _numbers(text: str | None, default: Sequence[float]) -> tuple[float, ...]:
    values = tuple(float(value) for value in (text or "").split())
    return values if len(values) == len(default) else tuple(default)
