"""Logs in the form of OMPL's benchmarks, which Planner Arena and moveit_benchmark_statistics.py read."""

from __future__ import annotations

from dataclasses import dataclass, field

Run = dict[str, str]  # "time REAL": "0.1"


@dataclass
class Log:
    """The runs of several planners on one problem. Seconds; ``setup`` is free text of several lines."""

    name: str
    host: str
    started: str
    setup: str
    timeout: float
    runs: int
    duration: float = 0.0
    version: str = "1.1.14"
    planners: dict[str, list[Run]] = field(default_factory=dict)


def write(log: Log) -> str:
    """The text of a log."""
    lines = [
        f"MoveIt version {log.version}",
        f"Experiment {log.name}",
        f"Running on {log.host}",
        f"Starting at {log.started}",
        "<<<|",
        log.setup,
        "|>>>",
        "0 is the random seed",
        f"{log.timeout:g} seconds per run",
        "-1 MB per run",
        f"{log.runs} runs per planner",
        f"{log.duration:g} seconds spent to collect the data",
        "0 enum types",
        f"{len(log.planners)} planners",
    ]
    for planner, runs in log.planners.items():
        properties = sorted({key for run in runs for key in run})
        lines += [planner, "0 common properties", f"{len(properties)} properties for each run", *properties, f"{len(runs)} runs"]
        lines += ["".join(f"{run.get(key, '')}; " for key in properties) for run in runs]
        lines.append(".")
    return "\n".join(lines) + "\n"


def read(text: str) -> Log:
    """A log's content.

    :raises ValueError: the text is no log.
    """
    lines = iter(text.splitlines())

    def after(word: str) -> str:
        line = next(lines, "")
        if not line.startswith(word):
            raise ValueError(f"'{line[:40]}' stands where '{word}' is expected")
        return line[len(word) :].strip()

    def number(ending: str) -> float:
        line = next(lines, "")
        try:
            return float(line.split()[0]) if ending in line else 1 / 0
        except (ValueError, IndexError, ZeroDivisionError):
            raise ValueError(f"'{line[:40]}' stands where a number of {ending} is expected") from None

    version = next(lines, "").rpartition(" ")[2]
    log = Log(after("Experiment"), after("Running on"), after("Starting at"), "", 0, 0, version=version)
    after("<<<|")
    setup = []
    for line in lines:
        if line.startswith("|>>>"):
            break
        setup.append(line)
    log.setup = "\n".join(setup)
    number("random seed")
    log.timeout = number("seconds per run")
    number("MB per run")
    log.runs = int(number("runs per planner"))
    log.duration = number("seconds spent")
    number("enum types")
    for _ in range(int(number("planners"))):
        planner = next(lines, "")
        number("common properties")
        properties = [next(lines, "") for _ in range(int(number("properties")))]
        rows = [next(lines, "").split("; ")[:-1] for _ in range(int(number("runs")))]
        log.planners[planner] = [{key: value for key, value in zip(properties, row) if value} for row in rows]
        after(".")
    return log
