"""``rosrun launch_gallery gallery PACKAGE...``: a page with pictures of what each launch file brings up.

Each launch file runs alone, with a ROS master and a display of its own. When its nodes have come up, pictures are taken of
the simulated scene, of RViz (with the launch file's own set-up, or one made of all that is published) and of every camera.
"""
from __future__ import annotations

import argparse
import contextlib
import json
import os
import re
import shlex
import signal
import socket
import subprocess
import sys
import tempfile
from typing import Dict, Iterator, List, Optional

from rviz_offscreen.display import DisplayError, private_display

from .launches import Launch, LaunchError, arguments, content, find
from .page import Entry, render

# what roslaunch prints while it ends, whatever the reason
_FAREWELL = re.compile(r"shutting down|^done$|^log file:|killing on exit|^Initiating|^process has died|^The traceback")


def parser() -> argparse.ArgumentParser:
    p = argparse.ArgumentParser(prog="gallery", description=__doc__, epilog=main.__doc__,
                                formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("targets", nargs="+", metavar="PACKAGE | PACKAGE/FILE.launch | PATH | ARG:=VALUE",
                   help="what to launch; ARG:=VALUE goes to every launch file that declares ARG "
                        "(windows are off by themselves: gui:=false rviz:=false)")
    p.add_argument("--output", "-o", default="out/gallery",
                   help="folder for index.html and the pictures (default out/gallery)")
    p.add_argument("--drive", nargs=3, type=float, metavar=("SPEED", "TURN", "SECONDS"),
                   help="drive robots that listen to velocity commands, m/s and rad/s, while RViz watches")
    p.add_argument("--size", default="1280x800", help="WIDTHxHEIGHT of the RViz window (default 1280x800)")
    p.add_argument("--timeout", type=float, default=60.0,
                   help="seconds to wait for nodes and for displays (default 60)")
    return p


def free_port() -> int:
    with socket.socket() as s:
        s.bind(("localhost", 0))
        return s.getsockname()[1]


@contextlib.contextmanager
def running(words: List[str], environment: Dict[str, str], log: "str | os.PathLike") -> Iterator[subprocess.Popen]:
    """roslaunch in a process group of its own, which gets Ctrl-C's signal at the end, and SIGKILL if that is in vain."""
    with open(log, "w") as file:
        process = subprocess.Popen(words, env=environment, stdout=file, stderr=subprocess.STDOUT,
                                   stdin=subprocess.DEVNULL, start_new_session=True)
        try:
            yield process
        finally:
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
                with contextlib.suppress(ProcessLookupError):
                    os.killpg(process.pid, number)
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(20)
                    break


def last_words(log: str) -> str:
    """The last line of roslaunch's output that says why, as far as a line can."""
    with open(log, errors="replace") as file:
        lines = [re.sub(r"\x1b\[[0-9;]*m|\x1b\].*?\x07", "", line).strip().strip("=") for line in file]
    said = [line for line in lines if line and not _FAREWELL.search(line)]
    return said[-1] if said else "nothing was printed"


def visit(launch: Launch, given: Dict[str, str], folder: str, options: argparse.Namespace) -> Entry:
    """Launch, take pictures, stop. Never raises for what is wrong with the launch file: the entry's notes say it."""
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
    job = {"folder": folder, "stem": stem, "log": log, "config": shown.rviz, "nodes": shown.nodes,
           "passing": shown.passing, "timeout": options.timeout, "size": options.size, "drive": options.drive}
    port = free_port()
    with private_display() as display, tempfile.TemporaryDirectory() as home:
        # the simulator leaves shadows out where no graphics card draws; a picture in a minute can afford them
        environment = {"ODE_SIM_SHADOWS": "on", **os.environ, **display, "ROS_HOME": home,
                       "ROS_MASTER_URI": f"http://localhost:{port}", "PYTHONUNBUFFERED": "1"}
        words = ["roslaunch", "-p", str(port), launch.path, *(f"{name}:={value}" for name, value in values.items())]
        with running(words, environment, log) as process:
            visitor = subprocess.Popen([sys.executable, "-m", "launch_gallery.visit"], env=environment, text=True,
                                       stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
            visitor.stdin.write(json.dumps(job))
            visitor.stdin.close()
            visitor.stdin = None
            while True:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    answer, complaints = visitor.communicate(timeout=0.5)
                    break
                if process.poll() is not None:
                    visitor.kill()
            if not answer:  # the master went away: roslaunch is ending
                with contextlib.suppress(subprocess.TimeoutExpired):
                    process.wait(10)
            if process.poll() is not None:
                entry.notes.append(f"roslaunch ended by itself with code {process.returncode}: {last_words(log)}")
            if answer:
                found = json.loads(answer)
                entry.pictures += [tuple(picture) for picture in found["pictures"]]
                entry.notes += found["notes"]
            elif process.poll() is None:
                entry.notes.append(f"no pictures: {(complaints.strip() or 'no reason given').splitlines()[-1]}")
    return entry


def main(argv: Optional[List[str]] = None) -> int:
    """Exit code 0: every launch file has pictures; 1: one has none, or there was nothing to launch; 2: wrong options."""
    options = parser().parse_args(sys.argv[1:] if argv is None else argv)
    given = dict(word.split(":=", 1) for word in options.targets if ":=" in word)
    folder = os.path.abspath(options.output)
    entries: List[Entry] = []
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
