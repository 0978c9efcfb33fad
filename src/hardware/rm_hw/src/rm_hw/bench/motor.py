"""Speed controller, rotor, gearbox and load of one RoboMaster motor. No ROS, no clock: time is what ``step`` is given.

Angles and torques with the suffix ``rotor`` are before the gearbox, those with ``out`` behind it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from rm_hw.frames import COUNTS_PER_TURN, Feedback

_RPM = 30.0 / math.pi
_SUBSTEPS = 2


@dataclass(frozen=True)
class MotorSpec:
    """Figures of one motor type, all at the rotor. Values marked * are assumptions, the others follow the data sheets.

    :ivar torque_constant: Nm/A
    :ivar back_emf: V s/rad
    :ivar resistance: ohm
    :ivar current_lag: s, time constant of the current loop* (for a voltage command: L/R)
    :ivar inertia: kg m^2 of the rotor
    :ivar coulomb: Nm, dry friction of motor and gearbox
    :ivar viscous: Nm s/rad
    :ivar gear: rotor turns per output turn when the motor comes with a gearbox
    :ivar counts_per_unit: command counts per ampere (per volt when ``voltage_command``)
    :ivar counts_per_ampere: feedback counts per ampere
    :ivar reports_temperature: the C610 leaves the temperature byte 0
    :ivar heat_capacity: J/K*; ``heat_resistance``: K/W to the air*
    """

    torque_constant: float
    back_emf: float
    resistance: float
    inertia: float
    coulomb: float
    viscous: float
    gear: float
    counts_per_unit: float
    counts_per_ampere: float
    max_counts: int
    current_lag: float = 0.0004
    voltage_command: bool = False
    reports_temperature: bool = True
    heat_capacity: float = 120.0
    heat_resistance: float = 3.0
    supply: float = 24.0


# M3508: 0.3 Nm/A behind 3591/187, 0.194 ohm, no load 482 rpm and 0.78 A at 24 V, time constant 50 ms at 72 rpm/Nm.
# M2006: 0.18 Nm/A behind 36, 0.461 ohm, no load 500 rpm and 0.6 A.
# GM6020: 0.741 Nm/A, 1.8 ohm, 5.7 mH, no load 320 rpm.
SPECS = {
    "rm_3508": MotorSpec(
        torque_constant=0.3 / 19.2032,
        back_emf=0.0246,
        resistance=0.194,
        inertia=1.8e-5,
        coulomb=0.006,
        viscous=6.4e-6,
        gear=3591.0 / 187.0,
        counts_per_unit=16384 / 20.0,
        counts_per_ampere=16384 / 20.0,
        max_counts=16384,
    ),
    "rm_2006": MotorSpec(
        torque_constant=0.18 / 36.0,
        back_emf=0.0126,
        resistance=0.461,
        inertia=4.0e-6,
        coulomb=0.0015,
        viscous=8.0e-7,
        gear=36.0,
        counts_per_unit=1000.0,
        counts_per_ampere=1000.0,
        max_counts=10000,
        reports_temperature=False,
        heat_capacity=40.0,
        heat_resistance=8.0,
    ),
    "rm_6020": MotorSpec(
        torque_constant=0.741,
        back_emf=0.70,
        resistance=1.8,
        inertia=2.3e-4,
        coulomb=0.05,
        viscous=1.0e-3,
        gear=1.0,
        counts_per_unit=30000 / 24.0,
        counts_per_ampere=16384 / 3.0,
        max_counts=30000,
        current_lag=0.0032,
        voltage_command=True,
    ),
}


@dataclass(frozen=True)
class Load:
    """What hangs on the output shaft.

    :ivar inertia: kg m^2 about the output axis
    :ivar gravity: Nm, torque of the weight at angle 0 (horizontal); it pulls towards +pi/2 as cos(angle)
    :ivar damping: Nm s/rad, ``friction``: Nm, of the joint itself
    """

    inertia: float = 0.0
    gravity: float = 0.0
    damping: float = 0.0
    friction: float = 0.0


# link2 and joint1 of rm_controls_tutorials: 0.5 kg at 0.2 m, joint damping 0.01 and friction 0.02
TUTORIAL_ARM = Load(inertia=0.0108333 + 0.5 * 0.2**2, gravity=0.5 * 9.81 * 0.2, damping=0.01, friction=0.02)


@dataclass
class Motor:
    """State of one motor; angles are zero where it was switched on.

    :ivar gear: rotor turns per output turn; the spec's where none is given. ``ratio`` is the one that holds
    :ivar start: rad at the output, the load's angle at rotor angle 0
    :ivar hand: rad at the output still to be turned by hand; ``hand_speed`` in rad/s at the output
    :ivar held: the shaft is held still (a stuck motor, or a hand on the arm)
    """

    spec: MotorSpec
    load: Load = field(default_factory=Load)
    gear: float | None = None
    start: float = 0.0
    ambient: float = 25.0
    angle: float = 0.0
    speed: float = 0.0
    current: float = 0.0
    temperature: float = 25.0
    command: int = 0
    hand: float = 0.0
    hand_speed: float = 2.0
    held: bool = False
    ratio: float = field(init=False)

    def __post_init__(self) -> None:
        self.ratio = self.gear = self.spec.gear if self.gear is None else self.gear
        if self.ratio == 0.0:
            raise ValueError("gear is 0: write the rotor turns per output turn, for example 19.2032")
        self._inertia = self.spec.inertia + self.load.inertia / self.ratio**2
        self._coulomb = self.spec.coulomb + self.load.friction / abs(self.ratio)
        self._viscous = self.spec.viscous + self.load.damping / self.ratio**2

    @property
    def output_angle(self) -> float:
        """rad, the load's angle."""
        return self.start + self.angle / self.ratio

    @property
    def output_speed(self) -> float:
        """rad/s behind the gearbox."""
        return self.speed / self.ratio

    @property
    def torque(self) -> float:
        """Nm of the rotor's magnetic field."""
        return self.spec.torque_constant * self.current

    def step(self, duration: float) -> None:
        """Advance by ``duration`` seconds (about a millisecond) under the present command."""
        spec, dt = self.spec, duration / _SUBSTEPS
        lag = 1.0 - math.exp(-dt / spec.current_lag)
        wanted = max(-spec.max_counts, min(spec.max_counts, self.command)) / spec.counts_per_unit
        for _ in range(_SUBSTEPS):
            emf = spec.back_emf * self.speed
            if spec.voltage_command:
                target = (wanted - emf) / spec.resistance
            else:  # the current loop runs out of voltage at speed
                target = max((-spec.supply - emf) / spec.resistance, min((spec.supply - emf) / spec.resistance, wanted))
            self.current += lag * (target - self.current)
            self._move(dt)
        heat = spec.resistance * self.current**2 - (self.temperature - self.ambient) / spec.heat_resistance
        self.temperature += duration * heat / spec.heat_capacity

    def _move(self, dt: float) -> None:
        if self.hand:
            step = math.copysign(min(abs(self.hand), self.hand_speed * dt), self.hand)
            self.hand = 0.0 if abs(self.hand) <= self.hand_speed * dt else self.hand - step
            self.angle += step * self.ratio
            self.speed = step * self.ratio / dt if self.hand else 0.0
            return
        if self.held:
            self.speed = 0.0
            return
        weight = self.load.gravity * math.cos(self.output_angle) / self.ratio
        speed = (self.speed + dt * (self.torque + weight) / self._inertia) / (1.0 + dt * self._viscous / self._inertia)
        # dry friction takes at most what is there: a motor at rest stays at rest, exactly
        self.speed = math.copysign(max(0.0, abs(speed) - dt * self._coulomb / self._inertia), speed)
        self.angle += dt * self.speed

    def feedback(self) -> Feedback:
        """The frame content the speed controller would send now."""
        counts = math.floor(self.angle * COUNTS_PER_TURN / (2.0 * math.pi)) % COUNTS_PER_TURN
        current = round(self.current * self.spec.counts_per_ampere)
        temperature = max(0, min(255, int(self.temperature))) if self.spec.reports_temperature else 0
        return Feedback(counts, max(-32768, min(32767, round(self.speed * _RPM))), max(-32768, min(32767, current)), temperature)
