"""A skin that hangs on bones, cut into one rigid piece for each bone: what draws and what collides need know nothing of bones.

A triangle belongs to the bone that has most of its weight, and to every other one that has much of it, so that pieces overlap and
no gap opens where a joint bends. Skins are bound to people with their arms stretched out: cut as they are, they would show horns at
the shoulders of all who let them hang. So the skin is first bent, smoothly, as an animation has the bones in the mean.
"""

from __future__ import annotations

import functools
from dataclasses import replace
from typing import Any
from xml.etree import ElementTree

import numpy as np

from ode_sim import collada_mesh
from ode_sim.actors.animation import Animation, animation_for
from ode_sim.actors.collada_tree import ColladaTree, Element, child, children, tag
from ode_sim.actors.quaternions import from_matrices, normalized, to_matrices
from ode_sim.actors.skeleton import Skeleton, read_skeleton, skin_of, told_in_one_line
from ode_sim.description.model import DescriptionError
from ode_sim.mesh import SKIN_PIECE, file_stamp
from ode_sim.mesh_files import MeshPart, check_triangles, usable

_BENT_BY = ", bent by "
_MUCH = 0.3  # of a triangle's weight, from which on it belongs to a bone too
_MOST_WEIGHTS = 5_000_000


def piece_name(bone: str, animation: str = "") -> str:
    """The submesh of a file that is the bone's piece. :param animation: a file by whose animation the skin is bent; '': as it was bound."""
    return SKIN_PIECE + bone + (_BENT_BY + animation if animation else "")


def load_pieces(path: str, animation: str = "") -> dict[str, list[MeshPart]]:
    """Pieces by the name of their bone; bones without skin have none. Lengths in metres.

    :param path: of the skin. :param animation: of the file that bends it, "" for none
    :raises DescriptionError: one line that names the file.
    """
    return _load(path, animation, file_stamp(path), file_stamp(animation) if animation else ())


def load_piece(path: str, submesh: str) -> list[MeshPart]:
    """The piece of the skin ``path`` that ``submesh`` means, see :func:`piece_name`.

    :raises DescriptionError: there is none.
    """
    bone, _, animation = submesh[len(SKIN_PIECE) :].partition(_BENT_BY)
    pieces = load_pieces(path, animation)
    if bone not in pieces:
        raise DescriptionError(f"mesh {path}: has no skin on a bone '{bone}'")
    return pieces[bone]


@functools.lru_cache(maxsize=16)
def _load(path: str, animation: str, _stamp: tuple[int, int], _other_stamp: tuple[int, ...]) -> dict[str, list[MeshPart]]:
    return told_in_one_line(path, lambda: _read(ColladaTree(path), animation))


def _read(tree: ColladaTree, bent_by: str) -> dict[str, list[MeshPart]]:
    skeleton = read_skeleton(tree)
    animation = animation_for(bent_by, skeleton) if bent_by else None
    controller, instance = skin_of(tree)
    skin = child(controller, "skin")
    assert skin is not None
    shape = tree.by_url(skin.get("source"), "geometry")
    if shape is None:
        raise tree.fault("its skin is of a shape that is not there")
    weights = _weights(tree, skin, skeleton)
    document = collada_mesh.document(_shapes_alone(tree))
    geometry = document.geometries[shape.get("id")]
    bind_shape = child(skin, "bind_shape_matrix")
    at_bind = tree.matrix(bind_shape, "the bind shape matrix") if bind_shape is not None else np.eye(4)
    materials = _materials(tree, instance, document)
    frames = _mean_frames(skeleton, animation)
    hangs = {bone: _scaled(frames[bone], 1.0 / tree.unit) @ inverse @ at_bind for bone, inverse in skeleton.inverse_bind.items()}
    pieces: dict[str, list[MeshPart]] = {}
    count = 0
    for primitive in geometry.primitives:
        for part, corners in collada_mesh.parts_of(primitive, geometry, materials.get(primitive.material), tree.path):
            own_weights = weights[_checked(tree, corners, len(weights))]
            for bone, piece in _cut(_bent(part, own_weights, hangs, tree.unit), own_weights).items():
                count += len(piece.triangles)
                check_triangles(count, tree.path)
                pieces.setdefault(skeleton.bones[bone].name, []).append(usable(_moved(piece, frames[bone]), tree.path))
    if not pieces:
        raise tree.fault("its skin has no triangles")
    return pieces


def _shapes_alone(tree: ColladaTree) -> bytes:
    """The file less what is not asked of the library that reads shapes and looks, which refuses much of it."""
    root = ElementTree.Element(tree.root.tag, tree.root.attrib)
    unwanted = ("library_animations", "library_controllers", "library_visual_scenes", "library_animation_clips", "scene")
    root.extend(entry for entry in tree.root if tag(entry) not in unwanted)
    return ElementTree.tostring(root)


def _checked(tree: ColladaTree, corners: np.ndarray, most: int) -> np.ndarray:
    if len(corners) and corners.max() >= most:
        raise tree.fault(f"its skin has weights of {most} corners; the shape has more")
    return corners


def _materials(tree: ColladaTree, instance: Element, document: Any) -> dict[str | None, Any]:
    """By the symbol under which the shape's triangles name them."""
    found = {}
    for bind in children(instance, "bind_material"):
        for entry in children(child(bind, "technique_common"), "instance_material"):
            name = (entry.get("target") or "").lstrip("#")
            found[entry.get("symbol")] = document.materials[name] if name in document.materials else None
    return found


