"""Runs inside RViz's own process (its Python bindings): loads a config, waits until all is drawn, writes PNG files.

Started by :mod:`rviz_offscreen.cli` with a JSON job on standard input; answers with one JSON line on descriptor 3. The
3D picture is read from OGRE's frame buffer, so it needs no X server; the whole window is painted by Qt around it.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys
import time
from typing import Any

# RViz's bindings load every module of Qt that is installed; the web engine asks for an OpenGL that OSMesa does not give.
for _name in ("QtWebEngine", "QtWebEngineCore", "QtWebEngineWidgets"):
    sys.modules[f"PyQt5.{_name}"] = None  # type: ignore[assignment]  # None is how Python knows what is not to be imported

from . import displays, extent  # noqa: E402
from .bindings import QApplication, QDockWidget, QImage, QPainter, QPoint, QRect, QWidget, disable_anti_aliasing, loaded_library, rviz, sip  # noqa: E402

_SETTLE_FRAMES = 3  # frames to draw after a change before the picture is taken: OGRE shows it one or two frames later


class Grabber:
    """One RViz window and the pictures taken of it."""

    def __init__(self, job: dict):
        self.job = job
        self.app = QApplication(["rviz"])
        if not job["anti_aliasing"]:
            disable_anti_aliasing()
        self.frame = rviz.VisualizationFrame()
        self.frame.setSplashPath("")
        self.frame.initialize()
        config = rviz.Config()
        reader = rviz.YamlConfigReader()
        reader.readFile(config, job["config"])
        if reader.error():
            raise RuntimeError(f"{job['config']}: {reader.errorMessage()}")
        self.frame.load(config)
        if not job["window"]:
            self._only_the_3d_view()
        width, height = job["size"]
        self.frame.resize(width, height)
        self.frame.show()
        self.manager = self.frame.getManager()
        if job["fixed_frame"]:
            self.manager.setFixedFrame(job["fixed_frame"])

    def _only_the_3d_view(self) -> None:
        self.frame.menuBar().hide()
        self.frame.statusBar().hide()
        self.frame.setHideButtonVisibility(False)
        for dock in self.frame.findChildren(QDockWidget):
            dock.hide()
        for bar in self.frame.children():
            if bar.metaObject().className() == "QToolBar":
                bar.hide()

    # ------------------------------------------------------------------------------------------ waiting

    def _run(self, seconds: float) -> None:
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self.app.processEvents()
            time.sleep(0.005)

    def _draw(self, frames: int) -> None:
        """Let RViz draw that many frames more."""
        target = self.manager.getFrameCount() + frames
        end = time.monotonic() + 10
        while self.manager.getFrameCount() < target and time.monotonic() < end:
            self.manager.queueRender()
            self._run(0.01)

    def wait_until_drawn(self) -> dict[str, dict[str, str]]:
        """Until every enabled display has drawn something, or the time limit; what nobody publishes only for the grace.

        :returns: ``not_ok`` (display: what it says) and ``unpublished`` (display: topics), as they are then.
        """
        start = time.monotonic()
        while True:
            self._draw(2)
            waiting = [state for state in displays.states(self.manager) if not state.drawn]
            unpublished = []
            late = time.monotonic() - start > min(self.job["grace"], self.job["timeout"])
            if late and any(state.topics for state in waiting):
                published = displays.published_topics()
                unpublished = [state for state in waiting if displays.nobody_publishes(state, published)]
                waiting = [state for state in waiting if state not in unpublished]
            if not waiting or time.monotonic() - start > self.job["timeout"]:
                self._draw(_SETTLE_FRAMES)
                return {
                    "not_ok": {state.name: state.problem for state in waiting},
                    "unpublished": {state.name: ", ".join(filter(None, state.topics)) for state in unpublished},
                }
            self._run(0.03)

    def watch(self, seconds: float) -> None:
        """Go on drawing for so long."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            self._draw(1)

    # ------------------------------------------------------------------------------------------ pictures

    def set_view(self, wanted: list[list], fit: bool) -> None:
        """``fit``: distance and focal point are those that have the robots in the frame, unless ``wanted`` says others."""
        values: dict[str, Any] = dict(wanted)
        if not values:
            return
        points = extent.corners(self.manager) if fit else None
        if points is not None and len(points):
            panel = next(panel for panel in self.frame.findChildren(QWidget) if panel.metaObject().className() == "rviz::RenderPanel")
            aspect = panel.width() / max(panel.height(), 1)
            values = {**extent.fitting_view(points, values["yaw"], values["pitch"], aspect), **values}
        views = self.manager.getViewManager()
        view = views.getCurrent()
        if view.subProp("Yaw") is None or view.subProp("Distance") is None:
            views.setCurrentViewControllerType("rviz/Orbit")
            view = views.getCurrent()
        for key, name in (("yaw", "Yaw"), ("pitch", "Pitch"), ("distance", "Distance")):
            if key in values:
                view.subProp(name).setValue(float(values[key]))
        focal = view.subProp("Focal Point")
        for key in "xyz":
            if key in values:
                focal.subProp(key.upper()).setValue(float(values[key]))

    def save(self, path: str) -> None:
        self._draw(_SETTLE_FRAMES)
        if self.job["window"]:
            self._paint_window(path)
        else:
            write_frame_buffer(render_windows()[0], path)

    def _paint_window(self, path: str) -> None:
        """The whole window: Qt's widgets, and what OGRE draws laid over the 3D view and the panels of images."""
        picture = QImage(self.frame.size(), QImage.Format.Format_RGB32)
        painter = QPainter(picture)
        self.frame.render(painter)
        for panel in self.frame.findChildren(QWidget):
            if panel.metaObject().className() == "rviz::RenderPanel" and not panel.visibleRegion().isEmpty():
                write_frame_buffer(window_of(panel), path)
                painter.drawImage(QRect(panel.mapTo(self.frame, QPoint(0, 0)), panel.size()), QImage(path))
        painter.end()
        if not picture.save(path, "PNG"):
            raise RuntimeError(f"cannot write {path}")


