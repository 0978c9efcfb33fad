"""SDF text to its root element, in the form of SDF 1.7 where older versions mean something else."""

from __future__ import annotations

from typing import cast

from ode_sim.description.model import quoted
from ode_sim.description.sdf_oldest import attributes_to_elements
from ode_sim.description.xmlsource import Element, child, fault, is_true, parse_xml, text_of

ENTITIES = ("model", "light", "actor")


def parse_sdf(text: str | bytes, file: str = "") -> Element:
    """The ``<sdf>`` element of ``text`` (``<gazebo>`` in files before 1.3, or a bare ``<world>``, ``<model>``, ``<light>``).

    :param file: where the text is from, for messages.
    :raises DescriptionError: not XML, or not SDF.
    """
    return sdf_root(parse_xml(text, file))


def sdf_root(root: Element) -> Element:
    """As :func:`parse_sdf`, of the root element of a text."""
    if root.tag in ENTITIES + ("world",):
        wrapper = Element("sdf", {"version": "1.6"})
        wrapper.file, wrapper.line = root.file, root.line
        wrapper.append(root)
        wrapper.oddities = root.oddities
        root = wrapper
    if root.tag not in ("sdf", "gazebo"):
        raise fault(root, "not SDF; expected <sdf version='1.6'> as the root element")
    if _version(root) <= (1, 0):
        attributes_to_elements(root)
    if _version(root) <= (1, 6):
        _say_frames_of_axes(root, in_model=_version(root) <= (1, 4))
    return root


def _say_frames_of_axes(root: Element, in_model: bool) -> None:
    """``<use_parent_model_frame>`` of 1.5 and 1.6 as 1.7 says it; what has none is in the model's frame up to 1.4."""
    for axis in list(root.iter("axis")) + list(root.iter("axis2")):
        flag = axis.find("use_parent_model_frame")
        if is_true(text_of(flag)) if flag is not None else in_model:
            if flag is not None:
                axis.remove(flag)
            xyz = axis.find("xyz")
            if xyz is None:
                xyz = child(axis, "xyz", "0 0 1")
            xyz.set("expressed_in", xyz.get("expressed_in") or "__model__")


def _version(root: Element) -> tuple[int, ...]:
    try:
        return tuple(int(part) for part in root.get("version", "1.6").split("."))
    except ValueError:
        raise fault(root, f"'{quoted(root.get('version'))}' is no SDF version; use 1.4 to 1.7") from None


def first_entity(root: Element) -> Element:
    """The first model, light or actor of ``root``, an ``<sdf>`` element, also when it lies in a ``<world>``.

    :raises DescriptionError: there is none.
    """
    for parent in [root] + root.findall("world"):
        for element in parent:
            if element.tag in ENTITIES:
                return cast(Element, element)
    raise fault(root, "holds no <model>, <light> or <actor>")
