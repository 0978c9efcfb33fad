"""The ROS master of an examination: ``python3 -m lab_check.examination.guarded_master PORT MEMORY``

A node that offers a topic and publishes at once is heard by those subscribers whose connection was quicker than its next line; which
ones these are differs from run to run. Here subscribers hear of new publishers when the examiner calls ``release``, that is when
everybody rests: nobody's first message is ever heard by some and not by others.

It also notes who takes names of the simulator: offers one of its services, registers under its node's name, or unregisters what is its. A
node says itself who it is, so it is looked at whose connection its call came through.

``release``, ``simulatorIs`` and ``told`` are the examiner's alone, who knows the word in the environment of both.
"""

from __future__ import annotations

import os
import pathlib
import sys
import threading
from collections.abc import Callable
from typing import Any

from rosgraph.xmlrpc import SilenceableXMLRPCRequestHandler
from rosmaster.main import rosmaster_main
from rosmaster.master_api import ROSMasterHandler

from lab_check.isolation.supervise import bound, descendants

_held: list[tuple[ROSMasterHandler, str, list[str], list[str]]] = []
_lock = threading.Lock()
_notify = ROSMasterHandler._notify_topic_subscribers
_WORD = os.environ.get("LAB_CHECK_WORD", "")
_caller = threading.local()  # .port: of the connection of the call that this thread answers
_REFUSED = (-1, "not for you", 0)
_MOST = 50  # sentences that are noted


class _Simulator:
    """Whose names are watched."""

    name, uri, pid = "", "", 0
    services: dict[str, str] = {}  # its services, with the name of the node as it gave it
    told: set[str] = set()


def _hold(self: ROSMasterHandler, topic: str, publishers: list[str], subscribers: list[str]) -> None:
    if subscribers:
        with _lock:
            _held.append((self, topic, publishers, list(subscribers)))


def _release(self: ROSMasterHandler, caller_id: str, word: str = "") -> tuple[int, str, int]:
    """Sends what was held, in its order; answers as the master's own calls do, with the number of news."""
    if word != _WORD:
        return _REFUSED
    with _lock:
        news, _held[:] = list(_held), []
    for master, topic, publishers, subscribers in news:
        _notify(master, topic, publishers, subscribers)
    return 1, "released", len(news)


def _simulator_is(self: ROSMasterHandler, caller_id: str, word: str, name: str, uri: str, pid: int) -> tuple[int, str, int]:
    if word != _WORD:
        return _REFUSED
    _Simulator.name, _Simulator.uri, _Simulator.pid = name, uri, pid
    for service, nodes in list(_offered.items()):
        mine = [index for index, node in enumerate(nodes) if node[1] == uri]
        if mine:
            _Simulator.services[service] = nodes[mine[0]][0]
            for node, _ in nodes[mine[0] + 1 :]:
                _note(f"the node {_shown(node)} registered {_shown(service)} over the simulator's")
    return 1, "noted", 0


def _told(self: ROSMasterHandler, caller_id: str, word: str) -> tuple[int, str, Any]:
    return (1, "", sorted(_Simulator.told)) if word == _WORD else _REFUSED


def _refuse_shutdown(self: ROSMasterHandler, caller_id: str, msg: str = "") -> tuple[int, str, int]:
    _note(f"{_shown(caller_id)} asked the ROS master to end; it went on")
    return _REFUSED


_offered: dict[str, list[tuple[str, str]]] = {}  # service -> who offered it, one after the other: node, its URI


def _its_own(service: str) -> bool:
    """One by which simulators of examinations once answered, or one of the examiner's."""
    return "lab_check" in service


def _watch_service(self: ROSMasterHandler, caller_id: str, service: str, service_api: str, caller_api: str) -> None:
    before = _offered.setdefault(service, [])
    if len(before) < _MOST and (caller_id, caller_api) not in before[-1:]:
        before.append((caller_id, caller_api))
    if caller_api == _Simulator.uri and _is_simulator():
        _Simulator.services[service] = caller_id
    elif service in _Simulator.services:
        _note(f"the node {_shown(caller_id)} registered {service} over the simulator's")
    elif _its_own(service) and not caller_id.startswith("/lab_check"):
        _note(f"the node {_shown(caller_id)} offers {_shown(service)}, a name of the examination")
    _watch_name(self, caller_id, caller_api)


def _watch_name(self: ROSMasterHandler, caller_id: str, *rest: str) -> None:
    """``rest`` ends with the URI of the node that registers."""
    if _Simulator.name and caller_id == _Simulator.name and (rest[-1] != _Simulator.uri or not _is_simulator()):
        _note(f"somebody registered under the simulator's name {_Simulator.name}")


def _watch_end(self: ROSMasterHandler, caller_id: str, *rest: str) -> None:
    if _Simulator.name and caller_id == _Simulator.name and not _is_simulator():
        _note(f"somebody unregistered {_shown(rest[0])} of the simulator")


def _is_simulator() -> bool:
    """The call came through a connection of the simulator's process, or of one that it started; also where that cannot be seen."""
    if not _Simulator.pid:
        return False
    inode = _inode(getattr(_caller, "port", 0))
    if not inode:
        return True
    return any(_holds(pid, inode) for pid in descendants(_Simulator.pid))


def _inode(port: int) -> str:
    for table in ("tcp", "tcp6"):
        try:
            for line in pathlib.Path("/proc/self/net", table).read_text().splitlines()[1:]:
                fields = line.split()
                if int(fields[1].rpartition(":")[2], 16) == port and fields[9] != "0":
                    return fields[9]
        except (OSError, IndexError, ValueError):
            continue
    return ""


def _holds(pid: int, inode: str) -> bool:
    try:
        return any(os.readlink(f"/proc/{pid}/fd/{name}") == f"socket:[{inode}]" for name in os.listdir(f"/proc/{pid}/fd"))
    except OSError:
        return False


def _note(sentence: str) -> None:
    if len(_Simulator.told) < _MOST:
        _Simulator.told.add(sentence)


def _shown(name: Any) -> str:
    return str(name)[:100]


def _watched(call: Callable, look: Callable[..., None]) -> Callable:
    """A call of the master's API that is looked at first. Wrong arguments are the master's own to refuse."""

    def first_looked_at(self: ROSMasterHandler, *arguments: Any) -> Any:
        if all(isinstance(argument, str) for argument in arguments) and len(arguments) > 1:
            with _lock:
                look(self, *arguments)
        return call(self, *arguments)

    return first_looked_at


class _Handler(SilenceableXMLRPCRequestHandler):
    def do_POST(self) -> None:
        _caller.port = self.client_address[1]
        super().do_POST()


def main() -> None:
    import rosgraph.xmlrpc

    rosgraph.xmlrpc.SilenceableXMLRPCRequestHandler = _Handler
    master = ROSMasterHandler
    master._notify_topic_subscribers = _hold
    master.release, master.simulatorIs, master.told, master.shutdown = _release, _simulator_is, _told, _refuse_shutdown
    master.registerService = _watched(master.registerService, _watch_service)
    for name in ("registerPublisher", "registerSubscriber"):
        setattr(master, name, _watched(getattr(master, name), _watch_name))
    for name in ("unregisterService", "unregisterPublisher", "unregisterSubscriber"):
        setattr(master, name, _watched(getattr(master, name), _watch_end))
    bound(float(sys.argv[2]))  # parameters and names are the submission's
    rosmaster_main(["rosmaster", "--core", "-p", sys.argv[1]])


if __name__ == "__main__":
    main()
