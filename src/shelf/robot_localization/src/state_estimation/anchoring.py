"""How a robot's world lies on the earth: found once, from a fix, a heading and the pose in the world. No ROS in it."""

from __future__ import annotations

import numpy as np

from .earth import Tangent, Utm, Zone, zone_of
from .motion import rotation
from .sensors import Transform, angles

Plane = Utm | Tangent


class Datum:
    """A point of the earth and the plane on which its surroundings are laid.

    :param latitude: and longitude: degrees :param altitude: m
    :param local: a plane that touches the earth there, in place of the UTM grid
    :param zone: of the UTM grid, in place of the point's own
    :raises ValueError: there is no such point
    """

    def __init__(self, latitude: float, longitude: float, altitude: float, local: bool = False, zone: Zone | None = None):
        self.plane: Plane = Tangent(latitude, longitude) if local else Utm(zone or zone_of(latitude, longitude))
        self.position = self.cartesian(latitude, longitude, altitude)
        self.convergence = self.plane.convergence(latitude, longitude)

    def cartesian(self, latitude: float, longitude: float, altitude: float) -> np.ndarray:
        """(3,): east, north on the plane, altitude, m, of a point at ``latitude``, ``longitude`` (degrees) and ``altitude`` (m).

        :raises ValueError: there is no such point
        """
        return np.array([*self.plane.plane(latitude, longitude, altitude), altitude])


class Anchor:
    """The pose of the plane in the robot's world, ``world_plane``.

    :param datum: where the receiver is
    :param world_base: the robot's pose in its world at that moment
    :param rpy: (3,), rad: its attitude; yaw from the true east
    :param offset: (3,), m: of the receiver in the robot's frame
    """

    def __init__(self, datum: Datum, world_base: Transform, rpy: np.ndarray, offset: np.ndarray = np.zeros(3)):
        self.datum = datum
        attitude = np.array(rpy, float)
        attitude[2] += datum.convergence
        self.heading = attitude[2]
        at = datum.position - rotation(attitude) @ offset
        # The world is level: roll and pitch of the robot are of the moment.
        plane_base = Transform(_level(self.heading), at)
        level = Transform(_level(angles(world_base.rotation)[2]), world_base.translation)
        self.world_plane = level @ plane_base.inverse()
        self._plane_world = self.world_plane.inverse()

    def to_map(self, latitude: float, longitude: float, altitude: float) -> np.ndarray:
        """(3,), m, in the robot's world, of ``latitude``, ``longitude`` (degrees), ``altitude`` (m). :raises ValueError: no such point"""
        turn = self.world_plane
        return turn.rotation @ self.datum.cartesian(latitude, longitude, altitude) + turn.translation

    def to_earth(self, position: np.ndarray) -> tuple[float, float, float]:
        """(latitude, longitude, altitude), degrees and m, of ``position`` (3,), m, in the robot's world.

        :raises ValueError: too far away
        """
        east, north, up = self._plane_world.rotation @ position + self._plane_world.translation
        return (*self.datum.plane.point(east, north), float(up))

    def covariance_in_map(self, covariance: np.ndarray) -> np.ndarray:
        """``covariance`` (3, 3) of east, north, up, in the world's axes."""
        return self.world_plane.rotation @ covariance @ self.world_plane.rotation.T

    def covariance_on_earth(self, covariance: np.ndarray) -> np.ndarray:
        """``covariance`` (3, 3) in the world's axes, of east, north, up."""
        return self._plane_world.rotation @ covariance @ self._plane_world.rotation.T


def _level(yaw: float) -> np.ndarray:
    return rotation(np.array([0.0, 0.0, yaw]))
