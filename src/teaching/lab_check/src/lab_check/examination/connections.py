"""Is everybody connected who wants to be? Nodes connect in wall time; simulated time waits for them."""

from __future__ import annotations

import os
import xmlrpc.client
from collections import Counter
from typing import Any

import rosgraph
from node_signals.bounded_calls import Transport

_TIMEOUT = 2.0  # s that a node gets to answer


def nodes() -> set[str]:
    """Names of all nodes that the master knows."""
    return {node for part in rosgraph.Master("/lab_check").getSystemState() for _, found in part for node in found}


def complete(master: rosgraph.Master, deaf: set[str]) -> bool:
    """Each subscriber that ``master`` knows has a connection from each publisher of its topic.

    :param deaf: nodes that did not answer, which are asked no more; filled here
    """
    published, subscribed, _ = master.getSystemState()
    publishers = {topic: set(found) - deaf for topic, found in published}
    wanted: dict[str, dict[str, int]] = {}
    for topic, found in subscribed:
        for node in set(found) - deaf:
            if publishers.get(topic):
                wanted.setdefault(node, {})[topic] = len(publishers[topic])
    for node, topics in wanted.items():
        try:
            proxy = xmlrpc.client.ServerProxy(master.lookupNode(node), transport=Transport(_TIMEOUT))
            answer: Any = proxy.getBusInfo("/lab_check")
            entries = answer[2]
            have = Counter(entry[4] for entry in entries if entry[2] == "i" and (len(entry) < 6 or entry[5]))
        except (OSError, xmlrpc.client.Error, rosgraph.MasterException, LookupError, TypeError, ValueError, MemoryError):
            deaf.add(node)
            continue
        if any(have[topic] < count for topic, count in topics.items()):
            return False
    return True


def release(master: rosgraph.Master) -> int:
    """Lets subscribers hear of new publishers (see :mod:`lab_check.examination.guarded_master`).

    :returns: the number of news
    :raises OSError: the master does not answer
    """
    return master.handle.release("/lab_check", _word())[2]


def simulator_is(master: rosgraph.Master, name: str, uri: str, pid: int) -> None:
    """Has ``master`` note from now on who takes names of the simulator: the node ``name`` at ``uri``, process ``pid``.

    :raises OSError: the master does not answer
    """
    master.handle.simulatorIs("/lab_check", _word(), name, uri, pid)


def told(master: rosgraph.Master) -> list[str]:
    """What the master noted, a sentence each."""
    return list(master.handle.told("/lab_check", _word())[2])


def _word() -> str:
    """By which the master knows the examiner; see :mod:`lab_check.examination.guarded_master`."""
    return os.environ.get("LAB_CHECK_WORD", "")
