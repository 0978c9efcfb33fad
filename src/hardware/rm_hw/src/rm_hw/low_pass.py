"""Second-order Butterworth low pass for samples that arrive at uneven intervals."""

from __future__ import annotations

import math

_ROOT = math.sqrt(2.0)
_NOTHING = 1e-12  # standing still reads 0, not ever smaller numbers
_SMALLEST_TAN = 0.01  # a floor under the corner: about 3 Hz at 1 kHz
_LARGEST_PHASE = math.pi / 4.0  # the corner is at most a quarter of the rate: after a gap the slope stays moderate


class LowPass:
    """The filter 1 / (s^2 + sqrt(2) s + 1) advanced by the trapezoidal rule over each measured interval, with the
    corner prewarped: at an even rate exactly the bilinear Butterworth filter.

    Its state is the output and the output's slope, not past samples as in a difference equation: with intervals that
    vary (late and lost frames) the latter grows without bound although every single set of its coefficients is stable.

    :param cutoff: Hz, at most a quarter of the sample rate; zero or negative: just that quarter.
    """

    def __init__(self, cutoff: float = -1.0) -> None:
        self.cutoff = cutoff
        self.reset()

    def reset(self) -> None:
        """Forget all samples."""
        self.output = 0.0
        self._stamp: float | None = None
        self._slope = self._input = 0.0

    def update(self, value: float, stamp: float) -> float:
        """Filter one sample.

        :param stamp: seconds; the first sample sets the output, one with the stamp of the one before is ignored.
        :returns: the output, in the unit of ``value``.
        """
        if self._stamp is None:
            self._stamp, self._input, self.output = stamp, value, value
            return value
        interval, self._stamp = stamp - self._stamp, stamp
        if interval <= 0.0:
            return self.output
        g = 1.0
        if self.cutoff > 0.0:
            g = max(_SMALLEST_TAN, math.tan(min(_LARGEST_PHASE, math.pi * self.cutoff * interval)))
        level = self.output + g * self._slope
        slope = self._slope - g * (self.output + _ROOT * self._slope - value - self._input)
        self._input = value
        scale = 1.0 + g * (_ROOT + g)
        self.output = ((1.0 + _ROOT * g) * level + g * slope) / scale
        self._slope = (slope - g * level) / scale
        if value == 0.0 and abs(self.output) < _NOTHING and abs(self._slope) < _NOTHING:
            self.output = self._slope = 0.0
        return self.output
