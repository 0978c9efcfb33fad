"""Files of a submission, opened as what they are at that moment: regular, within its folder, and no more of them than a bound says.
Programs of the submission may put a link, a pipe or another file in the place of one that was looked at before."""

from __future__ import annotations

import os
import pathlib
import re
import stat
from collections.abc import Iterator, Sequence
from fnmatch import translate
from typing import BinaryIO

_MOST_FILES = 50_000  # that are looked at for one pattern
_DEEP = 60  # folders in each other that are looked into: whoever goes down by recursion, or by whole paths, ends at some hundred


def open_regular(folder: str | os.PathLike, name: str | os.PathLike) -> BinaryIO:
    """
    :param folder: one that the submission cannot put something else in the place of
    :param name: below ``folder``; no part of it may be a link
    :raises OSError: it is not there, no regular file, or behind a link
    """
    parts = pathlib.PurePath(name).parts
    if not parts or ".." in parts or pathlib.PurePath(name).is_absolute():
        raise OSError(f"{name} lies outside of its folder")
    here = _open_folder(folder, parts[:-1])
    try:
        number = os.open(parts[-1], os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY, dir_fd=here)
    finally:
        os.close(here)
    if not stat.S_ISREG(os.fstat(number).st_mode):
        os.close(number)
        raise OSError(f"{name} is no regular file")
    return os.fdopen(number, "rb")


def _open_folder(folder: str | os.PathLike, parts: Sequence[str]) -> int:
    """Descriptor of a folder below another one.

    :raises OSError: one of ``parts`` is a link, or no folder
    """
    here = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        for part in parts:
            below = os.open(part, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC, dir_fd=here)
            os.close(here)
            here = below
    except OSError:
        os.close(here)
        raise
    return here


def read_regular(folder: str | os.PathLike, name: str | os.PathLike, most: int) -> bytes:
    """The first ``most`` bytes of ``name`` in ``folder``.

    :raises OSError: as :func:`open_regular`
    """
    with open_regular(folder, name) as file:
        return file.read(most)


def walk(folder: str | os.PathLike, below: str | os.PathLike = "", left_out: Sequence[str] = ()) -> Iterator[tuple[str, os.stat_result]]:
    """(path below ``folder``, what it is) of all that is no folder; no link is followed, and none is gone through. What goes meanwhile, or
    cannot be read, or lies behind more than ``_DEEP`` folders, is left out.

    :param folder: one that the submission cannot put something else in the place of
    :param below: where to begin, a path below ``folder``
    :param left_out: names of folders that are not looked into
    """
    waiting = [tuple(pathlib.PurePath(below).parts)]
    while waiting:
        parts = waiting.pop()
        try:
            here = _open_folder(folder, parts)
        except OSError:
            continue
        folders = []
        try:
            for name in sorted(os.listdir(here)):
                try:
                    information = os.stat(name, dir_fd=here, follow_symlinks=False)
                except OSError:
                    continue
                if not stat.S_ISDIR(information.st_mode):
                    yield "/".join((*parts, name)), information
                elif len(parts) < _DEEP and name not in left_out:
                    folders.append((*parts, name))
        except OSError:
            pass
        finally:
            os.close(here)
        waiting += reversed(folders)


def matching(folder: pathlib.Path, pattern: str, anywhere: bool = False, below: str | os.PathLike = "") -> list[str]:
    """Paths below ``folder / below`` of regular files that fit a pattern of a shell: ``*`` for a part of a path, ``**`` for any number of
    folders.

    :param folder, below: as in :func:`walk`
    :param anywhere: in any folder below, too
    """
    parts = [part for part in pattern.split("/") if part not in ("", ".")]
    wanted = [None if part == "**" else re.compile(translate(part)) for part in ((["**"] if anywhere else []) + parts)]
    skip, found = len(pathlib.PurePath(below).parts), []
    for count, (path, information) in enumerate(walk(folder, below)):
        if count >= _MOST_FILES:
            break
        names = tuple(path.split("/"))[skip:]
        if stat.S_ISREG(information.st_mode) and _fits(names, wanted):
            found.append("/".join(names))
    return sorted(found)


def _fits(names: tuple[str, ...], wanted: list) -> bool:
    """Whether the parts of a path fit; in time proportional to both, whatever the pattern."""
    reached = {0}
    for name in (*names, None):
        for index in sorted(reached):  # ** may stand for no folder
            while index < len(wanted) and wanted[index] is None:
                index += 1
                reached.add(index)
        if name is None:
            return len(wanted) in reached
        reached = {
            index if wanted[index] is None else index + 1
            for index in reached
            if index < len(wanted) and (wanted[index] is None or wanted[index].match(name))
        }
    return False
