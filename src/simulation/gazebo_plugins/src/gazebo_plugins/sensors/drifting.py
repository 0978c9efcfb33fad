"""The errors of hector_gazebo_plugins' sensors, and their dynamic_reconfigure parameters."""

from __future__ import annotations

from typing import Any

import numpy as np
from dynamic_parameters import Parameter, Server
from ode_sim.description.xmlsource import leading_numbers

_TABLE = (
    Parameter("gaussian_noise", float, 0.0, 0.0, 10.0, "Deviation of the white noise", level=1),
    Parameter("offset", float, 0.0, -10.0, 10.0, "What the signal is too high by, always", level=1),
    Parameter("drift", float, 0.0, 0.0, 10.0, "Deviation of the wandering bias", level=1),
    Parameter("drift_frequency", float, 0.0, 0.0, 1.0, "1 / time constant of the wandering bias, Hz", level=1),
    Parameter("scale_error", float, 1.0, 0.0, 2.0, "Factor on the true value", level=1),
)
_FIELDS = {"gaussian_noise": "sigma", "offset": "offset", "drift": "drift", "drift_frequency": "frequency", "scale_error": "scale"}


class DriftingError:
    """Scale, offset, a slowly wandering drift (first-order Gauss-Markov process) and white noise on each axis.

    :param sdf: the plugin's element
    :param prefix: of the tags: ``accelDrift``, ``accelGaussianNoise`` ... or ``drift``, ``gaussianNoise`` with ''
    :param size: number of axes; one number in the file serves all
    :param rng: of ``world.rng(name)``
    """

    def __init__(self, sdf, prefix: str, size: int, rng: np.random.Generator):
        def read(name: str, default: float) -> np.ndarray:
            tag = prefix + name if prefix else name[0].lower() + name[1:]
            numbers = leading_numbers(sdf.get(tag, ""), size)
            return np.full(size, default) if not numbers else np.resize(np.array(numbers), size)

        self.offset, self.drift, self.scale = read("Offset", 0.0), read("Drift", 0.0), read("ScaleError", 1.0)
        self.frequency, self.sigma = np.maximum(read("DriftFrequency", 1.0 / 3600.0), 0.0), read("GaussianNoise", 0.0)
        self._rng = rng
        self.reset()

    def reset(self) -> None:
        """Draw the drift anew, as at the start."""
        self.start(self.drift * self._rng.standard_normal(len(self.drift)))

    def start(self, drift: np.ndarray) -> None:
        """Go on from ``drift``, (size,)."""
        self.current = np.array(drift)
        self._last_ns: int | None = None

    @property
    def bias(self) -> np.ndarray:
        """(size,) what is wrong without the noise: offset and drift."""
        return self.offset + self.current

    @property
    def variance(self) -> np.ndarray:
        """(size,) of the noise."""
        return self.sigma**2

    def measured(self, value: Any, now_ns: int) -> np.ndarray:
        """(size,) what the sensor says of ``value`` (size,) at the sim time ``now_ns``."""
        self.wander(now_ns)
        return np.asarray(value) * self.scale + self.bias + self.sigma * self._rng.standard_normal(len(self.sigma))

    def wander(self, now_ns: int) -> float:
        """Let the drift go on to the sim time ``now_ns``. :returns: s since the last time, 0 at the first"""
        last, self._last_ns = self._last_ns, now_ns
        if last is None or now_ns <= last:
            return 0.0
        dt = (now_ns - last) * 1e-9
        decay = np.exp(-dt * self.frequency)
        self.current = decay * self.current + np.sqrt(1 - decay * decay) * self.drift * self._rng.standard_normal(len(self.drift))
        return dt

    def means(self) -> dict[str, float]:
        """What dynamic_reconfigure shows: one number for all axes."""
        return {name: float(np.mean(getattr(self, field))) for name, field in _FIELDS.items()}

    def take(self, config: dict[str, Any]) -> None:
        """Give all axes the values of ``config`` that are not the mean of their axes as it is."""
        for name, mean in self.means().items():
            if config[name] != mean:
                setattr(self, _FIELDS[name], np.full(len(self.drift), config[name]))


def error_parameters(server, namespace: str, error: DriftingError) -> Server:
    """The dynamic_reconfigure server of ``error``.

    :param server: of the plugin
    :param namespace: absolute name
    """

    def changed(config: dict[str, Any], _level: int) -> None:
        server.call(lambda: error.take(config))

    return Server(namespace, _TABLE, changed, initial=error.means(), current=error.means)
