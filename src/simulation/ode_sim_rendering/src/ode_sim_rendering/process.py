"""Pictures from a second process, so that the physics keeps its own core and its GIL.

::

    studio = RenderProcess(world, report=print)
    key = studio.add_camera(camera)
    studio.draw(key, ("image",), deliver)        # deliver(frame) is called from the studio's own thread

The process starts with the first picture asked for and ends with :meth:`RenderProcess.close`, or with the simulator,
however that ends: it lives on a socket to it. Link poses go out over the socket, images come back in shared memory.
"""

from __future__ import annotations

import mmap
import os
import subprocess
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection, Pipe
from typing import TYPE_CHECKING

import numpy as np

from ode_sim_rendering.camera import Camera, Fan
from ode_sim_rendering.messages import AddCamera, Done, Draw, DrawnBy, Failed, ForgetCamera, Problems, SetScene
from ode_sim_rendering.watch import SceneWatch, camera_seed

if TYPE_CHECKING:
    from ode_sim.world import World

#: What can be asked of a camera: the sensor image, compressed ones (``jpeg:QUALITY``, ``png:LEVEL``), depth in metres
#: (float32, NaN where invalid) or millimetres (uint16, 0 where invalid), an organised point cloud (see image.cloud). Of a lidar: ``rays``,
#: each ray's range (float32, m, +inf for none) and ``<laser_retro>`` of the visual that it meets (float32), row by row from below.
OUTPUTS = ("image", "jpeg", "png", "depth", "depth16", "cloud", "rays")

_SLOTS = 8  # frames of one camera under way at once: a quarter of a second at 30 Hz, on a machine that is busy
_BYTES_PER_PIXEL = 6 + 8 + 8 + 4 + 2 + 32  # of all outputs together; untouched pages cost nothing
_BYTES_PER_RAY = 4 + 4
_RESTARTS = 3
_START = "import sys; sys.path[:] = {path!r}; from ode_sim_rendering.worker import main; main({socket}, {memory})"


@dataclass(frozen=True)
class Frame:
    """``data``: output -> bytes in shared memory, valid until the receiver returns; ``error``: why there are none."""

    time_ns: int
    data: dict[str, memoryview]
    error: str = ""


@dataclass
class _Camera:
    camera: Camera
    message: AddCamera
    offset: int
    room: int  # of one slot
    free: list[int]


@dataclass
class _Pending:
    camera: _Camera
    slot: int
    time_ns: int
    deliver: Callable[[Frame], None]
    finished: threading.Event


