"""Topics that stand on the graph only while somebody wants them: `rostopic list` then shows a student those of Gazebo."""

from __future__ import annotations

import threading
import time
import xmlrpc.client
from collections.abc import Callable
from http.client import HTTPException

import rosgraph
import rospy

_PERIOD = 0.5  # wall s between two looks at who subscribes
_KEPT = 5.0  # wall s for which a topic that nobody wants any more stays
_TROUBLE = (OSError, xmlrpc.client.Error, HTTPException, rosgraph.MasterException)


class _Topic:
    def __init__(self, make: Callable[[], rospy.Publisher], gone: Callable[[], None]):
        self.make, self.gone = make, gone
        self.publisher: rospy.Publisher | None = None
        self.wanted_at = 0.0


class OnDemand:
    """Asks the master twice a second who subscribes: it tells publishers of nobody, and this node publishes only then."""

    def __init__(self) -> None:
        self._topics: dict[str, _Topic] = {}
        self._lock = threading.Lock()
        self._master = rosgraph.Master(rospy.get_caller_id())

    def offer(self, name: str, make: Callable[[], rospy.Publisher], gone: Callable[[], None] = lambda: None) -> None:
        """
        :param make: the publisher of the topic ``name`` (as for ``rospy.Publisher``); called, in another thread, when somebody
            subscribes
        :param gone: told, in the same thread, before it is unregistered
        """
        self._topics[rospy.resolve_name(name)] = _Topic(make, gone)

    def start(self) -> None:
        """When all is offered."""
        threading.Thread(target=self._run, name="on demand", daemon=True).start()

    def now(self, name: str) -> None:
        """Somebody is about to subscribe to ``name`` and need not wait for the next look."""
        with self._lock:
            self._want(self._topics[rospy.resolve_name(name)])

    def _run(self) -> None:
        ended = threading.Event()
        rospy.core.add_preshutdown_hook(lambda reason: ended.set())
        while not ended.is_set():
            try:
                self._look({name for name, nodes in self._master.getSystemState()[1] if nodes})
            except _TROUBLE:
                pass  # the master restarts or goes; the watch of it tells
            except rospy.ROSException:  # the node ends
                return
            ended.wait(_PERIOD)

    def _look(self, subscribed: set[str]) -> None:
        with self._lock:
            for name, topic in self._topics.items():
                if name in subscribed:
                    self._want(topic)
                elif topic.publisher is not None and time.monotonic() - topic.wanted_at > _KEPT:
                    if topic.publisher.get_num_connections():
                        continue
                    topic.gone()
                    topic.publisher.unregister()
                    topic.publisher = None

    @staticmethod
    def _want(topic: _Topic) -> None:
        topic.wanted_at = time.monotonic()
        if topic.publisher is None:
            topic.publisher = topic.make()
