"""Films of the world as MP4 (H.264): poses are kept while it runs, and drawn afterwards by a process of its own.

The pictures are those of the simulator's cameras, from where the page looked. Nothing is drawn while the film is being
taken, so that it costs the simulation nothing and no picture is missing.
"""

from __future__ import annotations

import math
import os
import pickle
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from ode_sim.math3 import Vec3, vec3
from ode_sim_rendering.camera import Camera, look_at
from ode_sim_rendering.scene import WORLD_FRAME, SceneDescription, SceneLight, SceneVisual, roads_of

from ode_sim_viewer.simulation import Frame, Refused, WorldRecord

RATE = 25  # pictures a second of wall time
_LONGEST = 120.0  # s
_LARGEST = (1280, 720)
_DRAWING = 15.0  # s that drawing may take for each s of film, and besides


@dataclass(frozen=True)
class Shot:
    """``poses`` (L, 7) of the scene's links; ``eye`` and ``target`` m; ``field`` of view from top to bottom, rad."""

    scene: int
    poses: np.ndarray
    eye: Vec3
    target: Vec3
    field: float


@dataclass
class Movie:
    """``width`` and ``height`` in pixels become even, and not larger than 1280x720."""

    width: int
    height: int
    scenes: list[SceneDescription] = field(default_factory=list)
    shots: list[Shot] = field(default_factory=list)
    _revision: int = -1

    def __post_init__(self) -> None:
        scale = min(1.0, _LARGEST[0] / self.width, _LARGEST[1] / self.height)
        self.width, self.height = (max(16, int(side * scale) // 2 * 2) for side in (self.width, self.height))

    @property
    def full(self) -> bool:
        return len(self.shots) >= _LONGEST * RATE

    def add(self, world: WorldRecord, frame: Frame, camera: Any) -> None:
        """One picture: the ``frame`` of ``world`` as viser's ``camera`` sees it."""
        if self.full:
            return
        if world.revision != self._revision:
            self._revision = world.revision
            self.scenes.append(scene_of(world))
        self.shots.append(Shot(len(self.scenes) - 1, frame.poses, vec3(camera.position), vec3(camera.look_at), float(camera.fov)))

    def render(self) -> bytes:
        """The file. In another process; it takes about as long as the film.

        :raises Refused: nothing was taken, or it cannot be drawn
        """
        if not self.shots:
            raise Refused("Nothing was filmed yet.")
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "film.mp4")
            command = [sys.executable, "-c", f"import sys; sys.path[:] = {sys.path!r}; from ode_sim_viewer.movie import main; main()", file]
            seconds = _DRAWING * (1.0 + len(self.shots) / RATE)
            try:
                ended = subprocess.run(command, input=pickle.dumps(self), capture_output=True, timeout=seconds)
            except subprocess.TimeoutExpired:
                raise Refused(f"the film was not drawn within {seconds:.0f} s") from None
            if ended.returncode:
                said = ended.stderr.decode(errors="replace").strip().splitlines()[-1:] or ["it could not be drawn"]
                raise Refused(said[0])
            with open(file, "rb") as stream:
                return stream.read()


def scene_of(world: WorldRecord) -> SceneDescription:
    """What a renderer draws of a described world; rows are those of :attr:`Frame.poses`."""
    links, visuals = {}, []
    lights = [SceneLight(WORLD_FRAME, light) for light in world.lights]
    for model in world.models:
        for link in model.description.links:
            row = model.links.get(link.name)
            if row is not None:
                links[row] = f"{model.name}::{link.name}"
                visuals += [SceneVisual(row, f"{links[row]}::{visual.name}", visual) for visual in link.visuals]
                lights += [SceneLight(row, light) for light in link.lights]
    names = tuple(links.get(row, "") for row in range(max(links, default=-1) + 1))
    return SceneDescription(names, (*visuals, *roads_of(world.scene)), tuple(lights), world.scene)


def write(movie: Movie, file: str) -> None:
    """Draw ``movie`` into ``file`` here, in this process.

    :raises RuntimeError: OpenCV cannot write films.
    """
    import cv2
    from ode_sim_rendering.renderer import Renderer

    renderer = Renderer(antialiasing="msaa", shadows="auto")
    writer = cv2.VideoWriter(file, cv2.VideoWriter_fourcc(*"avc1"), RATE, (movie.width, movie.height))
    if not writer.isOpened():
        raise RuntimeError("this OpenCV cannot write H.264; install python3-opencv of Debian")
    now = -1
    try:
        for shot in movie.shots:
            if shot.scene != now:
                now = shot.scene
                renderer.set_scene(movie.scenes[now])
            wide = 2 * math.atan(math.tan(shot.field / 2) * movie.width / movie.height)
            camera = Camera("film", movie.width, movie.height, wide, near=0.02, far=1000.0, pose=look_at(shot.eye, shot.target))
            writer.write(cv2.cvtColor(renderer.color(camera, shot.poses), cv2.COLOR_RGB2BGR))
    finally:
        writer.release()
        renderer.close()


def main() -> None:
    """Reads a pickled :class:`Movie` on standard input and writes the file that the command line names."""
    movie = pickle.load(sys.stdin.buffer)
    try:
        write(movie, sys.argv[1])
    except Exception as error:  # one line, which the asking process passes on
        sys.exit(f"{type(error).__name__}: {error}")
