"""Robot states and trajectories: messages to and from the types of the ``motion`` library."""

from __future__ import annotations

from collections.abc import Callable

import motion
import numpy as np
import rospy
from moveit_msgs.msg import AttachedCollisionObject, CollisionObject, RobotState, RobotTrajectory
from object_recognition_msgs.msg import ObjectType
from sensor_msgs.msg import MultiDOFJointState
from trajectory_msgs.msg import JointTrajectoryPoint, MultiDOFJointTrajectoryPoint

from . import convert

#: variables of a joint with a whole pose
_FLOATING = ("trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w")


def is_empty(message: RobotState) -> bool:
    """True when ``message`` says nothing about joints or attached bodies (upstream's rule for "the current state")."""
    return not (
        message.joint_state.name
        or message.joint_state.position
        or message.multi_dof_joint_state.joint_names
        or message.attached_collision_objects
    )


def apply_robot_state(scene, state: motion.RobotState, message: RobotState, attach: Callable | None = None) -> None:
    """Merge a RobotState message into ``state``.

    Poses of floating and planar joints are given in the frame of ``multi_dof_joint_state``'s header, which ``scene`` (None: the robot's
    own frame alone) tells; as upstream, one that nobody knows is told of and taken for the robot's.

    :param attach: ``attach(state, AttachedCollisionObject)`` for the attached bodies of the message; None leaves them
        out.
    :raises ValueError: names and positions do not match, a joint is unknown, or a value is not finite.
    """
    joints = message.joint_state
    if len(joints.name) != len(joints.position):
        raise ValueError(f"a robot state has {len(joints.name)} joint names and {len(joints.position)} positions")
    known = set(state.model.variables)
    for name, value in zip(joints.name, convert.finite(joints.position, "a robot state")):
        if name not in known:
            raise ValueError(f"a robot state names joint '{name}', which the robot '{state.model.name}' does not have")
        state.set(name, value)
    multi = message.multi_dof_joint_state
    origin = _frame_of_joints(scene, state, multi)
    for name, transform in zip(multi.joint_names, multi.transforms):
        set_multi_dof(state, name, origin * convert.pose(transform, f"joint '{name}'"))
    if not message.is_diff:
        state.clear_attached()
    if attach is not None:
        for body in message.attached_collision_objects:
            attach(state, body)


def _frame_of_joints(scene, state: motion.RobotState, multi: MultiDOFJointState) -> motion.Pose:
    here = motion.Pose.identity()
    if not multi.joint_names or convert.strip(multi.header.frame_id) in ("", state.model.frame):
        return here
    try:
        if scene is not None:
            return convert.in_model_frame(scene, multi.header.frame_id, here)
    except motion.UnknownNameError:
        pass
    rospy.logwarn(
        "The transform for multi-dof joints was specified in frame '%s' but it was not possible to transform that to frame '%s'",
        multi.header.frame_id,
        state.model.frame,
    )
    return here


def set_multi_dof(state: motion.RobotState, joint: str, pose: motion.Pose) -> None:
    """Put the floating or planar ``joint`` of ``state`` at ``pose`` (of its child in its parent frame); other joints are left."""
    if not state.model.has_joint(joint):
        return
    kind = state.model.joint(joint).type
    if kind == "floating":
        for suffix, value in zip(_FLOATING, (*pose.position, *pose.quaternion)):
            state.set(f"{joint}/{suffix}", float(value))
    elif kind == "planar":
        x, y, z, w = pose.quaternion
        state.set(
            {
                f"{joint}/x": float(pose.position[0]),
                f"{joint}/y": float(pose.position[1]),
                f"{joint}/theta": float(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))),
            }
        )


def multi_dof_pose(state: motion.RobotState, joint: str) -> motion.Pose:
    """Pose of the floating or planar ``joint`` in ``state``, of its child in its parent frame."""
    values = [float(value) for value in state.get_joint(joint)]
    if state.model.joint(joint).type == "floating":
        return motion.Pose(np.array(values[:3]), np.array(values[3:]))
    x, y, theta = values
    return motion.Pose(np.array((x, y, 0.0)), np.array((0.0, 0.0, np.sin(theta / 2), np.cos(theta / 2))))


def _multi_dof_joints(model) -> list[str]:
    return [name for name in model.active_joints if model.joint(name).type in ("planar", "floating")]


def robot_state_message(state: motion.RobotState, attached: bool = True, velocities: bool = False) -> RobotState:
    """The whole ``state``: all one-variable joints by position, the others by transform.

    :param attached: with the attached bodies. :param velocities: with those of the one-variable joints, where they are known.
    """
    model, message = state.model, RobotState()
    message.joint_state.header.frame_id = message.multi_dof_joint_state.header.frame_id = model.frame
    names = one_variable_joints(model)
    index = [model.variable_index(name) for name in names]
    message.joint_state.name = names
    message.joint_state.position = state.positions[index].tolist()
    if velocities and state.velocities is not None:
        message.joint_state.velocity = state.velocities[index].tolist()
    for name in _multi_dof_joints(model):
        message.multi_dof_joint_state.joint_names.append(name)
        message.multi_dof_joint_state.transforms.append(convert.transform_message(multi_dof_pose(state, name)))
    if attached:
        message.attached_collision_objects = [attached_message(body) for body in state.attached]
    return message


def one_variable_joints(model) -> list[str]:
    """Revolute, continuous and prismatic joints, mimic ones too, in the model's order."""
    return [name for name in model.joints if model.joint(name).type in ("revolute", "continuous", "prismatic")]


