"""What replaces functions of PyPI's xacro: a parser that notes file and line on each element, and clones that keep them. Does not
import ``xacro``, which imports this and hands itself over. Old forms and namespaces have modules of their own.
"""

from __future__ import annotations

import importlib
import os
import xml.dom.expatbuilder
import xml.dom.minidom
from typing import Any

from noetic_xacro import namespaces, old_forms
from noetic_xacro.expressions import MOST_ITEMS, bound_symbols, safe_eval
from noetic_xacro.marks import KEPT, PLACE
from noetic_xacro.substitution import substituted

MOST_ELEMENTS = 100_000  # that macros and blocks expand to, one beside the other and one in the other: some 20 s of work

xacro: Any = None  # the module ``xacro`` whose functions are replaced; it imports this one


class _PlacedBuilder(xml.dom.expatbuilder.ExpatBuilderNS):
    """minidom's builder, noting on every element where its start tag stands."""

    def __init__(self, file_name: str):
        super().__init__()
        self._file_name = file_name

    def install(self, parser):
        super().install(parser)
        parser.EntityDeclHandler = self._refuse_entity

    def start_doctype_decl_handler(self, *declaration):
        super().start_doctype_decl_handler(*declaration)
        self.getParser().EntityDeclHandler = self._refuse_entity  # which minidom has just replaced

    def _refuse_entity(self, name, *_declaration):
        """An entity may hold another file, or gigabytes; robots have properties."""
        raise xacro.XacroException(
            f"{self._file_name}:{self.getParser().CurrentLineNumber}: declares the entity "
            f"'{shortened(name, 60)}'; entities are not read, use a property"
        )

    def start_element_handler(self, name, attributes):
        super().start_element_handler(name, attributes)
        setattr(self.curNode, PLACE, f"{self._file_name}:{self.getParser().CurrentLineNumber}")


def _parse(inp, filename: str | None = None) -> xml.dom.minidom.Document:
    """Replacement of ``xacro.parse``: same contract, with places."""
    data: str | bytes
    if inp is None:
        assert filename is not None  # one of the two is there
        path = os.path.join(xacro.root_dir, filename)
        try:
            with open(path, "rb") as file:
                data = file.read()
        except OSError as error:
            xacro.filestack.pop()
            raise xacro.XacroException(f"{error.strerror}: {path}", exc=error) from error
    elif isinstance(inp, (str, bytes)):
        path, data = filename or "text", inp
    elif hasattr(inp, "read"):
        path, data = filename or str(getattr(inp, "name", "text")), inp.read()
    else:
        return inp
    document = _PlacedBuilder(path).parseString(data)
    assert document.documentElement is not None  # of XML that could be read
    old_forms.read_file(document.documentElement, path)
    return document


def _keep_place_in_clones() -> None:
    minidom: Any = xml.dom.minidom  # what is replaced is its own business: no stub tells of it
    original, process = minidom._clone_node, xacro.process_doc
    count = 0

    def process_doc(document, *arguments, **named):
        nonlocal count
        count = 0
        old_forms.begin(document)
        return process(document, *arguments, **named)

    xacro.process_doc = process_doc

    def clone_node(node, deep, new_owner_document):
        nonlocal count
        count += node.nodeType == node.ELEMENT_NODE
        if count > MOST_ELEMENTS:
            raise xacro.XacroException(f"expands to more than {MOST_ELEMENTS} elements; do macros call others twice?")
        clone = original(node, deep, new_owner_document)
        for mark in KEPT:
            if hasattr(node, mark):
                setattr(clone, mark, getattr(node, mark))
        return clone

    minidom._clone_node = clone_node


def _bound_texts() -> None:
    """``${b}${b}`` of a property that is ``${a}${a}`` ...: thirty lines make a thousand million characters."""
    original = xacro.eval_text

    def eval_text(text, symbols):
        result = original(text, symbols)
        if isinstance(result, str) and len(result) > 10 * MOST_ITEMS:
            raise xacro.XacroException(f"a text of {len(result)} characters is too much for a robot description")
        return result

    xacro.eval_text = eval_text


def _eval_extension(text: str) -> str:
    """``$(...)``: what goes wrong is told once, with what was written."""
    if text == "$(cwd)":
        return os.path.abspath(xacro.root_dir)
    substitution_args: Any = importlib.import_module("xacro.substitution_args")

    try:
        return substituted(text, xacro.substitution_args_context, substitution_args)
    except substitution_args.ArgException as error:
        raise xacro.XacroException("Undefined substitution argument", exc=error) from error
    except Exception as error:  # noqa: BLE001  $(eval) may raise anything
        raise xacro.XacroException(f"{shortened(text, 100)}:", exc=error) from error


def shortened(text: str, most: int = 300) -> str:
    """``text``, its middle left out where it is longer than ``most`` characters."""
    return text if len(text) <= most else f"{text[: most - most // 3]} ... {text[-(most // 3) :]}"


def install(module: Any) -> None:
    """Put this module's functions into ``module``, which is ``xacro``; done once, by its import."""
    global xacro
    xacro = module
    xacro.parse = _parse
    xacro.safe_eval = safe_eval
    xacro.eval_extension = _eval_extension
    _bound_texts()
    bound_symbols(xacro._global_symbols)
    _keep_place_in_clones()
    old_forms.install(xacro)
    namespaces.install(xacro)
