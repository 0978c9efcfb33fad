"""SDF 1.0, whose values are attributes (``<mass>`` was ``mass="2"``), in the form of the later ones: what sdformat's 1_0.convert does."""

from __future__ import annotations

from ode_sim.description.xmlsource import Element, child, text_of

_NAMES = ("name", "version", "type")  # attributes ever since
_VALUES = {"rgba", "xyz", "enabled", "angle", "link", "pose"}  # what is the element's own text later
_TAGS = {"origin": "pose", "damping": "velocity_decay"}
_ATTRIBUTES = {  # what is called otherwise as an element
    ("fog", "rgba"): "color",
    ("heightmap", "origin"): "pos",
    ("heightmap", "filename"): "uri",
    ("mesh", "filename"): "uri",
}
_OF_TYPES = ("solver", "fog")  # whose type is an element
_WITH_PARTS = ("axis", "axis2", "waypoint")  # whose xyz or pose is an element


def attributes_to_elements(root: Element) -> None:
    """All of ``root`` but what its plugins are told."""
    waiting = [root]
    while waiting:
        element = waiting.pop()
        if element.tag != "plugin":
            waiting += element  # type: ignore[arg-type]  # the parser makes Elements alone
            _convert(element)


def _convert(element: Element) -> None:
    for key, value in list(element.items()):
        if key in _NAMES and not (key == "type" and element.tag in _OF_TYPES):
            continue
        del element.attrib[key]
        if (element.tag, key) in _ATTRIBUTES:
            child(element, _ATTRIBUTES[element.tag, key], value)
        elif (element.tag, key) == ("material", "script"):
            child(child(element, "script"), "name", value)
        elif key in _VALUES and element.tag not in _WITH_PARTS and not text_of(element):
            element.text = value
        else:
            child(element, key, value)
    if element.tag == "origin" or (element.tag == "damping" and len(element)):
        element.tag = _TAGS[element.tag]
