#!/usr/bin/env python3
"""Paints the textures of the Gazebo/* materials (ode_sim.description.materials names the files).

Small pictures of our own that repeat without a seam; the same in every run. Run after a change.
"""

from pathlib import Path

import numpy as np
from PIL import Image

HERE = Path(__file__).resolve().parent / "textures"
SIZE = 128
WHITE, YELLOW = (0.85, 0.85, 0.83), (0.80, 0.62, 0.12)


def noise(rng, cells_x, cells_y):
    """Smooth noise from -1 to 1 over the picture, seamless, with so many cells across and up."""
    grid = rng.uniform(-1.0, 1.0, (cells_y, cells_x))
    y, x = np.mgrid[0:SIZE, 0:SIZE] / SIZE
    fx, fy = x * cells_x, y * cells_y
    ix, iy = fx.astype(int), fy.astype(int)
    tx, ty = (t * t * (3 - 2 * t) for t in (fx - ix, fy - iy))

    def at(dx, dy):
        return grid[(iy + dy) % cells_y, (ix + dx) % cells_x]

    return (at(0, 0) * (1 - tx) + at(1, 0) * tx) * (1 - ty) + (at(0, 1) * (1 - tx) + at(1, 1) * tx) * ty


def tinted(colour, light):
    """``colour`` (0..1) lightened and darkened by ``light`` (H, W)."""
    return np.asarray(colour) * (1.0 + light[..., None])


def grain(rng):
    return 0.08 * noise(rng, 4, 48) + 0.06 * noise(rng, 2, 16) + 0.03 * noise(rng, 16, 64)


def wood(rng):
    return tinted((0.62, 0.43, 0.26), grain(rng))


def boards(rng, colour, count, gap):
    """Boards along x with dark joints."""
    row = np.arange(SIZE) * count // SIZE
    shade = rng.uniform(-0.12, 0.12, count)[row][:, None]
    image = tinted(colour, grain(rng) + shade)
    image[(np.arange(SIZE) * count % SIZE) < gap * count] *= 0.45
    return image


def bricks(rng):
    rows, columns, joint = 8, 4, 3
    y, x = np.mgrid[0:SIZE, 0:SIZE]
    row = y * rows // SIZE
    shifted = (x + (row % 2) * SIZE // (2 * columns)) % SIZE
    shade = rng.uniform(-0.15, 0.15, (rows, columns))[row, shifted * columns // SIZE]
    image = tinted((0.58, 0.28, 0.22), shade + 0.08 * noise(rng, 32, 32))
    mortar = ((y % (SIZE // rows)) < joint) | ((shifted % (SIZE // columns)) < joint)
    image[mortar] = tinted((0.68, 0.66, 0.62), 0.05 * noise(rng, 32, 32))[mortar]
    return image


def ceiling_tiled(rng):
    image = tinted((0.84, 0.84, 0.81), 0.04 * noise(rng, 64, 64) - 0.12 * (rng.random((SIZE, SIZE)) > 0.97))
    lines = np.arange(SIZE) % (SIZE // 4) < 2
    image[lines], image[:, lines] = 0.62, 0.62
    return image


def painted_wall(rng):
    return tinted((0.85, 0.83, 0.78), 0.02 * noise(rng, 32, 32) + 0.015 * noise(rng, 8, 8))


def grass(rng):
    return tinted((0.28, 0.42, 0.18), 0.25 * noise(rng, 64, 64) + 0.15 * noise(rng, 16, 16) + 0.08 * noise(rng, 4, 4))


def road(rng):
    return tinted((0.28, 0.28, 0.29), 0.15 * noise(rng, 64, 64) + 0.05 * noise(rng, 8, 8))


def lanes(rng, count):
    """A road seen from above that goes up, once across: white at its edges, two lines between the directions, dashes between lanes."""
    image = np.kron(road(rng), np.ones((2, 2, 1)))
    size = len(image)
    across = (np.arange(size) + 0.5) / size
    thick = 0.018 if count < 4 else 0.011

    def line(place, colour, most=1.0):
        image[: int(most * size), np.abs(across - place) < thick / 2] = colour

    for edge in (0.035, 0.965):
        line(edge, WHITE)
    for number in range(1, count):
        place = 0.035 + 0.93 * number / count
        if 2 * number == count:
            line(place - thick, YELLOW)
            line(place + thick, YELLOW)
        else:
            line(place, WHITE, 0.5)
    return image


def runway(rng):
    image = lanes(rng, 1)
    size = len(image)
    image[: size // 2, size // 2 - 4 : size // 2 + 4] = WHITE
    return image


TEXTURES = {
    "wood": wood,
    "wood_floor": lambda rng: boards(rng, (0.55, 0.36, 0.20), 6, 2),
    "wood_pallet": lambda rng: boards(rng, (0.70, 0.55, 0.36), 4, 6),
    "bricks": bricks,
    "ceiling_tiled": ceiling_tiled,
    "painted_wall": painted_wall,
    "grass": grass,
    "road": lambda rng: lanes(rng, 2),
    "road_1": lambda rng: lanes(rng, 1),
    "road_4": lambda rng: lanes(rng, 4),
    "road_6": lambda rng: lanes(rng, 6),
    "runway": runway,
}

if __name__ == "__main__":
    for number, (name, paint) in enumerate(TEXTURES.items()):
        pixels = np.clip(paint(np.random.default_rng(number)) * 255.0, 0, 255).astype(np.uint8)
        Image.fromarray(pixels).quantize(32).save(HERE / f"{name}.png", optimize=True)
