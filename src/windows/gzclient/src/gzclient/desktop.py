"""A window of the desktop that shows the page: a browser of the system, without its bars."""

from __future__ import annotations

import html
import os
import shutil
import signal
import subprocess
import tempfile

from node_signals.children import end_with_parent

#: Those that show one page in a window of its own, in the order of preference.
_APPS = ("chromium", "chromium-browser", "google-chrome", "microsoft-edge", "brave-browser")
_OTHERS = ("firefox-esr", "firefox", "xdg-open")
_PATIENCE = 3.0  # s for the window to close by itself


def available() -> bool:
    """There is a display to open a window on."""
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def command(address: str, profile: str) -> list[str] | None:
    """What to run to show the page at ``address``, a URL; None where there is no browser.

    :param profile: folder of its own, so that the window is a process of its own
    """
    for name in _APPS:
        program = shutil.which(name)
        if program:
            return [
                program,
                f"--app={address}",
                f"--user-data-dir={profile}",
                "--no-first-run",
                "--no-default-browser-check",
                "--disable-background-networking",
                "--disable-component-update",
                "--disable-sync",
                "--class=gzclient",
                "--window-size=1280,800",
                "--enable-unsafe-swiftshader",
                # as root it does not run in its sandbox; the second takes the bar away that says so
                *(["--no-sandbox", "--test-type"] if os.geteuid() == 0 else []),
            ]
    for name in _OTHERS:
        program = shutil.which(name)
        if program:
            return [program, address] if name == "xdg-open" else [program, "--no-remote", "--profile", profile, address]
    return None


def _door(folder: str, address: str) -> str:
    """Where the browser is sent: a file of this user's alone that leads to the address. Other users can read a command line, and the
    address holds what they must not have."""
    path = os.path.join(folder, "open.html")
    with open(path, "w", encoding="utf-8", opener=lambda name, flags: os.open(name, flags, 0o600)) as file:
        file.write(f'<!doctype html><meta http-equiv="refresh" content="0; url={html.escape(address)}">\n')
    return f"file://{path}"


class Window:
    """The browser with the page; a context manager.

    :ivar process: None where there is none that could be watched
    """

    def __init__(self, address: str):
        self._folder = tempfile.TemporaryDirectory(prefix="gzclient_", ignore_cleanup_errors=True)
        self.process: subprocess.Popen | None = None
        words = command(_door(self._folder.name, address), self._folder.name)
        if words is None:
            return
        process = subprocess.Popen(
            words,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
            preexec_fn=end_with_parent,
        )
        if not words[0].endswith("xdg-open"):  # which has gone while the window stays
            self.process = process

    @property
    def closed(self) -> bool:
        return self.process is not None and self.process.poll() is not None

    def close(self) -> None:
        if self.process is not None and self.process.poll() is None:
            for number in (signal.SIGTERM, signal.SIGKILL):
                try:
                    os.killpg(self.process.pid, number)
                    self.process.wait(_PATIENCE)
                    break
                except ProcessLookupError:
                    break
                except subprocess.TimeoutExpired:
                    continue
        self._folder.cleanup()
