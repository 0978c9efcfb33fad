"""Files of packages, for meshes of robot models."""

from __future__ import annotations

from pathlib import Path
from urllib.parse import unquote

import rospkg

from foxglove_bridge.settings import allowed

MOST = 256 * 1024 * 1024  # bytes


def fetch(uri: str, patterns: tuple[str, ...]) -> bytes | None:
    """The file that ``uri``, ``package://NAME/PATH``, names; None if there is none, none of ``patterns`` allows it, or it lies outside."""
    if not allowed(uri, patterns) or not uri.startswith("package://"):
        return None
    name, _, inside = unquote(uri[len("package://") :]).partition("/")
    try:
        home = Path(rospkg.RosPack().get_path(name)).resolve()
        path = (home / inside).resolve()
        if home in path.parents and path.is_file() and path.stat().st_size <= MOST:
            return path.read_bytes()
    except (rospkg.ResourceNotFound, OSError, ValueError):
        pass
    return None
