"""Can a body have this inertia?"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import numpy as np

_ROUNDING = 1e-6  # of the moments: descriptions are written with so many digits
_LARGEST = 10.0  # m


def number(element: ET.Element | None, name: str, default: str = "") -> float:
    """The number of ``element`` that is called ``name``: an attribute, as URDF has it, or an element in it, as SDF does.

    :param default: of what is not written
    :raises ValueError: the element, what is called so, or a finite number in it is missing
    """
    text = None if element is None else element.get(name, element.findtext(name))
    value = float(default if text is None else text)
    if not math.isfinite(value):
        raise ValueError(f"{name} is {value}")
    return value


def insane(link: ET.Element) -> str:
    """Why the inertia of ``link``, of URDF or SDF, cannot be, '' when it can, or when there is none."""
    inertial = link.find("inertial")
    if inertial is None:
        return ""
    name = link.get("name")
    try:
        mass, tensor = _mass(inertial), _tensor(inertial.find("inertia"))
    except ValueError:
        return f"the inertia of link '{name}' is not complete, or holds what is no finite number"
    if mass <= 0 or min(tensor.diagonal()) <= 0:
        return f"link '{name}' has a mass or a moment of inertia that is not positive"
    moments = np.linalg.eigvalsh(tensor)
    principal = bool(np.triu(tensor, 1).any())
    told = ", ".join(f"{moment:g}" for moment in (moments if principal else tensor.diagonal())) + " about its principal axes" * principal
    if moments[0] <= 0:
        return f"the moments of inertia of link '{name}' ({told}) belong to no body: its products of inertia are too large for them"
    if 2 * moments[2] > moments.sum() * (1 + _ROUNDING):
        return f"the moments of inertia of link '{name}' ({told}) belong to no body: none may exceed the sum of the others"
    radius = math.sqrt(moments[2] / mass)
    if radius > _LARGEST:
        return f"link '{name}' of {mass:g} kg has the inertia of a body {radius:.0f} m across; wrong units?"
    return ""


def _mass(inertial: ET.Element) -> float:
    """:raises ValueError: it is missing, or no finite number"""
    mass = inertial.find("mass")
    return number(inertial, "mass") if mass is not None and mass.get("value") is None else number(mass, "value")


def _tensor(inertia: ET.Element | None) -> np.ndarray:
    """:raises ValueError: one of the moments is missing, or a number is not finite"""
    xx, yy, zz = (number(inertia, key) for key in ("ixx", "iyy", "izz"))
    xy, xz, yz = (number(inertia, key, "0") for key in ("ixy", "ixz", "iyz"))
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
