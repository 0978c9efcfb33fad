"""Answers browsers: a thread for each that looks."""

from __future__ import annotations

import select
import socket
import sys
import time
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any
from urllib.parse import urlsplit

import rospy

from web_video_server import request as requests
from web_video_server import topics
from web_video_server.pages import topics_page, viewer_page
from web_video_server.pictures import NoPicture, encoded
from web_video_server.request import AS_SENT, BadRequest, Request, shown

_BOUNDARY = "boundarydonotcross"
_LOOK = 0.25  # s between looks whether a browser that waits is still there
_PATIENCE = 60.0  # s that a single picture is waited for
_PICTURES = (("sensor_msgs/Image", "*"), ("sensor_msgs/CompressedImage", "*"))  # of a topic, of its compressed one; *: not known yet
_NOT_KEPT = {"Cache-Control": "no-cache, no-store, must-revalidate, pre-check=0, post-check=0, max-age=0", "Pragma": "no-cache"}
_FOR_ALL = {
    "Access-Control-Allow-Origin": "*",
    "Access-Control-Allow-Methods": "GET,POST,PUT,DELETE,HEAD,OPTIONS",
    "Access-Control-Allow-Headers": "Origin, Authorization, Accept, Content-Type",
    "Access-Control-Max-Age": "3600",
}


class Server(ThreadingHTTPServer):
    """:param verbose: each address that is asked for is told
    :param publish_rate: Hz of wall time at which the last picture is sent again where none comes; 0 or less: it is not

    :raises OSError: the address or port cannot be had
    """

    daemon_threads = True
    allow_reuse_address = True

    def __init__(self, address: str, port: int, default_type: str = "mjpeg", verbose: bool = True, publish_rate: float = -1.0):
        self.default_type, self.verbose = default_type, verbose
        self.again = 1.0 / publish_rate if publish_rate > 0 else None  # s
        super().__init__((address, port), _Handler)

    def handle_error(self, _request: Any, _address: Any) -> None:
        """One line; a browser that has gone is no error."""
        error = sys.exc_info()[1]
        if not isinstance(error, OSError):
            rospy.logerr("%s: %s", type(error).__name__, error)


