"""Planning scenes: messages to and from ``motion.PlanningScene``, with upstream's rules for objects, attached bodies
and diffs."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import motion
from geometry_msgs.msg import TransformStamped
from moveit_msgs.msg import (
    AllowedCollisionEntry,
    AllowedCollisionMatrix,
    AttachedCollisionObject,
    CollisionObject,
    LinkPadding,
    LinkScale,
    ObjectColor,
    PlanningScene,
    PlanningSceneComponents,
)
from octomap_msgs.msg import Octomap, OctomapWithPose
from std_msgs.msg import ColorRGBA

from . import convert, states

OCTOMAP = "<octomap>"
UNNAMED = "(noname)"


def _nothing(_message: str) -> None:
    pass


class SceneEditor:
    """Writes messages into a scene. What cannot be done is told to ``warn`` in one line, and the method returns False.

    Nothing is changed by a message that is refused. The caller keeps other threads away from the scene.
    """

    def __init__(self, scene: motion.PlanningScene, warn: Callable[[str], None] = _nothing):
        self._scene = scene
        self._warn = warn

    # --- objects of the world ---

    def collision_object(self, message: CollisionObject) -> bool:
        """ADD, APPEND, MOVE or REMOVE the object of the world that ``message`` names."""
        try:
            return self._collision_object(message)
        except (ValueError, motion.MotionError) as error:
            text, name = str(error), f"object '{message.id}'"
            self._warn(text if name in text else f"{name}: {text}")
            return False

    def _collision_object(self, message: CollisionObject) -> bool:
        _refuse_octomap(message.id)
        if message.operation == CollisionObject.REMOVE:
            return self._remove(message.id)
        if message.operation == CollisionObject.MOVE:
            return self._move(message)
        if message.operation not in (CollisionObject.ADD, CollisionObject.APPEND):
            raise ValueError(f"operation {message.operation} is not one of ADD 0, REMOVE 1, APPEND 2, MOVE 3")
        shapes, poses, pose, subframes = self._parts(message)
        if not message.id:
            raise ValueError("an object needs a name (id)")
        where = convert.in_model_frame(self._scene, message.header.frame_id, pose)
        if message.operation == CollisionObject.ADD or message.id not in self._scene.objects:
            self._scene.add_object(message.id, shapes, poses, pose=where, subframes=subframes, type=_type(message) or None)
        else:
            inverse = self._scene.object(message.id).pose.inverse() * where
            self._scene.append_shapes(message.id, shapes, [inverse * one for one in poses])
        return True

    def _parts(self, message: CollisionObject, shape_wanted: bool = True):
        shapes, poses = convert.shapes(message, f"object '{message.id}'")
        if shape_wanted and not shapes:
            raise ValueError("it has no shape: give it primitives, meshes or planes")
        pose = convert.pose(message.pose, f"object '{message.id}'")
        if len(shapes) == 1 and _is_zero(message.pose):  # messages of older clients: the pose is that of the only shape
            pose, poses = poses[0], [motion.Pose.identity()]
        if len(message.subframe_names) != len(message.subframe_poses):
            raise ValueError(f"it has {len(message.subframe_names)} subframe_names and {len(message.subframe_poses)} subframe_poses")
        subframes = {name: convert.pose(one, f"subframe '{name}'") for name, one in zip(message.subframe_names, message.subframe_poses)}
        return shapes, poses, pose, subframes

    def _remove(self, name: str) -> bool:
        gone = [name] if name else list(self._scene.objects)
        if not name:
            self._scene.clear_objects()
        elif not self._scene.remove_object(name):
            raise ValueError(f"it is not in the scene and cannot be removed; there are: {_list(self._scene.objects)}")
        for each in gone:
            self._scene.forget(each)
        return True

    def _move(self, message: CollisionObject) -> bool:
        if message.id not in self._scene.objects:
            raise ValueError(f"it is not in the scene and cannot be moved; there are: {_list(self._scene.objects)}")
        if message.primitives or message.meshes or message.planes:
            self._warn(f"object '{message.id}': a MOVE message carries shapes, which are ignored")
        given = [
            convert.pose(one, f"object '{message.id}'") for one in (*message.primitive_poses, *message.mesh_poses, *message.plane_poses)
        ]
        present = self._scene.object(message.id)
        pose = convert.pose(message.pose, f"object '{message.id}'")
        if len(given) == 1 and len(present.shapes) == 1 and _is_zero(message.pose):
            pose, given = given[0], []
        elif given and len(given) != len(present.shapes):
            raise ValueError(f"the message has {len(given)} shape poses, the object {len(present.shapes)} shapes")
        self._scene.move_object(message.id, convert.in_model_frame(self._scene, message.header.frame_id, pose))
        if given:
            self._scene.move_shapes(message.id, given)
        return True

    # --- attached bodies ---

    def attached_object(self, message: AttachedCollisionObject) -> bool:
        """Attach the object of ``message`` to a link, or detach it; what is detached returns to the world."""
        try:
            operation = message.object.operation
            if operation in (CollisionObject.ADD, CollisionObject.APPEND):
                self._attach(message)
            elif operation == CollisionObject.REMOVE:
                self._detach(message)
            else:
                raise ValueError(f"operation {operation} is not for attached objects: ADD 0, REMOVE 1 or APPEND 2")
            return True
        except (ValueError, motion.MotionError) as error:
            self._warn(f"attached object '{message.object.id}': {error}")
            return False

    def _attach(self, message: AttachedCollisionObject) -> None:
        model, name = self._scene.model, message.object.id
        if not model.has_link(message.link_name):
            raise ValueError(f"the robot '{model.name}' has no link '{message.link_name}' to attach it to")
        if not name:
            raise ValueError("an attached object needs a name (id)")
        _refuse_octomap(name)
        state = self._scene.state
        present = {body.id: body for body in state.attached}
        if message.object.operation == CollisionObject.ADD and not _has_shapes(message.object):
            if name not in self._scene.objects:
                raise ValueError(f"the message has no shape and the scene no such object; there are: {_list(self._scene.objects)}")
            self._attach_from_world(message)
            return
        body = attached_body(self._scene, state, message)
        if message.object.operation == CollisionObject.APPEND and name in present:
            body = _joined(present[name], body)
        if name in present:
            state.detach(name)
        state.attach(body)
        self._scene.remove_object(name)
        self._scene.set_state(state)

    def _attach_from_world(self, message: AttachedCollisionObject) -> None:
        item = self._scene.object(message.object.id)
        state = self._scene.state
        body = motion.AttachedBody(
            item.id,
            message.link_name,
            item.shapes,
            item.shape_poses,
            pose=state.pose(message.link_name).inverse() * item.pose,
            touch_links=_touch(message),
            subframes={**item.subframes},
            detach_posture=_posture(message),
            weight=message.weight,
            type=_type(message.object) or item.type or "",
        )
        if any(present.id == item.id for present in state.attached):
            state.detach(item.id)
        state.attach(body)
        self._scene.remove_object(item.id)
        self._scene.set_state(state)

    def _detach(self, message: AttachedCollisionObject) -> None:
        name, link = message.object.id, message.link_name
        if link and not self._scene.model.has_link(link):
            raise ValueError(f"the robot '{self._scene.model.name}' has no link '{link}' to detach it from")
        bodies = [body for body in self._scene.state.attached if (not link or body.link == link) and (not name or body.id == name)]
        if name and not bodies:
            held = {body.id: body.link for body in self._scene.state.attached}
            if name in held:
                raise ValueError(f"it is attached to link '{held[name]}', not to '{link}'")
            raise ValueError(f"it is not attached; attached are: {_list(held)}")
        for body in bodies:
            if body.id in self._scene.objects:
                self._warn(f"object '{body.id}' is in the world already: the attached one of that name is dropped")
                state = self._scene.state
                state.detach(body.id)
                self._scene.set_state(state)
            else:
                self._scene.detach_object(body.id)

    # --- whole scenes ---

    def planning_scene(self, message: PlanningScene) -> bool:
        """Apply ``message``: a diff changes what it names, any other replaces everything."""
        good = True
        if not message.is_diff:
            self._clear(message)
        elif message.name:
            self._scene.name = message.name
        good = self._robot_name(message.robot_model_name)
        try:
            self._settings(message)
        except (ValueError, motion.MotionError) as error:
            self._warn(f"planning scene: {error}")
            good = False
        if not states.is_empty(message.robot_state):
            good = self.robot_state(message.robot_state) and good
        for item in message.world.collision_objects:
            good = self.collision_object(item) and good
        return self.octomap(message.world.octomap) and good

    def _clear(self, message: PlanningScene) -> None:
        self._scene.name = message.name or UNNAMED
        self._scene.clear_objects()
        self._scene.set_octomap(None)
        state = self._scene.state
        state.clear_attached()
        self._scene.set_state(state)
        for frame in list(self._scene.transforms):
            self._scene.remove_transform(frame)
        for name in list(self._scene.colors):
            self._scene.remove_color(name)
        self._scene.set_acm(motion.AllowedCollisionMatrix.from_matrix([], []))

    def _robot_name(self, name: str) -> bool:
        if name and name != self._scene.model.name:
            self._warn(f"the planning scene is for robot '{name}', but '{self._scene.model.name}' is loaded here")
        return True

    def _settings(self, message: PlanningScene) -> None:
        for transform in message.fixed_frame_transforms:  # upstream's quirk: the header names the frame
            if convert.strip(transform.child_frame_id) != self._scene.frame:
                self._warn(
                    f"Given transform is to frame '{transform.child_frame_id}', but frame '{self._scene.frame}' was expected: left out"
                )
                continue
            pose = convert.pose(transform.transform, f"frame '{transform.header.frame_id}'")
            self._scene.set_transform(convert.strip(transform.header.frame_id), pose)
        matrix = message.allowed_collision_matrix
        if matrix.entry_names or (not message.is_diff and matrix.default_entry_names):
            self._scene.set_acm(acm_from_message(matrix))
        if message.link_padding:
            self._scene.set_padding({entry.link_name: float(entry.padding) for entry in message.link_padding})
        if message.link_scale:
            self._scene.set_scale({entry.link_name: float(entry.scale) for entry in message.link_scale})
        for entry in message.object_colors:
            colour = entry.color
            self._scene.set_color(entry.id, (colour.r, colour.g, colour.b, colour.a))

    def robot_state(self, message) -> bool:
        """Joint values and attached bodies of a RobotState message, merged into the scene's state."""
        state = self._scene.state
        try:
            states.apply_robot_state(self._scene, state, message)
        except (ValueError, motion.MotionError) as error:
            self._warn(f"robot state: {error}")
            return False
        held = [body.id for body in self._scene.state.attached]
        self._scene.set_state(state)
        good = True
        for body in message.attached_collision_objects:
            good = self.attached_object(body) and good
        for name in held:
            self._scene.forget(name)
        return good

    def octomap(self, message: OctomapWithPose) -> bool:
        """Replace the octomap, if the message has one; with a type and no data it takes the one there is away."""
        if not message.octomap.id and not message.octomap.data:
            return True
        if not message.octomap.data:
            self._scene.set_octomap(None)
            return True
        try:
            if message.octomap.id != "OcTree":
                raise ValueError(f"type '{message.octomap.id}' is unknown; OcTree is expected")
            frame = message.header.frame_id or message.octomap.header.frame_id
            where = convert.in_model_frame(self._scene, frame, convert.pose(message.origin, "the octomap"))
            data = bytes(value & 0xFF for value in message.octomap.data)
            tree = motion.OcTree.from_message_data(data, message.octomap.resolution, message.octomap.binary, message.octomap.id)
            self._scene.set_octomap(tree, where)
            return True
        except (ValueError, motion.MotionError) as error:
            self._warn(f"octomap: {error}")
            return False


