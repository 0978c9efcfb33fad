"""BVH files: motion capture as a text. Its bones point elsewhere than those of the skin; they are turned to it as Gazebo does."""

from __future__ import annotations

import math
import os

import numpy as np

from ode_sim.actors.animation import Animation
from ode_sim.actors.quaternions import from_matrices, to_matrices
from ode_sim.actors.skeleton import FARTHEST_BONE, MOST_BONES, Bone, Skeleton, matrices_of
from ode_sim.description.model import DescriptionError, quoted
from ode_sim.math3 import Quat

_MOST_BYTES = 64_000_000
_MOST_NUMBERS = 5_000_000
_AXES = {"X": (1.0, 0.0, 0.0), "Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}


class _Reader:
    """The hierarchy, line by line."""

    def __init__(self, path: str):
        self.path = path
        self.bones: list[Bone] = []
        self.offsets: list[np.ndarray] = []
        self.channels: list[list[str]] = []
        if os.path.getsize(path) > _MOST_BYTES:
            raise self.fault(f"is larger than {_MOST_BYTES // 1_000_000} MB")
        with open(path, encoding="utf-8", errors="replace") as stream:
            self.lines = [line.split() for line in stream if line.strip()]
        if not self.lines or self.lines[0][0] != "HIERARCHY":
            raise self.fault("does not begin with HIERARCHY")
        self.motion = self._hierarchy()

    def fault(self, reason: str) -> DescriptionError:
        return DescriptionError(f"{self.path}: {reason}")

    def _hierarchy(self) -> int:
        """:return: the number of the line MOTION."""
        around: list[int | None] = []  # None: an end site
        latest: int | None = -1
        for number, words in enumerate(self.lines[1:], 1):
            kind = words[0]
            if kind == "MOTION":
                if not self.bones or len(self.channels) != len(self.bones):
                    raise self.fault("has bones without CHANNELS")
                return number
            if kind in ("ROOT", "JOINT"):
                parent = around[-1] if around else -1
                if parent is None or len(self.bones) >= MOST_BONES:
                    raise self.fault(f"bone '{quoted(' '.join(words[1:]))}' stands in an end site, or is one of too many")
                name = words[1] if len(words) > 1 else f"bone_{len(self.bones)}"
                self.bones.append(Bone(name, name, parent, ()))
                self.offsets.append(np.zeros(3))
                latest = len(self.bones) - 1
            elif kind == "End":
                latest = None
            elif kind == "{":
                around.append(latest)
            elif kind == "}":
                if not around:
                    raise self.fault("closes a brace that was not opened")
                around.pop()
            elif kind == "OFFSET" and latest is not None:
                self.offsets[latest] = np.array(words[1:4], float)
            elif kind == "CHANNELS":
                self.channels.append(words[2 : 2 + int(words[1])])
        raise self.fault("has no MOTION")

    def frames(self) -> tuple[float, np.ndarray]:
        """Seconds between two, and (T, channels) numbers; lines that are too short are left out, as in Gazebo."""
        head = self.lines[self.motion + 1 : self.motion + 3]
        if len(head) < 2 or head[0][0] != "Frames:" or head[1][:2] != ["Frame", "Time:"]:
            raise self.fault("has no Frames: and Frame Time: after MOTION")
        step = float(head[1][2])
        width = sum(map(len, self.channels))
        rows = [row[:width] for row in self.lines[self.motion + 3 :][: int(head[0][1])] if len(row) >= width]
        if not rows or not 0.0 < step < 1e3 or len(rows) * len(self.bones) > _MOST_NUMBERS:
            raise self.fault(f"has {len(rows)} usable frames at {step:g} s; that is nothing to play")
        values = np.array(rows, float)
        if not (np.abs(values) <= FARTHEST_BONE).all() or not (np.abs(self.offsets) <= FARTHEST_BONE).all():
            raise self.fault(f"holds a number that is none, or one beyond {FARTHEST_BONE:g}")
        return step, values


def read_bvh(path: str) -> Animation:
    """The motion of the file ``path`` in its own bones, see :func:`fitted`.

    :raises DescriptionError: one line that names the file. A broken file may raise anything else.
    """
    reader = _Reader(path)
    step, values = reader.frames()
    rest = np.tile(np.eye(4), (len(reader.bones), 1, 1))
    rest[:, :3, 3] = reader.offsets
    count = len(values)
    positions, rotations = np.empty((count, len(reader.bones), 3)), np.empty((count, len(reader.bones), 4))
    column = 0
    for index, channels in enumerate(reader.channels):
        place, turn = np.tile(reader.offsets[index], (count, 1)), np.tile(np.eye(4), (count, 1, 1))
        for channel in channels:
            axis = channel[:1].upper()
            if channel.endswith("position"):
                place[:, "XYZ".index(axis)] = values[:, column]
            elif channel.endswith("rotation"):
                turn = turn @ matrices_of("rotate", np.column_stack([np.tile(_AXES[axis], (count, 1)), values[:, column]]))
            column += 1
        positions[:, index], rotations[:, index] = place, from_matrices(turn[:, :3, :3])
    skeleton = Skeleton(path, tuple(reader.bones), rest, {})
    return Animation(skeleton, step * np.arange(count), positions, rotations, np.ones(len(reader.bones), bool))


def fitted(animation: Animation, skin: Skeleton) -> Animation:
    """The motion of ``animation`` in the bones of ``skin``: each as long as the skin's, turned by how the two point elsewhere at rest.

    Its root stays where the script has it, in the file's own axes: what is up there is up, as Gazebo has it.
    """
    before, after = _aligners(animation.skeleton, skin)
    length = np.linalg.norm(skin.rest[:, :3, 3], axis=1)
    way = animation.positions.copy()
    size = np.linalg.norm(way, axis=2, keepdims=True)
    way = np.divide(way, size, out=np.zeros_like(way), where=size > 0.0) * length[:, None]
    positions = np.einsum("nij,tnj->tni", before, way)
    positions[:, 0] = 0.0
    turns = to_matrices(animation.rotations)
    turns[:, 1:] = before[1:] @ turns[:, 1:] @ after[1:]
    return Animation(animation.skeleton, animation.times, positions, from_matrices(turns), animation.moved, root_turn=_quat(before[0]))


def _quat(turn: np.ndarray) -> Quat:
    x, y, z, w = map(float, from_matrices(turn))
    return x, y, z, w


def _aligners(bvh: Skeleton, skin: Skeleton) -> tuple[np.ndarray, np.ndarray]:
    """(N, 3, 3) each: what a bone's motion is multiplied by from the left and from the right."""
    local = bvh.rest.copy()
    frames, skin_frames = bvh.model_frames(), skin.model_frames()
    known: dict[int, np.ndarray] = {0: skin.rest[0, :3, :3]}
    local[0, :3, :3] = known[0]
    counts = bvh.child_counts
    for index in range(len(bvh.bones)):
        for each, bone in enumerate(bvh.bones):  # what was turned above turns all that hangs on it
            frames[each] = local[each] if bone.parent < 0 else frames[bone.parent] @ local[each]
        if counts[index] != 1:
            continue
        child = bvh.children(index)[0]
        way, wanted = frames[child, :3, 3] - frames[index, :3, 3], skin_frames[child, :3, 3] - skin_frames[index, :3, 3]
        size = float(np.linalg.norm(way) * np.linalg.norm(wanted))
        if size < 1e-12:
            continue
        turn = _between(way, wanted, size)
        own, of_skin = frames[index, :3, :3], skin_frames[index, :3, :3]
        known[child] = of_skin.T @ turn @ own
        local[index, :3, :3] = own.T @ turn @ own
    before = np.array([known.get(index, np.eye(3)) for index in range(len(bvh.bones))])
    after = np.array([local[index, :3, :3].T @ before[index].T @ skin.rest[index, :3, :3] for index in range(len(bvh.bones))])
    after[0] = np.eye(3)
    return before, after


def _between(way: np.ndarray, wanted: np.ndarray, size: float) -> np.ndarray:
    """(3, 3), by upstream's rule: the angle is never more than a right one."""
    axis = np.cross(way, wanted)
    sine = float(np.linalg.norm(axis)) / size
    if sine < 1e-12:
        return np.eye(3)
    angle = math.degrees(math.asin(min(sine, 1.0)))
    return matrices_of("rotate", np.array([[*axis, angle]]))[0, :3, :3]
