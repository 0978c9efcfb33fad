"""``roslaunch rosbridge_server rosbridge_websocket.launch``"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import json
import ssl
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import bson
import node_signals
import rospy
import tornado.httpserver
import tornado.netutil
import tornado.web
import tornado.websocket
from rosauth.srv import Authentication
from rosbridge_library.internal.exceptions import RosbridgeError
from rosbridge_msgs.msg import ConnectedClient, ConnectedClients
from std_msgs.msg import Int32

from rosbridge_server.outbox import Frame, Outbox
from rosbridge_server.protocol import Client, Shared
from rosbridge_server.services import Services
from rosbridge_server.settings import SettingError, Settings
from rosbridge_server.topics import Feeds, Publications

LARGEST = 128 * 1024 * 1024  # bytes of one message of a client
REFUSED = 1008  # websocket: against a rule


class Clients:
    """Who is connected, on the latched topics client_count and connected_clients."""

    def __init__(self) -> None:
        self._count = rospy.Publisher("client_count", Int32, queue_size=10, latch=True)
        self._list = rospy.Publisher("connected_clients", ConnectedClients, queue_size=10, latch=True)
        self._there: dict[int, ConnectedClient] = {}
        self._tell()

    def come(self, number: int, address: str) -> None:
        """The client ``number`` is connected from ``address``."""
        self._there[number] = ConnectedClient(ip_address=address, connection_time=rospy.Time.now())
        rospy.loginfo("Client connected.  %d clients total.", len(self._there))
        self._tell()

    def go(self, number: int) -> None:
        """The client ``number`` has gone."""
        if self._there.pop(number, None) is not None:
            rospy.loginfo("Client disconnected. %d clients total.", len(self._there))
            self._tell()

    def _tell(self) -> None:
        self._list.publish(ConnectedClients(clients=list(self._there.values())))
        self._count.publish(len(self._there))


class Connection(tornado.websocket.WebSocketHandler):
    """One websocket; all its methods run in the loop's thread, what may wait in a thread of the connection's own."""

    numbers = 0

    def initialize(self, shared: Shared, clients: Clients, token: str) -> None:
        """Tornado's arguments of the handler: what all connections ``shared``, who is connected (``clients``), and ``token``."""
        self._shared, self._clients, self._token = shared, clients, token
        self._client: Client | None = None
        self._known = not shared.settings.authenticate

    def check_origin(self, origin: str) -> bool:
        return origin != "null" or self._shared.settings.websocket_null_origin

    def get_compression_options(self) -> dict[str, Any] | None:
        return {} if self._shared.settings.use_compression else None

    def open(self, *_: str, **__: str) -> None:
        self._loop = asyncio.get_running_loop()
        address = self.request.remote_ip or ""
        token = self.get_query_argument("token", "") or ""
        if self._token and not hmac.compare_digest(token.encode(), self._token.encode()):
            self._refuse(f"{address}: the address needs the token: ws://...:{self._shared.settings.port}/?token=...")
            return
        self.set_nodelay(True)
        Connection.numbers += 1
        self._thread = ThreadPoolExecutor(1, "client")
        outbox = Outbox(
            self._loop, self._write, lambda: self._loop.call_soon_threadsafe(self._cut), self._shared.settings.delay_between_messages
        )
        self._client = Client(Connection.numbers, self._shared, outbox)
        self._clients.come(self._client.number, address)

    async def _write(self, frame: Frame) -> None:
        await self.write_message(frame, binary=isinstance(frame, bytes))

    def _cut(self) -> None:
        rospy.logwarn("[Client %d] does not read any more: it is disconnected", self._client.number if self._client else 0)
        if self.ws_connection is not None:
            self.ws_connection._abort()

    async def on_message(self, message: Frame) -> None:
        """``message`` came. The next one is read when this one is done, so that a client that talks too much waits for itself."""
        if self._client is None:
            return
        work = self._client.incoming if self._known else self._introduce
        await asyncio.get_running_loop().run_in_executor(self._thread, work, message)

    def _introduce(self, frame: Frame) -> None:
        """What comes first where clients have to authenticate; in the connection's thread."""
        why = 'authenticate first: {"op": "auth", ...}'
        try:
            data = frame.encode() if isinstance(frame, str) else frame
            said = bson.decode(data) if self._shared.settings.bson_only_mode else json.loads(data)
            if isinstance(said, dict) and said.get("op") == "auth":
                self._known = rospy.ServiceProxy("authenticate", Authentication)(
                    said["mac"], said["client"], said["dest"], said["rand"], rospy.Time(said["t"]), said["level"], rospy.Time(said["end"])
                ).authenticated
                why = "it has no valid message authentication code"
        except rospy.ServiceException as error:
            why = f"the service {rospy.resolve_name('authenticate')} does not answer (rosrun rosauth ros_mac_authentication): {error}"
        except KeyError as error:
            why = f"auth: a field {error} is missing"
        except Exception as error:  # what a stranger sends may be anything
            why = f"auth: {' '.join(str(error).split())[:200]}"
        if not self._known:
            self._loop.call_soon_threadsafe(self._refuse, why)

    def _refuse(self, why: str) -> None:
        rospy.logwarn_throttle_identical(10, f"a client is refused: {why}")
        self.close(REFUSED, why.encode()[:120].decode(errors="ignore"))

    def on_close(self) -> None:
        if self._client is not None:
            self._clients.go(self._client.number)
            self._thread.submit(self._client.finish)
            self._thread.shutdown(wait=False)


