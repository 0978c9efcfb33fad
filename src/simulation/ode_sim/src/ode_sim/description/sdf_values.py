"""Numbers, vectors, colours and poses of SDF, with defaults and warnings."""
from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from typing import List, Optional, Sequence, Set, Tuple

from ode_sim import math3
from ode_sim.description.finder import ResourceFinder
from ode_sim.description.model import DescriptionError, Pose, Problem, Source
from ode_sim.description.xmlsource import is_true, source_of, text_of


class SdfValues:
    """Reads values of one file or text; collects :attr:`problems` on the way."""

    def __init__(self, finder: Optional[ResourceFinder] = None, base: str = ""):
        """:param base: directory that relative file names are tried in first."""
        self.finder = finder or ResourceFinder()
        self.base = base
        self.problems: List[Problem] = []
        self._missing: Set[str] = set()  # names reported as not found

    # ------------------------------------------------------------------ values

    def warn(self, element: Optional[ET.Element], message: str, severity: str = "warning") -> None:
        problem = Problem(severity, message, source_of(element) if element is not None else Source())
        if problem not in self.problems:
            self.problems.append(problem)

    def warn_missing(self, element: ET.Element, uri: str, consequence: str) -> None:
        """One warning for each name, however often it is used."""
        if uri not in self._missing:
            self._missing.add(uri)
            self.warn(element, f"cannot find '{uri}' ({self.finder.explain(uri)}); {consequence}")

    def numbers(self, element: Optional[ET.Element], default: Sequence[float], nan: bool = False) -> Tuple[float, ...]:
        """As many numbers as ``default`` has; the default (with a warning) when they cannot be read.

        :param nan: the caller deals with values that are not a number; otherwise they are refused.
        """
        text = text_of(element)
        if not text:
            return tuple(default)
        try:
            values = tuple(float(word) for word in text.split())
        except ValueError:
            values = ()
        if not nan and any(math.isnan(value) for value in values):
            raise DescriptionError(f"{source_of(element)}: '{text}' is not a number; give finite values")
        if len(values) < len(default):
            self.warn(element, f"'{text}' is not {len(default)} number{'s' * (len(default) > 1)}; "
                               f"using {' '.join(f'{v:g}' for v in default)}")
            return tuple(default)
        return values[:len(default)]

    def number(self, parent: Optional[ET.Element], path: str, default: float, nan: bool = False) -> float:
        return self.numbers(parent.find(path), (default,), nan)[0] if parent is not None else default

    def vector(self, parent: Optional[ET.Element], path: str, default):
        return self.numbers(parent.find(path), default) if parent is not None else tuple(default)

    @staticmethod
    def boolean(parent: ET.Element, path: str, default: bool) -> bool:
        text = text_of(parent.find(path))
        return is_true(text) if text else default

    def rgba(self, parent: Optional[ET.Element], tag: str, default=None):
        element = parent.find(tag) if parent is not None else None
        if element is None or not text_of(element):
            return default
        words = text_of(element).split()
        return self.numbers(element, (0.0, 0.0, 0.0, 1.0)) if len(words) > 3 else \
            (*self.numbers(element, (0.0, 0.0, 0.0)), 1.0)

    def pose(self, element: Optional[ET.Element]) -> Pose:
        """The numbers of a ``<pose>``, whatever frame they are in."""
        text = text_of(element)
        if not text:
            return math3.IDENTITY
        if element.get("rotation_format") == "quat_xyzw":
            values = self.numbers(element, (0.0,) * 6 + (1.0,))
            return Pose(values[:3], math3.quat_normalize(values[3:]))
        if len(text.split()) == 3:
            return Pose(self.numbers(element, (0.0,) * 3))
        values = self.numbers(element, (0.0,) * 6)
        if element.get("degrees") is not None and is_true(element.get("degrees")):
            values = values[:3] + tuple(math.radians(v) for v in values[3:])
        if not all(math.isfinite(value) for value in values):
            raise DescriptionError(f"{source_of(element)}: '{text}' is not a pose; give finite values")
        return math3.from_rpy(*values)
