"""``rosrun launch_gallery measure PACKAGE/FILE.launch``: does this robot drive, turn, stand, and do its sensors speak?

The launch file runs alone, without a window. When the robot has come up it stands for a minute, drives straight and turns,
and what it did in truth, as the simulator knows it, is set against what it was told. Prints one row of a Markdown table.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import re
import shlex
import signal
import sys

from rviz_offscreen.errors import DisplayError

from . import row, session
from .launches import Launch, LaunchError, arguments, content, find

_ERROR = re.compile(
    r"\[ *(?:ERROR|FATAL)\] *(?:\[[^\]]*\]:? *)*(.*)|(.*process has died.*)"
    r"|^((?:ERROR|error|RLException):? .*)"
)


def parser() -> argparse.ArgumentParser:
    p = argparse.ArgumentParser(
        prog="measure", description=__doc__, epilog=main.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = p.add_argument
    add(
        "targets",
        nargs="+",
        metavar="PACKAGE/FILE.launch | PATH | ARG:=VALUE",
        help="what to launch, several files together; windows are off by themselves: gui:=false rviz:=false",
    )
    add("--output", "-o", default="out/measure", help="folder for picture, figures and log (default out/measure)")
    add("--name", help="of these files (default: the launch file's)")
    add("--model", default="", help="robot in the simulation (default: the movable model with most joints, of several the last)")
    add("--command", default="", help="topic of Twist, TwistStamped or Ackermann messages (default: the best cmd_vel)")
    add("--speed", type=float, default=0.3, help="straight on, m/s (default 0.3; 0: not)")
    add("--aside", type=float, default=0.0, help="to the left, m/s, for robots that can (default 0: not)")
    add("--turn", type=float, default=0.5, help="rad/s, or steering angle in rad for Ackermann messages (default 0.5; 0: not)")
    add("--turn-speed", type=float, default=0.0, help="speed while turning, m/s (default 0; cars need one)")
    add("--wheelbase", type=float, default=0.0, help="m, of a car that is told its steering angle: its turn is set against geometry")
    add("--drive", type=float, default=10.0, help="seconds of simulation for each motion, after 2 to get going (default 10; 0: none)")
    add("--settle", type=float, default=5.0, help="seconds of simulation before anything counts (default 5)")
    add("--stand", type=float, default=60.0, help="seconds of simulation to stand still (default 60; 0: not)")
    add("--listen", type=float, default=5.0, help="seconds of simulation to listen to the sensors (default 5; 0: not)")
    add("--slow", type=float, default=0.25, help="simulated seconds per second while listening to sensors (default 0.25)")
    add(
        "--lockstep",
        action="store_true",
        help="physics waits for every picture: rates of cameras are then those of simulated time, however busy the machine",
    )
    add("--factor", type=float, help="simulated seconds per second while driving (default: the world's own; 0: as fast as it goes)")
    add("--reach", type=float, default=0.0, help="rad or m that each joint of the trajectory controllers is moved by (default 0: not)")
    add(
        "--no-display",
        dest="windows",
        action="store_false",
        help="no display for RViz and other windows: they end at once, which saves a slow machine their work",
    )
    add("--no-picture", dest="picture", action="store_false", help="no picture of the robot")
    add("--view", default="iso", help="of the picture: iso, front, side, top ... (default iso)")
    add("--timeout", type=float, default=90.0, help="seconds to wait for the nodes (default 90)")
    return p


def errors(log: str, most: int = 4) -> list[str]:
    """Different lines of the file ``log`` in which something complained, the first ``most`` of them."""
    found: list[str] = []
    for line in session.lines(log):
        match = _ERROR.search(line)
        said = next(filter(None, match.groups()), "") if match else ""
        if said and said not in found:
            found.append(said)
    return found[:most] + ([f"and {len(found) - most} more errors in the log"] if len(found) > most else [])


def measure(launches: list[Launch], given: dict[str, str], options: argparse.Namespace) -> dict:
    """The figures, as :mod:`.measuring` finds them, with the notes of what went wrong.

    :param launches: run together. :param given: their arguments by name. :param options: of the command line
    :raises LaunchError: a launch file cannot be read, or lacks an argument.
    """
    values: dict[str, str] = {}
    nodes: list[str] = []
    passing: list[str] = []
    for launch in launches:
        own = arguments(launch, given)
        shown = content(launch, own)
        values.update(own)
        nodes += shown.nodes
        passing += shown.passing
    folder = os.path.abspath(options.output)
    os.makedirs(folder, exist_ok=True)
    stem = options.name or re.sub(r"\W+", "-", launches[-1].name.replace(".launch", ""))
    log = os.path.join(folder, f"{stem}.log")
    job = {**vars(options), "folder": folder, "stem": stem, "log": log, "nodes": nodes, "passing": passing}
    words = [*(launch.path for launch in launches), *(f"{name}:={value}" for name, value in values.items())]
    figures = os.path.join(folder, f"{stem}.json")
    with contextlib.suppress(FileNotFoundError):
        os.remove(figures)
    try:
        outcome = session.look(
            "launch_gallery.measuring", words, log, job, options.windows, {"ODE_SIM_LOCKSTEP": "1"} if options.lockstep else {}
        )
    except KeyboardInterrupt:
        outcome = session.Outcome(notes=["interrupted"])
        if os.path.exists(figures):
            with open(figures) as file:
                outcome.answer = json.load(file)
    found = outcome.answer or {"notes": []}
    found["notes"] = outcome.notes + found["notes"]
    found["errors"] = errors(log)
    typed = [word for launch in launches for word in launch.words]
    typed += [f"{name}:={value}" for name, value in given.items()]
    name = launches[-1].name.replace(".launch", "")
    found["row"] = row.row(name, row.source(launches[-1].path), shlex.join(["roslaunch", *typed]), found, options.wheelbase)
    with open(figures, "w") as file:
        json.dump(found, file, indent=1)
    return found


def main(argv: list[str] | None = None) -> int:
    """Exit code 0: the robot came up and was measured; 1: it did not; 2: wrong options."""
    options = parser().parse_args(sys.argv[1:] if argv is None else argv)
    given = dict(word.split(":=", 1) for word in options.targets if ":=" in word)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        launches = [launch for target in options.targets if ":=" not in target for launch in find(target)]
        if not launches:
            raise LaunchError("name a launch file")
        found = measure(launches, given, options)
    except (LaunchError, DisplayError, OSError) as error:
        print(f"measure: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:  # before anything came up
        return 130
    print(found["row"])
    for line in found["errors"]:
        print(f"  printed: {line}")
    return 0 if "model" in found else 1
