"""Services, called with the bytes that a client sends."""

from __future__ import annotations

import io
from typing import Any

import roslib.message
import rospy
import rosservice
from foxglove.websocket import MessageSchema, Service, ServiceRequest, ServiceSchema

from foxglove_bridge.settings import BridgeError
from foxglove_bridge.topics import schema


class CallError(BridgeError):
    """A service that failed; the client is told this line."""


def type_of(name: str) -> str | None:
    """The type of the service ``name``, asked from its server; None where that does not answer."""
    try:
        return rosservice.get_service_type(name)
    except Exception:  # a server that is going, of another language, behind a wall
        return None


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
    """Those that the graph has."""

    def __init__(self, server: Any) -> None:
        self._server = server
        self._there: dict[str, bool] = {}  # whether it is offered
        self._told: set[str] = set()

    def are(self, names: set[str]) -> None:
        """The graph has the services ``names`` now: offer those that are new, take away the others."""
        gone = [name for name in self._there if name not in names]
        self._server.remove_services([name for name in gone if self._there.pop(name)])
        for name in sorted(names - set(self._there)):
            type_name = type_of(name)
            if type_name is None:
                continue  # asked again when the graph is looked at next
            service = offered(name, type_name)
            self._there[name] = service is not None
            if service is not None:
                self._server.add_services([service])
            elif type_name not in self._told:
                self._told.add(type_name)
                rospy.logwarn("services of type %s are not offered: no package here defines it", type_name)
