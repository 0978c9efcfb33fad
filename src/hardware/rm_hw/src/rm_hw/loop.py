"""The control loop: read, update, write, a thousand times a second, and what to do when that fails."""

from __future__ import annotations

import gc
import os
import sys
import time
from collections.abc import Callable

import rospy

_SWITCH_INTERVAL = 0.0002  # s; Python's own 5 ms would let a service thread hold up the loop for five cycles
_WARNING_PAUSE = 1.0  # s between two warnings about late cycles


def become_realtime(priority: int) -> None:
    """Ask for SCHED_FIFO for all threads of the process; without the right to, say how to get it and go on.

    All of them (those started later inherit it), because a thread of normal priority that is suspended while it holds
    the interpreter's lock would hold up the loop.
    """
    refused = None
    for thread in os.listdir("/proc/self/task"):
        try:
            os.sched_setscheduler(int(thread), os.SCHED_FIFO, os.sched_param(priority))
        except ProcessLookupError:  # it has ended since it was listed
            continue
        except OSError as error:
            refused = error
    if refused is not None:
        rospy.logerr(
            "Set scheduler failed, RUN THIS NODE AS SUPER USER. (%s) It runs on at normal priority, which is "
            "enough for the motor bench; for a robot allow real-time priority: put '@realtime - rtprio 99' "
            "into /etc/security/limits.d/realtime.conf, 'sudo usermod -aG realtime $USER', and log in again",
            refused.strerror,
        )
    sys.setswitchinterval(_SWITCH_INTERVAL)


class ControlLoop:
    """Calls ``cycle(time, period)`` at a rate until :meth:`stop`.

    :param frequency: Hz.
    :param threshold: s by which a cycle may be longer than it should before a warning.
    :param cycle: called with the time (s since the epoch) and the time since the last call (s).
    :param watch: called with each cycle's duration in s, for measurements.
    """

    def __init__(
        self, frequency: float, threshold: float, cycle: Callable[[float, float], None], watch: Callable[[float], None] | None = None
    ) -> None:
        self._period = 1.0 / frequency
        self._threshold = threshold
        self._cycle, self._watch = cycle, watch
        self._running = True
        self._late = 0
        self._next_warning = 0.0

    def stop(self, *_) -> None:
        """May be called from a signal handler or another thread."""
        self._running = False

    def run(self) -> None:
        """Until :meth:`stop`."""
        gc.collect()
        gc.freeze()  # what start-up has made need not be searched for garbage again
        last = due = time.monotonic()
        while self._running:
            due += self._period
            now = time.monotonic()
            if now < due:
                time.sleep(due - now)
            else:
                due = now  # do not run after lost time in a burst
            now = time.monotonic()
            elapsed, last = now - last, now
            self._check(elapsed, now)
            if self._watch:
                self._watch(elapsed)
            self._cycle(time.time(), elapsed)

    def _check(self, elapsed: float, now: float) -> None:
        excess = elapsed - self._period - self._threshold
        if excess <= 0.0:
            return
        self._late += 1
        if now < self._next_warning:
            return
        self._next_warning = now + _WARNING_PAUSE
        rospy.logwarn(
            "Cycle time exceeded error threshold by: %.6fs, cycle time: %.6fs, threshold: %.6fs (%d late "
            "cycles so far). If it happens often: stop other programs, lower loop_frequency, or use a "
            "real-time kernel",
            excess,
            elapsed,
            self._threshold,
            self._late,
        )
