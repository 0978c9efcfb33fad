"""A submission, whatever it is, into the source folder of a workspace of its own."""

from __future__ import annotations

import os
import pathlib
import shutil
import stat
import tarfile
import xml.etree.ElementTree as ET
import zipfile
from dataclasses import dataclass, field
from typing import Dict, Iterator, List, Tuple

from .errors import LabError

_LEFT_OUT = {".git", ".svn", ".hg", "build", "devel", "install", "logs", ".catkin_tools", ".catkin_workspace", "__pycache__", "__MACOSX"}
_MOST_FILES = 20000
_DEEP = 30


class StagingError(LabError, ValueError):
    """The submission cannot be taken; a sentence for the student."""


@dataclass
class Staged:
    """``packages`` from name to folder below the source folder; ``notes`` what was left out, and why."""

    packages: Dict[str, pathlib.Path] = field(default_factory=dict)
    notes: List[str] = field(default_factory=list)
    files: int = 0
    size: int = 0


def stage(submission: pathlib.Path, source: pathlib.Path, limit: float) -> Staged:
    """Copies regular files only; links are followed nowhere.

    :param submission: a folder, or a .zip, .tar, .tar.gz
    :param source: ``src`` of the workspace; made here
    :param limit: bytes
    :raises StagingError: nothing there, no package, too large
    """
    staged = Staged()
    source.mkdir(parents=True)
    if submission.is_symlink() and not submission.exists():
        raise StagingError(f"{submission.name} is a link that leads nowhere")
    if submission.is_dir():
        if submission.resolve() == pathlib.Path("/"):
            raise StagingError(f"{submission.name} is a link to /, no submission")
        _copy(submission, source / _safe(submission.resolve().name), limit, staged)
    elif zipfile.is_zipfile(submission) if submission.is_file() else False:
        _unzip(submission, source, limit, staged)
    elif submission.is_file() and tarfile.is_tarfile(submission):
        _untar(submission, source, limit, staged)
    elif submission.is_file():
        raise StagingError(f"{submission.name} is neither a folder nor a zip or tar archive")
    else:
        raise StagingError(f"there is no {submission}")
    if not staged.files:
        raise StagingError("the submission is empty: no file in it can be taken")
    before = len(staged.notes)
    staged.packages = _packages(source, staged.notes)
    if not staged.packages:
        if staged.notes[before:]:
            raise StagingError(f"there is no package that could be built: {'; '.join(staged.notes[before:])[:500]}")
        raise StagingError(
            "no package.xml is in the submission, so there is no catkin package to build; hand in the folder that holds your packages"
        )
    return staged


def _safe(name: str) -> str:
    """CMake and make take a path apart at blanks and the like."""
    return "".join(c if c.isascii() and (c.isalnum() or c in "._-+") else "_" for c in name) or "submission"


def _walk(folder: pathlib.Path, notes: List[str], depth: int = 0) -> Iterator[Tuple[pathlib.Path, os.DirEntry]]:
    if depth > _DEEP:
        notes.append(f"folders more than {_DEEP} deep were left out")
        return
    with os.scandir(folder) as entries:
        for entry in sorted(entries, key=lambda e: e.name):
            if entry.is_symlink():
                target = os.readlink(entry.path)
                resolved = os.path.realpath(entry.path)
                # A link within its own package is common; one that leaves the submission is a door.
                notes.append(
                    f"{_show(entry.name)}: a link to {_show(target)}; links are left out"
                    + ("" if os.path.exists(resolved) else " (this one leads nowhere)")
                )
            elif entry.is_dir(follow_symlinks=False):
                if entry.name not in _LEFT_OUT or (pathlib.Path(entry.path) / "package.xml").is_file():
                    yield from _walk(pathlib.Path(entry.path), notes, depth + 1)
            elif entry.is_file(follow_symlinks=False):
                yield folder, entry
            else:
                notes.append(f"{_show(entry.name)} is no regular file and was left out")


def _show(name: str) -> str:
    return name.encode("utf-8", "backslashreplace").decode()


def _count(staged: Staged, size: int, limit: float, name: str) -> None:
    staged.files += 1
    staged.size += size
    if staged.size > limit:
        raise StagingError(
            f"the submission is larger than {limit / 1e6:.0f} MB (at {_show(name)}); leave build folders, bags and videos out"
        )
    if staged.files > _MOST_FILES:
        raise StagingError(f"the submission has more than {_MOST_FILES} files")


