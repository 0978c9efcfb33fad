"""The node rm_hw."""

from __future__ import annotations

import signal
import sys
import traceback
from array import array

import numpy
import rospy
from controller_interface import NodeHandle
from controller_manager import ControllerManager

from rm_hw.coefficients import ConfigError
from rm_hw.hardware import RmRobotHW
from rm_hw.loop import ControlLoop, become_realtime


class CycleLog:
    """Durations of all cycles (s), written to the file that parameter ``cycle_time_log`` names, for measurements."""

    def __init__(self, path: str) -> None:
        self._path = path
        self._durations = array("d")
        self.add = self._durations.append if path else None

    def save(self) -> None:
        if self._path and self._durations:
            with open(self._path, "wb") as file:
                numpy.save(file, numpy.array(self._durations))


def main() -> int:
    """Run until SIGINT, SIGTERM or a failure; returns the exit code. The motors are off on every way out."""
    try:
        rospy.init_node("rm_hw", disable_signals=True)
    except (rospy.ROSException, OSError) as error:
        print(f"rm_hw: {error}", file=sys.stderr)
        return 1
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.default_int_handler)
    hw, manager = RmRobotHW(), None
    try:
        hw.init(NodeHandle(), NodeHandle(rospy.get_name()))
        manager = ControllerManager(hw)
        log = CycleLog(rospy.get_param("~cycle_time_log", ""))
        become_realtime(hw.config.thread_priority)
        _run(hw, manager, log)
        log.save()
        return 0
    except ConfigError as error:
        rospy.logfatal("rm_hw cannot start: %s", error)
        return 1
    except KeyboardInterrupt:
        return 0
    except Exception as error:  # whatever it was, the motors must be switched off and the user told in one line
        place = traceback.extract_tb(error.__traceback__)[-1]
        rospy.logfatal("rm_hw stops: %s: %s (%s:%d)", type(error).__name__, error, place.filename, place.lineno)
        return 1
    finally:
        hw.switch_off()
        if manager:
            manager.shutdown()
        hw.close()
        rospy.signal_shutdown("rm_hw ends")


def _run(hw: RmRobotHW, manager: ControllerManager, log: CycleLog) -> None:
    def cycle(now: float, period: float) -> None:
        hw.read(now, period)
        manager.update(now, period)
        hw.write(now, period)

    loop = ControlLoop(hw.config.loop_frequency, hw.config.cycle_time_error_threshold, cycle, log.add)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, loop.stop)
    rospy.on_shutdown(loop.stop)  # rosnode kill, or another node of this name
    loop.run()
