"""Runs the workspace's tests: pytest for ROS-free code, rostest for whatever talks ROS; one job more at a time than there are cores.

Every ``test/test_*.py`` below src/ is pytest's, every ``test/*.test`` is rostest's (on a master of its own). Closes with
one line ``N passed, M failed``, before it the cases that failed, each with its reason; the output of what failed is printed
in full, and kept with the rest in --logs.

With --again up to five files that failed run once more, up to twice, one after the other, when all others have ended; of pytest's
only the tests that failed. What passes then counts as passed, but a line ``unsteady: ...`` says what had failed: a fault of the
test or of what it tests, to be found.
What takes long is marked as slow, a test of pytest by ``@pytest.mark.slow``, a file of rostest by the comment ``<!-- slow -->``. It is
left out, unless packages are named, or --all or --since is given.
With --since COMMIT only what a change since that commit can break is tested: the packages with a file that differs, what needs them,
whose tests use any of these, and the scripts.
With --coverage the lines of Python that were run are counted, in nodes as well; the pages are in out/coverage.
"""

from __future__ import annotations

import argparse
import contextlib
import os
import queue
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Container, Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

import changed_packages
import coverage_of_tests

ROOT = Path(__file__).resolve().parent.parent
TIME_LIMIT = 600  # s for one file; a test that takes longer hangs
GRACE = 3  # s in which what it started ends after it
ENDING = 30  # s in which it ends what it started, before it is killed
LONGEST = 2400  # s, for a folder of several files
QUIET_LINES = 80  # of the output of what failed, with --quiet
REASON = 200  # characters of the reason of a case, with --quiet
SECOND_TRIES = 5  # files; if more have failed, it is no accident
MOST_WORKERS = 3  # one more than two cores: rostests wait for wall time as well, and two workers leave a third of the cores idle
AGAIN = 2  # times that each of them runs once more
SLOW = "<!-- slow -->"  # in a file of rostest
NONE_CHOSEN = 5  # pytest's exit code, if all tests of a folder are left out


@dataclass
class Job:
    package: Path
    kind: str
    path: Path
    slow: bool = True  # pytest: the slow tests too
    failed_only: bool = False  # pytest: only the tests that failed when it ran last, with the same logs

    @property
    def name(self) -> str:
        return f"{self.package.name}/{self.path.relative_to(self.package)}"

    @property
    def files(self) -> int:
        """How many files of tests it runs."""
        return max(1, len(list(self.path.rglob("test_*.py"))))

    @property
    def time_limit(self) -> int:
        """s"""
        return min(LONGEST, TIME_LIMIT * self.files)


@dataclass
class Result:
    job: Job
    passed: int
    failed: int
    skipped: int
    seconds: float
    output: str
    reasons: list[str] = field(default_factory=list)
    left_out: int = 0
    left_behind: list[str] = field(default_factory=list)  # processes that did not end with it


def find_jobs(packages: Container[str], kind: str, scripts: bool, slow: bool) -> list[Job]:
    """All test files of these packages, and those of scripts/ if asked for; with or without what is slow."""
    jobs: list[Job] = []
    for manifest in sorted([*(ROOT / "src").rglob("package.xml"), *(ROOT / "docs").rglob("package.xml")]):
        package = manifest.parent
        if package.name not in packages:
            continue
        test = package / "test"
        if not test.is_dir():
            continue
        if kind in ("rostest", "all"):
            jobs += [Job(package, "rostest", path) for path in sorted(test.rglob("*.test")) if slow or SLOW not in path.read_text()]
        if kind in ("pytest", "all") and any(test.rglob("test_*.py")):
            jobs.append(Job(package, "pytest", test, slow))
    if scripts and kind in ("pytest", "all"):
        jobs += [Job(ROOT, "pytest", path, slow) for path in sorted((ROOT / "scripts" / "tests").glob("test_*.py"))]
    # What takes long first, at the end all have something to do: folders of many files, packages of many rostests in a row.
    in_a_row = Counter(job.package for job in jobs if job.kind == "rostest")
    return sorted(jobs, key=lambda job: -(in_a_row[job.package] if job.kind == "rostest" else job.files))


