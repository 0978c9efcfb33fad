"""The class on one page: marks (HTML, CSV) and, task by task, what most of them lost points for."""

from __future__ import annotations

import csv
import html
import os
import pathlib
import urllib.parse
from collections import Counter
from typing import TYPE_CHECKING

from ..outcome import Result
from ..report.page import STYLE
from ..specs.spec import Spec
from .similar import Pair, pairs
from .store import Store, result_of

if TYPE_CHECKING:
    import sqlite3

RESULTS = "submissions"  # the folder of all reports: what a submission is called is no name of a file of the class
_COLOURS = ((0.999, "#d6f0dc"), (0.5, "#fff4cf"), (0.0, "#fbe0e0"))


def write(spec: Spec, store: Store, out: pathlib.Path) -> None:
    """Write gradebook.csv, gradebook.html and comparison.html of ``store``, a class examined by ``spec``, into ``out``."""
    rows = store.rows()
    results: dict[str, Result | None] = {row["name"]: result_of(row) for row in rows}
    tasks = (["Build"] if spec.data["packages"] else []) + [task["name"] for task in spec.data["tasks"]]
    near = pairs({row["name"]: pathlib.Path(os.fsdecode(row["path"])) for row in rows if row["state"] == "done"})
    with open(out / "gradebook.csv", "w", newline="", encoding="utf-8", errors="backslashreplace") as file:
        writer = csv.writer(file)
        writer.writerow(["submission", "points", "of", *tasks, "remark"])
        for row in rows:
            writer.writerow([safe(row["name"]), row["points"], row["of"], *_marks(results[row["name"]], tasks), safe(_remark(row))])
    for name, text in (("gradebook.html", _page(spec, rows, results, tasks, near)), ("comparison.html", _comparison(spec, results, tasks))):
        (out / name).write_text(text, encoding="utf-8", errors="xmlcharrefreplace")


def safe(text: str) -> str:
    """``text`` for a cell: a name that begins as a formula does would be one in a spreadsheet."""
    return "'" + text if text[:1] in tuple("=+-@\t\r") else text


def _remark(row: sqlite3.Row) -> str:
    """What stands in the place of marks."""
    if row["state"] == "done":
        return ""
    return "not examined" + ("" if row["state"] == "failed" else " yet") + (f": {row['why']}" if row["why"] else "")


def _marks(result: Result | None, tasks: list[str]) -> list:
    found = {task.name: task.points for task in result.tasks} if result else {}
    return [found.get(name, "") for name in tasks]


def _page(spec: Spec, rows: list[sqlite3.Row], results: dict[str, Result | None], tasks: list[str], near: list[Pair]) -> str:
    head = "".join(f"<th>{html.escape(name)}" for name in tasks)
    lines = []
    for row in rows:
        name, result = row["name"], results[row["name"]]
        if result is None:
            lines.append(f"<tr><td>{html.escape(name)}<td colspan={len(tasks) + 1}>{html.escape(_remark(row))}")
            continue
        cells = "".join(f"<td class=n style='background:{_colour(task.points, task.of)}'>{task.points:g}" for task in result.tasks)
        link = urllib.parse.quote(f"{RESULTS}/{name}/report.html")
        lines.append(f"<tr><td><a href='{link}'>{html.escape(name)}</a><td class=n><b>{result.points:g}</b> of {result.of:g}{cells}")
    twins = "".join(f"<li>{html.escape(p.first)} and {html.escape(p.second)}: {p.share:.0%} in common" for p in near)
    if twins:
        twins = (
            "<h2>Near-identical</h2><p class=note>Look before you judge: what the course handed out is in everybody's copy.</p>"
            f"<ul>{twins}</ul>"
        )
    title = html.escape(spec.data["title"])
    return (
        f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>{title}: gradebook</title>'
        f"<style>{STYLE} body {{max-width: none}}</style><h1>{title}</h1>"
        f"<p><a href='comparison.html'>Task by task</a>, <a href='gradebook.csv'>as CSV</a></p>"
        f"<table><tr><th>Submission<th>Points{head}\n" + "\n".join(lines) + f"</table>{twins}</html>\n"
    )


def _colour(points: float, of: float) -> str:
    part = points / of if of else 1.0
    return next(colour for least, colour in _COLOURS if part >= least)


def _comparison(spec: Spec, results: dict[str, Result | None], tasks: list[str]) -> str:
    parts = []
    known = [result for result in results.values() if result]
    for name in tasks:
        found = [task for result in known for task in result.tasks if task.name == name]
        if not found:
            continue
        full = sum(task.points >= task.of for task in found)
        mean = sum(task.points for task in found) / len(found)
        reasons = Counter(v.reason for task in found for v in task.verdicts if not v.passed)
        items = "".join(f"<li>{count} &times; {html.escape(reason)}" for reason, count in reasons.most_common(8))
        parts.append(
            f"<h2>{html.escape(name)}</h2><p>{full} of {len(found)} have all its points; the mean is {mean:.2f} of {found[0].of:g}.</p>"
            f"<ul>{items}</ul>"
        )
    return (
        f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>{html.escape(spec.data["title"])}: task by task</title>'
        f"<style>{STYLE}</style><h1>Task by task</h1>" + "\n".join(parts) + "</html>\n"
    )
