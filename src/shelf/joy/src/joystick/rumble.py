"""Force feedback of a joystick: the motors of its event device (linux/input.h). No ROS in it."""

from __future__ import annotations

import glob
import math
import os
import struct
import time
from collections.abc import Callable
from fcntl import ioctl
from typing import Any

_REST = 28 if struct.calcsize("P") == 8 else 24  # bytes of other effects, one of which has a pointer
EFFECT = struct.Struct(f"=HhHHHHH2xHH{_REST}x")  # type, id, direction, trigger (2), replay (2), heavy and light motor
INPUT = struct.Struct("@llHHi")  # s, us, type, code, value
FF_RUMBLE, EV_FF, FF_GAIN = 0x50, 0x15, 0x60
EVIOCSFF = 1 << 30 | EFFECT.size << 16 | 0x45 << 8 | 0x80
EVIOCGBIT_FF = 2 << 30 | 16 << 16 | 0x45 << 8 | 0x20 + EV_FF
_FULL = 0xFFFF
_LENGTH = 1000  # ms that an effect lasts; what is on is played again before
_AGAIN = 0.9  # s
_BY_ID = "/dev/input/by-id"


def event_device(joystick: str, folder: str = _BY_ID) -> str | None:
    """The event device that belongs to the ``joystick`` /dev/input/jsN, by the links that udev makes in ``folder``."""
    wanted = os.path.realpath(joystick)
    for link in sorted(glob.glob(os.path.join(glob.escape(folder), "*-joystick"))):
        if not link.endswith("-event-joystick") and os.path.realpath(link) == wanted:
            event = link.removesuffix("-joystick") + "-event-joystick"
            return event if os.path.exists(event) else None
    return None


class Rumble:
    """The two motors of an open event device.

    :param descriptor: of the device, open for writing; closed by ``close``.
    :param control: ``fcntl.ioctl``.
    :raises OSError: it has no motors.
    """

    def __init__(self, descriptor: int, control: Callable[..., Any] = ioctl):
        self._descriptor, self._control = descriptor, control
        self._motors = [0, 0]  # heavy and light
        self._number = -1  # of the effect, which the kernel gives
        self._changed, self._due = False, math.inf
        able = bytearray(16)
        control(descriptor, EVIOCGBIT_FF, able)
        if not able[FF_RUMBLE // 8] >> FF_RUMBLE % 8 & 1:
            raise OSError(0, "it has no motors")
        self._tell(FF_GAIN, _FULL)

    @classmethod
    def of(cls, path: str) -> Rumble:
        """Of the event device ``path``. :raises OSError: there is none, or it has no motors."""
        descriptor = os.open(path, os.O_RDWR | os.O_NONBLOCK)
        try:
            return cls(descriptor)
        except OSError:
            os.close(descriptor)
            raise

    def set(self, motor: int, intensity: float) -> None:
        """From now on ``motor`` (0: the heavy one, any other: the light one) turns with ``intensity``, 0 to 1."""
        share = min(max(intensity, 0.0), 1.0) if intensity == intensity else 0.0
        self._motors[0 if motor == 0 else 1] = int(share * _FULL)
        self._changed = True

    def play(self, now: float | None = None) -> None:
        """Hand on what was set, and keep it going; to be called some times a second.

        :param now: time.monotonic(). :raises OSError: the device is gone.
        """
        now = time.monotonic() if now is None else now
        if self._changed:
            self._changed = False
            effect = bytearray(EFFECT.pack(FF_RUMBLE, self._number, 0, 0, 0, _LENGTH, 0, *self._motors))
            self._control(self._descriptor, EVIOCSFF, effect)
            self._number = EFFECT.unpack(effect)[1]
            self._due = now
        if now >= self._due:
            self._tell(self._number, 1)
            self._due = now + _AGAIN if any(self._motors) else math.inf

    def close(self) -> None:
        os.close(self._descriptor)

    def _tell(self, code: int, value: int) -> None:
        os.write(self._descriptor, INPUT.pack(0, 0, EV_FF, code, value))
