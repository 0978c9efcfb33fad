"""Latitude and longitude (WGS 84) as plane coordinates: the UTM grid, or a plane that touches the earth.

By PROJ; no ROS in it.
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple

from pyproj import Proj, Transformer
from pyproj.exceptions import ProjError

_POLAR = 0  # zone number of what UTM does not cover: the caps round the poles (UPS)


class Zone(NamedTuple):
    """A zone of the UTM grid. ``number`` 1 to 60, or 0 for the polar grid; ``north`` of the equator."""

    number: int
    north: bool


def zone_of(latitude: float, longitude: float) -> Zone:
    """The standard zone of ``latitude``, ``longitude``, degrees; with the exceptions of Norway and Spitsbergen."""
    north = latitude >= 0
    if not -80 <= latitude < 84:
        return Zone(_POLAR, north)
    east = (longitude + 180) % 360 - 180
    number = int((east + 180) // 6) + 1
    if 56 <= latitude < 64 and 3 <= east < 6:
        number = 32
    elif latitude >= 72 and 6 <= east < 36:
        number = 31 + 2 * int((east + 3) // 12)
    return Zone(number, north)


def zone_named(name: str) -> Zone:
    """The zone of ``name``, "31U" (number, band of latitude) or of a polar "A", "B", "Y", "Z".

    :raises ValueError: it is neither
    """
    found = re.fullmatch(r"\s*(\d{1,2})?\s*([A-HJ-NP-Za-hj-np-z])\s*", name)
    if found:
        band = found[2].upper()
        if found[1] is None and band in "ABYZ":
            return Zone(_POLAR, band in "YZ")
        if found[1] is not None and band not in "ABYZ" and 1 <= int(found[1]) <= 60:
            return Zone(int(found[1]), band >= "N")
    raise ValueError(f"'{name}' is no zone of the UTM grid; one is a number from 1 to 60 and a band of latitude, as in 31U")


class Utm:
    """The plane of one zone, also a little beyond its borders.

    :param zone: where points are put, whichever side of the equator they are on
    """

    def __init__(self, zone: Zone):
        self.zone = zone
        grid = {"proj": "ups"} if zone.number == _POLAR else {"proj": "utm", "zone": zone.number}
        self._project = Proj(grid, ellps="WGS84", south=not zone.north)

    def plane(self, latitude: float, longitude: float, altitude: float) -> tuple[float, float]:
        """(east, north), m, of a point at ``latitude``, ``longitude``, degrees; ``altitude``, m, changes nothing.

        :raises ValueError: there is no such point, or it is too far from the zone
        """
        _check(latitude, longitude, altitude)
        try:
            return self._project(longitude, latitude, errcheck=True)
        except ProjError:
            raise ValueError(f"latitude {latitude:g}, longitude {longitude:g} cannot be told in UTM zone {self.zone.number}") from None

    def point(self, east: float, north: float) -> tuple[float, float]:
        """(latitude, longitude), degrees, of the point ``east``, ``north`` of the plane, m. :raises ValueError: there is none"""
        try:
            longitude, latitude = self._project(east, north, inverse=True, errcheck=True)
        except ProjError:
            raise ValueError(f"({east:g} m, {north:g} m) is not on the UTM grid") from None
        return latitude, longitude

    def convergence(self, latitude: float, longitude: float) -> float:
        """From true north clockwise to the grid's, rad, at ``latitude``, ``longitude``, degrees."""
        return math.radians(self._project.get_factors(longitude, latitude).meridian_convergence)


class Tangent:
    """East and north on the plane that touches the ellipsoid at ``latitude``, ``longitude``, degrees."""

    def __init__(self, latitude: float, longitude: float):
        _check(latitude, longitude, 0.0)
        self._project = Transformer.from_pipeline(
            f"+proj=pipeline +step +proj=cart +ellps=WGS84 +step +proj=topocentric +ellps=WGS84 +lat_0={latitude!r} +lon_0={longitude!r}"
        )

    def plane(self, latitude: float, longitude: float, altitude: float) -> tuple[float, float]:
        """(east, north), m, of a point at ``latitude``, ``longitude`` (degrees), ``altitude`` (m). :raises ValueError: no such point"""
        _check(latitude, longitude, altitude)
        return self._project.transform(longitude, latitude, altitude)[:2]

    def point(self, east: float, north: float) -> tuple[float, float]:
        """(latitude, longitude), degrees, of the point ``east``, ``north`` of the plane, m."""
        longitude, latitude, _ = self._project.transform(east, north, 0.0, direction="INVERSE")
        return latitude, longitude

    def convergence(self, _latitude: float, _longitude: float) -> float:
        """The plane's north is the true one."""
        return 0.0


def _check(latitude: float, longitude: float, altitude: float) -> None:
    if not (abs(latitude) <= 90 and math.isfinite(longitude) and math.isfinite(altitude)):
        raise ValueError(f"latitude {latitude:g}, longitude {longitude:g}, altitude {altitude:g} is no point on the earth")
