"""XML text to elements that know their line, with the tolerance of Gazebo's own parser."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from xml.parsers import expat

import lenient_xml

from ode_sim.errors import DescriptionError, Source, one_line, quoted

#: What a text may hold at most. A robot of 20 000 links has 300 000 elements; what nests deeper than 100 was not written
#: to be read, and every reader behind this one may go down the tree by recursion.
MOST_BYTES, MOST_ELEMENTS, DEEPEST = 64_000_000, 500_000, 100
_ROOTS = ("robot", "sdf", "gazebo", "world", "model", "light", "actor")  # of several roots the first that is one of these counts
_BUFFER = 1 << 20  # bytes of text that reach the reader in one piece
_NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?|inf(?:inity)?|nan))", re.IGNORECASE)


class Element(ET.Element):
    """An ElementTree element with the ``line`` (from 1) and ``file`` it was read from; 0 and '' if made here."""

    line: int = 0
    file: str = ""
    include_chain: tuple = ()  # of a model that was included: the URIs that led to it
    oddities: tuple = ()  # of a root: (line, what) of all that was read otherwise than it is written


def parse_xml(text: str | bytes, file: str = "") -> Element:
    """Root element of ``text``. Prefixes of namespaces stay part of the tag names, declared or not.

    As Gazebo's parser does, it tolerates blank lines before the XML declaration, ``--`` inside comments and anything
    after the root element; what is not well-formed is read as TinyXML reads it, and the root's ``oddities`` say what that was.

    :param file: where the text is from, for messages.
    :raises DescriptionError: not well-formed for TinyXML either (the line of text is quoted), too long, too deep, or with entities
        of its own: these may hold other files, or gigabytes.
    """
    if len(text) > MOST_BYTES:
        raise DescriptionError(f"{Source(file)}: is longer than {MOST_BYTES // 1_000_000} MB; nothing that large is read")
    whole = _decoded(text).lstrip("\ufeff")
    text = _without_comments(whole)
    body = text.lstrip()
    reader = _Reader(file, text.count("\n", 0, len(text) - len(body)))
    try:
        root = reader.read(body.encode("utf-8", "replace"))
        return root if root.tag in _ROOTS else _as_tinyxml(whole, file) or root
    except expat.ExpatError as error:
        lenient = _as_tinyxml(whole, file)
        if lenient is not None:
            return lenient
        line = error.lineno + reader.skipped
        lines = text.split("\n")
        words = one_line(lines[line - 1].strip(), 80) if 0 < line <= len(lines) else ""
        source = Source(file, line)
        if not body:
            raise DescriptionError("the text is empty; expected XML with <sdf> or <robot>", source) from None
        raise DescriptionError(
            f"not well-formed XML, {expat.ErrorString(error.code)}" + (f", at: {words}" if words else ""), source
        ) from None


def _decoded(text: str | bytes) -> str:
    if isinstance(text, str):
        return text
    try:
        return text.decode("utf-8")
    except UnicodeDecodeError:
        return text.decode("latin-1")


def _without_comments(text: str) -> str:
    """Blank lines in place of comments: the lines that follow keep their numbers."""
    pieces, at = [], 0
    while (begin := text.find("<!--", at)) >= 0 and (end := text.find("-->", begin + 4)) >= 0:
        pieces += [text[at:begin], "\n" * text.count("\n", begin, end)]
        at = end + 3
    return "".join(pieces) + text[at:]


def _as_tinyxml(text: str, file: str) -> Element | None:
    """The root that counts, None where TinyXML finds none either."""
    builder = _Builder(file)
    try:
        oddities = lenient_xml.feed(text, builder)
    except lenient_xml.XmlError:
        return None
    root = next((root for root in builder.roots if root.tag in _ROOTS), builder.roots[0] if builder.roots else None)
    if root is not None:
        root.oddities = tuple(oddities)
    return root


class _Builder:
    """Builds the elements of one text."""

    def __init__(self, file: str):
        self.file = file
        self.roots: list[Element] = []
        self._stack: list[Element] = []
        self._count = 0

    def start(self, tag: str, attrib: dict, line: int) -> None:
        element = Element(tag, attrib)
        element.line = line
        element.file = self.file
        (self._stack[-1] if self._stack else self.roots).append(element)
        self._stack.append(element)
        self._count += 1
        if len(self._stack) > DEEPEST:
            raise DescriptionError(f"<{quoted(tag)}> lies more than {DEEPEST} elements deep", Source(self.file, line))
        if self._count > MOST_ELEMENTS:
            raise DescriptionError(f"more than {MOST_ELEMENTS} elements; split the description up", Source(self.file, line))

    def end(self, tag: str) -> None:
        self._stack.pop()

    def data(self, text: str) -> None:
        if not self._stack:
            return
        parent = self._stack[-1]
        if len(parent):
            parent[-1].tail = (parent[-1].tail or "") + text
        else:
            parent.text = (parent.text or "") + text

    @property
    def closed(self) -> bool:
        """Whether there is a root and nothing is open."""
        return bool(self.roots) and not self._stack


class _Reader(_Builder):
    """By expat. ``skipped``: lines that were cut off before the text."""

    def __init__(self, file: str, skipped: int):
        super().__init__(file)
        self.skipped = skipped
        self._parser = parser = expat.ParserCreate("utf-8")
        parser.buffer_text = True
        parser.buffer_size = _BUFFER
        parser.StartElementHandler = lambda tag, attrib: self.start(tag, attrib, self._line())
        parser.EndElementHandler = self.end
        parser.CharacterDataHandler = self.data
        parser.EntityDeclHandler = self._entity

    def read(self, text: bytes) -> Element:
        try:
            self._parser.Parse(text, True)
        except expat.ExpatError:
            if not self.closed:
                raise
            # else: something after the root element
        finally:  # else parser and reader hold each other, and the tree, until the collector comes
            self._parser.StartElementHandler = self._parser.EndElementHandler = None
            self._parser.CharacterDataHandler = self._parser.EntityDeclHandler = None
        return self.roots[0]

    def _line(self) -> int:
        return self._parser.CurrentLineNumber + self.skipped

    def _entity(self, name: str, *_declaration: object) -> None:
        raise DescriptionError(
            f"declares the entity '{quoted(name)}'; entities are not read, write out what it stands for", Source(self.file, self._line())
        )


def read_bytes(file: str) -> bytes:
    """A whole file of a description.

    :raises DescriptionError: unreadable, or longer than :data:`MOST_BYTES`.
    """
    try:
        with open(file, "rb") as stream:
            data = stream.read(MOST_BYTES + 1)
    except (OSError, ValueError) as error:  # ValueError: a zero byte in the name
        raise DescriptionError(f"cannot read {file}: {getattr(error, 'strerror', None) or error}") from None
    if len(data) > MOST_BYTES:
        raise DescriptionError(f"{file}: is longer than {MOST_BYTES // 1_000_000} MB; nothing that large is read")
    return data


def clone(element: ET.Element) -> Element:
    """A deep copy of ``element`` that keeps the lines."""
    copy = Element(element.tag, dict(element.attrib))
    copy.text, copy.tail = element.text, element.tail
    copy.line, copy.file = getattr(element, "line", 0), getattr(element, "file", "")
    copy.extend([clone(child) for child in element])
    return copy


def child(parent: ET.Element, tag: str, text: str = "", attrib: dict | None = None, like: ET.Element | None = None) -> Element:
    """Append a new element ``tag`` with ``text`` and ``attrib`` to ``parent``; it takes the line of ``like``, or of ``parent``."""
    element = Element(tag, attrib or {})
    element.text = text
    origin = parent if like is None else like
    element.line, element.file = getattr(origin, "line", 0), getattr(origin, "file", "")
    parent.append(element)
    return element


def fault(element: ET.Element, message: str, of: str = "") -> DescriptionError:
    """The error of an element: file, line and element before the message, and ``of`` what it is where its name does not tell."""
    source = source_of(element)
    return DescriptionError(message, replace(source, element=f"{source.element} of {of}") if of else source)


def source_of(element: ET.Element) -> Source:
    """Where ``element`` was written, with its name for a message: ``<link name='a'>``."""
    name = element.get("name")
    shown = f"<{quoted(element.tag)}" + (f" name='{quoted(name)}'>" if name is not None else ">")
    return Source(getattr(element, "file", ""), getattr(element, "line", 0), shown)


def text_of(element: ET.Element | None, default: str = "") -> str:
    """Stripped text of ``element``, or its ``value`` attribute as old files have it; ``default`` of None."""
    if element is None:
        return default
    value = element.get("value")
    return (value if value is not None else element.text or "").strip()


def joint_end(joint: ET.Element, tag: str) -> str:
    """The link that a ``<joint>`` names as ``tag``, ``parent`` or ``child``; SDF 1.0 has it in an attribute ``link``."""
    element = joint.find(tag)
    if element is None:
        return ""
    return text_of(element) or text_of(element.find("link")) or (element.get("link") or "").strip()


def is_true(text: str) -> bool:
    """SDF and URDF extension booleans: ``text`` is true, yes or 1, in any case."""
    return text.strip().lower() in ("true", "yes", "1")


def leading_numbers(text: str, count: int) -> tuple[float, ...]:
    """Up to ``count`` numbers from the start of ``text``, as a C++ stream reads them: what follows is left alone (``0.3m``
    is 0.3), the first word that is no number ends the row.
    """
    numbers: list[float] = []
    position = 0
    while len(numbers) < count:
        match = _NUMBER.match(text, position)
        if not match:
            break
        numbers.append(float(match.group(1)))
        position = match.end()
    return tuple(numbers)
