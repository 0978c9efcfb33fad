"""Real-time priority for every thread of the process."""

import errno
import os

import pytest
from rm_hw import loop


@pytest.fixture
def become_realtime(monkeypatch):
    """become_realtime() in a process with threads 1 to 4; returns who got the priority, and the lines of the log."""

    def become_realtime(errors):
        raised, lines = [], []

        def set_scheduler(thread, policy, parameters):
            if thread in errors:
                raise OSError(errors[thread], os.strerror(errors[thread]))
            raised.append((thread, policy, parameters.sched_priority))

        monkeypatch.setattr(loop.os, "listdir", lambda place: ["1", "2", "3", "4"])
        monkeypatch.setattr(loop.os, "sched_setscheduler", set_scheduler)
        monkeypatch.setattr(loop.rospy, "logerr", lambda text, *values: lines.append(text % values))
        monkeypatch.setattr(loop.sys, "setswitchinterval", lambda interval: None)
        loop.become_realtime(95)
        return raised, lines

    return become_realtime


def test_every_thread_gets_the_priority(become_realtime):
    raised, lines = become_realtime({})
    assert raised == [(thread, os.SCHED_FIFO, 95) for thread in (1, 2, 3, 4)] and lines == []


def test_a_thread_that_ends_meanwhile_is_no_missing_right(become_realtime):
    raised, lines = become_realtime({2: errno.ESRCH})
    assert [thread for thread, *_ in raised] == [1, 3, 4] and lines == []


def test_missing_rights_are_said_once_and_it_runs_on(become_realtime):
    raised, lines = become_realtime(dict.fromkeys((1, 2, 3, 4), errno.EPERM))
    assert raised == [] and len(lines) == 1 and "limits.d/realtime.conf" in lines[0]


def test_a_wrong_priority_is_said(become_realtime):
    _, lines = become_realtime(dict.fromkeys((1, 2, 3, 4), errno.EINVAL))
    assert len(lines) == 1 and os.strerror(errno.EINVAL) in lines[0]
