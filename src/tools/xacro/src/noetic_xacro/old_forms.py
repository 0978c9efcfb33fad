"""What robots from before Noetic write without the prefix ``xacro:``: words (``<property>``, ``<if>``) and calls of macros.

Noetic's xacro leaves such elements alone, and so they are taken for xacro's only where a file that is right for Noetic would have no
such element: an element may have the name of a macro, and be one that the robot's description needs.
"""

from __future__ import annotations

import os
import sys
from typing import Any
from xml.dom.minidom import Element

from noetic_xacro.marks import AS_READ, CALLED, PLACE, PLAIN_INCLUDE
from noetic_xacro.reserved import RESERVED

_CUSTOM = frozenset({"plugin", "gazebo", "sensor"})  # elements of others, whose content has any names
# Words of xacro and the attribute by which they are told from others.
_WORDS = {
    "property": "name",
    "macro": "name",
    "arg": "default",
    "include": "filename",
    "insert_block": "name",
    "if": "value",
    "unless": "value",
}
_DEFINING = frozenset({"property", "arg", "include"})  # which nobody wrote into <gazebo> or <sensor>
_LAUNCH_WORDS = frozenset({"arg", "include"})
_SDF_ROOTS = frozenset({"sdf", "world", "launch"})

xacro: Any = None  # the module ``xacro``, once it is there
_prefixed: set[str] = set()  # names of macros that are called with prefix in the files read so far
_custom_calls: list[bool] = []  # of the macros being expanded: does the call stand in an element of others?
_warned: set[tuple[str, str]] = set()


def begin(document: Any) -> None:
    """``document``, which has been read, is going to be expanded."""
    _warned.clear()
    _custom_calls.clear()
    _prefixed.clear()
    _prefixed.update(getattr(document, CALLED, ()))


def _children(node: Any) -> list[Element]:
    return [child for child in node.childNodes if child.nodeType == child.ELEMENT_NODE]


def _elements(root: Element) -> list[tuple[Element, bool, bool]]:
    """All elements below ``root``; whether they stand in a plugin, and in another element of others."""
    found = []
    todo = [(child, False, False) for child in _children(root)]
    while todo:
        node, in_plugin, in_custom = todo.pop()
        found.append((node, in_plugin, in_custom))
        in_plugin = in_plugin or node.tagName == "plugin"
        in_custom = in_custom or node.tagName in _CUSTOM
        todo += [(child, in_plugin, in_custom) for child in _children(node)]
    return found


def read_file(root: Element, path: str) -> None:
    """Note how the elements of a file are written; ``<property .../>`` becomes ``<xacro:property .../>``, with one warning a file.

    :param root: the file's outermost element.
    :param path: the file, for the warning.
    """
    elements = _elements(root)
    tags = {node.tagName for node, _, _ in elements}
    called = {tag.removeprefix("xacro:") for tag in tags if tag.startswith("xacro:")}
    called.update(node.getAttribute("macro") for node, _, _ in elements if node.tagName == "xacro:call")
    setattr(root.ownerDocument, CALLED, called)
    _prefixed.update(called)
    found: list[tuple[str, str]] = []
    left: list[tuple[str, str]] = []
    for node, in_plugin, in_custom in elements:
        word = node.tagName
        setattr(node, AS_READ, word)
        if in_plugin or not _is_word(node, root, in_custom):
            continue
        if word != "include" and f"xacro:{word}" in tags:
            left += [(word, getattr(node, PLACE))] * (word not in _DEFINING)
            continue
        node.tagName = node.nodeName = f"xacro:{word}"
        if word == "include":
            setattr(node, PLAIN_INCLUDE, True)
        else:
            found.append((word, getattr(node, PLACE)))
    if found:
        _warn_of_word(*_first(found), f"{len(found)} such in {os.path.basename(path)}")
    if left:
        word, place = _first(left)
        _warn(f"{place}: <{word}> without prefix stays as it is, since <xacro:{word}> is written in this file, too")


def _first(found: list[tuple[str, str]]) -> tuple[str, str]:
    return min(found, key=lambda entry: int(entry[1].rsplit(":", 1)[1]))


def _is_word(node: Element, root: Element, in_custom: bool) -> bool:
    word = node.tagName
    if not node.hasAttribute(_WORDS.get(word, "")) or (in_custom and word in _DEFINING):
        return False
    if word in _LAUNCH_WORDS and root.tagName == "launch":
        return False
    return word != "include" or not _children(node)


def _warn(text: str) -> None:
    if xacro.verbosity > 0:
        print(f"xacro: warning: {text}", file=sys.stderr)


def _warn_of_word(word: str, place: str, count: str) -> None:
    _warn(
        f"{place}: <{word}> is written without prefix; write <xacro:{word}> (Noetic ignores the old form, here it is understood"
        f"{'; ' if count else ''}{count})"
    )


