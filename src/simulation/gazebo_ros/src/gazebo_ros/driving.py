"""Who drives which joint: two plugins that drive the same one do not know of each other, and the robot stands still for ever."""

from __future__ import annotations

import threading
import weakref
from collections.abc import Iterable
from typing import Any

import rospy


class Drivers:
    """Plugins say what they drive; a joint that has two is one warning, which names both."""

    def __init__(self) -> None:
        self._by_joint: weakref.WeakKeyDictionary[Any, list[Any]] = weakref.WeakKeyDictionary()
        self._lock = threading.Lock()

    def drives(self, owner: Any, joints: Iterable[Any]) -> None:
        """
        :param owner: something with a ``label``, by which the log names it
        :param joints: handles of joints that it moves from now on. Any thread
        """
        contested: dict[int, list[Any]] = {}
        with self._lock:
            for joint in joints:
                there = self._by_joint.setdefault(joint, [])
                if owner in there:
                    continue
                for other in there:
                    contested.setdefault(id(other), [other]).append(joint)
                there.append(owner)
        for other, *shared in contested.values():
            rospy.logwarn(
                "%s and %s both drive %s of model %s: one undoes in every step what the other does, as in Gazebo, and the "
                "robot may never move. Leave one of them out, or the transmissions of these joints",
                other.label,
                owner.label,
                _listed(shared),
                shared[0].model.name,
            )

    def ended(self, owner: Any) -> None:
        """``owner`` drives nothing any more."""
        with self._lock:
            for owners in self._by_joint.values():
                if owner in owners:
                    owners.remove(owner)


def _listed(joints: list[Any]) -> str:
    names = ", ".join(joint.name for joint in joints)
    return f"joint {names}" if len(joints) == 1 else f"the joints {names}"