def attached_body(scene, state, message: AttachedCollisionObject) -> motion.AttachedBody:
    """The body that ``message``, with shapes, describes, placed as ``state`` has the link; its frame is looked up in ``scene``.

    :raises ValueError: impossible shapes, or a frame that nobody knows.
    """
    editor = SceneEditor(scene)
    shapes, poses, pose, subframes = editor._parts(message.object)
    frame = convert.strip(message.object.header.frame_id)
    if frame == message.link_name:
        in_link = motion.Pose(*pose)
    else:
        in_model = motion.Pose(*pose) if frame in ("", scene.frame) else scene.frame_pose(frame, state) * motion.Pose(*pose)
        in_link = state.pose(message.link_name).inverse() * in_model
    return motion.AttachedBody(
        message.object.id,
        message.link_name,
        shapes,
        poses,
        pose=in_link,
        touch_links=_touch(message),
        subframes=subframes,
        detach_posture=_posture(message),
        weight=message.weight,
        type=_type(message.object),
    )


def attach_to_state(scene) -> Callable:
    """A function ``f(state, AttachedCollisionObject)`` for :func:`states.apply_robot_state`: bodies of a request's
    state in ``scene``.
    """

    def attach(state, message: AttachedCollisionObject) -> None:
        present = {body.id for body in state.attached}
        if message.object.operation == CollisionObject.REMOVE:
            for body in list(state.attached):
                if message.object.id in ("", body.id) and message.link_name in ("", body.link):
                    state.detach(body.id)
            return
        if not scene.model.has_link(message.link_name):
            raise ValueError(f"attached object '{message.object.id}': the robot has no link '{message.link_name}'")
        _refuse_octomap(message.object.id)
        if message.object.id in present:
            state.detach(message.object.id)
        state.attach(attached_body(scene, state, message))

    return attach


