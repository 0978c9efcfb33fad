"""Real-time pacing of the step loop."""

from __future__ import annotations

import time
from collections.abc import Callable

_NS = 1_000_000_000


class Throttle:
    """Spaces steps evenly in wall time without busy waiting.

    Slots lie on a fixed grid, so that a late wake-up does not slow the simulation down: the next steps follow without a
    pause until the grid is reached again. What is more than ``catch_up`` late (the machine was suspended, a model took
    long to load) is forgotten.

    :param rate: steps per wall second, 0 = as fast as possible
    :param catch_up: seconds
    :param clock: wall time in integer nanoseconds
    """

    def __init__(self, rate: float = 1000.0, catch_up: float = 0.1, clock: Callable[[], int] = time.monotonic_ns):
        self._catch_up_ns = int(catch_up * _NS)
        self._clock = clock
        self._next_ns = clock()
        self.rate = rate

    @property
    def rate(self) -> float:
        return self._rate

    @rate.setter
    def rate(self, rate: float) -> None:
        self._rate = rate
        self.paced = rate > 0.0  # read at every step
        self._period_ns = int(_NS / rate) if self.paced else 0
        self._next_ns = min(self._next_ns, self._clock() + self._period_ns)  # a slow rate may have put it far off

    def restart(self) -> None:
        """The next step may be taken at once (the simulation was paused)."""
        self._next_ns = self._clock()

    def delay(self) -> float:
        """Seconds until the next step is due; 0 or less when it is due now."""
        if not self._period_ns:
            return 0.0
        return (self._next_ns - self._clock()) / _NS

    def stepped(self) -> None:
        """A step was begun."""
        if not self._period_ns:
            return
        self._next_ns += self._period_ns
        earliest = self._clock() - self._catch_up_ns
        if self._next_ns < earliest:
            self._next_ns = earliest
