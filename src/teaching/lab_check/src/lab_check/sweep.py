"""``sweep``: one lab over a grid or random draw of parameters; the same examiner, a table and plots."""

from __future__ import annotations

import argparse
import csv
import html
import json
import os
import pathlib
import sys
from typing import Any

from .classroom.engines import How, Pool
from .classroom.grade import run
from .classroom.store import Store, fingerprint, result_of
from .outcome import Result
from .report.page import STYLE
from .specs.spec import SpecError
from .specs.sweep_spec import PlaceError, Sweep, load_sweep

_MOST_PLOTS = 24


def main(arguments: list[str] | None = None) -> int:
    from .cli import allowed, sandbox_options

    parser = argparse.ArgumentParser(
        prog="rosrun lab_check sweep", description="Examine a lab over a range of parameters; run it again to go on after an interruption."
    )
    parser.add_argument("sweep", help="YAML: which parameters take which values; docs/grading.md")
    parser.add_argument("--workers", type=int, default=max(1, os.cpu_count() or 1), help="examinations at a time; default: one per core")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("sweep"), help="default: ./sweep")
    parser.add_argument("--csv", action="store_true", help="no Parquet, also where pyarrow is installed")
    parser.add_argument("--show", action="store_true", help="only list the cases")
    sandbox_options(parser)
    options = parser.parse_args(arguments)
    if options.workers < 1:
        parser.error("--workers must be at least 1")
    try:
        sweep = load_sweep(options.sweep)
    except SpecError as error:
        print("\n".join(error.problems), file=sys.stderr)
        return 2
    if options.show:
        for number, values in enumerate(sweep.cases):
            print(case_name(number, sweep), json.dumps(values))
        return 0
    allowed(options.unsafe)
    return examine(sweep, options)


def case_name(number: int, sweep: Sweep) -> str:
    """The name of case ``number`` (from 0) of ``sweep``: ``case_001`` where there are some hundreds."""
    return f"case_{number + 1:0{len(str(len(sweep.cases)))}d}"


def examine(sweep: Sweep, options: argparse.Namespace) -> int:
    """Examine all cases of ``sweep``, as ``options`` of the command line say.

    :returns: the exit code: 0, 2 where a value has no place, 4 where a case could not be examined, 130 after Ctrl-C
    """
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    store = Store(out / "sweep.sqlite")
    inputs = {}
    names = [case_name(number, sweep) for number in range(len(sweep.cases))]
    given = fingerprint(sweep.submission, sweep.spec.read_text(encoding="utf-8") + json.dumps(sweep.data["set"]))
    for name, values in zip(names, sweep.cases):
        inputs[name] = values
        store.enlist(name, sweep.submission, given + json.dumps(values))
    store.begin_again(names)
    engine = Cases(sweep, inputs, out, How(options.unsafe, not options.no_films, options.port), options.workers)
    try:
        run(store, engine)
    except KeyboardInterrupt:
        print("\nlab_check: interrupted; the same command goes on from here", file=sys.stderr)
        return 130
    except PlaceError as error:
        print(f"{sweep.path}: {error}", file=sys.stderr)
        return 2
    finally:
        engine.end()
        columns, rows = table(inputs, store)
        written = write_table(columns, rows, out, options.csv)
        pictures = plots(sweep, columns, rows, out)
        write_page(sweep, columns, rows, pictures, out)
        print(f"{written}, {out / 'sweep.html'}")
    return 4 if any(row["state"] == "failed" for row in store.rows() if row["name"] in inputs) else 0


class Cases(Pool):
    """A pool that writes each case down just before it is examined, so that thousands of copies never lie about."""

    def __init__(self, sweep: Sweep, inputs: dict[str, dict[str, Any]], out: pathlib.Path, how: How, workers: int):
        super().__init__(lambda name: out / name / "case" / "spec.yaml", out, how, workers)
        self._sweep, self._inputs = sweep, inputs

    def start(self, name: str, path: pathlib.Path) -> None:
        super().start(name, self._sweep.write_case(self._inputs[name], self._out / name / "case"))

    def take(self, name: str) -> Result | str:
        from shutil import rmtree

        if self._sweep.touches_files:  # the spec stays: its values say how to see the case again
            rmtree(self._out / name / "case" / self._sweep.submission.name, ignore_errors=True)
        return super().take(name)


# ---------------------------------------------------------------------------------------------- the table


def table(inputs: dict[str, dict[str, Any]], store: Store) -> tuple[list[str], list[dict[str, Any]]]:
    """The columns, and a row for each case of ``inputs`` that was examined, as ``store`` has it.

    A row has its parameters, points, points of each task, and each figure that was measured.
    """
    rows, columns = [], ["case", *next(iter(inputs.values()))]
    for stored in store.rows():
        if stored["name"] not in inputs or stored["state"] not in ("done", "failed"):
            continue
        row = {"case": stored["name"], **inputs[stored["name"]], **figures(result_of(stored)), "why": stored["why"] or ""}
        columns += [column for column in row if column not in columns]
        rows.append(row)
    return columns, rows


