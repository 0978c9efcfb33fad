"""XML as TinyXML reads it, with which Gazebo, RViz, urdfdom and ros_control read robots and worlds.

A text that Python's parsers refuse is a robot there when TinyXML takes it: ``&`` that begins no entity is dropped, ``<`` may stand in
an attribute, values may lack their quotation marks, ``--`` may stand in a comment, there may be several roots, and what follows the
last one is not read. TinyXML refuses the same attribute given twice, an end tag that does not fit, and what is not closed.
"""

from __future__ import annotations

import re
from typing import Protocol
from xml.etree import ElementTree

_SPACE = re.compile(r"[ \t\r\n\v\f]*")
_NAME = re.compile(r"[A-Za-z_\x7f-\U0010ffff][A-Za-z0-9_\-.:\x7f-\U0010ffff]*")
_WORD = re.compile(r"[^ \t\r\n\v\f/>]*")
_ENTITY = re.compile(r"&(?:(amp|lt|gt|quot|apos);|#(x?)([0-9A-Fa-f]*)(;?)|)")
_NAMED = {"amp": "&", "lt": "<", "gt": ">", "quot": '"', "apos": "'"}


class XmlError(ValueError):
    """TinyXML refuses it as well. ``line`` (from 1) is where, ``reason`` what it is."""

    def __init__(self, reason: str, line: int) -> None:
        super().__init__(f"{reason}, line {line}")
        self.reason, self.line = reason, line


class Target(Protocol):
    """Takes the elements of a text in their order."""

    def start(self, tag: str, attrib: dict[str, str], line: int) -> None:
        """An element ``tag`` begins in ``line`` (from 1), with the attributes ``attrib``."""

    def end(self, tag: str) -> None:
        """The element ``tag`` ends."""

    def data(self, text: str) -> None:
        """``text`` stands in the element that was begun last."""


def feed(text: str, target: Target) -> list[tuple[int, str]]:
    """Hand every element of ``text`` to ``target``, those of further roots too. Takes linear time, whatever the text is.

    :returns: (line, what) of each thing that was read otherwise than it is written, as a bare ``&``
    :raises XmlError: TinyXML refuses it as well
    """
    return _Reading(text, target).read()


def fromstring(text: str, tag: str = "robot") -> ElementTree.Element:
    """The first root of that tag, else the first root, as ``ElementTree.fromstring`` gives it.

    :raises ElementTree.ParseError: the text is no XML, for TinyXML neither
    :raises TypeError: it is no text
    """
    if not isinstance(text, str):
        raise TypeError(f"XML is a text, not {type(text).__name__}")
    text = text.lstrip("\ufeff \t\r\n")
    try:
        return ElementTree.fromstring(text)
    except ElementTree.ParseError:
        tree = _Tree()
        try:
            feed(text, tree)
        except XmlError:
            tree.roots.clear()
        if not tree.roots:
            raise
    return next((root for root in tree.roots if root.tag == tag), tree.roots[0])


class _Tree:
    def __init__(self) -> None:
        self.roots: list[ElementTree.Element] = []
        self._stack: list[ElementTree.Element] = []

    def start(self, tag: str, attrib: dict[str, str], line: int) -> None:
        element = ElementTree.Element(tag, attrib)
        (self._stack[-1] if self._stack else self.roots).append(element)
        self._stack.append(element)

    def end(self, tag: str) -> None:
        self._stack.pop()

    def data(self, text: str) -> None:
        parent = self._stack[-1]
        if len(parent):
            parent[-1].tail = (parent[-1].tail or "") + text
        else:
            parent.text = (parent.text or "") + text


