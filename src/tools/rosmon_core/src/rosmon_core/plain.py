"""Output without keys: lines for a log file, a pipe, or a terminal with --disable-ui."""

from __future__ import annotations

import re
import sys

from rosmon_core import colors, severity

_COLOUR = re.compile(r"(\x1b\[[0-9;]*m)")


class Plain:
    """``label: text``, with colours only on a terminal."""

    def __init__(self, labels, flush: bool) -> None:
        self._width = max(map(len, labels))
        self._count = len(labels) - 1
        self._flush = flush
        self._colour = colors.mode() if sys.stdout.isatty() else None

    def show(self, label: str, text: str, level: str, index: int | None) -> None:
        """Print a line: ``text`` of ``level`` by ``label``, node ``index`` (None: rosmon itself)."""
        if self._colour:
            print(format_line(label, text, level, index, self._width, self._count, self._colour), flush=self._flush)
        else:
            print(f"{label:>{self._width}}: {severity.without_escapes(text)}", flush=self._flush)

    def flush(self) -> None:
        sys.stdout.flush()


def format_line(label: str, text: str, level: str, index: int | None, width: int, count: int, mode: str, columns: int = 0) -> str:
    """A line with a coloured, right-aligned label of ``width`` columns.

    :param text, level: what is said, and how serious it is. :param index: of ``count`` nodes; None: rosmon itself.
    :param mode: see :func:`colors.label_escape`.
    :param columns: of the terminal; longer lines go on in the next one behind a ``~``. 0: never.
    """
    start = "\x1b[7m" if index is None else colors.label_escape(index, count, mode)
    pieces = _wrap(colors.LEVELS[level] + severity.only_colours(text), columns - width - 2)
    return "\n".join(f"{start}{label if i == 0 else '~':>{width}}:{colors.RESET} {piece}{colors.RESET}" for i, piece in enumerate(pieces))


def _wrap(text: str, width: int) -> list[str]:
    """Pieces of at most ``width`` visible characters, each starting with the colours in force."""
    if width < 8 or len(text) <= width:
        return [text]
    pieces, piece, used, colour = [], "", 0, ""
    for part in _COLOUR.split(text):
        if _COLOUR.fullmatch(part):
            colour += part
            piece += part
            continue
        for character in part:
            if used == width:
                pieces.append(piece)
                piece, used = colour, 0
            piece += character
            used += 1
    return [*pieces, piece]
