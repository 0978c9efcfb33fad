"""Who rests, who never does, and who only works for long."""

import subprocess
import sys
import time

import pytest
from lab_check.examination import lockstep

MARK = "LAB_CHECK_TEST=lockstep"


@pytest.fixture
def program():
    started = []

    def start(code):
        started.append(subprocess.Popen(["env", MARK, sys.executable, "-c", code, "a_node"], stdout=subprocess.PIPE, text=True))
        assert started[-1].stdout.readline() == "begun\n"
        return started[-1]

    yield start
    for one in started:
        one.kill()
        one.wait()


def nodes():
    return lockstep.Nodes(MARK, [])


def test_a_sleeper_rests(program):
    program("import time; print('begun', flush=True); time.sleep(600)")
    found = nodes()
    assert found.settle() and not found.restless_names


def test_work_is_waited_for(program):
    """It prints when it is done; nobody is taken to rest before."""
    work = "while time.process_time() < 1.0: pass"
    worker = program(f"import time; print('begun', flush=True)\n{work}\nprint('done', flush=True); time.sleep(60)")
    assert nodes().settle(patience=3.0)
    assert lockstep.processor_time(worker.pid)[0] >= 0.9 and worker.stdout.readline() == "done\n"


def test_who_never_rests_is_given_up_after_so_much_work_and_named(program):
    program("print('begun', flush=True)\nwhile True: pass")
    found = nodes()
    assert not found.settle(patience=0.5)
    assert found.restless_names and found.settle(patience=0.5)  # without it, all rest


@pytest.mark.slow
def test_waiting_for_a_processor_is_no_work(program, monkeypatch):
    """On a machine that gives it next to none, even a loop is waited for until the wall time that is the last bound."""
    program("print('begun', flush=True)\nwhile True: pass")
    monkeypatch.setattr(lockstep, "processor_time", lambda pid: (1.0, True))
    monkeypatch.setattr(lockstep, "STRETCH", 4.0)
    begin = time.monotonic()
    assert not nodes().settle(patience=0.5) and time.monotonic() - begin > 1.9
