"""Pan, tilt and zoom within their limits; no ROS."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

#: Parameters of the node with the values that they have when nothing is said; rad.
DEFAULTS: dict[str, Any] = {
    "ptz": False,
    "pan_joint": "pan",
    "tilt_joint": "tilt",
    "pan_joint_command": "joint_pan_position_controller/command",
    "tilt_joint_command": "joint_tilt_position_controller/command",
    "min_pan_value": -2.97,
    "max_pan_value": 2.97,
    "min_tilt_value": 0.0,
    "max_tilt_value": 1.57,
    "min_zoom_value": 0.0,
    "max_zoom_value": 20000.0,
    "home_pan_value": 0.0,
    "home_tilt_value": 0.79,
    "ptz_rate": 5.0,
    "use_control_timeout": False,
    "control_timeout_value": 5.0,
    "invert_ptz": False,
    "initialization_delay": 0.0,
    "joint_states_topic": "joint_states",
}


@dataclass
class Head:
    """Where the head is to be. ``limits``: (least, most) of pan, tilt (rad) and zoom; ``inverted``: it hangs upside down."""

    limits: tuple[tuple[float, float], tuple[float, float], tuple[float, float]]
    inverted: bool = False
    pan: float = 0.0
    tilt: float = 0.0
    zoom: float = 0.0

    @classmethod
    def from_parameters(cls, values: dict[str, Any]) -> Head:
        """By ``values`` of parameters.

        :raises ValueError: a limit is no number, or the least is above the most; one line that names it.
        """
        limits: list[tuple[float, float]] = []
        for name in ("pan", "tilt", "zoom"):
            try:
                least, most = (float(values[f"{end}_{name}_value"]) for end in ("min", "max"))
            except (TypeError, ValueError):
                raise ValueError(f"min_{name}_value and max_{name}_value must be numbers") from None
            if not least <= most:
                raise ValueError(f"min_{name}_value {least:g} is above max_{name}_value {most:g}")
            limits.append((least, most))
        pan, tilt, zoom = limits
        return cls((pan, tilt, zoom), bool(values["invert_ptz"]))

    def go(self, pan: float, tilt: float, zoom: float, relative: bool = False) -> None:
        """A command to ``pan``, ``tilt`` (rad) and ``zoom`` or, ``relative``, onwards by them from where the head is to be; cut to the
        limits. What is no number changes nothing.
        """
        sign = -1.0 if self.inverted else 1.0
        begin = (self.pan, self.tilt, self.zoom) if relative else (0.0, 0.0, 0.0)
        wanted = [start + more for start, more in zip(begin, (sign * pan, sign * tilt, zoom))]
        if all(value == value for value in wanted):
            self.pan, self.tilt, self.zoom = (min(max(value, least), most) for value, (least, most) in zip(wanted, self.limits))
