"""The render process: reads requests from a socket, draws, and writes images into shared memory.

It ends when the socket closes, however the simulator went, so it never outlives it.
"""

from __future__ import annotations

import contextlib
import mmap
import signal
from collections.abc import Iterable
from dataclasses import replace
from multiprocessing.connection import Connection
from typing import Any

import cv2
import numpy as np
from ode_sim.description.model import one_line

from ode_sim_rendering.camera import Fan
from ode_sim_rendering.image import add_noise, cloud, compress, encode
from ode_sim_rendering.lidar import LidarView
from ode_sim_rendering.messages import AddCamera, Done, Draw, DrawnBy, Failed, ForgetCamera, Problems, SetScene
from ode_sim_rendering.renderer import Renderer
from ode_sim_rendering.scene import SceneDescription


class Worker:
    """One renderer and the cameras it draws for."""

    def __init__(self, connection: Connection, memory: int):
        self._connection = connection
        self._memory_fd = memory
        self._memory: mmap.mmap | None = None
        self._cameras: dict[int, AddCamera] = {}
        self._lidars: dict[int, LidarView] = {}
        self._retros = np.zeros(1, np.float32)  # of each visual, and at last of none
        self._renderer: Renderer | None = None
        self._no_renderer = ""

    def run(self) -> None:
        try:
            self._renderer = Renderer()
        except Exception as error:  # whatever GL says: every frame asked for is answered with it
            self._no_renderer = one_line(error, 300).strip() or type(error).__name__
        else:
            with contextlib.suppress(OSError):  # the simulator has gone already
                self._connection.send(DrawnBy(self._renderer.device))
        while True:
            try:
                request = self._connection.recv()
                self._serve(request)
            except (EOFError, ConnectionError):
                return

    def _serve(self, request: Draw | SetScene | AddCamera | ForgetCamera) -> None:
        if isinstance(request, Draw):
            try:
                self._connection.send(self._draw(request))
            except (EOFError, ConnectionError):
                raise
            except Exception as error:  # one camera's trouble must not end the others
                self._connection.send(Failed(request.frame, one_line(error, 200).strip() or type(error).__name__))
        elif isinstance(request, SetScene):
            if self._renderer is not None:
                problems = self._set_scene(request.scene)
                if problems:
                    self._connection.send(Problems(problems))
        elif isinstance(request, AddCamera):
            self._cameras[request.key] = request
            self._lidars.pop(request.key, None)
        elif isinstance(request, ForgetCamera):
            self._cameras.pop(request.key, None)
            self._lidars.pop(request.key, None)

    def _set_scene(self, scene: SceneDescription) -> list[str]:
        """Show ``scene``, or as much of it as can be shown; lines about what cannot."""
        trouble: list[str] = []
        assert self._renderer is not None  # else nobody asks
        without: tuple[dict[str, Any], ...] = ({}, {"lights": ()}, {"visuals": ()}, {"lights": (), "visuals": ()})
        for less in without:
            try:
                self._renderer.set_scene(replace(scene, **less))
                break
            except Exception as error:  # the cameras go on without what it was
                trouble = trouble or [f"cameras do not see all of the world: {one_line(error, 200) or type(error).__name__}"]
        retros = {visual.name: visual.visual.laser_retro for visual in scene.visuals}
        self._retros = np.array([*(retros.get(name, 0.0) for name in self._renderer.visual_names), 0.0], np.float32)
        return trouble + self._renderer.take_problems()

    def _draw(self, request: Draw) -> Done | Failed:
        if self._renderer is None:
            return Failed(request.frame, self._no_renderer)
        entry = self._cameras[request.key]
        if entry.fan is not None:
            return Done(request.frame, self._store(request, [("rays", self._rays(request, entry, entry.fan))]))
        camera, wanted = entry.camera, request.outputs
        flat = {name.partition(":")[0] for name in wanted}
        sources = (("color",) if flat & {"image", "jpeg", "png", "cloud"} else ()) + (
            ("depth",) if flat & {"depth", "depth16", "cloud"} else ()
        )
        pictures = self._renderer.images(camera, np.frombuffer(request.poses).reshape(-1, 7), sources)
        if "color" in pictures:
            rgb = add_noise(pictures["color"], camera, entry.seed, request.time_ns)
            image = encode(rgb, camera.encoding)
        if "depth" in pictures:
            depth = pictures["depth"]
            depth = np.where(np.isfinite(depth), depth, np.float32(camera.far))  # as Gazebo: nothing is the far clip
            low, high = entry.depth_range
            valid = (depth > low) & (depth < high)
        products: list[tuple[str, np.ndarray]] = []
        for name in wanted:
            kind, _, level = name.partition(":")
            if kind == "image":
                products.append((name, image))
            elif kind in ("jpeg", "png"):
                products.append((name, compress(image, camera.encoding, kind, int(level))))
            elif kind == "depth":
                products.append((name, np.where(valid, depth, np.float32(np.nan))))
            elif kind == "depth16":
                products.append((name, np.where(valid, np.minimum(depth * 1000, 65535), 0).astype(np.uint16)))
            elif kind == "cloud":
                products.append((name, cloud(depth, image, camera, valid)))
        return Done(request.frame, self._store(request, products))

    def _rays(self, request: Draw, entry: AddCamera, fan: Fan) -> np.ndarray:
        """(2, V*H): ranges and retros."""
        assert self._renderer is not None
        view = self._lidars.get(request.key)
        if view is None:
            view = self._lidars[request.key] = LidarView(entry.camera, fan)
        poses = np.frombuffer(request.poses).reshape(-1, 7)
        ranges, seen = view.ranges([self._renderer.images(camera, poses, ("depth", "ident")) for camera in view.cameras])
        return np.stack([ranges.ravel(), self._retros[seen].ravel()])

    def _store(self, request: Draw, products: Iterable[tuple[str, np.ndarray]]) -> dict[str, tuple[int, int]]:
        """Copy into the frame's place in shared memory: name -> (offset, length)."""
        if self._memory is None or request.offset + request.room > len(self._memory):
            self._memory = mmap.mmap(self._memory_fd, 0)
        stored, offset = {}, request.offset
        for name, array in products:
            array = np.ascontiguousarray(array)
            if offset + array.nbytes > request.offset + request.room:
                raise ValueError(f"{name} of {array.nbytes} bytes does not fit")
            np.frombuffer(self._memory, np.uint8, array.nbytes, offset)[:] = array.view(np.uint8).ravel()
            stored[name] = (offset, array.nbytes)
            offset += -(-array.nbytes // 64) * 64
        return stored


def main(connection_fd: int, memory_fd: int) -> None:
    """Entry point of the child process. Ctrl-C is for the simulator; when that goes, the socket closes.

    :param connection_fd: descriptor of the socket. :param memory_fd: of the shared memory that images go to.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    np.seterr(all="ignore")  # what flew off the map is not seen; that its numbers overflow is no news for the terminal
    cv2.setNumThreads(1)  # the other core is for the physics
    Worker(Connection(connection_fd), memory_fd).run()
