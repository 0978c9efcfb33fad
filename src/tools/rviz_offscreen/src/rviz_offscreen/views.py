"""Camera views for RViz, as the command line writes them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from .errors import ViewError

#: Orbit views by name: yaw and pitch in radians. What RViz calls yaw is where the eye stands, seen from the focal point.
NAMED: dict[str, dict[str, float]] = {
    "front": {"yaw": 0.0, "pitch": 0.1},
    "back": {"yaw": math.pi, "pitch": 0.1},
    "left": {"yaw": math.pi / 2, "pitch": 0.1},
    "right": {"yaw": -math.pi / 2, "pitch": 0.1},
    "top": {"yaw": 0.0, "pitch": math.pi / 2 - 1e-3},
    "iso": {"yaw": math.pi / 4, "pitch": 0.5},
}
_KEYS = ("yaw", "pitch", "distance", "x", "y", "z")


@dataclass(frozen=True)
class View:
    """``values``: yaw, pitch (rad), distance (m), focal point x, y, z (m, fixed frame). Of a named view, distance and
    focal point are chosen to have the robot in the frame, unless one of them is given; else what is missing stays as
    configured."""

    name: str
    values: tuple[tuple[str, float], ...] = field(default=())

    @property
    def fits(self) -> bool:
        return self.name in NAMED and not {"distance", "x", "y", "z"} & dict(self.values).keys()


def parse_view(text: str) -> View:
    """``NAME`` or ``[NAME:]yaw=0.5,pitch=0.3,distance=1.2,x=0,y=0,z=0.2``, a named view's values first.

    >>> parse_view("front:distance=2").values
    (('yaw', 0.0), ('pitch', 0.1), ('distance', 2.0))
    """
    name, colon, rest = text.partition(":")
    if not colon and "=" in name:
        name, rest = "", name
    values = dict(NAMED.get(name, {}))
    if not rest and name not in NAMED:
        raise ViewError(
            f"--view {text}: no view of that name; there are {', '.join(NAMED)}, or write NAME:yaw=..,pitch=..,distance=..,x=..,y=..,z=.."
        )
    for item in filter(None, (part.strip() for part in rest.split(","))):
        key, _, value = item.partition("=")
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if key.strip() not in _KEYS or not math.isfinite(number):
            raise ViewError(f"--view {text}: '{item}' is not one of {', '.join(_KEYS)} with a number")
        values[key.strip()] = number
    return View(name, tuple(values.items()))
