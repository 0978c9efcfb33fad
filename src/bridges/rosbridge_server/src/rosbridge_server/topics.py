"""Topics: one listener for all clients that read one, one publisher for all that write one."""

from __future__ import annotations

import json
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

import bson
import cbor2
import rosgraph
import rospy
from rosbridge_library.internal import pngcompression, ros_loader
from rosbridge_library.internal.cbor_conversion import extract_cbor_values
from rosbridge_library.internal.exceptions import RosbridgeError
from rosbridge_library.internal.message_conversion import extract_values, populate_instance

from rosbridge_server.outbox import Outbox

BUFFER = 16 * 1024 * 1024  # bytes that are read at once, of pictures and clouds
FORMS = ("none", "png", "cbor", "cbor-raw")  # of a message; where clients of one connection ask for several, the last
SETTLING = 2.0  # s after a publisher's beginning, in which who subscribes is also told what was published before
SLOW = 1.0  # s between looks whether a slow client has read


class TopicError(RosbridgeError):
    """A topic that cannot be read or written, in one line."""


def established(topic: str) -> str | None:
    """Type of a topic that somebody publishes or reads; None where nobody does, or the type is not known."""
    master = rosgraph.Master(rospy.get_name())
    published, subscribed, _ = master.getSystemState()
    if not any(name == topic for name, _ in [*published, *subscribed]):
        return None
    found = dict(master.getTopicTypes()).get(topic)
    return None if found == rosgraph.names.ANYTYPE else found


def class_of(topic: str, wanted: str | None, otherwise: str | None = None) -> Any:
    """
    :param wanted: type that a client names, if it does. :param otherwise: type where nothing else says it
    :raises RosbridgeError: the topic has another type, none that is known, or nothing here defines it
    """
    there = established(topic)
    name = wanted if wanted is not None else there or otherwise
    if name is None:
        raise TopicError(f"nobody publishes or reads {topic} yet, so its type is not known; give a field 'type'")
    kind = ros_loader.get_message_class(name)
    if there is not None and kind._type != there:
        raise TopicError(f"{topic} has messages of the type {there}, not {kind._type}")
    return kind


class Message:
    """One message as it came, and in each form in which a client wants it, made once for all."""

    def __init__(self, raw: Any, kind: Any) -> None:
        self._raw, self._kind = raw, kind
        self._now = rospy.get_rostime()
        self._parsed: Any = None
        self._made: dict[tuple[str, str], str | bytes] = {}

    def encoded(self, form: str, topic: str) -> str | bytes:
        """The message of ``topic`` in the form ``form``, as Subscription's compression names it.

        :raises RosbridgeError: its type is not the one of the topic
        """
        if (form, topic) not in self._made:
            self._made[form, topic] = self._encode(form, topic)
        return self._made[form, topic]

    def _encode(self, form: str, topic: str) -> str | bytes:
        head = {"op": "publish", "topic": topic}
        if form == "cbor-raw":
            return cbor2.dumps({**head, "msg": {"secs": self._now.secs, "nsecs": self._now.nsecs, "bytes": self._raw._buff}})
        if form == "cbor":
            return cbor2.dumps({**head, "msg": extract_cbor_values(self._message())})
        if form == "bson":
            return bson.encode({**head, "msg": extract_values(self._message(), bson=True)})
        text = json.dumps({**head, "msg": extract_values(self._message())})
        return json.dumps({"op": "png", "data": pngcompression.encode(text)}) if form == "png" else text

    def _message(self) -> Any:
        if self._parsed is None:
            header = self._raw._connection_header
            if header.get("md5sum") != self._kind._md5sum:
                raise TopicError(f"{header.get('callerid')} sends {header.get('type')}, and {self._kind._type} is defined otherwise here")
            parsed = self._kind()
            parsed.deserialize(self._raw._buff)
            self._parsed = parsed
        return self._parsed


class Feed:
    """What listens to one topic."""

    def __init__(self, topic: str) -> None:
        self.kind: Any = None  # of messages; None while all who read want them as they are
        self._lock = threading.Lock()
        self._readers: list[Subscription] = []
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._take, buff_size=BUFFER, tcp_nodelay=True)

    def add(self, reader: Subscription) -> None:
        """Let ``reader`` be told what comes, and what is latched: once more for each time that its client subscribes."""
        with self._lock:
            self._readers += [reader] if reader not in self._readers else []

        def once(raw: Any) -> None:
            reader.take(Message(raw, self.kind), latched=True)

        # what is latched was told to the subscriber when it connected
        self._subscriber.impl.add_callback(once, None)
        self._subscriber.impl.remove_callback(once, None)

    def remove(self, reader: Subscription) -> bool:
        """``reader`` is told no more. Whether nobody reads any more; then it listens no more."""
        with self._lock:
            self._readers = [each for each in self._readers if each is not reader]
            left = bool(self._readers)
        if not left:
            self._subscriber.unregister()
        return not left

    def _take(self, raw: Any) -> None:
        message = Message(raw, self.kind)
        with self._lock:
            readers = list(self._readers)
        for reader in readers:
            reader.take(message)