class UnknownPackage(Exception):
    """A package is named that the workspace does not have."""


def chosen(named: list[str], since: str | None) -> set[str]:
    """
    The packages that are tested: those named, or all; of these what a change since the commit ``since``, if given, can break.

    :raises changed_packages.UnknownCommit:
    :raises UnknownPackage: if one that is named is neither in src/ nor in docs/
    """
    workspace = changed_packages.workspace()
    known = {package.name for package in workspace.values()}
    if unknown := sorted(set(named) - known):
        raise UnknownPackage(f"no package {', '.join(unknown)} in src/ or docs/")
    names = set(named) or known
    if since is not None:
        names &= changed_packages.breakable(changed_packages.changed_files(since), workspace)
    return names


class Queue:
    """
    Jobs for several workers. Every second worker prefers pytest, which computes, to rostests, which mostly wait. Of one package
    only one rostest is at work: those of windows each have a browser, for two of which two cores are too slow.
    """

    def __init__(self, jobs: list[Job]) -> None:
        self._changed = threading.Condition()
        self._at_work: set[Path] = set()  # packages
        self._kinds: dict[str, list[Job]] = {"rostest": [], "pytest": []}
        for job in jobs:
            self._kinds[job.kind].append(job)

    def take(self, worker: int) -> Job | None:
        """The next job of worker number ``worker``, None when all are taken."""
        order = ("pytest", "rostest") if worker % 2 else ("rostest", "pytest")
        with self._changed:
            while any(self._kinds.values()):
                ready = (job for kind in order for job in self._kinds[kind] if kind == "pytest" or job.package not in self._at_work)
                job = next(ready, None)
                if job:
                    self._kinds[job.kind].remove(job)
                    if job.kind == "rostest":
                        self._at_work.add(job.package)
                    return job
                self._changed.wait()
            return None

    def done(self, job: Job) -> None:
        """It has ended."""
        with self._changed:
            if job.kind == "rostest":
                self._at_work.discard(job.package)
            self._changed.notify_all()


def run_all(jobs: list[Job], workers: int, scratch: Path) -> Iterator[Result]:
    """Results of all jobs as they come."""
    waiting, results = Queue(jobs), queue.Queue()

    def work(worker: int) -> None:
        while (job := waiting.take(worker)) is not None:
            try:
                results.put(run(job, scratch))
            except Exception as error:  # a fault of this runner is a failure of the job, not a silence
                results.put(Result(job, 0, 1, 0, 0.0, f"{job.name}: the test runner failed: {error!r}"))
            waiting.done(job)

    for worker in range(workers):
        threading.Thread(target=work, args=(worker,), daemon=True).start()
    for _ in jobs:
        yield results.get()


def count(report: Path) -> tuple[int, int, int]:
    """(passed, failed, skipped) from a JUnit file; a missing one counts as one failure."""
    try:
        root = ET.parse(report).getroot()
    except (OSError, ET.ParseError):
        return 0, 1, 0
    suites = [root] if root.tag == "testsuite" else list(root.iter("testsuite"))
    total = failed = skipped = 0
    for suite in suites:
        total += int(suite.get("tests", 0))
        failed += int(suite.get("failures", 0)) + int(suite.get("errors", 0))
        skipped += int(suite.get("skipped", suite.get("skip", 0)) or 0)
    return total - failed - skipped, failed, skipped


