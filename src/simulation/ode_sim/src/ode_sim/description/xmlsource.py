"""XML text to elements that know their line, with the tolerance of Gazebo's own parser."""
from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from typing import Optional, Union
from xml.parsers import expat

from ode_sim.description.model import DescriptionError, Source

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)


class Element(ET.Element):
    """An ElementTree element with the ``line`` (from 1) and ``file`` it was read from; 0 and '' if made here."""

    line: int = 0
    file: str = ""
    include_chain: tuple = ()  # of a model that was included: the URIs that led to it


def parse_xml(text: Union[str, bytes], file: str = "") -> Element:
    """Root element of ``text``. Prefixes of namespaces stay part of the tag names, declared or not.

    As Gazebo's parser does, it tolerates blank lines before the XML declaration, ``--`` inside comments and anything
    after the root element.

    :raises DescriptionError: not well-formed; the line of text is quoted.
    """
    if isinstance(text, bytes):
        try:
            text = text.decode("utf-8")
        except UnicodeDecodeError:
            text = text.decode("latin-1")
    text = text.lstrip("\ufeff")
    text = _COMMENT.sub(lambda match: "\n" * match.group().count("\n"), text)
    body = text.lstrip()
    skipped = text.count("\n", 0, len(text) - len(body))

    stack: list[Element] = []
    root: Optional[Element] = None
    parser = expat.ParserCreate("utf-8")
    parser.buffer_text = True

    def start(tag, attrib):
        nonlocal root
        element = Element(tag, attrib)
        element.line = parser.CurrentLineNumber + skipped
        element.file = file
        if stack:
            stack[-1].append(element)
        elif root is None:
            root = element
        stack.append(element)

    def characters(data):
        if not stack:
            return
        parent = stack[-1]
        if len(parent):
            parent[-1].tail = (parent[-1].tail or "") + data
        else:
            parent.text = (parent.text or "") + data

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: stack.pop()
    parser.CharacterDataHandler = characters
    try:
        parser.Parse(body.encode("utf-8", "replace"), True)
    except expat.ExpatError as error:
        if root is not None and not stack:  # something after the root element
            return root
        line = error.lineno + skipped
        lines = text.splitlines()
        quoted = lines[line - 1].strip()[:80] if 0 < line <= len(lines) else ""
        place = f"{file or 'text'}:{line}"
        if not body:
            raise DescriptionError(f"{place}: the text is empty; expected XML with <sdf> or <robot>") from None
        raise DescriptionError(f"{place}: not well-formed XML, {expat.ErrorString(error.code)}"
                               + (f", at: {quoted}" if quoted else "")) from None
    return root


def clone(element: ET.Element) -> Element:
    """A deep copy that keeps the lines."""
    copy = Element(element.tag, dict(element.attrib))
    copy.text, copy.tail = element.text, element.tail
    copy.line, copy.file = getattr(element, "line", 0), getattr(element, "file", "")
    copy.extend([clone(child) for child in element])
    return copy


def child(parent: ET.Element, tag: str, text: str = "", attrib: Optional[dict] = None,
          like: Optional[ET.Element] = None) -> Element:
    """Append a new element to ``parent``; it takes the line of ``like``, or of ``parent``."""
    element = Element(tag, attrib or {})
    element.text = text
    origin = parent if like is None else like
    element.line, element.file = getattr(origin, "line", 0), getattr(origin, "file", "")
    parent.append(element)
    return element


def source_of(element: ET.Element) -> Source:
    """Where ``element`` was written, with its name for a message: ``<link name='a'>``."""
    name = element.get("name")
    shown = f"<{element.tag} name='{name}'>" if name is not None else f"<{element.tag}>"
    return Source(getattr(element, "file", ""), getattr(element, "line", 0), shown)


def text_of(element: Optional[ET.Element], default: str = "") -> str:
    """Stripped text of an element, or its ``value`` attribute as old files have it."""
    if element is None:
        return default
    value = element.get("value")
    return (value if value is not None else element.text or "").strip()


def is_true(text: str) -> bool:
    """SDF and URDF extension booleans: true, yes, 1 in any case."""
    return text.strip().lower() in ("true", "yes", "1")
