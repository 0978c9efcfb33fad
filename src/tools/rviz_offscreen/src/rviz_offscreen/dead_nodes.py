"""What a crash or a kill leaves behind: the master lists an RViz that is gone, and rqt_graph and rosnode show it for good."""

from __future__ import annotations

import contextlib
import re
import socket
from urllib.parse import urlsplit

import rosgraph
import rosgraph.network

_RVIZ = re.compile(r".*/rviz_\d+")  # as it names itself, with the time
_PATIENCE = 1.0  # s


def unregister() -> None:
    """As ``rosnode cleanup`` does it, for RViz's nodes of this machine where nobody answers any more."""
    with contextlib.suppress(rosgraph.MasterException, OSError):
        published, subscribed, services = rosgraph.Master("/screenshot").getSystemState()
        nodes = {node for listed in (published, subscribed, services) for _, names in listed for node in names}
        for name in filter(_RVIZ.fullmatch, nodes):
            master = rosgraph.Master(name)
            uri = master.lookupNode(name)
            if _answers(uri):
                continue
            for topic in _of(name, published):
                master.unregisterPublisher(topic, uri)
            for topic in _of(name, subscribed):
                master.unregisterSubscriber(topic, uri)
            for service in _of(name, services):
                master.unregisterService(service, master.lookupService(service))


def _of(name: str, listed: list) -> list[str]:
    return [what for what, nodes in listed if name in nodes]


def _answers(uri: str) -> bool:
    """Of a node on another machine, too: what cannot be reached from here may be at work there."""
    place = urlsplit(uri)
    network = rosgraph.network
    if place.hostname not in {"localhost", network.get_host_name(), network.get_local_address(), *network.get_local_addresses()}:
        return True
    try:
        socket.create_connection((place.hostname, place.port or 0), _PATIENCE).close()
    except ConnectionRefusedError:
        return False
    except OSError:
        return True
    return True
