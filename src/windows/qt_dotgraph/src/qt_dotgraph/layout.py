"""Graphviz's layout of DOT text, as plain data. No Qt in here, so that it can run in any thread."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import dataclass, field

_PATIENCE = 20.0  # s; dot's search for few crossings has no end of its own
_LARGE = 150  # edges from which on it is cut short, and edges are straight
_QUICK = ["-Gnslimit=0.1", "-Gmclimit=0.05", "-Gsplines=line"]
# Clusters with labelled edges between them can be too much for dot ("trouble in init_rank"): another way of ranking helps, and
# without the boxes of clusters it always goes.
_WAYS_OUT = (["-Gnewrank=true"], [*_QUICK, "-Gclusterrank=none"])
_SHAPES = re.compile(r"^\s*(strict\s+)?(di)?graph\b", re.I)

Point = tuple[float, float]


class LayoutError(Exception):
    """DOT text that Graphviz refuses, or no Graphviz; one line."""


@dataclass
class Node:
    """A node: centre and size in points, y upwards; ``attributes`` are those of the DOT text."""

    name: str
    label: str
    center: Point
    size: Point
    attributes: dict[str, str] = field(default_factory=dict)


@dataclass
class Cluster:
    """A box around nodes: its corner with the least x and y, its size, and where its label is (points)."""

    name: str
    label: str
    corner: Point
    size: Point
    label_center: Point | None
    attributes: dict[str, str] = field(default_factory=dict)


@dataclass
class Edge:
    """An edge: names of its ends, the points of its Bezier curves (1 + 3 n), the tips of its arrows."""

    tail: str
    head: str
    label: str
    points: list[Point]
    start_tip: Point | None
    end_tip: Point | None
    label_center: Point | None
    attributes: dict[str, str] = field(default_factory=dict)


@dataclass
class Layout:
    """Everything of a graph; ``size`` is its width and height in points."""

    nodes: list[Node]
    clusters: list[Cluster]
    edges: list[Edge]
    size: Point


def layout(dot: str) -> Layout:
    """Lay out DOT text. Text that has positions already, as ``dot -Tdot`` writes it, keeps them.

    :raises LayoutError: not DOT, or Graphviz is missing.
    """
    command = ["neato", "-n2", "-Tjson"] if _has_positions(dot) else ["dot", "-Tjson", *_options(dot)]
    return _parse(_run(command, dot))


def render(dot: str, form: str) -> bytes:
    """The picture of the DOT text ``dot`` as ``form`` says: ``svg``, ``png``, ``pdf`` or ``dot`` (the text, with positions).

    :raises LayoutError: as above.
    """
    return _run(["dot", f"-T{form}", *_options(dot)], dot)


def _options(dot: str) -> list[str]:
    return _QUICK if dot.count("->") + dot.count("--") > _LARGE else []


def _has_positions(dot: str) -> bool:
    return re.search(r"\bpos=\"?-?[\de]", dot) is not None and "bb=" in dot


def _run(command: list[str], dot: str) -> bytes:
    if not _SHAPES.search(re.sub(r"/\*.*?\*/|//[^\n]*|^#[^\n]*", "", dot[:2000], flags=re.S | re.M)):
        raise LayoutError("this is not a graph in DOT (it begins with neither graph nor digraph)")
    reason = ""
    for further in ([], *_WAYS_OUT):
        try:
            done = subprocess.run([*command, *further], input=dot.encode(), capture_output=True, timeout=_PATIENCE)
        except FileNotFoundError as error:
            raise LayoutError("Graphviz is not installed; run scripts/setup (Debian package graphviz)") from error
        except subprocess.TimeoutExpired:
            reason = f"finds no layout within {_PATIENCE:g} s; hide some nodes or topics"
            continue
        if done.returncode == 0 and done.stdout:
            return done.stdout
        lines = done.stderr.decode(errors="replace").strip().splitlines() or ["no reason given"]
        reason = f"refuses the graph: {lines[0][:200]}"
        if "syntax error" in lines[0]:
            break
    raise LayoutError(f"Graphviz {reason}")


def _parse(data: bytes) -> Layout:
    graph = json.loads(data.decode(errors="replace"))
    objects = graph.get("objects", [])
    names = {thing["_gvid"]: thing["name"] for thing in objects}
    nodes, clusters = [], []
    for thing in objects:
        if "pos" in thing and thing.get("style") != "invis":
            size = (float(thing.get("width", 1)) * 72, float(thing.get("height", 0.5)) * 72)
            nodes.append(Node(thing["name"], _label(thing), _point(thing["pos"]), size, _texts(thing)))
        elif thing["name"].startswith("cluster") and thing.get("bb"):
            left, bottom, right, top = map(float, thing["bb"].split(","))
            clusters.append(
                Cluster(
                    thing["name"],
                    _label(thing, ""),
                    (left, bottom),
                    (right - left, top - bottom),
                    _point(thing["lp"]) if "lp" in thing else None,
                    _texts(thing),
                )
            )
    edges = [_edge(thing, names) for thing in graph.get("edges", []) if "pos" in thing and thing.get("style") != "invis"]
    left, bottom, right, top = map(float, (graph.get("bb") or "0,0,0,0").split(","))
    return Layout(nodes, clusters, edges, (right - left, top - bottom))


def _edge(thing, names) -> Edge:
    start = end = None
    points = []
    for part in thing["pos"].split(";")[0].split():
        if part.startswith("s,"):
            start = _point(part[2:])
        elif part.startswith("e,"):
            end = _point(part[2:])
        else:
            points.append(_point(part))
    return Edge(
        names[thing["tail"]],
        names[thing["head"]],
        _label(thing, ""),
        points,
        start,
        end,
        _point(thing["lp"]) if thing.get("lp") else None,
        _texts(thing),
    )


def _point(text: str) -> Point:
    x, y = text.rstrip("!").split(",")[:2]
    return float(x), float(y)


def _label(thing, otherwise=None) -> str:
    """The text to show; ``\\N`` and no label are the name, ``\\n`` breaks the line."""
    label = thing.get("label", thing["name"] if otherwise is None else otherwise)
    label = label.replace("\\N", thing.get("name", ""))
    return re.sub(r"\\([nlr\\\"])", lambda match: "\n" if match.group(1) in "nlr" else match.group(1), label).rstrip("\n")


def _texts(thing) -> dict[str, str]:
    return {key: value for key, value in thing.items() if isinstance(value, str) and not key.startswith("_")}
