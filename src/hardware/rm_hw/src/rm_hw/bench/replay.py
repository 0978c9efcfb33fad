"""Frames of a CAN log on the bench's ports, at the pace they were recorded."""

from __future__ import annotations

from collections.abc import Iterator

import can

from rm_hw.bench.bus import TICK, BenchError, Bus, Device, Frame
from rm_hw.frames import RM_COMMAND_IDS

_LINGER = 0.5  # s between the last frame and the end


class Replay:
    """Plays what motors and IMUs sent; the commands in the log, which came from the driver, are left out.

    :param path: any format python-can reads (.log of candump, .asc, .blf, .csv ...).
    :param directory: of the links to the ports, one pair per channel in the log.
    """

    def __init__(self, path: str, directory: str, watch=lambda bus, frame: None) -> None:
        try:
            messages = list(can.LogReader(path))
        except (OSError, ValueError) as error:
            raise BenchError(f"cannot replay {path}: {error}; .log, .asc, .blf and .csv files of python-can are read") from None
        if not messages:
            raise BenchError(f"cannot replay {path}: there is no frame in it")
        self._start = messages[0].timestamp
        self.time = 0.0
        self.buses: dict[str, Bus] = {}
        for message in messages:
            name = str(message.channel or "can0")
            if name not in self.buses:
                self.buses[name] = Bus(name, directory, watch)
        self.devices: dict[str, Device] = {}
        self._messages: Iterator[can.Message] = iter(m for m in messages if not m.is_error_frame and m.arbitration_id not in RM_COMMAND_IDS)
        self._since_last = 0.0
        self._next: can.Message | None = next(self._messages, None)

    @property
    def finished(self) -> bool:
        """All frames are sent, and have been read: closing a terminal takes away what is still in it."""
        return self._since_last > _LINGER

    def listen(self) -> None:
        for bus in self.buses.values():
            bus.listen()

    def tick(self) -> None:
        """One millisecond; time stands still until somebody has opened the first port of a bus."""
        if self._next is None:
            self._since_last += TICK
        if not any(bus.opened for bus in self.buses.values()):
            return
        self.time += TICK
        while self._next is not None and self._next.timestamp - self._start <= self.time:
            frame = Frame(self._next.arbitration_id, bytes(self._next.data))
            self.buses[str(self._next.channel or "can0")].speak([frame])
            self._next = next(self._messages, None)

    def command(self, line: str) -> str:
        raise BenchError(f"'{line}': a recording has no motors to command")

    def close(self) -> None:
        for bus in self.buses.values():
            bus.unplug()
