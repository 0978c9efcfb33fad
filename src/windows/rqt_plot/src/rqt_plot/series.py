"""A growing curve that forgets its beginning, and its reduction to what a screen can show. NumPy alone."""

from __future__ import annotations

import numpy as np

#: samples kept of a curve unless told: 200 s at 1 kHz, 3.2 MB
CAPACITY = 200_000


class Series:
    """Samples (x, y) in order of x, at most ``capacity`` of them: the oldest go first.

    :param capacity: samples to keep, or None for all.
    """

    def __init__(self, capacity: int | None = CAPACITY):
        if capacity is not None and capacity < 1:
            raise ValueError(f"a series keeps at least one sample, not {capacity}")
        self.capacity = capacity
        self.clear()

    def clear(self) -> None:
        """Forget all samples, and the memory they took."""
        self._data = np.empty((2, 64))
        self._begin = self._end = 0
        self.dropped = 0  #: samples forgotten so far: keeps the groups of `decimate` where they are

    def __len__(self) -> int:
        return self._end - self._begin

    @property
    def x(self) -> np.ndarray:
        """(n,) view, valid until the next change."""
        return self._data[0, self._begin : self._end]

    @property
    def y(self) -> np.ndarray:
        """(n,) view, valid until the next change."""
        return self._data[1, self._begin : self._end]

    def extend(self, x, y, sort: bool = True) -> None:
        """Append samples; with ``sort``, what is older than the newest one goes to its place.

        :param x: (n,) :param y: (n,)
        """
        x, y = np.asarray(x, float), np.asarray(y, float)
        if len(x) != len(y):
            raise ValueError(f"{len(x)} values of x, {len(y)} of y")
        if self.capacity is not None and len(x) > self.capacity and not sort:
            self.dropped += len(x) - self.capacity
            x, y = x[-self.capacity :], y[-self.capacity :]
        self._make_room(len(x))
        ordered = not sort or len(x) == 0 or ((len(self) == 0 or not x[0] < self._data[0, self._end - 1]) and not np.any(x[1:] < x[:-1]))
        self._data[0, self._end : self._end + len(x)] = x
        self._data[1, self._end : self._end + len(x)] = y
        self._end += len(x)
        if not ordered:
            order = np.argsort(self.x, kind="stable")
            self._data[:, self._begin : self._end] = self._data[:, self._begin : self._end][:, order]
        if self.capacity is not None:
            self._drop(max(0, len(self) - self.capacity))

    def drop_before(self, x: float) -> None:
        """Forget the samples with a smaller x."""
        self._drop(int(np.searchsorted(self.x, x)))

    def _drop(self, count: int) -> None:
        self._begin += count
        self.dropped += count

    def _make_room(self, count: int) -> None:
        size = self._data.shape[1]
        if self._end + count <= size:
            return
        kept = len(self)
        # Twice what is kept, a quarter more than can be: each sample is moved a few times, however long the curve runs.
        wanted = 2 * (kept + count)
        if self.capacity is not None:
            wanted = min(wanted, self.capacity + self.capacity // 4 + count)
        target = self._data if kept + count <= 0.85 * size else np.empty((2, max(wanted, kept + count)))
        target[:, :kept] = self._data[:, self._begin : self._end].copy() if target is self._data else self._data[:, self._begin : self._end]
        self._data, self._begin, self._end = target, 0, kept


def visible(series: Series, low: float, high: float) -> slice:
    """Index range of the samples of ``series`` with low <= x <= high and one more on either side, so that lines leave the picture."""
    begin, end = np.searchsorted(series.x, low, "left"), np.searchsorted(series.x, high, "right")
    return slice(max(0, int(begin) - 1), min(len(series), int(end) + 1))


def decimate(x: np.ndarray, y: np.ndarray, columns: int, offset: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """At most about 4 * ``columns`` of the samples, that look the same: the lowest and highest of each group.

    :param x, y: (n,), x in ascending order
    :param offset: number of the first sample since the curve began; groups begin at multiples of their size, so a picture
        that scrolls does not shimmer.
    """
    group = len(x) // max(1, columns)
    if group < 4:
        return x, y
    # Sizes that are powers of two change seldom while the number of visible samples varies a little.
    group = 1 << (group.bit_length() - 1)
    head = -offset % group
    count = (len(x) - head) // group
    middle = slice(head, head + count * group)
    grouped = y[middle].reshape(count, group)
    out = np.empty((2, 2 * count))
    grouped_x = x[middle].reshape(count, group)
    out[0, 0::2], out[0, 1::2] = grouped_x[:, 0], grouped_x[:, -1]
    np.fmin.reduce(grouped, axis=1, out=out[1, 0::2])
    np.fmax.reduce(grouped, axis=1, out=out[1, 1::2])
    return (np.concatenate((x[:head], out[0], x[middle.stop :])), np.concatenate((y[:head], out[1], y[middle.stop :])))


def limits(values: np.ndarray) -> tuple[float, float] | None:
    """Smallest and largest finite value; None if there is none."""
    if len(values) == 0:
        return None
    low, high = float(np.min(values)), float(np.max(values))
    if not (np.isfinite(low) and np.isfinite(high)):
        values = values[np.isfinite(values)]
        if len(values) == 0:
            return None
        low, high = float(np.min(values)), float(np.max(values))
    return low, high
