"""Is what is measured there all the while, and still the same?"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable

from ..examination.simulated_world import Sample


class Presence:
    """Follows things of the simulated world from when they are first seen.

    ``problem`` is '' or a sentence: one was gone for a while, or another thing came in its place. What does not happen to a robot while it
    is not there tells nothing of it.
    """

    def __init__(self, names: Iterable[str], identity: Callable[[Sample, str], Hashable | None] = Sample.identity):
        """:param identity: of a thing by its name: another value after it was replaced, None where it is not there"""
        self.problem = ""
        self._identity = identity
        self._known: dict[str, Hashable | None] = dict.fromkeys(names)
        self._late: set[str] = set()

    def missing(self) -> list[str]:
        """Names of what was never seen."""
        return [name for name, known in self._known.items() if known is None]

    def due(self) -> None:
        """What was not seen until now comes too late."""
        self._late = set(self.missing())

    def look(self, sample: Sample) -> None:
        for name, known in self._known.items():
            found = self._identity(sample, name)
            if known is None and found is not None:
                self._known[name] = found
                if name in self._late:
                    self._complain(f"'{name}' came only at {sample.time:.2f} s of simulation, when it was watched already")
            elif found is None and known is not None:
                self._complain(f"'{name}' was gone at {sample.time:.2f} s of simulation, while it was watched")
            elif found != known:
                self._complain(f"'{name}' was replaced by another of its name by {sample.time:.2f} s of simulation, while it was watched")

    def _complain(self, sentence: str) -> None:
        self.problem = self.problem or sentence
