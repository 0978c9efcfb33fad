"""The mathematics of transmissions.

a: actuators, j: joints, n: mechanical reduction of an actuator, m: of a joint, o: offset of a joint (rad or m).
Every method takes and gives one value per actuator or joint, in SI units.
"""
from __future__ import annotations

from typing import List, Optional, Sequence, Tuple
from xml.etree import ElementTree

from hardware_interface import ControlError


class TransmissionError(ControlError):
    """A transmission cannot be made; one line saying which and why."""


class Transmission:
    """Base of all transmissions. ``from_info`` makes one out of its URDF description."""

    num_actuators = 1
    num_joints = 1

    #: True: absolute encoders bypass the transmission, crosswise
    direct_absolute_encoders = False

    @classmethod
    def from_info(cls, info) -> "Tuple[Transmission, List[int], List[int]]":
        """:param info: TransmissionInfo.
        :return: the transmission, and the indices of the info's actuators and joints in the transmission's order.
        :raises TransmissionError: wrong number of joints, missing roles, zero reduction ...
        """
        raise NotImplementedError

    def position_to_joint(self, a: Sequence[float]) -> Sequence[float]:
        raise NotImplementedError

    def velocity_to_joint(self, a: Sequence[float]) -> Sequence[float]:
        raise NotImplementedError

    def effort_to_joint(self, a: Sequence[float]) -> Sequence[float]:
        raise NotImplementedError

    def position_to_actuator(self, j: Sequence[float]) -> Sequence[float]:
        raise NotImplementedError

    def velocity_to_actuator(self, j: Sequence[float]) -> Sequence[float]:
        raise NotImplementedError

    def effort_to_actuator(self, j: Sequence[float]) -> Sequence[float]:
        raise NotImplementedError


def _number(element: Optional[ElementTree.Element], tag: str, where: str, default: Optional[float]) -> float:
    text = element.findtext(tag) if element is not None else None
    if text is None:
        if default is None:
            raise TransmissionError(f"{where} needs <{tag}>")
        return default
    try:
        return float(text)
    except ValueError:
        raise TransmissionError(f"{where}: <{tag}>{text}</{tag}> is no number") from None


def _nonzero(values: Sequence[float], what: str) -> List[float]:
    if any(value == 0.0 for value in values):
        raise TransmissionError(f"a mechanical reduction of 0 ({what}) is impossible")
    return [float(value) for value in values]


def _by_role(entries: Sequence, roles: Sequence[str], where: str) -> List[int]:
    """Index of the entry with each role."""
    have = [entry.role for entry in entries]
    if sorted(have) != sorted(roles):
        raise TransmissionError(f"{where} needs the <role>s {', '.join(roles)}, each once; it has "
                                f"{', '.join(role or 'none' for role in have) or 'none'}")
    return [have.index(role) for role in roles]


def _check_counts(info, actuators: int, joints: int) -> None:
    for entries, wanted, kind in ((info.actuators, actuators, "actuator"), (info.joints, joints, "joint")):
        if len(entries) != wanted:
            raise TransmissionError(f"transmission '{info.name}' ({info.type}) needs {wanted} {kind}"
                                    f"{'s' if wanted > 1 else ''}, it has {len(entries)}")


class SimpleTransmission(Transmission):
    """j = a/n + o."""

    def __init__(self, reduction: float, offset: float = 0.0):
        self.reduction, = _nonzero([reduction], "actuator")
        self.offset = offset

    @classmethod
    def from_info(cls, info):
        _check_counts(info, 1, 1)
        where = f"transmission '{info.name}'"
        reduction = _number(info.actuators[0].element, "mechanicalReduction",
                            f"{where}: actuator '{info.actuators[0].name}'", None)
        offset = _number(info.joints[0].element, "offset", f"{where}: joint '{info.joints[0].name}'", 0.0)
        return cls(reduction, offset), [0], [0]

    def position_to_joint(self, a):
        return (a[0] / self.reduction + self.offset,)

    def velocity_to_joint(self, a):
        return (a[0] / self.reduction,)

    def effort_to_joint(self, a):
        return (a[0] * self.reduction,)

    def position_to_actuator(self, j):
        return ((j[0] - self.offset) * self.reduction,)

    def velocity_to_actuator(self, j):
        return (j[0] * self.reduction,)

    def effort_to_actuator(self, j):
        return (j[0] / self.reduction,)


