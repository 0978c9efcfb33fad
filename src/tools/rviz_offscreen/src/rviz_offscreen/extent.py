"""How large the robots in RViz are, and the orbit view that has them in its frame. Runs in RViz's own process."""

from __future__ import annotations

import itertools
import math
import xml.etree.ElementTree as ET

import lenient_xml
import numpy as np
import rosgraph
import rospkg

from . import displays

_HALF_FOV = math.radians(22.5)  # RViz's vertical field of view is 45 degrees
_FILLED = 0.88  # of the frame, along the side that is filled first
_POINT = np.full(3, 0.02)  # m, half the size of a link without a shape
_LEAST = 0.05  # m, from the eye to what is nearest


def _numbers(text: str | None, default: tuple[float, ...]) -> np.ndarray:
    return np.array([float(word) for word in text.split()] if text else default)


def _turned_by_rpy(points: np.ndarray, rpy: np.ndarray) -> np.ndarray:
    (cr, cp, cy), (sr, sp, sy) = np.cos(rpy), np.sin(rpy)
    rotation = np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
    return points @ rotation.T


def _turned(points: np.ndarray, x: float, y: float, z: float, w: float) -> np.ndarray:
    axis = np.array([x, y, z])
    return points + 2 * np.cross(axis, np.cross(axis, points) + w * points)


def _bounds(geometry: ET.Element | None, packages: rospkg.RosPack) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest corner of a shape, (3,) each, m."""
    shape = None if geometry is None else next(iter(geometry), None)
    half: np.ndarray = _POINT
    if shape is not None and shape.tag == "box":
        half = _numbers(shape.get("size"), (0.0,) * 3) / 2
    elif shape is not None and shape.tag in ("cylinder", "sphere"):
        radius = float(shape.get("radius", 0))
        half = np.array([radius, radius, float(shape.get("length", 2 * radius)) / 2])
    elif shape is not None and shape.tag == "mesh":
        import trimesh

        scheme, _, rest = (shape.get("filename") or "").partition("://")
        name, _, inside = rest.partition("/")
        path = f"{packages.get_path(name)}/{inside}" if scheme == "package" else rest
        low, high = trimesh.load(path, force="mesh", process=False).bounds * _numbers(shape.get("scale"), (1.0,) * 3)
        return np.minimum(low, high), np.maximum(low, high)
    return -half, half


def _link_boxes(description: str) -> dict[str, list[np.ndarray]]:
    """Link -> the corners (8,3) of each of its visuals, in the link's frame. What cannot be read is a point."""
    packages = rospkg.RosPack()
    boxes: dict[str, list[np.ndarray]] = {}
    for link in lenient_xml.fromstring(description).iterfind("link"):
        found = boxes[link.get("name", "")] = []
        for visual in link.iterfind("visual"):
            origin, geometry = visual.find("origin"), visual.find("geometry")
            try:
                low, high = _bounds(geometry, packages)
                corners = np.array(list(itertools.product(*zip(low, high))))
                if origin is not None:
                    corners = _turned_by_rpy(corners, _numbers(origin.get("rpy"), (0.0,) * 3)) + _numbers(origin.get("xyz"), (0.0,) * 3)
                found.append(corners)
            except Exception:  # a mesh that is missing or broken: RViz says so, the picture is taken all the same
                found.append(np.zeros((1, 3)))
    return boxes


def corners(manager) -> np.ndarray:
    """(N,3) corners of all robots that RViz shows, in its fixed frame, m; (0,3) when it shows none."""
    found = []
    for robot in displays.robots(manager):
        try:
            boxes = _link_boxes(rosgraph.Master("/rviz").getParam(rosgraph.names.resolve_name(robot.parameter, "/rviz")))
        except (rosgraph.MasterError, ET.ParseError):
            continue
        for name, (position, orientation) in robot.links.items():
            found += [_turned(box, *orientation) + position for box in boxes.get(name, ())]
    return np.concatenate(found) if found else np.zeros((0, 3))


def fitting_view(points: np.ndarray, yaw: float, pitch: float, aspect: float) -> dict[str, float]:
    """Distance and focal point of the orbit view that has all ``points`` (N,3) in its frame, seen from ``yaw`` and ``pitch``, rad.

    :param aspect: width / height of the picture
    """
    level = math.cos(pitch)
    towards = -np.array([level * math.cos(yaw), level * math.sin(yaw), math.sin(pitch)])
    left = np.array([-towards[1], towards[0], 0.0]) / max(math.hypot(towards[0], towards[1]), 1e-12)
    axes = np.stack([towards, left, np.cross(towards, left)])
    seen = points @ axes.T
    depth, across = seen[:, 0], seen[:, 1:]
    slopes = math.tan(_HALF_FOV) * np.array([aspect, 1.0]) * _FILLED
    # A point is in the frame if |across - middle| <= slope * (depth + eye); the best middle of a side serves both ends.
    high, low = (across / slopes - depth[:, None]).max(axis=0), (-across / slopes - depth[:, None]).max(axis=0)
    eye = max(float(((high + low) / 2).max()), _LEAST - float(depth.min()))
    middle = np.array([float((depth.min() + depth.max()) / 2), *((high - low) / 2 * slopes)])
    focal = axes.T @ middle
    return {"distance": eye + middle[0], "x": focal[0], "y": focal[1], "z": focal[2]}
