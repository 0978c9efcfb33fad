"""A class: submissions on several workers, results as they come, and what was done stays done."""
from __future__ import annotations

import argparse
import json
import os
import pathlib
import signal
import subprocess
import sys
import time
from dataclasses import dataclass
from typing import Callable, Dict, List, Optional, Union

from . import gradebook
from .outcome import Result
from .spec import Spec
from .store import Store, fingerprint
from .supervise import descendants, die_with_parent

TRIES = 2  # for a submission whose worker died


@dataclass
class Running:
    process: subprocess.Popen
    worker: int


class Pool:
    """Examinations in processes of this machine. One that dies is told from one that gives bad marks: it leaves no report."""

    def __init__(self, spec: Spec, out: pathlib.Path, options: argparse.Namespace):
        self._spec, self._out, self._options = spec, out, options
        self.running: Dict[str, Running] = {}

    def start(self, name: str, path: pathlib.Path) -> None:
        free = min(set(range(self._options.workers)) - {r.worker for r in self.running.values()})
        folder = self._out / name
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "report.json").unlink(missing_ok=True)
        words = [sys.executable, "-c", "import sys; from lab_check.cli import check; sys.exit(check())", str(self._spec.path), str(path),
                 "--out", str(folder)]
        words += ["--unsafe", "--port", str((self._options.port or 11400) + 20 * free)] if self._options.unsafe else []
        words += ["--no-films"] if self._options.no_films else []
        with open(folder / "check.txt", "w", encoding="utf-8") as log:
            process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log, start_new_session=True,
                                       preexec_fn=die_with_parent)
        self.running[name] = Running(process, free)

    def ended(self) -> List[str]:
        return [name for name, running in self.running.items() if running.process.poll() is not None]

    def take(self, name: str) -> Union[Result, str]:
        """The result, or why there is none."""
        code = self.running.pop(name).process.returncode
        try:
            result = Result.from_data(json.loads((self._out / name / "report.json").read_text(encoding="utf-8")))
        except (OSError, ValueError, TypeError, KeyError):
            said = (self._out / name / "check.txt").read_text(encoding="utf-8", errors="replace").strip().splitlines()
            how = f"was killed by signal {-code}" if code < 0 else f"ended with code {code}"
            return f"its worker {how}" + (f": {said[-1]}" if said else "")
        return f"the checker itself failed: {result.fault}" if result.fault else result

    def end(self) -> None:
        """Kills what still runs, with all that it started."""
        for running in self.running.values():
            for pid in descendants(running.process.pid):
                try:
                    os.kill(pid, signal.SIGKILL)
                except OSError:
                    continue
            running.process.wait()
        self.running.clear()


def named(paths: List[pathlib.Path]) -> Dict[str, pathlib.Path]:
    """Submissions by the last part of their path; where two have the same, the folder before it goes in front."""
    found: Dict[str, pathlib.Path] = {}
    last = [path.name for path in paths]
    for path in paths:
        name = path.name if last.count(path.name) == 1 else f"{path.parent.name}_{path.name}"
        while name in found:
            name += "_"
        found[name] = path
    return found


def run(store: Store, pool, workers: int, show: Callable[[str], None]) -> None:
    """Until nothing waits and nothing runs."""
    waiting = store.waiting()
    begin, finished, number = time.monotonic(), 0, len(waiting)
    while waiting or pool.running:
        while waiting and len(pool.running) < workers:
            name = waiting.pop(0)
            store.started(name)
            pool.start(name, store.path_of(name))
        ended = pool.ended()
        for name in ended:
            taken = pool.take(name)
            if isinstance(taken, Result):
                store.done(name, taken)
                outcome = f"{taken.points:g} of {taken.of:g}"
            elif store.tries(name) < TRIES:
                store.waits_again(name, taken)
                waiting.append(name)
                show(f"{name}: {taken}; it is tried again")
                continue
            else:
                store.failed(name, taken)
                outcome = f"not examined: {taken}"
            finished += 1
            left = (time.monotonic() - begin) / finished * (number - finished)
            show(f"[{finished}/{number}] {name}: {outcome}; about {left:.0f} s to go")
        if not ended:
            time.sleep(0.1)


def main(arguments: Optional[List[str]] = None) -> int:
    from .cli import allowed, load_spec, parser_for, sandbox_options
    parser = parser_for("grade", "Mark a class; run it again to go on after an interruption.")
    parser.add_argument("submissions", type=pathlib.Path, nargs="+")
    parser.add_argument("--workers", type=int, default=max(1, os.cpu_count() or 1), help="examinations at a time; default: one per core")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("lab_check"), help="default: ./lab_check")
    parser.add_argument("--again", action="store_true", help="also what is done already")
    sandbox_options(parser)
    options = parser.parse_args(arguments)
    if options.workers < 1:
        parser.error("--workers must be at least 1")
    spec = load_spec(options.spec)
    allowed(options.unsafe)
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    store = Store(out / "class.sqlite")
    text = spec.path.read_text(encoding="utf-8") + (str(time.time()) if options.again else "")
    for name, path in named([path for path in options.submissions if path.name != "faults.json"]).items():
        store.enlist(name, path.absolute(), fingerprint(path, text))
    store.begin_again()
    pool = Pool(spec, out, options)
    try:
        run(store, pool, options.workers, lambda line: print(line, flush=True))
    except KeyboardInterrupt:
        print("\nlab_check: interrupted; the same command goes on from here", file=sys.stderr)
        return 130
    finally:
        pool.end()
        gradebook.write(spec, store, out)
    failed = store.counts().get("failed", 0)
    print(f"{out / 'gradebook.html'}, {out / 'gradebook.csv'}" + (f"; {failed} could not be examined" if failed else ""))
    return 4 if failed else 0