def _joined(old: motion.AttachedBody, new: motion.AttachedBody) -> motion.AttachedBody:
    """``old`` with the shapes of ``new`` added."""
    shift = old.pose.inverse() * new.pose
    return motion.AttachedBody(
        old.id,
        old.link,
        [*old.shapes, *new.shapes],
        [*old.shape_poses, *(shift * pose for pose in new.shape_poses)],
        pose=old.pose,
        touch_links=sorted({*old.touch_links, *new.touch_links}),
        subframes={**old.subframes, **new.subframes},
        detach_posture=new.detach_posture or old.detach_posture,
        weight=new.weight,
        type=new.type or old.type,
    )


def _refuse_octomap(name: str) -> None:
    if name == OCTOMAP:
        raise ValueError(f"the name {OCTOMAP} is kept for the octomap, which comes through the octomap of a planning scene")


def _type(message: CollisionObject) -> str:
    """The type of an object as the scene keeps it; "" if it has none."""
    return "\t".join((message.type.key, message.type.db)) if message.type.key or message.type.db else ""


def _touch(message: AttachedCollisionObject) -> list[str]:
    return sorted({*message.touch_links, message.link_name})


def _posture(message: AttachedCollisionObject):
    return message.detach_posture if message.detach_posture.joint_names else None


