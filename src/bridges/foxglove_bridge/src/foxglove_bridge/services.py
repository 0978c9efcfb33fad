"""Services, called with the bytes that a client sends."""

from __future__ import annotations

import io
import queue
import threading
from typing import Any

import roslib.message
import rospy
from foxglove.websocket import MessageSchema, Service, ServiceRequest, ServiceSchema
from rosbridge_library.internal.service_types import type_of

from foxglove_bridge.settings import BridgeError
from foxglove_bridge.topics import schema

ASKERS = 8  # threads that ask servers for their types


class CallError(BridgeError):
    """A service that failed; the client is told this line."""


def offered(name: str, type_name: str) -> Service | None:
    """The service ``name`` of type ``type_name`` for clients; None where no package defines the type."""
    try:
        kind: Any = roslib.message.get_service_class(type_name)
    except (ValueError, ImportError, AttributeError):
        kind = None
    if kind is None:
        return None
    request, response = (
        MessageSchema(encoding="ros1", schema=schema(part, f"{type_name}_{end}"))
        for part, end in ((kind._request_class, "Request"), (kind._response_class, "Response"))
    )
    return Service(name, schema=ServiceSchema(type_name, request=request, response=response), handler=lambda call: _call(name, kind, call))


def _call(name: str, kind: Any, call: ServiceRequest) -> bytes:
    request = kind._request_class()
    try:
        request.deserialize(call.payload)
    except Exception as error:  # genpy raises whatever its struct does
        raise CallError(f"{len(call.payload)} bytes are no request of {kind._type}: {' '.join(str(error).split())[:100]}") from None
    try:
        response = rospy.ServiceProxy(name, kind).call(request)
    except (rospy.ServiceException, rospy.ROSException) as error:
        raise CallError(str(error)) from None
    out = io.BytesIO()
    response.serialize(out)
    return out.getvalue()


class Services:
    """Those that the graph has. Servers are asked for their types in threads of their own: one that hangs holds up nothing else.

    :param timeout: s that a server has to tell its type
    """

    def __init__(self, server: Any, timeout: float) -> None:
        self._server, self._timeout = server, timeout
        self._lock = threading.Lock()
        self._wanted: set[str] = set()
        self._there: dict[str, bool] = {}  # whether it is offered
        self._asked: set[str] = set()  # in the queue, or being asked now
        self._told: set[str] = set()
        self._queue: queue.SimpleQueue[str] = queue.SimpleQueue()
        for _ in range(ASKERS):
            threading.Thread(target=self._ask, daemon=True).start()

    def are(self, names: set[str]) -> None:
        """The graph has the services ``names`` now: take away those that are gone; the others are offered when their types are known."""
        with self._lock:
            self._wanted = names
            gone = [name for name in self._there if name not in names]
            self._server.remove_services([name for name in gone if self._there.pop(name)])
            new = sorted(names - set(self._there) - self._asked)
            self._asked.update(new)
        for name in new:
            self._queue.put(name)

    def stop(self) -> None:
        """Offer nothing more."""
        with self._lock:
            self._wanted = set()

    def _ask(self) -> None:
        while True:
            name = self._queue.get()
            type_name = type_of(name, self._timeout)
            service = offered(name, type_name) if type_name is not None else None
            with self._lock:
                self._asked.discard(name)
                if type_name is not None and name in self._wanted:  # else it is asked again when the graph is looked at next
                    self._offer(name, type_name, service)

    def _offer(self, name: str, type_name: str, service: Service | None) -> None:
        self._there[name] = service is not None
        if service is not None:
            self._server.add_services([service])
        elif type_name not in self._told:
            self._told.add(type_name)
            rospy.logwarn("services of type %s are not offered: no package here defines it", type_name)
