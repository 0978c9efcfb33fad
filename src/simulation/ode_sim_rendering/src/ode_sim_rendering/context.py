"""Headless OpenGL contexts: EGL first (a GPU where there is one, else Mesa's llvmpipe), OSMesa as the second back-end.

Both give a :class:`moderngl.Context` of OpenGL 3.3 core, so the renderer has one code path.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import os
from types import ModuleType
from typing import Any

from ode_sim.errors import RenderingUnavailable

from ode_sim_rendering.devices import SOFTWARE, UnknownDevice, devices, index_of

BACKENDS = ("auto", "egl", "osmesa")
_GL_VERSION = 330


class _OsmesaContext:
    """What moderngl asks of a context provider, over libOSMesa. All drawing goes to framebuffer objects; the default
    buffer that OSMesa insists on is a token one."""

    _FORMAT, _RGBA, _PROFILE, _CORE, _MAJOR, _MINOR, _UBYTE = 0x22, 0x1908, 0x33, 0x34, 0x36, 0x37, 0x1401
    _SIZE = 4
    _current: _OsmesaContext | None = None  # the context in use, to go back to

    def __init__(self, **_moderngl_settings: object) -> None:
        self._lib = lib = ctypes.CDLL(ctypes.util.find_library("OSMesa") or "libOSMesa.so.8")
        lib.OSMesaCreateContextAttribs.restype = ctypes.c_void_p
        lib.OSMesaCreateContextAttribs.argtypes = [ctypes.POINTER(ctypes.c_int), ctypes.c_void_p]
        lib.OSMesaMakeCurrent.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_uint, ctypes.c_int, ctypes.c_int]
        lib.OSMesaGetProcAddress.restype = ctypes.c_void_p
        lib.OSMesaDestroyContext.argtypes = [ctypes.c_void_p]
        wanted = (self._FORMAT, self._RGBA, self._PROFILE, self._CORE, self._MAJOR, 3, self._MINOR, 3, 0)
        self._handle = lib.OSMesaCreateContextAttribs((ctypes.c_int * len(wanted))(*wanted), None)
        if not self._handle:
            raise RenderingUnavailable("OSMesa has no OpenGL 3.3")
        self._buffer = (ctypes.c_ubyte * (4 * self._SIZE * self._SIZE))()
        self._use()

    def load(self, name: str) -> int:
        """Address of the GL function ``name``, 0 if there is none."""
        return self._lib.OSMesaGetProcAddress(name.encode()) or 0

    def __enter__(self) -> _OsmesaContext:
        self._before, _OsmesaContext._current = _OsmesaContext._current, self
        self._use()
        return self

    def __exit__(self, *_exc: object) -> None:
        _OsmesaContext._current = self._before
        if self._before not in (None, self):
            self._before._use()

    def _use(self) -> None:
        if not self._lib.OSMesaMakeCurrent(self._handle, self._buffer, self._UBYTE, self._SIZE, self._SIZE):
            raise RenderingUnavailable("OSMesa could not make its context current")

    def release(self) -> None:
        self._lib.OSMesaDestroyContext(self._handle)


def _create_osmesa(moderngl: ModuleType) -> Any:
    """moderngl finds providers by name in glcontext; OSMesa is lent to that look-up for the length of one call."""
    import glcontext

    original = glcontext.get_backend_by_name
    glcontext.get_backend_by_name = lambda name: _OsmesaContext if name == "osmesa" else original(name)
    try:
        return moderngl.create_context(standalone=True, backend="osmesa", require=_GL_VERSION)
    finally:
        glcontext.get_backend_by_name = original


def _create_egl(moderngl: ModuleType, device: int | None) -> Any:
    settings: dict[str, Any] = {"standalone": True, "backend": "egl", "require": _GL_VERSION}  # versions type them differently
    if device is not None:
        settings["device_index"] = device
    return moderngl.create_context(**settings)


def _egl_devices(trouble: list[str]) -> list[int | None]:
    """Which to try, in turn: the one that ``ODE_SIM_GL_DEVICE`` names, else EGL's first; then software."""
    wanted, known = os.environ.get("ODE_SIM_GL_DEVICE", ""), devices()
    first: int | None = None
    if wanted:
        try:
            first = index_of(wanted, known)
        except UnknownDevice as error:
            trouble.append(f"ODE_SIM_GL_DEVICE: {error}; the first is taken")
    software = [number for number, name in enumerate(known) if name == SOFTWARE and number != (first or 0)]
    return [first, *software[:1]]


def _reason(error: Exception) -> str:
    return str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__


def create_context(backend: str = "auto", trouble: list[str] | None = None) -> Any:
    """A current, headless ``moderngl.Context``.

    :param backend: ``egl``, ``osmesa`` or ``auto`` (EGL, then OSMesa; the environment variable ``ODE_SIM_GL``
        overrides ``auto``). Of several cards ``ODE_SIM_GL_DEVICE`` chooses one: by EGL's index, by PCI address, or ``software``.
    :param trouble: gets a line for a device that is not there or whose driver fails; the next one draws then.
    :raises RenderingUnavailable: no back-end works; the message says why for each.
    """
    trouble = [] if trouble is None else trouble
    if backend == "auto":
        backend = os.environ.get("ODE_SIM_GL", "") or "auto"
    if backend not in BACKENDS:
        raise RenderingUnavailable(f"unknown OpenGL back-end '{backend}' (ODE_SIM_GL); use one of {', '.join(BACKENDS)}")
    try:
        import moderngl
    except ImportError as error:
        raise RenderingUnavailable(f"no OpenGL: {error}; install python3-moderngl") from error
    tries: list[tuple[str, int | None]] = [("egl", device) for device in _egl_devices(trouble)] if backend != "osmesa" else []
    reasons: list[str] = []
    for name, device in tries + ([("osmesa", None)] if backend != "egl" else []):
        try:
            made = _create_osmesa(moderngl) if name == "osmesa" else _create_egl(moderngl, device)
        except Exception as error:  # moderngl, glcontext and ctypes each raise types of their own
            reasons.append(f"{name}{'' if device is None else f' device {device}'}: {_reason(error)}")
            continue
        if reasons and (devices() or os.environ.get("ODE_SIM_GL_DEVICE")):  # without EGL, OSMesa is what was installed for it
            trouble.append(f"{'; '.join(reasons)}; drawn by {made.info['GL_RENDERER']}")
        return made
    raise RenderingUnavailable(f"no OpenGL ({'; '.join(reasons)}); install libegl1 with libgl1-mesa-dri, or libosmesa6")