def _has_shapes(message: CollisionObject) -> bool:
    return bool(message.primitives or message.meshes or message.planes)


def _is_zero(pose) -> bool:
    """As a message comes into being: nobody has set it. One without rotation has w = 1."""
    at, turn = pose.position, pose.orientation
    return (at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w) == (0, 0, 0, 0, 0, 0, 0)


def _list(names: Iterable[str]) -> str:
    known = sorted(names)
    return ", ".join(known[:8]) + (f" and {len(known) - 8} more" if len(known) > 8 else "") if known else "none"


# --- to messages ---


def acm_from_message(message: AllowedCollisionMatrix) -> motion.AllowedCollisionMatrix:
    """An AllowedCollisionMatrix message as a matrix.

    :raises ValueError: rows and names do not match.
    """
    count = len(message.entry_names)
    if len(message.entry_values) != count or any(len(row.enabled) != count for row in message.entry_values):
        raise ValueError(f"the allowed collision matrix has {count} names, so it needs {count} rows of {count} values")
    defaults = {name: bool(value) for name, value in zip(message.default_entry_names, message.default_entry_values)}
    # the entry of a pair is that of the upper half, as upstream reads it
    rows = [[bool(message.entry_values[min(i, j)].enabled[max(i, j)]) for j in range(count)] for i in range(count)]
    return motion.AllowedCollisionMatrix.from_matrix(list(message.entry_names), rows, defaults)


