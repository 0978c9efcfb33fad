"""Services that come up while a launch file starts everything at once."""

from __future__ import annotations

import time
from collections.abc import Iterator

import rosgraph
import rospy

_EVERY = 0.03  # s between two looks at first
_SELDOM = 0.3  # s between two looks of those who have waited long, as rospy's


def wait_for_service(name: str, timeout: float | None = None) -> None:
    """As ``rospy.wait_for_service``, which looks three times a second and so holds up every node of a launch; here looks
    are a tenth of the time waited apart.

    :param name: of the service
    :param timeout: wall s; None waits for ever
    :raises rospy.ROSException: it did not come in time
    :raises rospy.ROSInterruptException: the node ends
    """
    master, resolved = rosgraph.Master(rospy.get_name()), rospy.resolve_name(name)
    start = time.monotonic()
    for passed in _looks(start):
        if rospy.is_shutdown():
            raise rospy.ROSInterruptException("rospy shutdown")
        if timeout is not None and passed >= timeout:
            raise rospy.ROSException(f"timeout exceeded while waiting for service {resolved}")
        try:
            master.lookupService(resolved)
            break
        except (OSError, rosgraph.MasterException):  # not yet, or no master
            pass
    left = None if timeout is None else max(timeout - (time.monotonic() - start), 1e-3)
    rospy.wait_for_service(name, left)


def _looks(start: float) -> Iterator[float]:
    """s since ``start``, each time that a look is due."""
    while True:
        passed = time.monotonic() - start
        yield passed
        time.sleep(min(max(_EVERY, passed / 10.0), _SELDOM))
