"""Pictures and short films of a task, drawn by the simulator while its time stands still."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .simulated_world import Bench, Sample

_PERIOD, _RATE, _MOST = 0.5, 4, 24  # s of simulation between frames, frames/s of the film, frames


class Film:
    def __init__(self, bench: Bench, model: str):
        self._bench, self._model = bench, model
        self._frames: list[bytes] = []
        self._due = -1.0

    def sample(self, sample: Sample) -> None:
        if sample.time >= self._due - 1e-9 and len(self._frames) < _MOST:
            self._due = sample.time + _PERIOD
            self._frames.append(self._bench.picture(self._model, 480, 320))

    def write(self, path: str) -> str:
        """The film's path, '' when there is none: nothing could be drawn, or no time passed."""
        import cv2
        import numpy as np

        frames = [cv2.imdecode(np.frombuffer(png, np.uint8), cv2.IMREAD_COLOR) for png in self._frames if png]
        if len(frames) < 2:  # nothing passed that the picture does not show
            return ""
        os.makedirs(os.path.dirname(path), exist_ok=True)
        writer = cv2.VideoWriter(path, cv2.VideoWriter_fourcc(*"avc1"), _RATE, frames[0].shape[1::-1])
        for frame in frames:
            writer.write(frame)
        writer.release()
        return path if os.path.exists(path) else ""


def picture(bench: Bench, model: str, stem: str) -> list[str]:
    """Draws ``model`` at a task's end to ``stem`` with ``.png``. :returns: its path, nothing where ``bench`` cannot draw"""
    png = bench.picture(model)
    if not png:
        return []
    os.makedirs(os.path.dirname(stem), exist_ok=True)
    with open(stem + ".png", "wb") as file:
        file.write(png)
    return [stem + ".png"]