def attached_message(body: motion.AttachedBody) -> AttachedCollisionObject:
    """An attached body as a message; its pose is in the frame of the link."""
    message = AttachedCollisionObject(link_name=body.link, touch_links=sorted(body.touch_links), weight=body.weight)
    if body.detach_posture is not None:
        message.detach_posture = body.detach_posture
    item = message.object
    item.header.frame_id, item.id, item.operation = body.link, body.id, CollisionObject.ADD
    item.pose = convert.pose_message(body.pose)
    convert.fill_shapes(item, body.shapes, body.shape_poses)
    fill_subframes(item, body.subframes)
    fill_type(item, body.type)
    return message


def fill_type(item: CollisionObject, kind: str | None) -> None:
    """Write ``kind``, the type that a scene keeps of an object, into ``item``; None changes nothing."""
    if kind:
        item.type = ObjectType(*kind.split("\t", 1))


def fill_subframes(item: CollisionObject, subframes) -> None:
    """Write ``subframes``, a dict name -> pose, into ``item``."""
    for name, where in sorted(subframes.items()):
        item.subframe_names.append(name)
        item.subframe_poses.append(convert.pose_message(where))


def trajectory_message(trajectory: motion.Trajectory | None) -> RobotTrajectory:
    """A trajectory as a message: joints in the order of the group, frame the model's, stamp 0. None gives an empty
    one."""
    message = RobotTrajectory()
    if trajectory is None or len(trajectory) == 0:
        return message
    model = trajectory.start.model
    single = [(i, name) for i, name in enumerate(trajectory.variables) if "/" not in name]
    multi = [name for name in model.group(trajectory.group).active_joints if model.joint(name).type in ("planar", "floating")]
    joints = message.joint_trajectory
    joints.header.frame_id = message.multi_dof_joint_trajectory.header.frame_id = model.frame
    joints.joint_names = [name for _, name in single]
    columns = [i for i, _ in single]
    times = trajectory.times if trajectory.times is not None else np.zeros(len(trajectory))
    stamps = [rospy.Duration.from_sec(float(t)) for t in times]
    if columns:
        positions, velocities, accelerations = (
            None if rows is None else np.asarray(rows)[:, columns].tolist()
            for rows in (trajectory.positions, trajectory.velocities, trajectory.accelerations)
        )
        for i, stamp in enumerate(stamps):
            joints.points.append(
                JointTrajectoryPoint(
                    positions=positions[i] if positions else [],
                    velocities=velocities[i] if velocities else [],
                    accelerations=accelerations[i] if accelerations else [],
                    time_from_start=stamp,
                )
            )
    if multi:
        message.multi_dof_joint_trajectory.joint_names = multi
        for i, stamp in enumerate(stamps):
            state = trajectory.state(i)
            message.multi_dof_joint_trajectory.points.append(
                MultiDOFJointTrajectoryPoint(
                    transforms=[convert.transform_message(multi_dof_pose(state, name)) for name in multi], time_from_start=stamp
                )
            )
    return message


def trajectory_from_message(model, group: str, reference: motion.RobotState, message: RobotTrajectory) -> motion.Trajectory:
    """A trajectory of ``group`` of ``model`` from ``message``; joints that it lacks stay as in ``reference``.

    :raises ValueError: points without the positions of all named joints, a joint that the group lacks, times that run
        back.
    """
    joints, multi = message.joint_trajectory, message.multi_dof_joint_trajectory
    variables = list(model.group(group).variables)
    unknown = [name for name in joints.joint_names if name not in variables]
    if unknown:
        raise ValueError(f"the trajectory moves joint '{unknown[0]}', which group '{group}' does not have")
    count = max(len(joints.points), len(multi.points))
    positions = np.tile(reference.get_group(group), (count, 1))
    velocities, accelerations = np.zeros_like(positions), np.zeros_like(positions)
    columns = [variables.index(name) for name in joints.joint_names]
    has_velocities = has_accelerations = bool(joints.points)
    times = np.zeros(count)
    for i, point in enumerate(joints.points):
        if len(point.positions) != len(columns):
            raise ValueError(f"point {i} of the trajectory has {len(point.positions)} positions for {len(columns)} joints")
        positions[i, columns] = convert.finite(point.positions, f"point {i} of the trajectory")
        times[i] = point.time_from_start.to_sec()
        has_velocities = has_velocities and len(point.velocities) == len(columns)
        has_accelerations = has_accelerations and len(point.accelerations) == len(columns)
        if has_velocities:
            velocities[i, columns] = point.velocities
        if has_accelerations:
            accelerations[i, columns] = point.accelerations
    scratch = reference.copy()
    for i, point in enumerate(multi.points):
        times[i] = point.time_from_start.to_sec()
        for name, transform in zip(multi.joint_names, point.transforms):
            set_multi_dof(scratch, name, convert.pose(transform, f"joint '{name}'"))
            for variable in model.joint(name).variables:
                positions[i, variables.index(variable)] = scratch.get(variable)
    if count and (np.diff(times) < 0).any():
        raise ValueError("the times of the trajectory's points run backwards")
    start = reference.copy()
    if count:
        start.set_group(group, positions[0])
    return motion.Trajectory(
        model,
        group,
        start,
        positions,
        times=times,
        velocities=velocities if has_velocities else None,
        accelerations=accelerations if has_accelerations else None,
    )
