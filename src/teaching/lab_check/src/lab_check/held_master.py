"""The ROS master of an examination: ``python3 -m lab_check.held_master PORT``

A node that offers a topic and publishes at once is heard by those subscribers whose connection was quicker than its next line; which
ones these are differs from run to run. Here subscribers hear of new publishers when the examiner calls ``release``, that is when
everybody rests: nobody's first message is ever heard by some and not by others.
"""

from __future__ import annotations

import sys
import threading
from typing import List, Tuple

from rosmaster.main import rosmaster_main
from rosmaster.master_api import ROSMasterHandler

_held: List[Tuple[ROSMasterHandler, str, List[str], List[str]]] = []
_lock = threading.Lock()
_notify = ROSMasterHandler._notify_topic_subscribers


def _hold(self, topic: str, publishers: List[str], subscribers: List[str]) -> None:
    if subscribers:
        with _lock:
            _held.append((self, topic, publishers, list(subscribers)))


def _release(self, caller_id: str) -> Tuple[int, str, int]:
    """Sends what was held, in its order; answers as the master's own calls do, with the number of news."""
    with _lock:
        news, _held[:] = list(_held), []
    for master, topic, publishers, subscribers in news:
        _notify(master, topic, publishers, subscribers)
    return 1, "released", len(news)


def main() -> None:
    ROSMasterHandler._notify_topic_subscribers = _hold
    ROSMasterHandler.release = _release
    rosmaster_main(["rosmaster", "--core", "-p", sys.argv[1]])


if __name__ == "__main__":
    main()
