"""Files of a submission, opened as what they are at that moment: regular, within its folder, and no more of them than a bound says.
Programs of the submission may put a link, a pipe or another file in the place of one that was looked at before."""
from __future__ import annotations

import os
import pathlib
import re
import stat
from fnmatch import translate
from typing import BinaryIO, Iterator, List, Tuple

_MOST_FILES = 50_000  # that are looked at for one pattern


def open_regular(folder: "str | os.PathLike", name: "str | os.PathLike") -> BinaryIO:
    """
    :param name: below ``folder``; no part of it may be a link
    :raises OSError: it is not there, no regular file, or behind a link
    """
    parts = pathlib.PurePath(name).parts
    if not parts or ".." in parts or pathlib.PurePath(name).is_absolute():
        raise OSError(f"{name} lies outside of its folder")
    here = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        for part in parts[:-1]:
            below = os.open(part, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW | os.O_CLOEXEC, dir_fd=here)
            os.close(here)
            here = below
        number = os.open(parts[-1], os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY, dir_fd=here)
    finally:
        os.close(here)
    if not stat.S_ISREG(os.fstat(number).st_mode):
        os.close(number)
        raise OSError(f"{name} is no regular file")
    return os.fdopen(number, "rb")


def read_regular(folder: "str | os.PathLike", name: "str | os.PathLike", most: int) -> bytes:
    """The first ``most`` bytes.

    :raises OSError: as :func:`open_regular`
    """
    with open_regular(folder, name) as file:
        return file.read(most)


def matching(folder: pathlib.Path, pattern: str, anywhere: bool = False) -> List[str]:
    """Paths below ``folder`` of regular files that fit a pattern of a shell: ``*`` for a part of a path, ``**`` for any number of folders.

    :param anywhere: in any folder below, too
    """
    parts = [part for part in pattern.split("/") if part not in ("", ".")]
    wanted = [None if part == "**" else re.compile(translate(part)) for part in ((["**"] if anywhere else []) + parts)]
    return sorted(path for path, names in _files(folder) if _fits(names, wanted))


def _files(folder: pathlib.Path) -> Iterator[Tuple[str, Tuple[str, ...]]]:
    count = 0
    for place, folders, files in os.walk(folder, followlinks=False):
        folders.sort()
        for name in sorted(files):
            path = os.path.join(place, name)
            count += 1
            if count > _MOST_FILES:
                return
            try:
                if stat.S_ISREG(os.lstat(path).st_mode):
                    relative = os.path.relpath(path, folder)
                    yield relative, tuple(relative.split("/"))
            except OSError:  # it went meanwhile
                continue


def _fits(names: Tuple[str, ...], wanted: list) -> bool:
    """Whether the parts of a path fit; in time proportional to both, whatever the pattern."""
    reached = {0}
    for name in (*names, None):
        for index in sorted(reached):  # ** may stand for no folder
            while index < len(wanted) and wanted[index] is None:
                index += 1
                reached.add(index)
        if name is None:
            return len(wanted) in reached
        reached = {index if wanted[index] is None else index + 1 for index in reached
                   if index < len(wanted) and (wanted[index] is None or wanted[index].match(name))}
    return False
