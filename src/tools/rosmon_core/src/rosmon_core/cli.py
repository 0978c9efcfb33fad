"""The command line of rosmon: options anywhere, then PACKAGE FILE or PATH, then arguments name:=value.

Words are taken apart as upstream's ``getopt_long`` does: an option may be shortened as long as it is clear which is meant, its value
follows after ``=`` or as the next word, and ``--`` ends the options.
"""

from __future__ import annotations

import getopt
import math
import os
import re
from dataclasses import dataclass, field

import rospkg

from rosmon_core import RosmonError

HELP = """usage: mon launch [actions] [options] PACKAGE FILE.launch [arg:=value ...]
       mon launch [actions] [options] path/to/file.launch [arg:=value ...]

FILE is searched for by name in all folders of PACKAGE.

actions (instead of running the launch file):
  --benchmark               load the launch file, say how long it took, exit
  --list-args               print the names of the launch file's arguments, one per line

options:
  --disable-ui              print plain lines, take no keys (also chosen when there is no terminal)
  --flush-log               write each line to the log at once
  --flush-stdout            write each line to standard output at once
  -h, --help                this text
  --log=FILE                log to FILE (default /tmp/rosmon_<date>_<time>.log); 'syslog': to the system log
  --name=NAME               node name of rosmon itself (default: rosmon_<unique>)
  --no-start                start no node by itself
  --stop-timeout=SECONDS    time between SIGINT and SIGKILL when a node is stopped (default 5.0)
  --output-attr=obey|ignore obey: hide the output of nodes without an output attribute (default ignore: show it)
  --cpu-limit=CORES         warn in /diagnostics above this load of one node (default 0.9)
  --memory-limit=SIZE       warn in /diagnostics above this memory of one node, for example 15MB (default 500MiB)
  --disable-diagnostics     do not publish /diagnostics
  --diagnostics-prefix=TEXT replaces the node name in /diagnostics
  --auto-increment-spawn-delay=SECONDS
                            start each node that has no rosmon-spawn-delay so much later than the one before it

An option may be shortened as long as it is clear, and a value may follow after a blank.

environment:
  ROSMON_COLOR_MODE         truecolor, 256colors or ansi (default: what the terminal says)
  ROSMON_SYSLOG=1           as --log=syslog
  ROSMON_DEBUGGER_TERMINAL  command that opens a terminal for gdb (default 'xterm -e')
"""

_UNITS = {
    "": 1,
    "B": 1,
    "kB": 10**3,
    "MB": 10**6,
    "GB": 10**9,
    "TB": 10**12,
    "KB": 10**3,
    "mB": 10**6,
    "gB": 10**9,
    "tB": 10**12,
    "KiB": 2**10,
    "MiB": 2**20,
    "GiB": 2**30,
    "TiB": 2**40,
}
_FLAGS = ("benchmark", "list-args", "disable-ui", "flush-log", "flush-stdout", "help", "no-start", "disable-diagnostics")
_WITH_VALUE = (
    "log",
    "name",
    "diagnostics-prefix",
    "stop-timeout",
    "cpu-limit",
    "memory-limit",
    "output-attr",
    "auto-increment-spawn-delay",
)


@dataclass
class Options:
    """What the user asked for. Times in s, ``memory_limit`` in bytes, ``cpu_limit`` in cores."""

    file: str = ""
    arguments: list[str] = field(default_factory=list)
    benchmark: bool = False
    list_args: bool = False
    disable_ui: bool = False
    flush_log: bool = False
    flush_stdout: bool = False
    help: bool = False
    no_start: bool = False
    disable_diagnostics: bool = False
    log: str | None = None
    name: str | None = None
    diagnostics_prefix: str | None = None
    stop_timeout: float = 5.0
    cpu_limit: float = 0.9
    memory_limit: int = 500 * 2**20
    obey_output: bool = False
    spawn_increment: float = 0.0


