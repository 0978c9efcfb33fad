"""Hands the page out while the web server that it will talk to is still being loaded.

A browser needs a second to unpack and start the page, viser needs a second of imports: they happen side by side. The porter
answers the first request for the page, then leaves the door: what knocks next waits in the system's queue for the server.
"""

from __future__ import annotations

import contextlib
import functools
import gzip
import html
import http
import importlib.util
import os
import pathlib
import select
import socket
import threading
import time
from collections.abc import Callable
from typing import Any

_LONGEST = 65536  # bytes of a request's head
_PATIENCE = 5.0  # wall s that a browser may take to send it, or to read the answer

#: Until the controls are there the page draws when something has come from the server, and seldom else: what is seen then is empty,
#: and costs a second where the processor draws. There it makes no more than 15 pictures a second later: it has a simulation to compute.
#: A replay has no controls, and begins with its first picture.
_SPARING = b"""<script>(() => {
  const draw = window.requestAnimationFrame.bind(window);
  let waiting = new Map(), drawn = waiting, last = 0, number = 0, timer = 0, due = 0, gap = 1000, loading = true;
  const all = time => {
    drawn = waiting, waiting = new Map(), due = 0, last = performance.now();
    for (const f of drawn.values()) try { f(time); } catch (error) { reportError(error); }
  };
  const arm = rest => {
    const when = performance.now() + rest;
    if (due && due <= when) return;
    clearTimeout(timer);
    due = when, timer = rest > 4 ? setTimeout(() => draw(all), rest) : draw(all) && 0;
  };
  window.requestAnimationFrame = f => { waiting.set(++number, f); arm(last + gap - performance.now()); return number; };
  window.cancelAnimationFrame = key => { waiting.delete(key) || drawn.delete(key); };  // the numbers are ours, not the browser's
  const Usual = window.Worker;
  window.Worker = class extends Usual {
    constructor(...what) { super(...what); this.addEventListener("message", () => loading && waiting.size && arm(30)); }
  };
  const look = setInterval(() => {
    const canvas = document.querySelector("canvas[data-engine]") ?? document.querySelector("canvas");
    if (!document.querySelector('[role="tab"]') && !(window.__VISER_EMBED_DATA__ && canvas)) return;
    clearInterval(look);
    const gl = canvas?.getContext("webgl2");
    const told = gl && gl.getExtension("WEBGL_debug_renderer_info");
    const name = told ? gl.getParameter(told.UNMASKED_RENDERER_WEBGL) : "";
    const software = /swiftshader|llvmpipe|softpipe|software/i.test(name);
    loading = false, gap = software ? 66 : 0;
    if (software) document.documentElement.dataset.drawn = "drawn by the processor";
    if (waiting.size) arm(0);
  }, 100);
})();</script>"""

#: What decides about a request: ``refuse(path, headers)``, None or (status, headers, text).
Refuse = Callable[[str, "Headers"], tuple | None]


class Headers(dict[str, str]):
    """Of a request; names in any case."""

    def get(self, name: str, default: Any = None) -> Any:
        """The header ``name``, in any case, or ``default``."""
        return super().get(name.lower(), default)


def page_of_viser(title: str) -> bytes | None:
    """Its HTML under another title; None where it is not found. Does not import viser."""
    found = importlib.util.find_spec("viser")
    for folder in found.submodule_search_locations or () if found else ():
        with contextlib.suppress(OSError), open(os.path.join(folder, "client", "build", "index.html"), "rb") as file:
            return entitled(file.read(), title)
    return None


