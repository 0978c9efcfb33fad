"""``roslaunch foxglove_bridge foxglove_bridge.launch``"""

from __future__ import annotations

import dataclasses
import logging
import socket
import threading
from typing import Any

import foxglove
import node_signals
import rosgraph
import rosnode
import rospy
from foxglove.websocket import Capability, ConnectionGraph, Parameter, ServerListener, StatusLevel
from rosgraph_msgs.msg import Clock

from foxglove_bridge import assets
from foxglove_bridge.parameters import Parameters
from foxglove_bridge.services import Services
from foxglove_bridge.settings import TRIES, SettingError, Settings, allowed, unknown
from foxglove_bridge.topics import Published, Topics, now_ns

FIRST_LOOK, SLOWER = 0.2, 1.5  # s between looks at the graph, which grow while nothing changes
_KNOWN = {
    "clientPublish": Capability.ClientPublish,
    "parameters": Capability.Parameters,
    "services": Capability.Services,
    "connectionGraph": Capability.ConnectionGraph,
}


class Bridge(ServerListener):
    """The server, and what clients ask of it.

    :raises OSError: the address cannot be listened on
    """

    def __init__(self, settings: Settings) -> None:
        self.settings = settings
        # The library says by Python's logging that a client reads too slowly, and holds a lock of that client meanwhile: another thread
        # that has Python's own lock then waits for the first, which waits for Python's. It says nothing from CRITICAL on.
        foxglove.set_log_level(logging.CRITICAL)
        self._context = foxglove.Context()
        self._topics = Topics(self._context)
        self._published = Published(lambda name: allowed(name, settings.client_topic_whitelist), self._complain)
        self._parameters = Parameters(lambda name: allowed(name, settings.param_whitelist), self._parameters_changed, self._complain)
        self._graph_wanted = False
        self._clock: rospy.Subscriber | None = None
        has = settings.capabilities
        simulated = bool(rospy.get_param("/use_sim_time", False))
        capabilities = [_KNOWN[name] for name in has if name in _KNOWN] + ([Capability.Time] if simulated else [])
        with socket.socket() as probe:  # the server's own error does not say which port
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            probe.bind((settings.address, settings.port))
        self.server = foxglove.start_server(
            name="noetic_labs",
            host=settings.address,
            port=settings.port,
            capabilities=capabilities,
            server_listener=self,
            supported_encodings=["ros1"],
            context=self._context,
            session_id=str(now_ns()),
            asset_handler=(lambda uri: assets.fetch(uri, settings.asset_uri_allowlist)) if "assets" in has else None,
        )
        self._services = Services(self.server, settings.service_type_retrieval_timeout_ms / 1000) if "services" in has else None
        if simulated:
            self._clock = rospy.Subscriber("/clock", Clock, lambda m: self.server.broadcast_time(m.clock.to_nsec()), queue_size=1)

    # ------------------------------------------------------------------------------------------ the graph

    def follow_graph(self, stop: threading.Event) -> None:
        """Until ``stop``: topics, services and followed parameters as they come and go."""
        master = rosgraph.Master(rospy.get_name())
        pause, before = FIRST_LOOK, None
        while not stop.wait(pause):
            try:
                state, types = master.getSystemState(), dict(master.getTopicTypes())
                self._look(state, types)
                self._parameters.look()
            except (rosgraph.MasterException, OSError):  # it is away; it may come back
                state = None
            pause = FIRST_LOOK if state != before else min(pause * SLOWER, self.settings.max_update_ms / 1000)
            before = state

    def stop(self) -> None:
        """Tell clients that it ends."""
        if self._services is not None:
            self._services.stop()
        self.server.stop()

    def _look(self, state: list[Any], types: dict[str, str]) -> None:
        published, subscribed, services = ({name: nodes for name, nodes in part} for part in state)
        names = {name: types[name] for name in published if name in types and allowed(name, self.settings.topic_whitelist)}
        self._topics.are({name: type_name for name, type_name in names.items() if type_name != "*"})
        if self._services is not None:
            own = rospy.get_name() + "/"
            wanted: set[str] = {name for name in services if allowed(name, self.settings.service_whitelist) and not name.startswith(own)}
            self._services.are(wanted)
        if self._graph_wanted:
            graph = ConnectionGraph()
            for name, nodes in published.items():
                graph.set_published_topic(name, nodes)
            for name, nodes in subscribed.items():
                graph.set_subscribed_topic(name, nodes)
            for name, nodes in services.items():
                graph.set_advertised_service(name, nodes)
            self.server.publish_connection_graph(graph)

    # ------------------------------------------------------------------------------------------ what clients ask

    def on_subscribe(self, client: Any, channel: Any) -> None:
        """``client`` reads ``channel``: the library calls this, as the methods below."""
        topic = self._topics.by_channel(channel.id)
        if topic is not None:
            topic.read_by(client.id)

    def on_unsubscribe(self, client: Any, channel: Any) -> None:
        """``client`` does not read ``channel`` any more."""
        topic = self._topics.by_channel(channel.id)
        if topic is not None:
            topic.left_by(client.id)

    def on_client_advertise(self, client: Any, channel: Any) -> None:
        """``client`` is going to publish on ``channel``."""
        self._published.advertise(client.id, channel)

    def on_client_unadvertise(self, client: Any, client_channel_id: int) -> None:
        """``client`` does not publish on its channel ``client_channel_id`` any more."""
        self._published.unadvertise(client.id, client_channel_id)

    def on_message_data(self, client: Any, client_channel_id: int, data: bytes) -> None:
        """``client`` sends ``data``, a message of ROS 1, on its channel ``client_channel_id``."""
        self._published.message(client.id, client_channel_id, data)

    def on_get_parameters(self, client: Any, param_names: list[str], request_id: str | None = None) -> list[Parameter]:
        """The values of ``param_names``, all parameters if none is named, for ``client``'s request ``request_id``."""
        return self._parameters.get(param_names)

    def on_set_parameters(self, client: Any, parameters: list[Parameter], request_id: str | None = None) -> list[Parameter]:
        """Set ``parameters`` for ``client``'s request ``request_id``. :return: what they are then"""
        return self._parameters.set(parameters)

    def on_parameters_subscribe(self, param_names: list[str]) -> None:
        self._parameters.follow(param_names)

    def on_parameters_unsubscribe(self, param_names: list[str]) -> None:
        self._parameters.unfollow(param_names)

    def on_connection_graph_subscribe(self) -> None:
        self._graph_wanted = True  # the graph's own thread tells it: from here the server would wait for itself

    def on_connection_graph_unsubscribe(self) -> None:
        self._graph_wanted = False

    # ------------------------------------------------------------------------------------------ what is told

    def _parameters_changed(self, parameters: list[Parameter]) -> None:
        self.server.publish_parameter_values(parameters)

    def _complain(self, line: str, level: Any = StatusLevel.Warning) -> None:
        rospy.logwarn("%s", line)
        self.server.publish_status(line, level)


