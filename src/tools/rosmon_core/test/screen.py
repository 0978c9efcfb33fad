"""A person at a terminal, for tests: starts a command in a pseudo-terminal, reads its screen, types keys."""

import os
import re
import signal
import time

import pexpect
import pyte

F6, F7, F8, F9, F10 = "\x1b[17~", "\x1b[18~", "\x1b[19~", "\x1b[20~", "\x1b[21~"
_PATIENCE = 60.0  # s


class Screen:
    """``lines`` is what is on the screen; ``history`` everything that was ever written, without colours."""

    def __init__(self, command, columns=100, rows=24, **environment):
        self._screen = pyte.Screen(columns, rows)
        self._stream = pyte.Stream(self._screen)
        self.history = ""
        self._child = pexpect.spawn(
            command[0],
            command[1:],
            dimensions=(rows, columns),
            encoding="utf-8",
            env={**os.environ, "TERM": "xterm-256color", **environment},
        )

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self._child.isalive():
            self._child.kill(signal.SIGINT)
            self._child.kill(signal.SIGINT)
        self._child.close(force=True)

    @property
    def lines(self):
        self._update()
        return [line.rstrip() for line in self._screen.display]

    @property
    def pid(self):
        return self._child.pid

    def _update(self):
        while True:
            try:
                text = self._child.read_nonblocking(65536, timeout=0)
            except (pexpect.TIMEOUT, pexpect.EOF):
                return
            self.history += text
            self._stream.feed(text)

    def _character(self, text):
        """The first one of the lowest ``text`` on the screen; None while it is not there, as between two drawings."""
        for y, line in reversed(list(enumerate(self.lines))):
            if text in line:
                return self._screen.buffer[y][line.index(text)]
        return None

    def background(self, text):
        """Colour behind ``text``, None while that is not on the screen."""
        character = self._character(text)
        return character and character.bg

    def reversed(self, text):
        """Whether ``text`` is on the screen with its colours exchanged."""
        character = self._character(text)
        return character is not None and character.reverse

    def type(self, keys):
        self._child.send(keys)

    def wait(self, condition, what):
        """Until ``condition(self)`` is true."""
        end = time.monotonic() + _PATIENCE
        while time.monotonic() < end:
            self._update()
            if condition(self):
                return
            time.sleep(0.02)
        raise AssertionError(f"never happened: {what}; the screen is\n" + "\n".join(self.lines))

    def wait_for(self, text):
        """Until ``text`` has been written."""
        self.wait(lambda s: text in s.history, f"'{text}'")

    def next_lines(self, text, of_block):
        """Until a burst of lines that has ``text`` begins after the one that may be on its way now: lines of nodes are
        written in bursts, and ``of_block``, the end of the screen, is drawn anew below each.

        :return: where in the history it begins
        """
        pattern = re.compile(f"{re.escape(text)}.*?{re.escape(of_block)}.*?(?={re.escape(text)})", re.DOTALL)
        mark = len(self.history)
        self.wait(lambda s: pattern.search(s.history, mark), f"'{text}' before and after '{of_block}'")
        return pattern.search(self.history, mark).end()

    def on_screen(self, text):
        return any(text in line for line in self.lines)

    def finish(self):
        """The exit code after waiting for the end; None if it had to be killed."""
        end = time.monotonic() + _PATIENCE
        while self._child.isalive() and time.monotonic() < end:
            self._update()
            time.sleep(0.01)
        self._update()
        self._child.close(force=True)
        return self._child.exitstatus
