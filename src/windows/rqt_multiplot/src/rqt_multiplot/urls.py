"""Where configurations are: plain names, ``file:///...``, ``home://...`` (below the home folder), ``package://NAME/...``."""

from __future__ import annotations

import os
from pathlib import Path
from urllib.parse import unquote

import rospkg
from qt_gui.errors import WindowError


class UrlError(WindowError, ValueError):
    """A URL that leads nowhere; one line that says why."""


def to_path(url: str) -> Path:
    """
    :raises UrlError: a package that is not there, or a scheme of another kind.
    """
    scheme, mark, rest = url.partition("://")
    if not mark:
        return Path(os.path.expanduser(url)).absolute()
    rest = unquote(rest)
    if scheme == "file":
        return Path("/" + rest.lstrip("/"))
    if scheme == "home":
        return Path.home() / rest.lstrip("/")
    if scheme == "package":
        package, _, below = rest.lstrip("/").partition("/")
        try:
            return Path(rospkg.RosPack().get_path(package)) / below
        except rospkg.ResourceNotFound:
            raise UrlError(f"{url}: there is no package '{package}'; build it and source its workspace") from None
    raise UrlError(f"{url}: '{scheme}' is no scheme of configurations; use file, home or package")


def to_url(path: Path) -> str:
    """The ``file://`` URL of a path."""
    return f"file://{path.absolute()}"
