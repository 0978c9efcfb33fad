"""Text or files to worlds, models and lights: the front door of the readers."""

from __future__ import annotations

import os
import xml.etree.ElementTree as ET
from typing import cast

from ode_sim.description.finder import ResourceFinder
from ode_sim.description.model import DescriptionError, Light, Model, Problem, World, quoted
from ode_sim.description.sdf import SdfReader
from ode_sim.description.sdf_document import ENTITIES, first_entity, parse_sdf, sdf_root
from ode_sim.description.urdf import urdf_to_model
from ode_sim.description.xmlsource import Element, fault, parse_xml, read_bytes


def load_world(path_or_text: str, finder: ResourceFinder | None = None) -> tuple[World, list[Problem]]:
    """A world from ``path_or_text``: XML text (it starts with ``<``), a path, a URI, or a name such as ``worlds/empty.world``.

    :param finder: of the files that it names; None is a :class:`ResourceFinder` of the environment.
    :returns: the world, and what was noticed while reading it, in file order.
    :raises DescriptionError: no such file, not XML, or no ``<world>`` in it.
    """
    finder = finder or ResourceFinder()
    if path_or_text.lstrip("\ufeff \t\r\n").startswith("<"):
        file = ""
        text: str | bytes = path_or_text
    else:
        file = finder.find_world(path_or_text) or ""
        if not file:
            known = ", ".join(finder.stock_worlds())
            raise DescriptionError(
                f"cannot find world '{quoted(path_or_text, 200)}' ({finder.explain(path_or_text)})"
                + (f"; worlds that come with the simulator: {known}" if known else "")
            )
        text = read_bytes(file)
    root = parse_sdf(text, file)
    world = root.find("world")
    if world is None:
        raise fault(root, "holds no <world>")
    reader = SdfReader(finder, os.path.dirname(file))
    reader.warn_of_text(root)
    return reader.world(world), reader.problems


class Entity:
    """A text to spawn, parsed once: :attr:`kind` says what it is, :meth:`model` or :meth:`light` reads it, once.

    :param file: where the text is from: for messages, and for file names relative to it.
    :param finder: of the files that it names; None is a ResourceFinder of the environment.
    :raises DescriptionError: neither URDF nor SDF, nothing in it to spawn, or not XML.
    """

    def __init__(self, text: str, finder: ResourceFinder | None = None, file: str = ""):
        root = parse_xml(text, file)
        self._reader = SdfReader(finder, os.path.dirname(file))
        self._reader.warn_of_text(root)
        #: ``urdf``, ``model``, ``light`` or ``actor``
        self.kind = "urdf"
        if root.tag == "robot":
            self._element: ET.Element = root
            return
        if root.tag not in ("sdf", "gazebo", "world") + ENTITIES:
            raise fault(root, "neither URDF nor SDF; expected <robot> or <sdf> as the root element")
        self._element = _entity(self._reader, root)
        self.kind = self._element.tag

    def model(self, name: str | None = None) -> tuple[Model, list[Problem]]:
        """The model, and what was noticed while reading it. :param name: takes the place of the one in the text."""
        self._call_it(name)
        if self.kind == "urdf":
            model = urdf_to_model(cast(Element, self._element), self._reader)
        elif self.kind in ("model", "actor"):
            model = self._reader.model(self._element)
        else:
            raise fault(self._element, "is no <model>")
        return model, self._reader.problems

    def light(self, name: str | None = None) -> tuple[Light, list[Problem]]:
        """The light, with ``name`` as for :meth:`model`."""
        if self.kind != "light":
            raise fault(self._element, "is no <light>")
        self._call_it(name)
        return self._reader.light(self._element), self._reader.problems

    def _call_it(self, name: str | None) -> None:
        # in the text, as Gazebo does: there it may have none
        if name:
            self._element.set("name", name)


def root_kind(text: str, finder: ResourceFinder | None = None) -> str:
    """What a text to spawn is: ``urdf``, ``model``, ``light`` or ``actor``. ``finder``: as for :func:`load_world`.

    :raises DescriptionError: none of these, or not XML.
    """
    return Entity(text, finder).kind


def read_model(text: str, *, name: str | None = None, finder: ResourceFinder | None = None, file: str = "") -> tuple[Model, list[Problem]]:
    """A model from URDF or SDF text, whichever it is.

    :param name: takes the place of the one in the text.
    :param file: where the text is from: for messages, and for file names relative to it.
    :param finder: as for :func:`load_world`.
    :raises DescriptionError: not XML, or no model in it.
    """
    return Entity(text, finder, file).model(name)


def read_urdf(text: str, *, name: str | None = None, finder: ResourceFinder | None = None, file: str = "") -> tuple[Model, list[Problem]]:
    """A model from URDF text, by Gazebo's conversion rules. ``name``, ``finder``, ``file``: as for :func:`read_model`.

    :raises DescriptionError: not XML, or no robot that could be read.
    """
    reader = SdfReader(finder, os.path.dirname(file))
    root = parse_xml(text, file)
    reader.warn_of_text(root)
    if name:
        root.set("name", name)
    return urdf_to_model(root, reader), reader.problems


def read_sdf_model(
    text: str, *, name: str | None = None, finder: ResourceFinder | None = None, file: str = ""
) -> tuple[Model, list[Problem]]:
    """The first model of SDF text: ``<sdf><model>``, or in a ``<world>``, there also by ``<include>``.

    ``name``, ``finder``, ``file``: as for :func:`read_model`. :raises DescriptionError: not XML, URDF, or without a model.
    """
    entity = Entity(text, finder, file)
    if entity.kind == "urdf":
        raise DescriptionError(f"{file or 'text'}: is URDF; expected <sdf version='1.6'> as the root element")
    return entity.model(name)


def read_light(text: str, *, name: str | None = None, finder: ResourceFinder | None = None, file: str = "") -> tuple[Light, list[Problem]]:
    """The first light of SDF text. ``name``, ``finder``, ``file``: as for :func:`read_model`.

    :raises DescriptionError: not XML, or without a light.
    """
    return Entity(text, finder, file).light(name)


def _entity(reader: SdfReader, root: Element) -> ET.Element:
    """The first model or light, an ``<include>`` resolved."""
    root = sdf_root(root)
    element = _first_with_include(root)
    if element is None or element.tag != "include":
        return first_entity(root)
    included = reader.include(element)
    if included is None:
        raise DescriptionError(str(reader.problems[-1]))
    return included


def _first_with_include(root: ET.Element) -> ET.Element | None:
    for parent in [root] + root.findall("world"):
        for element in parent:
            if element.tag in ENTITIES + ("include",):
                return element
    return None
