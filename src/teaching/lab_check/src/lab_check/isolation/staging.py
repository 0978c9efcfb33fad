"""A submission, whatever it is, into the source folder of a workspace of its own."""

from __future__ import annotations

import bz2
import contextlib
import gzip
import io
import lzma
import os
import pathlib
import re
import resource
import signal
import stat
import tarfile
import xml.etree.ElementTree as ET
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass, field
from types import FrameType
from typing import IO, Any

from ..errors import LabError
from .untrusted_files import open_regular

_LEFT_OUT = {".git", ".svn", ".hg", "build", "devel", "install", "logs", ".catkin_tools", ".catkin_workspace", "__pycache__", "__MACOSX"}
_MOST_FILES = 20000
_DEEP = 30
_MANIFEST = 1_000_000  # bytes of a package.xml
_HEADER = 1 << 20  # bytes of a name, or of other facts of one file, in a tar
_LONGEST_NAME = 255  # bytes, of one part of a path
_MEMORY, _TIME = 2e9, 120.0  # bytes and s of processor time that taking a submission may need
_READERS = ((b"\x1f\x8b", gzip.open), (b"BZh", bz2.open), (b"\xfd7zXZ\x00", lzma.open), (b"\x5d\x00\x00", lzma.open))


class StagingError(LabError, ValueError):
    """The submission cannot be taken; a sentence for the student."""


@dataclass
class Staged:
    """``packages`` from name to folder below the source folder; ``notes`` what was left out, and why."""

    packages: dict[str, pathlib.Path] = field(default_factory=dict)
    notes: list[str] = field(default_factory=list)
    files: int = 0
    size: int = 0


@contextlib.contextmanager
def within_bounds(memory: float = _MEMORY, seconds: float = _TIME) -> Iterator[None]:
    """Whatever a submission's own bytes make a reader do ends as the submission's fault. For the main thread.

    :param memory: bytes. :param seconds: of processor time
    :raises StagingError: more was needed
    """
    soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    most = int(memory) if soft == resource.RLIM_INFINITY else min(int(memory), soft)

    def over(number: int, frame: FrameType | None) -> None:
        raise StagingError(f"the submission takes more than {seconds:.0f} s to unpack")

    before = signal.signal(signal.SIGPROF, over)
    resource.setrlimit(resource.RLIMIT_DATA, (most, hard))
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    except MemoryError:
        raise StagingError(f"the submission needs more than {memory / 1e9:g} GB of memory to unpack") from None
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))
        signal.signal(signal.SIGPROF, before)


def stage(submission: pathlib.Path, source: pathlib.Path, limit: float) -> Staged:
    """Copies regular files only; links are followed nowhere.

    :param submission: a folder, or a .zip, .tar, .tar.gz
    :param source: ``src`` of the workspace; made here
    :param limit: bytes
    :raises StagingError: nothing there, no package, too large
    """
    staged = Staged()
    source.mkdir(parents=True)
    unpack(submission, source, limit, staged)
    if not staged.files:
        why = f" ({'; '.join(staged.notes[:3])[:300]})" if staged.notes else ""
        raise StagingError(f"the submission is empty: no file in it can be taken{why}")
    before = len(staged.notes)
    staged.packages = _packages(source, staged.notes)
    if not staged.packages:
        if staged.notes[before:]:
            raise StagingError(f"there is no package that could be built: {'; '.join(staged.notes[before:])[:500]}")
        raise StagingError(
            "no package.xml is in the submission, so there is no catkin package to build; hand in the folder that holds your packages"
        )
    return staged


def unpack(submission: pathlib.Path, source: pathlib.Path, limit: float, staged: Staged) -> None:
    """The files of a submission, whatever it is, below ``source``.

    :param limit: bytes. :param staged: is told what was left out and changed
    :raises StagingError: it is no submission, too large, or cannot be read
    """
    name = _show(submission.name)
    if submission.is_symlink() and not submission.exists():
        raise StagingError(f"{name} is a link that leads nowhere")
    try:
        if submission.is_dir():
            if submission.resolve() == pathlib.Path("/"):
                raise StagingError(f"{name} is a link to /, no submission")
            _copy(submission, source / _safe(submission.resolve().name), limit, staged)
        elif not submission.exists():
            raise StagingError(f"there is no {_show(str(submission))}")
        elif not submission.is_file():
            raise StagingError(f"{name} is no regular file")
        elif zipfile.is_zipfile(submission):
            _unzip(submission, source, limit, staged)
        elif not _untar(submission, source, limit, staged):
            raise StagingError(f"{name} is neither a folder nor a zip or tar archive")
    except (StagingError, MemoryError):
        raise
    except Exception as error:  # what an archive's bytes can make its reader do has no end; none of it is the checker's fault
        raise StagingError(f"{name} cannot be unpacked: {_show(str(error) or type(error).__name__)}") from error