def _accept_includes() -> None:
    """``<include filename="..."/>`` of a file that is there; any other is an element of somebody else's."""
    original = xacro.process_include

    def process_include(node: Element, macros: Any, symbols: Any, evaluate: Any) -> None:
        if getattr(node, PLAIN_INCLUDE, False):
            if not _is_there(node.getAttribute("filename"), symbols):
                _warn(f"{getattr(node, PLACE, '')}: <include> is written without prefix and names no file that is there; it stays as it is")
                node.tagName = node.nodeName = "include"
                return evaluate(node, macros, symbols)
            file = str(getattr(node, PLACE, "")).rsplit(":", 1)[0]
            if ("<include>", file) not in _warned:
                _warned.add(("<include>", file))
                _warn_of_word("include", getattr(node, PLACE, ""), "")
        return original(node, macros, symbols, evaluate)

    xacro.process_include = process_include


def _is_there(written: str, symbols: Any) -> bool:
    try:
        name = xacro.abs_filename_spec(str(xacro.eval_text(written, symbols)))
    except xacro.XacroException:
        return False
    return any(character in name for character in "*[?") or os.path.exists(os.path.join(xacro.root_dir, name))


def _accept_macros() -> None:
    """``<wheel .../>`` for ``<xacro:wheel .../>``, with one warning a name.

    Without it the element stays in the URDF, is ignored there, and a robot without wheels or inertias is spawned.
    """
    original = xacro.handle_macro_call

    def handle_macro_call(node: Element, macros: Any, symbols: Any) -> bool:
        if node.tagName.startswith("xacro:"):
            _prefixed.add(node.tagName.removeprefix("xacro:"))
        elif _is_call(node, macros):
            node.tagName = node.nodeName = f"xacro:{node.tagName}"
        else:
            return original(node, macros, symbols)
        _custom_calls.append(_in_custom(node))
        try:
            return original(node, macros, symbols)
        finally:
            _custom_calls.pop()

    xacro.handle_macro_call = handle_macro_call


def _in_custom(node: Any) -> bool:
    node = node.parentNode
    while node is not None:
        if node.nodeName in _CUSTOM:
            return True
        node = node.parentNode
    return False


def _is_call(node: Any, macros: Any) -> bool:
    """Is this element without prefix a call of a macro?"""
    name = node.tagName
    if getattr(node, AS_READ, None) != name or name in RESERVED:  # <xacro:element> makes elements, never calls
        return False
    try:
        macro = macros[name]
    except KeyError:
        return False
    if not isinstance(macro, xacro.Macro) or any(other.body.getAttribute("name") == name for other in xacro.macrostack or []):
        return False  # the namespace of a file, or the element for whose sake there is the macro
    root = node.ownerDocument.documentElement
    if any(_custom_calls) or _in_custom(node) or (root is not None and root.tagName in _SDF_ROOTS):
        return False
    misfit = _misfit(node, macro)
    place = getattr(node, PLACE, "")
    if misfit or name in _prefixed:
        if misfit != "text" and bool(misfit) != (name in _prefixed):
            _warn_once(
                name,
                f"{place}: <{name}> stays as it is, though there is a macro of that name"
                f"{', which ' + misfit if misfit else ' and it is called with prefix elsewhere'}; to call it write <xacro:{name}>",
            )
        return False
    _warn_once(
        name, f"{place}: macro '{name}' is called without prefix; write <xacro:{name}> (Noetic ignores the old form, here it is expanded)"
    )
    return True


def _warn_once(name: str, text: str) -> None:
    if name not in {known for known, _ in _warned}:
        _warned.add((name, ""))
        _warn(text)


def _misfit(node: Element, macro: Any) -> str:
    """Why the macro cannot be meant: what it does that this element does not; '' if it can be."""
    if any(child.nodeType == child.TEXT_NODE and child.data.strip() for child in node.childNodes):
        return "text"
    given = {name for name in node.attributes.keys() if not name.startswith("xmlns")}
    blocks = sum(parameter.startswith("*") for parameter in macro.params)
    names = [parameter for parameter in macro.params if not parameter.startswith("*")]
    for parameter in names:
        if parameter not in given and parameter not in macro.defaultmap:
            return f"needs '{parameter}'"
    unknown = sorted(given.difference(names))
    if unknown:
        return f"has no parameter '{unknown[0]}'"
    children = _children(node)
    if len(children) != blocks and not (blocks and any(child.tagName.startswith("xacro:") for child in children)):
        return f"takes {blocks} blocks"
    return ""


def install(module: Any) -> None:
    """Put this module's functions into ``module``, which is ``xacro``."""
    global xacro
    xacro = module
    _accept_includes()
    _accept_macros()
