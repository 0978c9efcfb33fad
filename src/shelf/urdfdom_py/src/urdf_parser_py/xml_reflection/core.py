"""XML to objects and back, by what a class lists in ``FIELDS``.

What is missing or wrong raises :class:`ParseError` with the element's path; what is unknown is told to ``on_error``, which a
program may replace, and left out.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any
from xml.dom import minidom
from xml.etree import ElementTree

import yaml


class ParseError(ValueError):
    """``path``: where, as an XPath; ``e``: what is wrong there."""

    def __init__(self, e: Exception, path: str):
        self.e, self.path = e, path
        super().__init__(f"ParseError in {path}: {e}")


def on_error_stderr(message: str) -> None:
    sys.stderr.write(message + "\n")


on_error = on_error_stderr


def text(value: str) -> str:
    return value


def number(value: str) -> float:
    return float(value)


def numbers(count: int) -> Callable[[str], list[float]]:
    """A reader of ``count`` numbers."""

    def read(value: str) -> list[float]:
        found = [float(word) for word in value.split()]
        if len(found) != count:
            raise ValueError(f"'{value}' must be {count} numbers")
        return found

    return read


def written(value: Any) -> str:
    return " ".join(str(part) for part in value) if isinstance(value, (list, tuple)) or hasattr(value, "tolist") else str(value)


class Field:
    """One attribute or child element ``xml``, kept as ``var``.

    :param read: an attribute's text to a value; for children a subclass of :class:`Object`, or a name of an attribute and its reader
    """

    kind = ""

    def __init__(self, xml: str, read: Any, required: bool = True, default: Any = None, var: str | None = None):
        self.xml, self.read, self.required, self.default, self.var = xml, read, required, default, var or xml

    def missing(self, obj: Any, path: str) -> None:
        """Set the default of ``obj``, whose XML at ``path`` has no such field. :raises ParseError: it is required"""
        if self.required:
            raise ParseError(ValueError(f"Required {self.kind} not set in XML: {self.xml}"), path)
        setattr(obj, self.var, list(self.default) if isinstance(self.default, list) else self.default)

    def value_to_write(self, obj: Any) -> Any:
        """The field's value in ``obj``. :raises ValueError: it is required and not set"""
        value = getattr(obj, self.var)
        if value is None and self.required:
            raise ValueError(f"Required {self.kind} not set in object: {self.var}")
        return self.default if value is None else value


class Attribute(Field):
    kind = "attribute"


class Child(Field):
    kind = "element"

    def from_xml(self, node: ElementTree.Element, path: str) -> Any:
        """The value of the element ``node`` at ``path``. :raises ParseError: it is none of this kind"""
        if isinstance(self.read, tuple):  # <parent link="..."/>
            name, read = self.read
            if node.get(name) is None:
                raise ParseError(ValueError(f"Required attribute not set in XML: {name}"), path)
            return _judged(read, node.get(name), f"{path}[@{name}]")
        if self.read in (text, number):
            return _judged(self.read, (node.text or "").strip(), path)
        if self.read is ElementTree.Element:
            return node
        return self.read.from_xml(node, path)

    def to_xml(self, parent: ElementTree.Element, value: Any) -> None:
        """Append ``value`` to the element ``parent``."""
        if self.read is ElementTree.Element:
            parent.append(value)
            return
        node = ElementTree.SubElement(parent, self.xml)
        if isinstance(self.read, tuple):
            node.set(self.read[0], written(value))
        elif self.read in (text, number):
            node.text = written(value)
        else:
            value.write_xml(node)


class Aggregate(Child):
    """Any number of children, kept in a list."""

    def __init__(self, xml: str, read: Any, var: str | None = None):
        super().__init__(xml, read, required=False, var=var or xml + "s")

    def missing(self, obj: Any, path: str) -> None:
        pass


def _judged(read: Callable[[str], Any], value: Any, path: str) -> Any:
    try:
        return read(value)
    except ValueError as error:
        raise ParseError(error, path) from None


