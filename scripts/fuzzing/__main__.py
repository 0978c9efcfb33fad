"""The command ``scripts/fuzz``."""

from __future__ import annotations

import argparse
import os
import shutil
import signal
import sys
import tempfile
import zlib
from pathlib import Path

from fuzzing.findings import ROOT, Finding
from fuzzing.kinds import Kind, all_kinds, kind_of_file
from fuzzing.minimise import minimised
from fuzzing.pool import Clock, Pool
from fuzzing.worker import Job, case_of

_FAST = "/dev/shm"  # many small files are written


def main() -> int:
    """:return: 0 nothing found, 1 something found, 2 wrong options."""
    kinds = all_kinds()
    options = _options(list(kinds))
    here = os.getcwd()
    scratch = Path(tempfile.mkdtemp(prefix="noetic_labs_fuzz_", dir=_FAST if os.access(_FAST, os.W_OK) else None))
    for number in (signal.SIGINT, signal.SIGTERM):  # also when started in the background of a script
        signal.signal(number, signal.default_int_handler)
    os.chdir(scratch)  # kinds write files where they are
    try:
        if options.files:
            return _replay(kinds, options, scratch)
        run = Run(options, scratch, here)
        for name in options.kind or kinds:
            run.kind(kinds[name])
        return run.close()
    except KeyboardInterrupt:
        print("fuzz: stopped", file=sys.stderr)
        return 130
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


def _options(kinds: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="scripts/fuzz",
        epilog="What a kind is and what counts as found: docs/fuzzing.md",
        description="Hostile inputs for everything that reads or is told something.",
    )
    parser.add_argument("files", nargs="*", metavar="FILE", help="replay these cases, nothing else")
    parser.add_argument("-k", "--kind", action="append", choices=kinds, help="only this kind; may be repeated")
    parser.add_argument("-n", "--cases", type=int, default=1000, help="of each kind (%(default)s)")
    parser.add_argument("-s", "--seed", type=int, default=0, help="the same seed makes the same cases (%(default)s)")
    parser.add_argument("-f", "--first", type=int, default=0, help="number of the first case (%(default)s)")
    parser.add_argument("-j", "--jobs", type=int, default=min(2, os.cpu_count() or 1), help="processes at a time (%(default)s)")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "out" / "fuzz", help="where what is found is saved (%(default)s)")
    parser.add_argument("--most", type=int, default=20, help="different findings of a kind, then go to the next (%(default)s)")
    parser.add_argument("--patience", type=float, default=60.0, help="s to spend on making one finding smaller (%(default)s)")
    options = parser.parse_args()
    if options.cases < 1 or options.jobs < 1:
        parser.error("--cases and --jobs must be positive")
    for name in options.files:
        if not os.path.isfile(name):
            parser.error(f"{name}: no such file")
    options.files = [Path(name).resolve() for name in options.files]
    options.output = options.output.resolve()
    return options


class Run:
    """Cases of kind after kind; findings at equal places are one."""

    def __init__(self, options: argparse.Namespace, scratch: Path, here: str):
        self._options, self._scratch, self._here = options, scratch, here
        self._found: dict[tuple[str, str], tuple[Finding, int]] = {}

    def kind(self, kind: Kind) -> None:
        print(f"{kind.name}: {self._options.cases} cases, seed {self._options.seed} ...", flush=True)
        kind.prepare()
        clock, new = Clock(), []  # type: Clock, List[Tuple[Job, Finding]]

        def report(job: Job, finding: Finding | None) -> bool:
            clock.cases += 1
            if finding is not None:
                known, count = self._found.get(finding.key, (finding, 0))
                self._found[finding.key] = (known, count + 1)
                if not count:
                    new.append((job, finding))
                    print(f"  case {job}: {finding}", flush=True)
            return len(new) < self._options.most

        first = self._options.first
        try:
            with Pool(kind, self._options.seed, self._scratch, self._options.jobs) as pool:
                pool.run(iter(range(first, first + self._options.cases)), report)
        except KeyboardInterrupt:
            print(f"{kind.name}: stopped after {clock.cases} cases in {clock.seconds:.0f} s", flush=True)
            raise
        rate, seconds = clock.rate, clock.seconds
        with Pool(kind, self._options.seed, self._scratch, 1) as pool:
            for job, finding in new:
                self._save(kind, pool, job, finding)
        print(f"{kind.name}: {clock.cases} cases in {seconds:.0f} s ({rate:.1f} a second), {len(new)} new findings", flush=True)

    def _save(self, kind: Kind, pool: Pool, job: Job, finding: Finding) -> None:
        case = case_of(kind, self._options.seed, job) if isinstance(job, int) else job
        again = pool.one(case)
        if again is None or again.key != finding.key:
            remark = "not found again alone"
        else:
            case = minimised(kind, pool, case, finding, self._options.patience)
            remark = f"{len(case)} bytes"
        self._options.output.mkdir(parents=True, exist_ok=True)
        path = self._options.output / f"{kind.name}_{finding.slug}_{zlib.crc32(repr(finding.key).encode()):08x}{kind.suffix}"
        path.write_bytes(case)
        shown = os.path.relpath(path, self._here)
        print(f"  {finding}\n    {remark}: scripts/fuzz {shown if len(shown) < len(str(path)) else path}", flush=True)

    def close(self) -> int:
        for finding, count in sorted(self._found.values(), key=lambda entry: -entry[1]):
            print(f"{count:6}  {finding}")
        print(f"{len(self._found)} different findings")
        return 1 if self._found else 0


def _replay(kinds: dict[str, Kind], options: argparse.Namespace, scratch: Path) -> int:
    worst = 0
    prepared = set()
    for path in options.files:
        name = (options.kind or [kind_of_file(path)])[0]
        if name is None:
            print(f"{path}: what kind is it? Give --kind", file=sys.stderr)
            return 2
        if name not in prepared:
            kinds[name].prepare()
            prepared.add(name)
        with Pool(kinds[name], options.seed, scratch, 1) as pool:
            finding = pool.one(path.read_bytes())
        print(f"{path}: {finding or 'nothing found'}", flush=True)
        worst = max(worst, int(finding is not None))
    return worst


if __name__ == "__main__":
    sys.exit(main())
