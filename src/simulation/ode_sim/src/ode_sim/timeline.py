"""Moments of a world that can be gone back to: snapshots in the order of sim time, kept in bounded memory."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ode_sim.world import Snapshot

MOST = 300  # moments that are kept
_MOST_BYTES = 200_000_000
_LONGEST = 1e6  # s between two moments


@dataclass(frozen=True)
class Moment:
    """``number`` is never used again; ``time_ns`` of the world."""

    number: int
    time_ns: int
    snapshot: Snapshot

    @property
    def size(self) -> int:
        """Bytes, about."""
        return len(self.snapshot.state) + len(self.snapshot.generators)


class Timeline:
    """In the thread that steps the world.

    What is kept after going back takes the place of the moments that came later: there is one future at a time. A model
    that comes or goes begins a new timeline, as nothing from before fits any more. When the memory is full, the oldest
    moment is forgotten.

    :param world: :class:`ode_sim.World`
    """

    def __init__(self, world: Any):
        self._world = world
        self._moments: list[Moment] = []
        self._number = 0
        self._period_ns = 0
        self._next_ns = 0
        world.on_spawn.append(lambda model: self.forget())
        world.on_remove.append(lambda model: self.forget())

    @property
    def moments(self) -> tuple[Moment, ...]:
        return tuple(self._moments)

    @property
    def period(self) -> float:
        """s of sim time from one moment that is kept to the next; 0: none is."""
        return self._period_ns * 1e-9

    def keep(self) -> Moment:
        """The world as it is now."""
        now = self._world.time_ns
        self._number += 1
        moment = Moment(self._number, now, self._world.save())
        self._moments = [kept for kept in self._moments if kept.time_ns < now] + [moment]
        while len(self._moments) > MOST or sum(kept.size for kept in self._moments) > max(_MOST_BYTES, moment.size):
            self._moments.pop(0)
        return moment

    def record(self, period: float) -> None:
        """Keep a moment now, and from now on one every ``period`` s of sim time; 0: no more.

        :raises ValueError: no such period
        """
        if not 0.0 <= period <= _LONGEST:
            raise ValueError(f"a period of {period} s; give seconds from 0 (none) to {_LONGEST:g}")
        self._period_ns = round(period * 1e9)
        if self._period_ns:
            self._next_ns = self.keep().time_ns + self._period_ns

    def after_step(self) -> None:
        """Keep this moment if it is time for it."""
        now = self._world.time_ns
        if self._period_ns and (now >= self._next_ns or now < self._next_ns - self._period_ns):  # the time was set back
            self._next_ns = self.keep().time_ns + self._period_ns

    def find(self, number: int) -> Moment:
        """The moment ``number``. :raises ValueError: it is not kept (any more)."""
        for moment in self._moments:
            if moment.number == number:
                return moment
        raise ValueError(
            f"moment {number} is not kept"
            + (
                f"; there are {self._moments[0].number} to {self._moments[-1].number}"
                if self._moments
                else ": none is since a model came or went"
            )
        )

    def went_back(self, moment: Moment) -> None:
        """The world was restored to ``moment``: the next one is kept a period later."""
        self._next_ns = moment.time_ns + self._period_ns

    def forget(self) -> None:
        self._moments.clear()
