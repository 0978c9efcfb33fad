"""Text files of scenes (``.scene``), as RViz and the warehouse tools of MoveIt write them.

A scene's name; then for each object ``* name``, its pose (a line of x y z, a line of the quaternion x y z w), the number of
shapes, for each of them its kind, size, pose and colour, and the number of subframes with their names and poses; a line ``.``
ends it. Files of before Noetic have neither object poses nor subframes. Metres.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from geometry_msgs.msg import Point, Pose, Quaternion
from moveit_msgs.msg import CollisionObject, ObjectColor, PlanningScene
from shape_msgs.msg import Mesh, MeshTriangle, Plane, SolidPrimitive
from std_msgs.msg import ColorRGBA

# kind: primitive type, and where in its dimensions the numbers of the file go
_KINDS = {
    "box": (SolidPrimitive.BOX, (0, 1, 2)),
    "sphere": (SolidPrimitive.SPHERE, (0,)),
    "cylinder": (SolidPrimitive.CYLINDER, (1, 0)),
    "cone": (SolidPrimitive.CONE, (1, 0)),
}
_NAMES = {kind: (name, order) for name, (kind, order) in _KINDS.items()}


def write(scene: PlanningScene) -> str:
    """The objects of a scene as text; all of them must be given in the scene's own frame."""
    colours = {entry.id: entry.color for entry in scene.object_colors}
    lines = [scene.name]
    for item in scene.world.collision_objects:
        colour = colours.get(item.id, ColorRGBA())
        shapes = [*_shape_lines(item)]
        lines += [f"* {item.id}", *_pose_lines(item.pose), str(len(shapes))]
        for shape, pose in shapes:
            lines += [*shape, *_pose_lines(pose), _numbers((colour.r, colour.g, colour.b, colour.a))]
        lines.append(str(len(item.subframe_names)))
        for name, pose in zip(item.subframe_names, item.subframe_poses):
            lines += [name, *_pose_lines(pose)]
    return "\n".join([*lines, "."]) + "\n"


def _numbers(values: Sequence[float]) -> str:
    return " ".join(f"{value:.9g}" for value in values)


def _pose_lines(pose: Pose) -> list[str]:
    at, turn = pose.position, pose.orientation
    rotation = (turn.x, turn.y, turn.z, turn.w)
    return [_numbers((at.x, at.y, at.z)), _numbers(rotation if any(rotation) else (0, 0, 0, 1))]


def _shape_lines(item: CollisionObject) -> Iterator[tuple[list[str], Pose]]:
    def pose(poses, index):
        return poses[index] if index < len(poses) else Pose()

    for index, shape in enumerate(item.primitives):
        name, order = _NAMES[shape.type]
        yield [name, _numbers([shape.dimensions[i] for i in order])], pose(item.primitive_poses, index)
    for index, mesh in enumerate(item.meshes):
        rows = [_numbers((v.x, v.y, v.z)) for v in mesh.vertices]
        rows += [" ".join(str(i) for i in triangle.vertex_indices) for triangle in mesh.triangles]
        yield ["mesh", f"{len(mesh.vertices)} {len(mesh.triangles)}", *rows], pose(item.mesh_poses, index)
    for index, plane in enumerate(item.planes):
        yield ["plane", _numbers(plane.coef)], pose(item.plane_poses, index)


