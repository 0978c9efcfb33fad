"""``rosrun rosapi rosapi_node``: what is there, asked by services."""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Callable, Iterable
from typing import Any

import node_signals
import rosgraph
import rosnode
import rospy
import rosservice
from rosbridge_library.internal import ros_loader
from rosbridge_library.internal.exceptions import RosbridgeError
from rosbridge_library.internal.globs import allowed, globs
from rosbridge_library.internal.service_types import type_of, types_of

import rosapi.srv
from rosapi import typedefs

ACTION = {"cancel", "feedback", "goal", "result", "status"}  # topics of an action
PUBLISHED, SUBSCRIBED, OFFERED = range(3)  # of the master's state
PATIENCE = 1.0  # s that a server has to tell the type of its service


class Api:
    """The services' answers.

    :param get: value of a private parameter, or a default
    :raises RosbridgeError: a parameter cannot be used
    """

    def __init__(self, get: Callable[[str, Any], Any]) -> None:
        self._topics, self._services, self._params = (
            globs(f"~{name}_glob", get(f"{name}_glob", "")) for name in ("topics", "services", "params")
        )

    # ------------------------------------------------------------------------------------------ topics

    def _state(self) -> tuple[dict[str, list[str]], ...]:
        return tuple({name: nodes for name, nodes in part} for part in _master().getSystemState())

    def _types(self) -> dict[str, str]:
        """Of topics that somebody publishes or reads and that clients may see; "" where the master knows none."""
        published, subscribed, _ = self._state()
        known = dict(_master().getTopicTypes())
        return {name: known.get(name, "") for name in sorted({*published, *subscribed}) if allowed(name, self._topics)}

    def topics(self, _: Any) -> dict[str, Any]:
        types = self._types()
        return {"topics": list(types), "types": list(types.values())}

    def topics_and_raw_types(self, _: Any) -> dict[str, Any]:
        types = self._types()
        return {"topics": list(types), "types": list(types.values()), "typedefs_full_text": [_full_text(name) for name in types.values()]}

    def topics_for_type(self, request: Any) -> dict[str, Any]:
        return {"topics": [name for name, kind in self._types().items() if kind == request.type]}

    def topic_type(self, request: Any) -> dict[str, Any]:
        return {"type": self._types().get(request.topic, "")}

    def publishers(self, request: Any) -> dict[str, Any]:
        return {"publishers": self._nodes(PUBLISHED, request.topic)}

    def subscribers(self, request: Any) -> dict[str, Any]:
        return {"subscribers": self._nodes(SUBSCRIBED, request.topic)}

    def _nodes(self, part: int, topic: str) -> list[str]:
        return self._state()[part].get(topic, []) if allowed(topic, self._topics) else []

    def action_servers(self, _: Any) -> dict[str, Any]:
        found: dict[str, set] = {}
        for name in self._types():
            space, _, last = name.rpartition("/")
            found.setdefault(space, set()).add(last)
        return {"action_servers": [space for space, names in found.items() if space and names >= ACTION]}

    # ------------------------------------------------------------------------------------------ services and nodes

    def services(self, _: Any) -> dict[str, Any]:
        return {"services": self._seen(self._state()[OFFERED])}

    def _seen(self, services: Iterable[str]) -> list[str]:
        return [name for name in sorted(services) if allowed(name, self._services)]

    def services_for_type(self, request: Any) -> dict[str, Any]:
        types = types_of(self._seen(self._state()[OFFERED]), PATIENCE)
        return {"services": sorted(name for name, kind in types.items() if kind == request.type)}

    def service_type(self, request: Any) -> dict[str, Any]:
        return {"type": (type_of(request.service, PATIENCE) or "") if allowed(request.service, self._services) else ""}

    def service_providers(self, request: Any) -> dict[str, Any]:
        """Nodes that have a service of the type that the field ``service`` names, as upstream."""
        state = self._state()[OFFERED]
        types = types_of(self._seen(state), PATIENCE)
        return {"providers": [node for name, kind in types.items() if kind == request.service for node in state[name]]}

    def service_node(self, request: Any) -> dict[str, Any]:
        return {"node": next(iter(self._state()[OFFERED].get(request.service, [])), "")}

    def service_host(self, request: Any) -> dict[str, Any]:
        uri = rosservice.get_service_uri(request.service) or ""
        return {"host": uri.partition("://")[2].rpartition(":")[0]}

    def nodes(self, _: Any) -> dict[str, Any]:
        return {"nodes": rosnode.get_node_names()}

    def node_details(self, request: Any) -> dict[str, Any]:
        published, subscribed, offered = (sorted(name for name, nodes in part.items() if request.node in nodes) for part in self._state())
        return {"subscribing": subscribed, "publishing": published, "services": offered}

    # ------------------------------------------------------------------------------------------ types

    def message_details(self, request: Any) -> dict[str, Any]:
        return {"typedefs": typedefs.of_message(request.type)}

    def service_request_details(self, request: Any) -> dict[str, Any]:
        return {"typedefs": typedefs.of_class(ros_loader.get_service_class(request.type)._request_class)}

    def service_response_details(self, request: Any) -> dict[str, Any]:
        return {"typedefs": typedefs.of_class(ros_loader.get_service_class(request.type)._response_class)}

    # ------------------------------------------------------------------------------------------ parameters and time

    def get_param_names(self, _: Any) -> dict[str, Any]:
        return {"names": [name for name in rospy.get_param_names() if allowed(name, self._params)]}

    def get_param(self, request: Any) -> dict[str, Any]:
        """The value as JSON; of one that is not there the default, null where none is given."""
        self._allow(request.name)
        default = None
        if request.default:
            try:
                default = json.loads(request.default)
            except ValueError:
                default = request.default
        return {"value": json.dumps(_finite(rospy.get_param(request.name, default)), default=str)}

    def set_param(self, request: Any) -> dict[str, Any]:
        self._allow(request.name)
        try:
            value = json.loads(request.value)
        except ValueError as error:
            raise rospy.ServiceException(
                f"{request.name}: the value {request.value!r:.60} is no JSON ({error}); a text has quotes of its own"
            ) from None
        rospy.set_param(request.name, value)
        return {}

    def has_param(self, request: Any) -> dict[str, Any]:
        return {"exists": allowed(request.name, self._params) and rospy.has_param(request.name)}

    def search_param(self, request: Any) -> dict[str, Any]:
        found = rospy.search_param(request.name) or ""
        return {"global_name": found if allowed(found, self._params) else ""}

    def delete_param(self, request: Any) -> dict[str, Any]:
        self._allow(request.name)
        if rospy.has_param(request.name):
            rospy.delete_param(request.name)
        return {}

    def _allow(self, name: str) -> None:
        if not allowed(name, self._params):
            raise rospy.ServiceException(f"~params_glob does not allow {name}")

    def get_time(self, _: Any) -> dict[str, Any]:
        return {"time": rospy.get_rostime()}