#: viser's page unpacks its program with this line; what follows is done to the program there.
_UNPACKED = b"const code=td.decode(heap.subarray(up+ss,up+sz))"
#: Until the server has told otherwise that program lights the scene by a picture, which takes the processor 0.4 s to prepare; here the
#: server always tells otherwise.
_UNLIT = rb""".replace(/===null\?[\w$]+:([\w$]+\.hdri_data)/,"===null?null:$1")"""
#: It makes a canvas of its own to find out whether the processor draws, which takes that 0.2 s and more: later is soon enough to say so,
#: and the canvas of the scene knows it as well.
_ASKED_LATER = (
    rb""".replace(/let ([\w$]+)=([\w$]+)\(\);(console\.log\(`WebGL support[^]*?`webgl-software-rendering`[^]*?`orange`\}\))"""
    rb"""(?=\},\[\]\))/,"setTimeout(()=>{let $1=$2();$3},5e3)")"""
    rb""".replace(/=document\.createElement\(`canvas`\)(?=,[\w$]+=!1,[\w$]+=`unknown`)/,"""
    rb""""=document.querySelector('canvas[data-engine]')??document.createElement('canvas')")"""
)
#: What is typed and pressed goes to the server at most every 50 ms, the last of it only: a button pressed right after a field was filled
#: took the place of the field's value, which was lost. What concerns something else is sent first, and so is a
#: second press of the same button, which a page that is slow to draw hears together with the first.
_NOTHING_LOST = (
    rb""".replace(/([\w$]+)\.sendMessage!==null&&\(([\w$]+)=([\w$]+),([\w$]+)\?\(\1\.sendMessage\(\3\),([\w$]+)=!1/,"""
    rb""""$1.sendMessage!==null&&($5&&$2&&($2.type!==$3.type||$2.uuid!==$3.uuid||$2.name!==$3.name"""
    rb"""||$2!==$3&&JSON.stringify($2)===JSON.stringify($3))&&($1.sendMessage($2),$5=!1),$2=$3,$4?($1.sendMessage($3),$5=!1")"""
)
#: Handles that are drawn through everything are gripped so, too: what is hit of them is hit first. Some are gripped by a part that is not
#: drawn at all, in a group that stands where it is put.
_ON_TOP = (
    rb""".replace(/\.sort\(\(([\w$]+),([\w$]+)\)=>\{(?=let [\w$]+=[\w$]+\(\1\.object\),)/,"""
    rb"""".sort(($1,$2)=>{let grip=o=>o.material?.depthTest===!1||!o.visible&&o.parent?.matrixAutoUpdate===!1?1:0,"""
    rb"""first=grip($2.object)-grip($1.object);if(first)return first;")"""
)
#: A colour that was typed as rgb(...) and left by Enter was taken back: the field puts in what was right a moment before, as if it had been
#: typed. What is no colour gives way to the colour that is, and nothing else.
_COLOUR_AS_TYPED = (
    rb""".replace(/&&([\w$]+\([\w$]+\([\w$]+\)\))\},\[([\w$]+)\]\),([^]{1,700}?)onBlur:\(\)=>"""
    rb"""\{let ([\w$]+)=([\w$]+\([\w$]+\));\4&&!([\w$]+\(\4,[\w$]+\))&&([\w$]+\([\w$]+,\4\))\}/,"""
    rb""""&&$1},[$2]),$3fixOnBlur:!1,onBlur:()=>{let $4=$5;$4?$6||$7:$1}")"""
)


@functools.lru_cache(maxsize=1)
def _frame() -> bytes:
    """The tools above the page, the state below it, and what is shown while it loads."""
    folder = pathlib.Path(__file__).parent / "frame"
    return b"<style>%s</style><script>%s</script>" % tuple((folder / f"frame.{ending}").read_bytes() for ending in ("css", "js"))


def entitled(page: bytes, title: str, framed: bool = True) -> bytes:
    """viser's ``page`` with ``title`` for its own, sparing where it draws.

    :param framed: with tools and state round it; a recorded page has no controls for them
    """
    head = f"<title>{html.escape(title)}</title>".encode() + _SPARING + (_frame() if framed else b"")
    changes = _UNLIT + _ASKED_LATER + _NOTHING_LOST + _ON_TOP + _COLOUR_AS_TYPED
    return page.replace(_UNPACKED, _UNPACKED + changes, 1).replace(b"<title>Viser</title>", head, 1)


