"""Finds the mesh files that descriptions name."""
from __future__ import annotations

import os
from functools import lru_cache
from typing import Callable, Dict, Optional, Tuple
from urllib.parse import unquote

from motion import _core

FindPackage = Callable[[str], Optional[str]]


@lru_cache(maxsize=4)
def _packages_below(path: str) -> Dict[str, str]:
    """Folder name -> folder of every package below the roots; the first root wins."""
    found: Dict[str, str] = {}
    for root in filter(None, path.split(":")):
        for folder, folders, files in os.walk(root):
            if "package.xml" in files:
                found.setdefault(os.path.basename(folder), folder)
                folders.clear()
            folders[:] = sorted(f for f in folders if not f.startswith("."))
    return found


def find_package(name: str) -> Optional[str]:
    """Directory of a package below ROS_PACKAGE_PATH, by its folder's name; None if there is none."""
    path = os.environ.get("ROS_PACKAGE_PATH", "")
    found = _packages_below(path).get(name)
    if found is None or not os.path.isdir(found):
        _packages_below.cache_clear()
        found = _packages_below(path).get(name)
    return found


def resolve(uri: str, package: FindPackage = find_package) -> str:
    """Absolute path of what ``package://``, ``file://`` or a plain name says; "" when there is no such file."""
    scheme, separator, rest = uri.strip().partition("://")
    if not separator:
        path: Optional[str] = uri.strip()
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


def load_mesh(path: str, scale: Tuple[float, float, float] = (1.0, 1.0, 1.0), package: FindPackage = find_package) -> _core.Mesh:
    """A mesh of an STL, DAE, OBJ ... file; ``package://`` will do.

    :param scale: per axis.
    :raises InvalidInputError: there is no such file, or it holds no triangles.
    """
    found = resolve(path, package)
    if not found:
        raise _core.InvalidInputError(f"mesh file '{path[:120]}' is not found")
    return _core.Mesh._load(found, scale)