class _Reading:
    """One pass over a text, from ``<`` to ``<``."""

    def __init__(self, text: str, target: Target) -> None:
        self._text, self._target = text.partition("\0")[0], target  # TinyXML reads up to a zero byte
        self._at = 0
        self._counted = (0, 1)  # up to where lines are counted, and the line there
        self._open: list[str] = []
        self._oddities: list[tuple[int, str]] = []

    def read(self) -> list[tuple[int, str]]:
        if self._text.startswith("\ufeff"):
            self._at = 1
        while True:
            begin = self._at
            self._skip_space()
            if self._at >= len(self._text):
                break
            if self._text[self._at] != "<":
                if not self._open:
                    break  # after or between the roots: the rest is not read
                self._characters(begin)
            elif self._open and self._text.startswith("</", self._at):
                self._end_tag()
            else:
                self._markup()
        if self._open:
            raise self._error(f"<{self._open[-1]}> is not closed")
        return self._oddities

    # ------------------------------------------------------------------ pieces

    def _skip_space(self) -> None:
        match = _SPACE.match(self._text, self._at)
        assert match is not None  # it may be empty
        self._at = match.end()

    def _line(self) -> int:
        position, line = self._counted
        if self._at >= position:
            line += self._text.count("\n", position, self._at)
            self._counted = (self._at, line)
            return line
        return 1 + self._text.count("\n", 0, self._at)

    def _error(self, reason: str) -> XmlError:
        return XmlError(reason, self._line())

    def _odd(self, what: str) -> None:
        if len(self._oddities) < 10:
            self._oddities.append((self._line(), what))

    def _characters(self, begin: int) -> None:
        end = self._text.find("<", self._at)
        end = len(self._text) if end < 0 else end
        self._target.data(self._plain(self._text[begin:end]))
        self._at = end

    def _markup(self) -> None:
        """What begins with ``<`` and is no end tag."""
        text, at = self._text, self._at
        if text.startswith("<!--", at):
            self._jump("-->", at + 4)
        elif text.startswith("<![CDATA[", at):
            end = text.find("]]>", at)
            if self._open:
                self._target.data(text[at + 9 : end if end >= 0 else len(text)])
            self._jump("]]>", at)
        elif _NAME.match(text, at + 1):
            self._start_tag()
        else:  # a declaration, a document type, or no markup at all
            self._jump(">", at)

    def _jump(self, end: str, begin: int) -> None:
        found = self._text.find(end, begin)
        self._at = len(self._text) if found < 0 else found + len(end)

    def _end_tag(self) -> None:
        expected = self._open[-1]
        after = self._at + 2 + len(expected)
        fits = self._text.startswith(expected, self._at + 2)
        match = _SPACE.match(self._text, after)
        assert match is not None
        if not fits or not self._text.startswith(">", match.end()):
            raise self._error(f"expected </{expected}>")
        self._at = match.end() + 1
        self._open.pop()
        self._target.end(expected)

    def _start_tag(self) -> None:
        match = _NAME.match(self._text, self._at + 1)
        assert match is not None
        tag, line = match.group(), self._line()
        self._at = match.end()
        attributes: dict[str, str] = {}
        while True:
            self._skip_space()
            sign = self._text[self._at : self._at + 1]
            if sign in ("/", ">"):
                break
            if not sign:
                raise XmlError(f"<{tag}> is not closed", line)
            name, value = self._attribute(tag)
            if name in attributes:
                raise self._error(f"attribute '{name}' of <{tag}> is given twice")
            attributes[name] = value
        if sign == "/" and not self._text.startswith("/>", self._at):
            raise self._error(f"'/' in the middle of <{tag}>")
        self._target.start(tag, attributes, line)
        self._at += len("/>" if sign == "/" else ">")
        if sign == "/":
            self._target.end(tag)
        else:
            self._open.append(tag)

    def _attribute(self, tag: str) -> tuple[str, str]:
        match = _NAME.match(self._text, self._at)
        if match is None:
            raise self._error(f"<{tag}> has something in it that is no attribute")
        name = match.group()
        self._at = match.end()
        self._skip_space()
        if not self._text.startswith("=", self._at):
            raise self._error(f"attribute '{name}' of <{tag}> has no value")
        self._at += 1
        self._skip_space()
        quote = self._text[self._at : self._at + 1]
        if quote not in ('"', "'") or not quote:
            return name, self._unquoted(tag, name)
        end = self._text.find(quote, self._at + 1)
        if end < 0:
            raise self._error(f"the value of attribute '{name}' of <{tag}> does not end")
        written = self._text[self._at + 1 : end]
        if "<" in written:
            self._odd(f"'<' in attribute '{name}' of <{tag}> is part of the value")
        value = self._plain(written)
        self._at = end + 1
        return name, value

    def _unquoted(self, tag: str, name: str) -> str:
        match = _WORD.match(self._text, self._at)
        assert match is not None
        word = match.group()
        if not word and self._at >= len(self._text):
            raise self._error(f"<{tag}> is not closed")
        if '"' in word or "'" in word:
            raise self._error(f"attribute '{name}' of <{tag}> has a quotation mark within its value")
        self._odd(f"attribute '{name}' of <{tag}> has no quotation marks")
        self._at = match.end()
        return word

    def _plain(self, text: str) -> str:
        """Entities replaced; of what is none the ``&`` is dropped."""
        return _ENTITY.sub(self._meaning, text) if "&" in text else text

    def _meaning(self, match: re.Match[str]) -> str:
        named, hexadecimal, digits, closed = match.groups()
        if named:
            return _NAMED[named]
        if digits is None:
            self._odd("a bare '&' is dropped (it is written &amp;)")
            return ""
        try:
            code = int(digits, 16 if hexadecimal else 10) if closed else -1
        except ValueError:
            code = -1
        if code < 0:
            raise self._error(f"'{match.group()[:20]}' is no character")
        return chr(code) if 0 < code <= 0x10FFFF and not 0xD800 <= code < 0xE000 else ""