def main() -> int:
    node_signals.init_node("foxglove_bridge")
    try:
        settings = _settings()
        bridge = Bridge(settings)
    except SettingError as error:
        rospy.logfatal("%s", error)
        return 1
    except (OSError, OverflowError) as error:
        rospy.logfatal(
            "%s port %d cannot be listened on: %s; set ~port to another",
            settings.address,
            settings.port,
            getattr(error, "strerror", None) or error,
        )
        return 1
    rospy.loginfo("ws://%s:%d for Foxglove and Lichtblick", settings.address, bridge.server.port)
    stop = threading.Event()
    rospy.on_shutdown(stop.set)
    follow(bridge, stop)
    return 0


def _settings() -> Settings:
    settings = Settings.read(lambda name, default: rospy.get_param("~" + name, default), rospy.logwarn)
    for name in unknown(settings.capabilities):
        rospy.logwarn("~capabilities: there is no '%s'", name)
    return settings


def follow(bridge: Bridge, stop: threading.Event) -> None:
    """Let ``bridge`` work until ``stop``."""
    bridge.follow_graph(stop)
    bridge.stop()


def own_or_running() -> tuple[int, Bridge | None]:
    """Port of the bridge that runs on this master, and None; else one is begun in this process, on the first free port.

    :raises SettingError: no port is free, or a parameter of this node cannot be used
    """
    port = rospy.get_param("/foxglove_bridge/port", None)
    if isinstance(port, int) and "/foxglove_bridge" in rosnode.get_node_names():
        return port, None
    settings = _settings()
    for candidate in range(settings.port, settings.port + TRIES):
        try:
            bridge = Bridge(dataclasses.replace(settings, port=candidate))
            return bridge.server.port, bridge
        except (OSError, OverflowError):
            continue
    raise SettingError(f"no port from {settings.port} to {settings.port + TRIES - 1} is free for the bridge; set ~port to another")
