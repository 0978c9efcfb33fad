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
from typing import Dict, List

from python_qt_binding.QtCore import Qt
from python_qt_binding.QtGui import QImage, QPainter
from python_qt_binding.QtWidgets import QApplication, QDockWidget, QTreeView, QWidget
from rviz import bindings as rviz

_SETTLE_FRAMES = 3  # frames to draw after a change before the picture is taken: OGRE shows it one or two frames later


class Grabber:
    """One RViz window and the pictures taken of it."""

    def __init__(self, job: dict):
        self.job = job
        self.app = QApplication(["rviz"])
        if not job["anti_aliasing"]:
            # What rviz's --disable-anti-aliasing does; the bindings do not expose it.
            _library("librviz.so")._ZN4rviz12RenderSystem19disableAntiAliasingEv()
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

    def _statuses(self) -> Dict[str, str]:
        """'Ok', 'Warn' or 'Error' of the global status and of each enabled display, as the Displays panel shows them."""
        statuses: Dict[str, str] = {}
        for tree in self.frame.findChildren(QTreeView):
            model = tree.model()
            if model is None or model.columnCount() < 2:
                continue
            for row in range(model.rowCount()):
                self._collect(model, model.index(row, 0), statuses)
        return statuses

    def _collect(self, model, index, statuses: Dict[str, str]) -> None:
        name = str(model.data(index, Qt.DisplayRole) or "")
        if name.startswith("Global Status: "):
            statuses["Global Status"] = name.rpartition(": ")[2]
            return
        enabled = model.data(index.sibling(index.row(), 1), Qt.CheckStateRole)
        if enabled is not None and int(enabled) == Qt.Unchecked:
            return
        for row in range(model.rowCount(index)):
            child = model.index(row, 0, index)
            text = str(model.data(child, Qt.DisplayRole) or "")
            if text.startswith("Status: "):
                statuses[name] = text.rpartition(": ")[2]
            elif model.rowCount(child):
                self._collect_group(model, child, statuses)

    def _collect_group(self, model, index, statuses: Dict[str, str]) -> None:
        """Displays inside a Group display."""
        if any(str(model.data(model.index(row, 0, index), Qt.DisplayRole) or "").startswith("Status: ")
               for row in range(model.rowCount(index))):
            self._collect(model, index, statuses)

    def wait_until_drawn(self) -> Dict[str, str]:
        """Until every enabled display reports Ok, or the time limit; what is not Ok then, by display name."""
        end = time.monotonic() + self.job["timeout"]
        while True:
            self._draw(2)
            bad = {name: status for name, status in self._statuses().items() if status.lower() != "ok"}
            if not bad or time.monotonic() > end:
                self._draw(_SETTLE_FRAMES)
                return bad
            self._run(0.03)

    # ------------------------------------------------------------------------------------------ pictures

    def set_view(self, values: List[list]) -> None:
        values = dict(values)
        if not values:
            return
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
        write_frame_buffer(path)
        if self.job["window"]:
            self._paint_window(path)

    def _paint_window(self, path: str) -> None:
        """The whole window: Qt's widgets, with the 3D picture laid where the 3D view is."""
        scene = QImage(path)
        picture = QImage(self.frame.size(), QImage.Format_RGB32)
        painter = QPainter(picture)
        self.frame.render(painter)
        # below the central widget: Image and Camera displays have render panels of their own in the docks
        view = next(w for w in self.frame.centralWidget().findChildren(QWidget)
                    if w.metaObject().className() in ("rviz::RenderPanel", "rviz::QtOgreRenderWindow"))
        painter.drawImage(view.mapTo(self.frame, view.rect().topLeft()), scene.scaled(view.size()))
        painter.end()
        if not picture.save(path, "PNG"):
            raise RuntimeError(f"cannot write {path}")

def write_frame_buffer(path: str) -> None:
    """Ogre::RenderWindow::writeContentsToFile of RViz's main window, which the bindings do not expose.

    The symbols are those of OGRE 1.12's stable C++ ABI (Itanium mangling).
    """
    ogre = _library("libOgreMain.so")
    root = ogre._ZN4Ogre4Root15getSingletonPtrEv
    root.restype = ctypes.c_void_p
    get_target = ogre._ZN4Ogre4Root15getRenderTargetERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE
    get_target.restype = ctypes.c_void_p
    get_target.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    write = ogre._ZN4Ogre12RenderTarget19writeContentsToFileERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEE
    write.restype = None
    write.argtypes = [ctypes.c_void_p, ctypes.c_void_p]
    with _StdString(b"OgreWindow(1)") as name:
        window = get_target(root(), name)
    if not window:
        raise RuntimeError("RViz has no 3D window")
    with _StdString(path.encode()) as file:
        write(window, file)
    if not os.path.getsize(path):
        raise RuntimeError(f"cannot write {path}")


def _library(name: str) -> ctypes.CDLL:
    """A shared library that this process has loaded already, by its name without version."""
    with open("/proc/self/maps") as maps:
        path = next(line.split()[-1] for line in maps if f"/{name}" in line)
    return ctypes.CDLL(path)


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
    bad = grabber.wait_until_drawn()
    drawn = time.monotonic() - start
    for picture in job["pictures"]:
        grabber.set_view(picture["view"])
        grabber.save(picture["path"])
    json.dump({"not_ok": bad, "seconds": round(drawn, 3)}, answer)
    answer.write("\n")
    answer.flush()
    _library("libroscpp.so")._ZN3ros8shutdownEv()  # unregisters the node
    os._exit(0)  # the bindings' destructors run in no useful order, and all is written


if __name__ == "__main__":
    main()
