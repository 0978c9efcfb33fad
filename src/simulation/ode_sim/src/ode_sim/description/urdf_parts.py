"""What the elements of a URDF say, with urdfdom's idea of what is at fault and what that costs.

urdfdom reports a fault of an ``<inertial>``, a ``<visual>`` or a ``<collision>`` and keeps the link; so does this reader: one warning, and
the part counts as 0 or is left out. A fault of a ``<joint>``, or of what holds the robot together, is the end of the robot there and here.
"""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar, cast

from ode_sim import math3
from ode_sim.description.model import FARTHEST, DescriptionError, Mimic, Pose, Vec3, quoted
from ode_sim.description.sdf_values import Numbers
from ode_sim.description.xmlsource import fault

JOINT_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
SDF_JOINT_TYPES = ("screw", "gearbox", "universal", "ball", "revolute2")  # which URDF has not
TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)  # to the end: what a C++ stream reads as a whole
_XACRO = "; this is xacro text, run it through 'rosrun xacro xacro FILE' first"
Read = TypeVar("Read")


@dataclass(frozen=True)
class Limit:
    lower: float = 0.0
    upper: float = 0.0
    effort: float = 0.0
    velocity: float = 0.0


@dataclass(frozen=True)
class JointParts:
    """A ``<joint>``; ``axis`` is 0 0 0 where an ``<axis>`` tells none. ``losses``: damping and friction."""

    type: str
    pose: Pose
    axis: Vec3 = (1.0, 0.0, 0.0)
    limit: Limit | None = None
    mimic: Mimic | None = None
    losses: tuple[float, float] | None = None


# ------------------------------------------------------------------------------------------------ attributes


def name_of(element: ET.Element, key: str = "name") -> str:
    """The attribute ``key`` of ``element``. :raises DescriptionError: not there, or empty."""
    value = (element.get(key) or "").strip()
    if not value:
        raise fault(element, f"attribute '{key}' is missing")
    return value


def number(element: ET.Element, key: str, default: float | None = None) -> float:
    """The attribute ``key`` of ``element``.

    :param default: where the attribute is not there; without one it must be.
    :raises DescriptionError: no number, or none at all.
    """
    text = element.get(key)
    if text is None:
        if default is None:
            raise fault(element, f"attribute '{key}' is missing; it is a number")
        return default
    value = _value(text)
    if value is None:
        raise fault(element, f"{key}='{quoted(text)}' is not a number{_hint(text)}")
    return value


def floats(element: ET.Element, key: str, default: Numbers) -> Numbers:
    """The numbers of the attribute ``key`` of ``element``, as many as ``default`` has.

    :raises DescriptionError: more, or less, or something else.
    """
    text = element.get(key)
    if text is None:
        return default
    values = [_value(word) for word in text.split()]
    if len(values) != len(default) or None in values:
        raise fault(element, f"{key}='{quoted(text)}' is not {len(default)} numbers{_hint(text)}")
    return cast(Numbers, tuple(values))


def origin(parent: ET.Element) -> Pose:
    """The ``<origin>`` of ``parent``. :raises DescriptionError: no numbers, or farther away than :data:`FARTHEST`."""
    element = parent.find("origin")
    if element is None:
        return math3.IDENTITY
    xyz, rpy = floats(element, "xyz", (0.0, 0.0, 0.0)), floats(element, "rpy", (0.0, 0.0, 0.0))
    if max(map(abs, xyz)) > FARTHEST:
        raise fault(element, f"xyz='{quoted(element.get('xyz'))}' is farther away than {FARTHEST:g} m")
    return math3.from_rpy(*xyz, *rpy)


def is_xacro(error: DescriptionError) -> bool:
    """Whether ``error`` says that xacro was not run: then nothing else of the text makes sense."""
    return error.message.endswith(_XACRO)


def _value(text: str) -> float | None:
    if not _NUMBER.fullmatch(text):
        return None
    value = float(text)
    return value if math.isfinite(value) else None


def _hint(text: str) -> str:
    if "${" in text or "$(" in text:
        return _XACRO
    if re.search(r"\d,\d", text):
        return "; decimals are written with a point"
    return ""


# ------------------------------------------------------------------------------------------------ links


def inertial(element: ET.Element, problems: Callable[[DescriptionError], None]) -> tuple[float, Pose, tuple[float, ...]]:
    """Mass (kg), pose and tensor (kg m^2) of ``element``, an ``<inertial>``; what is at fault is 0, and goes to ``problems``."""

    def read(value: Callable[[], Read], otherwise: Read) -> Read:
        try:
            return value()
        except DescriptionError as error:
            problems(error)
            return otherwise

    mass = read(lambda: number(part(element, "mass"), "value"), 0.0)
    pose = read(lambda: origin(element), math3.IDENTITY)
    nothing: tuple[float, ...] = (0.0,) * len(TENSOR)
    tensor = read(lambda: tuple(number(part(element, "inertia"), key) for key in TENSOR), nothing)
    return mass, pose, tensor


def part(inertial: ET.Element, tag: str) -> ET.Element:
    """The child ``tag`` of ``inertial``. :raises DescriptionError: it is not there."""
    found = inertial.find(tag)
    if found is None:
        raise fault(inertial, f"<{tag}> is missing")
    return found


