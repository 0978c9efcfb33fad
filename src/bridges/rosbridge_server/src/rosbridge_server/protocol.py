"""What one client says, operation by operation, and what it is told."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import bson
import cbor2
import rospy
from rosbridge_library.internal import pngcompression
from rosbridge_library.internal.cbor_conversion import extract_cbor_values
from rosbridge_library.internal.exceptions import InvalidArgumentException, MissingArgumentException, RosbridgeError
from rosbridge_library.internal.globs import allowed
from rosbridge_library.internal.message_conversion import extract_values

from rosbridge_server import services
from rosbridge_server.outbox import Frame, Outbox
from rosbridge_server.settings import Settings
from rosbridge_server.topics import FORMS, Feeds, Publications, Subscription

LEVELS = ("none", "error", "warning", "info")  # of what a client is told
MOST = 128 * 1024 * 1024  # characters of a client's fragments that wait for the others
SAID_AGAIN = 10.0  # s until the same line is logged again
_WORDS = {str: "a text", bool: "true or false", int: "a whole number", float: "a number", list: "a list", dict: "an object"}


@dataclass
class _Fragments:
    total: int
    parts: dict[int, Any] = field(default_factory=dict)
    last: float = field(default_factory=time.monotonic)


@dataclass(frozen=True)
class Shared:
    """What all clients share."""

    settings: Settings
    feeds: Feeds
    publications: Publications
    services: services.Services


class Client:
    """
    One connection. :meth:`incoming` and :meth:`finish` are called one after the other, in any thread but the websocket's.

    :param number: its name in the log
    """

    def __init__(self, number: int, shared: Shared, outbox: Outbox) -> None:
        self.number = number
        self._shared, self._settings, self._outbox = shared, shared.settings, outbox
        self._bson = shared.settings.bson_only_mode
        self._level = "error"
        self._subscriptions: dict[str, Subscription] = {}
        self._advertised: dict[str, set] = {}  # topic -> ids
        self._published: set = set()
        self._fragments: dict[Any, _Fragments] = {}
        self._fragment_number = 0
        self._operations: dict[str, Callable[[dict[str, Any]], None]] = {
            "advertise": self._advertise,
            "unadvertise": self._unadvertise,
            "publish": self._publish,
            "subscribe": self._subscribe,
            "unsubscribe": self._unsubscribe,
            "call_service": self._call_service,
            "advertise_service": self._advertise_service,
            "unadvertise_service": self._unadvertise_service,
            "service_response": self._service_response,
            "fragment": self._fragment,
            "png": self._png,
            "set_level": self._set_level,
            "auth": lambda message: None,
        }  # where it is asked for, it comes first

    # ------------------------------------------------------------------------------------------ in

    def incoming(self, frame: Frame) -> None:
        """One frame of the websocket."""
        try:
            for message in self._decoded(frame):
                self._do(message)
        except RosbridgeError as error:
            self.say("error", str(error))

    def _decoded(self, frame: Frame) -> Iterator[Any]:
        if self._bson:
            try:
                yield bson.decode(frame if isinstance(frame, bytes) else frame.encode())
            except Exception as error:  # bson raises whatever its struct does
                raise InvalidArgumentException(f"{len(frame)} bytes are no BSON: {error}") from None
            return
        try:
            text = frame.decode() if isinstance(frame, bytes) else frame
            decoder, place = json.JSONDecoder(), 0
            while place < len(text) and text[place:].strip():
                place += len(text[place:]) - len(text[place:].lstrip())
                message, place = decoder.raw_decode(text, place)
                yield message
        except (ValueError, RecursionError) as error:
            raise InvalidArgumentException(f"{frame[:40]!r} is no JSON: {error}") from None

    def _do(self, message: Any) -> None:
        number = message.get("id") if isinstance(message, dict) else None
        try:
            if not isinstance(message, dict) or "op" not in message:
                raise MissingArgumentException(f"a message is an object with a field 'op'; there are {', '.join(sorted(self._operations))}")
            operation = self._operations.get(message["op"]) if isinstance(message["op"], str) else None
            if operation is None:
                raise InvalidArgumentException(f"there is no operation {message['op']!r}; there are {', '.join(sorted(self._operations))}")
            operation(message)
        except (RosbridgeError, rospy.ROSException, OSError) as error:
            name = message.get("op", "") if isinstance(message, dict) else ""
            self.say("error", f"{name}: {error}" if name in self._operations else str(error), number)
        except Exception as error:  # the connection and the other clients live on
            self.say("error", f"{message.get('op')}: {type(error).__name__}: {' '.join(str(error).split())[:300]}", number)

    def _advertise(self, message: dict[str, Any]) -> None:
        topic, type_name = _get(message, "topic", str), _get(message, "type", str)
        self._allow(topic, "topics_glob")
        self._shared.publications.register(
            self.number, topic, type_name, _get(message, "latch", bool, False), _get(message, "queue_size", int, 100)
        )
        self._advertised.setdefault(topic, set()).add(_key(message.get("id")))

    def _unadvertise(self, message: dict[str, Any]) -> None:
        topic = _get(message, "topic", str)
        ids = self._advertised.get(topic, set())
        ids.discard(_key(message.get("id")))
        if message.get("id") is None or not ids:
            if self._advertised.pop(topic, None) is not None and topic not in self._published:
                self._shared.publications.unregister(self.number, topic)

    def _publish(self, message: dict[str, Any]) -> None:
        topic = _get(message, "topic", str)
        self._allow(topic, "topics_glob")
        latch, queue_size = _get(message, "latch", bool, False), _get(message, "queue_size", int, 100)
        publication = self._shared.publications.register(self.number, topic, None, latch, queue_size, _get(message, "type", str, None))
        if topic not in self._advertised:
            self._published.add(topic)
        publication.publish(message.get("msg", {}))

    def _subscribe(self, message: dict[str, Any]) -> None:
        topic, type_name = _get(message, "topic", str), _get(message, "type", str, None)
        throttle = _get(message, "throttle_rate", float, 0)
        length, fragment = _get(message, "queue_length", int, 0), _get(message, "fragment_size", int, None)
        compression = _get(message, "compression", str, "none")
        if compression not in FORMS:
            raise InvalidArgumentException(f"there is no compression {compression!r}; there are {', '.join(FORMS)}")
        for name, value, least in (("throttle_rate", throttle, 0), ("queue_length", length, 0), ("fragment_size", fragment or 1, 1)):
            if not least <= value < float("inf"):
                raise InvalidArgumentException(f"{name} is {value}: out of range")
        self._allow(topic, "topics_glob")
        subscription = self._subscriptions.get(topic)
        if subscription is None:
            subscription = Subscription(topic, self._tell_topic, self._outbox, self._bson, lambda line: self.say("error", line))
        subscription.wish(_key(message.get("id")), throttle, length, fragment, compression)
        try:
            self._shared.feeds.join(subscription, type_name, compression == "cbor-raw")
        except RosbridgeError:
            if subscription.drop(_key(message.get("id"))):
                subscription.close()
            raise
        self._subscriptions[topic] = subscription
        self.say("info", f"subscribed to {topic}", message.get("id"))

    def _unsubscribe(self, message: dict[str, Any]) -> None:
        topic, number = _get(message, "topic", str), message.get("id")
        subscription = self._subscriptions.get(topic)
        if subscription is not None and subscription.drop(None if number is None else _key(number)):
            self._end(self._subscriptions.pop(topic))
            self.say("info", f"unsubscribed from {topic}", number)

    def _end(self, subscription: Subscription) -> None:
        subscription.close()
        self._shared.feeds.leave(subscription)

    def _call_service(self, message: dict[str, Any]) -> None:
        service = _get(message, "service", str)
        name, _, number = service.partition("#")  # an id as old pages wrote it
        number = message.get("id", number or None)
        fragment = _get(message, "fragment_size", int, None)
        compression = _get(message, "compression", str, "none")

        def work() -> None:
            answer = {"op": "service_response", "service": service, **({} if number is None else {"id": number})}
            try:
                self._allow(name, "services_glob")
                response = services.call(name, message.get("args", []))
                values = extract_cbor_values(response) if compression == "cbor" else extract_values(response, self._bson)
                self.send({**answer, "values": values, "result": True}, fragment, compression)
            except Exception as error:  # whatever it is, the client waits for an answer
                line = " ".join(str(error).split())
                self.say("error", f"call_service: {name}: {line}", number)
                self.send({**answer, "values": line, "result": False})

        threading.Thread(target=work, name=f"call of {name}", daemon=True).start()

    def _advertise_service(self, message: dict[str, Any]) -> None:
        service, type_name = _get(message, "service", str), _get(message, "type", str)
        self._allow(service, "services_glob")
        fragment = _get(message, "fragment_size", int, None)
        self._shared.services.offer(self.number, service, type_name, lambda request: self.send(request, fragment), self._bson)
        self.say("info", f"advertised service {service}", message.get("id"))

    def _unadvertise_service(self, message: dict[str, Any]) -> None:
        self._shared.services.withdraw(self.number, _get(message, "service", str))
        self.say("info", f"unadvertised service {message['service']}", message.get("id"))

    def _service_response(self, message: dict[str, Any]) -> None:
        offered = self._shared.services.of(self.number, _get(message, "service", str))
        offered.answer(_get(message, "id", str), message.get("values"), _get(message, "result", bool, None))

    def _fragment(self, message: dict[str, Any]) -> None:
        number, total = _key(_get(message, "id", object)), _get(message, "total", int)
        place, data = _get(message, "num", int), _get(message, "data", bytes if self._bson else str)
        now = time.monotonic()
        for old in [key for key, found in self._fragments.items() if now - found.last > self._settings.fragment_timeout]:
            del self._fragments[old]
            self.say("warning", f"the fragments of {old} took more than {self._settings.fragment_timeout:g} s; they are gone")
        whole = self._fragments.setdefault(number, _Fragments(total))
        waiting = sum(len(part) for found in self._fragments.values() for part in found.parts.values())
        if total != whole.total or not 0 <= place < total or waiting + len(data) > MOST:
            del self._fragments[number]
            raise InvalidArgumentException(
                f"fragment {place} of {total} of the message {number}: "
                + (
                    "there are too many"
                    if 0 <= place < total == whole.total
                    else f"the others are of {whole.total}"
                    if total != whole.total
                    else f"they count from 0 to {total - 1}"
                )
            )
        whole.parts[place], whole.last = data, now
        if len(whole.parts) == total:
            del self._fragments[number]
            self.incoming((b"" if self._bson else "").join(whole.parts[index] for index in range(total)))

    def _png(self, message: dict[str, Any]) -> None:
        data = _get(message, "data", str)
        try:
            text = pngcompression.decode(data)
        except Exception as error:  # Pillow raises whatever a broken picture makes it
            raise InvalidArgumentException(f"data is no picture in base64: {error}") from None
        self.incoming(text)

    def _set_level(self, message: dict[str, Any]) -> None:
        level = _get(message, "level", str)
        if level not in LEVELS:
            raise InvalidArgumentException(f"there is no level {level!r}; there are {', '.join(LEVELS)}")
        self._level = level

    def _allow(self, name: str, setting: str) -> None:
        if not allowed(name, getattr(self._settings, setting)):
            raise InvalidArgumentException(f"~{setting} does not allow {name}")

    # ------------------------------------------------------------------------------------------ out

    def say(self, level: str, line: str, number: Any = None) -> None:
        """``line`` into the log, and to the client where its level asks for ``level``; ``number``: id of what it is about."""
        log = {"error": rospy.logerr_throttle_identical, "warning": rospy.logwarn_throttle_identical}.get(level)
        if log is not None:
            log(SAID_AGAIN, f"[Client {self.number}] {line}")
        else:
            rospy.logdebug("[Client %d] %s", self.number, line)
        if LEVELS.index(level) <= LEVELS.index(self._level):
            self.send({"op": "status", "level": level, "msg": line, **({} if number is None else {"id": number})})

    def send(self, message: dict[str, Any], fragment: int | None = None, compression: str = "none") -> None:
        """Send ``message``, in pieces of ``fragment`` bytes (None: whole), packed by ``compression``: "none", "png", "cbor"."""
        if compression == "cbor" and not self._bson:
            data: Frame = cbor2.dumps(message)
        elif compression == "png" and not self._bson:
            data = json.dumps({"op": "png", "data": pngcompression.encode(json.dumps(message))})
        else:
            data = self._encode(message)
        self._outbox.put(self._frames(data, fragment, message.get("id")))

    def _tell_topic(self, topic: str, data: Frame, fragment: int | None) -> None:
        if self._outbox.put(self._frames(data, fragment, None), topic):
            rospy.logwarn_throttle_identical(60, f"[Client {self.number}] reads too slowly: messages of {topic} are dropped")

    def _encode(self, message: dict[str, Any]) -> Frame:
        return bson.encode(message) if self._bson else json.dumps(message)

    def _frames(self, data: Frame, fragment: int | None, number: Any) -> list[Frame]:
        size = fragment or self._settings.max_message_size
        if not size or len(data) <= size or isinstance(data, bytes) and not self._bson:  # CBOR is not cut
            return [data]
        if number is None:
            self._fragment_number += 1
            number = str(self._fragment_number)
        total = -(-len(data) // size)
        return [
            self._encode({"op": "fragment", "id": number, "data": data[place * size : (place + 1) * size], "num": place, "total": total})
            for place in range(total)
        ]

    def finish(self) -> None:
        """The client is gone, and nothing of it stays."""
        self._outbox.close()
        for subscription in self._subscriptions.values():
            self._end(subscription)
        for topic in {*self._advertised, *self._published}:
            self._shared.publications.unregister(self.number, topic)
        self._shared.services.leave(self.number)
        self._subscriptions.clear()
        self._fragments.clear()


_REQUIRED: Any = object()


def _get(message: dict[str, Any], name: str, kind: type[Any], default: Any = _REQUIRED) -> Any:
    """A field, checked; null counts as none where there is a default.

    :raises RosbridgeError: it is missing, or of another type
    """
    value = message.get(name)
    if value is None and (default is not _REQUIRED or name not in message):
        if default is _REQUIRED:
            raise MissingArgumentException(f"a field '{name}' is missing")
        return default
    kinds: tuple[type, ...] = (int, float) if kind is float else (kind,)
    if not isinstance(value, kinds) or isinstance(value, bool) and kind in (int, float):
        raise InvalidArgumentException(f"field '{name}' should be {_WORDS.get(kind, 'bytes')}, not {value!r:.60}")
    return value


def _key(number: Any) -> str | int | float | None:
    """An id as a key; clients choose what they like."""
    return number if isinstance(number, (str, int, float)) or number is None else repr(number)
