"""The picture of a height map's ground: its layers' pictures, tiled, one over the other by height."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from ode_sim.description.model import GroundLayer, Heightmap

_WIDEST = 2048  # pixels along a side
_TILE = 128  # pixels that a tile is given where they suffice


def painted(shape: Heightmap, heights: np.ndarray, image: Callable[[GroundLayer], np.ndarray | None]) -> np.ndarray:
    """(N,N,4) uint8 RGBA, first row at +y, first column at -x. Tiles begin at that corner and stand upright for who looks down with +y
    upwards, as in a real Gazebo 11.1.

    :param shape: with at least one layer. :param heights: (rows, columns) m, likewise. :param image: of a layer, RGBA, first row on top;
        None: its colour.
    """
    extent = np.maximum(np.abs(shape.size[:2]), 1e-6)
    smallest = max(min((layer.size for layer in shape.layers if layer.size > 0), default=1.0), extent.max() * _TILE / _WIDEST)
    count = int(np.clip(extent.max() / smallest * _TILE, 64, _WIDEST))
    along = (np.arange(count) + 0.5) / count
    height = _sampled(heights, along) - heights.min()
    seen = np.zeros((count, count, 3), np.float32)
    for number, layer in enumerate(shape.layers):
        pixels = image(layer)
        over = _tiled(pixels, extent / (layer.size or 1.0), along) if pixels is not None else np.array(layer.colour, np.float32) * 255
        part = np.clip((height - layer.min_height) / max(layer.fade, 1e-6), 0.0, 1.0)[..., None] if number else 1.0
        seen += (over - seen) * np.float32(part)
    return np.dstack([np.rint(seen).astype(np.uint8), np.full((count, count), 255, np.uint8)])


def _sampled(heights: np.ndarray, along: np.ndarray) -> np.ndarray:
    """Heights at the middles of the picture's pixels."""
    rows, columns = (np.rint(along * (size - 1)).astype(int) for size in heights.shape)
    return heights[np.ix_(rows, columns)]


def _tiled(pixels: np.ndarray, tiles: np.ndarray, along: np.ndarray) -> np.ndarray:
    """(N,N,3) of a picture that is repeated ``tiles`` times along x and along y."""
    high, wide = pixels.shape[:2]
    # pixels of the picture that are one of the ground's; at most all of them
    step_u, step_v = (min(size, max(1, int(size * tile / len(along)))) for size, tile in zip((wide, high), tiles))
    high, wide = high // step_v, wide // step_u
    pixels = pixels[: high * step_v, : wide * step_u, :3].reshape(high, step_v, wide, step_u, 3).mean(axis=(1, 3))
    u = (along * tiles[0] % 1.0 * wide).astype(int)  # of a column of the picture of the ground
    v = (along * tiles[1] % 1.0 * high).astype(int)  # of a row
    return pixels[v[:, None], u[None, :]]
