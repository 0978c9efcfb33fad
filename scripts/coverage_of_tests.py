"""Which lines of the workspace's Python a run of tests has gone through, in pytest and in all nodes that it starts.

A package's ``__init__.py`` is not counted: catkin's relay of the devel space executes it as a text without a name.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOOL = ROOT / ".python-coverage"
REQUIREMENTS = ROOT / "scripts" / "requirements-coverage.txt"
# Nodes end by a signal or by os._exit(): both first write down what was seen.
_SETTINGS = """[run]
parallel = true
sigterm = true
patch = _exit
data_file = {folder}/data
source = {source}
omit =
    */test/*
    */setup.py
    */__init__.py
disable_warnings = no-data-collected,module-not-imported
"""
_HOOK = "import coverage\n\ncoverage.process_startup()\n"


def install() -> None:
    """The tool, in a folder of its own, when it is not there yet. :raises subprocess.CalledProcessError: pip could not"""
    noted = TOOL / REQUIREMENTS.name
    if noted.is_file() and noted.read_bytes() == REQUIREMENTS.read_bytes():
        return
    subprocess.run(
        [
            sys.executable,
            "-m",
            "pip",
            "install",
            "-q",
            "--disable-pip-version-check",
            "--root-user-action=ignore",
            "--no-deps",
            "--upgrade",
            "--target",
            str(TOOL),
            "-r",
            str(REQUIREMENTS),
        ],
        check=True,
    )
    noted.write_bytes(REQUIREMENTS.read_bytes())


def environment(folder: Path, source: Path = ROOT / "src") -> dict[str, str]:
    """What a process needs, and hands on to those it starts, so that all of them write into ``folder``."""
    (folder / "hook").mkdir(parents=True, exist_ok=True)
    (folder / "settings").write_text(_SETTINGS.format(folder=folder, source=source))
    (folder / "hook" / "sitecustomize.py").write_text(_HOOK)
    path = [str(folder / "hook"), str(TOOL), os.environ.get("PYTHONPATH", "")]
    return {"PYTHONPATH": os.pathsep.join(entry for entry in path if entry), "COVERAGE_PROCESS_START": str(folder / "settings")}


def package_of(path: Path, root: Path = ROOT) -> str:
    """The catkin package that a file belongs to; its folder where it is in none."""
    for folder in (root / path).parents:
        if (folder / "package.xml").is_file():
            return folder.name
    return path.parts[0]


def table(files: dict[str, dict], packages: list[str]) -> Iterator[tuple[str, int, int]]:
    """(package, lines that were run, lines that can be) in the order of names; of ``packages`` alone if any are named."""
    counts: dict[str, list[int]] = defaultdict(lambda: [0, 0])
    for name, entry in files.items():
        package = package_of(Path(name))
        if not packages or package in packages:
            counts[package][0] += entry["summary"]["covered_lines"]
            counts[package][1] += entry["summary"]["num_statements"]
    for package, (run, lines) in sorted(counts.items()):
        yield package, run, lines


def report(folder: Path, out: Path, packages: list[str]) -> list[str]:
    """Pages with every line in ``out``, and what to print: a line for each package."""
    command = [sys.executable, "-m", "coverage"]
    options = [f"--rcfile={folder / 'settings'}"]
    calls = (
        ["combine", "-q", *options],
        ["html", "-q", *options, "-d", str(out)],
        ["json", "-q", *options, "-o", str(out / "coverage.json")],
    )
    for call in calls:
        if subprocess.run(command + call, cwd=ROOT, env=dict(os.environ, PYTHONPATH=str(TOOL))).returncode:
            return ["no line of Python was seen that could be counted"]
    rows = list(table(json.loads((out / "coverage.json").read_text())["files"], packages))
    run, lines = sum(row[1] for row in rows), sum(row[2] for row in rows)
    return [
        f"{name:40} {done:6} of {most:6} lines  {100.0 * done / max(most, 1):5.1f} %"
        for name, done, most in [*rows, ("all of these", run, lines)]
    ]