def _certificate(settings: Settings) -> ssl.SSLContext | None:
    if not settings.certfile:
        return None
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    try:
        context.load_cert_chain(settings.certfile, settings.keyfile)
    except (OSError, ssl.SSLError) as error:
        raise SettingError(f"~certfile {settings.certfile}, ~keyfile {settings.keyfile}: {error}") from None
    return context


async def _serve(settings: Settings, stop: asyncio.Event) -> None:
    """Until ``stop``."""
    shared = Shared(settings, Feeds(), Publications(settings.unregister_timeout, rospy.logwarn), Services(rospy.logwarn))
    certificate = _certificate(settings)
    application = tornado.web.Application(
        [(r".*", Connection, {"shared": shared, "clients": Clients(), "token": settings.token()})],
        websocket_max_message_size=LARGEST,
        websocket_ping_interval=settings.websocket_ping_interval or None,
        websocket_ping_timeout=settings.websocket_ping_timeout,
        log_function=lambda handler: None,
    )
    server = tornado.httpserver.HTTPServer(application, ssl_options=certificate)
    while not stop.is_set():
        try:
            sockets = tornado.netutil.bind_sockets(settings.port, settings.address)
            break
        except OSError as error:
            rospy.logwarn(
                "Unable to start server: %s port %d cannot be listened on: %s. Retrying in %gs; set ~port to another",
                settings.address,
                settings.port,
                error.strerror,
                settings.retry_startup_delay,
            )
        try:
            await asyncio.wait_for(stop.wait(), settings.retry_startup_delay)
        except TimeoutError:
            pass
    else:
        return
    server.add_sockets(sockets)
    port = sockets[0].getsockname()[1]
    rospy.set_param("~actual_port", port)
    rospy.loginfo("Rosbridge WebSocket server started at %s://%s:%d", "wss" if certificate else "ws", settings.address, port)
    await stop.wait()
    server.stop()


async def _run(settings: Settings) -> None:
    loop, stop = asyncio.get_running_loop(), asyncio.Event()

    def end() -> None:
        with contextlib.suppress(RuntimeError):  # the loop has ended by itself
            loop.call_soon_threadsafe(stop.set)

    rospy.on_shutdown(end)
    await _serve(settings, stop)


def main() -> int:
    node_signals.init_node("rosbridge_websocket")
    try:
        settings = Settings.read(lambda name, default: rospy.get_param("~" + name, default), rospy.myargv()[1:], rospy.logwarn)
        asyncio.run(_run(settings))
    except RosbridgeError as error:
        rospy.logfatal("%s", error)
        return 1
    return 0
