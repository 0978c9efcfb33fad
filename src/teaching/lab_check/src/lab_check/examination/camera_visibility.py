"""What a simulated camera sees of each model. ``python3 -m lab_check.examination.camera_visibility`` is a process of its own, so that
OpenGL stays in it.

Reads a pickled (camera, scene, poses of links) from standard input; writes the share of the picture that each visual has, by its name,
as JSON.
"""

from __future__ import annotations

import json
import os
import pickle
import sys
from collections import Counter
from typing import TYPE_CHECKING

import numpy as np

from lab_check.examination.scoped_names import belongs

if TYPE_CHECKING:
    from ode_sim_rendering.camera import Camera
    from ode_sim_rendering.scene import SceneDescription


def shares(camera: Camera, scene: SceneDescription, poses: np.ndarray) -> dict[str, float]:
    """``model::link::visual`` -> its part of the picture that ``camera`` takes of ``scene``, of those that can be seen.

    :param poses: (L, 7) x y z qx qy qz qw of the scene's links, world frame
    """
    from ode_sim_rendering.renderer import Renderer

    renderer = Renderer()
    renderer.set_scene(scene)
    picture = renderer.segmentation(camera, poses)
    found: Counter = Counter()
    for number, pixels in zip(*np.unique(picture, return_counts=True)):
        if number >= 0:
            found[renderer.visual_names[number]] += int(pixels)
    return {name: pixels / picture.size for name, pixels in sorted(found.items())}


def share_of(name: str, found: dict[str, float]) -> float:
    """The part of the picture that ``name`` has, a model or ``model::link``, of ``found``, which :func:`shares` gave."""
    return sum(part for visual, part in found.items() if belongs(visual, name))


def main() -> None:
    answer = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what a library prints is no answer
    json.dump(shares(*pickle.load(sys.stdin.buffer)), answer)


if __name__ == "__main__":
    main()
