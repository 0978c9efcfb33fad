"""scripts/fuzz sees what it is there to see, and a short run of every kind finds nothing."""

import os
import re
import signal
import subprocess
import time
from pathlib import Path
from random import Random

import pytest

ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT / "scripts/fuzzing/corpus"

from fuzzing import tree_cases, values, worker, xml_cases  # noqa: E402
from fuzzing.findings import Found, check_message  # noqa: E402
from fuzzing.kinds import Kind  # noqa: E402
from fuzzing.minimise import minimised  # noqa: E402
from fuzzing.pool import Pool  # noqa: E402
from fuzzing.worker import case_of  # noqa: E402

#: cases of the short run; those of the kinds with nodes are in test_fuzzing_nodes.py
SHORT = {"urdf": 60, "sdf": 60, "world": 40, "plan": 40, "mesh": 40, "api": 80, "xacro": 20}


class Trap(Kind):
    """A case is a word that says what goes wrong."""

    name, suffix = "trap", ".txt"
    time_limit = 1.0
    memory = 1 << 30

    def generate(self, random):
        return b"well"

    def run(self, case):
        for word in case.split():
            getattr(self, word.decode())()

    def smaller(self, case):
        words = case.split()
        for i in range(len(words)):
            yield b" ".join(words[:i] + words[i + 1 :])

    def well(self):
        pass

    def abort(self):
        os.abort()

    def leave(self):
        os._exit(3)

    def hang(self):
        while True:
            pass

    def undeclared(self):
        {}["no such key"]

    def hog(self):
        return bytearray(4 << 30)

    def found(self):
        raise Found("silent NaN", "link_poses", "nan")

    def prints(self):
        os.write(2, b"ODE Message 3: LCP internal error\n")

    def chatter(self):
        check_message("one line\nand another", "a reader")


@pytest.fixture
def pool(tmp_path):
    with Pool(Trap(), 0, tmp_path, 1) as pool:
        yield pool


@pytest.mark.parametrize(
    "case, what",
    [
        (b"abort", "process ended by SIGABRT"),
        (b"leave", "process ended by exit code 3"),
        (b"hang", "hang"),
        (b"undeclared", "undeclared KeyError"),
        (b"hog", "undeclared MemoryError"),
        (b"found", "silent NaN"),
        (b"prints", "output on the terminal"),
        (b"chatter", "message is not one line"),
        (b"nonsense", "undeclared AttributeError"),
    ],
)
def test_what_goes_wrong_is_found_and_the_run_goes_on(pool, case, what):
    assert pool.one(case).what == what
    assert pool.one(b"well") is None


def test_all_cases_of_a_run_are_tried_by_some_workers(tmp_path):
    tried = []
    with Pool(Trap(), 0, tmp_path, 3) as pool:
        pool.run(iter([b"well", b"abort"] * 10), lambda job, finding: tried.append((job, finding and finding.what)) or True)
    assert sorted(tried, key=str) == sorted([(b"well", None), (b"abort", "process ended by SIGABRT")] * 10, key=str)


def test_a_worker_that_has_not_begun_is_ended(tmp_path, monkeypatch):
    lead = os.setpgid  # the first thing that a worker's process does, for itself
    monkeypatch.setattr(os, "setpgid", lambda pid, group: lead(pid, group) if pid else time.sleep(60))
    begun = time.monotonic()
    worker.Worker(Trap(), 0, tmp_path / "worker", 0).end()
    assert time.monotonic() - begun < 30


def test_a_finding_is_made_smaller_and_stays_the_same(pool):
    case = b"well well abort well found well"
    assert minimised(Trap(), pool, case, pool.one(case)) == b"abort"


def test_the_same_seed_makes_the_same_cases():
    mutator = xml_cases.XmlMutator([b"<sdf><model name='a'><pose>1 2 3 0 0 0</pose><link name='l'/></model></sdf>"])

    class Xml(Trap):
        def generate(self, random):
            return mutator.case(random)

    cases = [case_of(Xml(), 5, number) for number in range(50)]
    assert cases == [case_of(Xml(), 5, number) for number in range(50)]
    assert len(set(cases)) > 40 and cases != [case_of(Xml(), 6, number) for number in range(50)]


def test_trees_are_made_smaller_one_value_at_a_time():
    tree = {"a": [1, 2], "b": {"c": "text"}}
    smaller = list(tree_cases.smaller(tree))
    assert {"b": {"c": "text"}} in smaller and {"a": [1], "b": {"c": "text"}} in smaller and {"a": [1, 2], "b": {}} in smaller
    assert tree == {"a": [1, 2], "b": {"c": "text"}}


def test_numbers_in_texts_are_replaced():
    changed = {values.with_numbers_changed(Random(seed), "1 2.5e3 -3") for seed in range(40)}
    assert any(re.match(r"\S+ 2.5e3 -3$", text) for text in changed) and any(text.startswith("1 2.5e3 ") for text in changed)


def fuzz(*arguments, timeout=280):
    """:return: exit code and output. Everything that it started ends with it."""
    process = subprocess.Popen(
        [ROOT / "scripts/fuzz", *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    )
    try:
        output, _ = process.communicate(timeout=timeout)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        raise
    return process.returncode, output


@pytest.mark.slow
@pytest.mark.parametrize("kind", sorted(SHORT))
def test_a_short_run_finds_nothing(kind, tmp_path):
    code, output = fuzz("--kind", kind, "--cases", SHORT[kind], "--seed", 1, "--output", tmp_path, "--patience", 8)
    assert code == 0, output
    assert f"{kind}: {SHORT[kind]} cases in" in output


@pytest.mark.slow
def test_what_once_broke_something_breaks_nothing():
    files = sorted(path for path in CORPUS.iterdir() if not path.name.startswith("nodes_"))
    code, output = fuzz(*files)
    assert code == 0, output
    assert output.count("nothing found") == len(files)


def test_a_replay_says_what_it_cannot_read(tmp_path):
    (tmp_path / "letter.txt").write_text("dear reader")
    code, output = fuzz(tmp_path / "letter.txt")
    assert code == 2 and "what kind is it? Give --kind" in output


def test_ctrl_c_ends_a_run_and_its_workers(tmp_path):
    process = subprocess.Popen(
        [ROOT / "scripts/fuzz", "--kind", "api", "--cases", "100000", "--output", tmp_path],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    process.stdout.readline()
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    output, _ = process.communicate(timeout=60)
    assert process.returncode == 130 and "Traceback" not in output
