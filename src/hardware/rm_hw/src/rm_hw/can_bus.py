"""One CAN bus through python-can: opening, draining, sending, and opening again after it was lost."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any

import can

from rm_hw import protocol_lines

BITRATE = 1000000
RETRY = 0.5  # s between attempts to open an interface
SEND_TIMEOUT = 0.002  # s
_GARBAGE_PAUSE = 1.0  # s between two lines about garbage
_PATIENCE = 0.05  # s during which nothing can be sent before the bus counts as lost

OPEN_ERRORS = (OSError, ValueError, can.CanError)


def open_interface(interface: str, channel: str, bitrate: int = BITRATE) -> can.BusABC:
    """Open an interface of python-can.

    :param interface: ``socketcan`` (its bit rate is set with ``ip link``), ``slcan``, or another one python-can has.
    :param channel: what that calls the bus: ``can0``, a serial port.
    :param bitrate: bit/s.
    :raises OSError, ValueError, can.CanError: it cannot be opened.
    """
    make: Any = can.Bus  # makes an object of the class that the interface has
    if interface == "slcan":
        protocol_lines.register()
        device = channel.partition("@")[0]
        if not os.path.exists(device):
            raise FileNotFoundError(f"there is no {device}")
        return make(interface="slcan", channel=f"lines://{channel}", bitrate=bitrate, sleep_after_open=0)
    if interface == "socketcan":
        return make(interface="socketcan", channel=channel)
    return make(interface=interface, channel=channel, bitrate=bitrate)


class CanBus:
    """A bus that may be missing. Opening is tried in a thread of its own, everything else happens in the caller's.

    :param name: as the configuration calls it, for example can0.
    :param report: called with (level, line); level is info, warn or error.
    :param interface, channel, bitrate: as for :func:`open_interface`.
    """

    def __init__(self, name: str, interface: str, channel: str, report: Callable[[str, str], None], bitrate: int = BITRATE) -> None:
        self.name, self.interface, self.channel = name, interface, channel
        self._bitrate = bitrate
        self._report = report
        self._bus: can.BusABC | None = None
        self._stop = threading.Event()
        self._opener: threading.Thread | None = None
        self._told = False
        self._rejected = 0
        self._next_garbage_line = 0.0
        self._failing_since: float | None = None

    @property
    def connected(self) -> bool:
        return self._bus is not None

    def start(self) -> None:
        """Open now if possible, else keep trying every half second in the background."""
        if not self._open_once():
            self._opener = threading.Thread(target=self._keep_opening, name=f"open {self.name}", daemon=True)
            self._opener.start()

    def _keep_opening(self) -> None:
        while not self._stop.wait(RETRY):
            if self._open_once():
                return

    def _open_once(self) -> bool:
        try:
            bus = open_interface(self.interface, self.channel, self._bitrate)
        except OPEN_ERRORS as error:
            if not self._told:
                self._told = True
                self._report(
                    "error",
                    f"Unable to select CAN interface {self.name}: I/O control error: {self._remedy(error)}; trying again every {RETRY:g} s",
                )
            return False
        self._told = False
        self._rejected = 0
        self._report("info", f"Successfully connected to {self.name}")
        self._bus = bus
        return True

    def _remedy(self, error: Exception) -> str:
        if self.interface == "socketcan":
            if getattr(error, "errno", None) == 97:
                return f"this kernel has no CAN support ({error}); use a USB adapter with 'interface: slcan', or 'rosrun rm_hw motor_bench'"
            return f"{error}; run 'sudo ip link set {self.name} up type can bitrate {self._bitrate}'"
        return f"{error}; is the adapter plugged in and its device name '{self.channel}' right?"

    def receive(self) -> Iterator[can.Message]:
        """All frames that have arrived since the last call, oldest first. Never waits."""
        bus = self._bus
        if bus is None:
            return
        try:
            message = bus.recv(0)
            while message is not None:
                if not message.is_error_frame:
                    yield message
                message = bus.recv(0)
        except (OSError, can.CanError) as error:
            self.lose(error)
            return
        port = getattr(bus, "serialPortOrig", None)
        if port is not None and port.rejected != self._rejected and time.monotonic() >= self._next_garbage_line:
            self._next_garbage_line = time.monotonic() + _GARBAGE_PAUSE
            self._report(
                "warn",
                f"{self.name}: {port.rejected - self._rejected} lines from {self.channel} are no CAN "
                "frames and were ignored: check the adapter's cable and baud rate",
            )
            self._rejected = port.rejected

    def send(self, identifier: int, data: bytes) -> bool:
        """Send ``data`` (up to 8 bytes) in a standard frame with the 11-bit ``identifier``; False if it could not be sent."""
        bus = self._bus
        if bus is None:
            return False
        try:
            bus.send(can.Message(arbitration_id=identifier, data=data, is_extended_id=False), timeout=SEND_TIMEOUT)
        except (OSError, can.CanError) as error:
            self._not_sent(error)
            return False
        self._failing_since = None
        return True

    def _not_sent(self, error: Exception) -> None:
        """A full queue may empty again; what goes on failing is lost."""
        now = time.monotonic()
        if self._failing_since is None:
            self._failing_since = now
        elif now - self._failing_since > _PATIENCE:
            self._failing_since = None
            self.lose(error.__cause__ or error)

    def lose(self, error: BaseException) -> None:
        """The bus failed with ``error``: close it and start looking for it again."""
        bus, self._bus = self._bus, None
        if bus is None:
            return
        self._report(
            "error",
            f"{self.name} is lost ({error}): its motors are disabled until it is back; check the adapter, the cable and the termination",
        )
        self._close(bus)
        if not self._stop.is_set():
            self._told = True
            self._opener = threading.Thread(target=self._keep_opening, name=f"open {self.name}", daemon=True)
            self._opener.start()

    def close(self) -> None:
        """Stop trying, close the interface."""
        self._stop.set()
        if self._opener:
            self._opener.join()
        bus, self._bus = self._bus, None
        if bus is not None:
            self._close(bus)

    @staticmethod
    def _close(bus: can.BusABC) -> None:
        try:
            bus.shutdown()
        except (OSError, can.CanError):
            return  # it is gone already; there is nothing left to release
