"""A picture of a world or of one model that fills the frame, from a side that has a name.

:class:`Painter` draws them in a process of its own, so that nothing of OpenGL comes into a simulator that is asked for one.
"""

from __future__ import annotations

import itertools
import math
import os
import pickle
import select
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from ode_sim.description import model as d
from ode_sim.errors import Refused
from ode_sim.math3 import Pose, quat_to_matrix

from ode_sim_rendering.assets import Assets
from ode_sim_rendering.camera import Camera, look_at
from ode_sim_rendering.scene import SceneDescription

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from ode_sim_rendering.renderer import Renderer

#: Azimuth and elevation in rad of the eye, seen from what it looks at.
VIEWS: dict[str, tuple[float, float]] = {
    "iso": (math.pi / 5, 0.45),
    "front": (0.0, 0.08),
    "back": (math.pi, 0.08),
    "left": (math.pi / 2, 0.08),
    "right": (-math.pi / 2, 0.08),
    "top": (math.pi / 2, math.pi / 2 - 0.01),
}
_HFOV = 0.9
_WINDOW_HFOV = 1.0472
_FILLED = 0.88  # of the frame, along the side that is filled first
_LEAST = 0.05  # m, of what is looked at
_SHOWN = 0.5  # of a model's pixels: where less of it is to be seen, what stands before it is cut away
_COARSE = 4  # pixels of a picture for one of those that are counted
_KEPT = 20.0  # s for which a process without work is kept


@dataclass(frozen=True)
class Portrait:
    """What to draw: ``scene`` with its link ``poses`` (L,7), of it the visuals of ``model`` ('' = all but the ground),
    from ``view``, with ``width`` x ``height`` pixels. ``eye``: X_WE of an eye that looks along its x axis, in place of a view."""

    scene: SceneDescription
    poses: np.ndarray
    model: str
    view: str
    width: int
    height: int
    eye: Pose | None = None


def extent(portrait: Portrait, assets: Assets | None = None) -> np.ndarray:
    """(N,3) corners, world frame, m, of the boxes around each visual of ``portrait`` that is to fill the frame; (0,3) if there is none.

    A plane has no end and a height map is the ground: both count only when they belong to ``model``.

    :param assets: meshes that are loaded; None loads them.
    """
    assets, corners = assets or Assets(), []
    ground = () if portrait.model else (d.Plane, d.Heightmap)
    for seen in portrait.scene.visuals:
        if isinstance(seen.visual.geometry, ground) or portrait.model not in ("", seen.name.split("::")[0]):
            continue
        for part in assets.parts(seen.visual, seen.name):
            points = assets.meshes[part.key].vertices
            low, high = points.min(axis=0), points.max(axis=0)
            box = np.array(list(itertools.product(*zip(low, high))))
            corners.append(
                _moved(_moved(box * part.scale, part.pose.p, part.pose.q), portrait.poses[seen.link, :3], portrait.poses[seen.link, 3:])
            )
    return np.concatenate(corners) if corners else np.zeros((0, 3))


def _moved(points: np.ndarray, p: ArrayLike, q: Iterable[float]) -> np.ndarray:
    x, y, z, w = q
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    return points @ rotation.T + np.asarray(p)


def camera_for(corners: np.ndarray, view: str, width: int, height: int) -> Camera:
    """The camera of ``width`` x ``height`` pixels that has all ``corners`` (N,3) in its frame from the side ``view``, as near as it can.

    :param view: one of :data:`VIEWS`.
    """
    return camera_from(corners, *VIEWS[view], width, height)


