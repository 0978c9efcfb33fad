"""The tables of dynamic_reconfigure that move_group and MoveIt's classes in C++ have in common, for :mod:`dynamic_parameters`."""

from __future__ import annotations

import math
from collections.abc import Iterable

from dynamic_parameters import Parameter

from . import _execution  # type: ignore[attr-defined]  # compiled

_TYPES = {_execution.Kind.FLAG: bool, _execution.Kind.COUNT: int, _execution.Kind.NUMBER: float}


def table(rows: Iterable[_execution.Parameter]) -> list[Parameter]:
    """The parameters of a server.

    :param rows: one of the tables of ``laws/parameters.hpp``, such as ``_execution.plan_parameters()``.
    """
    return [_parameter(row, _TYPES[row.kind]) for row in rows]


def _parameter(row: _execution.Parameter, kind: type) -> Parameter:
    if kind is bool:
        return Parameter(row.name, bool, bool(row.value), description=row.description, level=row.level)
    high = kind(row.high) if math.isfinite(row.high) else None
    return Parameter(row.name, kind, kind(row.value), kind(row.low), high, row.description, row.level)