def parse_memory(text: str) -> int:
    """Bytes from ``15MB``, ``1.5 GiB`` or ``1000``. :raises RosmonError: something else."""
    match = re.fullmatch(r"\s*([0-9]*\.?[0-9]+)\s*([A-Za-z]*)\s*", text)
    if not match or match.group(2) not in _UNITS:
        raise RosmonError(f"'{text}' is no amount of memory: write for example 15MB or 200MiB (B, kB, MB, GB, TB, KiB, MiB, GiB, TiB)")
    return int(float(match.group(1)) * _UNITS[match.group(2)])


def parse_number(text: str, what: str) -> float:
    """``text`` as a number that is zero or more; ``what`` it is, for the error. :raises RosmonError: something else."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if math.isnan(value) or value < 0.0:
        raise RosmonError(f"{what} is '{text}': write a number that is zero or more")
    return value


def find_launch_file(package: str, name: str) -> str:
    """Path of the file called ``name`` anywhere below the package's folders.

    :raises RosmonError: no such package or file, or several such files.
    """
    try:
        root = rospkg.RosPack().get_path(package)
    except rospkg.ResourceNotFound:
        raise RosmonError(
            f"Could not find path of package '{package}': is its workspace built and devel/setup.bash sourced in this terminal?"
        ) from None
    found, launch_files = [], []
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(f for f in folders if not f.startswith("."))
        found += [os.path.join(folder, f) for f in files if f == name]
        launch_files += [f for f in files if f.endswith(".launch")]
    if not found:
        listed = ", ".join(sorted(set(launch_files))) or "no launch file at all"
        raise RosmonError(f"Could not find launch file '{name}' in package '{package}' ({root}); it has {listed}")
    if len(found) > 1:
        raise RosmonError(
            f"Found multiple launch files named '{name}' in package '{package}': "
            f"{', '.join(sorted(found))}; give the path of the one that is meant"
        )
    return found[0]


def parse(words: list[str]) -> Options:
    """Options from the words behind ``mon launch``. :raises RosmonError: a word cannot be understood."""
    options = Options()
    try:
        given, rest = getopt.gnu_getopt(words, "h", [*_FLAGS, *(name + "=" for name in _WITH_VALUE)])
    except getopt.GetoptError as error:
        raise RosmonError(f"{error.msg}; see 'mon launch --help'") from None
    for name, value in given:
        _option(options, "help" if name == "-h" else name[2:], value)
        if options.help:
            return options
    split = next((i for i, word in enumerate(rest) if ":=" in word and i > 0), len(rest))
    positional, options.arguments = rest[:split], rest[split:]
    for word in options.arguments:
        if ":=" not in word:
            raise RosmonError(f"'{word}' stands behind an argument: write arguments as name:=value, after the file")
    if len(positional) == 2:
        options.file = find_launch_file(*positional)
    elif len(positional) == 1:
        options.file = os.path.abspath(positional[0])
        if not os.path.isfile(options.file):
            raise RosmonError(f"Could not find launch file '{positional[0]}': write PACKAGE FILE or the path of a file")
    else:
        raise RosmonError("expected PACKAGE FILE or the path of a launch file; see 'mon launch --help'")
    return options


def _option(options: Options, name: str, value: str) -> None:
    if name in _FLAGS:
        setattr(options, name.replace("-", "_"), True)
    elif name in ("log", "name", "diagnostics-prefix"):
        setattr(options, name.replace("-", "_"), value or None)
    elif name == "memory-limit":
        options.memory_limit = parse_memory(value)
    elif name == "output-attr":
        if value not in ("obey", "ignore"):
            raise RosmonError(f"--output-attr is '{value}': write obey or ignore")
        options.obey_output = value == "obey"
    else:
        attribute = {"auto-increment-spawn-delay": "spawn_increment"}.get(name, name.replace("-", "_"))
        setattr(options, attribute, parse_number(value, "--" + name))
