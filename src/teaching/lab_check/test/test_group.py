"""The kernel's bound on the processes of a submission."""

import os
import signal
import subprocess
import sys

import pytest
from lab_check.isolation import control_group
from lab_check.isolation.supervise import Program

MANY = """
import subprocess
started = []
try:
    for _ in range(60):
        started.append(subprocess.Popen(["sleep", "60"]))
except OSError as error:
    print(len(started), error.strerror, flush=True)
    input()
"""


@pytest.fixture
def place():
    with control_group.bounded(20) as place:
        if not place:
            pytest.skip("this user can make no control group here")
        yield place
    assert not os.path.exists(place)


@pytest.mark.slow
def test_programs_of_a_submission_start_no_more_than_they_may_together(place):
    limits = {"log": 1e6}
    waits = Program(["sleep", "60"], limits, place=place)
    many = Program([sys.executable, "-c", MANY], limits, place=place)
    try:
        many.write("\n")
        assert many.wait(60) and many.code == 0
        count, _, why = many.output.text().partition(" ")
        assert int(count) == 18 and "Resource temporarily unavailable" in why  # with the two programs
        assert subprocess.run(["true"]).returncode == 0  # others are not counted
    finally:
        for program in (waits, many):
            os.killpg(program.process.pid, signal.SIGKILL)
            program.process.wait()


def test_without_such_groups_there_is_no_bound(monkeypatch, tmp_path):
    monkeypatch.setattr(control_group, "HIERARCHIES", (str(tmp_path), str(tmp_path / "absent")))
    with control_group.bounded(20) as place:
        assert place == ""
        control_group.enter(place)
    assert not any(tmp_path.iterdir())
