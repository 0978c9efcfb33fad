"""Compiled plugins in a process whose node is one of rospy: roscpp beside it, and a line that names a plugin which goes wrong.

``start_roscpp()`` makes the node of roscpp that compiled code finds. Two nodes in one process need two names: rospy keeps the one
that users know, roscpp has it with ``_compiled`` behind. Its clock is moved by ``set_time`` alone, so that compiled code sees
the time of its step.

``why_not(library)`` tells why a library cannot be loaded, in words, or "" if it can.

C++ users of ``<compiled_plugins/guard.h>`` say whose code they call; a crash, exit() or a call that blocks is then named in one line.
"""

from __future__ import annotations

import atexit
import threading
from typing import Optional

import rospy
import rospy.names

from . import _core
from ._core import set_time, why_not

__all__ = ["set_time", "start_roscpp", "why_not"]

_starting = threading.Lock()
_clock: bool | None = None
_name = ""  # of roscpp's node


def start_roscpp() -> bool:
    """Make sure that compiled code finds roscpp running, and that what it does wrong is named.

    What is set now among rospy's private parameters is there for roscpp's node as well: ``~`` is another name to it.

    :return: whether its clock is to be moved by ``set_time``: this is so under simulated time, in a node of rospy.
    """
    global _clock, _name
    with _starting:
        if _clock is None:
            simulated = rospy.rostime.is_wallclock() is False
            name = rospy.get_name().rpartition("/")[2] + "_compiled"
            words = dict(rospy.names.get_mappings(), __ns=rospy.get_namespace())
            made = _name = _core.start(name, words, rospy.get_time() if simulated else -1.0)
            _core.watch()
            atexit.register(_core.stop)
            _clock = simulated and made.rpartition("/")[2] == name
        _share_parameters()
        return _clock


def _share_parameters() -> None:
    private = rospy.get_param(rospy.get_name(), None)
    if isinstance(private, dict) and private and _name != rospy.get_name():
        rospy.set_param(_name, private)
