"""The kernel's own bounds on a submission, where this user can make control groups: processes and memory of all its programs together.

prlimit's bound on processes holds for one user, none holds for memory that nobody has mapped (files in memory, buffers of sockets, the
pages of a tmpfs), and the Guard looks ten times a second: by then much is taken that others need.
"""

from __future__ import annotations

import contextlib
import fcntl
import os
import pathlib
import time
import uuid
from collections.abc import Iterator

# Version 1 of control groups has a hierarchy for each resource, version 2 one for all.
HIERARCHIES = ("/sys/fs/cgroup/pids", "/sys/fs/cgroup/memory", "/sys/fs/cgroup")
_OWN = "/proc/self/cgroup"
_PREFIX = "lab_check_"  # versions that locked none called theirs lab_check.
_LEAVING = 5.0  # s that killed processes may take to be gone
_BOUNDS = {"pids.max": "processes", "memory.max": "memory", "memory.limit_in_bytes": "memory"}
_NO_SWAP = ("memory.swap.max", "memory.swappiness")
# What only the submission causes: pages of files that anybody may have read are the kernel's to give back.
_COUNTED = (("anon", "shmem", "kernel_stack", "pagetables", "sock", "slab_unreclaimable", "percpu"), ("total_rss", "total_shmem"))


@contextlib.contextmanager
def bounded(most: int, memory: float = 0.0) -> Iterator[str]:
    """:param most: processes and threads, of all that enter it together.
    :param memory: bytes, of all that enter it together; 0: no bound
    :return: folders for :func:`enter`, joined by ``:``; '' where no group can be made here."""
    locks = _make({"processes": str(most), **({"memory": str(int(memory))} if memory else {})})
    places = list(locks)
    try:
        yield os.pathsep.join(places)
    finally:
        end = time.monotonic() + _LEAVING
        while places and time.monotonic() < end:
            places = [place for place in places if not _removed(place)]
            if places:
                time.sleep(0.05)
        for lock in locks.values():
            os.close(lock)


def enter(place: str) -> None:
    """Put this process, and all that it starts from now on, into the group ``place``."""
    for folder in filter(None, place.split(os.pathsep)):
        pathlib.Path(folder, "cgroup.procs").write_text("0")


def counts_memory(place: str) -> bool:
    """Whether the kernel counts the memory of the group ``place``."""
    return any(
        os.path.exists(os.path.join(folder, name))
        for folder in place.split(os.pathsep)
        if folder
        for name in ("memory.max", "memory.limit_in_bytes")
    )


def memory(place: str) -> float | None:
    """Bytes that only the processes of the group ``place`` hold, in whatever way; None where no group counts them."""
    for folder in filter(None, place.split(os.pathsep)):
        try:
            figures = dict(line.split() for line in pathlib.Path(folder, "memory.stat").read_text().splitlines())
            names = _COUNTED[0] if "anon" in figures else _COUNTED[1]
            taken = sum(float(figures.get(name, 0)) for name in names)
            kernel = pathlib.Path(folder, "memory.kmem.usage_in_bytes")  # version 1 tells it apart from the rest
            return taken + (float(kernel.read_text()) if kernel.exists() else 0.0)
        except (OSError, ValueError):
            continue
    return None


def ended_for_memory(place: str) -> int:
    """How many processes of the group ``place`` the kernel has ended so far because they took more memory than it may."""
    for folder in filter(None, place.split(os.pathsep)):
        for name in ("memory.events", "memory.oom_control"):
            try:
                figures = dict(line.split() for line in pathlib.Path(folder, name).read_text().splitlines())
                return int(figures["oom_kill"])
            except (OSError, ValueError, KeyError):
                continue
    return 0


def delegated(mounted: str = HIERARCHIES[-1], own: str = _OWN) -> list[str]:
    """The highest group of version 2 above this process that this user may change, if there is one below the root: systemd hands one to
    each user whose programs run below their own manager (a terminal on a desktop, ``systemd-run --user --scope``). The kernel moves a
    process within what its user may write, and no further.

    :param mounted: where the hierarchy is
    :param own: says in which group this process is
    """
    try:
        lines = pathlib.Path(own).read_text().splitlines()
    except OSError:
        return []
    path = next((line[len("0::") :] for line in lines if line.startswith("0::")), "")
    place, highest = os.path.normpath(f"{mounted}/{path}"), []
    while place.startswith(mounted + "/") and all(os.access(f, os.W_OK) for f in (place, os.path.join(place, "cgroup.procs"))):
        highest, place = [place], os.path.dirname(place)
    return highest


def _make(bounds: dict[str, str]) -> dict[str, int]:
    """Folders that together keep the bounds, as far as this machine lets us make them, each with the descriptor of its lock."""
    places: dict[str, int] = {}
    kept: set = set()
    for hierarchy in (*HIERARCHIES, *delegated()):
        _sweep(hierarchy)
        try:
            place, lock = _new(hierarchy)
        except OSError:  # not mounted, read-only, or this user may not
            continue
        mine = _write(place, {name: bounds[kind] for name, kind in _BOUNDS.items() if kind in bounds and kind not in kept})
        if mine:
            kept |= {_BOUNDS[name] for name in mine}
            places[place] = lock
        else:
            _removed(place)  # nothing is counted in this hierarchy
            os.close(lock)
    return places


def _new(hierarchy: str) -> tuple[str, int]:
    """A group, and the descriptor of its lock, which whoever makes a group holds as long as it lives.

    :raises OSError: none can be made there
    """
    while True:
        place = os.path.join(hierarchy, f"{_PREFIX}{uuid.uuid4().hex}")
        os.mkdir(place)
        lock = _lock(place)
        if lock is not None and os.path.isdir(place):  # nobody took it for one that was left behind, before it was locked
            return place, lock
        if lock is not None:
            os.close(lock)


def _lock(place: str) -> int | None:
    """None where somebody holds it, or it is not there any more."""
    try:
        number = os.open(place, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    except FileNotFoundError:
        return None
    try:
        fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(number)
        return None
    except OSError:
        os.close(number)
        raise
    return number


def _sweep(hierarchy: str) -> None:
    """Away with what those left behind that were killed. Processes that are still in a group keep it."""
    try:
        left = [entry.path for entry in os.scandir(hierarchy) if entry.name.startswith(_PREFIX)]
    except OSError:
        return
    for place in left:
        with contextlib.suppress(OSError):
            lock = _lock(place)
            if lock is not None:
                _removed(place)
                os.close(lock)


def _write(place: str, values: dict[str, str]) -> list[str]:
    """The names of those bounds that are kept in this group."""
    written = []
    for name, value in values.items():
        file = pathlib.Path(place, name)
        try:
            if file.exists():
                file.write_text(value)
                written.append(name)
        except OSError:
            continue
    for name in _NO_SWAP if any(name.startswith("memory") for name in written) else ():
        with contextlib.suppress(OSError):
            file = pathlib.Path(place, name)
            if file.exists():
                file.write_text("0")
    return written


def _removed(place: str) -> bool:
    try:
        os.rmdir(place)
    except FileNotFoundError:
        pass
    except OSError:  # processes are still in it
        return False
    return True
