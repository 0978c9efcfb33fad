"""Simulated time that does not begin: ``use_sim_time`` is set and nobody publishes /clock. Whatever waits for time then waits for ever."""

from __future__ import annotations

import rospy

SENTENCE = (
    "use_sim_time is true and no /clock has come: time stands still until a simulation or a bag (rosbag play --clock) runs. "
    "Without one: rosparam set use_sim_time false, and start this again"
)


def expected() -> bool:
    """Whether this node's time is simulated."""
    return not rospy.rostime.is_wallclock()


def missing() -> str | None:
    """What to tell the user while no time has come, or None."""
    return SENTENCE if expected() and rospy.rostime.is_rostime_initialized() and rospy.get_rostime().is_zero() else None
