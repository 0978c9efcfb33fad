"""Height maps: an image to heights in metres."""
from __future__ import annotations

import numpy as np

from ode_sim.description.model import DescriptionError, Heightmap


def load_heights(heightmap: Heightmap) -> np.ndarray:
    """(N, N) heights in m above the shape's origin; the first row is at +y, the first column at -x.

    White is ``size.z``, black 0.

    :raises DescriptionError: the image cannot be read.
    """
    from PIL import Image
    if not heightmap.path:
        raise DescriptionError(f"height map image '{heightmap.uri}' cannot be found")
    try:
        with Image.open(heightmap.path) as image:
            grey = np.asarray(image.convert("I" if image.mode.startswith("I") else "L"), dtype=float)
            full = 65535.0 if image.mode.startswith("I") else 255.0
    except OSError as error:
        raise DescriptionError(f"height map image {heightmap.path} cannot be read: {error}") from None
    return np.ascontiguousarray(np.clip(grey / full, 0.0, 1.0) * heightmap.size[2])