def shape(element: ET.Element) -> tuple[ET.Element, Pose]:
    """The shape in the ``<geometry>`` of ``element``, a visual or collision, and its pose in the link.

    :raises DescriptionError: what urdfdom would not take.
    """
    pose = origin(element)
    geometry = element.find("geometry")
    if geometry is None or len(geometry) == 0:
        raise fault(element, "it has no shape in its <geometry>")
    form = geometry[0]
    sizes: tuple[float, ...] = ()
    if form.tag == "box":
        if form.get("size") is None:
            raise fault(form, "attribute 'size' is missing; it is 3 numbers")
        sizes = floats(form, "size", (0.0, 0.0, 0.0))
    elif form.tag in ("cylinder", "capsule"):
        sizes = number(form, "length"), number(form, "radius")
    elif form.tag == "sphere":
        sizes = (number(form, "radius"),)
    elif form.tag == "mesh":
        if form.get("filename") is None:
            raise fault(form, "attribute 'filename' is missing")
        mesh_scale(form)
    else:
        raise fault(form, "unknown shape; use box, cylinder, sphere or mesh")
    if not all(0.0 <= size <= FARTHEST for size in sizes):
        raise fault(form, f"size {' '.join(f'{s:g}' for s in sizes)}; sizes must be positive and at most {FARTHEST:g} m")
    if element.tag == "visual":
        material = element.find("material")
        if material is not None and material.get("name") is None:
            raise fault(material, "attribute 'name' is missing")
    return form, pose


def mesh_scale(mesh: ET.Element) -> tuple[float, ...]:
    """Three numbers, ``mesh``'s scale; one stands for all three axes."""
    words = (mesh.get("scale") or "").split()
    return floats(mesh, "scale", (1.0, 1.0, 1.0)) if len(words) != 1 else (number(mesh, "scale"),) * 3


# ------------------------------------------------------------------------------------------------ joints


def joint(element: ET.Element, name: str, problems: Callable[[ET.Element, str], None]) -> JointParts:
    """What ``element``, the ``<joint>`` ``name``, says.

    :param problems: takes what is odd and does no harm.
    :raises DescriptionError: whatever ends the robot in urdfdom.
    """
    kind = name_of(element, "type")
    if kind not in JOINT_TYPES:
        also = f" ('{kind}' is of SDF alone)" if kind in SDF_JOINT_TYPES else ""
        raise fault(element, f"unknown type '{quoted(kind)}'{also}; use one of {', '.join(JOINT_TYPES)}")
    limits, axis = element.find("limit"), element.find("axis")
    if kind in ("revolute", "prismatic") and limits is None:
        raise fault(
            element,
            f"a {kind} joint needs <limit lower upper effort velocity/>" + ("; or make it continuous" if kind == "revolute" else ""),
        )
    xyz = (1.0, 0.0, 0.0)
    if axis is not None and kind not in ("floating", "fixed"):
        xyz = floats(axis, "xyz", (0.0, 0.0, 0.0))
    limit = (
        None
        if limits is None
        else Limit(
            *(number(limits, key, default) for key, default in (("lower", 0.0), ("upper", 0.0), ("effort", None), ("velocity", None)))
        )
    )
    _check_what_is_not_simulated(element)
    return JointParts(kind, origin(element), xyz, limit, _mimic(element, name, problems), _losses(element))


def _mimic(element: ET.Element, name: str, problems: Callable[[ET.Element, str], None]) -> Mimic | None:
    mimic = element.find("mimic")
    if mimic is None:
        return None
    followed = mimic.get("joint")
    if followed is None:
        raise fault(mimic, "attribute 'joint' is missing")
    factor, offset = number(mimic, "multiplier", 1.0), number(mimic, "offset", 0.0)
    if not followed.strip():
        problems(mimic, f"joint '{quoted(name)}' mimics a joint without a name; it moves by itself")
        return None
    return Mimic(followed.strip(), factor, offset)


def _losses(element: ET.Element) -> tuple[float, float] | None:
    dynamics = element.find("dynamics")
    if dynamics is None:
        return None
    if dynamics.get("damping") is None and dynamics.get("friction") is None:
        raise fault(dynamics, "neither 'damping' nor 'friction' is given")
    return number(dynamics, "damping", 0.0), number(dynamics, "friction", 0.0)


def _check_what_is_not_simulated(element: ET.Element) -> None:
    safety, calibration = element.find("safety_controller"), element.find("calibration")
    if safety is not None:
        for key in ("soft_lower_limit", "soft_upper_limit", "k_position"):
            number(safety, key, 0.0)
        number(safety, "k_velocity")
    if calibration is not None:
        for key in ("rising", "falling"):
            number(calibration, key, 0.0)


# ------------------------------------------------------------------------------------------------ robot


def check_robot(robot: ET.Element) -> None:
    """:raises DescriptionError: ``robot`` is of another version of URDF than 1.0, or has two materials of a name."""
    version = robot.get("version")
    if version is not None and not re.fullmatch(r"\s*\+?0*1\.\s*\+?0+", version):
        raise fault(robot, f"version='{quoted(version)}'; there is URDF 1.0 only, write version='1.0' or leave it out")
    names: list[str] = []
    for material in robot.findall("material"):
        name = material.get("name") or ""
        if name in names:
            raise fault(material, "a material of this name is there already" if name else "a second material without a name")
        names.append(name)
