"""Keys of the motor bench: a terminal in character mode, and what each key does."""

from __future__ import annotations

import os
import select
import sys
import termios
import tty

from rm_hw.bench.bus import Bench, BenchError
from rm_hw.bench.replay import Replay

HELP = """keys: Tab next motor | left/right arrow turn its shaft 0.1 rad by hand | space hold/release (stuck motor)
      l leave/return | d drop half of its frames | t 5 ms late | h heat to 105 C | c cool to 25 C
      g garbage bytes | b bus off/on | u unplug/plug the adapter | ? this help | q quit"""
_ARROWS = {"\x1b[C": 0.1, "\x1b[D": -0.1}


class Keys:
    """Reads standard input without waiting. Use as a context manager: it restores the terminal."""

    def __init__(self, bench: Bench | Replay) -> None:
        self._bench = bench
        self._selected = 0
        self._unplugged: dict[str, bool] = {}

    def __enter__(self) -> Keys:
        self._saved = termios.tcgetattr(sys.stdin)
        tty.setcbreak(sys.stdin)
        return self

    def __exit__(self, *_) -> None:
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, self._saved)

    @property
    def motor(self) -> str | None:
        """The selected motor."""
        names = list(self._bench.devices)
        return names[self._selected % len(names)] if names else None

    def poll(self) -> str | None:
        """Carry out a waiting key and say what it did; None without one. :raises EOFError: quit."""
        if not select.select([sys.stdin], [], [], 0)[0]:
            return None
        key = os.read(sys.stdin.fileno(), 8).decode(errors="replace")
        if key in ("q", ""):
            raise EOFError
        if key == "\t":
            self._selected += 1
            return f"selected {self.motor}"
        line = self._line(key)
        if line is None or isinstance(self._bench, Replay):  # a recording has no motors to work on
            return HELP
        try:
            return self._bench.command(line)
        except BenchError as error:
            return str(error)

    def _line(self, key: str) -> str | None:
        name = self.motor
        if name is None:
            return None
        device = self._bench.devices[name]
        bus_name, bus = next((n, b) for n, b in self._bench.buses.items() if name in b.devices)
        if key in _ARROWS:
            return f"turn {name} {_ARROWS[key]}"
        return {
            " ": f"{'release' if device.motor.held else 'hold'} {name}",
            "l": f"{'leave' if device.present else 'return'} {name}",
            "d": f"drop {name} {0 if device.drop else 0.5}",
            "t": f"late {name} {0 if device.late else 0.005}",
            "h": f"heat {name} 105",
            "c": f"heat {name} 25",
            "g": f"garbage {bus_name} 64",
            "b": f"{'busoff' if bus.works else 'recover'} {bus_name}",
            "u": f"{'unplug' if bus.ports else 'plug'} {bus_name}",
        }.get(key)
