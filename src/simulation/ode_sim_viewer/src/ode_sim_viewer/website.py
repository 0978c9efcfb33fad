"""The web server of the page, and who may open it.

By default it answers on the loopback interface only, to pages that come from itself. With ``listen`` it answers to
every machine that shows the token, which is part of the address that is printed once. A page that changes what others see asks for
the token on the loopback interface, too (``token``): all users of the machine reach that.

The port is taken at once, viser (a second of imports) is started when a browser has knocked. The page itself is given to that
browser at once, by the :mod:`~ode_sim_viewer.porter`; what comes next waits in the system's queue for viser.
"""

from __future__ import annotations

import asyncio
import contextlib
import functools
import gzip
import hmac
import http
import importlib.util
import io
import secrets
import socket
import threading
from collections.abc import Callable, Mapping
from http.cookies import CookieError, SimpleCookie
from typing import Any
from urllib.parse import parse_qs, unquote, urlsplit

from ode_sim.errors import Unavailable

from ode_sim_viewer.porter import Porter, entitled

#: Beside the 11345 of Gazebo's own master; the next free one is taken where it is in use.
DEFAULT_PORT = 11346
#: Names of this machine for itself.
LOOPBACK = ("localhost", "127.0.0.1", "::1")
_TRIES = 100
_WAITING = 64  # connections that the system keeps until the server looks at them
LINKED = "/link/"  # before the name of a link
_starting = threading.Lock()
#: Host of the request -> status, headers, text.
Link = Callable[[str], tuple[http.HTTPStatus, dict[str, str], str]]


class Guard:
    """Decides about each request before anything else sees it.

    :param token: that a request must show ('' = none is needed)
    :param loopback: only this machine is answered; by default where there is no token
    """

    def __init__(self, token: str = "", loopback: bool | None = None):
        self.token = token
        self._loopback = not token if loopback is None else loopback
        self._cookie = f"viewer_{secrets.token_hex(4)}"  # of its own for each server on this host

    def refuse(self, path: str, headers: Mapping[str, str]) -> tuple | None:
        """None, or (status, headers, text) to answer a request for ``path`` with.

        :param headers: a mapping, as of websockets
        """
        host = headers.get("Host", "")
        if self._loopback and urlsplit(f"//{host}").hostname not in LOOPBACK:
            return self._no("this page is for this machine only; start it with --listen for others")
        origin = headers.get("Origin")
        if origin is not None and urlsplit(origin).netloc != host:
            return self._no("a page of another site may not use this one")
        if not self.token:
            return None
        shown = parse_qs(urlsplit(path).query).get("token", [""])[0]
        if shown and hmac.compare_digest(shown.encode(), self.token.encode()):
            cookie = f"{self._cookie}={self.token}; HttpOnly; SameSite=Lax; Path=/"  # Strict: not after the file that opens it
            return http.HTTPStatus.SEE_OTHER, {"Location": "/", "Set-Cookie": cookie}, ""
        if hmac.compare_digest(self._kept(headers.get("Cookie", "")).encode(), self.token.encode()):
            return None
        return self._no("open this page with the address that the terminal printed; it ends in ?token=...")

    def _kept(self, cookies: str) -> str:
        try:
            kept = SimpleCookie(cookies).get(self._cookie)
        except CookieError:
            return ""
        return kept.value if kept else ""

    @staticmethod
    def _no(reason: str) -> tuple:
        return http.HTTPStatus.FORBIDDEN, {"Content-Type": "text/plain; charset=utf-8"}, reason + "\n"


