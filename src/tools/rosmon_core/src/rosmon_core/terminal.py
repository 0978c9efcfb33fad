"""The terminal interface: output scrolls, keys and node boxes stay below it.

prompt_toolkit reads the keys and draws the block at the bottom; lines of nodes are collected and written above it
twenty times a second, so that a node that prints thousands of lines does not redraw the block thousands of times.
"""

from __future__ import annotations

import asyncio
import string
import sys

from prompt_toolkit.application import Application, run_in_terminal
from prompt_toolkit.input import create_input
from prompt_toolkit.key_binding import KeyBindings
from prompt_toolkit.layout import FormattedTextControl, HSplit, Layout, Window
from prompt_toolkit.output.vt100 import Vt100_Output
from prompt_toolkit.styles import Style

from rosmon_core import colors
from rosmon_core.debugger import debug
from rosmon_core.monitor import Monitor
from rosmon_core.plain import format_line
from rosmon_core.process import NodeProcess, State

KEYS = string.ascii_lowercase + string.ascii_uppercase + string.digits
_BOX = 13
_INTERVAL = 0.05  # s between two bursts of output
_STYLE = Style.from_dict(
    {
        "bar": "bg:ansiwhite fg:ansiblack",
        "bar.key": "bg:ansicyan fg:ansiblack",
        "idle": "",
        "running": "bg:ansigreen fg:ansiblack",
        "crashed": "bg:ansired fg:ansiwhite",
        "waiting": "bg:ansiyellow fg:ansiblack",
        "key": "reverse",
        "muted": "bg:ansiblue fg:ansiwhite",
        "chosen": "bold underline",
        "dim": "",
    }
)
_STATE_STYLE = {State.IDLE: "class:idle", State.RUNNING: "class:running", State.CRASHED: "class:crashed", State.WAITING: "class:waiting"}
_GLOBAL_KEYS = (
    ("A-Z", "Node actions"),
    ("F6", "Start all"),
    ("F7", "Stop all"),
    ("F8", "WARN+ only"),
    ("F9", "Mute all"),
    ("F10", "Unmute all"),
    ("/", "Node search"),
)
_NODE_KEYS = (("s", "start"), ("k", "stop"), ("d", "debug"), ("m", "mute"), ("u", "unmute"))
_ACTIONS = {"s": "start", "k": "stop", "m": "mute", "u": "unmute"}

Fragments = list[tuple[str, str]]


