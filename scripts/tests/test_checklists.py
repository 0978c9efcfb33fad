"""The quick checklists: courses typed line by line in real terminals."""

import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CHECKLISTS = ROOT / "scripts" / "checklists"


def names(*options):
    return subprocess.run([CHECKLISTS, "--list", *options], capture_output=True, text=True, check=True).stdout.split()


def test_each_course_has_one():
    assert names() == ["arm", "mbot", "motor", "ur5"]


@pytest.mark.slow
@pytest.mark.parametrize("name", names("--quick"))
def test_as_the_course_says(name):
    ended = subprocess.run([CHECKLISTS, "--setup", ROOT / "devel/setup.bash", name], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stdout + ended.stderr


def test_what_is_not_said_fails(tmp_path):
    """A checklist that cannot fail would be none."""
    transcript = tmp_path / "silent.transcript"
    transcript.write_text("T1$ echo one\nT1: two\n")
    ended = subprocess.run(
        [CHECKLISTS, "--setup", ROOT / "devel/setup.bash", "silent"],
        capture_output=True,
        text=True,
        env={**os.environ, "TRANSCRIPTS": str(tmp_path)},
    )
    assert ended.returncode == 1 and "silent.transcript:2: T1: 'two' was not said" in ended.stdout, ended.stdout


@pytest.mark.slow
def test_a_simulator_that_dies_is_told_at_once(tmp_path):
    transcript = tmp_path / "dead.transcript"
    transcript.write_text(
        "T1& echo 'ImportError: no such symbol'; echo '[gazebo-2] process has died [pid 7]'; seq 5; sleep 500\nT1: started\n"
    )
    ended = subprocess.run(
        [CHECKLISTS, "--setup", ROOT / "devel/setup.bash", "dead"],
        capture_output=True,
        text=True,
        timeout=200,
        env={**os.environ, "TRANSCRIPTS": str(tmp_path)},
    )
    assert ended.returncode == 1
    assert "dead.transcript:2: T1: the simulator has died before 'started'" in ended.stdout, ended.stdout
    assert "ImportError: no such symbol" in ended.stdout, ended.stdout
