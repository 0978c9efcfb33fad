"""What the master and the nodes say about themselves, read at one moment. Neither Qt nor rospy in here."""

from __future__ import annotations

import concurrent.futures
import socket
import threading
import xmlrpc.client
from dataclasses import dataclass, field
from http.client import HTTPException
from typing import Any

import rosgraph
from node_signals.bounded_calls import Transport
from qt_gui.errors import WindowError
from rosgraph.names import canonicalize_name

DEAD, WONKY = "DEAD", "WONKY"
_TIMEOUT = 1.0  # s that a node gets to answer
_AT_ONCE = 16  # nodes asked at a time
_TROUBLE = (OSError, xmlrpc.client.Error, HTTPException, ValueError)


class NoMaster(WindowError):
    """The master does not answer; one line."""


@dataclass
class State:
    """The graph of one moment.

    ``publishers``, ``subscribers``: topic -> nodes, as registered. ``connections``: (publisher, topic, subscriber) of each
    connection that exists; ``active``: (node, topic, whether it publishes), of connections whose other end may be unknown.
    ``bad``: node -> DEAD (nobody there) or WONKY (no sensible answer). ``services``: node -> names.
    """

    nodes: set[str] = field(default_factory=set)
    publishers: dict[str, list[str]] = field(default_factory=dict)
    subscribers: dict[str, list[str]] = field(default_factory=dict)
    connections: set[tuple[str, str, str]] = field(default_factory=set)
    active: set[tuple[str, str, bool]] = field(default_factory=set)
    bad: dict[str, str] = field(default_factory=dict)
    services: dict[str, list[str]] = field(default_factory=dict)
    types: dict[str, str] = field(default_factory=dict)

    def registered(self) -> set[tuple[str, str, bool]]:
        """As ``active``, of all registrations."""
        return {
            (node, topic, out)
            for table, out in ((self.publishers, True), (self.subscribers, False))
            for topic, nodes in table.items()
            for node in nodes
        }


def read() -> State:
    """Ask the master, then all nodes at the same time; a node that hangs costs one second, whatever their number.

    :raises NoMaster: no answer from it.
    """
    uri = rosgraph.get_master_uri()
    try:
        master = xmlrpc.client.ServerProxy(uri, Transport(5.0))
        multi: Any = xmlrpc.client.MultiCall(master)
        multi.getSystemState("/rqt_graph")
        multi.getTopicTypes("/rqt_graph")
        (_, _, (publishers, subscribers, services)), (_, _, types) = multi()
        nodes = {node for table in (publishers, subscribers, services) for _, names in table for node in names}
        uris = _node_uris(master, sorted(nodes))
    except _TROUBLE as error:
        raise NoMaster(f"the ROS master at {uri} does not answer; start roscore, or set ROS_MASTER_URI") from error
    state = State(nodes, {t: list(n) for t, n in publishers}, {t: list(n) for t, n in subscribers}, types=dict(map(tuple, types)))
    for service, names in services:
        for node in names:
            state.services.setdefault(node, []).append(service)
    names = {address: node for node, address in uris.items()}
    with concurrent.futures.ThreadPoolExecutor(_AT_ONCE) as pool:
        for node, answer in zip(sorted(nodes), pool.map(lambda n: _bus_info(uris.get(n)), sorted(nodes))):
            if isinstance(answer, str):
                state.bad[node] = answer
            else:
                for entry in answer:
                    _note(state, names, node, entry)
    return state


def _node_uris(master, nodes) -> dict[str, str]:
    multi: Any = xmlrpc.client.MultiCall(master)
    for node in nodes:
        multi.lookupNode("/rqt_graph", node)
    answers = multi() if nodes else ()
    return {node: uri for node, (code, _, uri) in zip(nodes, answers) if code == 1}


def _bus_info(uri):
    """The connections of a node, or why there is no answer."""
    if uri is None:
        return DEAD  # it went between two questions
    try:
        node: Any = xmlrpc.client.ServerProxy(uri, Transport(_TIMEOUT))
        code, _, info = node.getBusInfo("/rqt_graph")
        return info if code == 1 and isinstance(info, list) else WONKY
    except (ConnectionRefusedError, socket.gaierror):
        return DEAD
    except _TROUBLE:
        return WONKY


def _note(state, names, node, entry) -> None:
    """One connection as a node tells it: [id, other end, direction, transport, topic, connected...]."""
    if len(entry) < 5 or len(entry) > 5 and not entry[5]:
        return
    other, direction, topic = entry[1], entry[2], entry[4]
    other = names.get(other) if str(other).startswith("http://") else canonicalize_name(str(other))
    for out in {"o": (True,), "i": (False,), "b": (True, False)}.get(direction, ()):
        state.active.add((node, topic, out))
        if other in state.nodes:
            state.connections.add((node, topic, other) if out else (other, topic, node))


def service_types(services: list[str]) -> dict[str, str]:
    """Name -> type, or ? where the service does not answer within a second; they are asked at the same time."""
    import rosservice

    def ask(name, found):
        try:
            found[name] = rosservice.get_service_type(name) or "?"
        except Exception:  # rosservice raises what its sockets do, and more
            found[name] = "?"

    found: dict[str, str] = {}
    threads = [threading.Thread(target=ask, args=(name, found), daemon=True) for name in services]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(_TIMEOUT)
    return {name: found.get(name, "?") for name in services}
