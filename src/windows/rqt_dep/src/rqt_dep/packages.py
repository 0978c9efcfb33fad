"""Packages and what they depend on, as data and as DOT text. No Qt in here."""

from __future__ import annotations

import os
import xml.etree.ElementTree as ET
from dataclasses import dataclass

import rospkg
from rqt_graph.dotcode import passes, quoted

_TAGS = ("depend", "build_depend", "build_export_depend", "exec_depend", "run_depend")
DEPENDS, DEPENDS_ON, BOTH = "depends", "depends_on", "both"


@dataclass
class Options:
    """What to show: names and expressions, ``depth`` steps from them in one direction or both (0: all)."""

    name_filter: str = ""
    direction: str = DEPENDS
    depth: int = 3
    hide_transitive: bool = True
    system: bool = False  # also names that no package here has


def read_packages(rospack: rospkg.RosPack | None = None) -> dict[str, set[str]]:
    """Package -> names that its manifest depends on, of all packages on ROS_PACKAGE_PATH; what cannot be read has none."""
    rospack = rospack or rospkg.RosPack()
    packages: dict[str, set[str]] = {}
    for name in rospack.list():
        try:
            root = ET.parse(os.path.join(rospack.get_path(name), "package.xml")).getroot()
        except (OSError, ET.ParseError):
            packages[name] = set()
            continue
        packages[name] = {(element.text or "").strip() for tag in _TAGS for element in root.iter(tag)} - {"", name}
    return packages


def select(packages: dict[str, set[str]], options: Options) -> tuple[set[str], set[tuple[str, str]], set[str]]:
    """(packages shown, edges from a package to what it needs, those which the filter names), as ``options`` say.

    :param packages: name -> names of those it needs
    """
    names = set(packages) | ({need for needs in packages.values() for need in needs} if options.system else set())
    text = options.name_filter.strip()
    chosen = {name for name in names if passes(name, text)} if text else set()
    needs = {name: packages.get(name, set()) & names for name in names}
    users: dict[str, set[str]] = {name: set() for name in names}
    for name, below in needs.items():
        for need in below:
            users[need].add(name)
    shown = set(chosen)
    for table, wanted in ((needs, (DEPENDS, BOTH)), (users, (DEPENDS_ON, BOTH))):
        if options.direction in wanted:
            shown |= _reach(chosen, table, options.depth)
    edges = {(name, need) for name in shown for need in needs[name] & shown}
    return shown, _without_transitive(edges) if options.hide_transitive else edges, chosen


def _reach(start, table, depth) -> set[str]:
    seen, edge, step = set(start), set(start), 0
    while edge and (depth == 0 or step < depth):
        edge = {other for name in edge for other in table[name]} - seen
        seen |= edge
        step += 1
    return seen


def _without_transitive(edges):
    """The edges that no longer way replaces. In a loop of packages all of them stay."""
    table: dict[str, set[str]] = {}
    for start, end in edges:
        table.setdefault(start, set()).add(end)
    below = {name: _reach(table[name], {**dict.fromkeys({end for _, end in edges}, ()), **table}, 0) for name in table}
    return {
        (start, end)
        for start, end in edges
        if not any(end in below.get(other, ()) and start not in below.get(other, ()) for other in table[start] - {end})
    }


def generate_dot(packages: dict[str, set[str]], options: Options) -> str:
    """DOT text of what :func:`select` chooses from ``packages`` by ``options``.

    Packages that the filter names are red where others are shown too; what is not of this system is grey.
    """
    shown, edges, chosen = select(packages, options)
    if not shown:
        return 'digraph graphname { "none" [label="Type the name of a package above" shape=box]; }\n'
    lines = ["digraph graphname {", "rankdir=TB; ranksep=0.3;"]
    for name in sorted(shown):
        color = " color=red" if name in chosen and len(chosen) < len(shown) else "" if name in packages else " color=gray"
        lines.append(f"{quoted(name)} [label={quoted(name)} shape=box{color}];")
    return "\n".join([*lines, *(f"{quoted(start)} -> {quoted(end)};" for start, end in sorted(edges)), "}", ""])
