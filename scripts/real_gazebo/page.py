"""Writes docs/parity.md from the records and from runs of ode_sim."""

from __future__ import annotations

import math
import multiprocessing
import os

from real_gazebo.compare import Result, compare, measured, number, told
from real_gazebo.records import Record, path_of
from real_gazebo.scene import Scene
from real_gazebo.scenes import SCENES

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PAGE = os.path.join(ROOT, "docs", "parity.md")
TITLES = {
    "joints": "Joints",
    "contacts": "Single contacts",
    "piles": "Piles, stacks and walls",
    "robots": "Wheels, casters and grippers",
    "worlds": "Files, worlds and fields of force",
    "sensors": "Sensors",
    "plugins": "Plugins of Gazebo itself",
}
HEAD = """# Parity with Gazebo Classic 11.1

What the real Gazebo Classic 11.1.0 (Debian 11's package) does in {scenes} scenes, and what this simulator does in the same ones with
`solver: gazebo` and with its own solvers. This page is written by `scripts/truth page`; edit the scenes, not the page.

**How to redo it.** `scripts/truth compare` and `scripts/truth page` need nothing but this workspace: what real Gazebo gave lies in
`scripts/real_gazebo/records`. `sudo scripts/truth chroot` makes the chroot with real Gazebo (Debian 11, 2.7 GB), `sudo scripts/truth record
[SCENE]` runs scenes there again. `scripts/truth list` names the scenes; each is a few lines of `scripts/real_gazebo/scenes_*.py`.
`scripts/tests/test_truth.py` holds the rows, but for those of sensors, which need a server each, and of `NOT_COMPARED` in `causes.py`.

**How to read it.** `gazebo` is held against *real*; `default` against the *law* where there is one, else against *real*. A value in
**bold** is off by more than its tolerance (part of the value + absolute), and the cause stands below the table. Tolerances: four digits
before chaos; for piles and skids what a user sees: falls or stands, times within 10 %, turns within 5 %. A row with a wide tolerance
(over 50 %) is told, not held. *never*: does not happen; *none*: cannot be measured.

| | rows | within tolerance | off, cause told |
|---|---|---|---|
{summary}
"""


def tolerance(near) -> str:
    if near[0] >= 0.5 or near[1] >= 5:
        return "told"
    parts = ([f"{near[0] * 100:g} %"] if near[0] else []) + ([f"{near[1]:g}"] if near[1] else [])
    return " + ".join(parts) or "exact"


def cell(result: Result, solver: str) -> str:
    text = number(result.ours[solver])
    return text if result.within(solver) else f"**{text}**"


def error(result: Result) -> str:
    """Errors of real Gazebo and of the default solver against the law."""
    law, default = result.row.law, result.ours["default"]
    if law is None or math.isinf(law):
        return ""
    return f"{number(result.real - law)}; {number(default - law)}"


def section(scene: Scene, results: list[Result]) -> list[str]:
    lines = [
        f"### {scene.name}",
        "",
        f"{scene.what[0].upper()}{scene.what[1:]}. Law: {scene.law}.",
        "",
        "| quantity | law | real | gazebo | default | tolerance of gazebo; default | error against the law: real; default |",
        "|---|---|---|---|---|---|---|",
    ]
    for r in results:
        lines.append(
            f"| {r.row.quantity} | {number(r.row.law)} | {number(r.real)} | {cell(r, 'gazebo')} | {cell(r, 'default')} | "
            f"{tolerance(r.row.gazebo)}; {tolerance(r.row.default)} | {error(r)} |"
        )
    causes = dict.fromkeys(
        f"`{solver}`: {r.cause(solver)}." for solver in ("gazebo", "default") for r in results if not r.within(solver) and r.cause(solver)
    )
    return lines + [""] + [f"* {cause}" for cause in causes] + ([""] if causes else [])


def real_section(scene: Scene) -> list[str]:
    record = Record.read(path_of(scene.name))
    values = "; ".join(f"{row.quantity} {number(measured(row, record))}" for row in scene.rows)
    return [f"* `{scene.name}`: {scene.what}. {values}."]


def values_of(name: str) -> list[tuple[float, dict[str, float]]]:
    """Of each row of a scene: real Gazebo's and ours."""
    return [(result.real, result.ours) for result in compare(next(scene for scene in SCENES if scene.name == name))]


def write(tell=print) -> str:
    """Run all scenes that have a record, on all processors; gives one line of what was written."""
    families: dict[str, list[str]] = {}
    counts = {solver: [0, 0] for solver in ("gazebo", "default")}
    scenes = [scene for scene in SCENES if os.path.exists(path_of(scene.name))]
    alone: list[Scene] = []
    with multiprocessing.Pool() as pool:
        for scene, values in zip(scenes, pool.imap(values_of, [scene.name for scene in scenes])):
            results = [Result(scene, row, *of_row) for row, of_row in zip(scene.rows, values)]
            if all(math.isnan(value) for result in results for value in result.ours.values()):
                alone.append(scene)  # it could not be run here
                continue
            for result in results:
                tell(told(scene, result))
            for solver, count in counts.items():
                count[0] += len(results)
                count[1] += sum(r.within(solver) for r in results)
            families.setdefault(scene.family, []).extend(section(scene, results))
    summary = "\n".join(
        f"| `{solver}` against {'real Gazebo' if solver == 'gazebo' else 'the laws'} | {rows} | {good} | {rows - good} |"
        for solver, (rows, good) in counts.items()
    )
    lines = [HEAD.format(scenes=len(scenes) - len(alone), summary=summary)]
    for family, text in families.items():
        lines += [f"## {TITLES.get(family, family)}", ""] + text
    if alone:
        lines += [
            "## Recorded, and not run here",
            "",
            "What real Gazebo did; this simulator was not run beside it when the page was written.",
            "",
        ]
        lines += [line for scene in alone for line in real_section(scene)]
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write("\n".join(lines).rstrip() + "\n")
    return f"{os.path.relpath(PAGE, ROOT)}: {len(scenes)} scenes, {counts}"
