"""The kernel's bound on the processes of a submission."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile

import pytest
from lab_check.isolation import control_group, supervise
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
    monkeypatch.setattr(control_group, "delegated", lambda: [])
    with control_group.bounded(20) as place:
        assert place == ""
        control_group.enter(place)
    assert not any(tmp_path.iterdir())


# As systemd lays them out: what is above the user's own manager is root's, what is below it the user's.
LAPTOP = "user.slice/user-1000.slice/user@1000.service/app.slice/terminal.scope"
DELEGATED = {
    "a terminal on a desktop": (f"0::/{LAPTOP}\n", ["user.slice/user-1000.slice/user@1000.service"]),
    "with version 1 beside it": (f"9:pids:/\n0::/{LAPTOP}\n", ["user.slice/user-1000.slice/user@1000.service"]),
    "a login by ssh": ("0::/user.slice/user-1000.slice/session-3.scope\n", []),
    "a container": ("0::/\n", []),
    "out of its namespace": ("0::/../elsewhere\n", []),
    "version 1 alone": ("9:pids:/\n4:memory:/a\n", []),
    "no such file": (None, []),
}
ASK = "import json, sys; from lab_check.isolation import control_group as g; print(json.dumps(g.delegated(*sys.argv[1:])))"


@pytest.fixture
def open_folder():
    """Where a user may look who is not the one that tests."""
    with tempfile.TemporaryDirectory(prefix="lab_check_group_", dir="/tmp") as name:  # TMPDIR may be the tester's alone
        os.chmod(name, 0o755)
        yield pathlib.Path(name)


@pytest.mark.parametrize("case", DELEGATED)
def test_a_user_makes_groups_in_what_systemd_gave_to_them(case, open_folder):
    told, expected = DELEGATED[case]
    mounted, own = open_folder / "cgroup", open_folder / "own"
    for path in (LAPTOP, "user.slice/user-1000.slice/session-3.scope", "../elsewhere"):
        for folder in (mounted / path, *(mounted / path).parents):
            if open_folder in folder.parents:
                folder.mkdir(parents=True, exist_ok=True)
                (folder / "cgroup.procs").touch()
    if told is not None:
        own.write_text(told)
    user = 65534 if os.geteuid() == 0 else os.geteuid()
    outside = open_folder / "elsewhere"  # the user's, and no group of this hierarchy
    for entry in (mounted, *mounted.rglob("*"), outside, outside / "cgroup.procs"):
        mine = "user@1000.service" in str(entry) or outside in (entry, entry.parent)
        entry.chmod((0o444, 0o555, 0o644, 0o755)[2 * mine + entry.is_dir()])
        if mine:
            os.chown(entry, user, -1)
    wish = {"user": user, "group": user, "extra_groups": []} if os.geteuid() == 0 else {}
    asked = subprocess.run([sys.executable, "-c", ASK, str(mounted), str(own)], capture_output=True, text=True, check=True, **wish)
    for entry in (mounted, *mounted.rglob("*")):
        entry.chmod(0o755)
    assert json.loads(asked.stdout) == [str(mounted / path) for path in expected]


def test_who_is_ended_for_memory_between_two_looks_is_told_so(monkeypatch):
    """The kernel ends a program that grows fast, and it is over before the guard looks: the last look says why."""
    monkeypatch.setattr(supervise, "_LOOK", 60.0)
    with control_group.bounded(20, 100e6) as place:
        if not control_group.counts_memory(place):
            pytest.skip("this user can make no control group here that counts memory")
        limits = {"log": 1e6, "memory": 100e6, "processes": 20, "time": 60.0}
        fine = Program(["true"], limits, place=place)
        greedy = Program([sys.executable, "-c", "bytearray(300_000_000)"], limits, place=place)
        guard = supervise.Guard(lambda: [fine, greedy], limits, place)
        guard.start()
        assert greedy.wait(60) and fine.wait(60)
        guard.stop()
        assert "memory" in guard.broke and greedy.broke == guard.broke and not fine.broke
