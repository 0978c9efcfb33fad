"""One serial port of the bench: a pseudo-terminal that speaks SLCAN (the Lawicel protocol of USB-CAN sticks)."""

from __future__ import annotations

import errno
import os
import re
import tty
from collections.abc import Iterable
from typing import NamedTuple

_OK, _BELL = b"\r", b"\a"
_DATA = re.compile(rb"t([0-7][0-9A-Fa-f]{2})([0-8])((?:[0-9A-Fa-f]{2})*)$")
_LONGEST_LINE = 64


class Frame(NamedTuple):
    """A standard data frame."""

    id: int
    data: bytes


def encode(frame: Frame) -> bytes:
    """``frame`` as a line, ``tIIILDD...`` and a carriage return."""
    return b"t%03X%d%s\r" % (frame.id, len(frame.data), frame.data.hex().upper().encode())


class SlcanPort:
    """A USB-CAN stick as its user sees it: ``path`` is a link to the terminal to open.

    The channel opens with ``O`` and closes with ``C`` or when the last process closes the terminal.
    Frames for a reader that does not keep up are lost, as in the stick's own buffer.
    """

    def __init__(self, path: str) -> None:
        self.path = path
        self.open = False
        self.lost = 0
        self._buffer = b""
        self._master, slave = os.openpty()
        tty.setraw(slave)
        os.set_blocking(self._master, False)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        temporary = f"{path}.{os.getpid()}"
        os.symlink(os.ttyname(slave), temporary)
        os.replace(temporary, path)
        os.close(slave)

    def close(self) -> None:
        """Unplug the stick: the link goes, whoever has the terminal open gets an I/O error."""
        if os.path.islink(self.path):
            os.unlink(self.path)
        os.close(self._master)

    def read(self, bus_works: bool = True) -> list[Frame]:
        """Frames the user has sent since the last call; other SLCAN commands are answered here."""
        try:
            self._buffer += os.read(self._master, 65536)
        except BlockingIOError:
            return []
        except OSError as error:
            if error.errno != errno.EIO:
                raise
            self.open, self._buffer = False, b""  # nobody has the terminal open
            return []
        *lines, self._buffer = self._buffer.split(_OK)
        if len(self._buffer) > _LONGEST_LINE:
            self._buffer = b""
        frames: list[Frame] = []
        answers = b""
        for line in lines:
            answers += self._command(line, frames, bus_works)
        self._write(answers)
        return frames

    def _command(self, line: bytes, frames: list[Frame], bus_works: bool) -> bytes:
        match = _DATA.match(line)
        if match:
            identifier, length, digits = match.groups()
            if not self.open or not bus_works or len(digits) != 2 * int(length):
                return _BELL
            frames.append(Frame(int(identifier, 16), bytes.fromhex(digits.decode())))
            return b"z\r"
        command = line[:1]
        if command == b"O":
            self.open = True
        elif command == b"C":
            self.open = False
        elif command == b"S":
            return _OK if line == b"S8" and not self.open else _BELL  # RoboMaster buses run at 1 Mbit/s
        elif command == b"V":
            return b"V1013\r"
        elif command == b"N":
            return b"NRMHW\r"
        elif command == b"F":
            return b"F00\r" if bus_works else b"F80\r"  # bit 7: bus error
        elif command:
            return _BELL
        return _OK

    def send(self, frames: Iterable[Frame]) -> None:
        """``frames`` from the bus to the user."""
        if self.open:
            self._write(b"".join(map(encode, frames)))

    def send_raw(self, data: bytes) -> None:
        """``data``, bytes as they are: line noise."""
        if self.open:
            self._write(data)

    def _write(self, data: bytes) -> None:
        if not data:
            return
        try:
            written = os.write(self._master, data)
            self.lost += len(data) - written
        except BlockingIOError:
            self.lost += len(data)
        except OSError as error:
            if error.errno != errno.EIO:
                raise
            self.open = False