def counts(job: Job, home: Path) -> tuple[int, int, int]:
    """(passed, failed, skipped) from the reports that a job has left in its folder."""
    if job.kind == "pytest":
        return count(home / "report.xml")
    # rosunit-*.xml hold the test cases; rostest-*.xml also knows of test nodes that died without a report.
    results = home / "results"
    cases = [count(report) for report in sorted(results.rglob("rosunit-*.xml"))]
    nodes = [count(report) for report in sorted(results.rglob("rostest-*.xml"))] or [(0, 1, 0)]
    return sum(c[0] for c in cases), max(sum(c[1] for c in cases), sum(n[1] for n in nodes)), sum(c[2] for c in cases)


def left_out(output: str) -> int:
    """How many tests pytest says that it left out."""
    found = re.search(r"(\d+) deselected", output)
    return int(found.group(1)) if found else 0


def reasons(home: Path) -> Iterator[str]:
    """One line for each case that failed: its name and why, from the reports below ``home``."""
    for report in sorted(home.rglob("*.xml")):
        try:
            cases = list(ET.parse(report).getroot().iter("testcase"))
        except (OSError, ET.ParseError):
            continue
        for case in cases:
            for fault in [*case.findall("failure"), *case.findall("error")]:
                lines = (fault.text or "").strip().splitlines() or [""]
                # pytest gives the message as an attribute; rosunit begins the text with it; gtest and a traceback end with it
                why = fault.get("message") or lines[-1 if lines[0].startswith("Traceback") else 0]
                yield f"{case.get('classname', '')}.{case.get('name', '')}: {' '.join(why.split())[:500]}"


def _gazebo_port() -> int:
    """Free at this moment, and none that the system gives away by itself: for the simulators of one file."""
    for port in random.sample(range(30000, 32000), 200):
        with socket.socket() as place:
            try:
                place.bind(("", port))
            except OSError:
                continue
            return port
    return 11345