class _TwoByTwo(Transmission):
    """Common to the transmissions between two actuators and two joints."""

    num_actuators = 2
    num_joints = 2

    def __init__(self, actuator_reduction: Sequence[float], joint_reduction: Sequence[float] = (1.0, 1.0),
                 joint_offset: Sequence[float] = (0.0, 0.0)):
        if not len(actuator_reduction) == len(joint_reduction) == len(joint_offset) == 2:
            raise TransmissionError("reductions and offsets must be two numbers each")
        self.n = _nonzero(actuator_reduction, "actuator")
        self.m = _nonzero(joint_reduction, "joint")
        self.offset = [float(value) for value in joint_offset]

    @classmethod
    def from_info(cls, info):
        _check_counts(info, 2, 2)
        where = f"transmission '{info.name}'"
        actuators = _by_role(info.actuators, ("actuator1", "actuator2"), f"{where}: actuators")
        joints = _by_role(info.joints, ("joint1", "joint2"), f"{where}: joints")
        n = [_number(info.actuators[i].element, "mechanicalReduction", f"{where}: actuator '{info.actuators[i].name}'",
                     None) for i in actuators]
        m = [_number(info.joints[i].element, "mechanicalReduction", where, 1.0) for i in joints]
        offset = [_number(info.joints[i].element, "offset", where, 0.0) for i in joints]
        return cls(n, m, offset), actuators, joints

    def position_to_joint(self, a):
        x = self.velocity_to_joint(a)
        return x[0] + self.offset[0], x[1] + self.offset[1]

    def position_to_actuator(self, j):
        return self.velocity_to_actuator((j[0] - self.offset[0], j[1] - self.offset[1]))


class DifferentialTransmission(_TwoByTwo):
    """The joints move with the sum and the difference of the actuators."""

    @classmethod
    def from_info(cls, info):
        transmission, actuators, joints = super().from_info(info)
        marks = [joint.element is not None and joint.element.find("ignoreTransmissionAbsoluteEncoder") is not None
                 for joint in info.joints]
        if any(marks) and not all(marks):
            raise TransmissionError(f"transmission '{info.name}': <ignoreTransmissionAbsoluteEncoder/> must be in both "
                                    f"joints or in none")
        transmission.direct_absolute_encoders = all(marks)
        return transmission, actuators, joints

    def velocity_to_joint(self, a):
        x, y = a[0] / self.n[0], a[1] / self.n[1]
        return (x + y) / (2.0 * self.m[0]), (x - y) / (2.0 * self.m[1])

    def effort_to_joint(self, a):
        x, y = a[0] * self.n[0], a[1] * self.n[1]
        return self.m[0] * (x + y), self.m[1] * (x - y)

    def velocity_to_actuator(self, j):
        x, y = j[0] * self.m[0], j[1] * self.m[1]
        return (x + y) * self.n[0], (x - y) * self.n[1]

    def effort_to_actuator(self, j):
        x, y = j[0] / self.m[0], j[1] / self.m[1]
        return (x + y) / (2.0 * self.n[0]), (x - y) / (2.0 * self.n[1])


class FourBarLinkageTransmission(_TwoByTwo):
    """The first actuator moves the first joint, and the second one along with it."""

    def velocity_to_joint(self, a):
        first = a[0] / (self.m[0] * self.n[0])
        return first, (a[1] / self.n[1] - first) / self.m[1]

    def effort_to_joint(self, a):
        return (self.m[0] * a[0] * self.n[0],
                self.m[1] * (a[1] * self.n[1] - a[0] * self.n[0] * self.m[0]))

    def velocity_to_actuator(self, j):
        return j[0] * self.m[0] * self.n[0], (j[0] + j[1] * self.m[1]) * self.n[1]

    def effort_to_actuator(self, j):
        return j[0] / (self.n[0] * self.m[0]), (j[0] + j[1] / self.m[1]) / self.n[1]
