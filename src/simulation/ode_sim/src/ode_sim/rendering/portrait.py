"""A picture of a world or of one model that fills the frame, from a side that has a name.

Drawn by :func:`main` in a process of its own, so that nothing of OpenGL stays in a simulator that is asked for one.
"""
from __future__ import annotations

import itertools
import math
import pickle
import subprocess
import sys
from dataclasses import dataclass
from typing import Dict, List, Tuple

import numpy as np

from ode_sim.description import model as d
from ode_sim.rendering.assets import Assets
from ode_sim.rendering.camera import Camera, look_at
from ode_sim.rendering.scene import SceneDescription

#: Azimuth and elevation in rad of the eye, seen from what it looks at.
VIEWS: Dict[str, Tuple[float, float]] = {
    "iso": (math.pi / 5, 0.45), "front": (0.0, 0.08), "back": (math.pi, 0.08), "left": (math.pi / 2, 0.08),
    "right": (-math.pi / 2, 0.08), "top": (math.pi / 2, math.pi / 2 - 0.01)}
_HFOV = 0.9
_FILLED = 0.88  # of the frame, along the side that is filled first
_LEAST = 0.05  # m, of what is looked at


class PortraitError(ValueError):
    """There is nothing to draw, or it cannot be drawn; one line."""


@dataclass(frozen=True)
class Portrait:
    """What to draw: ``scene`` with its link ``poses`` (L,7), of it the visuals of ``model`` ('' = all but the ground),
    from ``view``, with ``width`` x ``height`` pixels."""

    scene: SceneDescription
    poses: np.ndarray
    model: str
    view: str
    width: int
    height: int


def extent(portrait: Portrait) -> np.ndarray:
    """(N,3) corners, world frame, m, of the boxes around each visual that is to fill the frame; (0,3) if there is none.

    A plane has no end and a height map is the ground: both count only when they belong to ``model``.
    """
    assets, corners = Assets(), []
    ground = () if portrait.model else (d.Plane, d.Heightmap)
    for seen in portrait.scene.visuals:
        if isinstance(seen.visual.geometry, ground) or portrait.model not in ("", seen.name.split("::")[0]):
            continue
        for part in assets.parts(seen.visual, seen.name):
            points = assets.meshes[part.key].vertices
            low, high = points.min(axis=0), points.max(axis=0)
            box = np.array(list(itertools.product(*zip(low, high))))
            corners.append(_moved(_moved(box * part.scale, part.pose.p, part.pose.q),
                                  portrait.poses[seen.link, :3], portrait.poses[seen.link, 3:]))
    return np.concatenate(corners) if corners else np.zeros((0, 3))


def _moved(points: np.ndarray, p, q) -> np.ndarray:
    x, y, z, w = q
    rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    return points @ rotation.T + np.asarray(p)


def camera_for(corners: np.ndarray, view: str, width: int, height: int) -> Camera:
    """The camera that has all ``corners`` (N,3) in its frame, as near as that allows."""
    azimuth, elevation = VIEWS[view]
    level = math.cos(elevation)
    towards = -np.array([level * math.cos(azimuth), level * math.sin(azimuth), math.sin(elevation)])
    left = np.array([-towards[1], towards[0], 0.0]) / math.hypot(towards[0], towards[1])
    axes = np.stack([towards, left, np.cross(towards, left)])
    seen = corners @ axes.T
    depth, across = seen[:, 0], seen[:, 1:]
    slopes = np.array([math.tan(_HFOV / 2), math.tan(_HFOV / 2) * height / width]) * _FILLED
    # A point is in the frame if |across - middle| <= slope * (depth + distance); the best middle of a side serves both ends.
    high, low = (across / slopes - depth[:, None]).max(axis=0), (-across / slopes - depth[:, None]).max(axis=0)
    distance = max(float(((high + low) / 2).max()), _LEAST - float(depth.min()))
    middle = [_balanced(across[:, side], depth + distance) for side in (0, 1)]
    target = axes.T @ np.array([0.0, *middle])
    eye = target - towards * distance
    nearest = float(depth.min()) + distance
    return Camera("portrait", width, height, _HFOV, near=max(0.005, 0.2 * nearest), far=distance + 500.0,
                  pose=look_at(tuple(eye), tuple(target)))


def _balanced(across: np.ndarray, depth: np.ndarray) -> float:
    """The middle about which the points (N,) spread equally far to both sides of the picture."""
    low, high = float(across.min()), float(across.max())
    for _ in range(40):
        middle = (low + high) / 2
        shown = (across - middle) / depth
        low, high = (middle, high) if shown.max() > -shown.min() else (low, middle)
    return (low + high) / 2


def draw(portrait: Portrait) -> Tuple[bytes, List[str]]:
    """The picture as a PNG file, and lines about what could not be drawn. Here, in this process.

    :raises PortraitError: nothing to draw
    """
    import cv2

    from ode_sim.rendering.renderer import Renderer
    corners = extent(portrait)
    if not len(corners):
        if portrait.model:
            raise PortraitError(f"model '{portrait.model}' has nothing to see")
        corners = np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 0.5]])  # an empty world: the ground around the origin
    renderer = Renderer(antialiasing="msaa", shadows="on")
    try:
        renderer.set_scene(portrait.scene)
        pixels = renderer.color(camera_for(corners, portrait.view, portrait.width, portrait.height), portrait.poses)
        problems = renderer.take_problems()
    finally:
        renderer.close()
    return cv2.imencode(".png", cv2.cvtColor(pixels, cv2.COLOR_RGB2BGR))[1].tobytes(), problems


def take(portrait: Portrait, seconds: float = 60.0) -> Tuple[bytes, List[str]]:
    """As :func:`draw`, in another process.

    :raises PortraitError: nothing to draw, no OpenGL, or not done within ``seconds``
    """
    command = [sys.executable, "-c",
               f"import sys; sys.path[:] = {sys.path!r}; from ode_sim.rendering.portrait import main; main()"]
    try:
        ended = subprocess.run(command, input=pickle.dumps(portrait), capture_output=True, timeout=seconds)
    except subprocess.TimeoutExpired:
        raise PortraitError(f"the picture was not drawn within {seconds:g} s") from None
    if ended.returncode:
        last = ended.stderr.decode(errors="replace").strip().splitlines()[-1:] or [f"exit code {ended.returncode}"]
        raise PortraitError(last[0])
    return pickle.loads(ended.stdout)


def main() -> None:
    """Reads a pickled :class:`Portrait` on standard input, answers with the pickled result of :func:`draw`."""
    portrait = pickle.load(sys.stdin.buffer)
    try:
        answer = draw(portrait)
    except Exception as error:  # one line, which the asking process passes on
        sys.exit(f"{error}" if isinstance(error, PortraitError) else f"{type(error).__name__}: {error}")
    sys.stdout.buffer.write(pickle.dumps(answer))