class Website:
    """Holds a port from now on, and serves one page on it from :meth:`open` to :meth:`close`.

    :ivar viser: the ViserServer; None before :meth:`open`
    :param listen: to other machines, with a token
    :param token: also on this machine
    :param title: of the browser's window
    :param links: entries of the menu *Window* that open a page of their own, and what answers it, in a thread of its own
    :raises Unavailable: viser is not installed, or no port is free
    """

    def __init__(
        self,
        port: int = DEFAULT_PORT,
        listen: bool = False,
        title: str = "Gazebo",
        token: bool = False,
        links: Mapping[str, Link] | None = None,
    ):
        if importlib.util.find_spec("viser") is None:
            raise Unavailable("the page needs the Python package viser; scripts/setup installs it")
        self.guard = Guard(secrets.token_urlsafe(16) if listen or token else "", loopback=not listen)
        self.viser: Any = None
        self.links = dict(links or {})
        self._door = _take_port(port, listen)
        self.port = self._door.getsockname()[1]
        self._listen = listen
        self._title = title
        self._porter = Porter(self._door, self.guard.refuse, title)
        self._porter.start()

    @property
    def address(self) -> str:
        """What to type into a browser."""
        host = socket.gethostname() if self._listen else "localhost"
        return f"http://{host}:{self.port}/{self._shown}"

    @property
    def local_address(self) -> str:
        """The same on this machine."""
        return f"http://localhost:{self.port}/{self._shown}"

    @property
    def _shown(self) -> str:
        return f"?token={self.guard.token}" if self.guard.token else ""

    def knocked(self, seconds: float) -> bool:
        """Whether a browser has come to the door, within ``seconds``."""
        return self._porter.knocked.wait(seconds)

    def open(self) -> Any:
        """Start to answer; the ViserServer.

        :raises Unavailable: what viser needs is not installed
        """
        if self.viser is None:
            try:
                import viser
            except ImportError as error:
                raise Unavailable(f"the page needs the Python package {error.name}; scripts/setup installs it") from error
            self._porter.leave()
            self.viser = _start(viser, self._door, self._reply, self._title)
            self._withdraw_sharing()
        return self.viser

    def close(self) -> None:
        if self.viser is not None:
            with contextlib.redirect_stdout(io.StringIO()):  # viser says goodbye there
                self.viser.stop()
            self.viser = None
        self._porter.leave()
        self._door.close()

    def _reply(self, path: str, headers: Mapping[str, str]) -> tuple | Callable[[], tuple] | None:
        """What answers instead of the page, at once or when it is called; None: the page does."""
        link = self.links.get(unquote(urlsplit(path).path.partition(LINKED)[2]))
        refused = self.guard.refuse(path, headers)
        if refused is not None or link is None:
            return refused
        return functools.partial(link, urlsplit(f"//{headers.get('Host', '')}").hostname or "")

    def _withdraw_sharing(self) -> None:
        """A page may ask viser for a tunnel through a server in the internet; not here."""
        from viser import _messages

        for message in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
            self.viser._websock_server.unregister_handler(message)


def _entitled(response: Any, title: str) -> Any:
    if response is not None and response.headers.get("Content-Type", "").startswith("text/html"):
        packed = response.headers.get("Content-Encoding") == "gzip"
        body = gzip.decompress(response.body) if packed else response.body
        body = entitled(body, title)
        response.body = gzip.compress(body, 1) if packed else body
        del response.headers["Content-Length"]
        response.headers["Content-Length"] = str(len(response.body))
    return response


def _take_port(port: int, listen: bool) -> socket.socket:
    """The first free one from ``port`` (any, if it is 0), listened on."""
    for candidate in range(port, min(port + _TRIES, 65536)) if port else (0,):
        door = socket.socket()
        door.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            door.bind(("0.0.0.0" if listen else "127.0.0.1", candidate))
            door.listen(_WAITING)
            return door
        except OSError:
            door.close()
    raise Unavailable(f"no port from {port} to {port + _TRIES - 1} is free; choose another one with --port")


def _start(viser: Any, door: socket.socket, reply: Callable, title: str) -> Any:
    """A viser server on ``door`` whose requests ``reply`` sees first; viser has no place for either, so its call of
    ``serve`` is."""
    import rich
    import websockets.asyncio.server

    library: Any = websockets.asyncio.server
    console: Any = rich

    usual = library.serve

    def serve(handler: Any, host: str, port: int, process_request: Any = None, **options: Any) -> Any:
        async def guarded(connection: Any, request: Any) -> Any:
            answer = reply(request.path, request.headers)
            if answer is None:
                return _entitled(process_request(connection, request), title)
            status, headers, text = await asyncio.to_thread(answer) if callable(answer) else answer
            response = connection.respond(status, text)
            for name, value in headers.items():
                response.headers[name] = value
            return response

        return usual(handler, sock=door, process_request=guarded, **options)

    with _starting, contextlib.redirect_stdout(io.StringIO()):
        # viser draws a frame round an address that is not ours: not loaded, not drawn
        library.serve, write, console.print = serve, console.print, lambda *_, **__: None
        try:
            return viser.ViserServer(host="127.0.0.1", port=0, verbose=False)
        finally:
            library.serve, console.print = usual, write
