"""XML-RPC calls to the ROS master and to nodes that are given up after a while: one that is stopped answers nobody."""

from __future__ import annotations

import http.client
import socket
import time
import xmlrpc.client
from typing import Any
from xml.parsers.expat import ExpatError

import rosgraph

import node_signals

_MOST = 64 << 20  # bytes of an answer: the largest that are meant are parameters with a robot's description


class Transport(xmlrpc.client.Transport):
    """For ``xmlrpc.client.ServerProxy(uri, transport=Transport(1.0))``: its calls raise ``TimeoutError`` after that, also where the answer
    comes in drops, and another ``OSError`` where it does not end or is no XML-RPC.

    :param timeout: s that a call may take, from connecting to the last byte
    """

    def __init__(self, timeout: float):
        super().__init__()
        self._timeout = timeout
        self.end = 0.0  # of the call that is under way, of time.monotonic()

    def request(self, *arguments: Any, **named: Any) -> Any:
        self.end = time.monotonic() + self._timeout  # of both attempts, where the first one finds a connection that has ended
        try:
            return super().request(*arguments, **named)
        except (http.client.HTTPException, ExpatError, ValueError, TypeError, LookupError, AttributeError, RecursionError) as error:
            if isinstance(error, OSError):  # http.client.RemoteDisconnected
                raise
            raise OSError(f"the answer is no XML-RPC: {type(error).__name__}: {str(error)[:200]}") from error

    def make_connection(self, host: Any) -> http.client.HTTPConnection:
        known, connection = self._connection
        if known != host or not isinstance(connection, _Connection):
            name, self._extra_headers, _ = self.get_host_info(host)
            connection = _Connection(name, self._timeout)
            self._connection = host, connection
        connection.end = self.end
        return connection


class _Connection(http.client.HTTPConnection):
    def __init__(self, host: str, timeout: float):
        super().__init__(host, timeout=timeout)
        self.end = 0.0

    def putrequest(self, *arguments: Any, **named: Any) -> None:
        if isinstance(self.sock, _Socket):  # kept from the request before
            self.sock.allow(self.end, _MOST)
        super().putrequest(*arguments, **named)

    def connect(self) -> None:
        super().connect()
        self.sock = _Socket(fileno=self.sock.detach())
        self.sock.allow(self.end, _MOST)


class _Socket(socket.socket):
    def allow(self, end: float, most: int) -> None:
        """
        :param end: when to stop reading and writing, of ``time.monotonic()``
        :param most: bytes that are read until then
        """
        self._end, self._left = end, most
        self._hurry()

    def _hurry(self) -> None:
        seconds = self._end - time.monotonic()
        if seconds <= 0.0:
            raise TimeoutError("timed out")
        self.settimeout(seconds)

    def recv_into(self, *arguments: Any) -> int:
        self._hurry()
        count = super().recv_into(*arguments)
        self._left -= count
        if self._left < 0:
            raise OSError(f"an answer of over {_MOST >> 20} MiB")
        return count

    def sendall(self, *arguments: Any) -> None:
        self._hurry()
        super().sendall(*arguments)


def master_answers(caller: str) -> bool:
    """As ``rosgraph.is_master_online`` for ``caller``, which takes this process's own want of memory or files for a master that is away.

    A node that waits for the master would wait for ever then.

    :raises MemoryError, OSError: what :func:`node_signals.silent` ends the process for, in one line
    """
    try:
        rosgraph.Master(caller).getPid()
    except Exception as error:  # whatever a half-dead master sends
        if node_signals.starved(error):
            raise
        return False
    return True