def _master() -> rosgraph.Master:
    """One for each question: services are called in threads, and its connection bears one question at a time."""
    return rosgraph.Master(rospy.get_name())


def _full_text(type_name: str) -> str:
    try:
        return ros_loader.get_message_class(type_name)._full_text
    except RosbridgeError:
        return ""


def _finite(value: Any) -> Any:
    """JSON has no infinity and no NaN: null."""
    if isinstance(value, dict):
        return {name: _finite(each) for name, each in value.items()}
    if isinstance(value, list):
        return [_finite(each) for each in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


#: services under /rosapi, by the names of their types
SERVICES = {
    "topics": "Topics",
    "topics_for_type": "TopicsForType",
    "topics_and_raw_types": "TopicsAndRawTypes",
    "topic_type": "TopicType",
    "services": "Services",
    "services_for_type": "ServicesForType",
    "service_type": "ServiceType",
    "service_providers": "ServiceProviders",
    "service_node": "ServiceNode",
    "service_host": "ServiceHost",
    "publishers": "Publishers",
    "subscribers": "Subscribers",
    "nodes": "Nodes",
    "node_details": "NodeDetails",
    "action_servers": "GetActionServers",
    "message_details": "MessageDetails",
    "service_request_details": "ServiceRequestDetails",
    "service_response_details": "ServiceResponseDetails",
    "set_param": "SetParam",
    "get_param": "GetParam",
    "has_param": "HasParam",
    "search_param": "SearchParam",
    "delete_param": "DeleteParam",
    "get_param_names": "GetParamNames",
    "get_time": "GetTime",
}


def _answer(work: Callable[[Any], dict[str, Any]], kind: Any, request: Any) -> Any:
    try:
        return kind._response_class(**work(request))
    except (
        RosbridgeError,
        rospy.ROSException,
        rosgraph.MasterException,
        rosnode.ROSNodeException,
        rosservice.ROSServiceException,
        KeyError,
        OSError,
    ) as error:
        raise rospy.ServiceException(" ".join(str(error).split())) from None


def main() -> int:
    node_signals.init_node("rosapi_node")
    try:
        api = Api(lambda name, default: rospy.get_param("~" + name, default))
    except RosbridgeError as error:
        rospy.logfatal("%s", error)
        return 1
    for name, type_name in SERVICES.items():
        kind = getattr(rosapi.srv, type_name)
        rospy.Service(f"/rosapi/{name}", kind, functools.partial(_answer, getattr(api, name), kind))
    rospy.loginfo("Rosapi started")
    node_signals.spin()
    return 0
