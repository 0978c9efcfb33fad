"""XML-RPC calls to the ROS master and to nodes that are given up after a while: one that is stopped answers nobody."""

from __future__ import annotations

import xmlrpc.client

import rosgraph

import node_signals


class Transport(xmlrpc.client.Transport):
    """For ``xmlrpc.client.ServerProxy(uri, transport=Transport(1.0))``: its calls raise ``TimeoutError`` after that.

    :param timeout: s that connecting, and each wait for a part of the answer, may take
    """

    def __init__(self, timeout: float):
        super().__init__()
        self._timeout = timeout

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = self._timeout
        return connection


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