def _safe(name: str) -> str:
    """CMake and make take a path apart at blanks and the like."""
    return "".join(c if c.isascii() and (c.isalnum() or c in "._-+") else "_" for c in name) or "submission"


def _walk(folder: pathlib.Path, notes: list[str], depth: int = 0) -> Iterator[tuple[pathlib.Path, os.DirEntry]]:
    if depth > _DEEP:
        notes.append(f"folders more than {_DEEP} deep were left out")
        return
    try:
        entries = sorted(os.scandir(folder), key=lambda e: e.name)
    except OSError as error:
        notes.append(f"the folder {_show(folder.name)} cannot be read and was left out: {error.strerror}")
        return
    for entry in entries:
        if entry.is_symlink():
            # A link within its own package is common; one that leaves the submission is a door.
            leads = "" if os.path.exists(os.path.realpath(entry.path)) else " (this one leads nowhere)"
            notes.append(f"{_show(entry.name)}: a link to {_show(os.readlink(entry.path))}; links are left out{leads}")
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
        place = target / folder.relative_to(submission) / entry.name
        try:
            with open_regular(folder, entry.name) as stream:
                information = os.fstat(stream.fileno())
                _count(staged, information.st_size, limit, entry.name)
                _write(stream, place, information.st_size, information.st_mode, entry.name)
        except OSError as error:
            staged.notes.append(f"{_show(entry.name)} cannot be read: {error.strerror}")


def _write(stream: IO[bytes], place: pathlib.Path, size: int, mode: int, name: str) -> None:
    place.parent.mkdir(parents=True, exist_ok=True)
    with open(place, "wb") as out:
        _pour(stream, out, size, name)
    place.chmod(0o644 | (mode & stat.S_IXUSR and 0o111))


def _inside(source: pathlib.Path, name: str, notes: list[str]) -> pathlib.Path | None:
    parts = pathlib.PurePosixPath(name.replace("\\", "/")).parts
    if not parts or ".." in parts or parts[0] == "/" or "\0" in name or len(parts) > _DEEP:
        notes.append(f"{_show(name)[:200]} would be written outside; left out")
        return None
    if any(len(os.fsencode(part)) > _LONGEST_NAME for part in parts):
        notes.append(f"{_show(name)[:60]}... has a name longer than a file's can be; left out")
        return None
    if _LEFT_OUT.intersection(parts[:-1]):
        return None
    place = source.joinpath(*parts)
    if place.exists() or any(parent.is_file() for parent in place.parents):
        notes.append(f"{_show(name)[:200]} is in the archive twice, or stands for a file and a folder; the first counts")
        return None
    return place


def _unzip(archive: pathlib.Path, source: pathlib.Path, limit: float, staged: Staged) -> None:
    if archive.stat().st_size > 2 * limit:
        raise StagingError(f"{_show(archive.name)} is larger than {limit / 1e6:.0f} MB; leave build folders, bags and videos out")
    with zipfile.ZipFile(archive) as file:
        for entry in file.infolist():
            mode = entry.external_attr >> 16
            if stat.S_ISLNK(mode):
                _left_link(entry.filename, "", staged, limit)
            if entry.is_dir() or stat.S_ISLNK(mode):
                continue
            if entry.flag_bits & 1:
                raise StagingError(f"{_show(archive.name)} is encrypted; hand it in without a password")
            place = _inside(source, entry.filename, staged.notes)
            if place is not None:
                _count(staged, entry.file_size, limit, entry.filename)
                with file.open(entry) as stream:
                    _write(stream, place, entry.file_size, mode, entry.filename)


def _left_link(name: str, to: str, staged: Staged, limit: float) -> None:
    _count(staged, 0, limit, name)
    staged.notes.append(f"{_show(name)[:200]}: a link{' to ' + _show(to)[:200] if to else ''}; links are left out")


