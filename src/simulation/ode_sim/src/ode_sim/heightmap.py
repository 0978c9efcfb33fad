"""Height maps: an image to heights in metres."""
from __future__ import annotations

import numpy as np

from ode_sim.description.model import DescriptionError, Heightmap, quoted
from ode_sim.images import read_grey

MOST_HEIGHTS = 4097 ** 2  # 250 MB in the collision space


def load_heights(heightmap: Heightmap) -> np.ndarray:
    """(N, N) heights in m above the shape's origin; the first row is at +y, the first column at -x.

    White is ``size.z``, black 0.

    :raises DescriptionError: the image cannot be read.
    """
    if not heightmap.path:
        raise DescriptionError(f"height map image '{quoted(heightmap.uri)}' cannot be found")
    return np.ascontiguousarray(read_grey(heightmap.path, MOST_HEIGHTS) * heightmap.size[2])
