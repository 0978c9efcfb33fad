"""The web server of the page, and who may open it.

By default it answers on the loopback interface only, to pages that come from itself. With ``listen`` it answers to
every machine that shows the token, which is part of the address that is printed once.
"""
from __future__ import annotations

import contextlib
import hmac
import http
import io
import secrets
import socket
import threading
from http.cookies import CookieError, SimpleCookie
from typing import Optional
from urllib.parse import parse_qs, urlsplit

#: Beside the 11345 of Gazebo's own master; the next free one is taken where it is in use.
DEFAULT_PORT = 11346
_LOOPBACK = ("localhost", "127.0.0.1", "::1")
_TRIES = 100
_starting = threading.Lock()


class Unavailable(RuntimeError):
    """The page cannot be served; one line that says what to do."""


class Guard:
    """Decides about each request before anything else sees it.

    :param token: that a request must show ('' = none is needed, but the loopback interface is)
    """

    def __init__(self, token: str = ""):
        self.token = token
        self._cookie = f"viewer_{secrets.token_hex(4)}"  # of its own for each server on this host

    def refuse(self, path: str, headers) -> Optional[tuple]:
        """None, or (status, headers, text) to answer with.

        :param headers: a mapping, as of websockets
        """
        host = headers.get("Host", "")
        if not self.token and urlsplit(f"//{host}").hostname not in _LOOPBACK:
            return self._no("this page is for this machine only; start it with --listen for others")
        origin = headers.get("Origin")
        if origin is not None and urlsplit(origin).netloc != host:
            return self._no("a page of another site may not use this one")
        if not self.token:
            return None
        shown = parse_qs(urlsplit(path).query).get("token", [""])[0]
        if shown and hmac.compare_digest(shown.encode(), self.token.encode()):
            cookie = f"{self._cookie}={self.token}; HttpOnly; SameSite=Strict; Path=/"
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
    """Serves one page until :meth:`close`.

    :param listen: to other machines, with a token
    :raises Unavailable: viser is not installed, or no port is free
    """

    def __init__(self, port: int = DEFAULT_PORT, listen: bool = False):
        try:
            import viser
        except ImportError as error:
            raise Unavailable(f"the page needs the Python package {error.name}; scripts/setup installs it") from error
        self.guard = Guard(secrets.token_urlsafe(16) if listen else "")
        self.viser = _start(viser, "0.0.0.0" if listen else "127.0.0.1", _free_port(port, listen), self.guard)
        self._withdraw_sharing()
        self.port = self.viser.get_port()
        self._listen = listen

    @property
    def address(self) -> str:
        """What to type into a browser."""
        host = socket.gethostname() if self._listen else "localhost"
        return f"http://{host}:{self.port}/" + (f"?token={self.guard.token}" if self._listen else "")

    @property
    def local_address(self) -> str:
        """The same on this machine."""
        return f"http://localhost:{self.port}/" + (f"?token={self.guard.token}" if self._listen else "")

    def close(self) -> None:
        with contextlib.redirect_stdout(io.StringIO()):  # viser says goodbye there
            self.viser.stop()

    def _withdraw_sharing(self) -> None:
        """A page may ask viser for a tunnel through a server in the internet; not here."""
        from viser import _messages
        for message in (_messages.ShareUrlRequest, _messages.ShareUrlDisconnect):
            self.viser._websock_server.unregister_handler(message)


def _free_port(port: int, listen: bool) -> int:
    if port == 0:
        return 0
    for candidate in range(port, min(port + _TRIES, 65536)):
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(("0.0.0.0" if listen else "127.0.0.1", candidate))
                return candidate
            except OSError:
                continue
    raise Unavailable(f"no port from {port} to {port + _TRIES - 1} is free; choose another one with --port")


def _start(viser, host: str, port: int, guard: Guard):
    """A viser server whose requests pass ``guard`` first; viser has no place for one, so its call of ``serve`` is."""
    import websockets.asyncio.server as library

    usual = library.serve

    def serve(handler, *where, process_request=None, **options):
        def guarded(connection, request):
            refused = guard.refuse(request.path, request.headers)
            if refused is None:
                return process_request(connection, request)
            status, headers, text = refused
            response = connection.respond(status, text)
            for name, value in headers.items():
                response.headers[name] = value
            return response

        return usual(handler, *where, process_request=guarded, **options)

    with _starting, contextlib.redirect_stdout(io.StringIO()):  # where viser draws a frame round its address
        library.serve = serve
        try:
            return viser.ViserServer(host=host, port=port, verbose=False)
        finally:
            library.serve = usual
