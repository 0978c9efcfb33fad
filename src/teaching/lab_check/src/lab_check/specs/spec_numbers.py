"""What a schema cannot say of a spec's numbers: JSON Schema knows neither ``.nan`` nor ``.inf``, which YAML has, nor an order of two."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, TypeGuard

_MESSAGES = ("message", "request", "goal", "arguments")  # what they hold goes to the submission, or to the spec's own functions
_RANGES = ("rate", "by", "turned", "share")
_BOUNDS = (*_RANGES, "least", "most", "tolerance")  # which may be without end


def problems_of_numbers(data: Any, where: tuple = ()) -> Iterator[tuple[tuple, str]]:
    """The place, a path of keys, and a sentence for each number of ``data`` by which nothing could be judged.

    :param where: the path of keys to ``data``
    """
    if isinstance(data, float) and not math.isfinite(data):
        if math.isnan(data):
            yield where, "is no number (.nan), which no value equals, and none is less or more than"
        elif not set(_BOUNDS) & set(where):
            yield where, "has to be finite"
    elif isinstance(data, dict):
        least, most = data.get("least"), data.get("most")
        if _is_number(least) and _is_number(most) and least > most:
            yield (*where, "least"), f"{least:g} is more than most, {most:g}"
        for key, value in data.items():
            if key not in _MESSAGES:
                yield from problems_of_numbers(value, (*where, key))
    elif isinstance(data, list):
        if where and where[-1] in _RANGES and len(data) == 2 and all(map(_is_number, data)) and data[0] > data[1]:
            yield where, f"[{data[0]:g}, {data[1]:g}]: the least comes first"
        for index, value in enumerate(data):
            yield from problems_of_numbers(value, (*where, index))


def _is_number(value: Any) -> TypeGuard[float]:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
