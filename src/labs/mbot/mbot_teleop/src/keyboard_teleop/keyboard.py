"""Single keys from a terminal or a pipe."""

import os
import select
import termios
import time
import tty

PERIOD = 0.1  # s, the longest wait for a key


class Keyboard:
    """Reads keys from a file descriptor: each as it is typed from a terminal, one per PERIOD from anything else.

    A context manager: the terminal has its old settings again at the end.
    """

    def __init__(self, descriptor):
        self._descriptor = descriptor
        self._terminal = os.isatty(descriptor)
        self._settings = None
        self.ended = False  # the pipe or file has no more keys

    def __enter__(self):
        if self._terminal:
            self._settings = termios.tcgetattr(self._descriptor)
            tty.setcbreak(self._descriptor, termios.TCSADRAIN)
            mode = termios.tcgetattr(self._descriptor)
            mode[tty.LFLAG] &= ~termios.ISIG  # Ctrl-C comes as a key
            termios.tcsetattr(self._descriptor, termios.TCSADRAIN, mode)
        return self

    def __exit__(self, *_):
        if self._settings is not None:
            termios.tcsetattr(self._descriptor, termios.TCSADRAIN, self._settings)

    def read(self):
        """The next key, or "" when none came within PERIOD. Ctrl-C on a terminal is the key "\\x03"."""
        return self._read_ready() if self._terminal else self._read_pipe()

    def _read_pipe(self):
        # keys in a pipe were not typed in time: spread them as a held key would come
        start = time.monotonic()
        key = "" if self.ended else self._read_ready()
        time.sleep(max(0.0, start + PERIOD - time.monotonic()))
        return "" if key == "\n" else key

    def _read_ready(self):
        if not select.select([self._descriptor], [], [], PERIOD)[0]:
            return ""
        data = os.read(self._descriptor, 1)
        self.ended = not data
        return data.decode("latin-1")
