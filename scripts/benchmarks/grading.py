"""A class of arm homeworks with seeded faults: how long it takes, what a second worker brings, what the sandbox and a long queue cost."""

import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

from lab_check import faults
from lab_check.isolation import sandbox
from lab_check.outcome import Result
from lab_check.report import marks

ROOT = pathlib.Path(__file__).resolve().parents[2]
ARM = ROOT / "src" / "labs" / "arm"
SPEC = ROOT / "src" / "teaching" / "lab_check" / "specs" / "arm_homework.yaml"


def grade(folder, out, workers):
    """(wall seconds, processor seconds, marks by submission) of a class."""
    submissions = sorted(path for path in folder.iterdir() if path.is_dir())
    begin, before = time.monotonic(), processor_seconds()
    done = subprocess.run(
        ["rosrun", "lab_check", "grade", str(SPEC), *map(str, submissions), "--workers", str(workers), "--no-films", "--out", str(out)],
        capture_output=True,
        text=True,
    )
    if done.returncode:
        raise SystemExit(f"grading.py: {done.stdout[-300:]}{done.stderr[-300:]}")
    took, used = time.monotonic() - begin, processor_seconds() - before
    results = {path.name: Result.from_data(json.loads((out / path.name / "report.json").read_text())) for path in submissions}
    return took, used, {name: marks(result) for name, result in results.items()}


def processor_seconds():
    """Of all ended programs that this one started."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def plain_throughput():
    """Of two programs that only count, against one: the most that a second worker can bring on this machine."""
    words, took = [sys.executable, "-c", "sum(i * i for i in range(30_000_000))"], {}
    for number in (1, 2):
        begin = time.monotonic()
        for one in [subprocess.Popen(words) for _ in range(number)]:
            one.wait()
        took[number] = time.monotonic() - begin
    return 2 * took[1] / took[2]


def sandbox_cost(scratch, runs=10):
    """Seconds that both walls add to a program that does nothing: the outer once, the inner for each of three programs."""
    platform = sandbox.Platform.here()
    home = scratch / "cost" / "home"
    home.mkdir(parents=True)
    inner = sandbox.inner_words(platform, str(home), sandbox.environment(11311))
    words = {"bare": ["true"], "inner": [*inner, "true"], "outer": [*sandbox.outer_words(), "true"]}
    cost = {}
    for name, command in words.items():
        begin = time.monotonic()
        for _ in range(runs):
            subprocess.run(command, check=True, capture_output=True)
        cost[name] = (time.monotonic() - begin) / runs
    return (cost["outer"] - cost["bare"]) + 3 * (cost["inner"] - cost["bare"])


def queue(count, scratch):
    """Grades ``count`` submissions whose examination takes no time; for a process of its own, which prints its peak memory, MB."""
    from lab_check.classroom import grade, gradebook
    from lab_check.classroom.engines import Engine
    from lab_check.classroom.store import Store
    from lab_check.outcome import TaskResult, Verdict
    from lab_check.specs import spec

    class Nothing(Engine):
        def __init__(self):
            self.running, self.workers = {}, 100

        def start(self, name, path):
            self.running[name] = path

        def ended(self):
            return list(self.running)

        def take(self, name):
            del self.running[name]
            verdicts = [Verdict("joint", True, f"joint j{i} was at 1 rad after 2 s", 2.5, figures={"error": 0.01}) for i in range(8)]
            return Result("Empty work", name, 20.0, 20.0, tasks=[TaskResult("Nothing", 20.0, 20.0, verdicts)])

        def end(self):
            pass

    store = Store(scratch / "class.sqlite")
    for number in range(count):
        store.enlist(f"student{number:05}", scratch / "none", "")
    grade.run(store, Nothing(), lambda line: None)
    gradebook.write(spec.load(SPEC), store, scratch)
    print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)


def queue_memory(count, scratch):
    """MB that the driver's process takes at most for a queue of ``count``, and for one of 10."""
    words = "import grading, pathlib, sys; grading.queue(int(sys.argv[1]), pathlib.Path(sys.argv[2]))"
    found = []
    for number in (count, 10):
        place = scratch / f"queue{number}"
        place.mkdir()
        done = subprocess.run(
            [sys.executable, "-c", words, str(number), str(place)],
            cwd=pathlib.Path(__file__).parent,
            check=True,
            capture_output=True,
            text=True,
        )
        found.append(float(done.stdout))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", required=True)
    parser.add_argument("--count", type=int, default=40)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder)
        figures = {"sandbox: seconds for a submission": sandbox_cost(scratch)}
        figures["class: driver's memory for a queue of 10000, MB"], figures["class: driver's memory for a queue of 10, MB"] = queue_memory(
            10000, scratch
        )
        faults.make(ARM, scratch / "class", options.count)
        two, _, first = grade(scratch / "class", scratch / "two", 2)
        figures[f"{options.count} arm homeworks, 2 workers: seconds"] = two
        part = max(options.count // 4, 2)
        faults.make(ARM, scratch / "part", part)
        _, _, alone = grade(scratch / "part", scratch / "alone", 1)
        # Copies that take equally long: of others, one worker would wait for the other's last. So many that the start of the command,
        # which no second worker shortens, weighs little.
        equal = max(2 * (3 * options.count // 20), 2)
        faults.make(ARM, scratch / "equal", equal, faults=[fault for fault in faults.FAULTS if fault.name == "none"])
        one_part, one_used, _ = grade(scratch / "equal", scratch / "one", 1)
        two_part, two_used, _ = grade(scratch / "equal", scratch / "again", 2)
        figures["class: throughput of 2 workers / 1"] = one_part / two_part
        figures["class: throughput of 2 programs that only count / 1"] = plain_throughput()
        for name, wall, used in (("1 worker", one_part, one_used), ("2 workers", two_part, two_used)):
            figures[f"class: wall seconds of a submission, {name}"] = wall / equal
            figures[f"class: processor seconds of a submission, {name}"] = used / equal
        figures["class: share of submissions with the same marks by 1 and 2 workers"] = sum(
            alone[name] == first[name] for name in alone
        ) / len(alone)
    with open(options.json, "w", encoding="utf-8") as out:
        json.dump(figures, out)


if __name__ == "__main__":
    main()
