"""The points that a curve keeps, and the few of them that a picture needs. NumPy alone."""

from __future__ import annotations

import numpy as np
from rqt_plot.series import Series, decimate, limits, visible

from rqt_multiplot.config import Data, DataType

MOST_POINTS = 1_000_000  #: of a vector or list, 16 MB: the oldest go first
_CLOCK_SET_BACK = 1.0  # s


class Points(Series):
    """Points in the order in which they came, kept as the configuration says."""

    def __init__(self, data: Data):
        self.data = data
        super().__init__(data.circular_buffer_capacity if data.type == DataType.CIRCULAR_BUFFER else MOST_POINTS)

    def clear(self) -> None:
        super().clear()
        self.ascending = True

    def append(self, points, x_is_time: bool) -> None:
        """
        :param points: (n, 2). :param x_is_time: then a jump back begins the curve anew.
        """
        new: np.ndarray = np.asarray(points, float).reshape(-1, 2)
        if x_is_time and len(new):
            steps = np.diff(new[:, 0], prepend=self.x[-1] if len(self) else new[0, 0])
            jumps = np.flatnonzero(steps < -_CLOCK_SET_BACK)
            if len(jumps):
                self.clear()
                new = new[jumps[-1] :]
        if len(new):
            before = self.x[-1] if len(self) else -np.inf
            self.ascending = self.ascending and bool(new[0, 0] >= before) and not np.any(np.diff(new[:, 0]) < 0)
        self.extend(new[:, 0], new[:, 1], sort=False)
        if self.data.type == DataType.TIME_FRAME and len(self):
            self._keep_frame(self.x[-1] - self.data.time_frame_length)

    def _keep_frame(self, begin: float) -> None:
        if self.ascending:
            self.drop_before(begin)
        else:
            late = np.flatnonzero(self.x >= begin)
            self._drop(int(late[0]) if len(late) else 0)

    def bounds(self) -> tuple[tuple[float, float] | None, tuple[float, float] | None]:
        """Limits of x and of y; None where there is no finite value."""
        return limits(self.x), limits(self.y)

    def picture(self, x_range, y_range, columns: int, rows: int) -> tuple[np.ndarray, np.ndarray]:
        """What has to be drawn in a window of columns x rows pixels: x, y.

        :param x_range, y_range: (from, to) that is shown
        """
        if self.ascending:
            shown = visible(self, *x_range)
            return decimate(self.x[shown], self.y[shown], columns, self.dropped + shown.start)
        if len(self) < 20_000:
            return self.x.copy(), self.y.copy()
        # A path that runs anywhere: of consecutive points in one pixel the first is enough.
        with np.errstate(invalid="ignore"):
            pixel = np.floor((self.x - x_range[0]) * (columns / ((x_range[1] - x_range[0]) or 1.0))) * (4 * rows) + np.floor(
                (self.y - y_range[0]) * (rows / ((y_range[1] - y_range[0]) or 1.0))
            )
        keep = np.concatenate(([True], pixel[1:] != pixel[:-1]))
        return self.x[keep], self.y[keep]

    def nearest(self, x: float) -> tuple[float, float] | None:
        """The point whose x is nearest."""
        if not len(self):
            return None
        if self.ascending:
            index = int(np.searchsorted(self.x, x))
            index -= index == len(self) or index > 0 and x - self.x[index - 1] < self.x[index] - x
        else:
            index = int(np.argmin(np.abs(self.x - x)))
        return float(self.x[index]), float(self.y[index])
