"""Label colours of nodes in what the terminal can show."""

from __future__ import annotations

import colorsys
import os
from collections.abc import Mapping

#: Text and background of labels on 16 colours. Light text is on the dark three (97 is unknown to some, which then keep 37). Yellow is
#: left out: it is a dark brown on some consoles, a bright yellow on others.
_ANSI = ("30;42", "37;97;44", "30;46", "37;97;45", "30;47", "37;97;41")
RESET = "\x1b[0m"
LEVELS = {"debug": "\x1b[32m", "info": "", "warn": "\x1b[33m", "error": "\x1b[31m"}


def mode(environment: Mapping[str, str] = os.environ) -> str:
    """``truecolor``, ``256colors`` or ``ansi``."""
    asked = environment.get("ROSMON_COLOR_MODE", "")
    if asked in ("truecolor", "256colors", "ansi"):
        return asked
    if environment.get("COLORTERM", "") in ("truecolor", "24bit"):
        return "truecolor"
    return "256colors" if "256" in environment.get("TERM", "") else "ansi"


def rgb(index: int, count: int) -> tuple[int, int, int]:
    """The colour of ``index`` of ``count``, 0 to 255: evenly spread hues, light enough for black text."""
    red, green, blue = (round(255 * c) for c in colorsys.hsv_to_rgb(index / max(1, count), 0.45, 0.9))
    return red, green, blue


def label_escape(index: int, count: int, colour_mode: str) -> str:
    """Escape sequence that starts the label of node ``index`` of ``count``: a colour of its own below text that can be read on it.

    :param colour_mode: what the terminal can show: "truecolor", "256colors" or "ansi".
    """
    if colour_mode == "ansi":
        return f"\x1b[{_ANSI[index % len(_ANSI)]}m"
    r, g, b = rgb(index, count)
    if colour_mode == "truecolor":
        return f"\x1b[30;48;2;{r};{g};{b}m"
    return f"\x1b[30;48;5;{16 + 36 * round(r / 51) + 6 * round(g / 51) + round(b / 51)}m"
