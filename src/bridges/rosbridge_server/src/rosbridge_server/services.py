"""Services that clients call, and services that clients offer."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable
from typing import Any

import rospy
import rosservice
from rosbridge_library.internal import ros_loader
from rosbridge_library.internal.exceptions import RosbridgeError
from rosbridge_library.internal.message_conversion import extract_values, populate_instance


class ServiceError(RosbridgeError):
    """A call that failed, or a service that cannot be offered, in one line."""


def call(service: str, args: Any) -> Any:
    """Call ``service``.

    :param args: values of the request's fields, by name or in their order; anything else is none
    :return: the response
    :raises RosbridgeError: there is no such service, it failed, or the values are none of the request
    """
    name = rospy.resolve_name(service)
    try:
        type_name = rosservice.get_service_type(name)
    except Exception as error:  # its server is going, of another language, behind a wall
        raise ServiceError(f"the server of {name} does not answer: {' '.join(str(error).split())}") from None
    if type_name is None:
        raise ServiceError(f"there is no service {name}")
    kind = ros_loader.get_service_class(type_name)
    request = kind._request_class()
    if isinstance(args, list):
        if len(args) > len(request.__slots__):
            raise ServiceError(f"{name} takes {len(request.__slots__)} arguments, not {len(args)}")
        args = dict(zip(request.__slots__, args))
    populate_instance(args if isinstance(args, dict) else {}, request)
    try:
        return rospy.ServiceProxy(name, kind).call(request)
    except (rospy.ServiceException, rospy.ROSException) as error:
        raise ServiceError(str(error)) from None


class Offered:
    """One service of a client: its callers wait until the client has answered, or is gone.

    :param ask: sends a request to the client
    :raises RosbridgeError: it cannot be offered
    """

    _numbers = itertools.count(1)

    def __init__(self, name: str, type_name: str, ask: Callable[[dict[str, Any]], None], bson_only: bool) -> None:
        self.name = name
        self._ask, self._bson = ask, bson_only
        self._kind = ros_loader.get_service_class(type_name)
        self._lock = threading.Lock()
        self._calls: dict[str, _Call] = {}
        self._closed = False
        try:
            self._service = rospy.Service(name, self._kind, self._handle)
        except (rospy.ServiceException, rospy.ROSException, ValueError) as error:
            raise ServiceError(f"{name} cannot be offered: {error}") from None

    def _handle(self, request: Any) -> Any:
        number, waiting = f"service_request:{self.name}:{next(self._numbers)}", _Call()
        with self._lock:
            if self._closed:
                raise rospy.ServiceException("the client that offers it is gone")
            self._calls[number] = waiting
        self._ask({"op": "call_service", "id": number, "service": self.name, "args": extract_values(request, self._bson)})
        waiting.done.wait()
        if waiting.error is not None:
            raise rospy.ServiceException(waiting.error)
        return waiting.response

    def answer(self, number: Any, values: Any, result: bool | None) -> None:
        """The client answers the request ``number`` with ``values``, by the response's fields.

        :param result: whether the service could do it; None: the client did not say
        :raises RosbridgeError: the values are none of the response, which its caller is told as well; or nobody has asked
        """
        with self._lock:
            waiting = self._calls.pop(number, None) if isinstance(number, str) else None
        if waiting is None:
            raise ServiceError(f"{self.name}: there is no request with the id {number!r}")
        try:
            if result is None:
                raise ServiceError(f"{self.name}: the response needs a field 'result': true, or false where it failed")
            if not result:
                waiting.error = f"the client says that it failed: {values!r:.300}" if values else "the client says that it failed"
            else:
                waiting.response = populate_instance(values if values is not None else {}, self._kind._response_class())
        except RosbridgeError as error:
            waiting.error = str(error)
            raise
        finally:
            waiting.done.set()

    def close(self, reason: str) -> None:
        """End the service; callers that wait are told ``reason``."""
        with self._lock:
            self._closed = True
            calls, self._calls = list(self._calls.values()), {}
        for waiting in calls:
            waiting.error = reason
            waiting.done.set()
        self._service.shutdown(reason)


class _Call:
    def __init__(self) -> None:
        self.done = threading.Event()
        self.response: Any = None
        self.error: str | None = None


class Services:
    """Services of all clients: a name has one server, the one that came last."""

    def __init__(self, warn: Callable[[str], None]) -> None:
        self._warn = warn
        self._lock = threading.Lock()
        self._there: dict[str, Any] = {}  # name -> client's number, Offered

    def offer(self, client: int, name: str, type_name: str, ask: Callable[[dict[str, Any]], None], bson_only: bool) -> None:
        """``client`` (its number) offers the service ``name`` of type ``type_name``; ``ask`` sends it a request.

        :param bson_only: requests go to it as BSON
        :raises RosbridgeError: it cannot be offered
        """
        with self._lock:
            ros_loader.get_service_class(type_name)  # what is there stays where the new one cannot be
            if name in self._there:
                self._warn(f"{name} was offered before; the new one takes its place")
                self._there.pop(name)[1].close("another client offers it now")
            self._there[name] = client, Offered(name, type_name, ask, bson_only)

    def of(self, client: int, name: str) -> Offered:
        """The service ``name`` of ``client`` (its number). :raises ServiceError: the client does not offer it"""
        owner, found = self._there.get(name, (None, None))
        if owner != client or found is None:
            raise ServiceError(f"you do not offer a service {name}; 'advertise_service' does")
        return found

    def withdraw(self, client: int, name: str) -> None:
        """End the service ``name`` of ``client`` (its number). :raises ServiceError: the client does not offer it"""
        with self._lock:
            self.of(client, name)
            self._there.pop(name)[1].close("it was unadvertised")

    def leave(self, client: int) -> None:
        """All that a client offers ends with it."""
        with self._lock:
            for name in [name for name, (owner, _) in self._there.items() if owner == client]:
                self._there.pop(name)[1].close("the client that offers it is gone")