class Object:
    """``TAG`` is what its element is called, ``FIELDS`` what is in it."""

    TAG = ""
    FIELDS: list[Field] = []

    # reading

    @classmethod
    def from_xml_string(cls, xml_string: str | bytes) -> Any:
        """The object of ``xml_string``. :raises ParseError: what it says is missing or wrong, or no XML"""
        return cls._read(cls.__new_empty(), xml_string)

    @classmethod
    def from_xml_file(cls, file_path: str) -> Any:
        """The object of the file ``file_path``. :raises ParseError: as above. :raises OSError: the file cannot be read"""
        with open(file_path, "rb") as file:
            return cls.from_xml_string(file.read())

    def parse(self, xml_string: str) -> Any:
        """Reads ``xml_string`` into this object, and returns it."""
        return self._read(self, xml_string)

    @classmethod
    def from_xml(cls, node: ElementTree.Element, path: str = "") -> Any:
        """An object of the element ``node``; ``path`` is its place in the document, for errors. :raises ParseError: it cannot be read"""
        obj = cls.__new_empty()
        obj.read_xml(node, path)
        return obj

    @classmethod
    def __new_empty(cls) -> Any:
        return cls()

    @staticmethod
    def _read(obj: Any, xml_string: Any) -> Any:
        if isinstance(xml_string, str):  # an encoding that the header names is that of the file it came from
            xml_string = xml_string.lstrip().encode()
            if xml_string.startswith(b"<?xml"):
                xml_string = xml_string[xml_string.find(b"?>") + 2 :]
        try:
            node = ElementTree.fromstring(xml_string)
        except ElementTree.ParseError as error:
            raise ParseError(error, "/" + obj.TAG) from None
        obj.read_xml(node, "/" + obj.TAG)
        return obj

    def read_xml(self, node: ElementTree.Element, path: str) -> None:
        """Set the fields to what the element ``node`` says; ``path`` is its place in the document. :raises ParseError: it cannot be read"""
        attributes = {field.xml: field for field in self.FIELDS if isinstance(field, Attribute)}
        children = {field.xml: field for field in self.FIELDS if isinstance(field, Child)}
        seen = set()
        for name, value in node.attrib.items():
            if name in attributes:
                setattr(self, attributes[name].var, _judged(attributes[name].read, value, f"{path}[@{name}]"))
                seen.add(name)
        own = node.get("name")
        if own is not None and "name" in attributes:
            path = f"{path.rpartition('[')[0] if path.endswith(']') else path}[@name='{own}']"
        for child in node:
            self._read_child(children.get(child.tag) if isinstance(child.tag, str) else None, child, path, seen)
        for field in self.FIELDS:
            if field.xml not in seen:
                field.missing(self, path)
        for name in node.attrib:
            if name not in attributes:
                on_error(f'Unknown attribute "{name}" in {path}')
        for child in node:
            if isinstance(child.tag, str) and child.tag not in children:
                on_error(f'Unknown tag "{child.tag}" in {path}')
        self.post_read_xml()
        try:
            self.check_valid()
        except ParseError:
            raise
        except (ValueError, AssertionError) as error:
            raise ParseError(error, path) from None

    def _read_child(self, field: Any, node: ElementTree.Element, path: str, seen: set) -> None:
        if field is None:
            return
        if isinstance(field, Aggregate):
            place = f"{path}/{field.xml}[{len(getattr(self, field.var)) + 1}]"
            self.add_aggregate(field.xml, field.from_xml(node, place))
        elif field.xml in seen:
            on_error(f"Scalar element defined multiple times: {field.xml}")
            return
        else:
            setattr(self, field.var, field.from_xml(node, f"{path}/{field.xml}"))
        seen.add(field.xml)

    def post_read_xml(self) -> None:
        """For classes that derive something from what was read."""

    def check_valid(self) -> None:
        """:raises ValueError: what cannot be"""

    # writing

    def to_xml(self) -> ElementTree.Element:
        node = ElementTree.Element(self.TAG)
        self.write_xml(node)
        return node

    def write_xml(self, node: ElementTree.Element) -> None:
        """Write the fields into ``node``. :raises ValueError: a required one is not set"""
        self.check_valid()
        for field in self.FIELDS:
            if isinstance(field, Aggregate):
                continue
            value = field.value_to_write(self)
            if value is not None and isinstance(field, Attribute):
                node.set(field.xml, written(value))
            elif value is not None and isinstance(field, Child):
                field.to_xml(node, value)
        by_name = {field.xml: field for field in self.FIELDS if isinstance(field, Child)}
        for xml_var, value in getattr(self, "aggregate_order", []):
            by_name[xml_var].to_xml(node, value)

    def to_xml_string(self, addHeader: bool = True) -> str:
        """The element as text, its children indented by two; ``addHeader``: with the XML declaration."""
        document = minidom.parseString(ElementTree.tostring(self.to_xml())).toprettyxml(indent="  ")
        lines = [line for line in document.split("\n") if line.strip()]
        return "\n".join(lines if addHeader else lines[1:])

    # lists

    def aggregate_init(self) -> None:
        self.aggregate_order: list[Any] = []  # (name of the element, object), in the order of the file

    def add_aggregate(self, xml_var: str, obj: Any) -> None:
        """Append ``obj`` to the list of the children with the tag ``xml_var``."""
        field = next(field for field in self.FIELDS if field.xml == xml_var)
        getattr(self, field.var).append(obj)
        self.aggregate_order.append((xml_var, obj))

    def remove_aggregate(self, obj: Any) -> None:
        """Take ``obj``, a child, out of its list."""
        xml_var = next(name for name, one in self.aggregate_order if one is obj)
        self.aggregate_order = [(name, one) for name, one in self.aggregate_order if one is not obj]
        field = next(field for field in self.FIELDS if field.xml == xml_var)
        setattr(self, field.var, [one for one in getattr(self, field.var) if one is not obj])

    # as text

    def get_refl_vars(self) -> list[str]:
        return [field.var for field in self.FIELDS]

    def to_yaml(self) -> dict[str, Any]:
        return {name: _plain(getattr(self, name)) for name in self.get_refl_vars()}

    def __str__(self) -> str:
        return yaml.dump(self.to_yaml()).rstrip()


def _plain(value: Any) -> Any:
    if value is None or isinstance(value, str):
        return str(value)
    if isinstance(value, (int, float, bool)):
        return value
    if isinstance(value, ElementTree.Element):
        return ElementTree.tostring(value, encoding="unicode")
    if hasattr(value, "to_yaml"):
        return value.to_yaml()
    return [_plain(part) for part in value]
