"""``rosrun launch_gallery gallery PACKAGE...``: a page with pictures of what each launch file brings up.

Each launch file runs alone, with a ROS master and a display of its own. When its nodes have come up, pictures are taken of
the simulated scene, of RViz (with the launch file's own set-up, or one made of all that is published) and of every camera.
"""

from __future__ import annotations

import argparse
import os
import re
import shlex
import signal
import sys

from rviz_offscreen.errors import DisplayError

from . import session
from .launches import Launch, LaunchError, arguments, content, find
from .page import Entry, render


def parser() -> argparse.ArgumentParser:
    p = argparse.ArgumentParser(
        prog="gallery", description=__doc__, epilog=main.__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    p.add_argument(
        "targets",
        nargs="+",
        metavar="PACKAGE | PACKAGE/FILE.launch | PATH | ARG:=VALUE",
        help="what to launch; ARG:=VALUE goes to every launch file that declares ARG "
        "(windows are off by themselves: gui:=false rviz:=false)",
    )
    p.add_argument("--output", "-o", default="out/gallery", help="folder for index.html and the pictures (default out/gallery)")
    p.add_argument(
        "--drive",
        nargs=3,
        type=float,
        metavar=("SPEED", "TURN", "SECONDS"),
        help="drive robots that listen to velocity commands, m/s and rad/s, while RViz watches",
    )
    p.add_argument("--size", default="1280x800", help="WIDTHxHEIGHT of the RViz window (default 1280x800)")
    p.add_argument("--timeout", type=float, default=60.0, help="seconds to wait for nodes and for displays (default 60)")
    return p


def visit(launch: Launch, given: dict[str, str], folder: str, options: argparse.Namespace) -> Entry:
    """Run ``launch``, take pictures, stop. Never raises for what is wrong with the launch file: the entry's notes say it.

    :param given: arguments by name. :param folder: where the pictures go. :param options: of the command line
    """
    entry = Entry(launch.name, shlex.join(["roslaunch", *launch.words]))
    try:
        values = arguments(launch, given)
        shown = content(launch, values)
    except LaunchError as error:
        entry.notes.append(str(error))
        return entry
    entry.command = shlex.join(["roslaunch", *launch.words, *(f"{name}:={value}" for name, value in values.items())])
    stem = re.sub(r"\W+", "-", launch.name.replace(".launch", ""))
    log = os.path.join(folder, f"{stem}.log")
    job = {
        "folder": folder,
        "stem": stem,
        "log": log,
        "config": shown.rviz,
        "nodes": shown.nodes,
        "passing": shown.passing,
        "timeout": options.timeout,
        "size": options.size,
        "drive": options.drive,
    }
    words = [launch.path, *(f"{name}:={value}" for name, value in values.items())]
    outcome = session.look("launch_gallery.visit", words, log, job)
    entry.notes += outcome.notes
    if outcome.answer:
        entry.pictures += [tuple(picture) for picture in outcome.answer["pictures"]]
        entry.notes += outcome.answer["notes"]
    return entry


def main(argv: list[str] | None = None) -> int:
    """Exit code 0: every launch file has pictures; 1: one has none, or there was nothing to launch; 2: wrong options."""
    options = parser().parse_args(sys.argv[1:] if argv is None else argv)
    given = dict(word.split(":=", 1) for word in options.targets if ":=" in word)
    folder = os.path.abspath(options.output)
    entries: list[Entry] = []
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        launches = [launch for target in options.targets if ":=" not in target for launch in find(target)]
        os.makedirs(folder, exist_ok=True)
        for launch in launches:
            entries.append(visit(launch, given, folder, options))
            print(f"{entries[-1].command}: {len(entries[-1].pictures)} pictures", flush=True)
            for note in entries[-1].notes:
                print(f"  {note}", flush=True)
            with open(os.path.join(folder, "index.html"), "w") as file:
                file.write(render("Gallery", entries))
    except (LaunchError, DisplayError, OSError) as error:
        print(f"gallery: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    print(os.path.join(folder, "index.html"))
    return 0 if entries and all(entry.pictures for entry in entries) else 1
