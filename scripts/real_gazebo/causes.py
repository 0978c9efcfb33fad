"""Why a solver is not within its tolerance: the rows that are off today, each with the cause in words.

The tests expect exactly these to fail (strictly), so that whoever mends one has to take it out here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple


@dataclass(frozen=True)
class Cause:
    """:param quantities: of the rows of that scene; none: all of them."""

    solver: str
    scene: str
    why: str
    quantities: Tuple[str, ...] = ()


def of(solver: str, why: str, *rows) -> Tuple[Cause, ...]:
    """:param rows: names of scenes, or (scene, quantity, ...)."""
    return tuple(Cause(solver, row, why) if isinstance(row, str) else Cause(solver, row[0], why, tuple(row[1:])) for row in rows)


CAUSES: Tuple[Cause, ...] = ()


def cause_of(solver: str, scene: str, quantity: str) -> str:
    """Empty where the row is expected to hold."""
    return next((c.why for c in CAUSES if c.solver == solver and c.scene == scene and (not c.quantities or quantity in c.quantities)), "")
