"""From axes and buttons to velocities. No ROS in it."""

import math
from collections.abc import Sequence
from typing import Any

from node_signals.parameters import is_number

FIELDS = {"linear": ("x", "y", "z"), "angular": ("yaw", "pitch", "roll")}
_DEFAULTS = {"linear": ("x", 1, 0.5, 1.0), "angular": ("yaw", 0, 0.5, None)}  # field, axis, scale, turbo (None: as scale)

Velocities = dict[str, float]


def _whole(value: float) -> int:
    """The nearest whole number, as roscpp reads a parameter for one; of a map's it takes what is before the point."""
    return math.floor(value + 0.5)


def _button(parameters: dict, name: str, default: int) -> int:
    value = parameters.get(name, default)
    if not is_number(value):
        raise ValueError(f"{name} must be the number of a button, but is {value!r:.40}")
    return _whole(value)


class Driver:
    """Parameters (each axis_ and scale_ one number, or one for each field of a map):

    enable_button (0), enable_turbo_button (-1: none), require_enable_button (True), axis_linear (x: 1),
    scale_linear (m/s, x: 0.5), scale_linear_turbo (x: 1.0), axis_angular (yaw: 0), scale_angular (rad/s, yaw: 0.5),
    scale_angular_turbo (as scale_angular).
    """

    def __init__(self, parameters: dict):
        self.enable = _button(parameters, "enable_button", 0)
        self.turbo = _button(parameters, "enable_turbo_button", -1)
        self.required = bool(parameters.get("require_enable_button", True))
        self.axes: dict[str, int] = {}
        self.scales: dict[str, Velocities] = {"normal": {}, "turbo": {}}
        for kind in FIELDS:
            self._read(kind, parameters)
        self._stopped = False

    def _read(self, kind: str, parameters: dict) -> None:
        field, axis, normal, turbo = _DEFAULTS[kind]
        axes = parameters.get("axis_" + kind, axis)
        mapped = isinstance(axes, dict)
        normal = parameters.get("scale_" + kind, {} if mapped else normal)
        turbo = parameters.get(f"scale_{kind}_turbo", {} if mapped else normal if turbo is None else turbo)
        targets: list[tuple[str, Any, dict[str, Any]]] = [
            ("axis_", axes, self.axes),
            ("scale_", normal, self.scales["normal"]),
            ("scale_turbo_", turbo, self.scales["turbo"]),
        ]
        for name, values, into in targets:
            if isinstance(values, dict) != mapped:
                raise ValueError(f"axis_{kind} and scale_{kind} must both be numbers, or both maps like {{{field}: 1}}")
            for key, value in (values if mapped else {field: values}).items():
                if key not in FIELDS[kind]:
                    raise ValueError(f"{name}{kind} has a field {key!r:.40}; there are {', '.join(FIELDS[kind])}")
                if not is_number(int(value) if mapped and isinstance(value, bool) else value):
                    raise ValueError(f"{name}{kind} must give numbers (axes whole ones), but {key} is {value!r:.40}")
                into[key] = (int(value) if mapped else _whole(value)) if into is self.axes else float(value)

    def drive(self, axes: Sequence[float], buttons: Sequence[int]) -> Velocities | None:
        """m/s and rad/s of the six fields, for ``axes`` and ``buttons`` of a Joy message.

        None if there is nothing to say: an enable button that is let go stops once.
        """
        if self._pressed(self.turbo, buttons):
            return self._velocities(axes, "turbo")
        if not self.required or self._pressed(self.enable, buttons):
            return self._velocities(axes, "normal")
        if self._stopped:
            return None
        self._stopped = True
        return self._velocities((), "normal")

    @staticmethod
    def _pressed(button: int, buttons: Sequence[int]) -> bool:
        return 0 <= button < len(buttons) and bool(buttons[button])

    def _velocities(self, axes: Sequence[float], which: str) -> Velocities:
        self._stopped = not axes
        values = {field: 0.0 for fields in FIELDS.values() for field in fields}
        for field, axis in self.axes.items():
            if 0 <= axis < len(axes):
                values[field] = axes[axis] * self.scales[which].get(field, 0.0)
        return values

    def lines(self) -> Sequence[tuple[str, tuple]]:
        """What the node tells at its start: formats with their arguments."""
        told: list[tuple[str, tuple]] = [("Teleop enable button %i.", (self.enable,))]
        if self.turbo >= 0:
            told.append(("Turbo on button %i.", (self.turbo,)))
        for kind, fields in FIELDS.items():
            for field in sorted(set(fields) & set(self.axes)):
                told.append(
                    (kind.capitalize() + " axis %s on %i at scale %f.", (field, self.axes[field], self.scales["normal"].get(field, 0.0)))
                )
                if self.turbo >= 0:
                    told.append((f"Turbo for {kind} axis %s is scale %f.", (field, self.scales["turbo"].get(field, 0.0))))
        return told
