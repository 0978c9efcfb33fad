"""Filters over time, ray by ray: LaserArrayFilter, and the filters of the package filters that it holds."""

from __future__ import annotations

from collections import deque
from typing import Any

import numpy as np

from .base import Filter, FilterError, Scan


class _Window:
    """Mean or median of the last ``number_of_observations`` of each ray."""

    def __init__(self, over, count: int):
        self._over = over
        self._seen: deque[np.ndarray] = deque(maxlen=count)

    def apply(self, values: np.ndarray) -> np.ndarray:
        if self._seen and len(self._seen[-1]) != len(values):
            self._seen.clear()
        self._seen.append(values.copy())
        return self._over(np.array(self._seen)).astype(np.float32)


def _median(rows: np.ndarray) -> np.ndarray:
    return np.sort(rows, axis=0)[len(rows) // 2]


_KINDS = {"MultiChannelMeanFilterFloat": lambda rows: rows.mean(axis=0), "MultiChannelMedianFilterFloat": _median}


def _windows(chain: Any, name: str) -> list[_Window]:
    windows = []
    for entry in chain if isinstance(chain, list) else [chain]:
        kind = str(entry.get("type", "") if isinstance(entry, dict) else "").rsplit("/", 1)[-1]
        if kind not in _KINDS:
            raise FilterError(f"filter '{name}': there is no filter '{kind}' of arrays; there are filters/{', filters/'.join(_KINDS)}")
        count = (entry.get("params") or {}).get("number_of_observations")
        if not isinstance(count, int) or not 0 < count <= 10000:
            raise FilterError(f"filter '{name}': {kind} needs number_of_observations from 1 to 10000, not {count!r}")
        windows.append(_Window(_KINDS[kind], count))
    return windows


class ArrayFilter(Filter):
    """``range_filter_chain`` and ``intensity_filter_chain``: chains of filters of arrays."""

    def prepare(self, given) -> None:
        if not {"range_filter_chain", "intensity_filter_chain"} & set(given):
            raise FilterError(f"filter '{self.name}' needs range_filter_chain or intensity_filter_chain")
        self._ranges = _windows(given.get("range_filter_chain", []), self.name)
        self._intensities = _windows(given.get("intensity_filter_chain", []), self.name)

    def apply(self, scan: Scan) -> None:
        for window in self._ranges:
            scan.ranges = window.apply(scan.ranges)
        for window in self._intensities:
            scan.intensities = window.apply(scan.intensities)


class MedianFilter(ArrayFilter):
    """LaserMedianFilter: one chain, ``internal_filter``, for both."""

    def prepare(self, given) -> None:
        if "internal_filter" not in given:
            raise FilterError(f"filter '{self.name}' needs internal_filter")
        super().prepare({"range_filter_chain": given["internal_filter"], "intensity_filter_chain": given["internal_filter"]})
