"""The PID law, without ROS."""

from __future__ import annotations

from typing import NamedTuple

from ._pid import Law


class Gains(NamedTuple):
    """``i_max`` and ``i_min`` bound the integral *term* (output units); both 0 switch the integral part off."""

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_max: float = 0.0
    i_min: float = 0.0
    antiwindup: bool = False


class Pid(Law):
    """output = p*e + i*integral(e) + d*de/dt with e = target - measured; ``pid_law.h`` says the rest.

    Without ``antiwindup`` only the integral term is clamped, while the integral itself goes on growing; with it the
    integral stops where its term meets the clamp. Gains may be replaced from any thread at any time.

    :param p, i, d, i_max, i_min, antiwindup: as for :meth:`set_gains`; ``i_min`` = ``i_max`` = 0 switches the integral part off.
    """

    def __init__(self, p: float = 0.0, i: float = 0.0, d: float = 0.0, i_max: float = 0.0, i_min: float = 0.0, antiwindup: bool = False):
        super().__init__()
        self._set_gains(p, i, d, i_max, i_min, antiwindup)

    @property
    def gains(self) -> Gains:
        return Gains(*self._gains())

    @gains.setter
    def gains(self, gains: Gains) -> None:
        self._set_gains(*gains)

    def set_gains(self, p: float, i: float, d: float, i_max: float, i_min: float, antiwindup: bool = False) -> None:
        """Replace all gains at once: ``p`` in units of the command per unit of the error, ``i`` that per s, ``d`` that times s.

        :param i_max, i_min: clamp of the integral term, in the command's unit.
        :param antiwindup: the integral itself stops where its term meets the clamp.
        """
        self._set_gains(p, i, d, i_max, i_min, antiwindup)

    def slope_of_position(self, dt: float) -> float:
        """How much less the next command, in ``dt`` s, gets per unit of speed of what is measured, where the error is one of position.

        Negative where there is no D gain: nothing of the command is of the speed yet.
        """
        gains = self.gains
        if gains.d == 0.0:
            return -gains.p * dt if gains.p > 0.0 else 0.0
        return max(gains.d + gains.p * dt, 0.0)

    def slope_of_velocity(self, dt: float) -> float:
        """The same where the error is one of speed; ``dt`` in s."""
        gains = self.gains
        return gains.p + gains.d / dt if dt > 0.0 else gains.p
