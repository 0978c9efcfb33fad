"""``roslaunch foxglove_bridge lichtblick.launch``: Lichtblick's page from this machine, with a layout for what runs."""

from __future__ import annotations

import argparse
import functools
import gzip
import http.client
import http.server
import json
import os
import shutil
import sys
import tarfile
import threading
import urllib.request
import zlib
from collections.abc import Callable
from pathlib import Path, PurePosixPath
from typing import Any
from urllib.parse import quote, urlencode, urlsplit

import node_signals

from foxglove_bridge.layout import Running, layout
from foxglove_bridge.settings import TRIES, BridgeError

VERSION = "1.28.1"
ARCHIVE = f"https://github.com/lichtblick-suite/lichtblick/releases/download/v{VERSION}/lichtblick-web.tar.gz"
PORT = 8766  # the next after the bridge's; the first free one from there
_LOOPBACK = ("localhost", "127.0.0.1", "::1")


def folder() -> Path:
    """Where Lichtblick's page is kept: ``LICHTBLICK_PAGE``, else a folder of yours."""
    named = os.environ.get("LICHTBLICK_PAGE")
    data = os.environ.get("XDG_DATA_HOME") or str(Path.home() / ".local/share")
    return Path(named) if named else Path(data) / "noetic_labs" / "lichtblick"


def installed() -> bool:
    return (folder() / "index.html").is_file()


def install(source: str, say: Callable[[str], None]) -> None:
    """Unpack Lichtblick's page into :func:`folder`.

    :param source: an archive (.tar.gz) as Lichtblick's releases have it, as a file or an address
    :param say: is told a line before what takes long
    :raises BridgeError: it cannot be had, or is no such archive
    """
    place = folder()
    made = place.with_name(place.name + ".new")
    shutil.rmtree(made, ignore_errors=True)
    try:
        if urlsplit(source).scheme in ("http", "https"):
            say(f"fetching {source}")
            with urllib.request.urlopen(source, timeout=60) as stream:
                _unpack(stream, made)
        else:
            with open(source, "rb") as stream:
                _unpack(stream, made)
        if not (made / "index.html").is_file():
            raise BridgeError(f"{source} has no index.html: it should be lichtblick-web.tar.gz of one of Lichtblick's releases")
        shutil.rmtree(place, ignore_errors=True)
        made.rename(place)
    except (OSError, EOFError, tarfile.TarError, zlib.error, http.client.HTTPException) as error:
        raise BridgeError(
            f"{source}: {getattr(error, 'reason', None) or error}; another way: --install FILE, an archive fetched elsewhere"
        ) from error
    finally:
        shutil.rmtree(made, ignore_errors=True)


def _unpack(stream: Any, target: Path) -> None:
    """The plain files of an archive into ``target``, to its last byte, which has its sum; what would lie elsewhere is left out."""
    with gzip.GzipFile(fileobj=stream) as unzipped:
        with tarfile.open(fileobj=unzipped, mode="r|") as archive:
            for member in archive:
                path = PurePosixPath(member.name)
                content = archive.extractfile(member) if member.isfile() else None
                if content is None or path.is_absolute() or ".." in path.parts:
                    continue
                (target / path).parent.mkdir(parents=True, exist_ok=True)
                (target / path).write_bytes(content.read())
        while unzipped.read(1 << 20):
            pass


class _Handler(http.server.SimpleHTTPRequestHandler):
    """The files of the page; ``/`` alone, and a layout, come from what runs."""

    server: Page

    def do_GET(self) -> None:
        if urlsplit(f"//{self.headers.get('Host', '')}").hostname not in _LOOPBACK:  # a name of another's that leads here
            self.send_error(403, "this page is for this machine only")
            return
        path, _, query = self.path.partition("?")
        if path == "/" and not query:
            self.send_response(302)
            self.send_header("Location", self.server.start())
            self.send_header("Content-Length", "0")
            self.end_headers()
        elif path.startswith("/layout/"):
            self._answer(json.dumps(layout(self.server.running())).encode(), "application/json")
        else:
            super().do_GET()

    def _answer(self, body: bytes, kind: str) -> None:
        self.send_response(200)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Cache-Control", "no-store")
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        """Nothing: the terminal is the user's."""


class Page(http.server.ThreadingHTTPServer):
    """Serves on the loopback interface.

    :param port: the first to try
    :param bridge: port of the bridge that the page connects to
    :param running: tells what there is, each time that a layout is asked for
    :raises BridgeError: no port is free
    """

    daemon_threads = True

    def __init__(self, port: int, bridge: int, running: Callable[[], Running]) -> None:
        self.bridge, self.running = bridge, running
        for candidate in range(port, port + TRIES) if port else (0,):
            try:
                super().__init__(("127.0.0.1", candidate), functools.partial(_Handler, directory=str(folder())))
                return
            except OSError:
                continue
        raise BridgeError(f"no port from {port} to {port + TRIES - 1} is free; choose another one with --port")

    @property
    def address(self) -> str:
        return f"http://localhost:{self.server_address[1]}/"

    def start(self) -> str:
        """The page's address with the connection and the layout in it; ``openIn`` spares the question after a desktop's program."""
        name = quote(self.running().name, safe="")
        words = {
            "ds": "foxglove-websocket",
            "ds.url": f"ws://localhost:{self.bridge}",
            "layoutUrl": f"{self.address}layout/{name}.json",
            "openIn": "web",
        }
        return "/?" + urlencode(words)


def main(arguments: list[str]) -> int:
    """Exit code: 0 it was ended, 1 there is no page, or no port."""
    parser = argparse.ArgumentParser(
        prog="lichtblick", description="Plots and topics of what runs, in the browser: Lichtblick and a bridge to it."
    )
    parser.add_argument("--port", type=int, default=PORT, help=f"of the page; the next free one from here ({PORT})")
    parser.add_argument("--bridge", type=int, metavar="PORT", help="of one that runs; else that of this master, or one of its own")
    parser.add_argument("--install", nargs="?", const=ARCHIVE, metavar="ARCHIVE", help=f"fetch the page once, from {ARCHIVE} or a file")
    options = parser.parse_args([word for word in arguments if ":=" not in word])
    try:
        if options.install:
            install(options.install, _say)
            _say(f"the page is in {folder()}")
            return 0
        if not installed():
            raise BridgeError(f"Lichtblick's page is not in {folder()}: rosrun foxglove_bridge lichtblick --install fetches it once")
        return _serve(options.port, options.bridge)
    except BridgeError as error:
        _say(str(error))
        return 1


def _serve(port: int, told: int | None) -> int:
    import rospy

    from foxglove_bridge.facts import Facts
    from foxglove_bridge.node import follow, own_or_running

    node_signals.init_node("lichtblick", anonymous=True, disable_rostime=True)
    bridge_port, bridge = (told, None) if told else own_or_running()
    page = Page(port, bridge_port, Facts().running)
    print(f"lichtblick: plots and topics are at {page.address}", flush=True)
    stop = threading.Event()
    rospy.on_shutdown(stop.set)
    rospy.on_shutdown(page.shutdown)
    threading.Thread(target=page.serve_forever, daemon=True).start()
    if bridge is None:
        stop.wait()
    else:
        follow(bridge, stop)
    return 0


def _say(line: str) -> None:
    print(f"lichtblick: {line}", file=sys.stderr, flush=True)