class Porter(threading.Thread):
    """At the door from :meth:`start` until the page has been given to somebody, or :meth:`leave`.

    :param door: listened on
    :ivar knocked: set when a browser was there
    """

    def __init__(self, door: socket.socket, refuse: Refuse, title: str):
        super().__init__(name="porter", daemon=True)
        self.knocked = threading.Event()
        self._door, self._refuse, self._title = door, refuse, title
        self._bell, self._ring = socket.socketpair()
        self._begun: dict[socket.socket, bytes] = {}  # requests of which a part has come
        self._since: dict[socket.socket, float] = {}

    def leave(self) -> None:
        """Returns when it is gone; what has not been answered is hung up on, browsers then try again."""
        with contextlib.suppress(OSError):
            self._ring.send(b".")
        if self.is_alive():
            self.join()

    def run(self) -> None:
        try:
            while not self._served():
                pass
        finally:
            for connection in list(self._begun):
                self._drop(connection)
            self.knocked.set()
            self._bell.close()
            self._ring.close()

    def _served(self) -> bool:
        """Answer what comes next; whether the porter is to go."""
        ready, _, _ = select.select([self._door, self._bell, *self._begun], [], [], _PATIENCE)
        if self._bell in ready:
            return True
        for late in [c for c, since in self._since.items() if time.monotonic() > since + _PATIENCE]:
            self._drop(late)
        for connection in ready:
            if connection is self._door:
                with contextlib.suppress(OSError):
                    new, _ = self._door.accept()
                    new.settimeout(_PATIENCE)
                    self._begun[new], self._since[new] = b"", time.monotonic()
            elif connection in self._begun and self._read(connection):
                return True
        return False

    def _read(self, connection: socket.socket) -> bool:
        """More of a request; whether the page was given away."""
        try:
            more = connection.recv(_LONGEST)
        except OSError:
            more = b""
        self._begun[connection] += more
        if b"\r\n\r\n" not in self._begun[connection] and more and len(self._begun[connection]) < _LONGEST:
            return False
        self.knocked.set()
        given = False
        with contextlib.suppress(OSError, ValueError):  # it went away, or is no browser
            given = bool(more) and self._answer(connection, self._begun[connection])
        self._drop(connection)
        return given

    def _answer(self, connection: socket.socket, request: bytes) -> bool:
        first, *rest = request.split(b"\r\n\r\n", 1)[0].decode("latin-1").split("\r\n")
        method, path, _ = first.split(" ", 2)
        headers = Headers((name.strip().lower(), value.strip()) for name, _, value in (line.partition(":") for line in rest))
        refused = self._refuse(path, headers)
        if refused is not None:
            status, more, text = refused
            self._send(connection, status, more, text.encode())
            return False
        page = page_of_viser(self._title) if method == "GET" and path.partition("?")[0] == "/" and not headers.get("Upgrade") else None
        if page is None:  # a page of before that looks whether the server is back: it asks again
            self._send(connection, http.HTTPStatus.SERVICE_UNAVAILABLE, {"Retry-After": "1"}, b"")
            return False
        more = {"Content-Type": "text/html; charset=utf-8"}
        if "gzip" in headers.get("Accept-Encoding", "") and connection.getpeername()[0] != "127.0.0.1":
            more["Content-Encoding"], page = "gzip", gzip.compress(page, 1)
        self._send(connection, http.HTTPStatus.OK, more, page)
        return True

    @staticmethod
    def _send(connection: socket.socket, status: http.HTTPStatus, headers: dict[str, str], body: bytes) -> None:
        lines = [
            f"HTTP/1.1 {status.value} {status.phrase}",
            *(f"{name}: {value}" for name, value in headers.items()),
            f"Content-Length: {len(body)}",
            "Connection: close",
            "",
            "",
        ]
        connection.sendall("\r\n".join(lines).encode("latin-1") + body)

    def _drop(self, connection: socket.socket) -> None:
        del self._begun[connection], self._since[connection]
        with contextlib.suppress(OSError):
            connection.shutdown(socket.SHUT_WR)
        connection.close()
