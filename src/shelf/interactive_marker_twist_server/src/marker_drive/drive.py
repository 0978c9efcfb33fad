"""From a drag to velocities. No ROS in it."""

from collections.abc import Sequence

from node_signals.parameters import is_number

_KEYS = ("linear_scale", "max_positive_linear_velocity", "max_negative_linear_velocity")
_DEFAULTS = (1.0, 1.0, -1.0)


class Drive:
    """Parameters: linear_scale (m/s for each m), max_positive_linear_velocity and max_negative_linear_velocity (m/s), each a
    number for x or a map of x, y, z; angular_scale (rad/s for each rad, 2.2), max_angular_velocity (rad/s, 2.2).
    """

    def __init__(self, parameters: dict):
        scales = parameters.get(_KEYS[0], 1.0)
        self._linear: dict[str, tuple[float, float, float]] = {}
        for axis in scales if isinstance(scales, dict) else "x":
            if axis not in ("x", "y", "z"):
                raise ValueError(f"linear_scale has an axis {axis!r:.40}; there are x, y, z")
            scale, most, least = (_number(parameters, key, axis, default) for key, default in zip(_KEYS, _DEFAULTS))
            self._linear[axis] = scale, least, most
        self._angular = _number(parameters, "angular_scale", None, 2.2)
        self._most_angular = abs(_number(parameters, "max_angular_velocity", None, 2.2))

    @property
    def axes(self) -> Sequence[str]:
        """The axes that can be dragged, in the order x, y, z."""
        return sorted(self._linear)

    def linear(self, axis: str, distance: float) -> float:
        """m/s along ``axis`` ("x", "y", "z") for a drag of ``distance`` m; 0 for an axis that is not driven."""
        if axis not in self._linear:
            return 0.0
        scale, least, most = self._linear[axis]
        return max(least, min(most, scale * distance))

    def angular(self, yaw: float) -> float:
        """rad/s for a turn of ``yaw`` rad."""
        return max(-self._most_angular, min(self._most_angular, self._angular * yaw))


def _number(parameters: dict, key: str, axis, default: float) -> float:
    value = parameters.get(key, default)
    if isinstance(value, dict) and axis is not None:
        value = value.get(axis, default)
    if not is_number(value):
        raise ValueError(f"{key} must be a number{'' if axis is None else ' or a map of x, y, z'}, but is {value!r:.40}")
    return float(value)