class Terminal:
    """Shows a monitor and carries out keys. :meth:`show` may be called before :meth:`run`."""

    def __init__(self, labels, title: str | None) -> None:
        self._width = max(map(len, labels))
        self._count = len(labels) - 1
        self._colour = colors.mode()
        self._lines: list[tuple[str, str, str, int | None]] = []
        self._running: Monitor | None = None
        self._selected: NodeProcess | None = None
        self._search: str | None = None
        self._match = 0
        self._output = Vt100_Output.from_pty(sys.stdout)
        self._output.enable_cpr = False  # not every terminal answers where its cursor is, and none needs to
        if title:
            self._output.set_title(title)
        self._application: Application = Application(
            Layout(HSplit([Window(FormattedTextControl(self._block), dont_extend_height=True, wrap_lines=True)])),
            key_bindings=self._bindings(),
            style=_STYLE,
            input=create_input(),
            output=self._output,
            erase_when_done=True,
            min_redraw_interval=_INTERVAL,
        )

    @property
    def _monitor(self) -> Monitor:
        assert self._running is not None  # nothing is drawn and no key is read before run()
        return self._running

    def show(self, label: str, text: str, level: str, index: int | None) -> None:
        """Show a line with the next ones: ``text`` of ``level`` by ``label``, node ``index`` (None: rosmon itself)."""
        self._lines.append((label, text, level, index))

    def flush(self) -> None:
        """Write what has been collected, once the application has ended."""
        for line in self._formatted():
            print(line)
        sys.stdout.flush()

    async def run(self, monitor: Monitor) -> None:
        """Until the monitor is done."""
        self._running = monitor
        monitor.changed.append(self._application.invalidate)
        writer = asyncio.ensure_future(self._write())
        ending = asyncio.ensure_future(self._end())
        try:
            await self._application.run_async(handle_sigint=False)
        finally:
            monitor.changed.remove(self._application.invalidate)
            for task in (writer, ending):
                task.cancel()
            self.flush()

    async def _end(self) -> None:
        await self._monitor.done.wait()
        self._application.exit()

    async def _write(self) -> None:
        while True:
            await asyncio.sleep(_INTERVAL)
            if self._lines:
                await run_in_terminal(self.flush)

    def _formatted(self) -> list[str]:
        lines, self._lines = self._lines, []
        columns = self._output.get_size().columns
        return [
            format_line(label, text, level, index, self._width, self._count, self._colour, columns) for label, text, level, index in lines
        ]

    def _matches(self) -> list[NodeProcess]:
        return [n for n in self._monitor.nodes if (self._search or "") in self._monitor.label(n)]

    # what is drawn

    def _block(self) -> Fragments:
        if self._running is None:
            return []
        columns = max(_BOX, self._output.get_size().columns)
        return [*self._bar(), ("", "\n"), *self._boxes(columns)]

    def _bar(self) -> Fragments:
        if self._search is not None:
            return [("class:bar", f" Searching for: {self._search}_  (Tab, arrows: next; Enter: choose; Esc: end) ")]
        keys: tuple[tuple[str, str], ...]
        if self._selected:
            title, keys = f" Actions for '{self._monitor.label(self._selected)}': ", _NODE_KEYS
        else:
            title, keys = " ", _GLOBAL_KEYS
        bar: Fragments = [("class:bar", title)]
        for key, text in keys:
            on = key == "F8" and self._monitor.warnings_only
            bar += [("class:bar.key" + (" reverse" if on else ""), f"{key}:"), ("class:bar", f" {text}  ")]
        return bar

    def _boxes(self, columns: int) -> Fragments:
        per_row = max(1, (columns + 1) // (_BOX + 3))
        matches = self._matches() if self._search is not None else []
        boxes: Fragments = []
        for i, node in enumerate(self._monitor.nodes):
            if i:
                boxes.append(("", "\n" if i % per_row == 0 else " "))
            key = KEYS[i] if i < len(KEYS) else " "
            boxes.append(("class:muted" if node.muted else "class:key", key))
            style = _STATE_STYLE[node.state]
            if self._search is not None and node not in matches:
                style = "class:dim"
            if node is self._selected or (matches and node is matches[self._match % len(matches)]):
                style += " class:chosen"
            boxes.append((style, f" {self._monitor.label(node)[: _BOX - 1]:<{_BOX - 1}}"))
        return boxes

    # keys

    def _bindings(self) -> KeyBindings:
        bindings = KeyBindings()

        @bindings.add("c-c")
        def _quit(event):
            self._monitor.say("killing everything at once" if self._monitor.closing else "Shutting down...")
            self._monitor.shutdown()

        for key, action in (
            ("f6", lambda: self._monitor.start_all()),
            ("f7", lambda: self._monitor.stop_all()),
            ("f8", self._toggle_warnings),
            ("f9", lambda: self._monitor.mute_all(True)),
            ("f10", lambda: self._monitor.mute_all(False)),
        ):
            bindings.add(key)(lambda event, action=action: action())
        for key in ("tab", "right", "down"):
            bindings.add(key)(lambda event: self._step(1))
        for key in ("s-tab", "left", "up"):
            bindings.add(key)(lambda event: self._step(-1))
        bindings.add("enter")(lambda event: self._choose())
        bindings.add("escape", eager=True)(lambda event: self._leave())
        bindings.add("backspace")(lambda event: self._type(None))
        bindings.add("<any>")(lambda event: self._type(event.data))
        return bindings

    def _toggle_warnings(self) -> None:
        self._monitor.warnings_only = not self._monitor.warnings_only

    def _step(self, direction: int) -> None:
        if self._search is not None:
            self._match += direction

    def _choose(self) -> None:
        matches = self._matches() if self._search is not None else []
        if matches:
            self._selected = matches[self._match % len(matches)]
        self._search = None

    def _leave(self) -> None:
        self._search = self._selected = None

    def _type(self, text: str | None) -> None:
        if self._search is not None:
            self._search = self._search[:-1] if text is None else self._search + text
            self._match = 0
        elif text is None or not text.isprintable():
            return
        elif self._selected:
            self._act(self._selected, text)
        elif text == "/":
            self._search, self._match = "", 0
        elif text in KEYS and KEYS.index(text) < len(self._monitor.nodes):
            self._selected = self._monitor.nodes[KEYS.index(text)]

    def _act(self, node: NodeProcess, key: str) -> None:
        self._selected = None
        if key in _ACTIONS:
            self._monitor.act(node, _ACTIONS[key])
        elif key == "d":
            self._monitor.say(debug(node))
