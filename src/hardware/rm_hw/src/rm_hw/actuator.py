"""One motor on a bus: its feedback in SI units, its turns, whether it answers, and the command it gets."""

from __future__ import annotations

import math

from rm_hw.coefficients import Coefficients
from rm_hw.frames import CheetahReply, Feedback
from rm_hw.low_pass import LowPass

SILENCE = 0.1  # s without a frame after which a motor counts as gone
TOO_HOT = 99  # degrees Celsius, above it a motor is not commanded
WARM = 80  # degrees Celsius, above it a warning is due
_SHORTEST_INTERVAL = 0.0005
_CHEETAH_RANGE = 8.0 * math.pi


class Actuator:
    """State and command of one motor.

    Attributes are plain floats and ints so that a RobotHW can copy them every cycle: ``position`` (rad),
    ``velocity`` (rad/s, filtered), ``effort`` (Nm), ``commanded_effort`` and ``executed_effort`` (Nm, written by the
    RobotHW), ``offset`` (rad, added to the position; a calibration controller writes it).

    :param feedback_id: CAN id of the feedback frame; for ``cheetah`` the motor id.
    :param name: of the motor. :param type_name: ``rm_3508`` ..., the row of ``coefficients``. :param bus: name of its CAN bus.
    :param need_calibration: its position means nothing until a controller has calibrated it.
    :param cutoff: Hz, of the velocity's :class:`LowPass`. :param timeout: s of silence that halt it.
    """

    def __init__(
        self,
        name: str,
        type_name: str,
        bus: str,
        feedback_id: int,
        coefficients: Coefficients,
        need_calibration: bool = False,
        cutoff: float = -1.0,
        timeout: float = SILENCE,
    ) -> None:
        self.name, self.type, self.bus, self.id = name, type_name, bus, feedback_id
        self.coefficients = coefficients
        self.need_calibration = need_calibration
        self.timeout = timeout
        self.filter = LowPass(cutoff)
        self.calibrated = False
        self.calibration_reading = False
        self.position_raw = self.last_position_raw = self.velocity_raw = self.temperature = self.circle = 0
        self.frequency = self.position = self.velocity = self.effort = self.offset = 0.0
        self.commanded_effort = self.executed_effort = 0.0
        self.stamp = 0.0
        self.halted = True
        self._heard: float | None = None
        self._angle: int | None = None

    def on_feedback(self, feedback: Feedback, stamp: float, now: float) -> bool:
        """Take a RoboMaster frame, ``feedback``, received at ``stamp`` (s since the epoch) and monotonic time ``now`` (s).

        :returns: False if it came less than half a millisecond after the previous one and was dropped.
        """
        self.follow(feedback.angle)
        if not self._accept(stamp, now):
            return False
        k = self.coefficients
        self.last_position_raw, self.position_raw = self.position_raw, feedback.angle
        self.velocity_raw, self.temperature = feedback.rpm, feedback.temperature
        self.position = k.act2pos * (feedback.angle + k.counts_per_turn * self.circle) + self.offset
        self.velocity = self.filter.update(k.act2vel * feedback.rpm, stamp)
        self.effort = k.act2effort * feedback.current
        return True

    def follow(self, angle: int) -> None:
        """Count whole turns by ``angle``, the encoder's counts. For frames that a newer one has overtaken, too: after a pause of the
        driver the
        rotor may have gone further in them than half a turn.
        """
        if self._angle is not None:
            jump = angle - self._angle
            if jump > 4096:
                self.circle -= 1
            elif jump < -4096:
                self.circle += 1
        self._angle = angle

    def on_cheetah(self, reply: CheetahReply, stamp: float, now: float) -> bool:
        """Take an MIT driver's ``reply``; ``stamp`` and ``now`` as in :meth:`on_feedback`. Its range of 25 rad is unwrapped in steps of
        8 pi.
        """
        if not self._accept(stamp, now):
            return False
        k = self.coefficients
        within = k.act2pos * reply.position + k.act2pos_offset
        if self._angle is not None:
            jump = within - (k.act2pos * self._angle + k.act2pos_offset)
            if jump > _CHEETAH_RANGE / 2.0:
                self.circle -= 1
            elif jump < -_CHEETAH_RANGE / 2.0:
                self.circle += 1
        self._angle = reply.position
        self.last_position_raw, self.position_raw = self.position_raw, reply.position
        self.velocity_raw = reply.velocity
        self.position = within + _CHEETAH_RANGE * self.circle + self.offset
        self.velocity = self.filter.update(k.act2vel * reply.velocity + k.act2vel_offset, stamp)
        self.effort = k.act2effort * reply.effort + k.act2effort_offset
        return True

    def _accept(self, stamp: float, now: float) -> bool:
        interval = stamp - self.stamp
        if 0.0 <= interval < _SHORTEST_INTERVAL:
            return False
        self.frequency = 1.0 / interval if interval > 0.0 else 0.0  # negative: the clock was set back
        self.stamp = stamp
        self._heard = now
        return True

    def check(self, now: float) -> str | None:
        """Decide whether the motor may be commanded at monotonic time ``now``, s. Call once a cycle after all frames are in.

        :returns: a line when that changed (silent, too hot, back again), else None.
        """
        silent = self._heard is None or now - self._heard > self.timeout
        hot = self.temperature > TOO_HOT
        was_halted, self.halted = self.halted, silent or hot
        if self.halted:
            self.velocity = self.effort = 0.0
            self.calibrated = False
        if self.halted == was_halted:
            return None
        label = f"actuator '{self.name}' ({self.type}, {self.bus} id 0x{self.id:03X})"
        if silent:
            self.filter.reset()
            self.frequency = 0.0
            return (
                f"{label} has sent nothing for {self.timeout:g} s and is disabled: check its power, its CAN plug "
                "and its id; it is used again as soon as frames return"
            )
        if hot:
            return (
                f"{label} is at {self.temperature} C, above {TOO_HOT} C, and is disabled until it has cooled: let it rest, lower the load"
            )
        return f"{label} is answering"

    def command_counts(self, effort: float) -> int:
        """Counts that ask for ``effort`` (Nm), limited to ``max_out``; a command that is no number counts as zero."""
        if self.halted or not math.isfinite(effort):
            return 0
        k = self.coefficients
        return int(max(-k.max_out, min(k.max_out, k.effort2act * effort)))
