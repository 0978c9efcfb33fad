"""A building drawn from above."""

from __future__ import annotations

import contextlib
import math
import os
from typing import Any

from PIL import Image, ImageDraw, ImageFont

from building_editor.building import Building, PlanError, Wall
from building_editor.sdf_model import outline

_WIDEST = 20_000  # pixels of a drawing

_PAPER, _GRID, _WALL, _DOOR, _WINDOW, _STEP, _MODEL = (
    (255, 255, 255),
    (226, 230, 234),
    (60, 64, 72),
    (214, 158, 84),
    (86, 156, 214),
    (150, 150, 158),
    (96, 160, 96),
)


def draw(building: Building, width: int = 1000) -> Image.Image:
    """All levels of ``building`` from above, side by side, the lowest first: walls dark, doors brown, windows blue, on a grid of 1 m
    (10, 100 ... for what is larger than 200 m).

    :param width: of one level, pixels; less where there are many.
    """
    x0, y0, x1, y1 = outline(building.levels)
    x0, x1 = (choose([x] + [placed.at[0] for placed in building.models]) for choose, x in ((min, x0), (max, x1)))
    y0, y1 = (choose([y] + [placed.at[1] for placed in building.models]) for choose, y in ((min, y0), (max, y1)))
    margin = 0.05 * max(x1 - x0, y1 - y0) + 0.3
    x0, y0, x1, y1 = x0 - margin, y0 - margin, x1 + margin, y1 + margin
    width = max(20, min(width, _WIDEST // len(building.levels)))
    scale = width / (x1 - x0)
    grid = 10 ** max(0, math.ceil(math.log10(max(x1 - x0, y1 - y0) / 200.0)))
    page = (width, max(1, round((y1 - y0) * scale)))
    image = Image.new("RGB", (page[0] * len(building.levels), page[1]), _PAPER)
    pen = ImageDraw.Draw(image)
    for number, level in enumerate(building.levels):

        def at(x: float, y: float) -> tuple[float, float]:
            return (number * page[0] + (x - x0) * scale, (y1 - y) * scale)

        for x in range(math.ceil(x0 / grid) * grid, math.floor(x1) + 1, grid):
            pen.line([at(x, y0), at(x, y1)], fill=_GRID)
        for y in range(math.ceil(y0 / grid) * grid, math.floor(y1) + 1, grid):
            pen.line([at(x0, y), at(x1, y)], fill=_GRID)
        for stairs in level.stairs:
            for i in range(stairs.steps):
                tread = stairs.depth / stairs.steps
                corners = _turned(stairs.at, stairs.yaw, (i + 0.5) * tread, 0.0, tread, stairs.width)
                pen.polygon([at(*p) for p in corners], outline=_STEP)
        for wall in level.walls:
            _draw_wall(pen, wall, at)
        if number == 0:
            for placed in building.models:
                u, v = at(*placed.at[:2])
                pen.ellipse([u - 5, v - 5, u + 5, v + 5], fill=_MODEL)
                _write(pen, (u + 8, v - 6), placed.name, _MODEL)
        _write(pen, (number * page[0] + 8, 6), f"{building.name}, level {number}   grid {grid} m", _WALL)
    return image


def save(building: Building, path: str) -> None:
    """:func:`draw` of ``building`` to the file ``path``, in the format that its name ends with.

    :raises PlanError: no such format. :raises OSError: the file cannot be written.
    """
    if os.path.splitext(path)[1].lower() not in Image.registered_extensions():
        raise PlanError(f"preview '{path}': give it the ending .png or .jpg")
    image = draw(building)
    try:
        image.save(path)
    except (ValueError, KeyError):  # a format that Pillow reads and does not write
        raise PlanError(f"preview '{path}': give it the ending .png or .jpg") from None


#: Fonts of Debian by how much they know: the last is Pillow's own, of Latin letters alone.
_FONTS = ("NotoSansCJK-Regular.ttc", "wqy-zenhei.ttc", "wqy-microhei.ttc", "DroidSansFallbackFull.ttf", "DejaVuSans.ttf")
_SIZE = 11  # pixels, as large as Pillow's own


def _write(pen: ImageDraw.ImageDraw, at: tuple[float, float], text: str, colour: tuple[int, int, int]) -> None:
    """A name in any script; where no font is there for it, its characters are question marks."""
    try:
        text.encode("latin-1")
    except UnicodeEncodeError:
        font = _font_of(text)
        if font is not None:
            pen.text(at, text, fill=colour, font=font)
            return
        text = text.encode("latin-1", "replace").decode("latin-1")
    pen.text(at, text, fill=colour)


def _font_of(text: str) -> Any:
    """The first font of this machine that has all of its characters, or None."""
    for name in _FONTS:
        with contextlib.suppress(OSError, ImportError):
            font = ImageFont.truetype(name, _SIZE)
            missing = bytes(font.getmask(chr(0x10FFFF)))
            if not any(bytes(font.getmask(character)) == missing for character in text if not character.isspace()):
                return font
    return None


def _draw_wall(pen: ImageDraw.ImageDraw, wall: Wall, at) -> None:
    (before, after), length = wall.reach, wall.length
    pen.polygon(
        [at(*p) for p in _turned(wall.start, wall.yaw, 0.5 * (length + after - before), 0.0, length + before + after, wall.thickness)],
        fill=_WALL,
    )
    for opening in wall.openings:
        corners = _turned(wall.start, wall.yaw, opening.at, 0.0, opening.width, wall.thickness)
        pen.polygon([at(*p) for p in corners], fill=_DOOR if opening.kind == "door" else _WINDOW)


def _turned(origin, yaw: float, x: float, y: float, length: float, width: float):
    """Corners of a rectangle around (x, y) of a frame at ``origin`` turned by ``yaw``."""
    c, s = math.cos(yaw), math.sin(yaw)
    return [
        (origin[0] + c * (x + dx * length) - s * (y + dy * width), origin[1] + s * (x + dx * length) + c * (y + dy * width))
        for dx, dy in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    ]
