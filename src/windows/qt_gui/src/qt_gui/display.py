"""Whether Qt will find a display: it ends the process with a core dump where there is none."""
import ctypes
import os
from typing import Optional


def missing_display() -> Optional[str]:
    """One line saying what is missing and what to do, or None when a window can be shown."""
    platform = os.environ.get("QT_QPA_PLATFORM", "").split(":")[0].split(";")[0]
    if platform not in ("", "xcb", "wayland", "wayland-egl"):
        return None
    remedy = ("start it on a desktop, through ssh -X, or with scripts/offscreen COMMAND (xvfb-run COMMAND) for a display that "
              "nobody sees")
    if platform != "xcb" and os.environ.get("WAYLAND_DISPLAY"):
        return None
    name = os.environ.get("DISPLAY")
    if not name:
        return f"no display to open a window on (DISPLAY is not set): {remedy}"
    try:
        x11 = ctypes.CDLL("libX11.so.6")
    except OSError:
        return None
    x11.XOpenDisplay.restype = ctypes.c_void_p
    x11.XCloseDisplay.argtypes = [ctypes.c_void_p]
    connection = x11.XOpenDisplay(None)
    if not connection:
        return f"the display {name} (DISPLAY) cannot be opened: {remedy}"
    x11.XCloseDisplay(connection)
    return None