def _copy(submission: pathlib.Path, target: pathlib.Path, limit: float, staged: Staged) -> None:
    for folder, entry in _walk(submission, staged.notes):
        information = entry.stat(follow_symlinks=False)
        _count(staged, information.st_size, limit, entry.name)
        place = target / folder.relative_to(submission)
        place.mkdir(parents=True, exist_ok=True)
        try:
            shutil.copyfile(entry.path, place / entry.name, follow_symlinks=False)
        except OSError as error:
            staged.notes.append(f"{_show(entry.name)} cannot be read: {error.strerror}")
            continue
        (place / entry.name).chmod(0o644 | (information.st_mode & stat.S_IXUSR and 0o111))


def _inside(source: pathlib.Path, name: str, notes: List[str]) -> "pathlib.Path | None":
    parts = pathlib.PurePosixPath(name.replace("\\", "/")).parts
    if not parts or ".." in parts or parts[0] == "/" or "\0" in name or len(parts) > _DEEP:
        notes.append(f"{_show(name)} would be written outside; left out")
        return None
    if _LEFT_OUT.intersection(parts[:-1]):
        return None
    return source.joinpath(*parts[:-1], parts[-1])


def _unzip(archive: pathlib.Path, source: pathlib.Path, limit: float, staged: Staged) -> None:
    try:
        with zipfile.ZipFile(archive) as file:
            for entry in file.infolist():
                mode = entry.external_attr >> 16
                if entry.is_dir() or stat.S_ISLNK(mode):
                    continue
                place = _inside(source, entry.filename, staged.notes)
                if place is not None:
                    _count(staged, entry.file_size, limit, entry.filename)
                    place.parent.mkdir(parents=True, exist_ok=True)
                    with file.open(entry) as stream, open(place, "wb") as out:
                        _pour(stream, out, entry.file_size, entry.filename)
                    place.chmod(0o644 | (mode & 0o100 and 0o111))
    except (zipfile.BadZipFile, OSError, RuntimeError, NotImplementedError) as error:
        raise StagingError(f"{archive.name} cannot be unpacked: {error}") from error


def _untar(archive: pathlib.Path, source: pathlib.Path, limit: float, staged: Staged) -> None:
    try:
        with tarfile.open(archive) as file:
            for entry in file:
                if not entry.isfile():
                    continue
                place = _inside(source, entry.name, staged.notes)
                if place is not None:
                    _count(staged, entry.size, limit, entry.name)
                    place.parent.mkdir(parents=True, exist_ok=True)
                    with file.extractfile(entry) as stream, open(place, "wb") as out:
                        _pour(stream, out, entry.size, entry.name)
                    place.chmod(0o644 | (entry.mode & 0o100 and 0o111))
    except (tarfile.TarError, OSError, EOFError) as error:
        raise StagingError(f"{archive.name} cannot be unpacked: {error}") from error


def _pour(stream, out, size: int, name: str) -> None:
    """No more than the archive's own table announces: a bomb lies about its size."""
    while chunk := stream.read(min(1 << 20, size + 1)):
        size -= len(chunk)
        if size < 0:
            raise StagingError(f"{_show(name)} unpacks to more than the archive says")
        out.write(chunk)


def _packages(source: pathlib.Path, notes: List[str]) -> Dict[str, pathlib.Path]:
    found: Dict[str, pathlib.Path] = {}
    for manifest in sorted(source.rglob("package.xml")):
        shown = _show(str(manifest.relative_to(source)))
        try:
            name = (ET.parse(manifest).getroot().findtext("name") or "").strip()
        except (ET.ParseError, UnicodeDecodeError, ValueError, OSError) as error:
            notes.append(f"{shown} is no XML that can be read: {error}")
            continue
        if not name:
            notes.append(f"{shown} has no <name>")
        elif name in found:
            notes.append(
                f"package {name} is there twice ({found[name].relative_to(source)} and {manifest.parent.relative_to(source)}); "
                "the second is left out"
            )
            (manifest.parent / "CATKIN_IGNORE").touch()
        else:
            found[name] = manifest.parent
    return found
