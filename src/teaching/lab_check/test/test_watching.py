"""Who waits for an examination sees which task is examined."""

import subprocess

from lab_check.check import _ended


def test_tasks_are_told_as_they_begin(tmp_path):
    log, seen = tmp_path / ".examiner.log", []
    log.write_text("roscore is there\n")
    with subprocess.Popen(["cat"], stdin=subprocess.PIPE) as examiner:

        def watch(done, now):
            seen.append((done, now))
            with open(log, "a") as said:
                if len(seen) == 1:
                    said.write("task 'Build the robot' begins at 0.000 s of simulation, 1.0 s of wall time\n")
                elif len(seen) == 2:
                    said.write("a remark\ntask 'Move it' begins at 2.000 s of simulation, 3.0 s of wall time\n")
                else:
                    examiner.stdin.close()

        assert _ended(examiner, 60, tmp_path, watch) == 0
    assert seen[:3] == [(0, "building, starting"), (0, "Build the robot"), (1, "Move it")]


def test_one_that_never_ends_is_given_up_with_and_without_a_watcher(tmp_path):
    (tmp_path / ".examiner.log").touch()
    for watch in (None, lambda done, now: None):
        with subprocess.Popen(["cat"], stdin=subprocess.PIPE) as examiner:
            assert _ended(examiner, 0.1, tmp_path, watch) is None
            examiner.kill()