def _twin(source: pathlib.Path, entry: tarfile.TarInfo, staged: Staged, limit: float) -> None:
    """A file with two names: tar holds the second as a link to the first, which is unpacked already."""
    parts = pathlib.PurePosixPath(entry.linkname).parts
    first = source.joinpath(*parts)
    if not parts or ".." in parts or parts[0] == "/" or not first.is_file():
        _left_link(entry.name, entry.linkname, staged, limit)
        return
    place = _inside(source, entry.name, staged.notes)
    if place is not None:
        with open(first, "rb") as stream:
            information = os.fstat(stream.fileno())
            _count(staged, information.st_size, limit, entry.name)
            _write(stream, place, information.st_size, information.st_mode, entry.name)


def _untar(archive: pathlib.Path, source: pathlib.Path, limit: float, staged: Staged) -> bool:
    """Returns False where that is no tar, packed or not."""
    with open(archive, "rb") as file:
        begin = file.read(6)
        file.seek(0)
        reader = next((opened for magic, opened in _READERS if begin.startswith(magic)), None)
        counted: Any = _Counted(reader(file) if reader else file, 2 * limit + _HEADER)
        try:
            tar = tarfile.open(fileobj=counted, mode="r:")
        except tarfile.ReadError:
            if reader:
                raise
            return False
        with tar:
            for entry in tar:
                if entry.issym():
                    _left_link(entry.name, entry.linkname, staged, limit)
                elif entry.islnk():
                    _twin(source, entry, staged, limit)
                content = tar.extractfile(entry) if entry.isfile() else None
                if content is None:
                    continue
                place = _inside(source, entry.name, staged.notes)
                if place is not None:
                    _count(staged, entry.size, limit, entry.name)
                    with content as stream:
                        _write(stream, place, entry.size, entry.mode, entry.name)
        while counted.read(1 << 16):  # what packed it ends with a sum of all
            pass
    return True


class _Counted:
    """A stream that gives no more than so many bytes in all, and no more at once than a header of a tar, or a piece of a file, can need."""

    def __init__(self, stream: io.BufferedIOBase, most: float):
        self._stream, self._most = stream, most

    def read(self, size: int = -1) -> bytes:
        if size < 0:
            raise StagingError("the archive is damaged: a file in it has less than no bytes")
        if size > 2 * _HEADER:
            raise StagingError(f"a name in the archive claims to be {size / 1e6:.0f} MB long")
        self._count(size)
        return self._stream.read(size)

    def seek(self, position: int, whence: int = os.SEEK_SET) -> int:
        if whence == os.SEEK_SET:
            self._count(max(position - self._stream.tell(), 0))
        return self._stream.seek(position, whence)

    def tell(self) -> int:
        return self._stream.tell()

    def _count(self, more: int) -> None:
        if self._stream.tell() + more > self._most:
            raise StagingError(f"the archive unpacks to more than {self._most / 1e6:.0f} MB; leave build folders, bags and videos out")


def _pour(stream: IO[bytes], out: IO[bytes], size: int, name: str) -> None:
    """No more than the archive's own table announces: a bomb lies about its size."""
    while chunk := stream.read(min(1 << 20, size + 1)):
        size -= len(chunk)
        if size < 0:
            raise StagingError(f"{_show(name)} unpacks to more than the archive says")
        out.write(chunk)


def _packages(source: pathlib.Path, notes: list[str]) -> dict[str, pathlib.Path]:
    found: dict[str, pathlib.Path] = {}
    for manifest in sorted(source.rglob("package.xml")):
        shown = _show(str(manifest.relative_to(source)))
        name, problem = _name_of(manifest)
        if name is None:
            notes.append(f"{shown} {problem}")
        elif name in found:
            notes.append(
                f"package {name} is there twice ({_show(str(found[name].relative_to(source)))} and "
                f"{_show(str(manifest.parent.relative_to(source)))}); the second is left out"
            )
            (manifest.parent / "CATKIN_IGNORE").touch()
        else:
            found[name] = manifest.parent
    return found


def _name_of(manifest: pathlib.Path) -> tuple[str | None, str]:
    """The package's name, or None and why there is none."""
    if not manifest.is_file():
        return None, "is no file"
    if manifest.stat().st_size > _MANIFEST:
        return None, f"is larger than {_MANIFEST / 1e6:.0f} MB"
    try:
        name = (ET.fromstring(manifest.read_bytes()).findtext("name") or "").strip()
    except MemoryError:
        raise
    except Exception as error:  # no XML, an encoding that nobody knows, entities without end ...
        return None, f"is no XML that can be read: {_show(str(error))[:200]}"
    if not name:
        return None, "has no <name>"
    if not re.fullmatch("[A-Za-z0-9_-]{1,100}", name):
        return None, f"has the name {name[:40]!r}; a package's has letters, digits and _"
    return name, ""
