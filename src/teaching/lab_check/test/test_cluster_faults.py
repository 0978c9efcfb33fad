"""A cluster of four nodes on this machine, each a raylet of its own: the pool's marks, and what is lost when a node, the driver or the head
is killed in mid-run. Submissions sleep while CMake configures them, until the test ends their sleep: nothing here hopes for a moment."""

import csv
import functools
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time

import pytest
from lab_check.check import free_port
from lab_check.isolation import sandbox
from test_support import wait_until as wait

NAP = f"99{os.getpid()}"  # s that submissions sleep, with the number of one behind the point: as nobody else does
SPEC = """\
title: T
packages: [p]
build: {points: 3, timeout: 3000}
tasks:
  - {name: A, points: 4, launch: '', expect: [{file: {path: '*/readme.txt', contains: hello}}, {file: {path: '*/x'}}]}
"""
MANIFEST = (
    "<package format='2'><name>p</name><version>1.0.0</version><description>d</description>"
    "<maintainer email='a@b.de'>m</maintainer><license>BSD</license><buildtool_depend>catkin</buildtool_depend></package>"
)
CMAKE = "cmake_minimum_required(VERSION 3.10)\nproject(p)\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
POINTS = ["5.0", "3.0", "5.0", "3.0", "5.0", "3.0"]  # of the submissions in turn: a file that every second one lacks

wait_until = functools.partial(wait, timeout=300.0)  # a busy machine is given its time

pytestmark = pytest.mark.slow


def asleep():
    """Number of a submission -> process that sleeps for it."""
    found = {}
    for place in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (place / "cmdline").read_bytes().decode(errors="replace").split("\0")
        except OSError:
            continue
        if words[:1] == ["sleep"] and words[1].startswith(f"{NAP}."):
            found[int(words[1].partition(".")[2])] = int(place.name)
    return found


def wake(number=None):
    """Ends the sleep of one, or of all."""
    for one, pid in asleep().items():
        if number in (None, one):
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                continue


class Nodes:
    """``ray start`` for each, one after the other: two that start at once get in each other's way."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lc_ray.", dir="/tmp"))  # paths of sockets must be short
        self.address = f"127.0.0.1:{free_port()}"
        self.processes = []
        self.add("--head", f"--port={self.address.rpartition(':')[2]}", f"--temp-dir={self.folder}", "--include-dashboard=false")
        for _ in range(3):
            self.add(f"--address={self.address}")

    def add(self, *words):
        log = self.folder / f"start{len(self.processes)}.log"
        with open(log, "w", encoding="utf-8") as file:
            process = subprocess.Popen(
                [
                    "rosrun",
                    "lab_check",
                    "ray",
                    "start",
                    *words,
                    "--num-cpus=1",
                    "--min-worker-port=0",
                    "--max-worker-port=0",
                    "--object-store-memory=100000000",
                    "--block",
                ],
                stdout=file,
                stderr=file,
                start_new_session=True,
                env={**os.environ, "RAY_AUTH_MODE": "disabled"},
            )
        self.processes.append(process)
        wait_until(lambda: "block forever" in log.read_text() or process.poll() is not None, log)
        if process.poll() is not None:
            pytest.fail(f"a node did not start: {log.read_text()[-600:]}")

    def kill(self, number):
        """All that belongs to a node, at once."""
        os.killpg(self.processes[number].pid, signal.SIGKILL)
        self.processes[number].wait()

    def end(self):
        for number, process in enumerate(self.processes):
            if process.poll() is None:
                self.kill(number)
        shutil.rmtree(self.folder, ignore_errors=True)


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    pytest.importorskip("ray", reason="ray is not installed: scripts/setup --teaching")
    try:
        sandbox.check()
    except sandbox.SandboxError as error:
        pytest.skip(str(error))
    place = tmp_path_factory.mktemp("class")
    (place / "spec.yaml").write_text(SPEC)
    for number in range(1, 7):
        package = place / "submissions" / f"s{number}" / "p"
        package.mkdir(parents=True)
        (package / "package.xml").write_text(MANIFEST)
        (package / "CMakeLists.txt").write_text(CMAKE + f"execute_process(COMMAND sleep {NAP}.{number})\n")
        if number % 2:
            (package / "readme.txt").write_text("hello")
    return place


@pytest.fixture(scope="module")
def nodes(place):
    made = Nodes()
    yield made
    made.end()
    wake()


def grade(place, out, *words):
    """A driver; what it says goes to a file."""
    submissions = sorted(map(str, (place / "submissions").iterdir()))
    with open(place / f"{out}.txt", "a", encoding="utf-8") as file:
        return subprocess.Popen(
            ["rosrun", "lab_check", "grade", str(place / "spec.yaml"), *submissions, "--out", str(place / out), "--no-films", *words],
            stdout=file,
            stderr=file,
            start_new_session=True,
        )


def finish(driver):
    """Whoever sleeps is woken until the driver has ended; its exit code."""

    def woken():
        wake()
        return driver.poll() is not None

    wait_until(woken, "the driver did not end")
    return driver.returncode


def points(place, out):
    with open(place / out / "gradebook.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["submission"] for row in rows] == [f"s{number}" for number in range(1, 7)]
    return [row["points"] for row in rows]


def test_four_nodes_give_the_pools_marks_also_when_one_is_killed(place, nodes):
    driver = grade(place, "nodes", "--address", nodes.address)
    wait_until(lambda: len(asleep()) == 4, "not all nodes are at work")
    nodes.kill(3)
    wait_until(lambda: len(asleep()) == 3, "its examination went on")
    assert finish(driver) == 0, (place / "nodes.txt").read_text()
    assert " is gone; it is tried again" in (place / "nodes.txt").read_text()
    assert points(place, "nodes") == POINTS
    assert finish(grade(place, "pool", "--workers", "2")) == 0
    assert (place / "nodes" / "gradebook.csv").read_text() == (place / "pool" / "gradebook.csv").read_text()


def test_whoever_kills_the_driver_ends_its_work_and_the_same_command_goes_on(place, nodes):
    driver = grade(place, "driver", "--address", nodes.address)
    wait_until(lambda: 1 in asleep(), "s1 is not examined")
    wake(1)
    wait_until(lambda: "s1: 5 of 7" in (place / "driver.txt").read_text(), "s1 is not done")
    wait_until(asleep, "nobody is examined")
    driver.kill()  # rosrun has become the program itself
    driver.wait()
    wait_until(lambda: not asleep(), "what it began goes on")
    assert finish(grade(place, "driver", "--address", nodes.address)) == 0
    assert points(place, "driver") == POINTS and (place / "driver.txt").read_text().count("s1: 5 of 7") == 1


def test_without_its_head_a_class_is_one_line_and_goes_on_with_another(place, nodes):
    """The last test on these nodes: Ray without its head ends them."""
    driver = grade(place, "head", "--address", nodes.address)
    wait_until(lambda: 1 in asleep(), "s1 is not examined")
    wake(1)
    wait_until(lambda: "s1: 5 of 7" in (place / "head.txt").read_text(), "s1 is not done")
    nodes.kill(0)
    wait_until(lambda: driver.poll() is not None, "the driver hangs")
    said = (place / "head.txt").read_text()
    assert driver.returncode == 3 and "the same command goes on from here" in said and "Traceback" not in said, said
    assert points(place, "head")[0] == "5.0" and "" in points(place, "head")
    assert finish(grade(place, "head", "--workers", "2")) == 0
    assert points(place, "head") == POINTS and (place / "head.txt").read_text().count("s1: 5 of 7") == 1