class RenderProcess:
    """One render process for one world. :meth:`draw` and :meth:`add_camera` belong to the physics thread.

    :param report: called with one line about anything that cannot be drawn; from any thread.
    :param tell: called with one line of what draws, when the first picture is asked for; from any thread.
    """

    def __init__(self, world: World, report: Callable[[str], None], tell: Callable[[str], None] = lambda _line: None):
        self._world = world
        self._report, self._tell = report, tell
        self._watch = SceneWatch(world)
        self._memory_fd = os.memfd_create("ode_sim images")
        self._memory: mmap.mmap | None = None
        self._used = 0
        self._spare: dict[int, list[int]] = {}  # room of a slot -> offsets of freed cameras
        self._cameras: dict[int, _Camera] = {}
        self._next_key = self._next_frame = 0
        self._pending: dict[int, _Pending] = {}
        self._lock = threading.Lock()  # of the pending frames and the free slots
        self._process: subprocess.Popen | None = None
        self._connection: Connection | None = None
        self._failures = 0
        self._closed = False

    # ------------------------------------------------------------------------------------------ physics thread

    def add_camera(self, camera: Camera, depth_range: tuple[float, float] = (0.0, np.inf), fan: Fan | None = None) -> int:
        """A key of ``camera`` for :meth:`draw`.

        :param depth_range: m, depths outside of it are invalid.
        :param fan: it is a lidar with these rays, whose only output is ``rays``.
        """
        key = self._next_key
        self._next_key += 1
        wanted = len(fan.yaws) * len(fan.pitches) * _BYTES_PER_RAY if fan else camera.width * camera.height * _BYTES_PER_PIXEL
        room = -(-(wanted + 65536) // mmap.PAGESIZE) * mmap.PAGESIZE
        spare = self._spare.get(room)
        if spare:
            offset = spare.pop()
        else:
            offset, self._used = self._used, self._used + _SLOTS * room
            os.ftruncate(self._memory_fd, self._used)
            self._memory = None  # mapped anew, larger, at the next frame; views of the old mapping stay valid
        message = AddCamera(key, camera, camera_seed(self._world, camera.name), depth_range, fan)
        self._cameras[key] = _Camera(camera, message, offset, room, list(range(_SLOTS)))
        self._send(self._connection, message)
        return key

    def change_camera(self, key: int, camera: Camera) -> None:
        """``key`` draws ``camera`` from the next picture on. The size has to be the same: another one is another camera."""
        entry = self._cameras[key]
        entry.camera, entry.message = camera, replace(entry.message, camera=camera)
        self._send(self._connection, entry.message)

    def remove_camera(self, key: int) -> None:
        """Forget the camera ``key``; frames under way are still delivered."""
        entry = self._cameras.pop(key)
        self._send(self._connection, ForgetCamera(key))
        with self._lock:
            busy = any(pending.camera is entry for pending in self._pending.values())
        if not busy:  # else its place is still written to, and is simply not used again
            self._spare.setdefault(entry.room, []).append(entry.offset)

    def draw(self, key: int, outputs: tuple[str, ...], deliver: Callable[[Frame], None], wait: bool = False, most: int = _SLOTS) -> bool:
        """Take the picture of this moment. :return: False when it is left out, or cannot be drawn

        :param key: from :meth:`add_camera`. :param outputs: of :data:`OUTPUTS`.
        :param deliver: called once with the :class:`Frame`, from another thread.
        :param wait: return only when ``deliver`` has returned; without it the call takes microseconds, and a picture
            is left out (False is returned) while ``most`` (1 to 8) of this camera are under way.
        """
        entry = self._cameras[key]
        connection = self._connection or self._start()
        if connection is None:
            deliver(Frame(self._world.time_ns, {}, "the render process has ended too often"))
            return False
        scene = self._watch.news()
        if scene is not None:
            self._send(connection, SetScene(scene))
        with self._lock:
            if _SLOTS - len(entry.free) >= most or self._connection is not connection:
                return False
            slot = entry.free.pop()
            number = self._next_frame
            self._next_frame += 1
            pending = self._pending[number] = _Pending(entry, slot, self._world.time_ns, deliver, threading.Event())
        poses = np.ascontiguousarray(self._world.link_poses).tobytes()
        self._send(connection, Draw(number, key, tuple(outputs), pending.time_ns, poses, entry.offset + slot * entry.room, entry.room))
        if wait:
            pending.finished.wait()
        return True

    @property
    def pid(self) -> int | None:
        """Of the running render process, None before the first picture."""
        return self._process.pid if self._process is not None else None

    def close(self) -> None:
        """End the process; frames under way are dropped."""
        self._closed = True
        self._watch.close()
        if self._process is not None:
            self._process.kill()  # it has nothing to save
            self._process.wait()
            self._thread.join(timeout=5)
        os.close(self._memory_fd)

    # ------------------------------------------------------------------------------------------ the process

    def _start(self) -> Connection | None:
        if self._closed or self._failures > _RESTARTS:
            return None
        ours, theirs = Pipe()  # blocking, whatever socket.setdefaulttimeout() a ROS library has left behind
        code = _START.format(path=sys.path, socket=theirs.fileno(), memory=self._memory_fd)
        # Mesa warns on every start that there is no graphics card
        environment = {"EGL_LOG_LEVEL": "fatal", **os.environ}
        self._process = subprocess.Popen(
            [sys.executable, "-c", code], stdin=subprocess.DEVNULL, env=environment, pass_fds=(theirs.fileno(), self._memory_fd)
        )
        theirs.close()
        connection = self._connection = ours
        for entry in self._cameras.values():
            self._send(connection, entry.message)
        self._watch.mark()
        self._thread = threading.Thread(target=self._receive, args=(connection, self._process), name="pictures", daemon=True)
        self._thread.start()
        return connection

    @staticmethod
    def _send(connection: Connection | None, message: SetScene | AddCamera | ForgetCamera | Draw) -> None:
        if connection is None:
            return
        try:
            connection.send(message)
        except OSError:
            pass  # the process has ended; the receiving thread says so

    def _receive(self, connection: Connection, process: subprocess.Popen) -> None:
        """Thread: hand out what the process answers, until it ends."""
        while True:
            try:
                answer = connection.recv()
            except (EOFError, OSError):
                break
            if isinstance(answer, Problems):
                for line in answer.lines:
                    self._report(line)
                continue
            if isinstance(answer, DrawnBy):
                self._tell(f"cameras are drawn by {answer.device}")
                continue
            with self._lock:
                pending = self._pending.pop(answer.frame, None)
            if pending is None:
                continue
            if isinstance(answer, Done):
                memory = self._mapped(pending.camera)
                self._finish(
                    pending,
                    Frame(pending.time_ns, {name: memory[offset : offset + length] for name, (offset, length) in answer.stored.items()}),
                )
            elif isinstance(answer, Failed):
                self._finish(pending, Frame(pending.time_ns, {}, answer.reason))
        self._lost(connection, process)

    def _finish(self, pending: _Pending, frame: Frame) -> None:
        try:
            pending.deliver(frame)
        except Exception as error:  # a receiver's trouble must not silence the other cameras
            self._report(f"camera '{pending.camera.camera.name}': the picture could not be handed on: {error!r}")
        finally:
            self._release(pending)

    def _release(self, pending: _Pending) -> None:
        with self._lock:
            pending.camera.free.append(pending.slot)
        pending.finished.set()

    def _mapped(self, entry: _Camera) -> memoryview:
        memory = self._memory
        if memory is None or len(memory) < entry.offset + _SLOTS * entry.room:
            memory = self._memory = mmap.mmap(self._memory_fd, 0)
        return memoryview(memory)

    def _lost(self, connection: Connection, process: subprocess.Popen) -> None:
        code = process.wait()
        with self._lock:
            left, self._pending = list(self._pending.values()), {}
            self._connection = None
        connection.close()
        if not self._closed:
            self._failures += 1
            how = f"{'signal' if code < 0 else 'exit code'} {abs(code)}"
            self._report(
                f"the render process ended unexpectedly ({how}); "
                + ("it is started again" if self._failures <= _RESTARTS else "cameras stay off")
            )
        for pending in left:
            self._release(pending)
