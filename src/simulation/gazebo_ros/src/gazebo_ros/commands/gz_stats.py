"""``gz stats``: how fast the simulation runs, in the original's lines."""

from __future__ import annotations

import argparse
import time
from collections import deque

import rospy

from gazebo_ros.commands.asking import simulator
from gazebo_ros.commands.command_line import Failure
from gazebo_ros.msg import WorldView

_PERIOD = 0.2  # wall s between two lines
_PATIENCE = 5.0  # wall s until the first message
_HEADING = "# real-time factor (percent), simtime (sec), realtime (sec), paused (T or F)"


class Factor:
    """The real-time factor over the last messages, as the original takes it: how far all are from the oldest, in sim time and in real
    time."""

    def __init__(self) -> None:
        self._times: deque[tuple[float, float]] = deque(maxlen=20)

    def __call__(self, sim: float, real: float) -> float | None:
        """With the times ``sim`` and ``real`` of one more message, s; None while no real time has passed."""
        if self._times and (sim < self._times[-1][0] or real < self._times[-1][1]):  # the simulation was reset
            self._times.clear()
        self._times.append((sim, real))
        first_sim, first_real = self._times[0]
        passed = sum(each[1] - first_real for each in self._times)
        return sum(each[0] - first_sim for each in self._times) / passed if passed > 0.0 else None


def line(message: WorldView, factor: float, plot: bool) -> str:
    """What is printed of ``message``.

    :param factor: real-time factor
    :param plot: with commas
    """
    sim, paused = message.sim_time.to_sec(), "T" if message.paused else "F"
    if plot:
        return f"{factor:4.2f}, {sim:16.6f}, {message.real_time:16.6f}, {paused}"
    return f"Factor[{factor:4.2f}] SimTime[{sim:4.2f}] RealTime[{message.real_time:4.2f}] Paused[{paused}]"


def stats(options: argparse.Namespace) -> None:
    """Real-time factor, sim time and real time, five lines a second."""
    newest: deque[WorldView] = deque(maxlen=1)
    name = simulator() + "/view"
    subscriber = rospy.Subscriber(name, WorldView, newest.append, queue_size=1)
    begin = time.monotonic()
    factor, told, heading = Factor(), False, options.plot
    while not rospy.is_shutdown():
        late = time.monotonic() - begin
        if newest:
            message = newest.pop()
            value = factor(message.sim_time.to_sec(), message.real_time)
            if value is not None or message.paused:
                if heading:
                    print(_HEADING)
                print(line(message, 0.0 if message.paused or value is None else value, options.plot), flush=True)
                told, heading = True, False
        elif not told and late > _PATIENCE:
            raise Failure(f"the simulator sends nothing on {name}")
        if told and options.duration is not None and late >= options.duration:
            break
        rospy.rostime.wallsleep(_PERIOD if told else 0.02)
    subscriber.unregister()
