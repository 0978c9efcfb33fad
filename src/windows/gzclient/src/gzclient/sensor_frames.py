"""Where the frame of a sensor's message is in the world, and what is drawn there."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from ode_sim.math3 import Pose, compose, quat_from_rpy
from ode_sim_viewer.simulation import WorldRecord

_OPTICAL = quat_from_rpy(-math.pi / 2, 0.0, -math.pi / 2)  # of a body frame: x forward becomes z forward
_MOST_POINTS = 4000  # of a scan that are sent to a page
_MOST_CLOUD = 20_000  # of a cloud
_CAMERAS = ("camera", "depth", "depth_camera", "multicamera", "rgbd_camera", "wideanglecamera")
_FLOATS = {7: "f4", 8: "f8"}  # datatypes of sensor_msgs/PointField


def find_frame(world: WorldRecord, frame_id: str) -> tuple[str, str, Pose] | None:
    """(model, link, X_LF) of a message's ``frame_id``: of the sensor whose plugin names it, or of the link so named.

    Links that a fixed joint merged into their parent are known by their sensors only. None: ``world`` has neither.
    """
    wanted = frame_id.strip("/").rpartition("/")[2]
    if not wanted:
        return None
    for model in world.models:
        for link in model.description.links:
            for sensor in link.sensors:
                names = {
                    (plugin.element.findtext(tag) or "").strip().strip("/").rpartition("/")[2]
                    for plugin in sensor.plugins
                    for tag in ("frameName", "frame_name", "frameId")
                }
                if wanted in names:
                    # an optical frame is drawn where the camera is: the sensor looks along its own x
                    return model.name, link.name, sensor.pose
    for model in world.models:
        for link in model.description.links:
            if link.name.rpartition("::")[2] == wanted:
                return model.name, link.name, Pose()
    return None


def is_camera(world: WorldRecord, model: str, link: str, frame_id: str) -> bool:
    """Whether a camera on this ``link`` of a ``model`` of ``world`` has a plugin that names ``frame_id``: its data are in
    optical axes, z forward.
    """
    wanted = frame_id.strip("/").rpartition("/")[2]
    record = world.model(model)
    for candidate in record.description.links if record is not None else ():
        for sensor in candidate.sensors if candidate.name == link else ():
            if sensor.type in _CAMERAS and any(
                (plugin.element.findtext("frameName") or "").strip().strip("/").rpartition("/")[2] == wanted for plugin in sensor.plugins
            ):
                return True
    return False


def cloud_points(message: Any) -> tuple[np.ndarray, np.ndarray]:
    """((N, 3) float32 m, (N, 3) uint8 colours) of a sensor_msgs/PointCloud2, thinned; grey where it has no colours.

    :raises ValueError: it has no places, or is cut off
    """
    fields = {field.name: field for field in message.fields}
    if not all(name in fields and fields[name].datatype in _FLOATS for name in "xyz"):
        raise ValueError(f"a cloud of {', '.join(fields) or 'nothing'}; x, y and z are wanted")
    step, count = message.point_step, message.width * message.height
    if step <= 0 or len(message.data) < step * count or message.row_step not in (0, step * message.width):
        raise ValueError(f"the cloud is cut off: {len(message.data)} bytes for {count} points")
    order = ">" if message.is_bigendian else "<"
    layout: dict[str, Any] = {
        "names": list("xyz"),
        "formats": [order + _FLOATS[fields[name].datatype] for name in "xyz"],
        "offsets": [fields[name].offset for name in "xyz"],
        "itemsize": step,
    }
    tint = fields.get("rgb") or fields.get("rgba")
    if tint is not None:
        layout["names"].append("tint")
        layout["formats"].append(order + "u4")
        layout["offsets"].append(tint.offset)
    kind: Any = np.dtype(layout)  # type: ignore[call-overload]  # the stub knows no offsets of a dict that grows
    found = np.frombuffer(message.data, kind, count)[:: max(1, -(-count // _MOST_CLOUD))]
    points = np.stack([found[name] for name in "xyz"], axis=1).astype(np.float32)
    good = np.isfinite(points).all(axis=1)
    if tint is None:
        return points[good], np.full((int(good.sum()), 3), 120, np.uint8)
    packed = found["tint"][good]
    return points[good], np.stack([packed >> 16 & 255, packed >> 8 & 255, packed & 255], axis=1).astype(np.uint8)


def scan_points(message: Any) -> np.ndarray:
    """(N, 3) float32 m: where the beams of a sensor_msgs/LaserScan ended, in its frame; not those that hit nothing."""
    ranges = np.asarray(message.ranges, np.float32)[:100_000]
    step = max(1, -(-len(ranges) // _MOST_POINTS))
    angles = message.angle_min + message.angle_increment * np.arange(len(ranges))
    good = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= message.range_max)
    ranges, angles = ranges[good][::step], angles[good][::step]
    points = np.stack([ranges * np.cos(angles), ranges * np.sin(angles), np.zeros_like(ranges)], axis=1)
    return points.astype(np.float32)


def range_cone(message: Any, beams: int = 9) -> np.ndarray:
    """(``beams``, 3) float32 m: the rim of the cone of ``message``, a sensor_msgs/Range, x forward."""
    distance = message.range if math.isfinite(message.range) else message.max_range
    half = message.field_of_view / 2
    turn = np.linspace(0.0, 2 * math.pi, beams)
    rim = distance * math.tan(min(half, 1.5))
    return np.stack([np.full(beams, distance), rim * np.cos(turn), rim * np.sin(turn)], axis=1).astype(np.float32)


def optical(x_ls: Pose) -> Pose:
    """The optical frame (z forward) of a camera at ``x_ls`` (x forward)."""
    return compose(x_ls, Pose(q=_OPTICAL))


def field_of_view(world: WorldRecord, model: str, link: str, frame_id: str) -> float:
    """Horizontal, rad, of the camera on this ``link`` of a ``model`` of ``world`` whose plugin names ``frame_id``; 1.047 where it
    is not said, as in SDF.
    """
    wanted = frame_id.strip("/").rpartition("/")[2]
    record = world.model(model)
    for candidate in record.description.links if record is not None else ():
        if candidate.name != link:
            continue
        for sensor in candidate.sensors:
            for plugin in sensor.plugins:
                if (plugin.element.findtext("frameName") or "").strip().strip("/").rpartition("/")[2] == wanted:
                    try:
                        return float(sensor.element.findtext("camera/horizontal_fov") or 1.047)
                    except ValueError:
                        return 1.047
    return 1.047