class _Handler(BaseHTTPRequestHandler):
    server: Server
    server_version, sys_version = "web_video_server", ""

    def log_message(self, _format: str, *_arguments: Any) -> None:
        pass

    def do_OPTIONS(self) -> None:
        self._begin(HTTPStatus.OK, "text/plain", {**_FOR_ALL, "Content-Length": "0"})

    def do_GET(self) -> None:
        if self.server.verbose:
            rospy.loginfo("Handling Request: %s", shown(self.path))
        parts = urlsplit(self.path)
        answer = {"/": self._topics, "/stream": self._stream, "/stream_viewer": self._viewer, "/snapshot": self._snapshot}.get(parts.path)
        try:
            if answer is None:
                raise BadRequest(f"there is nothing at {shown(parts.path)}; there are /, /stream, /stream_viewer and /snapshot")
            answer(parts.query)
        except BadRequest as error:
            self._say(HTTPStatus.NOT_FOUND, str(error))
        except OSError:
            pass  # the browser has gone

    def _topics(self, _query: str) -> None:
        self._page(topics_page(list(topics.published().items())))

    def _viewer(self, query: str) -> None:
        self._page(viewer_page(requests.read(query, self.server.default_type).topic, query))

    def _snapshot(self, query: str) -> None:
        """A JPEG, as all of upstream's are, unless the address asks for another type."""
        asked = self._known(requests.read(query))
        until = time.monotonic() + _PATIENCE
        with self._listening(asked) as latest:
            while time.monotonic() < until and not self._gone():
                message = latest.next(_LOOK)
                data = self._data(message, asked) if message is not None else None
                if data is not None:
                    self._begin(
                        HTTPStatus.OK,
                        self._content_type(message, asked),
                        {**_NOT_KEPT, **_FOR_ALL, "X-Timestamp": _stamp(message), "Content-Length": str(len(data))},
                    )
                    self.wfile.write(data)
                    return
        raise BadRequest(f"no picture came on {asked.topic} within {_PATIENCE:g} s; is the simulation paused?")

    def _stream(self, query: str) -> None:
        asked = self._known(requests.read(query, self.server.default_type))
        with self._listening(asked) as latest:
            self._begin(HTTPStatus.OK, f"multipart/x-mixed-replace;boundary={_BOUNDARY}", {**_NOT_KEPT, **_FOR_ALL})
            self.wfile.write(f"--{_BOUNDARY}\r\n".encode())
            last: bytes | None = None
            while not self._gone():
                message = latest.next(self.server.again or _LOOK)
                data = self._data(message, asked) if message is not None else None
                if data is not None:
                    last = self._part(message, data, asked)
                elif last is not None and self.server.again:
                    self.wfile.write(last)

    def _part(self, message: Any, data: bytes, asked: Request) -> bytes:
        head = {
            "Content-type": self._content_type(message, asked),
            "X-Timestamp": _stamp(message),
            **_FOR_ALL,
            "Content-Length": str(len(data)),
        }
        part = "".join(f"{name}: {value}\r\n" for name, value in head.items()).encode() + b"\r\n" + data + f"\r\n--{_BOUNDARY}\r\n".encode()
        self.wfile.write(part)
        return part

    # ------------------------------------------------------------------------------------------ topics

    def _known(self, asked: Request) -> Request:
        """The request as it can be served: ``ros_compressed`` becomes JPEG where nobody compresses.

        :raises BadRequest: nobody publishes the topic
        """
        kinds = topics.published()
        compressed = f"{asked.topic}/compressed" in kinds
        if asked.type == AS_SENT and not compressed:
            rospy.logwarn("nobody publishes %s/compressed: %s is sent as mjpeg", asked.topic, asked.topic)
            asked = Request(asked.topic, "mjpeg", asked.width, asked.height, asked.quality, asked.invert)
        wanted = f"{asked.topic}/compressed" if asked.type == AS_SENT or asked.transport == "compressed" else asked.topic
        kind = kinds.get(wanted, "")
        if kind in _PICTURES[wanted != asked.topic]:
            return asked
        if kind:
            raise BadRequest(
                f"{wanted} has messages of {shown(kind)}, which are no pictures; wanted is {_PICTURES[wanted != asked.topic][0]}"
            )
        images = ", ".join(sorted(name for name, kind in kinds.items() if kind == "sensor_msgs/Image")) or "none"
        raise BadRequest(f"nobody publishes {wanted}; image topics: {images}")

    def _listening(self, asked: Request) -> topics.Latest:
        if asked.type == AS_SENT or asked.transport == "compressed":
            return topics.Latest(f"{asked.topic}/compressed", compressed=True)
        return topics.Latest(asked.topic, compressed=False)

    @staticmethod
    def _data(message: Any, asked: Request) -> bytes | None:
        if asked.type == AS_SENT:
            return bytes(message.data)
        try:
            return encoded(message, asked)
        except NoPicture as error:
            rospy.logerr_throttle(30, shown(f"{asked.topic}: {error}"))
            return None

    @staticmethod
    def _content_type(message: Any, asked: Request) -> str:
        if asked.type != AS_SENT:
            return asked.content_type
        return "image/png" if "png" in message.format else "image/jpeg"

    # ------------------------------------------------------------------------------------------ HTTP

    def _gone(self) -> bool:
        """Whether the browser has closed the connection, or this node ends."""
        readable, _, _ = select.select([self.connection], [], [], 0)
        return rospy.is_shutdown() or bool(readable) and self.connection.recv(1, socket.MSG_PEEK) == b""

    def _page(self, text: str) -> None:
        data = text.encode()
        self._begin(HTTPStatus.OK, "text/html; charset=utf-8", {**_NOT_KEPT, "Content-Length": str(len(data))})
        self.wfile.write(data)

    def _say(self, status: HTTPStatus, sentence: str) -> None:
        rospy.logwarn("%s", shown(sentence))
        data = (sentence + "\n").encode()
        self._begin(status, "text/plain; charset=utf-8", {"Content-Length": str(len(data)), **_FOR_ALL})
        self.wfile.write(data)

    def _begin(self, status: HTTPStatus, kind: str, headers: dict[str, str]) -> None:
        self.send_response(status)
        self.send_header("Connection", "close")
        self.send_header("Content-type", kind)
        for name, value in headers.items():
            self.send_header(name, value)
        self.end_headers()


def _stamp(message: Any) -> str:
    return f"{message.header.stamp.to_sec():.6f}"
