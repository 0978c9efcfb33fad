"""What EGL can draw on in this machine: graphics cards and Mesa's software."""

from __future__ import annotations

import ctypes
import os
import re
from collections.abc import Sequence

from ode_sim.errors import Refused

SOFTWARE = "software"
UNNAMED = "unnamed"  # a device that says neither that it is software nor which card it is
_EXTENSIONS, _DRM_FILE = 0x3055, 0x3233
_MOST = 64
_PCI = re.compile(r"(?:[0-9a-f]{4}:)?[0-9a-f]{2}:[0-9a-f]{2}\.[0-7]", re.IGNORECASE)


class UnknownDevice(Refused):
    """There is no such device; the message lists those that there are."""


def devices() -> list[str]:
    """In EGL's order, of each the PCI address (``0000:65:00.0``), :data:`SOFTWARE` or :data:`UNNAMED`; [] without EGL."""
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError:
        return []
    egl.eglGetProcAddress.restype, egl.eglGetProcAddress.argtypes = ctypes.c_void_p, [ctypes.c_char_p]
    addresses = [egl.eglGetProcAddress(name) for name in (b"eglQueryDevicesEXT", b"eglQueryDeviceStringEXT")]
    if not all(addresses):
        return []
    list_of = ctypes.CFUNCTYPE(ctypes.c_uint, ctypes.c_int, ctypes.POINTER(ctypes.c_void_p), ctypes.POINTER(ctypes.c_int))(addresses[0])
    text_of = ctypes.CFUNCTYPE(ctypes.c_char_p, ctypes.c_void_p, ctypes.c_int)(addresses[1])
    found, count = (ctypes.c_void_p * _MOST)(), ctypes.c_int(0)
    if not list_of(_MOST, found, ctypes.byref(count)):
        return []
    names = []
    for device in found[: count.value]:
        extensions = (text_of(device, _EXTENSIONS) or b"").split()
        file = text_of(device, _DRM_FILE) if b"EGL_EXT_device_drm" in extensions else None
        names.append(SOFTWARE if b"EGL_MESA_device_software" in extensions else _pci_address(file) or UNNAMED)
    return names


def _pci_address(file: bytes | None) -> str | None:
    """Of the card behind ``/dev/dri/card0``."""
    if not file:
        return None
    place = os.path.realpath(f"/sys/class/drm/{os.path.basename(file.decode())}/device")
    return os.path.basename(place) if _PCI.fullmatch(os.path.basename(place)) else None


def index_of(wanted: str, known: Sequence[str]) -> int:
    """Which of ``known`` is meant by ``wanted``: an index, a PCI address (``65:00.0``) or ``software``.

    :raises UnknownDevice: none is
    """
    wanted = wanted.strip().lower()
    if wanted.isdecimal() and int(wanted) < len(known):
        return int(wanted)
    full = f"0000:{wanted}" if _PCI.fullmatch(wanted) and wanted.count(":") == 1 else wanted
    if full in known:
        return list(known).index(full)
    there = ", ".join(f"{number} ({name})" for number, name in enumerate(known)) or "none"
    raise UnknownDevice(f"there is no device '{wanted}' to draw on; there is {there}")


def card_draws() -> bool:
    """Whether pictures come from a graphics card, as far as can be told before one is drawn: a driver may still fail."""
    known, chosen = devices(), os.environ.get("ODE_SIM_GL_DEVICE", "")
    try:
        first = known[index_of(chosen, known) if chosen else 0] if known else SOFTWARE
    except UnknownDevice:
        first = known[0]
    return first != SOFTWARE and os.environ.get("ODE_SIM_GL", "") != "osmesa"
