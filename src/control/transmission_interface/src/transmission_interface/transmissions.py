"""Transmissions as classes; their mathematics are those of ``transmission_law.h``, which says what the letters are.

Every method takes and gives one value per actuator or joint, in SI units.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ._law import Coupling, Law, plan
from .errors import TransmissionError

if TYPE_CHECKING:
    from ._law import Part
    from .parser import ActuatorInfo, JointInfo, TransmissionInfo

__all__ = ["DifferentialTransmission", "FourBarLinkageTransmission", "SimpleTransmission", "Transmission", "TransmissionError"]


class Transmission:
    """Base of all transmissions. ``from_info`` makes one out of its URDF description."""

    num_actuators = 1
    num_joints = 1

    @classmethod
    def from_info(cls, info: TransmissionInfo) -> tuple[Transmission, list[int], list[int]]:
        """:param info: TransmissionInfo.
        :return: the transmission, and the indices of the info's actuators and joints in the transmission's order.
        :raises TransmissionError: wrong number of joints, missing roles, zero reduction ...
        """
        raise NotImplementedError

    def position_to_joint(self, a: Sequence[float]) -> Sequence[float]:
        """Positions of the joints, rad or m, for those of the actuators, ``a``, rad or m."""
        raise NotImplementedError

    def velocity_to_joint(self, a: Sequence[float]) -> Sequence[float]:
        """Velocities of the joints, rad/s or m/s, for those of the actuators, ``a``."""
        raise NotImplementedError

    def effort_to_joint(self, a: Sequence[float]) -> Sequence[float]:
        """Efforts of the joints, Nm or N, for those of the actuators, ``a``."""
        raise NotImplementedError

    def absolute_to_joint(self, a: Sequence[float]) -> Sequence[float]:
        """Positions of the joints, rad or m, for ``a``, those of the actuators' absolute encoders."""
        return self.position_to_joint(a)

    def position_to_actuator(self, j: Sequence[float]) -> Sequence[float]:
        """Positions of the actuators, rad or m, for those of the joints, ``j``, rad or m."""
        raise NotImplementedError

    def velocity_to_actuator(self, j: Sequence[float]) -> Sequence[float]:
        """Velocities of the actuators, rad/s or m/s, for those of the joints, ``j``."""
        raise NotImplementedError

    def effort_to_actuator(self, j: Sequence[float]) -> Sequence[float]:
        """Efforts of the actuators, Nm or N, for those of the joints, ``j``."""
        raise NotImplementedError


class _Lawful(Law, Transmission):
    """One that the law knows."""

    _coupling: Coupling

    @classmethod
    def from_info(cls, info: TransmissionInfo) -> tuple[Transmission, list[int], list[int]]:
        law, actuators, joints = plan(
            cls._coupling, info.name, info.type, *([_part(entry) for entry in entries] for entries in (info.actuators, info.joints))
        )
        made = cls.__new__(cls)
        Law.__init__(made, law)
        return made, actuators, joints


class SimpleTransmission(_Lawful):
    """j = a/n + o: ``reduction`` is n, ``offset`` o, rad or m."""

    _coupling = Coupling.SIMPLE

    def __init__(self, reduction: float, offset: float = 0.0):
        super().__init__(self._coupling, [reduction], [1.0], [offset], False)


class DifferentialTransmission(_Lawful):
    """The joints move with the sum and the difference of the actuators.

    :param actuator_reduction, joint_reduction: of each actuator and joint
    :param joint_offset: of each joint, rad or m
    :param crosswise: absolute encoders sit on the joints, each on the other one
    """

    num_actuators = num_joints = 2
    _coupling = Coupling.DIFFERENTIAL

    def __init__(
        self,
        actuator_reduction: Sequence[float],
        joint_reduction: Sequence[float] = (1.0, 1.0),
        joint_offset: Sequence[float] = (0.0, 0.0),
        crosswise: bool = False,
    ):
        super().__init__(self._coupling, actuator_reduction, joint_reduction, joint_offset, crosswise)


class FourBarLinkageTransmission(_Lawful):
    """The first actuator moves the first joint, and the second one along with it.

    ``actuator_reduction``, ``joint_reduction``, ``joint_offset``: as of :class:`DifferentialTransmission`.
    """

    num_actuators = num_joints = 2
    _coupling = Coupling.FOUR_BAR

    def __init__(
        self, actuator_reduction: Sequence[float], joint_reduction: Sequence[float] = (1.0, 1.0), joint_offset: Sequence[float] = (0.0, 0.0)
    ):
        super().__init__(self._coupling, actuator_reduction, joint_reduction, joint_offset, False)


def _part(entry: ActuatorInfo | JointInfo) -> Part:
    """What an ActuatorInfo or a JointInfo says, for the law."""
    element = entry.element
    if element is None:
        return entry.name, entry.role, None, None, False
    return (
        entry.name,
        entry.role,
        element.findtext("mechanicalReduction"),
        element.findtext("offset"),
        element.find("ignoreTransmissionAbsoluteEncoder") is not None,
    )
