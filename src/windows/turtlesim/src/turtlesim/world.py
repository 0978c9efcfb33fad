"""The turtles' world: who is there, where everyone is, and what their pens draw. Knows neither ROS nor Qt.

Lengths in metres, angles in radians, x to the right and y up from the lower left corner.
"""

import math
import struct
from dataclasses import dataclass, field
from typing import NamedTuple

PIXELS = 500  # of the window, both ways
METRE = 45  # pixels
COMMAND_LIFE = 1.0  # s of wall time that a velocity command counts
_LARGEST = 3.4e38  # what a pose message can hold

Point = tuple[float, float]


def _single(value: float) -> float:
    """A number as float32 holds it: with that, first poses print as everybody's tutorial prints them."""
    return struct.unpack("f", struct.pack("f", value))[0]


SIZE = _single((PIXELS - 1) / METRE)


class WorldError(ValueError):
    """A request that cannot be fulfilled; the message is for the one who made it."""


class Line(NamedTuple):
    """A stroke of a pen."""

    start: Point
    end: Point
    pen: "Pen"


@dataclass(frozen=True)
class Pen:
    color: tuple[int, int, int] = (0xB3, 0xB8, 0xFF)
    width: int = 3  # pixels


@dataclass
class Turtle:
    """One turtle. ``picture`` is the number of its picture."""

    name: str
    x: float
    y: float
    theta: float
    picture: int = 0
    pen: Pen = field(default_factory=Pen)
    pen_down: bool = True
    command: tuple[float, float, float] = (0.0, 0.0, 0.0)  # m/s ahead, m/s to the left, rad/s
    commanded_at: float = -math.inf  # s

    @property
    def speed(self) -> float:
        """m/s, whichever way."""
        return min(math.hypot(*self.command[:2]), _LARGEST)

    def drive(self, ahead: float, left: float, turn: float, now: float) -> None:
        """Take a velocity, ``ahead`` and to the ``left`` in m/s, ``turn`` in rad/s, which counts for COMMAND_LIFE.

        :param now: s, on the clock of :meth:`step`
        :raises WorldError: for numbers that are not finite; the turtle goes on as before
        """
        _check_finite(self.name, "a velocity", ahead, left, turn)
        self.command, self.commanded_at = (ahead, left, turn), now

    def set_pen(self, color: tuple[int, int, int], width: int, off: bool) -> None:
        """Draw in ``color`` (r, g, b; 0 to 255) and ``width`` (pixels, 0 counts as 1); ``off`` lifts the pen, which keeps both."""
        self.pen_down = not off
        if not off:
            self.pen = Pen(color, width or 1)

    def teleport(self, x: float, y: float, theta: float) -> list[Line]:
        """Put the turtle at (x, y) m, with the heading ``theta`` rad; what its pen draws on the way.

        :raises WorldError: a number is not finite
        """
        _check_finite(self.name, "a pose", x, y, theta)
        old = (self.x, self.y)
        self.x, self.y, self.theta = x, min(y, SIZE), theta
        return self._stroke(old)

    def teleport_relative(self, distance: float, angle: float) -> list[Line]:
        """Turn by ``angle`` (rad), then go ``distance`` (m) ahead at once; what its pen draws on the way.

        :raises WorldError: a number is not finite
        """
        _check_finite(self.name, "a distance and angle", distance, angle)
        old = (self.x, self.y)
        self.theta += angle
        self.x += math.cos(self.theta) * distance
        self.y += math.sin(self.theta) * distance
        return self._stroke(old)

    def step(self, dt: float, now: float) -> tuple[list[Line], Point | None]:
        """Move on by dt seconds.

        :param now: s; a command older than COMMAND_LIFE has ended
        :returns: what the pen draws, and where the turtle would be if it had not hit the wall (None: it has not)
        """
        if now - self.commanded_at > COMMAND_LIFE:
            self.command = (0.0, 0.0, 0.0)
        ahead, left, turn = self.command
        old = (self.x, self.y)
        self.theta += turn * dt
        self.theta -= 2 * math.pi * math.floor((self.theta + math.pi) / (2 * math.pi))
        self.x += (math.cos(self.theta) * ahead - math.sin(self.theta) * left) * dt
        self.y += (math.sin(self.theta) * ahead + math.cos(self.theta) * left) * dt
        beyond = None
        if not (0 <= self.x <= SIZE and 0 <= self.y <= SIZE):
            beyond = (self.x, self.y)
            self.x, self.y = (min(max(value, 0.0), SIZE) for value in beyond)
        return self._stroke(old) if old != (self.x, self.y) else [], beyond

    def _stroke(self, start: Point) -> list[Line]:
        return [Line(start, (self.x, self.y), self.pen)] if self.pen_down else []


class World:
    """All turtles, by name in alphabetical order."""

    def __init__(self):
        self.turtles: dict[str, Turtle] = {}
        self._count = 0

    def spawn(self, name: str, x: float, y: float, theta: float, picture: int = 0) -> Turtle:
        """A new turtle at (x, y) m with the heading ``theta`` rad; without a ``name`` it gets the next free turtleN.

        :param picture: number of its picture
        :raises WorldError: if the name is taken, or a number is not finite
        """
        _check_finite(name or "the new turtle", "a pose", x, y, theta)
        if name in self.turtles:
            raise WorldError(f"A turtled named [{name}] already exists")
        while not name or name in self.turtles:
            self._count += 1
            name = f"turtle{self._count}"
        turtle = Turtle(name, x, y, theta, picture)
        self.turtles = dict(sorted([*self.turtles.items(), (name, turtle)]))
        return turtle

    def kill(self, name: str) -> None:
        """:raises WorldError: if there is no such turtle"""
        if name not in self.turtles:
            raise WorldError(f"Tried to kill turtle [{name}], which does not exist")
        del self.turtles[name]

    def reset(self) -> None:
        """Nobody is there any more, and numbers start anew."""
        self.turtles, self._count = {}, 0


def _check_finite(name: str, what: str, *values: float) -> None:
    if not all(abs(value) < _LARGEST for value in values):
        raise WorldError(f"[{name}] cannot take {what} with a number that is not finite: {', '.join(f'{v:g}' for v in values)}")
