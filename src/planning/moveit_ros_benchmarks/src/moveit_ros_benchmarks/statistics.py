"""Logs of benchmarks into an SQLite database, in the form that Planner Arena reads, and plots of them."""

from __future__ import annotations

import argparse
import sqlite3
import sys

import numpy as np

from . import log

_TABLES = """
CREATE TABLE IF NOT EXISTS experiments (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512), totaltime REAL, timelimit REAL,
    memorylimit REAL, runcount INTEGER, version VARCHAR(128), hostname VARCHAR(1024), cpuinfo TEXT, date DATETIME, seed INTEGER,
    setup TEXT);
CREATE TABLE IF NOT EXISTS plannerConfigs (id INTEGER PRIMARY KEY AUTOINCREMENT, name VARCHAR(512) NOT NULL, settings TEXT);
CREATE TABLE IF NOT EXISTS enums (name VARCHAR(512), value INTEGER, description TEXT, PRIMARY KEY (name, value));
CREATE TABLE IF NOT EXISTS runs (id INTEGER PRIMARY KEY AUTOINCREMENT, experimentid INTEGER, plannerid INTEGER,
    FOREIGN KEY (experimentid) REFERENCES experiments(id) ON DELETE CASCADE,
    FOREIGN KEY (plannerid) REFERENCES plannerConfigs(id) ON DELETE CASCADE);
CREATE TABLE IF NOT EXISTS progress (runid INTEGER, time REAL, PRIMARY KEY (runid, time),
    FOREIGN KEY (runid) REFERENCES runs(id) ON DELETE CASCADE);
"""


def store(base: sqlite3.Connection, entry: log.Log) -> None:
    """Add the runs of ``entry`` to the database ``base``."""
    base.executescript(_TABLES)
    experiment = base.execute(
        "INSERT INTO experiments (name, totaltime, timelimit, memorylimit, runcount, version, hostname, date, seed, setup) "
        "VALUES (?, ?, ?, -1, ?, ?, ?, ?, 0, ?)",
        (
            entry.name,
            entry.duration,
            entry.timeout,
            entry.runs,
            f"MoveIt {entry.version}",
            entry.host,
            entry.started.replace("T", " "),
            entry.setup,
        ),
    ).lastrowid
    for planner, runs in entry.planners.items():
        row = base.execute("SELECT id FROM plannerConfigs WHERE name = ?", (planner,)).fetchone()
        number = row[0] if row else base.execute("INSERT INTO plannerConfigs (name, settings) VALUES (?, '')", (planner,)).lastrowid
        for run in runs:
            columns = {**dict(_column(base, key, value) for key, value in run.items()), "experimentid": experiment, "plannerid": number}
            base.execute(f"INSERT INTO runs ({', '.join(columns)}) VALUES ({', '.join('?' * len(columns))})", tuple(columns.values()))
    base.commit()


def _column(base: sqlite3.Connection, key: str, value: str) -> tuple[str, str]:
    """The column of a property, made where it is missing, and its value."""
    words, kind = key.split()[:-1], key.split()[-1]
    name = "".join(c if c.isalnum() else "_" for c in "_".join(words))
    if name not in {row[1] for row in base.execute("PRAGMA table_info(runs)")}:
        base.execute(f"ALTER TABLE runs ADD {name} {kind if kind in ('REAL', 'BOOLEAN', 'INTEGER') else 'TEXT'}")
    return name, value


def summary(entry: log.Log) -> list[str]:
    """A line for each planner of ``entry``: solved, time and length in the middle."""
    lines = [f"{entry.name}: {entry.runs} runs each"]
    for planner, runs in entry.planners.items():
        solved = [run for run in runs if run.get("solved BOOLEAN") == "1"]
        middle = [
            float(np.median([float(run.get(key, "nan")) for run in solved])) if solved else float("nan")
            for key in ("time REAL", "final_path_length REAL")
        ]
        lines.append(f"  {planner:50} solved {len(solved)} of {len(runs)}, time {middle[0]:.4g} s, length {middle[1]:.4g}")
    return lines


def plot(entries: list[log.Log], file: str) -> None:
    """Box plots of the real-valued properties of all runs of ``entries``, a page each, into ``file``, a PDF."""
    import matplotlib

    matplotlib.use("pdf")
    from matplotlib import pyplot
    from matplotlib.backends.backend_pdf import PdfPages

    planners = sorted({planner for entry in entries for planner in entry.planners})
    runs = {planner: [run for entry in entries for run in entry.planners.get(planner, [])] for planner in planners}
    keys = sorted({key for some in runs.values() for run in some for key in run if key.endswith(" REAL")})
    with PdfPages(file) as pages:
        for key in keys:
            pyplot.clf()
            values = [[float(run[key]) for run in runs[planner] if key in run] for planner in planners]
            pyplot.boxplot(values)
            pyplot.xticks(range(1, len(planners) + 1), planners, rotation=20, ha="right", fontsize=7)
            pyplot.ylabel(key[:-5])
            pyplot.tight_layout()
            pages.savefig(pyplot.gcf())


def main() -> int:
    """The program; its exit code."""
    parser = argparse.ArgumentParser(prog="moveit_benchmark_statistics.py", description="Put logs of benchmarks into a database.")
    parser.add_argument("logs", nargs="*", help="log files of moveit_run_benchmark")
    parser.add_argument("-d", "--database", default="benchmark.db", help="SQLite file; http://plannerarena.org shows it")
    parser.add_argument("-a", "--append", action="store_true", help="accepted: logs are always added to the file")
    parser.add_argument("-p", "--plot", metavar="FILE.pdf", help="box plots of all properties")
    options = parser.parse_args()
    if not options.logs:
        parser.error("name the log files")
    entries = []
    for name in options.logs:
        try:
            with open(name, encoding="utf-8") as file:
                entries.append(log.read(file.read()))
        except (OSError, ValueError) as error:
            print(f"{name}: {error}", file=sys.stderr)
            return 1
        print("\n".join(summary(entries[-1])))
    base = sqlite3.connect(options.database)
    for entry in entries:
        store(base, entry)
    base.close()
    print(f"written to {options.database}")
    if options.plot:
        plot(entries, options.plot)
        print(f"plotted in {options.plot}")
    return 0
