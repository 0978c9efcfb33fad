"""``rosrun noetic_environment report``: what somebody who helps has to know of this machine, in one file without personal data."""

from __future__ import annotations

import argparse
import getpass
import os
import platform
import re
import socket
import subprocess
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path
from xml.etree import ElementTree

import rospkg

PACKAGES = (
    "libode8*",
    "ros-base",
    "rviz",
    "catkin",
    "catkin-tools",
    "python3-numpy",
    "python3-rospkg",
    "libgl1-mesa-dri",
    "libqt5gui5*",
    "libqt6gui6*",
    "g++",
    "cmake",
)
#: names of variables of which the value counts
VARIABLES = re.compile(r"ROS_|GAZEBO_|ODE_SIM_|CMAKE_PREFIX_PATH|PYTHONPATH|DISPLAY|WAYLAND_|QT_|LIBGL_|MESA_|LANG|LC_ALL|XDG_SESSION")
LINES = 200  # of each log, from its end
LOGS = 8  # the newest
_DRAWS = "from ode_sim_rendering import Renderer; print(Renderer().device)"
_SECONDS = 20.0  # for each program that is asked


class Veil:
    """Takes out of a text what says who and where: home folders, names of user and machine, addresses."""

    def __init__(self, home: str, user: str, host: str) -> None:
        names = [(re.escape(home.rstrip("/")) + r"(?![\w.-])", "~")] if home.strip("/") else []
        names.append((r"/home/[^/\s:'\"]+", "/home/USER"))
        names += [
            (rf"(?<![\w-]){re.escape(name)}(?![\w-])", word)
            for name, word in ((user, "USER"), (host, "HOST"))
            if len(name) > 1 and name not in ("root", "localhost")
        ]
        self._rules = [(re.compile(pattern), word) for pattern, word in names]
        self._rules += [
            (re.compile(r"(://)[^/\s@]+@"), r"\1"),
            (re.compile(r"[\w.+-]+@[\w-]+(?:\.[\w-]+)+"), "MAIL"),
            (re.compile(r"\b(?!127\.|0\.0\.0\.0)(?:\d{1,3}\.){3}\d{1,3}\b"), "ADDRESS"),
            (re.compile(r"(?i)((?:token|password|secret|key)\w*\s*[=:]\s*)\S+"), r"\1..."),
        ]

    def over(self, text: str) -> str:
        for pattern, word in self._rules:
            text = pattern.sub(word, text)
        return text


def _asked(*command: str) -> str:
    """What a program prints, or in one line why it did not."""
    try:
        ended = subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=_SECONDS)
    except FileNotFoundError:
        return f"({command[0]} is not installed)"
    except subprocess.TimeoutExpired:
        return f"({command[0]} did not answer in {_SECONDS:g} s)"
    said = ended.stdout.strip() or ended.stderr.strip()
    return said if ended.returncode == 0 else f"({said.splitlines()[-1] if said else f'exit code {ended.returncode}'})"


def machine() -> Iterator[tuple[str, str]]:
    """(what, value) of system, processor, memory and what draws."""
    try:
        system = platform.freedesktop_os_release().get("PRETTY_NAME", "")
    except OSError:
        system = "unknown"
    yield "system", f"{system}, {platform.system()} {platform.release()}, {platform.machine()}"
    yield "container", ", ".join(name for name in ("/.dockerenv", "/run/.containerenv") if Path(name).exists()) or "no"
    pages = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    yield "processors, memory", f"{len(os.sched_getaffinity(0))} of {os.cpu_count()}, {pages / 2**30:.1f} GiB"
    yield "OpenGL", _asked(sys.executable, "-c", _DRAWS)


def versions() -> Iterator[tuple[str, str]]:
    """(what, version) of this platform, of Debian's packages and of Python's."""
    own = Path(rospkg.RosPack().get_path("noetic_environment"))
    yield "noetic_labs", ElementTree.parse(own / "package.xml").findtext("version", "")
    yield "commit", _asked("git", "-C", str(own), "describe", "--always", "--dirty")
    yield "python", platform.python_version()
    # a name that is not installed is an exit code, not an end: the others are told
    command = 'dpkg-query --show --showformat="\\${Package} \\${Version}\\n" "$@" 2> /dev/null || true'
    for line in _asked("sh", "-c", command, "sh", *PACKAGES).splitlines():
        name, _, version = line.partition(" ")
        if version:
            yield name, version


def workspaces(environment: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """(folder, how many packages it adds) of each sourced workspace, the newest first."""
    for folder in environment.get("CMAKE_PREFIX_PATH", "").split(":"):
        if folder:
            marker = Path(folder) / ".catkin"  # of a devel space: where its packages' sources are
            sources = [name for name in marker.read_text().split(";") if name] if marker.is_file() else []
            yield folder, f"{len(sources) or len(list(Path(folder).glob('share/*/package.xml')))} packages"


def logs(folder: Path) -> Iterator[tuple[str, str]]:
    """(name, last lines) of the newest logs of the last run."""
    latest = folder / "latest"
    place = latest if latest.is_dir() else folder
    files = [path for path in place.glob("*.log") if path.is_file()]
    for path in sorted(files, key=lambda path: path.stat().st_mtime, reverse=True)[:LOGS]:
        with open(path, "rb") as file:
            file.seek(max(0, path.stat().st_size - 200 * LINES))
            lines = file.read().decode(errors="replace").splitlines()[-LINES:]
        yield path.name, "\n".join(lines)


def text(environment: Mapping[str, str]) -> str:
    """The whole report, veiled."""
    kept = {name: value for name, value in environment.items() if VARIABLES.match(name) and name != "ROS_PACKAGE_PATH"}
    parts: list[str] = []
    for title, pairs in (
        ("Machine", machine()),
        ("Versions", versions()),
        ("Workspaces", workspaces(environment)),
        ("Variables", sorted(kept.items())),
    ):
        parts += [f"## {title}", *(f"{name}: {value}" for name, value in pairs), ""]
    for name, lines in logs(Path(rospkg.get_log_dir(environment))):
        parts += [f"## Log {name}", lines, ""]
    try:
        user = getpass.getuser()
    except (KeyError, OSError):  # a container's user without a name
        user = ""
    return Veil(os.path.expanduser("~"), user, socket.gethostname()).over("\n".join(parts)) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(
        prog="report",
        description="Writes versions, graphics and the last run's logs into one file, to be "
        "attached where you ask for help; read it before you do.",
    )
    parser.add_argument("--output", type=Path, default=Path("noetic_report.txt"), help="the file; - prints it")
    output = parser.parse_args().output
    report = text(os.environ)
    if str(output) == "-":
        print(report, end="")
        return 0
    try:
        output.write_text(report)
    except OSError as error:
        print(f"{output}: {error.strerror}", file=sys.stderr)
        return 1
    print(f"{output}: {len(report.splitlines())} lines; your name, machine and addresses are taken out, but read it before you send it")
    return 0
