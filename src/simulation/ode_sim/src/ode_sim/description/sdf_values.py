"""Numbers, vectors, colours and poses of SDF, with defaults and warnings."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from typing import TypeVar, cast, overload

from ode_sim import math3
from ode_sim.description.finder import ResourceFinder
from ode_sim.description.model import FARTHEST, Pose, Problem, Rgba, Source, quoted
from ode_sim.description.xmlsource import fault, is_true, leading_numbers, source_of, text_of

Numbers = TypeVar("Numbers", bound=tuple[float, ...])

LONGEST = 1e100  # of vectors that only tell a direction; the square of a longer one is infinite
_BRIGHTEST = 1e6  # of colours, which are 0..1


class SdfValues:
    """Reads values of one file or text; collects :attr:`problems` on the way."""

    def __init__(self, finder: ResourceFinder | None = None, base: str = ""):
        """:param base: directory that relative file names are tried in first."""
        self.finder = finder or ResourceFinder()
        self.base = base
        self.problems: list[Problem] = []
        self._missing: set[str] = set()  # names reported as not found
        self._noticed: set[Problem] = set()

    # ------------------------------------------------------------------ values

    def warn(self, element: ET.Element | Source | None, message: str, severity: str = "warning") -> None:
        """Add ``message`` about ``element`` to the problems, once; ``severity`` is "note", "warning" or "error"."""
        source = element if isinstance(element, Source) else source_of(element) if element is not None else Source()
        problem = Problem(severity, message, source)
        if problem not in self._noticed:
            self._noticed.add(problem)
            self.problems.append(problem)

    def warn_of_text(self, root: ET.Element) -> None:
        """What of the text of ``root`` was read otherwise than it is written."""
        for line, what in getattr(root, "oddities", ()):
            self.warn(Source(getattr(root, "file", ""), line), f"{what}; the text is not well-formed XML, Gazebo reads it so")

    def warn_missing(self, element: ET.Element, uri: str, consequence: str) -> None:
        """One warning for each ``uri`` that is not found, however often it is used; ``element`` names it, ``consequence`` is what
        follows.
        """
        if uri not in self._missing:
            self._missing.add(uri)
            self.warn(element, f"cannot find '{quoted(uri, 200)}' ({self.finder.explain(uri)}); {consequence}")

    def numbers(self, element: ET.Element | None, default: Numbers, nan: bool = False, most: float = math.inf) -> Numbers:
        """As many numbers as ``default`` has. As in Gazebo, numbers that stand first count, whatever follows them; those
        that are missing, or are a NaN, are taken from the default, with a warning.

        :param element: whose text it is; None or an empty one is the default, without a warning.
        :param nan: the caller deals with values that are not a number.
        :param most: the largest that makes sense, of either sign; beyond it the default is taken, with a warning.
        """
        text = text_of(element)
        if element is None or not text:
            return default
        values = leading_numbers(text, len(default))
        if not nan and any(math.isnan(value) for value in values):
            problem, values = "is not a number", default
        elif most < math.inf and any(abs(value) > most for value in values):
            problem, values = f"is beyond {most:g}", default
        elif len(values) < len(default):
            problem = f"is not {len(default)} number{'s' * (len(default) > 1)}"
            values += default[len(values) :]
        else:
            return cast(Numbers, values)
        self.warn(element, f"'{quoted(text)}' {problem}; using {' '.join(f'{v:g}' for v in values)}")
        return cast(Numbers, values)

    def number(self, parent: ET.Element | None, path: str, default: float, nan: bool = False, most: float = math.inf) -> float:
        """The number at ``path`` below ``parent``; ``default``, ``nan`` and ``most`` as for :meth:`numbers`."""
        return self.numbers(parent.find(path), (default,), nan, most)[0] if parent is not None else default

    def between(self, parent: ET.Element | None, path: str, default: float, lowest: float, highest: float) -> float:
        """The number at ``path`` below ``parent``, if it is from ``lowest`` to ``highest``; else ``default``, with a warning."""
        value = self.number(parent, path, default)
        if not lowest <= value <= highest:
            self.warn(
                parent.find(path) if parent is not None else None, f"{value:g} is not between {lowest:g} and {highest:g}; using {default:g}"
            )
            return default
        return value

    def whole(self, parent: ET.Element | None, path: str, default: int, lowest: int, highest: int) -> int:
        """As :meth:`between` of ``parent``, ``path``, ``default``, ``lowest`` and ``highest``, without what is behind the decimal point."""
        return int(self.between(parent, path, default, lowest, highest))

    def vector(self, parent: ET.Element | None, path: str, default: Numbers, most: float = math.inf) -> Numbers:
        """The numbers at ``path`` below ``parent``, as many as ``default`` has; ``most`` as for :meth:`numbers`."""
        return self.numbers(parent.find(path), default, most=most) if parent is not None else default

    @staticmethod
    def boolean(parent: ET.Element, path: str, default: bool) -> bool:
        """Whether the text at ``path`` below ``parent`` is true; ``default`` where there is none."""
        text = text_of(parent.find(path))
        return is_true(text) if text else default

    @overload
    def rgba(self, parent: ET.Element | None, tag: str, default: None = None) -> Rgba | None: ...

    @overload
    def rgba(self, parent: ET.Element | None, tag: str, default: Rgba) -> Rgba: ...

    def rgba(self, parent: ET.Element | None, tag: str, default: Rgba | None = None) -> Rgba | None:
        """The colour ``tag`` of ``parent``, red green blue alpha from 0 to 1, alpha 1 where three are given; else ``default``."""
        element = parent.find(tag) if parent is not None else None
        if element is None or not text_of(element):
            return default
        if len(text_of(element).split(None, 3)) > 3:
            return self.numbers(element, (0.0, 0.0, 0.0, 1.0), most=_BRIGHTEST)
        return (*self.numbers(element, (0.0, 0.0, 0.0), most=_BRIGHTEST), 1.0)

    def pose(self, element: ET.Element | None) -> Pose:
        """The numbers of ``element``, a ``<pose>``, whatever frame they are in; None is no shift and no turn.

        :raises DescriptionError: not finite, or farther away than :data:`FARTHEST`.
        """
        text = text_of(element)
        if element is None or not text:
            return math3.IDENTITY
        by_quaternion = element.get("rotation_format") == "quat_xyzw"
        count = 7 if by_quaternion else 3 if len(text.split(None, 4)) == 3 else 6
        values: tuple[float, ...] = self.numbers(element, ((0.0,) * 6 + (1.0,))[:count], nan=True)
        if not all(math.isfinite(value) for value in values):
            raise fault(element, f"'{quoted(text)}' is not a pose; give finite values")
        if max(abs(value) for value in values[:3]) > FARTHEST:
            raise fault(element, f"'{quoted(text)}' is farther away than {FARTHEST:g} m")
        if by_quaternion:
            if max(abs(value) for value in values[3:]) > LONGEST:
                raise fault(element, f"'{quoted(text)}' is not a pose; give a unit quaternion")
            return Pose((values[0], values[1], values[2]), math3.quat_normalize(values[3:]))
        if is_true(element.get("degrees") or ""):
            values = values[:3] + tuple(math.radians(v) for v in values[3:])
        return math3.from_rpy(*values)