def _listen_to_ctrl_c() -> None:
    """Started in the background of a script, this process ignores SIGINT; what it tests must not inherit that."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def run(job: Job, scratch: Path) -> Result:
    """One file in a session of its own. Whatever it leaves behind is ended, and told."""
    with tempfile.TemporaryDirectory(prefix="t_", ignore_cleanup_errors=True) as temporary:  # short: paths of sockets have 107 bytes
        return _run_in(job, scratch, temporary)


def _environment(job: Job, home: Path, temporary: str) -> dict[str, str]:
    environment = dict(
        os.environ,
        ROS_HOME=str(home),
        ROS_TEST_RESULTS_DIR=str(home / "results"),
        TMPDIR=temporary,
        GAZEBO_MASTER_URI=f"http://localhost:{_gazebo_port()}",
        PYTHONUNBUFFERED="1",
    )  # tests read what nodes print, as it is printed
    environment.pop("PYTHONDONTWRITEBYTECODE", None)  # every node of every test would compile all messages anew
    if ROOT / "docs" in job.package.parents:  # an example to copy, which is not built here
        environment["ROS_PACKAGE_PATH"] = f"{job.package}:{environment.get('ROS_PACKAGE_PATH', '')}"
    return environment


def _command(job: Job, scratch: Path, home: Path) -> list[str]:
    if job.kind != "pytest":
        return ["rostest", str(job.path)]
    chosen = ([] if job.slow else ["-m", "not slow"]) + (["--last-failed"] if job.failed_only else [])
    options = ["-q", "-o", f"cache_dir={scratch / 'pytest' / job.name}", "--durations=5", "--durations-min=2"]
    return [sys.executable, "-m", "pytest", *options, f"--junitxml={home / 'report.xml'}", *chosen, str(job.path)]


def _ends(process: subprocess.Popen, seconds: float) -> bool:
    try:
        process.wait(seconds)
        return True
    except subprocess.TimeoutExpired:
        return False


def _started_with(temporary: str) -> dict[int, str]:
    """Process ids, and names, of all that were started with this TMPDIR, whatever session or group they are in now."""
    found = {}
    for place in Path("/proc").glob("[0-9]*"):
        try:
            if f"TMPDIR={temporary}".encode() in (place / "environ").read_bytes().split(b"\0"):
                found[int(place.name)] = (place / "comm").read_text().strip()
        except OSError:  # another user's, or just ended
            continue
    return found


def end_what_is_left(temporary: str) -> list[str]:
    """Kills the processes of a file that has ended which do not end by themselves in a moment, and waits for them; their names."""
    left = _still_there(temporary, GRACE)
    for pid in left:
        with contextlib.suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
    if left:
        _still_there(temporary, ENDING)  # on a busy machine a killed process takes a while to be gone
    return sorted(set(left.values()))


def _still_there(temporary: str, seconds: float) -> dict[int, str]:
    """What :func:`_started_with` finds as soon as that is nothing, or after so long."""
    until = time.monotonic() + seconds
    while (left := _started_with(temporary)) and time.monotonic() < until:
        time.sleep(0.1)
    return left


def _run_in(job: Job, scratch: Path, temporary: str) -> Result:
    """:param temporary: the folder for what its processes, which may be killed, would leave in /tmp"""
    home = Path(tempfile.mkdtemp(prefix=job.package.name + "_", dir=scratch))
    start = time.monotonic()
    said = home / "output"
    with said.open("wb") as file:  # not a pipe: a process that outlives the test would hold it open, and this one would wait for it
        process = subprocess.Popen(
            _command(job, scratch, home),
            cwd=home,
            env=_environment(job, home, temporary),
            stdin=subprocess.DEVNULL,
            stdout=file,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            preexec_fn=_listen_to_ctrl_c,
        )
    stopped = not _ends(process, job.time_limit)
    if stopped:
        os.killpg(process.pid, signal.SIGINT)  # rostest's nodes have sessions of their own; it ends them on this
        if not _ends(process, ENDING):
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
    left = end_what_is_left(temporary)
    output = said.read_text(errors="replace")
    if stopped:
        output += f"\n{job.name}: stopped after {job.time_limit} s\n"
    if left:
        output += f"\n{job.name}: ended what it had left behind: {', '.join(left)}\n"
    seconds = time.monotonic() - start
    aside = 0 if job.slow else left_out(output)
    nothing_chosen = aside > 0 and process.returncode == NONE_CHOSEN
    passed, failed, skipped = (0, 0, 0) if nothing_chosen else counts(job, home)
    if not nothing_chosen:
        if process.returncode != 0 and failed == 0:
            failed += 1
            output += f"\n{job.name}: exit code {process.returncode}\n"
        if passed + failed == 0:
            failed += 1
            output += f"\n{job.name}: no test ran\n"
    (scratch / (job.name.replace("/", "__") + ".log")).write_text(output)
    return Result(job, passed, failed, skipped, seconds, output, list(reasons(home)) if failed else [], aside, left)


def faults(result: Result) -> list[str]:
    """One line for each case of this file that failed."""
    return [f"{result.job.name}: {reason}" for reason in result.reasons or ["see its output"]]


def tell(result: Result, quiet: bool) -> None:
    """One line for a file; if it failed, the reasons and its output as well. Quiet: the reasons of failures only."""
    if quiet and not result.failed:
        return
    mark = "FAIL" if result.failed else "ok"
    print(f"{mark:4} {result.job.kind:7} {result.job.name:70} {result.passed:4} passed {result.seconds:6.1f} s", flush=True)
    if result.failed and quiet:
        print("\n".join(f"     {reason[:REASON]}" for reason in result.reasons), flush=True)
    elif result.failed:
        print("\n".join(f"     {reason}" for reason in result.reasons), result.output, sep="\n", flush=True)


def second_tries(results: dict[Path, Result], scratch: Path, quiet: bool) -> list[str]:
    """Runs the few files that failed again and puts what comes of it into ``results``; one line for each case that was unsteady."""
    unsteady: list[str] = []
    broken = [result for result in results.values() if result.failed]
    for first in broken if len(broken) <= SECOND_TRIES else []:
        last = first
        for _ in range(AGAIN):
            print(f"once more: {first.job.name}", flush=True)
            another = run(replace(first.job, failed_only=True), scratch)
            if first.job.kind == "pytest":  # what did not fail before has not run once more
                another = replace(another, passed=last.passed + another.passed, skipped=last.skipped + another.skipped)
            last = results[first.job.path] = another
            tell(another, quiet)
            if not another.failed:
                unsteady += faults(first)
                break
    return unsteady


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("packages", nargs="*", help="only these packages")
    parser.add_argument("--all", action="store_true", help="what is marked as slow too")
    parser.add_argument("--since", metavar="COMMIT", help="only what a change since this commit can break, uncommitted files included")
    parser.add_argument("-k", "--kind", choices=["all", "pytest", "rostest"], default="all")
    parser.add_argument("-j", "--jobs", type=int, default=min(MOST_WORKERS, (os.cpu_count() or 1) + 1))
    parser.add_argument("--again", action="store_true", help="run the few files that failed again, alone")
    parser.add_argument("--quiet", action="store_true", help="tell only what fails")
    parser.add_argument("--coverage", action="store_true", help="count the lines of Python that are run; pages in out/coverage")
    parser.add_argument("--logs", default=None, help="keep all output in this folder")
    return parser


def main() -> int:
    parser = _parser()
    options = parser.parse_args()
    scratch = Path(options.logs or tempfile.mkdtemp(prefix="noetic_labs_test_")).resolve()
    scratch.mkdir(parents=True, exist_ok=True)
    try:
        packages = chosen(options.packages, options.since)
    except (UnknownPackage, changed_packages.UnknownCommit) as error:
        parser.error(str(error))
    slow = bool(options.all or options.packages or options.since)
    jobs = find_jobs(packages, options.kind, scripts=not options.packages, slow=slow)
    if options.since:
        print(f"since {options.since}: {len(packages)} packages can be broken, {len(jobs)} files of tests", flush=True)
    if not jobs:
        if options.since:
            return 0
        print(f"no tests found for {' '.join(options.packages) or 'any package'}", file=sys.stderr)
        return 1
    if options.coverage:
        coverage_of_tests.install()
        os.environ.update(coverage_of_tests.environment(scratch / "coverage"))
    start = time.monotonic()
    results: dict[Path, Result] = {}
    for result in run_all(jobs, options.jobs, scratch):
        results[result.job.path] = result
        tell(result, options.quiet)
    unsteady = second_tries(results, scratch, options.quiet) if options.again else []
    if options.quiet:
        for result in results.values():
            if result.failed:
                print(f"--- the end of what {result.job.name} printed", *result.output.splitlines()[-QUIET_LINES:], sep="\n")
    if options.coverage:
        print(*coverage_of_tests.report(scratch / "coverage", ROOT / "out" / "coverage", options.packages), sep="\n")
    print(f"{time.monotonic() - start:.0f} s in all, logs in {scratch}")
    passed, failed, skipped = (sum(getattr(result, kind) for result in results.values()) for kind in ("passed", "failed", "skipped"))
    if not failed and not unsteady and not options.logs:
        shutil.rmtree(scratch, ignore_errors=True)
    if not slow:
        files = len(find_jobs(packages, options.kind, scripts=True, slow=True)) - len(jobs)
        tests = sum(result.left_out for result in results.values())
        print(f"left out as slow: {files} files of rostest and {tests} tests of pytest; --all runs them too")
    for result in results.values():
        if result.left_behind:
            print(f"left behind by {result.job.name}, and ended: {', '.join(result.left_behind)}")
    print("".join(f"unsteady: {fault}\n" for fault in unsteady), end="")
    print("".join(f"failed: {fault}\n" for result in results.values() if result.failed for fault in faults(result)), end="")
    print(f"{passed} passed, {failed} failed, {skipped} skipped")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
