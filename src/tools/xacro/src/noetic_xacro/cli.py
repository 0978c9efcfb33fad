"""``xacro FILE [a:=b ...]`` as in ROS Noetic: PyPI's xacro, ``$(find pkg)`` through rospkg, errors with file and line.

PyPI's xacro reads with minidom, which forgets line numbers. The parser here notes file and line on each element, clones
keep them, and a failing run reports the innermost element that was being expanded.
"""
from __future__ import annotations

import os
import sys
import xml.dom.expatbuilder
import xml.dom.minidom
from typing import Optional
from xml.parsers.expat import ExpatError

import xacro
import xacro.cli
from ament_index_python.packages import PackageNotFoundError

from noetic_xacro.expressions import bound_symbols, safe_eval
from noetic_xacro.reserved import RESERVED

_PLACE = "xacro_place"  # attribute set on DOM elements: "file:line"
_LINES = 10  # of the files and macros around an error


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
        raise xacro.XacroException(f"{self._file_name}:{self.getParser().CurrentLineNumber}: declares the entity "
                                   f"'{_shortened(name, 60)}'; entities are not read, use a property")

    def start_element_handler(self, name, attributes):
        super().start_element_handler(name, attributes)
        setattr(self.curNode, _PLACE, f"{self._file_name}:{self.getParser().CurrentLineNumber}")


def _parse(inp, filename: Optional[str] = None) -> xml.dom.minidom.Document:
    """Replacement of ``xacro.parse``: same contract, with places."""
    if inp is None:
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
        path, data = filename or getattr(inp, "name", "text"), inp.read()
    else:
        return inp
    document = _PlacedBuilder(path).parseString(data)
    _prefix_words(document.documentElement, path)
    return document


# Words of xacro that robots from before Noetic write without prefix, and the attribute by which they are told from others.
_WORDS = {"property": "name", "macro": "name", "arg": "default", "include": "filename", "insert_block": "name", "if": "value",
          "unless": "value"}


def _prefix_words(root: xml.dom.minidom.Element, path: str) -> None:
    """``<property .../>`` becomes ``<xacro:property .../>``, with one warning a file; what stands in a plugin is not xacro's."""
    found = []
    todo = [root]
    while todo:
        for child in todo.pop().childNodes:
            if child.nodeType != child.ELEMENT_NODE or child.tagName == "plugin":
                continue
            if child.hasAttribute(_WORDS.get(child.tagName, "")):
                found.append((child.tagName, getattr(child, _PLACE)))
                child.tagName = child.nodeName = f"xacro:{child.tagName}"
            todo.append(child)
    if found and xacro.verbosity > 0:
        word, place = min(found, key=lambda entry: int(entry[1].rsplit(":", 1)[1]))
        print(f"xacro: warning: {place}: <{word}> is written without prefix; write <xacro:{word}> (Noetic ignores the old form, "
              f"here it is understood; {len(found)} such in {os.path.basename(path)})", file=sys.stderr)


def _keep_place_in_clones() -> None:
    original = xml.dom.minidom._clone_node

    def clone_node(node, deep, new_owner_document):
        clone = original(node, deep, new_owner_document)
        if hasattr(node, _PLACE):
            setattr(clone, _PLACE, getattr(node, _PLACE))
        return clone

    xml.dom.minidom._clone_node = clone_node


def _accept_macros_without_prefix() -> None:
    """``<wheel .../>`` for ``<xacro:wheel .../>``, as in packages from before Noetic: expanded, with one warning a name.

    Without it the element stays in the URDF, is ignored there, and a robot without wheels or inertias is spawned. Names
    that URDF and SDF use themselves (``<camera>`` in a sensor) are never taken for a macro.
    """
    original = xacro.handle_macro_call
    warned = set()

    def handle_macro_call(node, macros, symbols):
        name = node.tagName
        if ":" not in name and name not in RESERVED:
            try:
                xacro.resolve_macro(name, macros, symbols)
            except KeyError:
                return False
            if name not in warned and xacro.verbosity > 0:
                warned.add(name)
                print(f"xacro: warning: {getattr(node, _PLACE, '')}: macro '{name}' is called without prefix; write "
                      f"<xacro:{name}> (Noetic ignores the old form, here it is expanded)", file=sys.stderr)
            node.tagName = node.nodeName = f"xacro:{name}"
        return original(node, macros, symbols)

    xacro.handle_macro_call = handle_macro_call


def _place_of(error: BaseException) -> str:
    """Place of the innermost element that the failing call chain was working on, '' if unknown."""
    place = ""
    trace = error.__traceback__
    while trace is not None:
        for value in trace.tb_frame.f_locals.values():
            if isinstance(value, xml.dom.minidom.Element) and hasattr(value, _PLACE):
                place = getattr(value, _PLACE)
        trace = trace.tb_next
    return place


def _shortened(text: str, most: int = 300) -> str:
    return text if len(text) <= most else f"{text[:most - most // 3]} ... {text[-(most // 3):]}"


def _fail(message: str, verbosity: int, error: BaseException) -> None:
    lines = message.splitlines() or [""]
    print("\n".join([f"xacro: error: {_shortened(lines[0])}"] + [_shortened(line) for line in lines[1:_LINES]]), file=sys.stderr)
    if verbosity > 0:
        for stack in (xacro.macrostack, xacro.filestack):
            del (stack or [])[:-_LINES]  # the outer ones of what calls itself
        xacro.print_location()
    if verbosity > 1:
        raise error
    sys.exit(2)


def install() -> None:
    """Put this module's functions into the module ``xacro``; done once, by its import."""
    xacro.parse = _parse
    xacro.safe_eval = safe_eval
    bound_symbols(xacro._global_symbols)
    _keep_place_in_clones()
    _accept_macros_without_prefix()


def main() -> None:
    """Expand one file to standard output or to ``-o FILE``. Exit code 2 on any error, as upstream."""
    options, file_name = xacro.cli.process_args(sys.argv[1:])
    if options.root_dir:
        xacro.root_dir = options.root_dir
    try:
        doc = xacro.process_file(file_name, **vars(options))
        text = " ".join(sorted(set(xacro.all_includes))) if options.just_deps else doc.toprettyxml(indent="  ")
        if options.output:
            with xacro.open_output(options.output) as out:
                out.write(text)
        else:
            sys.stdout.write(text)
    except ExpatError as error:
        file = (xacro.filestack or [file_name])[-1]
        _fail(f"{file}:{error.lineno}: not well-formed XML: {error}", options.verbosity, error)
    except BrokenPipeError:
        os._exit(1)  # the reader went away (`xacro f | head`): nothing to report, nothing left to flush
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as error:  # noqa: BLE001  expressions in a xacro file may raise anything
        place = _place_of(error)
        if isinstance(error, RecursionError) or isinstance(getattr(error, "exc", None), RecursionError):
            _fail(f"{place or file_name}: nests too deep; does a macro or a file include itself?", options.verbosity, error)
        cause = getattr(error, "exc", None)
        message = str(cause if isinstance(cause, PackageNotFoundError) else error) or repr(error)
        _fail(f"{place}: {message}" if place and not message.startswith(place) else message, options.verbosity, error)
