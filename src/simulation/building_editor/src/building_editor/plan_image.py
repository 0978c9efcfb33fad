"""Walls found in the picture of a floor plan."""

from __future__ import annotations

import numpy as np
from ode_sim.description.model import DescriptionError
from ode_sim.images import read_rgba

from building_editor.plan_file import PlanError

Rectangle = tuple[float, float, float, float]  # x0, y0, x1, y1
_MOST_RECTANGLES = 5000
_MOST_PIXELS = 16_000_000


def wall_rectangles(
    path: str, resolution: float, origin: tuple[float, float], occupied: float = 0.5, negate: bool = False
) -> list[Rectangle]:
    """The dark areas of the image ``path`` as upright rectangles, in metres.

    :param resolution: m per pixel. :param origin: x, y of the lower left corner, m.
    :param occupied: as in map_server, how dark (0 white, 1 black) a wall is at least. :param negate: walls are light.
    :raises PlanError: no image, nothing dark in it, or so many slanted edges that it is no floor plan.
    """
    try:
        rgba = read_rgba(path, _MOST_PIXELS)
    except DescriptionError as error:
        raise PlanError(error) from None
    alpha = rgba[..., 3] / 255.0
    # what is transparent is white paper
    light = sum(rgba[..., channel].astype(float) for channel in range(3)) / 3.0 / 255.0 * alpha + (1.0 - alpha)
    dark = light if negate else 1.0 - light
    rectangles = _merged_runs(dark >= occupied)
    if not rectangles:
        raise PlanError(f"image {path}: nothing in it is dark enough to be a wall")
    if len(rectangles) > _MOST_RECTANGLES:
        raise PlanError(
            f"image {path}: more than {_MOST_RECTANGLES} pieces of wall; use a cleaner or coarser picture whose walls stand upright"
        )
    height = dark.shape[0]
    return [
        (
            origin[0] + c0 * resolution,
            origin[1] + (height - r1) * resolution,
            origin[0] + c1 * resolution,
            origin[1] + (height - r0) * resolution,
        )
        for r0, c0, r1, c1 in rectangles
    ]


def _merged_runs(mask: np.ndarray) -> list[tuple[int, int, int, int]]:
    """Disjoint rectangles (row0, column0, row1, column1) that cover ``mask``: equal runs of rows joined.

    No more than are too many.
    """
    done: list[tuple[int, int, int, int]] = []
    open_runs: dict[tuple[int, int], int] = {}  # (column0, column1) -> first row
    for row in range(mask.shape[0] + 1):
        line = mask[row] if row < mask.shape[0] else np.zeros(mask.shape[1], bool)
        edges = np.flatnonzero(np.diff(np.concatenate(([0], line.astype(np.int8), [0]))))
        runs = set(zip(map(int, edges[::2]), map(int, edges[1::2])))
        for run in [run for run in open_runs if run not in runs]:
            done.append((open_runs.pop(run), run[0], row, run[1]))
        for run in runs:
            open_runs.setdefault(run, row)
        if len(done) > _MOST_RECTANGLES:
            break
    return sorted(done)