def acm_message(matrix: motion.AllowedCollisionMatrix) -> AllowedCollisionMatrix:
    """A matrix as a message."""
    names, rows = matrix.matrix()
    defaults = matrix.defaults
    if defaults:  # a pair without an entry of its own has what its defaults say: in a message every pair has an entry
        rows = [[matrix.allowed(a, b) if i != j else rows[i][j] for j, b in enumerate(names)] for i, a in enumerate(names)]
    return AllowedCollisionMatrix(
        entry_names=list(names),
        entry_values=[AllowedCollisionEntry([bool(value) for value in row]) for row in rows],
        default_entry_names=sorted(defaults),
        default_entry_values=[bool(defaults[name]) for name in sorted(defaults)],
    )


def object_message(scene, name: str, geometry: bool = True) -> CollisionObject:
    """The object ``name`` of ``scene``'s world as an ADD message in the model frame; without ``geometry`` its name and type alone."""
    item = scene.object(name)
    message = CollisionObject(id=name, operation=CollisionObject.ADD)
    message.header.frame_id = scene.frame
    states.fill_type(message, item.type)
    if geometry:
        message.pose = convert.pose_message(item.pose)
        convert.fill_shapes(message, item.shapes, item.shape_poses)
        states.fill_subframes(message, item.subframes)
    return message


def octomap_message(scene) -> OctomapWithPose:
    """The octomap of the scene; empty if there is none."""
    message = OctomapWithPose()
    if scene.octomap is None:
        return message
    message.header.frame_id = message.octomap.header.frame_id = scene.frame
    message.origin = convert.pose_message(scene.octomap_pose)
    data = scene.octomap.message_data(True)
    message.octomap = Octomap(
        binary=True, id="OcTree", resolution=scene.octomap.resolution, data=[value - 256 if value > 127 else value for value in data]
    )
    message.octomap.header.frame_id = scene.frame
    return message


def colour_messages(scene) -> list[ObjectColor]:
    """Colours that were given to objects of ``scene``."""
    return [ObjectColor(name, ColorRGBA(*(float(v) for v in rgba))) for name, rgba in sorted(scene.colors.items())]


def transform_messages(scene) -> list[TransformStamped]:
    """Frames that ``scene`` knows from outside, in upstream's (reversed) notation."""
    messages = []
    for frame, pose in sorted(scene.transforms.items()):
        message = TransformStamped(child_frame_id=scene.frame, transform=convert.transform_message(pose))
        message.header.frame_id = frame
        messages.append(message)
    return messages


def scene_message(scene, components: int | None = None) -> PlanningScene:
    """The scene as a message.

    :param components: bits of PlanningSceneComponents; None or 0 asks for everything.
    """
    bits = components or 0xFFFF
    want = PlanningSceneComponents
    message = PlanningScene(name=scene.name, robot_model_name=scene.model.name, is_diff=False)
    if not bits & want.SCENE_SETTINGS:
        message.name = message.robot_model_name = ""
    if bits & want.ROBOT_STATE_ATTACHED_OBJECTS:
        message.robot_state = states.robot_state_message(scene.state)
    elif bits & want.ROBOT_STATE:
        message.robot_state = states.robot_state_message(scene.state, attached=False)
    if bits & want.TRANSFORMS:
        message.fixed_frame_transforms = transform_messages(scene)
    if bits & want.ALLOWED_COLLISION_MATRIX:
        message.allowed_collision_matrix = acm_message(scene.acm)
    if bits & want.LINK_PADDING_AND_SCALING:
        message.link_padding = [LinkPadding(name, value) for name, value in sorted(scene.padding.items())]
        message.link_scale = [LinkScale(name, value) for name, value in sorted(scene.scale.items())]
    if bits & want.OBJECT_COLORS:
        message.object_colors = colour_messages(scene)
    if bits & (want.WORLD_OBJECT_GEOMETRY | want.WORLD_OBJECT_NAMES):
        geometry = bool(bits & want.WORLD_OBJECT_GEOMETRY)
        message.world.collision_objects = [object_message(scene, name, geometry) for name in sorted(scene.objects) if name != OCTOMAP]
    if bits & want.OCTOMAP:
        message.world.octomap = octomap_message(scene)
    return message