def figures(result: Result | None) -> dict[str, Any]:
    """What of a result is a number, by names that are the same in every case."""
    if result is None:
        return {}
    found: dict[str, Any] = {"points": result.points, "of": result.of, "seconds": result.seconds}
    for task in result.tasks:
        found[task.name] = task.points
        for number, verdict in enumerate(task.verdicts):
            for key, value in verdict.figures.items():
                if isinstance(value, (int, float)):
                    found[f"{task.name} / {number + 1} {verdict.kind} / {key}"] = float(value)
    return found


def write_table(columns: list[str], rows: list[dict[str, Any]], out: pathlib.Path, as_csv: bool) -> pathlib.Path:
    """Write ``columns`` of ``rows`` into ``out``: Parquet, or CSV with ``as_csv`` or where pyarrow is not there. :returns: the file"""
    try:
        if as_csv:
            raise ImportError
        import pyarrow
        import pyarrow.parquet
    except ImportError:
        path = out / "sweep.csv"
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, columns, restval="")
            writer.writeheader()
            writer.writerows(rows)
        return path
    path = out / "sweep.parquet"
    data = {}
    for column in columns:
        values = [row.get(column) for row in rows]
        kinds = {type(value) for value in values if value is not None}
        if len(kinds) > 1:  # a column has one type
            numbers = kinds <= {int, float}
            values = [None if value is None else float(value) if numbers else str(value) for value in values]
        data[column] = values
    pyarrow.parquet.write_table(pyarrow.table(data), path)
    return path


# ---------------------------------------------------------------------------------------------- plots


def plots(sweep: Sweep, columns: list[str], rows: list[dict[str, Any]], out: pathlib.Path) -> list[tuple[str, pathlib.Path]]:
    """(figure, path) of one picture in ``out`` for the points and each figure that differs between the cases.

    In each there is one plot for every parameter of ``sweep``; ``columns``, ``rows``: from :func:`table`.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    parameters = list(sweep.data["parameters"])
    wanted = [column for column in columns if column not in (*parameters, "case", "of", "why", "seconds")]
    wanted = [c for c in wanted if c == "points" or _differs([row.get(c) for row in rows])][:_MOST_PLOTS] if rows else []
    folder = out / "plots"
    folder.mkdir(exist_ok=True)
    for old in folder.glob("*.png"):
        old.unlink()
    made = []
    for number, column in enumerate(wanted):
        known = [row for row in rows if row.get(column) is not None]
        figure, axes = pyplot.subplots(1, len(parameters), figsize=(4.5 * len(parameters), 3.2), squeeze=False, layout="constrained")
        for axis, name in zip(axes[0], parameters):
            axis.plot(
                [row[name] if isinstance(row[name], (int, float)) else str(row[name]) for row in known],
                [row[column] for row in known],
                "o",
                alpha=0.6,
            )
            axis.set_xlabel(name)
            axis.grid(alpha=0.3)
            if "log" in sweep.data["parameters"][name]:
                axis.set_xscale("log")
        figure.suptitle(column, fontsize=10)
        path = folder / f"{number:02d}.png"
        figure.savefig(path, dpi=90)
        pyplot.close(figure)
        made.append((column, path))
    return made


def _differs(values: list[Any]) -> bool:
    """By more than the last digits of a sum."""
    known = [value for value in values if value is not None]
    return bool(known) and max(known) - min(known) > 1e-9 * max(1.0, *map(abs, known))


def write_page(
    sweep: Sweep, columns: list[str], rows: list[dict[str, Any]], pictures: list[tuple[str, pathlib.Path]], out: pathlib.Path
) -> None:
    """``sweep.html`` in ``out``: the ``pictures`` of ``sweep``, and the first ``columns`` of ``rows`` with a link to each report."""
    parameters = list(sweep.data["parameters"])
    shown = [*parameters, "points", "of"]
    head = "".join(f"<th>{html.escape(column)}" for column in ["case", *shown, "remark"])
    lines = []
    for row in rows:
        cells = "".join(f"<td class=n>{html.escape(_short(row.get(column, '')))}" for column in shown)
        lines.append(f"<tr><td><a href='{row['case']}/report.html'>{row['case']}</a>{cells}<td>{html.escape(row['why'])}")
    images = "".join(f"<p><img src='plots/{path.name}' alt='{html.escape(column, quote=True)}'>" for column, path in pictures)
    title = html.escape(sweep.data["title"])
    text = (
        f'<!doctype html>\n<html lang="en"><meta charset="utf-8"><title>{title}</title><style>{STYLE} body {{max-width: none}}</style>'
        f"<h1>{title}</h1><p class=note>{len(rows)} of {len(sweep.cases)} cases</p>{images}\n<table><tr>{head}\n"
        + "\n".join(lines)
        + "</table></html>\n"
    )
    (out / "sweep.html").write_text(text, encoding="utf-8", errors="xmlcharrefreplace")


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
