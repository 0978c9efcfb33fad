"""Rows of a scene: real Gazebo's value, ours by both solvers, the law, and whether each is within its tolerance."""

from __future__ import annotations

import glob
import gzip
import math
import os
from collections.abc import Iterator
from dataclasses import dataclass

from real_gazebo.causes import cause_of
from real_gazebo.chroot import ChrootError
from real_gazebo.records import Record, path_of
from real_gazebo.scene import Row, Scene

KEPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "out", "truth")


@dataclass(frozen=True)
class Result:
    scene: Scene
    row: Row
    real: float
    ours: dict[str, float]  # by solver; NaN: it could not be measured

    def within(self, solver: str) -> bool:
        near, wanted = self.row.gazebo if solver == "gazebo" else self.row.default, self.wanted(solver)
        return close(self.ours[solver], wanted, near)

    def wanted(self, solver: str) -> float:
        """What that solver is held against: real Gazebo, or the law for the default one where there is a law."""
        return self.real if solver == "gazebo" or self.row.law is None else self.row.law

    def cause(self, solver: str) -> str:
        return cause_of(solver, self.scene.name, self.row.quantity)


def close(value: float, wanted: float, near: tuple[float, float]) -> bool:
    if math.isinf(value) or math.isinf(wanted):
        return value == wanted
    return abs(value - wanted) <= near[0] * abs(wanted) + near[1]


def measured(row: Row, record: Record | None) -> float:
    if record is None:
        return math.nan
    try:
        return float(row.measure(record))
    except (KeyError, IndexError, ValueError, StopIteration):  # what it names is not there
        return math.nan


def run_ours(scene: Scene, solver: str) -> Record:
    if scene.server:
        from real_gazebo.server import run
    else:
        from real_gazebo.ours import run
    return run(scene, solver)


def core_files() -> list[str]:
    import ode_sim

    # A devel space has a stub for the package; its sources are further on in the path.
    folders = dict.fromkeys([os.path.dirname(ode_sim.__file__), *ode_sim.__path__])
    return [ode_sim._core.__file__, *(file for folder in folders for file in glob.glob(os.path.join(folder, "**", "*.py"), recursive=True))]


def plugin_files() -> list[str]:
    """Libraries of the plugins in C++, which scenes on the server load."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
    return [
        file for prefix in prefixes for name in ("libgazebo*.so", "lib*Plugin.so") for file in glob.glob(os.path.join(prefix, "lib", name))
    ]


def kept_run(scene: Scene, solver: str) -> Record | None:
    """A run of this scene, maybe one that was kept since what it runs was last changed; None, with a line, where none can be had."""
    path = os.path.join(KEPT, solver, f"{scene.name}-{scene.digest()}.csv.gz")
    if os.path.exists(path) and os.path.getmtime(path) > max(
        map(os.path.getmtime, core_files() + (plugin_files() if scene.server else []))
    ):
        return Record.read(path)
    try:
        record = run_ours(scene, solver)
    except ChrootError as error:
        print(f"truth: {error}")
        return None
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with gzip.open(path, "wt") as file:
        file.write("\n".join(record.lines))
    return record


def compare(scene: Scene) -> Iterator[Result]:
    real = Record.read(path_of(scene.name))
    runs = {solver: kept_run(scene, solver) for solver in ("gazebo", "default")}
    for row in scene.rows:
        yield Result(scene, row, measured(row, real), {solver: measured(row, record) for solver, record in runs.items()})


def number(value: float | None) -> str:
    if value is None:
        return ""
    if math.isinf(value):
        return "never" if value > 0 else "-inf"
    return "none" if math.isnan(value) else f"{value + 0.0:.5g}"


def verdict(result: Result, solver: str) -> str:
    cause = result.cause(solver)
    if result.within(solver):
        return "ok, though a cause is told" if cause else "ok"
    return "OFF (told)" if cause else "OFF"


def told(scene: Scene, result: Result) -> str:
    ours = " ".join(f"{solver} {number(value)} {verdict(result, solver)}" for solver, value in result.ours.items())
    law = "" if result.row.law is None else f" law {number(result.row.law)}"
    return f"{scene.name}: {result.row.quantity}: real {number(result.real)}{law} {ours}"
