"""A node that outlives the ROS master registers with the next one.

rospy registers once. When an external roscore is killed and started again, nobody finds the node's topics, services and
parameters any more, though it runs on. A long-lived node calls :func:`watch` after ``init_node``; it asks the master
once a second whether it is still the one that knows this node.
"""

from __future__ import annotations

import threading
import weakref
import xmlrpc.client
from collections.abc import Callable, Iterator
from http.client import HTTPException

import rosgraph
import rospy
from rospy.impl.registration import RegManager, get_registration_listeners, get_service_manager, get_topic_manager

from node_signals.bounded_calls import Transport

_PERIOD = 1.0  # s
_TIMEOUT = 5.0  # s that the master gets to answer
_TROUBLE = (OSError, xmlrpc.client.Error, HTTPException, rosgraph.MasterException)
_restorers: dict[int, Callable[[], Callable[[], None] | None]] = {}  # by their own id


def on_return(f: Callable[[], None]) -> None:
    """Call ``f()`` when a new master is there, before topics and services are registered: it sets parameters again.

    A bound method is held weakly and forgotten with its object. It runs in the thread of the watch.
    """
    kept = weakref.WeakMethod(f, lambda dead: _restorers.pop(id(dead), None)) if hasattr(f, "__self__") else lambda: f
    _restorers[id(kept)] = kept


def watch() -> None:
    """Look after this node's registrations for the rest of its life. Call it once, after ``rospy.init_node``."""
    threading.Thread(target=_Watch().run, name="master watch", daemon=True).start()


class _Watch:
    def __init__(self):
        self._uri = rosgraph.get_master_uri()
        self._name, self._node_uri = rospy.get_caller_id(), rospy.core.get_node_uri()
        self._master_pid: int | None = None
        self._missed = False

    def run(self) -> None:
        ended = threading.Event()
        rospy.core.add_preshutdown_hook(lambda reason: ended.set())
        while not ended.wait(_PERIOD):
            try:
                self._look()
                self._missed = False
            except _TROUBLE:
                if not self._missed:
                    self._missed = True
                    rospy.logwarn("the ROS master at %s does not answer; this node goes on, and registers again when it is back", self._uri)

    def _look(self) -> None:
        (_, _, pid), (code, _, uri) = self._call([("getPid", ()), ("lookupNode", (self._name,))])
        if self._master_pid is None:
            self._master_pid = pid
        if pid == self._master_pid and code == 1 and uri == self._node_uri:
            return
        if code == 1 and uri != self._node_uri:
            return  # a node of the same name has taken this one's place, and will have ended it
        self._register()
        self._master_pid = pid
        rospy.logwarn("a new ROS master runs at %s: this node has registered with it", self._uri)

    def _call(self, calls: list[tuple[str, tuple]]) -> list:
        """Answers (code, text, value) to several calls, made in one."""
        multi = xmlrpc.client.MultiCall(xmlrpc.client.ServerProxy(self._uri, Transport(_TIMEOUT)))
        for method, arguments in calls:
            getattr(multi, method)(self._name, *arguments)
        return list(multi())  # type: ignore[call-overload]  # what it returns has __getitem__ alone

    def _register(self) -> None:
        for reference in list(_restorers.values()):
            restore = reference()
            if restore is not None:
                restore()
        calls = list(self._registrations())
        managers = [one for one in get_registration_listeners().listeners if isinstance(one, RegManager)]
        for (method, arguments), (_, _, value) in zip(calls, self._call(calls)):
            if method == "registerSubscriber":
                for manager in managers:
                    manager.publisher_update(arguments[0], value)

    def _registrations(self) -> Iterator[tuple[str, tuple]]:
        for topic, kind in get_topic_manager().get_publications():
            yield "registerPublisher", (topic, kind, self._node_uri)
        for topic, kind in get_topic_manager().get_subscriptions():
            yield "registerSubscriber", (topic, kind, self._node_uri)
        for service, uri in get_service_manager().get_services():
            yield "registerService", (service, uri, self._node_uri)
