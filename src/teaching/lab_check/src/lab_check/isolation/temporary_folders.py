"""Folders for the time of one examination. Whoever works in one holds its lock; what one that was killed left behind goes with the next."""

from __future__ import annotations

import contextlib
import fcntl
import os
import pathlib
import stat
import subprocess
import tempfile
import time
from collections.abc import Iterator

_YOUNG = 60.0  # s in which one may be made, but not locked yet


def top() -> pathlib.Path:
    """
    Where they are made: the machine's folder of temporary files. A private one, as pam_tmpdir gives to root, does not do where
    submissions run as a user of their own; then it is /tmp or /var/tmp.
    """
    first = pathlib.Path(tempfile.gettempdir())
    places = [first, pathlib.Path("/tmp"), pathlib.Path("/var/tmp")] if os.getuid() == 0 else [first]
    return next((place for place in places if place.is_dir() and os.access(place, os.W_OK) and _open_to_others(place)), first)


def _open_to_others(place: pathlib.Path) -> bool:
    return all(path.stat().st_mode & stat.S_IXOTH for path in (place, *place.parents))


@contextlib.contextmanager
def folder(prefix: str) -> Iterator[pathlib.Path]:
    """A new one among the machine's temporary files, its name begun with ``prefix``, which goes when the context is left."""
    sweep(prefix)
    place = pathlib.Path(tempfile.mkdtemp(prefix=prefix, dir=top()))
    lock = os.open(place, os.O_RDONLY)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield place
    finally:
        remove(place)
        os.close(lock)


def remove(place: pathlib.Path) -> None:
    """Remove ``place``, however deep its folders lie in each other: Python's own goes down by recursion."""
    subprocess.run(["rm", "-rf", "--", str(place)], stderr=subprocess.DEVNULL, check=False)


def sweep(prefix: str, young: float = _YOUNG) -> None:
    """Removes folders of that prefix in which nobody works.

    :param young: s of age up to which one is left alone
    """
    for place in top().glob(f"{prefix}*"):
        try:
            information = place.lstat()
            if information.st_uid != os.getuid() or not place.is_dir() or place.is_symlink() or time.time() - information.st_mtime < young:
                continue
            lock = os.open(place, os.O_RDONLY | os.O_NOFOLLOW)
        except OSError:  # it went meanwhile
            continue
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            remove(place)
        except OSError:  # somebody works there
            continue
        finally:
            os.close(lock)
