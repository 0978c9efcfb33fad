"""The PID law, without ROS."""
from __future__ import annotations

from math import isfinite
from typing import NamedTuple, Optional


class Gains(NamedTuple):
    """``i_max`` and ``i_min`` bound the integral *term* (output units); both 0 switch the integral part off."""

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_max: float = 0.0
    i_min: float = 0.0
    antiwindup: bool = False


class Pid:
    """output = p*e + i*integral(e) + d*de/dt with e = target - measured.

    Without ``antiwindup`` only the integral term is clamped, while the integral itself goes on growing; with it the
    integral stops where its term meets the clamp. Gains may be replaced from any thread at any time.
    """

    def __init__(self, p: float = 0.0, i: float = 0.0, d: float = 0.0, i_max: float = 0.0, i_min: float = 0.0,
                 antiwindup: bool = False):
        self.gains = Gains(p, i, d, i_max, i_min, antiwindup)
        self.reset()

    def set_gains(self, p: float, i: float, d: float, i_max: float, i_min: float, antiwindup: bool = False) -> None:
        self.gains = Gains(p, i, d, i_max, i_min, antiwindup)

    def reset(self, d_error: Optional[float] = None, i_error: float = 0.0) -> None:
        """Forget the past.

        After a plain reset the last error counts as 0, so the first step sees a derivative of e/dt; give ``d_error``
        to make the first step use that derivative instead.
        """
        self.p_error = 0.0
        self.i_error = i_error
        self.d_error = 0.0 if d_error is None else d_error
        self.command = 0.0
        self._p_error_last: Optional[float] = 0.0 if d_error is None else None

    def compute_command(self, error: float, dt: float, error_dot: Optional[float] = None) -> float:
        """One step.

        :param error: target - measured.
        :param dt: s since the last step.
        :param error_dot: derivative of the error; by default the difference quotient.
        :return: the command; 0.0, with nothing integrated, for dt 0 or an error that is not finite. Always finite.
        """
        if not dt or not isfinite(error):
            self.p_error = error
            return 0.0
        if error_dot is None:
            if self._p_error_last is None:
                error_dot = self.d_error
            elif dt > 0.0:
                error_dot = (error - self._p_error_last) / dt
            else:
                error_dot = self.d_error
            self._p_error_last = error
        elif not isfinite(error_dot):
            self.p_error = error
            return 0.0
        p, i, d, i_max, i_min, antiwindup = self.gains
        self.p_error = error
        self.d_error = error_dot
        i_error = self.i_error + dt * error
        if antiwindup and i:
            low, high = i_min / i, i_max / i
            if low > high:
                low, high = high, low
            i_error = low if i_error < low else high if i_error > high else i_error
        self.i_error = i_error
        i_term = i * i_error
        if not antiwindup:
            i_term = i_min if i_term < i_min else i_max if i_term > i_max else i_term
        command = p * error + i_term + d * error_dot
        if command - command != 0.0:  # more than a float holds; an infinite integral would make it NaN for good
            if not isfinite(self.i_error):
                self.i_error = 0.0
            command = 0.0
        self.command = command
        return command

    def slope_of_position(self, dt: float) -> float:
        """How much less the next command gets per unit of speed of what is measured, where the error is one of position.

        Negative where there is no D gain: nothing of the command is of the speed yet.
        """
        gains = self.gains
        if gains.d == 0.0:
            return -gains.p * dt if gains.p > 0.0 else 0.0
        return max(gains.d + gains.p * dt, 0.0)

    def slope_of_velocity(self, dt: float) -> float:
        """The same where the error is one of speed."""
        gains = self.gains
        return gains.p + gains.d / dt if dt > 0.0 else gains.p