def camera_from(corners: np.ndarray, azimuth: float, elevation: float, width: int, height: int, hfov: float = _HFOV) -> Camera:
    """The camera that has all ``corners`` (N,3) in its frame from a side given in rad, as near as that allows.

    :param azimuth, elevation: where the camera is, seen from the middle: from x to the left, and up.
    :param width, height: pixels. :param hfov: horizontal field of view, rad.
    """
    level = math.cos(elevation)
    towards = -np.array([level * math.cos(azimuth), level * math.sin(azimuth), math.sin(elevation)])
    left = np.array([-towards[1], towards[0], 0.0]) / math.hypot(towards[0], towards[1])
    axes = np.stack([towards, left, np.cross(towards, left)])
    seen = corners @ axes.T
    depth, across = seen[:, 0], seen[:, 1:]
    slopes = np.array([math.tan(hfov / 2), math.tan(hfov / 2) * height / width]) * _FILLED
    # A point is in the frame if |across - middle| <= slope * (depth + distance); the best middle of a side serves both ends.
    high, low = (across / slopes - depth[:, None]).max(axis=0), (-across / slopes - depth[:, None]).max(axis=0)
    distance = max(float(((high + low) / 2).max()), _LEAST - float(depth.min()))
    middle = [_balanced(across[:, side], depth + distance) for side in (0, 1)]
    eye = axes.T @ np.array([-distance, *middle])
    nearest = float(depth.min()) + distance
    return Camera(
        "portrait",
        width,
        height,
        hfov,
        near=max(0.005, 0.2 * nearest),
        far=float(depth.max()) + distance + 500.0,
        pose=look_at(tuple(eye), tuple(eye + towards)),
    )


def camera_at(eye: Pose, corners: np.ndarray, width: int, height: int) -> Camera:
    """The camera that stands at ``eye`` (X_WE), with the field of view of Gazebo's window; it sees as far as all ``corners`` (N,3) are.

    :param width, height: pixels.
    """
    farthest = float(np.linalg.norm(corners - np.asarray(eye.p), axis=1).max())
    return Camera("portrait", width, height, _WINDOW_HFOV, near=0.05, far=farthest + 500.0, pose=eye)


def without_foreground(camera: Camera, corners: np.ndarray) -> Camera:
    """``camera``, blind to whatever is nearer than all ``corners`` (N,3)."""
    axis = np.array(quat_to_matrix(camera.pose.q))[:, 0]
    return replace(camera, near=max(camera.near, 0.98 * float(((corners - camera.pose.p) @ axis).min())))


def _balanced(across: np.ndarray, depth: np.ndarray) -> float:
    """The middle about which the points (N,) spread equally far to both sides of the picture."""
    low, high = float(across.min()), float(across.max())
    for _ in range(40):
        middle = (low + high) / 2
        shown = (across - middle) / depth
        low, high = (middle, high) if shown.max() > -shown.min() else (low, middle)
    return (low + high) / 2


