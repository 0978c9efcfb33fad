"""A Collada file as XML with its ids, for what pycollada does not tell: skeletons and animations."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree import ElementTree

import numpy as np

from ode_sim.collada_mesh import sound_document
from ode_sim.description.model import DescriptionError, quoted
from ode_sim.mesh_files import file_content

Element = ElementTree.Element


def tag(element: Element) -> str:
    """The tag of ``element`` without its namespace."""
    return str(element.tag).rpartition("}")[2]


def children(element: Element | None, name: str) -> list[Element]:
    """The children of ``element`` with the tag ``name``; none of None."""
    return [child for child in element if tag(child) == name] if element is not None else []


def child(element: Element | None, *names: str) -> Element | None:
    """The first child of ``element`` with the first of ``names``, its first child with the next ..."""
    for name in names:
        element = next(iter(children(element, name)), None)
    return element


class ColladaTree:
    """The file ``path``. :raises DescriptionError: one line that names the file."""

    def __init__(self, path: str):
        self.path = path
        self.root = ElementTree.fromstring(sound_document(path, file_content(path, ".dae")))
        self._ids: dict[tuple[str, str], Element] = {}
        for element in self.root.iter():
            name = element.get("id")
            if name:
                self._ids.setdefault((tag(element), name), element)
        unit = child(self.root, "asset", "unit")
        self.unit = self.number(unit.get("meter", "1"), "its unit") if unit is not None else 1.0

    def fault(self, reason: str) -> DescriptionError:
        """A DescriptionError that names the file and says ``reason``."""
        return DescriptionError(f"{self.path}: {reason}")

    def number(self, text: str, what: str) -> float:
        """``text`` as a number; ``what`` it is, for the error.

        :raises DescriptionError: it is none, or not finite.
        """
        try:
            value = float(text)
        except ValueError:
            value = np.nan
        if not np.isfinite(value):
            raise self.fault(f"{what} is '{quoted(text)}', no number")
        return value

    def numbers(self, element: Element | None, what: str) -> np.ndarray:
        """(N,) the numbers in the text of ``element``; ``what`` they are, for the error.

        :raises DescriptionError: there is no element, or one is no finite number.
        """
        if element is None:
            raise self.fault(f"{what} is missing")
        try:
            values = np.array((element.text or "").split(), float)
        except ValueError:
            values = np.array([np.nan])
        if not np.isfinite(values).all():
            raise self.fault(f"{what} holds something that is no finite number")
        return values

    def matrix(self, element: Element | None, what: str) -> np.ndarray:
        """(4, 4) of the text of ``element``; ``what`` it is, for the error.

        :raises DescriptionError: as :meth:`numbers`, or they are not sixteen.
        """
        values = self.numbers(element, what)
        if len(values) != 16:
            raise self.fault(f"{what} holds {len(values)} numbers; a matrix has 16")
        return values.reshape(4, 4)

    def by_url(self, url: str | None, kind: str) -> Element | None:
        """The element with tag ``kind`` and the id ``url`` (``#`` before it or not): one of another tag may have the same id."""
        return self._ids.get((kind, (url or "").strip().lstrip("#")))

    def source(self, inputs: Element, semantic: str) -> Element | None:
        """The ``<source>`` that the ``<input>`` of meaning ``semantic`` among ``inputs``' children names."""
        found = next((entry for entry in children(inputs, "input") if entry.get("semantic") == semantic), None)
        return self.by_url(found.get("source"), "source") if found is not None else None

    def words(self, source: Element | None, what: str) -> list[str]:
        """The names in ``source``; ``what`` they are, for the error.

        :raises DescriptionError: it has none.
        """
        array = child(source, "Name_array")
        array = child(source, "IDREF_array") if array is None else array
        if array is None:
            raise self.fault(f"{what} is missing")
        return (array.text or "").split()

    def scene(self) -> Element:
        instance = child(self.root, "scene", "instance_visual_scene")
        found = self.by_url(instance.get("url"), "visual_scene") if instance is not None else None
        if found is None:
            raise self.fault("has no visual scene")
        return found

    def iter(self, name: str) -> Iterator[Element]:
        """All elements with the tag ``name``, in their order."""
        return (element for element in self.root.iter() if tag(element) == name)
