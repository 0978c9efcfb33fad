"""How bones move over time: the frames of a Collada file's animation, and the pose between two of them."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from ode_sim.actors.collada_tree import ColladaTree, Element, child, children, tag
from ode_sim.actors.quaternions import from_matrices, slerp
from ode_sim.actors.skeleton import FARTHEST_BONE, Bone, Skeleton, matrices_of, read_skeleton, told_in_one_line
from ode_sim.description.model import DescriptionError
from ode_sim.math3 import Quat
from ode_sim.mesh import file_stamp

_MOST_NUMBERS = 5_000_000  # frames times bones


@dataclass(frozen=True, eq=False)
class Animation:
    """``times`` (T,) s, ascending; ``positions`` (T, N, 3) m and ``rotations`` (T, N, 4) x y z w of each bone in its parent.

    ``moved`` (N,): the file says how this bone moves; of the others the skin's own rest counts.
    """

    skeleton: Skeleton
    times: np.ndarray
    positions: np.ndarray
    rotations: np.ndarray
    moved: np.ndarray
    root_turn: Quat | None = None  # x y z w, by which a path is turned: of BVH files, in which y is up

    @property
    def length(self) -> float:
        """s; from 0 to the last frame."""
        return float(self.times[-1])

    def pose_at(self, time: float) -> tuple[np.ndarray, np.ndarray]:
        """Positions (N, 3) and rotations (N, 4) at ``time``, s; after its end it begins anew, before its first frame that one counts."""
        time = looped(time, self.length)
        after = int(np.searchsorted(self.times, time, side="right"))
        if after == 0 or after == len(self.times):
            at = 0 if after == 0 else after - 1
            return self.positions[at], self.rotations[at]
        before = after - 1
        part = (time - self.times[before]) / (self.times[after] - self.times[before])
        return (
            self.positions[before] + part * (self.positions[after] - self.positions[before]),
            slerp(self.rotations[before], self.rotations[after], part),
        )

    def time_at(self, distance: float) -> float | None:
        """When the root has come ``distance`` along its x, m; beyond the last frame it begins anew. None: it does not go there."""
        x = self.positions[:, 0, 0]
        if not self.moved[0] or not x[-1] > max(x[0], 1e-6):
            return None
        distance = max(looped(distance, float(x[-1])), float(x[0]))
        at = int(np.argmax(x >= distance))
        if at == 0 or x[at] == distance:
            return float(self.times[at])
        part = (distance - x[at - 1]) / (x[at] - x[at - 1])
        return float(self.times[at - 1] + part * (self.times[at] - self.times[at - 1]))


def looped(value: float, length: float) -> float:
    """``value`` less whole lengths; the length itself stays, as the end of the first round."""
    if value <= length:
        return value
    if length <= 0.0:
        return 0.0
    rest = value % length
    return rest if rest > 0.0 else length


def load_animation(path: str) -> Animation:
    """The first animation of the file ``path``, Collada or BVH; for the skin of a skeleton see :func:`animation_for`.

    :raises DescriptionError: one line that names the file.
    """
    return _load(path, file_stamp(path))


def animation_for(path: str, skin: Skeleton) -> Animation:
    """The animation of the file ``path`` as the bones of ``skin`` play it.

    :raises DescriptionError: one line that names the file: it cannot be read, or is of another skeleton.
    """
    animation = load_animation(path)
    if animation.skeleton.child_counts != skin.child_counts:
        raise DescriptionError(f"{path}: its skeleton is not that of the skin {skin.path}; both need as many bones, joined alike")
    if not path.lower().endswith(".bvh"):
        return animation
    from ode_sim.actors.bvh import fitted

    return told_in_one_line(path, lambda: fitted(animation, skin))


@functools.lru_cache(maxsize=16)
def _load(path: str, _stamp: tuple[int, int]) -> Animation:
    if path.lower().endswith(".bvh"):
        from ode_sim.actors.bvh import read_bvh

        return told_in_one_line(path, lambda: read_bvh(path))
    return told_in_one_line(path, lambda: _read(ColladaTree(path)))


def _read(tree: ColladaTree) -> Animation:
    skeleton = read_skeleton(tree)
    channels: dict[int, list[Element]] = {}
    by_id = {bone.id: index for index, bone in reversed(list(enumerate(skeleton.bones)))}
    for channel in _channels(tree):
        bone = by_id.get((channel.get("target") or "").partition("/")[0])
        if bone is not None:
            channels.setdefault(bone, []).append(channel)
    if not channels:
        raise tree.fault("has no animation of its skeleton (<library_animations>)")
    moved = {index: _node(tree, skeleton.bones[index], found) for index, found in channels.items()}
    return assembled(tree, skeleton, moved)


def assembled(tree: ColladaTree, skeleton: Skeleton, moved: dict[int, tuple[np.ndarray, np.ndarray]]) -> Animation:
    """All bones of ``skeleton`` at all times, of those at which each moves.

    :param tree: the file, for errors. :param moved: by the bone's index, times (T,) s and matrices (T, 4, 4) in its parent.
    :raises DescriptionError: no frames that could be played.
    """
    times = np.unique(np.concatenate([own for own, _ in moved.values()]))
    count = len(skeleton.bones)
    if len(times) * count > _MOST_NUMBERS:
        raise tree.fault(f"its animation has {len(times)} frames of {count} bones; at most {_MOST_NUMBERS} make sense")
    if not np.isfinite(times).all() or times[0] < -1e6 or times[-1] > 1e6:
        raise tree.fault("its animation has times that no clock shows")
    positions = np.tile(skeleton.rest[:, :3, 3], (len(times), 1, 1))
    rotations = np.tile(from_matrices(skeleton.rest[:, :3, :3]), (len(times), 1, 1))
    for index, (own, matrices) in moved.items():
        own_rotations = from_matrices(matrices[:, :3, :3])
        at = np.clip(np.searchsorted(own, times, side="right") - 1, 0, len(own) - 1)
        after = np.minimum(at + 1, len(own) - 1)
        span = own[after] - own[at]
        part = np.clip(np.divide(times - own[at], span, out=np.zeros_like(times), where=span > 0.0), 0.0, 1.0)
        place = matrices[:, :3, 3]
        positions[:, index] = place[at] + part[:, None] * (place[after] - place[at])
        rotations[:, index] = slerp(own_rotations[at], own_rotations[after], part[:, None])
    if not (np.abs(positions) <= FARTHEST_BONE).all() or not np.isfinite(rotations).all():
        raise tree.fault(f"its animation moves a bone farther than {FARTHEST_BONE:g} m")
    flags = np.zeros(count, bool)
    flags[list(moved)] = True
    return Animation(skeleton, times, positions, rotations, flags)


def _channels(tree: ColladaTree) -> list[Element]:
    """Those of the first animation: Gazebo plays no other."""
    library = child(tree.root, "library_animations")
    sets = children(library, "animation")
    if sets and children(sets[0], "animation"):
        library = sets[0]
    return [element for element in library.iter() if tag(element) == "channel"] if library is not None else []


def _node(tree: ColladaTree, bone: Bone, channels: list[Element]) -> tuple[np.ndarray, np.ndarray]:
    """Times (T,) and poses (T, 4, 4), in metres, of a bone."""
    tracks = [_track(tree, channel, bone) for channel in channels]
    times = np.unique(np.concatenate([own for _, _, own, _ in tracks]))
    numbers = {at: np.tile(np.array(transform.values), (len(times), 1)) for at, transform in enumerate(bone.transforms)}
    sids = {transform.sid: at for at, transform in enumerate(bone.transforms) if transform.sid}
    for sid, component, own, values in tracks:
        at = sids.get(sid)
        if at is None:
            continue
        width = numbers[at].shape[1]
        wanted = range(width) if component is None else (component,)
        if values.shape[1] < len(wanted) or any(column >= width for column in wanted):
            raise tree.fault(f"the animation of '{bone.name}/{sid}' has {values.shape[1]} numbers at a time, not {width}")
        for source, column in enumerate(wanted):
            numbers[at][:, column] = np.interp(times, own, values[:, source])
    result = np.tile(np.eye(4), (len(times), 1, 1))
    for at, transform in enumerate(bone.transforms):
        result = result @ matrices_of(transform.kind, numbers[at])
    result[:, :3, 3] *= tree.unit
    return times, result


def _track(tree: ColladaTree, channel: Element, bone: Bone) -> tuple[str, int | None, np.ndarray, np.ndarray]:
    """What a channel moves: the transform's name, one of its numbers or None for all; times (T,), values (T, n)."""
    sid, component = _target(channel.get("target") or "")
    sampler = tree.by_url(channel.get("source"), "sampler")
    if sampler is None:
        raise tree.fault(f"the animation of bone '{bone.name}' names a sampler that is not there")
    times = tree.numbers(child(tree.source(sampler, "INPUT"), "float_array"), f"the times of bone '{bone.name}'")
    values = tree.numbers(child(tree.source(sampler, "OUTPUT"), "float_array"), f"the values of bone '{bone.name}'")
    if len(times) == 0 or len(values) == 0 or len(values) % len(times):
        raise tree.fault(f"the animation of bone '{bone.name}' has {len(values)} values for {len(times)} times")
    order = np.argsort(times, kind="stable")
    return sid, component, times[order], values.reshape(len(times), -1)[order]


def _target(target: str) -> tuple[str, int | None]:
    """``transform``, ``rotateX.ANGLE``, ``transform(0)(3)``: which transform of the bone, and which of its numbers."""
    path = target.partition("/")[2]
    name, dot, word = path.partition(".")
    if dot:
        return name, {"X": 0, "Y": 1, "Z": 2, "ANGLE": 3}.get(word)
    name, *indices = path.replace(")", "").split("(")
    places = [int(index) for index in indices if index.isdigit()]
    if not places:
        return name, None
    return name, places[0] if len(places) == 1 else 4 * places[0] + places[1]
