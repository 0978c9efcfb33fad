"""First lines of nodes that name an interpreter which is not there.

``python``: on Ubuntu a package (python-is-python3) gives it; ``python2``, by its name or its path; Noetic's ``python3.8``; and any of
them with the line end of Windows, or with its mark of UTF-8 before the ``#!``. A name of which nothing but the shim of a version manager
(pyenv, asdf, mise) is on PATH, without such a version behind it, is not there either.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Iterator, MutableMapping

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
    if next(_answering("python2", path), None) is None:
        _put_first("python2", environment)
    if plain is None or os.path.realpath(plain) != os.path.realpath(third):
        _put_first("python", environment)


def as_it_can_run(program: str) -> tuple[list[str], str]:
    """The words that start ``program``, and a line saying what is different, or "".

    What the kernel starts is left to it. Scripts of Python whose first line names what is not there are given to Python.
    """
    try:
        with open(program, "rb") as file:
            first = file.readline(256)
    except OSError:
        return [program], ""
    marked, ended = first.startswith(b"\xef\xbb\xbf#!"), first.rstrip(b"\n").endswith(b"\r")
    if not marked and not first.startswith(b"#!"):
        return [program], ""
    words = [word for word in first.decode(errors="replace").partition("#!")[2].split() if word != "-S"]
    from_path = bool(words) and os.path.basename(words[0]) == "env"
    asked, *options = words[from_path:] or [""]
    python = re.fullmatch(r"python(\d?)[.\d]*", os.path.basename(asked))
    if python is None:
        return [program], f"{program}: its lines end as on Windows, which no shell takes: dos2unix {program}" if ended else ""
    path = os.environ.get("PATH", os.defpath)
    there = shutil.which(asked, path=path) if from_path else asked if os.access(asked, os.X_OK) else None
    if not marked and not ended and there and _answers(there):
        return [program], ""
    behind = next(_answering(asked, path), None) if from_path else None
    why = "its lines end as on Windows (dos2unix mends them)" if ended else "it begins with Windows' mark of UTF-8" if marked else ""
    if not why and not behind and "." in os.path.basename(asked) and python[1] == "3":
        why = f"its first line asks for {os.path.basename(asked)}, which is not here"
    interpreter = behind or (_second() if python[1] == "2" else _DEBIANS)
    runs = "" if python[1] == "2" else "; it runs with Python 3"  # what takes the place of python2 says so itself
    return [interpreter, *options, program], f"{program}: {why}{runs}" if why else ""


def _second() -> str:
    """python2, or what takes its place and says so."""
    found, folder = next(_answering("python2", os.environ.get("PATH", os.defpath)), None), _folder("python2")
    return found or (os.path.join(folder, "python2") if folder else _DEBIANS)


def _answering(name: str, path: str) -> Iterator[str]:
    """Programs of that name on PATH, less shims with nothing behind them."""
    found = (shutil.which(name, path=folder) for folder in path.split(os.pathsep) if folder)
    return (program for program in found if program and _answers(program))


def _answers(python: str) -> bool:
    """Whether it is an interpreter, and no shim that only says that there is none. What is clearly a program is not asked."""
    folder = os.path.dirname(python)
    if folder in (_folder("python2"), _folder("python")):
        return True
    try:
        with open(python, "rb") as file:
            if file.read(4) == b"\x7fELF" and os.path.basename(folder) != "shims":
                return True
        return subprocess.run([python, "-c", ""], stdin=subprocess.DEVNULL, capture_output=True, timeout=20, check=False).returncode == 0
    except (OSError, subprocess.SubprocessError):
        return False


def _put_first(name: str, environment: MutableMapping[str, str]) -> None:
    path = environment.get("PATH", os.defpath)
    folder = _folder(name)
    if folder is not None and folder not in path.split(os.pathsep):
        environment["PATH"] = folder + os.pathsep + path


def _folder(name: str) -> str | None:
    folders = (os.path.normpath(os.path.join(place, name)) for place in _PLACES)
    return next((folder for folder in folders if os.access(os.path.join(folder, name), os.X_OK)), None)
