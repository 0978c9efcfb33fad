"""``<transmission>`` elements of a URDF. Bad ones are left out one by one, each with a line saying why."""

from __future__ import annotations

from dataclasses import dataclass, field
from xml.etree import ElementTree

from hardware_interface import description_root

from .errors import TransmissionError


@dataclass(frozen=True)
class JointInfo:
    """A joint of a transmission; ``hardware_interfaces`` as written, e.g. hardware_interface/EffortJointInterface."""

    name: str
    hardware_interfaces: tuple[str, ...]
    role: str = ""
    element: ElementTree.Element | None = field(default=None, repr=False, compare=False)


@dataclass(frozen=True)
class ActuatorInfo:
    """An actuator of a transmission."""

    name: str
    hardware_interfaces: tuple[str, ...] = ()
    role: str = ""
    element: ElementTree.Element | None = field(default=None, repr=False, compare=False)


@dataclass(frozen=True)
class TransmissionInfo:
    """One ``<transmission>``; ``type`` is its plugin name."""

    name: str
    type: str
    joints: tuple[JointInfo, ...]
    actuators: tuple[ActuatorInfo, ...]


class _Skip(Exception):
    """This transmission cannot be used; the line continues 'transmission X is left out: '."""


def _text(element: ElementTree.Element, tag: str) -> str:
    return (element.findtext(tag) or "").strip()


def _interfaces(element: ElementTree.Element) -> tuple[str, ...]:
    texts = ((entry.text or "").strip() for entry in element.iterfind("hardwareInterface"))
    return tuple(text for text in texts if text)


def _parse_one(element: ElementTree.Element, name: str, problems: list[str]) -> TransmissionInfo:
    kind = _text(element, "type")
    if not kind:
        raise _Skip("it has no <type>, e.g. transmission_interface/SimpleTransmission")
    joints = []
    for entry in element.iterfind("joint"):
        joint = entry.get("name")
        if joint is None:
            raise _Skip("a <joint> in it has no name attribute")
        interfaces = _interfaces(entry)
        if not joint or not interfaces:
            problems.append(
                f"transmission '{name}': joint '{joint}' is left out: "
                + (
                    "its name is empty"
                    if not joint
                    else "it has no <hardwareInterface>, which belongs into <joint> (the one in <actuator> does not count), "
                    "e.g. <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>"
                )
            )
            continue
        joints.append(JointInfo(joint, interfaces, _text(entry, "role"), entry))
    if not joints:
        raise _Skip("it has no usable <joint>")
    actuators = []
    for entry in element.iterfind("actuator"):
        actuator = entry.get("name")
        if actuator is None:
            raise _Skip("an <actuator> in it has no name attribute")
        if not actuator:
            problems.append(f"transmission '{name}': an <actuator> is left out: its name is empty")
            continue
        actuators.append(ActuatorInfo(actuator, _interfaces(entry), _text(entry, "role"), entry))
    if not actuators:
        raise _Skip('it has no <actuator name="...">')
    return TransmissionInfo(name, kind, tuple(joints), tuple(actuators))


def parse_transmissions(urdf: str) -> tuple[list[TransmissionInfo], list[str]]:
    """The usable transmissions of ``urdf``, a text, in file order, and a line for each thing that is left out.

    :raises TransmissionError: the text is no XML.
    """
    try:
        root = description_root(urdf)
    except ElementTree.ParseError as error:
        raise TransmissionError(f"the robot description is no valid XML: {error}") from None
    found: list[TransmissionInfo] = []
    problems: list[str] = []
    for index, element in enumerate(root.iterfind("transmission")):
        name = element.get("name", "")
        try:
            if not name:
                raise _Skip("it has no name")
            found.append(_parse_one(element, name, problems))
        except _Skip as reason:
            problems.append(f"transmission '{name or f'number {index + 1}'}' is left out: {reason}")
    return found, problems
