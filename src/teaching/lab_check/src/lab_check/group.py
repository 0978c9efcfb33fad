"""The kernel's own bound on the processes of a submission, where root asks for it: a control group.

prlimit's bound does not hold for root, as whom containers run, and the Guard looks ten times a second: by then a fork bomb has taken
all process numbers of the machine, and whatever else runs there can start nothing.
"""
from __future__ import annotations

import contextlib
import os
import pathlib
import time
import uuid
from typing import Iterator

HIERARCHIES = ("/sys/fs/cgroup/pids", "/sys/fs/cgroup")  # version 1, version 2 of control groups
_LEAVING = 5.0  # s that killed processes may take to be gone


@contextlib.contextmanager
def bounded(most: int) -> Iterator[str]:
    """:param most: processes and threads, of all that enter it together.
    :return: a folder for :func:`enter`; '' where no group can be made here."""
    place = _make(most)
    try:
        yield place
    finally:
        end = time.monotonic() + _LEAVING
        while place and not _removed(place) and time.monotonic() < end:
            time.sleep(0.05)


def enter(place: str) -> None:
    """This process, and all that it starts from now on."""
    if place:
        pathlib.Path(place, "cgroup.procs").write_text("0")


def _make(most: int) -> str:
    for hierarchy in HIERARCHIES:
        place = os.path.join(hierarchy, f"lab_check.{uuid.uuid4().hex}")
        try:
            os.mkdir(place)
        except OSError:  # not mounted, read-only, or this user may not
            continue
        try:
            if os.path.exists(os.path.join(place, "pids.max")):
                pathlib.Path(place, "pids.max").write_text(str(most))
                return place
        except OSError:
            pass
        _removed(place)  # processes are not counted in this hierarchy
    return ""


def _removed(place: str) -> bool:
    try:
        os.rmdir(place)
    except FileNotFoundError:
        pass
    except OSError:  # processes are still in it
        return False
    return True
