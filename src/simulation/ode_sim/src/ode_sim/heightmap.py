"""Height maps: an image to heights in metres, one reader for what collides and what is drawn."""

from __future__ import annotations

import numpy as np

from ode_sim.description.model import DescriptionError, Heightmap, quoted
from ode_sim.images import read_relief

MOST_HEIGHTS = 4097**2  # 250 MB in the collision space


def load_heights(heightmap: Heightmap) -> np.ndarray:
    """(rows, columns) heights of ``heightmap`` in m above the shape's origin; the first row is at +y, the first column at -x.

    The brightest pixel is ``size.z``, black 0: real Gazebo 11.1 scales so (``scripts/truth compare heightmap_dim``). With a negative
    ``size.z`` the heights of its absolute value are taken from 1 m, as there.

    :raises DescriptionError: the image cannot be read, or has less than 2x2 pixels.
    """
    if not heightmap.path:
        raise DescriptionError(f"height map image '{quoted(heightmap.uri)}' cannot be found")
    relief = read_relief(heightmap.path, MOST_HEIGHTS)
    if min(relief.shape) < 2:
        raise DescriptionError(f"image {heightmap.path}: a height map must have at least 2x2 pixels")
    heights = relief * (abs(heightmap.size[2]) / (relief.max() or 1.0))
    return np.ascontiguousarray(heights if heightmap.size[2] >= 0.0 else 1.0 - heights)


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
