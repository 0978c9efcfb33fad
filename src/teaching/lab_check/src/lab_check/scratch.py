"""Folders for the time of one examination. Whoever works in one holds its lock; what one that was killed left behind goes with the next."""
from __future__ import annotations

import contextlib
import fcntl
import os
import pathlib
import shutil
import tempfile
import time
from typing import Iterator

_YOUNG = 60.0  # s in which one may be made, but not locked yet


@contextlib.contextmanager
def folder(prefix: str) -> Iterator[pathlib.Path]:
    """A new one among the machine's temporary files, which goes when the context is left."""
    sweep(prefix)
    place = pathlib.Path(tempfile.mkdtemp(prefix=prefix))
    lock = os.open(place, os.O_RDONLY)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield place
    finally:
        shutil.rmtree(place, ignore_errors=True)
        os.close(lock)


def sweep(prefix: str, young: float = _YOUNG) -> None:
    """Removes folders of that prefix in which nobody works.

    :param young: s of age up to which one is left alone
    """
    for place in pathlib.Path(tempfile.gettempdir()).glob(f"{prefix}*"):
        try:
            information = place.lstat()
            if information.st_uid != os.getuid() or not place.is_dir() or place.is_symlink() or time.time() - information.st_mtime < young:
                continue
            lock = os.open(place, os.O_RDONLY | os.O_NOFOLLOW)
        except OSError:  # it went meanwhile
            continue
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            shutil.rmtree(place, ignore_errors=True)
        except OSError:  # somebody works there
            continue
        finally:
            os.close(lock)
