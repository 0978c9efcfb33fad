"""Which process is a node, and what it takes. No Qt in here."""

from __future__ import annotations

import socket
from typing import Any, NamedTuple
from urllib.parse import urlparse
from xmlrpc.client import Error as XmlRpcError
from xmlrpc.client import ServerProxy

import psutil
import rosgraph
import rosgraph.network
import rosnode
from node_signals.bounded_calls import Transport

_TIMEOUT = 1.0  # s: a node that is stopped must not hold up the others


class NodeUsage(NamedTuple):
    """One row of the table."""

    name: str
    pid: int
    cpu_percent: float  #: of one processor, since the last look
    memory_percent: float
    threads: int
    command: str
    resident: int  #: bytes
    virtual: int  #: bytes


def _is_here(host: str) -> bool:
    try:
        return socket.gethostbyname(host) in ["127.0.0.1", "127.0.1.1", *rosgraph.network.get_local_addresses()]
    except OSError:
        return False


class NodeInfo:
    """Looks at all nodes that run on this machine. Every call asks the master and the new nodes: not for the GUI's thread."""

    def __init__(self):
        self._processes: dict[str, psutil.Process] = {}  # by the node's address: a restarted node has another

    def look(self) -> list[NodeUsage]:
        """:raises rosgraph.MasterException or OSError: no master."""
        master = rosgraph.Master("/rqt_top")
        usages, addresses = [], set()
        for name in sorted({node for kind in master.getSystemState() for _, nodes in kind for node in nodes}):
            try:
                address = master.lookupNode(name)
            except rosgraph.MasterException:
                continue  # ended between the two questions
            addresses.add(address)
            usage = self._usage(name, address)
            if usage:
                usages.append(usage)
        for gone in set(self._processes) - addresses:
            del self._processes[gone]
        return usages

    def _usage(self, name: str, address: str) -> NodeUsage | None:
        if address not in self._processes:
            process = self._process(address)
            if process is None:
                return None
            process.cpu_percent()  # the first answer is 0 whatever it does
            self._processes[address] = process
        process = self._processes[address]
        try:
            with process.oneshot():
                memory = process.memory_info()
                return NodeUsage(
                    name,
                    process.pid,
                    process.cpu_percent(),
                    process.memory_percent(),
                    process.num_threads(),
                    " ".join(process.cmdline()),
                    memory.rss,
                    memory.vms,
                )
        except psutil.Error:
            del self._processes[address]
            return None

    @staticmethod
    def _process(address: str) -> psutil.Process | None:
        """The process of a node; None if it is on another machine or does not answer."""
        try:
            host = urlparse(address).hostname or ""
            if not _is_here(host):
                return None
            node: Any = ServerProxy(address, transport=Transport(_TIMEOUT))
            code, _, pid = node.getPid("/rqt_top")
            return psutil.Process(pid) if code == 1 else None
        except (OSError, XmlRpcError, psutil.Error, ValueError):
            return None

    @staticmethod
    def kill_node(name: str) -> bool:
        """Ask a node to end. :returns: whether it could be asked."""
        success, _ = rosnode.kill_nodes([name])
        return name in success
