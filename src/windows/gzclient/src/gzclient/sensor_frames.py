"""Where the frame of a sensor's message is in the world, and what is drawn there."""
from __future__ import annotations

import math
from typing import Any, Optional, Tuple

import numpy as np
from ode_sim.math3 import Pose, compose, quat_from_rpy
from ode_sim.viewer.simulation import WorldRecord

_OPTICAL = quat_from_rpy(-math.pi / 2, 0.0, -math.pi / 2)  # of a body frame: x forward becomes z forward
_MOST_POINTS = 4000  # of a scan that are sent to a page


def find_frame(world: WorldRecord, frame_id: str) -> Optional[Tuple[str, str, Pose]]:
    """(model, link, X_LF) of a message's ``frame_id``: of the sensor whose plugin names it, or of the link so named.

    Links that a fixed joint merged into their parent are known by their sensors only.
    """
    wanted = frame_id.strip("/").rpartition("/")[2]
    if not wanted:
        return None
    for model in world.models:
        for link in model.description.links:
            for sensor in link.sensors:
                names = {(plugin.element.findtext(tag) or "").strip().strip("/").rpartition("/")[2]
                         for plugin in sensor.plugins for tag in ("frameName", "frame_name", "frameId")}
                if wanted in names:
                    # an optical frame is drawn where the camera is: the sensor looks along its own x
                    return model.name, link.name, sensor.pose
    for model in world.models:
        for link in model.description.links:
            if link.name.rpartition("::")[2] == wanted:
                return model.name, link.name, Pose()
    return None


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
    """(beams, 3) float32 m: the rim of the cone of a sensor_msgs/Range, x forward."""
    distance = message.range if math.isfinite(message.range) else message.max_range
    half = message.field_of_view / 2
    turn = np.linspace(0.0, 2 * math.pi, beams)
    rim = distance * math.tan(min(half, 1.5))
    return np.stack([np.full(beams, distance), rim * np.cos(turn), rim * np.sin(turn)], axis=1).astype(np.float32)


def optical(x_ls: Pose) -> Pose:
    """The optical frame (z forward) of a camera at ``x_ls`` (x forward)."""
    return compose(x_ls, Pose(q=_OPTICAL))


def field_of_view(world: WorldRecord, model: str, link: str, frame_id: str) -> float:
    """Horizontal, rad, of the camera whose plugin names ``frame_id``; 1.047 where it is not said, as in SDF."""
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
