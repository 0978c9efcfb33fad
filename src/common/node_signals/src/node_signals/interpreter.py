"""``#!/usr/bin/env python`` of nodes: on Ubuntu the package python-is-python3 says what that is, Debian alone has none."""
from __future__ import annotations

import os
import shutil
from typing import MutableMapping

_DEBIANS = "/usr/bin/python3"
_HERE = os.path.dirname(os.path.abspath(__file__))
#: Folder with a ``python`` and nothing else: in the sources, installed.
_FOLDERS = [os.path.join(_HERE, "../../python"), os.path.join(_HERE, "../../../../share/node_signals/python")]


def supply_python(environment: MutableMapping[str, str]) -> None:
    """Nodes started with this environment find Debian's Python 3 under the name ``python``, where that would be missing or
    another interpreter (pyenv's, conda's) than ``python3``. Where ``python3`` is not Debian's, all stays as it is."""
    path = environment.get("PATH", os.defpath)
    third, plain = shutil.which("python3", path=path), shutil.which("python", path=path)
    if third is None or os.path.realpath(third) != os.path.realpath(_DEBIANS):
        return
    if plain is not None and os.path.realpath(plain) == os.path.realpath(third):
        return
    folder = next((os.path.normpath(folder) for folder in _FOLDERS if os.access(os.path.join(folder, "python"), os.X_OK)), None)
    if folder is not None and not path.startswith(folder + os.pathsep):
        environment["PATH"] = folder + os.pathsep + path
