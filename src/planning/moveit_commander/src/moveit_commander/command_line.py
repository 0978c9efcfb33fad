"""The program moveit_commander_cmdline.py."""

from __future__ import annotations

import argparse
import os
import readline
import sys

import rospy

from .exception import MoveItCommanderException
from .interpreter import MoveGroupCommandInterpreter, MoveGroupInfoLevel
from .roscpp_initializer import roscpp_initialize

_COLOURS = {
    MoveGroupInfoLevel.FAIL: "\033[91m",
    MoveGroupInfoLevel.WARN: "\033[93m",
    MoveGroupInfoLevel.SUCCESS: "\033[92m",
    MoveGroupInfoLevel.DEBUG: "\033[94m",
}
_HEADER, _PLAIN = "\033[95m", "\033[0m"


class Completer:
    """Completes commands and what follows them."""

    def __init__(self, options: dict[str, list[str]]):
        self.options = options
        self._matches: list[str] = []

    def complete(self, text: str, state: int) -> str | None:
        """The ``state``-th completion of ``text``, for readline."""
        if state == 0:
            words = readline.get_line_buffer().split()
            first = words[0] if words and (len(words) > 1 or not text) else ""
            choices = self.options.get(first, []) if first else list(self.options)
            self._matches = sorted(choice for choice in choices if choice.startswith(text))
        return self._matches[state] + " " if state < len(self._matches) else None


def main(arguments: list[str] | None = None) -> int:
    """Read commands until the end of the input; the exit code."""
    parser = argparse.ArgumentParser(prog="moveit_commander_cmdline.py", description="Command Line Interface to MoveIt")
    parser.add_argument("-i", "--interactive", action="store_true", help="read commands from the terminal (default)")
    parser.add_argument("-s", "--service", action="store_true", help="only keep the node running")
    parser.add_argument("group_name", nargs="?", default="", help="group to start with")
    options = parser.parse_args((rospy.myargv() if arguments is None else arguments)[1:])
    roscpp_initialize(sys.argv)
    rospy.init_node("move_group_interface_cmdline", anonymous=True, disable_signals=True)
    try:
        interpreter = MoveGroupCommandInterpreter()
    except (RuntimeError, MoveItCommanderException) as error:
        print(f"{_COLOURS[MoveGroupInfoLevel.FAIL]}{error}{_PLAIN}")
        return 1
    if options.group_name:
        _show(*interpreter.execute(f"use {options.group_name}"))
    if options.service:
        rospy.spin()
    else:
        _read(interpreter)
    print("Bye bye!")
    return 0


def _read(interpreter: MoveGroupCommandInterpreter) -> None:
    completer = Completer({**interpreter.get_keywords(), "quit": []})
    readline.set_completer(completer.complete)
    readline.parse_and_bind("tab: complete")
    print(f"\n{_HEADER}Waiting for commands. Type 'help' to get a list of known commands.{_PLAIN}\n")
    while not rospy.is_shutdown():
        group = interpreter.get_active_group()
        try:
            line = input(f"{_COLOURS[MoveGroupInfoLevel.DEBUG]}{group.get_name() if group else ''}> {_PLAIN}").strip()
        except (EOFError, KeyboardInterrupt):
            return
        if line.lower() in ("q", "quit", "exit"):
            return
        if line.lower() == "host":
            print(f"Master is '{os.environ['ROS_MASTER_URI']}'")
        elif line:
            _show(*interpreter.execute(line))
            completer.options = {**interpreter.get_keywords(), "quit": []}


def _show(level: int, text: str) -> None:
    colour = _COLOURS.get(level, "")
    print(f"{colour}{text}{_PLAIN if colour else ''}")
