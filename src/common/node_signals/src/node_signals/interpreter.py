"""``python`` and ``python2`` in first lines of nodes: on Ubuntu a package (python-is-python3) gives the first, Debian has neither."""
from __future__ import annotations

import os
import shutil
from typing import MutableMapping, Optional

_DEBIANS = "/usr/bin/python3"
_HERE = os.path.dirname(os.path.abspath(__file__))
#: Places of the folders ``python`` and ``python2``, each with programs of that name and nothing else: in the sources, installed.
_PLACES = [os.path.join(_HERE, "../.."), os.path.join(_HERE, "../../../../share/node_signals")]


def supply_python(environment: MutableMapping[str, str]) -> None:
    """Nodes started with this environment find Debian's Python 3 under the name ``python``, where that would be missing or
    another interpreter (pyenv's, conda's) than ``python3``; and, where there is no ``python2``, one that runs what Python 3 can read
    and says what to do with the rest. Where ``python3`` is not Debian's, all stays as it is."""
    path = environment.get("PATH", os.defpath)
    third, plain = shutil.which("python3", path=path), shutil.which("python", path=path)
    if third is None or os.path.realpath(third) != os.path.realpath(_DEBIANS):
        return
    if shutil.which("python2", path=path) is None:
        _put_first("python2", environment)
    if plain is None or os.path.realpath(plain) != os.path.realpath(third):
        _put_first("python", environment)


def _put_first(name: str, environment: MutableMapping[str, str]) -> None:
    path = environment.get("PATH", os.defpath)
    folder = _folder(name)
    if folder is not None and folder not in path.split(os.pathsep):
        environment["PATH"] = folder + os.pathsep + path


def _folder(name: str) -> Optional[str]:
    folders = (os.path.normpath(os.path.join(place, name)) for place in _PLACES)
    return next((folder for folder in folders if os.access(os.path.join(folder, name), os.X_OK)), None)
