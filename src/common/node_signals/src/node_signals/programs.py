"""The program that ``rosrun`` runs, found as Debian's finds it and in this process.

Debian's script starts the search of the catkin workspaces two to four times, each in a Python of its own, before the node begins.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
from typing import NamedTuple

from node_signals import rviz_start
from node_signals.interpreter import as_it_can_run

DEBIANS = "/usr/bin/rosrun"


class Command(NamedTuple):
    """``rosrun [--prefix PREFIX] PACKAGE PROGRAM ARGUMENT...``"""

    prefix: str
    package: str
    program: str
    arguments: list[str]


def command(words: list[str]) -> Command | None:
    """What was typed, ``words[0]`` being rosrun's name; None where Debian's has more to say than what the program says."""
    rest, prefix = words[1:], ""
    while len(rest) > 2 and rest[0] in ("-p", "--prefix"):
        prefix, rest = rest[1], rest[2:]
    if len(rest) < 2 or rest[0].startswith("-"):
        return None
    return Command(prefix, rest[0], rest[1], rest[2:])


def find(package: str, name: str) -> list[str]:
    """The files that could be meant by program ``name`` of ``package``; each is run where there is one, else somebody has to choose.

    A ``name`` with a slash is a place in the package.
    """
    catkins, own = _catkin_folders(["libexec", "share"], package), _folder_of(package)
    if not own:
        return []
    if "/" in name:  # a place in the package
        path = os.path.join(own, name.lstrip("/"))
        return [path] if os.path.isfile(path) and os.access(path, os.X_OK) else []
    found = _executables([*catkins, own], own, name)
    if len(found) == 2:  # a relay in the workspace's development space, and what it stands for
        shared = _catkin_folders(["share"], package)
        relays = [path for path in found if not any(path.startswith(folder) for folder in shared)]
        found = relays if len(relays) == 1 else found
    return found


def _catkin_folders(kinds: list[str], package: str) -> list[str]:
    from node_signals.quick_start import find_in_workspaces

    return list(find_in_workspaces(kinds, project=package, first_matching_workspace_only=True))


def _folder_of(package: str) -> str:
    found = subprocess.run(["rospack", "find", package], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    return found.stdout.strip()


def _executables(folders: list[str], own: str, name: str) -> list[str]:
    """In the order of ``folders``; what two neighbouring folders show is there once."""
    found = subprocess.run(
        ["find", "-L", *folders, "-name", name, "-type", "f", "-perm", "/111", "!", "-regex", f".*{own}/build/.*"],
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    ).stdout.splitlines()
    return [path for path, before in zip(found, ["", *found]) if path != before]


def run(words: list[str]) -> None:
    """Become the program that rosrun's ``words`` mean, if it is clear which it is; otherwise return, when Debian's rosrun has its say. Why
    it will find nothing stands before that.
    """
    asked = command(words)
    if asked is None:
        return
    found = find(asked.package, asked.program)
    if len(found) == 1:
        _refuse_what_is_none(asked.package, found[0])
        program, difference = as_it_can_run(found[0])
        if difference:
            print(f"rosrun: {difference}", file=sys.stderr, flush=True)
        line = [*asked.prefix.split(), *program, *asked.arguments]
        if asked[:3] == ("", "rviz", "rviz"):
            rviz_start.run(line)
        with contextlib.suppress(OSError):  # a script without its first line, a prefix that is no program: the shell's own way with them
            os.execvp(line[0], line)
    elif not found:
        why = _why_nothing(asked.package, asked.program)
        if "That is " in why:  # Debian's would only ask for its executable bit
            sys.exit(f"rosrun: {why}")
        print(f"rosrun: {why}", file=sys.stderr, flush=True)


def _refuse_what_is_none(package: str, path: str) -> None:
    """Launch files and the like that somebody made executable: a shell would read them as its own."""
    from pathlib import Path

    from node_signals.absent import no_program

    with open(path, "rb") as file:
        script = file.read(2) == b"#!"
    why = "" if script else no_program(Path(path), package)
    if why:
        sys.exit(f"rosrun: {os.path.basename(path)} of the package {package} is no program. {why}")


def _why_nothing(package: str, name: str) -> str:
    from node_signals.absent import explanation, of_program

    if not _folder_of(package):
        return f"the package '{package}' is not here. {explanation(package)}"
    return f"the package {package} has no program {name} that can be run. {of_program(package, name)}".rstrip()
