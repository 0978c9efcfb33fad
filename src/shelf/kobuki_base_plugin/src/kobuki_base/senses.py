"""What the base feels: bumpers, cliffs below its edge, wheels off the ground."""

from __future__ import annotations

import math

import numpy as np
from ode_sim import math3
from plugin_loader import PluginError

SIDES = "left", "center", "right"
_BUMPER_HEIGHTS = 0.01, 0.13  # m above the floor: the body is one simple shape, what touches it elsewhere is no bump


def bumper_side(angle: float) -> str:
    """Which bumper something pushes that lies at ``angle`` (rad, to the left of ahead); '' behind the robot.

    Each bumper covers 60 degrees.
    """
    angle = math.remainder(angle, 2 * math.pi)
    if abs(angle) > math.pi / 2:
        return ""
    return "center" if abs(angle) <= math.pi / 6 else "left" if angle > 0 else "right"


class Bumper:
    """The three bumpers of ``model``: what touches its body, ``wheels`` left out."""

    def __init__(self, world, model, wheels):
        self._world, self._model = world, model
        apart = {wheel.name for wheel in wheels}
        self._body = {collision.id for link in model.links.values() if link.name not in apart for collision in link.collisions.values()}

    def pressed(self) -> set[str]:
        """Of :data:`SIDES` those that something pushes now."""
        found = set()
        pose = self._model.pose
        yaw = math3.quat_to_rpy(pose.q)[2]
        for contact in self._world.contacts():
            first, second = int(contact["collision1"]) in self._body, int(contact["collision2"]) in self._body
            height = contact["position"][2] - pose.p[2]
            if first == second or not _BUMPER_HEIGHTS[0] <= height <= _BUMPER_HEIGHTS[1]:
                continue
            out = -contact["normal"] if first else contact["normal"]  # from the robot to what it touches
            if math.hypot(out[0], out[1]) > 0.5:
                found.add(bumper_side(math.atan2(out[1], out[0]) - yaw))
        return found - {""}


class Cliffs:
    """Distances to the floor as the rays of the named sensors find them.

    :param sensors: side to name of a ray sensor of ``model``.
    :param threshold: m, from which on there is a cliff.
    """

    def __init__(self, world, model, sensors: dict[str, str], threshold: float):
        self._world, self._threshold = world, threshold
        self._own = [collision for link in model.links.values() for collision in link.collisions.values()]
        self._places = {side: named_sensor(model, name, ("ray", "gpu_ray")) for side, name in sensors.items()}

    def distances(self) -> dict[str, float]:
        """Side to distance in m; inf where there is no floor within the sensor's range."""
        poses = [math3.compose(link.pose, sensor.pose) for link, sensor in self._places.values()]
        ahead = [math3.quat_rotate(pose.q, (1.0, 0.0, 0.0)) for pose in poses]
        ranges, _ = self._world.cast_rays(np.array([pose.p for pose in poses]), np.array(ahead), 0.15, self._own)
        return dict(zip(self._places, ranges))

    def is_cliff(self, distance: float) -> bool:
        """Whether a floor ``distance`` m away is too deep to drive over."""
        return distance >= self._threshold


def reading(distance: float) -> int:
    """What the real sensor's converter would say of ``distance`` m, as upstream's plugin has it (16 bit)."""
    return int(76123 * math.atan2(0.995, min(distance, 1e3))) & 0xFFFF


class OnFloor:
    """Whether a wheel touches anything."""

    def __init__(self, world, wheel):
        self._world = world
        self._shapes = [collision.id for collision in wheel.collisions.values()]

    def __call__(self) -> bool:
        contacts = self._world.contacts()
        return any(np.isin(contacts[one], self._shapes).any() for one in ("collision1", "collision2"))


def named_sensor(model, name: str, kinds) -> tuple:
    """(link handle, description) of the sensor ``name``, of one of ``kinds``.

    :raises PluginError: the model has none; says which it has.
    """
    there = []
    for description in model.description.links:
        for sensor in description.sensors:
            if sensor.name == name and sensor.type in kinds:
                return model.links[description.name], sensor
            there.append(f"{sensor.name} ({sensor.type})")
    raise PluginError(f"model {model.name} has no sensor '{name}' of type {' or '.join(kinds)}; it has {', '.join(there) or 'none'}")