# ---------------------------------------------------------------------------------------------- OGRE
# The bindings do not expose OGRE; the symbols below are those of OGRE 1.12's stable C++ ABI (Itanium mangling).


def render_windows() -> list[int]:
    """Addresses of the OGRE windows of RViz, in the order of their making: the 3D view, then those of Image displays."""
    ogre = loaded_library("libOgreMain.so")
    root = ogre._ZN4Ogre4Root15getSingletonPtrEv
    root.restype = ctypes.c_void_p
    get_target = ogre._ZN4Ogre4Root15getRenderTargetERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE
    get_target.restype = ctypes.c_void_p
    get_target.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    windows: list[int] = []
    while not windows or windows[-1]:
        with _StdString(b"OgreWindow(%d)" % (len(windows) + 1)) as name:  # RViz's numbers; 0 is never shown
            windows.append(get_target(root(), name))
    if len(windows) < 2:
        raise RuntimeError("RViz has no 3D window")
    return windows[:-1]


def window_of(panel: QWidget) -> int:
    """Address of the OGRE window of a render panel: rviz::RenderWidget keeps it behind its QWidget."""
    address: int = sip.unwrapinstance(panel)  # type: ignore[func-returns-value,assignment]  # the stub of PyQt says None
    words = ctypes.cast(address, ctypes.POINTER(ctypes.c_void_p))
    windows = render_windows()
    return next(word for word in words[:16] if word in windows)


def write_frame_buffer(window: int, path: str) -> None:
    """Ogre::RenderTarget::writeContentsToFile of ``window``, the target's address, to ``path``."""
    ogre = loaded_library("libOgreMain.so")
    write = ogre._ZN4Ogre12RenderTarget19writeContentsToFileERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE
    write.restype = None
    write.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    with _StdString(path.encode()) as file:
        write(window, file)
    if not os.path.getsize(path):
        raise RuntimeError(f"cannot write {path}")


class _StdString:
    """A std::string (libstdc++'s C++11 layout) around bytes that Python keeps."""

    def __init__(self, value: bytes):
        self._buffer = ctypes.create_string_buffer(value)
        self._memory = (ctypes.c_uint64 * 4)(ctypes.addressof(self._buffer), len(value), 0, 0)

    def __enter__(self) -> int:
        return ctypes.addressof(self._memory)

    def __exit__(self, *_) -> None:
        pass


def main() -> None:
    job = json.load(sys.stdin)
    answer = os.fdopen(3, "w")
    start = time.monotonic()
    grabber = Grabber(job)
    result = grabber.wait_until_drawn()
    drawn = time.monotonic() - start
    grabber.watch(job["watch"])
    for picture in job["pictures"]:
        grabber.set_view(picture["view"], picture["fit"])
        grabber.save(picture["path"])
    json.dump({**result, "seconds": round(drawn, 3)}, answer)
    answer.write("\n")
    answer.flush()
    loaded_library("libroscpp.so")._ZN3ros8shutdownEv()  # unregisters the node
    os._exit(0)  # the bindings' destructors run in no useful order, and all is written


if __name__ == "__main__":
    main()
