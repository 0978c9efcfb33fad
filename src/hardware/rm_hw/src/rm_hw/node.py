"""The node rm_hw."""
from __future__ import annotations

import signal
import sys
import traceback

import rospy
from controller_interface import NodeHandle
from controller_manager import ControllerManager

from rm_hw.coefficients import ConfigError
from rm_hw.hardware import RmRobotHW
from rm_hw.loop import ControlLoop, become_realtime


def main() -> int:
    """Run until SIGINT, SIGTERM or a failure; returns the exit code. The motors are off on every way out."""
    try:
        rospy.init_node("rm_hw", disable_signals=True)
    except (rospy.ROSException, OSError) as error:
        print(f"rm_hw: {error}", file=sys.stderr)
        return 1
    hw = RmRobotHW()
    manager = None
    try:
        hw.init(NodeHandle(), NodeHandle(rospy.get_name()))
        manager = ControllerManager(hw)
        loop = _loop(hw, manager)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, loop.stop)
        become_realtime(hw.config.thread_priority)
        loop.run()
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


def _loop(hw: RmRobotHW, manager: ControllerManager) -> ControlLoop:
    def cycle(now: float, period: float) -> None:
        hw.read(now, period)
        manager.update(now, period)
        hw.write(now, period)
    return ControlLoop(hw.config.loop_frequency, hw.config.cycle_time_error_threshold, cycle)
