"""Submissions, specs and reports as bytes: the machines of a cluster need no common disk."""

from __future__ import annotations

import io
import os
import pathlib
import tarfile

from ..errors import LabError
from ..specs.spec import Spec


class TooLarge(LabError, ValueError):
    """More than a submission may hold; it is not sent anywhere."""


def pack(path: pathlib.Path, most: float = float("inf")) -> bytes:
    """A tar of a file or a folder under its own name. Links stay links, and are followed nowhere but in ``path`` itself.

    :param most: bytes
    :raises TooLarge: it holds more
    :raises OSError: it cannot be read
    """
    resolved = path.resolve()
    if resolved == pathlib.Path("/"):  # which the examiner shall see as the student's link to /
        resolved = path
    size = 0

    def counted(entry: tarfile.TarInfo) -> tarfile.TarInfo | None:
        nonlocal size
        size += entry.size
        if size > most:
            raise TooLarge(f"{path.name} holds more than {most / 1e6:.0f} MB")
        return entry if entry.isfile() or entry.isdir() or entry.issym() or entry.islnk() else None

    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w") as archive:
        try:
            archive.add(resolved, path.name, filter=counted)
        except RecursionError:
            raise TooLarge(f"{path.name} has too many folders in each other") from None
    return stream.getvalue()


def unpack(parcel: bytes, folder: pathlib.Path) -> None:
    """What :func:`pack` made, ``parcel``, into ``folder``."""
    folder.mkdir(parents=True, exist_ok=True)
    with tarfile.open(fileobj=io.BytesIO(parcel)) as archive:
        if hasattr(archive, "extraction_filter"):
            archive.extraction_filter = staticmethod(lambda member, path: member)  # packed by ourselves, links and all
        archive.extractall(folder)


def pack_spec(spec: Spec) -> tuple[bytes, str]:
    """The spec with what it names beside itself.

    :returns: a tar that keeps how the files lie to each other; the spec's path in it
    """
    folder = spec.path.parent
    named = {spec.path} | {(folder / name).resolve() for name in spec.data["also"]}
    for task in spec.data["tasks"]:
        named |= {(folder / e["python"]["file"]).resolve() for e in task["expect"] if "python" in e}
    root = os.path.commonpath([str(path.parent) for path in named])
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w") as archive:
        for path in sorted(named):
            archive.add(path, os.path.relpath(path, root))
    return stream.getvalue(), os.path.relpath(spec.path, root)
