"""A private X server with a window manager, and programs on it that are used as a person does.

::

    from rqt_testing.desktop import Desktop

    with Desktop() as desktop:                             # Xvfb and openbox; nothing is seen on the real screen
        rqt = desktop.run(["rqt", "--standalone", "rqt_my_plugin"])
        rqt.window("My Plugin")                            # waits for a window whose title has this in it
        rqt.click("topic_edit")                            # by objectName, a real click of the mouse there
        desktop.keys("ctrl+a"); desktop.type("/other\\n")
        rqt.choose("Plugins", "Topics", "My Plugin")       # a way through menus, by real clicks
        assert rqt.text("topic_edit") == "/other"
        desktop.screenshot("/tmp/x.png")
        assert rqt.end() == 0                              # Ctrl-C; the exit code
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import ExitStack
from typing import Any

from rviz_offscreen.display import private_display

_TIMEOUT = 60.0  # s for anything to appear, on a machine that does other things too


class Desktop:
    """The X server lives as long as the ``with`` block, and ends with the programs that :meth:`run` started on it.

    :param size: of the screen, WIDTHxHEIGHTxDEPTH in pixels and bits
    """

    def __init__(self, size: str = "1280x800x24"):
        self._size = size
        self._stack = ExitStack()
        self._programs: list[Program] = []
        self.environment: dict[str, str] = {}

    def __enter__(self) -> Desktop:
        self.home = self._stack.enter_context(tempfile.TemporaryDirectory(prefix="desktop_"))
        variables = self._stack.enter_context(private_display(self._size))
        os.mkdir(os.path.join(self.home, "run"), 0o700)
        self.environment = {
            **os.environ,
            **variables,
            "XDG_CONFIG_HOME": os.path.join(self.home, "config"),
            "XDG_RUNTIME_DIR": os.path.join(self.home, "run"),
            "HOME": self.home,
            "NO_AT_BRIDGE": "1",
            "ROS_HOME": os.environ.get("ROS_HOME", os.path.join(self.home, "ros")),
        }
        for name in ("QT_QPA_PLATFORM", "WAYLAND_DISPLAY", "SESSION_MANAGER", "DBUS_SESSION_BUS_ADDRESS"):
            self.environment.pop(name, None)
        manager = subprocess.Popen(
            ["openbox", "--config-file", self._openbox_settings()],
            env=self.environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        self._stack.callback(_end, manager)
        self._wait(
            lambda: (
                b"_NET_SUPPORTING_WM_CHECK(WINDOW)"
                in subprocess.run(["xprop", "-root", "_NET_SUPPORTING_WM_CHECK"], env=self.environment, capture_output=True).stdout
            ),
            "window manager",
        )
        return self

    def __exit__(self, *_):
        for program in self._programs:
            program.kill()
        self._stack.close()

    def _openbox_settings(self) -> str:
        """No menus of its own, so that every click reaches the program."""
        path = os.path.join(self.home, "openbox.xml")
        with open(path, "w") as file:
            file.write(
                '<openbox_config xmlns="http://openbox.org/3.4/rc"><focus><focusNew>yes</focusNew></focus>'
                '<mouse><context name="Titlebar"><mousebind button="Left" action="Drag"><action name="Move"/></mousebind>'
                '</context><context name="Close"><mousebind button="Left" action="Click"><action name="Close"/></mousebind>'
                '</context><context name="Client"><mousebind button="Left" action="Press"><action name="Focus"/>'
                '<action name="Raise"/></mousebind></context></mouse></openbox_config>'
            )
        return path

    def run(self, command: list[str], **variables: str) -> Program:
        """Start one of our commands (found on PATH, or ``rosrun``'s way: ``["rosrun", package, script]``)."""
        if command[0] == "rosrun":
            found = subprocess.run(
                ["catkin_find", "--first-only", "--libexec", command[1], command[2]], capture_output=True, text=True
            ).stdout.strip()
            command = [found or command[2], *command[3:]]
        script = shutil.which(command[0])
        if script is None:
            raise FileNotFoundError(f"no command {command[0]}")
        program = Program(self, [script, *command[1:]], {**self.environment, **variables})
        self._programs.append(program)
        return program

    def xdotool(self, *arguments) -> str:
        return subprocess.run(["xdotool", *map(str, arguments)], env=self.environment, check=True, capture_output=True, text=True).stdout

    def click_at(self, x: int, y: int, button: int = 1, times: int = 1) -> None:
        """Click at the pixel (x, y) of the screen, ``times`` times; ``button``: 1 left, 2 middle, 3 right, 4 and 5 the wheel."""
        self.xdotool("mousemove", "--sync", x, y)
        self.xdotool("click", "--repeat", times, "--delay", 60, button)

    def drag(self, start: tuple[int, int], end: tuple[int, int], button: int = 1) -> None:
        """Press ``button`` (1: left) at ``start``, move in some steps, let go at ``end``: pixels of the screen."""
        self.xdotool("mousemove", "--sync", *start, "mousedown", button)
        for step in range(1, 9):
            self.xdotool("mousemove", "--sync", *(round(a + (b - a) * step / 8) for a, b in zip(start, end)))
        self.xdotool("mouseup", button)

    def keys(self, *names: str) -> None:
        """Press keys or combinations: ``"ctrl+a"``, ``"Return"``."""
        self.xdotool("key", "--clearmodifiers", *names)

    def type(self, text: str) -> None:
        """Type a text into what has the focus; a line feed presses Return."""
        for index, line in enumerate(text.split("\n")):
            if index:
                self.keys("Return")  # xdotool types a line feed as a key that Qt does not take for one
            if line:
                self.xdotool("type", "--clearmodifiers", "--delay", "8", "--", line)

    def screenshot(self, path: str) -> None:
        """The whole screen as PNG, by a program of its own, as no widget would draw itself otherwise than it is seen."""
        subprocess.run(
            [
                sys.executable,
                "-c",
                "import sys\nfrom python_qt_binding.QtWidgets import QApplication\n"
                "app = QApplication([])\nscreen = app.primaryScreen()\n"
                "screen.grabWindow(0).save(sys.argv[1])",
                path,
            ],
            env=self.environment,
            check=True,
            capture_output=True,
        )

    def _wait(self, condition, what: str, timeout: float = _TIMEOUT):
        end = time.monotonic() + timeout
        while True:
            value = condition()
            if value:
                return value
            if time.monotonic() > end:
                raise AssertionError(f"no {what} within {timeout} s")
            time.sleep(0.03)


class Program:
    """A running command; ``output()`` is what it has printed so far."""

    def __init__(self, desktop: Desktop, command: list[str], environment: dict[str, str]):
        self._desktop = desktop
        number = len(desktop._programs)
        self._socket = os.path.join(desktop.home, f"{number}.socket")
        self._log = os.path.join(desktop.home, f"{number}.log")
        with open(self._log, "wb") as log:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "rqt_testing.driven", self._socket, *command],
                env=environment,
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def output(self) -> str:
        with open(self._log, errors="replace") as log:
            return log.read()

    def ask(self, what: str, name: str = ""):
        """One question, ``what``, about the thing called ``name``, to the program; None when it has no answer yet."""
        if self.process.poll() is not None:
            raise AssertionError(f"the program has ended with {self.process.returncode}:\n{self.output()}")
        try:
            with socket.socket(socket.AF_UNIX) as connection:
                connection.settimeout(15)
                connection.connect(self._socket)
                with connection.makefile("rw") as stream:
                    stream.write(json.dumps({"what": what, "name": name}) + "\n")
                    stream.flush()
                    answer = json.loads(stream.readline() or "null")
        except (OSError, ValueError):
            return None
        return None if isinstance(answer, dict) and "error" in answer else answer

    def window(self, title: str = "", timeout: float = _TIMEOUT) -> list:
        """Wait for a window of this program with ``title`` in its title, in its place and with the focus of the keyboard on the
        program: [title, class, x, y, width, height].

        :param timeout: s
        """
        return self._wait(lambda: next((w for w in self.ask("windows") or [] if title in w[0]), None), f"window '{title}'", timeout)

    def rect(self, name: str) -> tuple[int, int, int, int]:
        """Where the visible widget of that ``objectName`` is: x, y, width, height in pixels of the screen."""
        return self._wait(lambda: self.ask("rect", name), f"widget {name}")

    def text(self, name: str) -> str:
        """What the widget of that ``objectName`` says, as soon as it is seen."""
        return self._wait(lambda: [text for text in [self.ask("text", name)] if text is not None], f"widget {name}")[0]

    def click(self, name: str, button: int = 1, times: int = 1, at: tuple[float, float] | None = None) -> None:
        """Click on the widget of which ``name`` is the ``objectName``, in its middle or ``at`` a fraction of its width and height.

        :param button: 1 left, 2 middle, 3 right
        :param times: 2 for a double click
        """
        self._click(lambda: self.ask("rect", name), f"widget {name}", button, times, at)

    def click_text(self, text: str, button: int = 1, times: int = 1) -> None:
        """Click on a menu entry, tab, row, button or label that says ``text``; ``button`` and ``times`` as of :meth:`click`."""
        self._click(lambda: self.ask("entry", text), f"'{text}'", button, times, None)

    def choose(self, *texts: str) -> None:
        """Click through menus."""
        for text in texts:
            self.click_text(text)

    def _click(self, find, what, button, times, at) -> None:
        """Click when the thing has come to rest: windows are moved by their manager, menus unfold."""
        seen: list[Any] = [None, None]  # rectangles: the last but one, the last

        def resting():
            seen[:] = seen[1], find()
            return seen[1] is not None and seen[0] == seen[1]

        self._wait(resting, what)
        x, y, width, height = seen[1]
        right, down = at or (0.5, 0.5)
        self._desktop.click_at(round(x + right * width), round(y + down * height), button, times)

    def wait(self, condition, what: str = "that", timeout: float = _TIMEOUT):
        """Wait until ``condition()`` is true; what it returned.

        :param what: names it in the error
        :param timeout: s
        """
        return self._wait(condition, what, timeout)

    def _wait(self, condition, what, timeout=_TIMEOUT):
        try:
            return self._desktop._wait(condition, what, timeout)
        except AssertionError as error:
            raise AssertionError(
                f"{error}; visible: {self.ask('windows')}, {self.ask('names')}; printed: {self.output()[-2000:]}"
            ) from None

    def end(self, number: int = signal.SIGINT, timeout: float = _TIMEOUT) -> int:
        """Send the signal ``number`` and wait for the end, ``timeout`` s at most; the exit code."""
        self.process.send_signal(number)
        return self.process.wait(timeout)

    def kill(self) -> None:
        _end(self.process, group=True)


def _end(process, group=False) -> None:
    if process.poll() is None:
        (os.killpg if group else os.kill)(process.pid, signal.SIGTERM)
        try:
            process.wait(5)
        except subprocess.TimeoutExpired:
            (os.killpg if group else os.kill)(process.pid, signal.SIGKILL)
            process.wait()
