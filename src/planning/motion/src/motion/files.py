"""Finds the mesh files that descriptions name."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from functools import lru_cache
from urllib.parse import unquote

from motion import _core

FindPackage = Callable[[str], str | None]
_COMMENT, _NAME = re.compile(rb"<!--.*?-->", re.S), re.compile(rb"<name>\s*([^<\s]+)\s*</name>")


@lru_cache(maxsize=4)
def _packages_below(path: str) -> dict[str, str]:
    """Name -> folder of every package below the roots, links included; the first root wins."""
    found: dict[str, str] = {}
    for root in filter(None, path.split(":")):
        seen = set()  # real paths: a link may lead back up
        for folder, folders, files in os.walk(root, followlinks=True):
            real = os.path.realpath(folder)
            if real in seen or "CATKIN_IGNORE" in files:
                folders.clear()
                continue
            seen.add(real)
            if "package.xml" in files:
                found.setdefault(_name_in(os.path.join(folder, "package.xml")) or os.path.basename(folder), folder)
                folders.clear()
            folders[:] = sorted(f for f in folders if not f.startswith("."))
    return found


def _name_in(manifest: str) -> str:
    """The package's name, which need not be that of its folder; "" where it cannot be read."""
    try:
        with open(manifest, "rb") as file:
            name = _NAME.search(_COMMENT.sub(b"", file.read()))
    except OSError:
        return ""
    return name.group(1).decode(errors="replace") if name else ""


def find_package(name: str) -> str | None:
    """Directory of a package below ROS_PACKAGE_PATH, by the name in its package.xml; None if there is none."""
    path = os.environ.get("ROS_PACKAGE_PATH", "")
    found = _packages_below(path).get(name)
    if found is None or not os.path.isdir(found):
        _packages_below.cache_clear()
        found = _packages_below(path).get(name)
    return found


def resolve(uri: str, package: FindPackage = find_package) -> str:
    """Absolute path of what ``uri`` says, ``package://``, ``file://`` or a plain name; "" when there is no such file.

    :param package: gives the folder of a package, or "".
    """
    scheme, separator, rest = uri.strip().partition("://")
    if not separator:
        path: str | None = uri.strip()
    elif scheme == "file":
        path = unquote(rest)
        path = path if path.startswith("/") else "/" + path.partition("/")[2]
    elif scheme == "package":
        name, _, inside = unquote(rest).partition("/")
        folder = package(name)
        path = os.path.join(folder, inside) if folder else None
    else:
        path = None
    return os.path.abspath(path) if path and os.path.isfile(path) else ""


def load_mesh(path: str, scale: tuple[float, float, float] = (1.0, 1.0, 1.0), package: FindPackage = find_package) -> _core.Mesh:
    """A mesh of ``path``, an STL, DAE, OBJ ... file; ``package://`` will do.

    :param scale: per axis.
    :param package: as for :func:`resolve`.
    :raises InvalidInputError: there is no such file, or it holds no triangles.
    """
    found = resolve(path, package)
    if not found:
        raise _core.InvalidInputError(f"mesh file '{path[:120]}' is not found")
    return _core.Mesh._load(found, scale)
