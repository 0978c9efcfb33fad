"""When something that is done at a rate is due: one verb, and the rules that robots' rates depend on.

``gate.due(now)`` is True once per opening, and takes it. The rules differ upstream, and a recorded rate shows which it was:

======================  ==================================================================================================
:class:`RateGate`       ros_control's controllers: the next opening is a period after the one that was due, so the mean
                        rate is exact, and after a stall the gate catches up. Seconds.
:class:`PeriodAdded`    Gazebo's drive plugins: open when strictly more than a period has passed; the period is added, not
                        the time of the opening. ``elapsed`` is what they integrate over. Nanoseconds.
:class:`Spaced`         Gazebo's sensor plugins, messages for people: openings are a period or more apart. Nanoseconds.
:class:`LatenessKept`   Gazebo's sensors: as Spaced, but what an opening is late counts for the next, so that 30 Hz on
                        a 1 ms step gives 30 a second. Nanoseconds.
======================  ==================================================================================================

Time that goes backwards (a simulation was reset) starts each anew. Knows no ROS.
"""

from __future__ import annotations

_NS = 1_000_000_000


class RateGate:
    """Opens ``rate`` times a second, as every ros_control controller gates its topics.

    The next opening is counted from the last one that was due, so the mean rate is exact; after a stall the gate stays
    open every cycle until it has caught up. Like upstream's it opens strictly after the due time.

    :param rate: Hz; 0 or less never opens.
    """

    __slots__ = ("_period", "_start", "_count", "_next", "_jumped")

    #: s; keeps rounding of float times from deciding whether a cycle at the due time itself is late
    _TOLERANCE = 1e-6

    def __init__(self, rate: float, time: float = 0.0):
        self._period = 1.0 / rate if rate > 0.0 else float("inf")
        self.restart(time)

    def restart(self, time: float) -> None:
        """Count from ``time`` (s)."""
        self._start = time
        self._count = 0
        self._schedule()

    def resume(self, time: float) -> None:
        """Go on at ``time`` (s) after a pause: the openings missed meanwhile are lost, the next one is in the first cycle.

        A pause shorter than a period changes nothing, so that the rate holds through a stop and a start.
        """
        if time > self._next:
            self.restart(max(time - 1.001 * self._period, 0.0))

    def _schedule(self) -> None:
        last = self._start + self._count * self._period if self._count else self._start
        self._next = last + self._period + self._TOLERANCE
        self._jumped = last - self._TOLERANCE

    def due(self, time: float) -> bool:
        """Whether ``time`` (s) is past the next opening."""
        if time > self._next:
            self._count += 1
            self._schedule()
            return True
        if time < self._jumped:
            self.restart(time)
        return False


class PeriodAdded:
    """Gazebo's drive plugins' rule.

    :param rate: Hz; 0 or less opens in every step
    """

    def __init__(self, rate: float):
        self._period_ns = round(_NS / rate) if rate > 0.0 else 0
        self._last_ns: int | None = None
        #: s from the opening before to the last one
        self.elapsed = 0.0

    def due(self, now_ns: int) -> bool:
        """Whether it opens at ``now_ns``; the first time that it is asked it only begins to count."""
        if self._last_ns is None or now_ns < self._last_ns:
            self._last_ns = now_ns
            return False
        elapsed = now_ns - self._last_ns
        if elapsed <= self._period_ns and (self._period_ns or not elapsed):
            return False
        late = elapsed > 2 * self._period_ns  # a long pause of the gate must not be followed by a burst
        self._last_ns = now_ns if late or not self._period_ns else self._last_ns + self._period_ns
        self.elapsed = elapsed / _NS
        return True


class Spaced:
    """Openings a period or more apart.

    :param rate: Hz; 0 or less = whenever it is asked
    :param strict: more than a period apart, as ArbotiX' boards and MoveIt's map updaters have it
    :param last_ns: an opening to count from; without it the first question finds the gate open
    """

    def __init__(self, rate: float, strict: bool = False, last_ns: int | None = None):
        self._period_ns = round(_NS / rate) if rate > 0.0 else 0
        self._least_ns = self._period_ns + strict if self._period_ns else 0
        self._last_ns = last_ns

    def ready(self, now_ns: int) -> bool:
        """Whether it would open at ``now_ns``; does not take the opening."""
        return self._last_ns is None or not 0 <= now_ns - self._last_ns < self._least_ns

    def take(self, now_ns: int) -> None:
        """The opening is at ``now_ns``, ready or not."""
        self._last_ns = now_ns

    def due(self, now_ns: int) -> bool:
        """Whether it opens at ``now_ns``, which takes the opening."""
        last_ns = self._last_ns
        if last_ns is not None and 0 <= now_ns - last_ns < self._least_ns:
            return False
        self._last_ns = now_ns
        return True

    def reset(self) -> None:
        """Time starts anew: open at the next question."""
        self._last_ns = None


class LatenessKept:
    """Gazebo's sensors' rule: due when the time since the last opening plus the delay carried over reaches the period. A delay
    of a period or more is forgotten.

    :param rate: Hz; 0 or less = every step
    """

    def __init__(self, rate: float):
        self.rate = rate
        self.last_ns = 0
        self._delay_ns = 0

    @property
    def rate(self) -> float:
        """Hz, 0 = every step."""
        return self._rate

    @rate.setter
    def rate(self, rate: float) -> None:
        self._rate = max(rate, 0.0)
        self.period_ns = round(_NS / rate) if rate > 0 else 0

    def ready(self, now_ns: int) -> bool:
        """Whether it would open at ``now_ns``; does not take the opening. Never twice at the same time, and not at 0."""
        if now_ns <= self.last_ns:
            if now_ns < self.last_ns:
                self.reset()
            return False
        return now_ns - self.last_ns + self._delay_ns >= self.period_ns

    def take(self, now_ns: int) -> None:
        """The opening is at ``now_ns``."""
        delay = max(0, now_ns - self.last_ns + self._delay_ns - self.period_ns)
        self._delay_ns = delay if delay < self.period_ns else 0
        self.last_ns = now_ns

    def due(self, now_ns: int) -> bool:
        """Whether it opens at ``now_ns``, which takes the opening."""
        if not self.ready(now_ns):
            return False
        self.take(now_ns)
        return True

    def reset(self) -> None:
        """Count from 0."""
        self.last_ns = 0
        self._delay_ns = 0
