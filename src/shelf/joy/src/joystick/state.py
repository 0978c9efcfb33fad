"""Axes and buttons of a joystick, from the events of the kernel (linux/joystick.h). No ROS in it."""

import struct

EVENT = struct.Struct("=IhBB")  # time in ms, value, type, number
BUTTON, AXIS, INIT = 0x01, 0x02, 0x80
FULL = 32767


class State:
    """What a sensor_msgs/Joy shows.

    :param deadzone: share of the throw around the middle that counts as zero, 0 to below 1; the rest is stretched to -1 to 1
    :param sticky: buttons change at each press and stay
    :param trust: take the kernel's first value of an axis, which nobody has touched yet; else it is 0
    """

    def __init__(self, deadzone: float = 0.05, sticky: bool = False, trust: bool = False):
        if not 0 <= deadzone < 1:
            raise ValueError(f"deadzone must be from 0 to below 1, but is {deadzone}")
        self.axes: list[float] = []
        self.buttons: list[int] = []
        self._deadzone, self._sticky, self._trust = deadzone, sticky, trust

    def take(self, value: int, kind: int, number: int) -> bool:
        """One event of the kernel: the button or axis ``number``, by ``kind``, has ``value`` (js_event's fields).

        True if it should be told at once (a button), False if others may be waited for (an axis).
        """
        if kind & ~INIT == BUTTON:
            _grow(self.buttons, number, 0)
            if not self._sticky or kind & INIT:
                self.buttons[number] = int(bool(value))
            elif value:
                self.buttons[number] = 1 - self.buttons[number]
            return not kind & INIT
        if kind & ~INIT == AXIS:
            _grow(self.axes, number, 0.0)
            if self._trust or not kind & INIT:  # the first one is often wrong
                self.axes[number] = self._scaled(value)
        return False

    def _scaled(self, value: int) -> float:
        """-1 to 1; left and up are positive, as REP-103 turns, while the kernel counts right and down."""
        share = max(-1.0, value / FULL)
        beyond = max(abs(share) - self._deadzone, 0.0) / (1 - self._deadzone)
        return -beyond if share > 0 else beyond


def _grow(values: list, number: int, rest) -> None:
    values.extend([rest] * (number + 1 - len(values)))
