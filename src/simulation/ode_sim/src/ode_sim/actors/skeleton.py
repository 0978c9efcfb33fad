"""The bones of a Collada file that has a skin: their tree, how they rest, and where the skin was bound to them."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from ode_sim.actors.collada_tree import ColladaTree, Element, child, children, tag
from ode_sim.description.model import DescriptionError, one_line, quoted
from ode_sim.mesh import file_stamp

MOST_BONES = 500
FARTHEST_BONE = 1e5  # m
T = TypeVar("T")


@dataclass(frozen=True)
class NodeTransform:
    """One element that moves a node: its kind, by which name animations know it, its numbers."""

    kind: str
    sid: str
    values: tuple[float, ...]


@dataclass(frozen=True)
class Bone:
    name: str
    id: str
    parent: int  # -1: the root
    transforms: tuple[NodeTransform, ...]


@dataclass(frozen=True, eq=False)
class Skeleton:
    """Bones in the order in which Gazebo numbers them, parents first; lengths in metres."""

    path: str
    bones: tuple[Bone, ...]
    rest: np.ndarray  # (N, 4, 4), of each in its parent
    inverse_bind: dict[int, np.ndarray]  # (4, 4) in the file's own unit, of those that carry skin

    @property
    def child_counts(self) -> list[int]:
        counts = [0] * len(self.bones)
        for bone in self.bones:
            if bone.parent >= 0:
                counts[bone.parent] += 1
        return counts

    def children(self, index: int) -> list[int]:
        """Numbers of the bones that hang on bone ``index``."""
        return [i for i, bone in enumerate(self.bones) if bone.parent == index]

    def index_of(self, word: str) -> int | None:
        """The bone called ``word``: by name, as skins tell bones; else by id, as animations do."""
        for index, bone in enumerate(self.bones):
            if bone.name == word:
                return index
        return next((index for index, bone in enumerate(self.bones) if bone.id == word), None)

    def model_frames(self) -> np.ndarray:
        """(N, 4, 4), of each in the skeleton's own frame, at rest."""
        frames = np.empty_like(self.rest)
        for index, bone in enumerate(self.bones):
            frames[index] = self.rest[index] if bone.parent < 0 else frames[bone.parent] @ self.rest[index]
        return frames


def load_skeleton(path: str) -> Skeleton:
    """The skeleton of the file ``path``. :raises DescriptionError: one line that names the file."""
    return _load(path, file_stamp(path))


@functools.lru_cache(maxsize=16)
def _load(path: str, _stamp: tuple[int, int]) -> Skeleton:
    return told_in_one_line(path, lambda: read_skeleton(ColladaTree(path)))


def told_in_one_line(path: str, read: Callable[[], T]) -> T:
    """What ``read`` returns; what a broken file ``path`` makes it raise becomes a ``DescriptionError``."""
    try:
        with np.errstate(all="ignore"):
            return read()
    except DescriptionError:
        raise
    except Exception as error:  # a parser fed with a broken file may raise anything
        raise DescriptionError(f"{path}: is broken, {one_line(error, 150) or type(error).__name__}") from None


def read_skeleton(tree: ColladaTree) -> Skeleton:
    """The skeleton in ``tree``. :raises DescriptionError: there is none, or it is broken."""
    controller, instance = skin_of(tree)
    roots = [tree.by_url(skeleton.text, "node") for skeleton in children(instance, "skeleton")]
    nodes = [node for node in roots if node is not None] or children(tree.scene(), "node")
    bones: list[Bone] = []
    if len(nodes) > 1:
        bones.append(Bone("gazebo-dummy-root", "gazebo-dummy-root", -1, ()))
    for node in nodes:
        _gather(tree, node, 0 if len(nodes) > 1 else -1, bones)
    if not bones:
        raise tree.fault("its skin has no skeleton")
    skeleton = Skeleton(tree.path, tuple(bones), np.array([matrix_of(bone.transforms) for bone in bones]), {})
    inverse_bind = _inverse_bind(tree, child(controller, "skin"), skeleton)
    bound = Skeleton(tree.path, skeleton.bones, _at_bind(skeleton, inverse_bind, tree.unit), inverse_bind)
    if not (np.abs(bound.rest) <= FARTHEST_BONE).all() or not (np.abs(bound.model_frames()) <= FARTHEST_BONE).all():
        raise tree.fault(f"a bone of its skeleton lies farther than {FARTHEST_BONE:g} m from another one")
    return bound


def skin_of(tree: ColladaTree) -> tuple[Element, Element]:
    """The first controller in ``tree`` with a skin that the scene shows, and where it does so."""
    for instance in tree.iter("instance_controller"):
        controller = tree.by_url(instance.get("url"), "controller")
        if child(controller, "skin") is not None:
            assert controller is not None
            return controller, instance
    raise tree.fault("has no skin on a skeleton (<library_controllers>)")


