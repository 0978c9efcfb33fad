"""Poses, shapes and constraints: messages to and from the types of the ``motion`` library.

Lengths are metres, angles radians, quaternions x, y, z, w. What a message says wrongly raises ``ValueError`` with one
line.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence

import motion
import numpy as np
import rospy
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, Transform, Vector3
from moveit_msgs.msg import BoundingVolume, Constraints
from shape_msgs.msg import Mesh, MeshTriangle, Plane, SolidPrimitive

IDENTITY = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
_NAMES = {SolidPrimitive.BOX: "box", SolidPrimitive.SPHERE: "sphere", SolidPrimitive.CYLINDER: "cylinder", SolidPrimitive.CONE: "cone"}
_DIMENSIONS = {SolidPrimitive.BOX: 3, SolidPrimitive.SPHERE: 1, SolidPrimitive.CYLINDER: 2, SolidPrimitive.CONE: 2}


def strip(frame: str) -> str:
    """A frame name without the leading slash that old packages write."""
    return frame[1:] if frame.startswith("/") else frame


def finite(values: Iterable[float], what: str) -> tuple[float, ...]:
    """``values`` as a tuple.

    :raises ValueError: one of them is NaN or infinite; the line begins with ``what`` they are.
    """
    result = tuple(float(value) for value in values)
    if not all(math.isfinite(value) for value in result):
        raise ValueError(f"{what} holds a number that is not finite: {result}")
    return result


def pose(message, what: str = "the pose", empty_is_identity: bool = True) -> motion.Pose:
    """``message``, a geometry_msgs/Pose (or Transform), as a Pose; the quaternion is normalised, an empty one is no rotation.

    :param what: it is, for the error.
    :raises ValueError: not finite, or the quaternion is zero and ``empty_is_identity`` is False.
    """
    at = message.translation if isinstance(message, Transform) else message.position
    turn = message.rotation if isinstance(message, Transform) else message.orientation
    position = finite((at.x, at.y, at.z), f"the position of {what}")
    quaternion = finite((turn.x, turn.y, turn.z, turn.w), f"the orientation of {what}")
    length = math.sqrt(sum(value * value for value in quaternion))
    if length < 1e-9:
        if not empty_is_identity:
            raise ValueError(f"the orientation of {what} is all zeros, which is no rotation; w = 1 is none at all")
        return motion.Pose(np.array(position), np.array((0.0, 0.0, 0.0, 1.0)))
    return motion.Pose(np.array(position), np.array(quaternion) / length)


def pose_message(value) -> Pose:
    """``value``, any pair (position, quaternion), as a geometry_msgs/Pose."""
    position, quaternion = value[0], value[1]
    return Pose(Point(*(float(v) for v in position)), Quaternion(*(float(v) for v in quaternion)))


def transform_message(value) -> Transform:
    """``value``, any pair (position, quaternion), as a geometry_msgs/Transform."""
    return Transform(Vector3(*(float(v) for v in value[0])), Quaternion(*(float(v) for v in value[1])))


def pose_stamped(frame: str, value, stamp=None) -> PoseStamped:
    """A PoseStamped of ``value`` in ``frame``, with ``stamp`` if that is given."""
    message = PoseStamped(pose=pose_message(value))
    message.header.frame_id = frame
    if stamp is not None:
        message.header.stamp = stamp
    return message


def in_model_frame(scene, frame: str, value) -> motion.Pose:
    """``value``, given in ``frame``, in the model frame. "" is the model frame.

    :raises motion.UnknownNameError: the scene does not know the frame.
    """
    frame = strip(frame)
    if frame in ("", scene.frame):
        return motion.Pose(*value)
    return scene.frame_pose(frame) * motion.Pose(*value)


def primitive(message: SolidPrimitive):
    """``message``, a SolidPrimitive, as a shape.

    :raises ValueError: unknown type, too few or impossible dimensions.
    """
    if message.type not in _DIMENSIONS:
        raise ValueError(f"primitive type {message.type} is not one of BOX 1, SPHERE 2, CYLINDER 3, CONE 4")
    name, count = _NAMES[message.type], _DIMENSIONS[message.type]
    if len(message.dimensions) < count:
        raise ValueError(f"a {name} needs {count} dimensions, not {len(message.dimensions)}")
    size = finite(message.dimensions[:count], f"a {name}")
    if min(size) < 0:
        raise ValueError(f"a {name} has a negative dimension: {list(size)}")
    if message.type == SolidPrimitive.BOX:
        return motion.Box(*size)
    if message.type == SolidPrimitive.SPHERE:
        return motion.Sphere(size[0])
    height, radius = size
    return motion.Cylinder(radius, height) if message.type == SolidPrimitive.CYLINDER else motion.Cone(radius, height)


def mesh(message: Mesh):
    """``message``, a shape_msgs/Mesh, as a shape.

    :raises ValueError: empty, or a triangle names a vertex that is not there.
    """
    if not message.triangles or not message.vertices:
        raise ValueError(f"a mesh has {len(message.vertices)} vertices and {len(message.triangles)} triangles")
    vertices = np.array([(v.x, v.y, v.z) for v in message.vertices], dtype=float)
    triangles = np.array([tuple(t.vertex_indices) for t in message.triangles], dtype=np.int64)
    if not np.isfinite(vertices).all():
        raise ValueError("a mesh has a vertex that is not finite")
    if triangles.max() >= len(vertices):
        raise ValueError(f"a mesh has a triangle of vertex {triangles.max()}, but only {len(vertices)} vertices")
    return motion.Mesh(vertices, triangles)


def plane(message: Plane):
    """``message``, a shape_msgs/Plane, ax + by + cz + d = 0, as a shape. :raises ValueError: it has no normal."""
    coefficients = finite(message.coef, "a plane")
    if not any(coefficients[:3]):
        raise ValueError("a plane has the normal 0 0 0")
    return motion.Plane(*coefficients)


def shapes(message, owner: str) -> tuple[list, list[motion.Pose]]:
    """Shapes and their poses of ``message``, a CollisionObject or BoundingVolume: primitives first, then meshes, then planes.

    Missing poses are identities.

    :raises ValueError: a shape that cannot be, naming ``owner``.
    """
    found, poses = [], []
    for field, poses_field, make in (
        ("primitives", "primitive_poses", primitive),
        ("meshes", "mesh_poses", mesh),
        ("planes", "plane_poses", plane),
    ):
        given = getattr(message, poses_field, ())
        entries = getattr(message, field, ())
        if len(given) > len(entries):
            raise ValueError(f"{owner} has {len(given)} {poses_field} for {len(entries)} {field}")
        for index, entry in enumerate(entries):
            try:
                found.append(make(entry))
            except ValueError as error:
                raise ValueError(f"{owner}: {error}") from error
            poses.append(pose(given[index], owner) if index < len(given) else motion.Pose.identity())
    return found, poses


def fill_shapes(message, found: Sequence, poses: Sequence) -> None:
    """Append the shapes ``found`` and their ``poses`` to the fields of ``message``, a CollisionObject or BoundingVolume.

    Octrees have no message there.
    """
    for shape, where in zip(found, poses):
        if isinstance(shape, motion.Mesh):
            message.meshes.append(
                Mesh(
                    triangles=[MeshTriangle(tuple(int(i) for i in row)) for row in shape.triangles],
                    vertices=[Point(*map(float, row)) for row in shape.vertices],
                )
            )
            message.mesh_poses.append(pose_message(where))
        elif isinstance(shape, motion.Plane):
            message.planes.append(Plane([float(value) for value in shape.coefficients]))
            message.plane_poses.append(pose_message(where))
        elif not isinstance(shape, motion.OcTree):
            message.primitives.append(primitive_message(shape))
            message.primitive_poses.append(pose_message(where))


def primitive_message(shape) -> SolidPrimitive:
    """``shape``, a box, sphere, cylinder or cone, as a SolidPrimitive."""
    if isinstance(shape, motion.Box):
        return SolidPrimitive(SolidPrimitive.BOX, [float(edge) for edge in shape.size])
    if isinstance(shape, motion.Sphere):
        return SolidPrimitive(SolidPrimitive.SPHERE, [shape.radius])
    kind = SolidPrimitive.CYLINDER if isinstance(shape, motion.Cylinder) else SolidPrimitive.CONE
    return SolidPrimitive(kind, [shape.length, shape.radius])


def constraints(message: Constraints, scene) -> motion.Constraints:
    """A Constraints ``message``, as a planner takes it.

    :param scene: in which its frames are looked up, and the robot's joints and links.
    :raises ValueError: a constraint that cannot be used (unknown joint or link, no region, not finite).
    """
    result = motion.Constraints(name=message.name)
    result.joint = [_joint(entry, scene) for entry in message.joint_constraints]
    result.position = [_position(entry, scene) for entry in message.position_constraints]
    result.orientation = [_orientation(entry, scene) for entry in message.orientation_constraints]
    result.visibility = [_visibility(entry) for entry in message.visibility_constraints]
    return result


def path_constraints(message: Constraints, scene, warn: Callable[[str], None]) -> motion.Constraints:
    """Constraints of ``message`` that are to be kept all the way, as a planner takes them; ``scene`` as for :func:`constraints`.

    Position and orientation constraints without a link's name are left out, as MoveIt does; ``warn`` is told so.

    :raises ValueError: another one cannot be used.
    """
    usable = Constraints(message.name, message.joint_constraints, [], [], message.visibility_constraints)
    for field in ("position_constraints", "orientation_constraints"):
        given = getattr(message, field)
        setattr(usable, field, [entry for entry in given if entry.link_name])
        if len(getattr(usable, field)) < len(given):
            warn(f"path constraints: one of the {field} names no link and is left out; set its link_name")
    return constraints(usable, scene)


def _joint(message, scene) -> motion.JointConstraint:
    numbers = finite(
        (message.position, message.tolerance_above, message.tolerance_below), f"the constraint of joint '{message.joint_name}'"
    )
    if not scene.model.has_joint(message.joint_name) and message.joint_name not in scene.model.variables:
        raise ValueError(f"joint constraint of '{message.joint_name}': the robot has no joint of that name")
    if min(numbers[1:]) < 0:
        raise ValueError(f"joint constraint of '{message.joint_name}': tolerances are 0 or more, not {numbers[1:]}")
    return motion.JointConstraint(message.joint_name, numbers[0], above=numbers[1], below=numbers[2], weight=message.weight)


def _placed(region: BoundingVolume, what: str) -> BoundingVolume:
    """The shapes of ``region`` that have poses, and no pose more; a line says which are left out."""
    placed = BoundingVolume()
    for field, poses_field in (("primitives", "primitive_poses"), ("meshes", "mesh_poses")):
        entries, given = getattr(region, field), getattr(region, poses_field)
        both = min(len(entries), len(given))
        if len(entries) != len(given):
            rospy.logwarn("%s has %d %s and %d poses for them; the first %d are taken", what, len(entries), field, len(given), both)
        setattr(placed, field, entries[:both])
        setattr(placed, poses_field, given[:both])
    return placed


def _position(message, scene) -> motion.PositionConstraint:
    what = f"position constraint of link '{message.link_name}'"
    _check_link(message.link_name, scene, what)
    found, poses = shapes(_placed(message.constraint_region, what), what)
    if not found:
        raise ValueError(f"{what} has no region: give it a primitive and its pose")
    offset = message.target_point_offset
    frame = _frame(message.header.frame_id, scene, what)
    return motion.PositionConstraint(
        message.link_name,
        region=list(zip(found, poses)),
        offset=finite((offset.x, offset.y, offset.z), what),
        frame=frame,
        weight=message.weight,
    )


def _orientation(message, scene) -> motion.OrientationConstraint:
    what = f"orientation constraint of link '{message.link_name}'"
    _check_link(message.link_name, scene, what)
    turn = message.orientation
    quaternion = finite((turn.x, turn.y, turn.z, turn.w), what)
    length = math.sqrt(sum(value * value for value in quaternion))
    if length < 1e-3:
        raise ValueError(f"{what} has the quaternion 0 0 0 0, which is no orientation; w = 1 is no rotation")
    tolerance = finite((message.absolute_x_axis_tolerance, message.absolute_y_axis_tolerance, message.absolute_z_axis_tolerance), what)
    return motion.OrientationConstraint(
        message.link_name,
        tuple(value / length for value in quaternion),
        tolerance=tolerance,
        parameterization="rotation_vector" if message.parameterization == message.ROTATION_VECTOR else "euler",
        frame=_frame(message.header.frame_id, scene, what),
        weight=message.weight,
    )


def _visibility(message) -> motion.VisibilityConstraint:
    return motion.VisibilityConstraint(
        target_pose=pose(message.target_pose.pose, "a visibility target"),
        target_frame=strip(message.target_pose.header.frame_id),
        target_radius=message.target_radius,
        sensor_pose=pose(message.sensor_pose.pose, "a visibility sensor"),
        sensor_frame=strip(message.sensor_pose.header.frame_id),
        cone_sides=message.cone_sides,
        max_view_angle=message.max_view_angle,
        max_range_angle=message.max_range_angle,
        sensor_view={0: "z", 1: "y", 2: "x"}.get(message.sensor_view_direction, "z"),
        weight=message.weight,
    )


def _check_link(name: str, scene, what: str) -> None:
    if not name:
        raise ValueError(f"{what} names no link")
    if not scene.model.has_link(name) and not scene.knows_frame(name):
        raise ValueError(f"{what}: the robot has no link of that name")


def _frame(name: str, scene, what: str) -> str:
    frame = strip(name)
    if frame and frame != scene.frame and not scene.knows_frame(frame):
        raise ValueError(f"{what} is given in frame '{frame}', which neither the robot, the scene nor TF knows")
    return frame
