"""Child processes that do not outlive their parent."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal

_PR_SET_PDEATHSIG, _PR_SET_CHILD_SUBREAPER = 1, 36  # linux/prctl.h
_libc = ctypes.CDLL(None)  # here and not in the child: between fork and exec little may be called


def end_with_parent(number: signal.Signals = signal.SIGTERM) -> None:
    """For ``preexec_fn``: the child gets signal ``number`` when the thread that starts it ends, however that happens."""
    _libc.prctl(_PR_SET_PDEATHSIG, number)


def adopt_orphans() -> None:
    """From now on this process becomes the parent of what its children leave behind; :func:`wait_for_all` waits for that."""
    _libc.prctl(_PR_SET_CHILD_SUBREAPER, 1)


def wait_for_all() -> None:
    """Return when this process has no children any more; call it when those that it started itself have been waited for."""
    with contextlib.suppress(ChildProcessError):
        while True:
            os.wait()
