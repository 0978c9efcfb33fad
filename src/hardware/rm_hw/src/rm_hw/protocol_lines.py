"""The serial port under python-can's ``slcan`` back-end: whole, valid frame lines only.

python-can 4.1 asks the operating system for every single byte, raises on a line it cannot decode (and then on every
later one), and takes the stick's acknowledgements for "nothing received"; pyserial reports a time-out for bytes that
were written when the process was merely suspended meanwhile. This port reads in blocks, hands on frame lines and
nothing else, counts the rest in ``rejected``, and writes a line whole. It is opened through pyserial's own URL look-up
as ``lines:///dev/ttyACM0`` once :func:`register` has been called; pyserial wants this module to be called
``protocol_lines``.
"""

from __future__ import annotations

import os
import re
import select
from typing import TYPE_CHECKING

import serial

if TYPE_CHECKING:
    from typing_extensions import Buffer

_LINE = re.compile(rb"t[0-7][0-9A-Fa-f]{2}(?:0|1.{2}|2.{4}|3.{6}|4.{8}|5.{10}|6.{12}|7.{14}|8.{16})$")
_HEX = re.compile(rb"t[0-9A-Fa-f]+$")
_ACKNOWLEDGEMENTS = (b"", b"z", b"Z")
_LONGEST_LINE = 64


class LineSerial(serial.Serial):
    """A serial port whose reader sees valid SLCAN data lines only."""

    def __init__(self, *args, **kwargs) -> None:
        self._ready = b""
        self._position = 0
        self._partial = b""
        self._read_timeout: float | None = None
        self.rejected = 0
        super().__init__(*args, **kwargs)

    @property
    def timeout(self) -> float | None:
        """s to wait for a read. Unlike pyserial's, changing it does not reconfigure the port."""
        return self._read_timeout

    @timeout.setter
    def timeout(self, timeout: float | None) -> None:
        self._read_timeout = self._timeout = timeout

    @property
    def _descriptor(self) -> int:
        """The open device's."""
        assert self.fd is not None
        return self.fd

    @property
    def in_waiting(self) -> int:
        """Bytes of valid lines at hand."""
        if self._position == len(self._ready):
            self._fill()
        return len(self._ready) - self._position

    def read(self, size: int = 1) -> bytes:
        """Up to ``size`` bytes of valid lines; empty when none came within ``timeout``."""
        if not self.in_waiting:
            if self._read_timeout != 0:
                select.select([self._descriptor], [], [], self._read_timeout)
            self._fill()
        start, self._position = self._position, min(len(self._ready), self._position + size)
        return self._ready[start : self._position]

    def write(self, data: Buffer) -> int:
        """Write all of ``data``.

        :raises serial.SerialTimeoutException: the device takes nothing within ``write_timeout``.
        """
        sent, data = 0, bytes(data)
        while sent < len(data):
            try:
                sent += os.write(self._descriptor, data[sent:])
            except BlockingIOError:
                if not select.select([], [self._descriptor], [], self.write_timeout)[1]:
                    raise serial.SerialTimeoutException("the adapter takes no more frames") from None
            except OSError as error:
                raise serial.SerialException(f"the adapter is gone: {error}") from error
        return sent

    def flush(self) -> None:
        """Nothing waits here; the driver sends as fast as the line allows."""

    @property
    def write_timeout(self) -> float | None:
        """s to wait for room. Unlike pyserial's, changing it does not reconfigure the port."""
        return self._write_timeout

    @write_timeout.setter
    def write_timeout(self, timeout: float | None) -> None:
        self._write_timeout = timeout

    def _fill(self) -> None:
        try:
            data = os.read(self._descriptor, 65536)
        except BlockingIOError:
            return
        except OSError as error:
            raise serial.SerialException(f"the adapter is gone: {error}") from error
        if not data:
            return
        data = self._partial + data.replace(b"\a", b"\r")  # a bell ends a line too: the stick refused something
        *lines, self._partial = data.split(b"\r")
        if len(self._partial) > _LONGEST_LINE:
            self._partial = b""
            self.rejected += 1
        good = []
        for line in lines:
            if _LINE.match(line) and _HEX.match(line):
                good.append(line + b"\r")
            elif line not in _ACKNOWLEDGEMENTS:
                self.rejected += 1
        self._ready, self._position = b"".join(good), 0


def serial_class_for_url(url: str) -> tuple[str, type]:
    """pyserial's hook: (device path, class) of ``url``."""
    return url[len("lines://") :], LineSerial


def register() -> None:
    """Make ``lines://`` known to pyserial."""
    if "rm_hw" not in serial.protocol_handler_packages:
        serial.protocol_handler_packages.append("rm_hw")