def _weights(tree: ColladaTree, skin: Element, skeleton: Skeleton) -> np.ndarray:
    """(V, N): how much of each corner hangs on each bone; rows sum up to 1."""
    entry = child(skin, "vertex_weights")
    if entry is None:
        raise tree.fault("its skin has no <vertex_weights>")
    names = tree.words(tree.source(entry, "JOINT"), "the list of the skin's joints")
    values = tree.numbers(child(tree.source(entry, "WEIGHT"), "float_array"), "the list of weights")
    counts = tree.numbers(child(entry, "vcount"), "<vcount> of the skin").astype(int)
    offsets = {one.get("semantic"): int(one.get("offset") or 0) for one in children(entry, "input")}
    stride = max(offsets.values()) + 1
    table = tree.numbers(child(entry, "v"), "<v> of the skin").astype(int)
    if len(counts) * len(skeleton.bones) > _MOST_WEIGHTS * 10 or counts.sum() > _MOST_WEIGHTS:
        raise tree.fault("its skin has more weights than make sense")
    if (counts < 0).any() or len(table) != counts.sum() * stride:
        raise tree.fault("<vcount> and <v> of its skin do not fit together")
    table = table.reshape(-1, stride)
    joints, chosen = table[:, offsets["JOINT"]], table[:, offsets["WEIGHT"]]
    if (joints < -1).any() or (joints >= len(names)).any() or (chosen < 0).any() or (chosen >= len(values)).any():
        raise tree.fault("a weight of its skin refers to a joint or a number that is not there")
    bones = np.array([skeleton.index_of(name) for name in names])
    result = np.zeros((len(counts), len(skeleton.bones)))
    on_bone = joints >= 0  # -1 is the shape itself
    corners = np.repeat(np.arange(len(counts)), counts)
    np.add.at(result, (corners[on_bone], bones[joints[on_bone]]), np.abs(values[chosen[on_bone]]))
    first = min(skeleton.inverse_bind)
    result[result.sum(axis=1) <= 0.0, first] = 1.0
    return result / result.sum(axis=1, keepdims=True)


def _cut(part: MeshPart, weights: np.ndarray) -> dict[int, MeshPart]:
    """Pieces by the number of their bone. ``weights`` (V, N) are of the part's own corners."""
    of_triangle = weights[part.triangles].mean(axis=1)
    largest = weights[part.triangles].max(axis=1)
    main = of_triangle.argmax(axis=1)
    pieces = {}
    for bone in np.flatnonzero(largest.max(axis=0, initial=0.0) > 0.0):
        triangles = part.triangles[(main == bone) | (largest[:, bone] >= _MUCH)]
        if len(triangles) and (main == bone).any():
            used, inverse = np.unique(triangles, return_inverse=True)
            pieces[int(bone)] = replace(
                part,
                vertices=part.vertices[used],
                triangles=inverse.reshape(-1, 3),
                normals=None if part.normals is None else part.normals[used],
                uv=None if part.uv is None else part.uv[used],
            )
    return pieces


def _mean_frames(skeleton: Skeleton, animation: Animation | None) -> np.ndarray:
    """(N, 4, 4) of the bones in the skeleton's frame, in metres, rigid: turned as the animation has them in the mean, else as bound."""
    frames = skeleton.model_frames()
    frames[:, :3, :3] = to_matrices(from_matrices(frames[:, :3, :3]))
    if animation is None:
        return frames
    middle = animation.rotations[len(animation.times) // 2]
    side = np.where(np.sum(animation.rotations * middle, axis=-1, keepdims=True) < 0.0, -1.0, 1.0)
    turns = to_matrices(normalized((animation.rotations * side).sum(axis=0)))
    for index, bone in enumerate(skeleton.bones):
        if bone.parent < 0:
            continue
        local = np.eye(4)
        local[:3, 3] = skeleton.rest[index, :3, 3]
        local[:3, :3] = turns[index] if animation.moved[index] else to_matrices(from_matrices(skeleton.rest[index, :3, :3]))
        frames[index] = frames[bone.parent] @ local
    return frames


def _scaled(frame: np.ndarray, factor: float) -> np.ndarray:
    result = frame.copy()
    result[:3, 3] *= factor
    return result


def _bent(part: MeshPart, weights: np.ndarray, hangs: dict[int, np.ndarray], unit: float) -> MeshPart:
    """Each corner where its bones have it in the mean, in metres. :param hangs: from the file's frame to where the bone has it."""
    vertices = np.zeros_like(part.vertices)
    normals = None if part.normals is None else np.zeros_like(part.normals)
    flips = 0.0
    for bone, matrix in hangs.items():
        share = weights[:, bone]
        on_it = share > 0.0
        if not on_it.any():
            continue
        amount, linear = share[on_it, None], matrix[:3, :3]
        vertices[on_it] += amount * (part.vertices[on_it] @ linear.T + matrix[:3, 3])
        flips += np.sign(np.linalg.det(linear)) * share.sum()
        if normals is not None and part.normals is not None:
            normals[on_it] += amount * (part.normals[on_it] @ np.linalg.inv(linear))
    if normals is not None:
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = np.divide(normals, length, out=np.zeros_like(normals), where=length > 0.0)
    triangles = part.triangles[:, ::-1] if flips < 0.0 else part.triangles
    return replace(part, vertices=vertices * unit, triangles=triangles, normals=normals)


def _moved(part: MeshPart, frame: np.ndarray) -> MeshPart:
    """In the frame of its bone, which is rigid."""
    turn = frame[:3, :3]
    return replace(part, vertices=(part.vertices - frame[:3, 3]) @ turn, normals=None if part.normals is None else part.normals @ turn)
