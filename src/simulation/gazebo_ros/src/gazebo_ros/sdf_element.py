"""Lenient reading of an SDF element, as plugins of Gazebo Classic read theirs."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable

from ode_sim.description.xmlsource import leading_numbers


class SdfElement:
    """One XML element with typed access to its children.

    :param element: the XML element
    :param warn: called with one line when a value cannot be read and the default is used instead
    """

    def __init__(self, element: ET.Element, warn: Callable[[str], None] = lambda line: None):
        self.element = element
        self._warn = warn

    @property
    def name(self) -> str:
        return self.element.tag

    @property
    def attrib(self) -> dict[str, str]:
        return self.element.attrib

    @property
    def text(self) -> str:
        """The element's own text without surrounding white space."""
        return (self.element.text or "").strip()

    def has(self, tag: str) -> bool:
        """Whether there is a child ``<tag>``."""
        return self.element.find(tag) is not None

    def child(self, tag: str) -> SdfElement | None:
        """The first child ``<tag>``, or None."""
        found = self.element.find(tag)
        return None if found is None else SdfElement(found, self._warn)

    def children(self, tag: str | None = None) -> list[SdfElement]:
        """All children (``<tag>`` alone, if it is given), in file order."""
        return [SdfElement(e, self._warn) for e in self.element if isinstance(e.tag, str) and tag in (None, e.tag)]

    def text_or(self, tag: str, default: str) -> str:
        """Text of the first child ``tag``; ``default`` when it is missing or empty."""
        return self.get(tag, default) or default

    def get(self, tag: str, default=""):
        """Value of the first child ``tag``, converted to the type of ``default``.

        Numbers may be followed by anything, as a C++ stream reads them (``0.3m`` is 0.3); a bool is true for ``true``
        and ``1`` in any case, else false; a tuple default of n floats reads n numbers, and stands in for those that are
        missing. With ``default=None`` the text, or None. A missing or empty element gives the default (an empty one the
        empty string when a text is wanted); an unreadable one gives it with a warning.

        >>> SdfElement(ET.fromstring("<plugin><rate> 30.0 </rate></plugin>")).get("rate", 0.0)
        30.0
        """
        found = self.element.find(tag)
        if found is None:
            return default
        text = (found.text or "").strip()
        if default is None or isinstance(default, str):
            return text
        if not text:
            return default
        if isinstance(default, bool):
            return text.lower() in ("true", "1")
        count = len(default) if isinstance(default, tuple) else 1
        numbers = leading_numbers(text, count)
        if len(numbers) < count:
            wanted = "a number" if count == 1 else f"{count} numbers"
            used = numbers + default[len(numbers) :] if isinstance(default, tuple) else default
            self._warn(f"<{tag}>{text}</{tag}>: {wanted} expected, using {used}")
            return used
        if isinstance(default, tuple):
            return numbers
        if isinstance(default, int):
            try:
                return int(numbers[0])
            except (ValueError, OverflowError):
                self._warn(f"<{tag}>{text}</{tag}>: a whole number expected, using {default}")
                return default
        return numbers[0]
