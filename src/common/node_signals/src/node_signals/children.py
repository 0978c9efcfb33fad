"""Child processes that do not outlive their parent."""

from __future__ import annotations

import ctypes
import signal

_PR_SET_PDEATHSIG = 1  # linux/prctl.h
_libc = ctypes.CDLL(None)  # here and not in the child: between fork and exec little may be called


def end_with_parent(number: signal.Signals = signal.SIGTERM) -> None:
    """For ``preexec_fn``: the child gets signal ``number`` when the thread that starts it ends, however that happens."""
    _libc.prctl(_PR_SET_PDEATHSIG, number)