def _gather(tree: ColladaTree, node: Element, parent: int, bones: list[Bone]) -> None:
    todo = [(node, parent)]
    while todo:
        at, above = todo.pop()
        if len(bones) >= MOST_BONES:
            raise tree.fault(f"its skeleton has more than {MOST_BONES} bones")
        identity = at.get("id") or ""
        name = at.get("sid") or at.get("name") or identity or f"bone_{len(bones)}"
        bones.append(Bone(name, identity, above, _transforms(tree, at, name)))
        index = len(bones) - 1
        todo += [(below, index) for below in reversed(children(at, "node"))]


def _transforms(tree: ColladaTree, node: Element, name: str) -> tuple[NodeTransform, ...]:
    counts = {"matrix": 16, "translate": 3, "rotate": 4, "scale": 3}
    found = []
    for entry in node:
        kind = tag(entry)
        if kind in counts:
            values = tree.numbers(entry, f"<{kind}> of bone '{quoted(name)}'")
            if len(values) != counts[kind]:
                raise tree.fault(f"<{kind}> of bone '{quoted(name)}' has {len(values)} numbers, not {counts[kind]}")
            found.append(NodeTransform(kind, entry.get("sid") or "", tuple(values)))
    return tuple(found)


def matrix_of(transforms: tuple[NodeTransform, ...]) -> np.ndarray:
    """(4, 4) of ``transforms``, one after the other."""
    result = np.eye(4)
    for transform in transforms:
        result = result @ matrices_of(transform.kind, np.array([transform.values]))[0]
    return result


def matrices_of(kind: str, values: np.ndarray) -> np.ndarray:
    """(T, 4, 4) of a transform of ``kind`` matrix, translate, scale or rotate whose numbers ``values`` (T, n) change over time."""
    count = len(values)
    if kind == "matrix":
        return values.reshape(count, 4, 4)
    result = np.tile(np.eye(4), (count, 1, 1))
    if kind == "translate":
        result[:, :3, 3] = values
    elif kind == "scale":
        result[:, 0, 0], result[:, 1, 1], result[:, 2, 2] = values.T
    else:
        length = np.linalg.norm(values[:, :3], axis=1, keepdims=True)
        axis = np.divide(values[:, :3], length, out=np.zeros_like(values[:, :3]), where=length > 0.0)
        angle = np.radians(values[:, 3])
        cross = np.zeros((count, 3, 3))
        cross[:, 0, 1], cross[:, 0, 2], cross[:, 1, 2] = -axis[:, 2], axis[:, 1], -axis[:, 0]
        cross -= cross.transpose(0, 2, 1)
        sine, cosine = np.sin(angle)[:, None, None], np.cos(angle)[:, None, None]
        result[:, :3, :3] += sine * cross + (1.0 - cosine) * (cross @ cross)
    return result


def _inverse_bind(tree: ColladaTree, skin: Element | None, skeleton: Skeleton) -> dict[int, np.ndarray]:
    joints = child(skin, "joints")
    if joints is None:
        raise tree.fault("its skin has no <joints>")
    names = tree.words(tree.source(joints, "JOINT"), "the list of the skin's joints")
    matrices = tree.numbers(child(tree.source(joints, "INV_BIND_MATRIX"), "float_array"), "the list of bind matrices")
    if len(matrices) != 16 * len(names):
        raise tree.fault(f"has {len(names)} joints of the skin but {len(matrices)} numbers of bind matrices; it takes 16 for each")
    found = {}
    for name, matrix in zip(names, matrices.reshape(-1, 4, 4)):
        index = skeleton.index_of(name)
        if index is None:
            raise tree.fault(f"the skin hangs on a joint '{quoted(name)}' that is no bone of the skeleton")
        if abs(np.linalg.det(matrix)) < 1e-12:
            raise tree.fault(f"the bind matrix of bone '{quoted(name)}' cannot be inverted")
        found[index] = matrix
    return found


def _at_bind(skeleton: Skeleton, inverse_bind: dict[int, np.ndarray], unit: float) -> np.ndarray:
    """Rest is where the skin was bound to a bone, as in Gazebo; bones without skin rest where the file has them."""
    rest = skeleton.rest.copy()
    frames = np.empty_like(rest)
    for index, bone in enumerate(skeleton.bones):
        parent = frames[bone.parent] if bone.parent >= 0 else np.eye(4)
        if index in inverse_bind:
            frames[index] = np.linalg.inv(inverse_bind[index])
            rest[index] = np.linalg.solve(parent, frames[index])
        else:
            frames[index] = parent @ rest[index]
    rest[:, :3, 3] *= unit
    return rest
