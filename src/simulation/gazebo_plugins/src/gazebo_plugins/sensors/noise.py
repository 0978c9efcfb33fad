"""SDF's ``<noise>``: the law is ``sensor_noise.hpp`` of ode_sim, here with the generator of the world."""

from __future__ import annotations

import numpy as np
from gazebo_ros import SdfElement
from ode_sim import _core


def axis_noise(group: SdfElement | None, axis: str) -> SdfElement | None:
    """``<noise>`` of ``axis``, ``<x>``, ``<y>`` or ``<z>``, in ``group``, such as ``<angular_velocity>``; None if there is none."""
    found = group.child(axis) if group else None
    return found.child("noise") if found else None


class SdfNoise:
    """What a ``<noise>`` adds to the values of one axis, or of all beams: the same in each run of the same world and seed.

    :param noise: the element, or None for no noise
    :param rng: of ``world.rng(name)``
    :param usual: the type of one that names none: ``gaussian`` for rays
    """

    def __init__(self, noise: SdfElement | None, rng: np.random.Generator, usual: str = "none"):
        kind = "none" if noise is None else noise.attrib.get("type") or noise.text_or("type", usual)
        self.active = kind in ("gaussian", "gaussian_quantized")
        get = noise.get if noise is not None and self.active else (lambda tag, default: default)
        self._rng = rng
        self.mean, self.stddev, self.precision = get("mean", 0.0), get("stddev", 0.0), get("precision", 0.0)
        self._walk = get("dynamic_bias_stddev", 0.0), get("dynamic_bias_correlation_time", 0.0)
        self.bias, bias = 0.0, (get("bias_mean", 0.0), get("bias_stddev", 0.0))
        if any(bias):
            self.bias = _core.drawn_bias(*bias, rng.standard_normal(), rng.random())

    def __call__(self, value, dt: float = 0.0):
        """:param value: a number, or an array of them, each with an error of its own
        :param dt: s since the last call; 0: the bias stays
        """
        if _core.wanders(*self._walk, dt):
            self.bias = _core.wandered_bias(self.bias, *self._walk, dt, self._rng.standard_normal())
        normal = self._rng.standard_normal(np.shape(value)) if self.stddev else 0.0
        return _core.measured(value, self.bias, self.mean, self.stddev, self.precision, normal)