class Feeds:
    """All of them, by the resolved names of their topics."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._feeds: dict[str, Feed] = {}

    def join(self, reader: Subscription, wanted: str | None, raw: bool) -> None:
        """Let ``reader`` be told what comes on its topic.

        :param wanted: the type that it asks for; None: whichever it is. :param raw: it takes the messages' bytes as they are
        :raises RosbridgeError: see :func:`class_of`
        """
        topic = rospy.resolve_name(reader.topic)
        with self._lock:
            feed = self._feeds.get(topic)
            kind = feed.kind if feed is not None else None
            if kind is None and not raw:
                kind = class_of(topic, wanted)
            elif kind is not None and wanted is not None and not raw and ros_loader.get_message_class(wanted) is not kind:
                raise TopicError(f"{topic} has messages of the type {kind._type}, not {wanted}")
            if feed is None:
                feed = self._feeds[topic] = Feed(topic)
            feed.kind = kind
            feed.add(reader)

    def leave(self, reader: Subscription) -> None:
        """``reader`` is told no more."""
        topic = rospy.resolve_name(reader.topic)
        with self._lock:
            feed = self._feeds.get(topic)
            if feed is not None and feed.remove(reader):
                del self._feeds[topic]


class Subscription:
    """
    What one client reads of one topic. The client may subscribe more than once, by ids of its own: what is asked for most counts.

    :param send: a message's text or bytes, and the size of its fragments
    """

    def __init__(
        self,
        topic: str,
        send: Callable[[str, str | bytes, int | None], None],
        outbox: Outbox,
        bson_only: bool,
        complain: Callable[[str], None],
    ) -> None:
        self.topic = topic
        self._send, self._outbox, self._bson, self._complain = send, outbox, bson_only, complain
        self._wishes: dict[Any, dict[str, Any]] = {}
        self._changed = threading.Condition()
        self._waiting: deque[Message] = deque()
        self._last = 0.0
        self._pause, self._length = 0.0, 0  # s, messages
        self._form, self._fragment = "none", None
        self._worker: threading.Thread | None = None
        self._closed = False

    def wish(self, number: Any, throttle_rate: float, queue_length: int, fragment_size: int | None, compression: str) -> None:
        """Note what the client asks for by the id ``number``.

        :param throttle_rate: ms between two messages. :param queue_length: messages kept for later meanwhile; 0: they are dropped
        :param fragment_size: bytes; None: messages go whole. :param compression: "none", "png", "cbor" or "cbor-raw"
        """
        with self._changed:
            self._wishes[number] = {"pause": throttle_rate / 1000, "length": queue_length, "fragment": fragment_size, "form": compression}
            self._settle()

    def drop(self, number: Any) -> bool:
        """The client does not want what it asked for by the id ``number`` (None: all). Whether nothing is wished any more."""
        with self._changed:
            if number is None:
                self._wishes.clear()
            self._wishes.pop(number, None)
            self._settle()
            return not self._wishes

    def _settle(self) -> None:
        wishes = self._wishes.values()
        if not wishes:
            return
        self._pause, self._length = min(wish["pause"] for wish in wishes), min(wish["length"] for wish in wishes)
        self._fragment = min((wish["fragment"] for wish in wishes if wish["fragment"]), default=None)
        self._form = "bson" if self._bson else max((wish["form"] for wish in wishes), key=FORMS.index)
        self._waiting = deque(self._waiting, maxlen=self._length or None)
        if self._length and self._worker is None:
            self._worker = threading.Thread(target=self._work, name=f"queue of {self.topic}", daemon=True)
            self._worker.start()
        self._changed.notify_all()

    def close(self) -> None:
        with self._changed:
            self._closed = True
            self._changed.notify_all()

    def take(self, message: Message, latched: bool = False) -> None:
        """Sends, keeps or drops ``message``; does not wait for the client.

        :param latched: it comes for a new wish, and no pause drops it: there is no next one
        """
        with self._changed:
            if self._closed:
                return
            if self._length:
                self._waiting.append(message)
                self._changed.notify_all()
                return
            now = time.monotonic()
            if self._pause and not latched and now < self._last + self._pause:
                return
            self._last = now
        self._tell(message)

    def _work(self) -> None:
        """Sends what waits, not faster than the throttle and the client let it."""
        while True:
            with self._changed:
                while not self._closed and not self._waiting:
                    self._changed.wait()
                rest = self._last + self._pause - time.monotonic()
                if not self._closed and rest > 0:
                    self._changed.wait(rest)
                    continue
            if self._closed:
                return
            if not self._outbox.wait_until_empty(SLOW):
                continue
            with self._changed:
                if not self._waiting:
                    continue
                message = self._waiting.popleft()
                self._last = time.monotonic()
            self._tell(message)

    def _tell(self, message: Message) -> None:
        try:
            self._send(self.topic, message.encoded(self._form, self.topic), self._fragment)
        except Exception as error:  # of bytes that are no message of their type, genpy raises whatever its struct does
            self._complain(f"{self.topic}: {' '.join(str(error).split())[:300]}")


class _Early(rospy.SubscribeListener):
    """Who publishes right after advertising means those as well that are still connecting."""

    def __init__(self) -> None:
        self._end = time.monotonic() + SETTLING
        self._messages: list[Any] = []

    def keep(self, message: Any) -> None:
        if time.monotonic() < self._end:
            self._messages.append(message)
        elif self._messages:
            self._messages = []

    def peer_subscribe(self, topic_name: str, topic_publish: Any, peer_publish: Callable[[Any], None]) -> None:
        for message in list(self._messages) if time.monotonic() < self._end else ():
            peer_publish(message)


class Publication:
    """A publisher that clients share."""

    def __init__(self, topic: str, kind: Any, latch: bool, queue_size: int) -> None:
        self.kind, self.latch = kind, latch
        self.clients: set[int] = set()
        self.unused_since: float | None = None
        self._early = _Early()
        self._publisher = rospy.Publisher(
            topic, kind, subscriber_listener=self._early, latch=latch, queue_size=queue_size, tcp_nodelay=True
        )

    def publish(self, values: Any) -> None:
        """Publish a message of ``values``, by its fields. :raises RosbridgeError: they are none of it"""
        message = populate_instance(values, self.kind())
        if not self.latch:
            self._early.keep(message)
        self._publisher.publish(message)

    def close(self) -> None:
        self._publisher.unregister()


class Publications:
    """All publishers, by the resolved names of their topics.

    :param patience: s that one stays when the last client that used it has gone
    """

    def __init__(self, patience: float, warn: Callable[[str], None]) -> None:
        self._patience, self._warn = patience, warn
        self._lock = threading.Lock()
        self._there: dict[str, Publication] = {}

    def register(
        self, client: int, topic: str, wanted: str | None, latch: bool, queue_size: int, otherwise: str | None = None
    ) -> Publication:
        """The publisher of ``topic``, which ``client`` (its number) uses from now on.

        :param wanted: the type that it asks for; None: whichever it is. :param latch, queue_size: as for ``rospy.Publisher``
        :param otherwise: the type of a topic that nobody knows yet
        :raises RosbridgeError: see :func:`class_of`
        """
        topic = rospy.resolve_name(topic)
        with self._lock:
            found = self._there.get(topic)
            if found is None:
                try:
                    found = self._there[topic] = Publication(topic, class_of(topic, wanted, otherwise), latch, queue_size)
                except (rospy.ROSException, ValueError) as error:
                    raise TopicError(f"{topic} cannot be published: {error}") from None
            elif wanted is not None and ros_loader.get_message_class(wanted) is not found.kind:
                raise TopicError(f"{topic} has messages of the type {found.kind._type}, not {wanted}")
            elif wanted is not None and latch != found.latch:
                self._warn(f"{topic} is already published, {'' if found.latch else 'not '}latched, and stays so")
            found.clients.add(client)
            found.unused_since = None
            return found

    def unregister(self, client: int, topic: str) -> None:
        """``client`` (its number) does not publish on ``topic`` any more."""
        topic = rospy.resolve_name(topic)
        with self._lock:
            found = self._there.get(topic)
            if found is None or client not in found.clients:
                return
            found.clients.discard(client)
            if found.clients:
                return
            found.unused_since = time.monotonic()
        timer = threading.Timer(self._patience, self._forget, (topic, found.unused_since))
        timer.daemon = True
        timer.start()

    def _forget(self, topic: str, since: float) -> None:
        with self._lock:
            found = self._there.get(topic)
            if found is None or found.unused_since != since:
                return
            del self._there[topic]
            found.close()
