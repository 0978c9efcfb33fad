"""A class: submissions on several workers, results as they come, and what was done stays done."""

from __future__ import annotations

import argparse
import os
import pathlib
import sqlite3
import sys
import time
from collections.abc import Callable

from node_signals.progress import Progress, progress

from ..outcome import Result, name_for
from ..specs.spec import Spec
from . import gradebook
from .cluster import Cluster, ClusterError
from .engines import Engine, How, NotBegun, Pool
from .gradebook import RESULTS
from .remote_engine import Lost, RemoteEngine
from .store import Store, fingerprint

TRIES = 2  # for a submission whose worker died


def named(paths: list[pathlib.Path]) -> dict[str, pathlib.Path]:
    """Submissions, ``paths``, by the last part of their path, as :func:`lab_check.outcome.name_for` has it; where two have the same, the
    folder before it goes in front.
    """
    found: dict[str, pathlib.Path] = {}
    last = [path.name for path in paths]
    for path in paths:
        name = base = name_for(path.name if last.count(path.name) == 1 else f"{path.parent.name}_{path.name}")
        number = 1
        while name in found:
            number += 1
            name = f"{base}_{number}"
        found[name] = path
    return found


def run(store: Store, engine: Engine, show: Callable[[str], None] | None = None) -> None:
    """Until nothing of ``store`` waits and nothing runs on ``engine``.

    :param show: takes each line; None: the terminal, with a bar
    """
    waiting = store.waiting()
    with progress(len(waiting), "examining", "submissions", quiet=show is not None) as bar:
        _run(store, engine, waiting, bar, show or bar.line)


def _run(store: Store, engine: Engine, waiting: list[str], bar: Progress, show: Callable[[str], None]) -> None:
    begin, finished, number = time.monotonic(), 0, len(waiting)
    while waiting or engine.running:
        while waiting and len(engine.running) < engine.workers:
            name = waiting.pop(0)
            store.started(name)
            engine.start(name, store.path_of(name))
        ended = engine.ended()
        for name in ended:
            taken = engine.take(name)
            if isinstance(taken, Result):
                store.done(name, taken)
                outcome = f"{taken.points:g} of {taken.of:g}"
            elif isinstance(taken, NotBegun) or store.tries(name) < TRIES:
                store.waits_again(name, taken, tried=not isinstance(taken, NotBegun))
                waiting.append(name)
                show(f"{name}: {taken}; it is tried again")
                continue
            else:
                store.failed(name, taken)
                outcome = f"not examined: {taken}"
            finished += 1
            bar.update()
            left = (time.monotonic() - begin) / finished * (number - finished)
            show(f"[{finished}/{number}] {name}: {outcome}; about {left:.0f} s to go")
        if not ended:
            time.sleep(0.1)


def results(out: pathlib.Path) -> pathlib.Path:
    """Where a class's reports go below ``out``, each in a folder with the submission's name; the class's own files lie elsewhere."""
    return out / RESULTS


def engine_for(spec: Spec, out: pathlib.Path, options: argparse.Namespace) -> Engine:
    """The engine for ``spec`` that ``options`` of the command line choose, with reports below ``out``.

    :raises ClusterError: an address was given, and no cluster is there that can examine
    """
    how = How(options.unsafe, not options.no_films, options.port)
    if options.address:
        return RemoteEngine(
            Cluster,
            (spec, results(out), how, options.workers or 0, options.address),
            "the cluster, or its head,",
            lambda line: print(f"lab_check: {line}", file=sys.stderr),
        )
    return Pool(lambda name: spec.path, results(out), how, options.workers or max(1, os.cpu_count() or 1))


def main(arguments: list[str] | None = None) -> int:
    from ..cli import allowed, load_spec, parser_for, sandbox_options

    parser = parser_for("grade", "Mark a class; run it again to go on after an interruption.")
    parser.add_argument("submissions", type=pathlib.Path, nargs="+")
    parser.add_argument("--workers", type=int, help="examinations at a time; default: one per core")
    parser.add_argument("--address", help="a Ray cluster: HOST or HOST:PORT, auto for that of this machine; default: processes here")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("lab_check"), help="default: ./lab_check")
    parser.add_argument("--again", action="store_true", help="also what is done already")
    sandbox_options(parser)
    options = parser.parse_args(arguments)
    if options.workers is not None and options.workers < 1:
        parser.error("--workers must be at least 1")
    spec = load_spec(options.spec)
    if not options.address:
        allowed(options.unsafe)
    out = options.out.resolve()
    inside = next((path for path in options.submissions if out.is_relative_to(path.resolve())), None)
    if inside is not None:  # whoever wrote it could have put a class.sqlite of his own there
        parser.error(f"the results would lie in {inside}, which is a submission: name another folder by --out, or leave that one out")
    try:
        return _examine(spec, out, options)
    except KeyboardInterrupt:
        print("\nlab_check: interrupted; the same command goes on from here", file=sys.stderr)
        return 130
    except (ClusterError, Lost) as error:
        print(f"lab_check: {error}", file=sys.stderr)
        return 3
    except (OSError, sqlite3.Error) as error:  # a full disk, a folder that may not be written to
        print(
            f"lab_check: {out}: {getattr(error, 'strerror', None) or error}; when that is mended, the same command goes on from here",
            file=sys.stderr,
        )
        return 5


def _examine(spec: Spec, out: pathlib.Path, options: argparse.Namespace) -> int:
    out.mkdir(parents=True, exist_ok=True)
    store = Store(out / "class.sqlite")
    enlist(store, spec, options)
    engine = engine_for(spec, out, options)
    try:
        run(store, engine)
    finally:
        engine.end()
        gradebook.write(spec, store, out)
    failed = store.counts().get("failed", 0)
    print(f"{out / 'gradebook.html'}, {out / 'gradebook.csv'}" + (f"; {failed} could not be examined" if failed else ""))
    return 4 if failed else 0


def examined_by(spec: Spec) -> str:
    """The spec with what it names beside itself: when that is another, all are examined again."""
    folder = spec.path.parent
    functions = {folder / e["python"]["file"] for task in spec.data["tasks"] for e in task["expect"] if "python" in e}
    texts = [path.read_text(encoding="utf-8") for path in (spec.path, *sorted(functions))]
    return "".join(texts + [fingerprint(folder / name, "") for name in spec.data["also"]])


def enlist(store: Store, spec: Spec, options: argparse.Namespace) -> None:
    """The submissions of ``options``, the command line, and what an earlier run left undone in ``store``, wait to be examined by
    ``spec``.
    """
    text = examined_by(spec) + (str(time.time()) if options.again else "")
    for name, path in named([path for path in options.submissions if path.name != "faults.json"]).items():
        store.enlist(name, path.absolute(), fingerprint(path, text))
    store.begin_again()
