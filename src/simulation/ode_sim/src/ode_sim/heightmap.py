"""Height maps: an image to heights in metres, one reader for what collides and what is drawn."""

from __future__ import annotations

import numpy as np

from ode_sim.description.model import DescriptionError, Heightmap, quoted
from ode_sim.images import read_grey

MOST_HEIGHTS = 4097**2  # 250 MB in the collision space


def load_heights(heightmap: Heightmap) -> np.ndarray:
    """(rows, columns) heights of ``heightmap`` in m above the shape's origin; the first row is at +y, the first column at -x.

    White is ``size.z``, black 0.

    :raises DescriptionError: the image cannot be read, or has less than 2x2 pixels.
    """
    if not heightmap.path:
        raise DescriptionError(f"height map image '{quoted(heightmap.uri)}' cannot be found")
    grey = read_grey(heightmap.path, MOST_HEIGHTS)
    if min(grey.shape) < 2:
        raise DescriptionError(f"image {heightmap.path}: a height map must have at least 2x2 pixels")
    return np.ascontiguousarray(grey * heightmap.size[2])


def thinned(heights: np.ndarray, most: int) -> np.ndarray:
    """``heights`` with at most ``most`` rows and columns, over the same ground: the first and the last ones stay."""
    for axis in (0, 1):
        count = heights.shape[axis]
        if count > most:
            places = np.linspace(0.0, count - 1.0, most)
            low = np.minimum(places.astype(int), count - 2)
            part = (places - low).reshape((-1, 1) if axis == 0 else (1, -1))
            heights = heights.take(low, axis) * (1.0 - part) + heights.take(low + 1, axis) * part
    return heights
