"""Nodes that a launch file gives a window of their own, ``launch-prefix="xterm -e"``, where there is no such window to be had.

Upstream's roslaunch stops everything where the terminal is not installed, and without a display the terminal ends before its node begins.
"""

from __future__ import annotations

import os
import shutil

from node_signals.display import missing_display

_TERMINALS = {
    "gnome-terminal",
    "konsole",
    "lxterminal",
    "mate-terminal",
    "qterminal",
    "rxvt",
    "terminator",
    "tilix",
    "urxvt",
    "uxterm",
    "x-terminal-emulator",
    "xfce4-terminal",
    "xterm",
}
_COMMAND_FOLLOWS = ("-e", "-x", "--", "--execute", "--command")


def command_in_terminal(words: list[str]) -> list[str] | None:
    """What a terminal is asked to run: the words behind its ``-e``. None if these words start no terminal, or one for a shell."""
    if not words or os.path.basename(words[0]) not in _TERMINALS:
        return None
    at = next((number for number, word in enumerate(words) if word in _COMMAND_FOLLOWS), len(words))
    return words[at + 1 :] or None


def with_what_is_there(words: list[str]) -> tuple[list[str], str]:
    """The command of a node, ``words``, as it can be run here, and a line saying what is different, or "".

    With a display and another terminal the node gets that one. Otherwise it runs as nodes do that have no window.
    """
    command = command_in_terminal(words)
    if command is None:
        return words, ""
    terminal = words[0]
    if missing_display():
        return command, f"{terminal} would open a window, and there is no display: it runs without, and reads nothing from a keyboard"
    if shutil.which(terminal):
        return words, ""
    other = next((name for name in ("x-terminal-emulator", "xterm") if shutil.which(name)), None)
    install = f"sudo apt install {os.path.basename(terminal)}"
    if other:
        return [other, "-e", *command], f"{terminal} is not installed ({install}): {other} takes its place"
    return command, f"{terminal} is not installed ({install}): it runs without a window, and reads nothing from a keyboard"
