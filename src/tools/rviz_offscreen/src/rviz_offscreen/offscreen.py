"""offscreen COMMAND...: run COMMAND under a private virtual display with software OpenGL.

For RViz and other windows on a machine with neither screen nor GPU. The display is Xvfb's on a free number; it goes when
COMMAND ends, however that happens. OFFSCREEN_SIZE sets the screen (default 1280x800x24). The exit code is COMMAND's.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys

from rviz_offscreen.display import private_display
from rviz_offscreen.errors import DisplayError


def _run(command: list[str]) -> int:
    with private_display(os.environ.get("OFFSCREEN_SIZE", "1280x800x24")) as variables:
        environment = {k: v for k, v in os.environ.items() if k != "WAYLAND_DISPLAY"}
        try:
            process = subprocess.Popen(command, env={**environment, **variables})
        except OSError as error:
            raise DisplayError(f"cannot run {command[0]}: {error.strerror}") from error
        # Ctrl-C in a terminal reaches the command by itself (same process group); a signal for this process alone is passed on.
        signal.signal(signal.SIGINT, lambda *_: None if os.isatty(0) else process.send_signal(signal.SIGINT))
        signal.signal(signal.SIGTERM, lambda *_: process.terminate())
        code = process.wait()
    return code if code >= 0 else 128 - code


def main(command: list[str]) -> int:
    """Exit code: the command's; 1 when there is no display to be had, 2 without a command."""
    if not command or command[0] in ("-h", "--help"):
        print(__doc__)
        return 0 if command else 2
    try:
        return _run(command)
    except DisplayError as error:
        print(f"offscreen: {error}", file=sys.stderr)
        return 1