class Studio:
    """Draws portraits in this process; those of the same scene, one after the other, share what was loaded for it."""

    def __init__(self) -> None:
        self._renderer: Renderer | None = None
        self._assets = Assets()
        self._scene: SceneDescription | None = None

    def draw(self, portrait: Portrait) -> tuple[bytes, list[str]]:
        """The picture ``portrait`` as a PNG file, and lines about what could not be drawn, each said once for a scene.

        :raises Refused: nothing to draw
        """
        import cv2

        from ode_sim_rendering.renderer import Renderer

        if portrait.scene is not self._scene:
            self.close()
            self._scene, self._assets = portrait.scene, Assets()
        corners = extent(portrait, self._assets)
        if not len(corners):
            if portrait.model:
                raise Refused(f"model '{portrait.model}' has nothing to see")
            corners = np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 0.5]])  # an empty world: the ground around the origin
        if self._renderer is None:
            self._renderer = Renderer(antialiasing="msaa", shadows="on", assets=self._assets)
            self._renderer.set_scene(portrait.scene)
        camera = (
            camera_for(corners, portrait.view, portrait.width, portrait.height)
            if portrait.eye is None
            else camera_at(portrait.eye, corners, portrait.width, portrait.height)
        )
        if portrait.model:
            bare = without_foreground(camera, corners)
            if self._pixels(camera, portrait) < _SHOWN * self._pixels(bare, portrait):
                camera = bare
        pixels = self._renderer.color(camera, portrait.poses)
        png = cv2.imencode(".png", cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR))[1].tobytes()
        return png, self._renderer.take_problems()

    def _pixels(self, camera: Camera, portrait: Portrait) -> int:
        """How many pixels of a coarser picture show the model."""
        coarse = replace(camera, width=camera.width // _COARSE, height=camera.height // _COARSE)
        assert self._renderer is not None
        own = [i for i, name in enumerate(self._renderer.visual_names) if name.split("::")[0] == portrait.model]
        return int(np.isin(self._renderer.segmentation(coarse, portrait.poses), own).sum())

    def close(self) -> None:
        """Gives up what was loaded."""
        if self._renderer is not None:
            self._renderer.close()
        self._renderer = self._scene = None


class Painter:
    """Draws portraits in a process of its own, in which OpenGL stays; :meth:`take` may be called from several threads.

    The process ends after some seconds without work. Until then the next picture of the same scene takes a tenth of the time.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._process: subprocess.Popen | None = None
        self._words = tempfile.TemporaryFile()  # what the process says of its own end
        self._scene = b""

    def take(self, portrait: Portrait, seconds: float = 60.0) -> tuple[bytes, list[str]]:
        """As :meth:`Studio.draw` with ``portrait``.

        :raises Refused: nothing to draw, no OpenGL, or not done within ``seconds``
        """
        scene = pickle.dumps(portrait.scene)
        with self._lock:
            kept = self._process is not None and self._process.poll() is None
            if kept:
                answer = self._ask(scene if scene != self._scene else b"", portrait, seconds)
            if not kept or answer is None:  # none yet, or it has just ended for lack of work
                self._start()
                answer = self._ask(scene, portrait, seconds)
            if answer is None:
                raise Refused(self._last_words())
            self._scene = scene
        if isinstance(answer, str):
            raise Refused(answer)
        return answer

    def close(self) -> None:
        with self._lock:
            if self._process is not None:
                self._process.kill()
                self._process.communicate()
                self._process = None

    def _start(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.communicate()
        command = [sys.executable, "-c", f"import sys; sys.path[:] = {sys.path!r}; from ode_sim_rendering.portrait import main; main()"]
        self._words.truncate(0)
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._words)

    def _ask(self, scene: bytes, portrait: Portrait, seconds: float) -> tuple[bytes, list[str]] | str | None:
        """The answer, None when the process ended without one."""
        process = self._process
        assert process is not None and process.stdin is not None and process.stdout is not None
        late = threading.Event()

        def give_up() -> None:
            late.set()
            process.kill()

        timer = threading.Timer(seconds, give_up)
        timer.start()
        try:
            pickle.dump((scene, replace(portrait, scene=SceneDescription())), process.stdin)
            process.stdin.flush()
            return pickle.load(process.stdout)
        except (EOFError, OSError, pickle.UnpicklingError):
            process.kill()
            process.wait()
            if late.is_set():
                raise Refused(f"the picture was not drawn within {seconds:g} s") from None
            return None
        finally:
            timer.cancel()

    def _last_words(self) -> str:
        self._words.seek(0)
        lines = self._words.read().decode(errors="replace").strip().splitlines()
        assert self._process is not None
        return lines[-1] if lines else f"the process that draws ended with exit code {self._process.returncode}"


def main() -> None:
    """Reads pickled ``(scene, portrait)`` on standard input, an empty scene being the one before; answers each with what
    :meth:`Studio.draw` returns, or a line about why not. Ends with its input, or after some seconds without."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what a library prints is no answer
    studio, scene = Studio(), SceneDescription()
    while select.select([sys.stdin], [], [], _KEPT)[0]:
        try:
            pickled, portrait = pickle.load(sys.stdin.buffer)
        except EOFError:
            return
        scene = pickle.loads(pickled) if pickled else scene
        try:
            answer: object = studio.draw(replace(portrait, scene=scene))
        except Refused as error:
            answer = str(error)
        except Exception as error:  # one line, which the asking process passes on
            answer = f"{type(error).__name__}: {error}"
        pickle.dump(answer, answers)
        answers.flush()
