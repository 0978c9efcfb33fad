"""Test signals and one-line filters."""

from __future__ import annotations

import math
import random
from typing import NamedTuple


class SinusoidValue(NamedTuple):
    """Value and its first two derivatives (per s, per s^2)."""

    value: float
    first: float
    second: float


class Sinusoid:
    """offset + amplitude * sin(phase + 2 pi frequency t).

    :param frequency: Hz.
    :param phase: rad.
    """

    def __init__(self, offset: float = 0.0, amplitude: float = 0.0, frequency: float = 0.0, phase: float = 0.0):
        self.offset = offset
        self.amplitude = amplitude
        self.frequency = frequency
        self.phase = phase

    def update(self, time: float) -> SinusoidValue:
        """The signal at ``time`` (s), with its first and second derivative by time."""
        omega = 2.0 * math.pi * self.frequency
        angle = self.phase + omega * time
        return SinusoidValue(
            self.offset + self.amplitude * math.sin(angle),
            self.amplitude * omega * math.cos(angle),
            -self.amplitude * omega * omega * math.sin(angle),
        )


class SineSweep:
    """Sine of ``amplitude`` whose frequency grows exponentially from ``start`` to ``end`` (Hz) in ``duration`` (s); 0 afterwards.

    :raises ValueError: start > end, or something is negative.
    """

    def __init__(self, start: float, end: float, duration: float, amplitude: float):
        if start > end or min(start, end, duration, amplitude) < 0.0:
            raise ValueError(
                f"sine sweep from {start} to {end} Hz in {duration} s with amplitude {amplitude}: "
                "nothing may be negative and the start must not exceed the end"
            )
        self.duration = duration
        self.amplitude = amplitude
        self._omega = 2.0 * math.pi * start
        ratio = math.log(end / start) if start > 0.0 and end > start else 0.0
        self._scale = duration / ratio if ratio else math.inf

    def update(self, time: float) -> float:
        """:param time: s since the start of the sweep."""
        if time > self.duration:
            return 0.0
        if math.isinf(self._scale):
            return self.amplitude * math.sin(self._omega * time)
        return self.amplitude * math.sin(self._omega * self._scale * math.expm1(time / self._scale))


class Dither:
    """Gaussian noise of standard deviation ``amplitude``; the same seed gives the same noise."""

    def __init__(self, amplitude: float, seed: int = 0):
        self.amplitude = amplitude
        self._random = random.Random(seed)

    def update(self) -> float:
        return self.amplitude * self._random.gauss(0.0, 1.0)


def clamp(value: float, low: float, high: float) -> float:
    """``value``, or the nearer of ``low`` and ``high`` where it lies outside of them."""
    return min(max(value, low), high)


def exponential_smoothing(current: float, last: float, alpha: float) -> float:
    """alpha * current + (1 - alpha) * last; alpha 1 is no smoothing."""
    return alpha * current + (1.0 - alpha) * last
