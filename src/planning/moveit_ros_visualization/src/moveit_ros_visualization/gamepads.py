"""Gamepads as the node ``joy`` describes them: which button and which stick is which.

Controls have the names of a PlayStation's pad. A pad is told by how many axes and buttons its messages have.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from sensor_msgs.msg import Joy

STILL = 0.1  # of a stick's way that counts as none


class Pad(NamedTuple):
    """Where the controls are: numbers of buttons, (axis, least value) for what is an axis, and the left stick's axes."""

    buttons: dict[str, int]
    axes: dict[str, tuple[int, float]]
    stick: tuple[int, int] = (0, 1)  # to the left, forward


class Controls(NamedTuple):
    """What is pressed, and the left stick: (to the left, forward), each -1 to 1."""

    pressed: frozenset
    stick: np.ndarray


def _numbered(names: str, numbers: str) -> dict[str, int]:
    return {name: int(number) for name, number in zip(names.split(), numbers.split())}


def _cross(sideways: int, along: int, left: float, up: float) -> dict[str, tuple[int, float]]:
    return {"left": (sideways, left), "right": (sideways, -left), "up": (along, up), "down": (along, -up)}


_FACE = "square circle triangle cross L1 R1 select start"
_XBOX = Pad(_numbered(_FACE, "2 1 3 0 4 5 6 7"), {**_cross(6, 7, 0.1, 0.1), "L2": (2, -0.5), "R2": (5, -0.5)})
_PS3 = "select start square triangle circle cross up down left right L1 R1 L2 R2"

#: (axes, buttons) of the message -> pad
PADS: dict[tuple[int, int], Pad] = {
    (8, 11): _XBOX,
    (27, 19): Pad(_numbered(_PS3, "0 3 15 12 13 14 4 6 7 5 10 11 8 9"), {}),
    (20, 17): Pad(
        _numbered("select start", "0 3"),
        {
            name: (axis, -1e-6)
            for name, axis in _numbered(
                "square up down left right triangle cross circle L1 R1 L2 R2", "15 4 6 7 5 12 14 13 10 11 8 9"
            ).items()
        },
    ),
    (6, 17): Pad(_numbered(_FACE + " L2 R2", "3 1 2 0 4 5 8 9 6 7"), {}),
    (14, 14): Pad(_numbered(_FACE + " L2 R2", "0 2 3 1 4 5 8 9 6 7"), _cross(9, 10, -1e-6, -1e-6)),
    (8, 13): Pad(_numbered(_FACE + " L2 R2", "3 1 2 0 4 5 8 9 6 7"), _cross(6, 7, -1e-6, -1e-6)),
}


def read(message: Joy) -> Controls | None:
    """The controls of a message; None if its pad is not known."""
    pad = PADS.get((len(message.axes), len(message.buttons)))
    if pad is None:
        return None
    pressed = {name for name, number in pad.buttons.items() if message.buttons[number]}
    for name, (axis, least) in pad.axes.items():
        value = message.axes[axis]
        if value > least if least > 0 else value < least:
            pressed.add(name)
    stick = np.array([message.axes[axis] for axis in pad.stick])
    stick[~(np.abs(stick) > STILL)] = 0.0  # and what is no number
    return Controls(frozenset(pressed), np.clip(stick, -1.0, 1.0))
