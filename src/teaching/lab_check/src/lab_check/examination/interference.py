"""What nodes of the submission did to what is measured: noted in the report, and by the spec's word it costs the task."""

from __future__ import annotations


class Interference:
    """``names``, ``twice``: sentences about names of the simulator, and about joints that several models have."""

    def __init__(self) -> None:
        self.names: set[str] = set()
        self.twice: set[str] = set()
        self._changes: dict[tuple[str, str], tuple[int, float]] = {}

    def changed(self, what: str, who: str, count: int, first: float) -> None:
        """The node ``who`` called ``what``, a service of the simulator that changes the world, or published on a topic that does: in
        /gazebo, or ``/a/topic`` of a plugin.

        :param count: how often. :param first: simulated s of the first time
        """
        self._changes[what, who] = (count, first)

    @property
    def found(self) -> bool:
        return bool(self.names or self.twice or self._changes)

    def notes(self) -> list[str]:
        """A sentence each."""
        changes = [
            f"{'the node ' if who.startswith('/') else ''}{who} used {what if what.startswith('/') else '/gazebo/' + what} {count} times, "
            f"for the first time at {first:.3f} s of simulation: it changed the world by hand"
            for (what, who), (count, first) in sorted(self._changes.items())
        ]
        return changes + sorted(self.names) + sorted(self.twice)

    def first(self) -> str:
        return self.notes()[0]
