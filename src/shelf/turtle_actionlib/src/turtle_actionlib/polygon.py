"""Drives along a regular polygon by the turtle's pose. Knows no ROS."""

import math

_GAIN = 6.0  # 1/s, velocity per error
_DISTANCE, _ANGLE = 1e-5, 1e-5  # m, rad; an error below is none
_STUCK = 125  # poses without a change while driving: the wall is in the way


class PolygonError(ValueError):
    """A shape that cannot be drawn; the message says why."""


class Polygon:
    """One drawing of a polygon whose corners lie on a circle."""

    def __init__(self, edges: int, radius: float):
        """
        :param edges: 3 or more
        :param radius: m, of the circle
        :raises PolygonError: for others
        """
        if edges < 3:
            raise PolygonError(f"a shape has 3 edges or more, not {edges}")
        if not (math.isfinite(radius) and radius > 0):
            raise PolygonError(f"the radius must be above 0, not {radius:g}")
        self.interior_angle = (edges - 2) * math.pi / edges
        self.apothem = radius * math.cos(math.pi / edges)
        self._side = 2 * radius * math.sin(math.pi / edges)
        self._edges = edges
        self._start: tuple[float, float, float] | None = None  # x, y, theta at the last corner
        self._last: tuple | None = None
        self._unchanged = 0

    @property
    def done(self) -> bool:
        return self._edges == 0

    def velocity(self, x: float, y: float, theta: float) -> tuple:
        """(m/s, rad/s) to command to a turtle at ``x``, ``y`` (m), turned by ``theta`` (rad).

        :raises PolygonError: if the turtle does not move any more though it should
        """
        self._watch((x, y, theta))
        if self._start is None:
            self._start = x, y, theta
        way = self._side - math.dist(self._start[:2], (x, y))
        if way > _DISTANCE:
            return _GAIN * way, 0.0
        turn = math.remainder(self._start[2] + math.pi - self.interior_angle - theta, 2 * math.pi)
        if abs(turn) > _ANGLE:
            return 0.0, _GAIN * turn
        self._start = None
        self._edges -= 1
        return 0.0, 0.0

    def _watch(self, pose: tuple) -> None:
        self._unchanged = self._unchanged + 1 if pose == self._last else 0
        self._last = pose
        if self._unchanged > _STUCK:
            raise PolygonError(f"the turtle is stuck at x={pose[0]:.2f}, y={pose[1]:.2f}: the shape does not fit into the window")
