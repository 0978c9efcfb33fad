"""A private virtual display: Xvfb on a free number, gone when its owner is. No ROS in here; scripts/offscreen uses it too."""

from __future__ import annotations

import contextlib
import ctypes
import os
import select
import shutil
import signal
import subprocess
from collections.abc import Iterator

from .errors import DisplayError

_PR_SET_PDEATHSIG = 1
_libc = ctypes.CDLL(None)  # loaded here: after fork() only async-safe work should be left


def die_with_parent() -> None:
    """For ``preexec_fn``: a session of its own (Ctrl-C is not for it), and no survival of a killed parent."""
    os.setsid()
    _libc.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


@contextlib.contextmanager
def private_display(size: str = "1280x800x24") -> Iterator[dict[str, str]]:
    """Start Xvfb with a screen of ``size`` (WIDTHxHEIGHTxDEPTH, pixels and bits) and stop it afterwards.

    :yields: the environment variables that send a program to it, with software OpenGL.
    :raises DisplayError: Xvfb missing or refusing.
    """
    if not shutil.which("Xvfb"):
        raise DisplayError("Xvfb is not installed; run scripts/setup (Debian package xvfb)")
    reading, writing = os.pipe()
    server = subprocess.Popen(
        ["Xvfb", "-displayfd", str(writing), "-screen", "0", size, "-nolisten", "tcp", "-noreset", "+extension", "GLX"],
        pass_fds=[writing],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        preexec_fn=die_with_parent,
    )
    os.close(writing)
    try:
        # Xvfb writes the number it found free once it accepts clients, and closes the pipe if it gives up.
        number = b""
        while not number.endswith(b"\n") and select.select([reading], [], [], 20)[0]:
            data = os.read(reading, 16)
            if not data:
                break
            number += data
        if not number.strip():
            raise DisplayError(f"Xvfb did not start with a screen of {size} (WIDTHxHEIGHTxDEPTH)")
        # Smoothed edges make three times the work of RViz's pictures where the processor draws; DRI_NO_MSAA=0 wants them.
        yield {"DISPLAY": f":{number.decode().strip()}", "LIBGL_ALWAYS_SOFTWARE": "1", "DRI_NO_MSAA": os.environ.get("DRI_NO_MSAA", "1")}
    finally:
        os.close(reading)
        server.terminate()
        server.wait()
