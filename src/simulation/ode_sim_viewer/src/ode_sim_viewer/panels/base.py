"""What every tab of the page is."""

from __future__ import annotations

import html
from collections.abc import Callable
from typing import Any

from ode_sim_viewer.simulation import Frame, WorldRecord


class Panel:
    """Made inside its tab: the constructor adds what it shows to ``page.server.gui``.

    :cvar title: of the tab; '' = no tab: controls that are not seen, which the tools and menus of the frame press
    :cvar upper: beside the tree of the world, else among the lists below it
    """

    title = ""
    upper = False

    def __init__(self, page: Any):
        self.page = page
        self.gui = page.server.gui
        self.simulation = page.simulation

    def on_world(self, world: WorldRecord) -> None:
        """Another world, a change of what is in it, or all of it drawn anew. Drawing thread."""

    def on_frame(self, frame: Frame) -> None:
        """Show what is in ``frame``. Five times a second, in the drawing thread."""

    def on_move(self, frame: Frame) -> None:
        """For every frame that is drawn, up to thirty a second. Drawing thread."""

    def on_models(self) -> None:
        """An editor has saved: the model path has other models. Drawing thread."""

    def on_absent(self) -> None:
        """The simulator has gone. Drawing thread."""

    def on_click(self, button: Any, f: Callable[[], Any]) -> None:
        """``f()`` when ``button`` is pressed by a page that may act."""
        button.on_click(lambda event: self.page.attempt(event, f))

    def on_update(self, control: Any, f: Callable[[Any], Any]) -> None:
        """``f(value)`` when a page that may act changes ``control``."""
        control.on_update(lambda event: self.page.attempt(event, lambda: f(event.target.value)))


def escaped(text: object) -> str:
    """For add_html: a name is text, whatever is in it."""
    return html.escape(str(text))


def note(text: object) -> str:
    """For add_html: ``text`` as a small line."""
    return f"<div style='padding:0 0.6em;font-size:0.8em'>{escaped(text)}</div>"


def counted(number: int, thing: str) -> str:
    """``number`` and ``thing``: ``1 wall``, ``2 walls``."""
    return f"{number} {thing}" if number == 1 else f"{number} {thing}s"


def free_name(name: str, taken: Any) -> str:
    """``name``, or where ``taken`` has it ``name_0``, ``name_1`` ... as Gazebo's window names what it inserts."""
    if name not in taken:
        return name
    number = 0
    while f"{name}_{number}" in taken:
        number += 1
    return f"{name}_{number}"
