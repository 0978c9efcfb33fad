"""A second process that switches the motors off when the first one is gone without having done so.

Speed controllers go on with the last current they were told. A process that ends by SIGKILL, a crash of the interpreter
or a lack of memory cannot say goodbye; this one notices, because its pipe closes.
"""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import time
from collections.abc import Sequence

import can

from rm_hw.can_bus import OPEN_ERRORS, SEND_TIMEOUT, open_interface

_GOODBYE = b"goodbye\n"
_REPEAT = 20  # times, 5 ms apart
_ATTEMPTS = 50  # to open a bus, 20 ms apart


class Guard:
    """Watches over this process until :meth:`dismiss`.

    :param buses: (interface, channel, bitrate, zero frames) of each bus.
    """

    def __init__(self, buses: Sequence[tuple[str, str, int, list[tuple[int, bytes]]]]) -> None:
        task = json.dumps(
            [[interface, channel, bitrate, [[i, data.hex()] for i, data in frames]] for interface, channel, bitrate, frames in buses]
        )
        self._process = subprocess.Popen(
            [sys.executable, "-m", "rm_hw.guard", task], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, start_new_session=True
        )

    def dismiss(self) -> None:
        """The motors are off; the guard may go."""
        try:
            self._process.communicate(_GOODBYE, timeout=2.0)
        except (BrokenPipeError, subprocess.TimeoutExpired):
            self._process.kill()
            self._process.wait()


def _switch_off(task: Sequence[Sequence]) -> None:
    open_buses: dict[int, can.BusABC] = {}
    for _attempt in range(_ATTEMPTS):
        for index, (interface, channel, bitrate, _) in enumerate(task):
            if index not in open_buses:
                try:
                    open_buses[index] = open_interface(interface, channel, bitrate)
                except OPEN_ERRORS:
                    continue  # another attempt, as long as there are some
        if len(open_buses) == len(task):
            break
        time.sleep(0.02)
    for _ in range(_REPEAT):
        for index, bus in open_buses.items():
            for identifier, data in task[index][3]:
                try:
                    bus.send(can.Message(arbitration_id=identifier, data=bytes.fromhex(data), is_extended_id=False), timeout=SEND_TIMEOUT)
                except (OSError, can.CanError):
                    continue  # the bus is gone; the others must still be told
        time.sleep(0.005)


def main() -> int:
    """Wait for the end of standard input."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    if sys.stdin.buffer.read() != _GOODBYE:
        _switch_off(json.loads(sys.argv[1]))
        print("rm_hw has ended without a word: its guard has sent zero current to all motors", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