def read(text: str, frame: str = "") -> PlanningScene:
    """A scene (a diff) with the objects of a text.

    :param frame: that the poses are given in.
    :raises ValueError: the text is no scene; the line is named.
    """
    reader = _Reader(text)
    scene = PlanningScene(name=reader.line().strip(), is_diff=True)
    scene.robot_state.is_diff = True
    new = reader.has_object_poses()
    while True:
        marker = reader.word("'*' or '.'")
        if marker == ".":
            return scene
        if marker != "*":
            raise reader.problem(f"'{marker[:20]}' stands where '* <object>' or the final '.' is expected")
        item = CollisionObject(id=reader.line().strip(), operation=CollisionObject.ADD)
        item.header.frame_id = frame
        item.pose = reader.pose() if new else Pose(orientation=Quaternion(w=1.0))
        colour = None
        for _ in range(reader.count("shapes")):
            _read_shape(reader, item)
            rgba = reader.floats(4, "a colour")
            colour = rgba if any(rgba) else colour
        for _ in range(reader.count("subframes") if new else 0):
            item.subframe_names.append(reader.word("a subframe's name"))
            item.subframe_poses.append(reader.pose())
        scene.world.collision_objects.append(item)
        if colour is not None:
            scene.object_colors.append(ObjectColor(item.id, ColorRGBA(*colour)))


def _read_shape(reader: _Reader, item: CollisionObject) -> None:
    kind = reader.word("a shape")
    if kind in _KINDS:
        number, order = _KINDS[kind]
        values = reader.floats(len(order), f"a {kind}")
        item.primitives.append(SolidPrimitive(number, [values[order.index(i)] for i in range(len(order))]))
        item.primitive_poses.append(reader.pose())
    elif kind == "plane":
        item.planes.append(Plane(reader.floats(4, "a plane")))
        item.plane_poses.append(reader.pose())
    elif kind == "mesh":
        vertices, triangles = reader.count("vertices"), reader.count("triangles")
        mesh = Mesh(vertices=[Point(*reader.floats(3, "a vertex")) for _ in range(vertices)])
        mesh.triangles = [
            MeshTriangle(tuple(reader.count("vertices of a triangle", vertices - 1) for _ in range(3))) for _ in range(triangles)
        ]
        item.meshes.append(mesh)
        item.mesh_poses.append(reader.pose())
    else:
        raise reader.problem(f"shape '{kind[:20]}' is unknown; there are box, sphere, cylinder, cone, plane and mesh")


class _Reader:
    """Words and lines of a text, one after the other."""

    def __init__(self, text: str):
        self._text, self._at = text, 0

    def problem(self, what: str) -> ValueError:
        return ValueError(f"line {self._text.count(chr(10), 0, self._at) + 1}: {what}")

    def line(self) -> str:
        """The rest of the line."""
        end = self._text.find("\n", self._at)
        end = len(self._text) if end < 0 else end
        line, self._at = self._text[self._at : end], min(end + 1, len(self._text))
        return line

    def word(self, what: str) -> str:
        """The next word."""
        start = self._at
        while start < len(self._text) and self._text[start].isspace():
            start += 1
        end = start
        while end < len(self._text) and not self._text[end].isspace():
            end += 1
        self._at = end
        if start == end:
            raise self.problem(f"the text ends where {what} is expected")
        return self._text[start:end]

    def floats(self, count: int, what: str) -> list[float]:
        words = [self.word(what) for _ in range(count)]
        try:
            values = [float(word) for word in words]
        except ValueError:
            values = [math.nan]
        if not all(math.isfinite(value) for value in values):
            raise self.problem(f"{what} is {count} numbers, not '{' '.join(words)[:60]}'")
        return values

    def count(self, what: str, most: int = 10_000_000) -> int:
        word = self.word(f"the number of {what}")
        if not word.isdigit() or int(word) > most:
            raise self.problem(f"the number of {what} is '{word[:20]}'")
        return int(word)

    def pose(self) -> Pose:
        at, turn = self.floats(3, "a position"), self.floats(4, "a quaternion")
        return Pose(Point(*at), Quaternion(*turn))

    def has_object_poses(self) -> bool:
        """Whether the first object has a pose: its line has several numbers."""
        lines = self._text[self._at :].splitlines()
        first = next((i for i, line in enumerate(lines) if line.startswith("*")), None)
        return first is None or first + 1 >= len(lines) or " " in lines[first + 1].strip()
