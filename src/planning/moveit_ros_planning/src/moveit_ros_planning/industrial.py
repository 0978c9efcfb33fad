"""Requests for industrial motions, judged before they are planned: what Pilz's planner asks of a message, in its order, with its codes."""

from __future__ import annotations

from copy import deepcopy

import motion
from moveit_core import convert
from moveit_core.errors import PlanningError, one_line
from moveit_msgs.msg import Constraints, MotionPlanRequest, MoveItErrorCodes, RobotState
from shape_msgs.msg import SolidPrimitive

PLANNERS = ("CIRC", "LIN", "PTP")
_REST = 1e-8  # rad/s or m/s below which a joint stands still, as upstream
_BESIDE = 1e-6  # rad or m that rounding may put a joint beyond its limit


def prepared(
    message: MotionPlanRequest, scene: motion.PlanningScene, solved: bool
) -> tuple[MotionPlanRequest, motion.AuxiliaryPoint | None]:
    """The request ``message`` as its planner reads it, and the auxiliary point of a circle.

    Of a position constraint only its first primitive pose counts, whether or not there is a region about it; of a goal of joint values
    nothing else does.

    :param scene: in which it is planned.
    :param solved: kinematics.yaml gives the group a solver.
    :raises PlanningError: the request is refused.
    """
    if message.planner_id not in PLANNERS:
        raise PlanningError(
            MoveItErrorCodes.PLANNING_FAILED, f"there is no planner '{one_line(message.planner_id, 40)}' (there is: {', '.join(PLANNERS)})"
        )
    _check_scaling("velocity", message.max_velocity_scaling_factor)
    _check_scaling("acceleration", message.max_acceleration_scaling_factor)
    if not scene.model.has_group(message.group_name):
        raise PlanningError(
            MoveItErrorCodes.INVALID_GROUP_NAME,
            f"the robot '{scene.model.name}' has no group '{one_line(message.group_name, 40)}'; it has: "
            + (", ".join(scene.model.groups) or "none"),
        )
    _check_start(message.start_state, scene.model, message.group_name)
    message = deepcopy(message)
    goal = _goal(message, scene, solved)
    point = _auxiliary(message) if message.planner_id == "CIRC" else None
    if goal.joint_constraints and message.planner_id != "PTP":
        _check_joint_goal(message, goal, point, scene.model)
    return message, point


def _check_scaling(name: str, value: float) -> None:
    if not 0.0001 <= value <= 1.0:
        raise PlanningError(
            MoveItErrorCodes.INVALID_MOTION_PLAN, f"max_{name}_scaling_factor of an industrial motion must be in [0.0001, 1], not {value:g}"
        )


def _check_start(start: RobotState, model: motion.RobotModel, group: str) -> None:
    """What the message itself says; the present state is not asked."""
    joints = start.joint_state
    if len(joints.name) != len(joints.position):
        raise PlanningError(
            MoveItErrorCodes.INVALID_ROBOT_STATE, f"start state: {len(joints.name)} joint names and {len(joints.position)} positions"
        )
    moved = set(model.group(group).variables)
    for index, (name, position) in enumerate(zip(joints.name, joints.position)):
        if name not in moved:
            continue
        limits = model.variable_limits(name)
        if limits.has_position and not limits.min_position - _BESIDE <= position <= limits.max_position + _BESIDE:
            raise PlanningError(
                MoveItErrorCodes.INVALID_ROBOT_STATE,
                f"start state: joint '{name}' is at {position:.4g}, outside its limits {limits.min_position:.4g} to "
                f"{limits.max_position:.4g}",
            )
        if index < len(joints.velocity) and not abs(joints.velocity[index]) < _REST:
            raise PlanningError(
                MoveItErrorCodes.INVALID_ROBOT_STATE,
                f"start state: joint '{name}' moves with {joints.velocity[index]:.3g}; industrial motions begin at rest",
            )


def _refused_goal(why: str, code: int = MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS) -> PlanningError:
    return PlanningError(code, f"the goal of an industrial motion {why}")


def _goal(message: MotionPlanRequest, scene: motion.PlanningScene, solved: bool) -> Constraints:
    if len(message.goal_constraints) != 1:
        raise _refused_goal(f"is exactly one of goal_constraints: there are {len(message.goal_constraints)}")
    (goal,) = message.goal_constraints
    pose = len(goal.position_constraints) == 1 and len(goal.orientation_constraints) == 1
    if bool(goal.joint_constraints) == pose:
        raise _refused_goal(
            "is one of joint values, or one position and one orientation of a link: there are "
            f"{len(goal.joint_constraints)} joint_constraints, {len(goal.position_constraints)} position_constraints and "
            f"{len(goal.orientation_constraints)} orientation_constraints"
        )
    if not pose:
        _check_joints(goal, scene.model, message.group_name)
        goal.position_constraints, goal.orientation_constraints = [], []
        return goal
    position, turn = goal.position_constraints[0], goal.orientation_constraints[0]
    if not position.link_name or not turn.link_name or position.link_name != turn.link_name:
        raise _refused_goal(
            "names one link in its position and its orientation: they name "
            f"'{one_line(position.link_name, 40)}' and '{one_line(turn.link_name, 40)}'"
        )
    _check_link(position.link_name, scene, message.group_name, solved)
    region = position.constraint_region
    if not region.primitive_poses:
        raise _refused_goal("is where the first of primitive_poses is: there is none")
    region.primitive_poses, region.meshes, region.mesh_poses = region.primitive_poses[:1], [], []
    region.primitives = region.primitives[:1] or [SolidPrimitive(SolidPrimitive.SPHERE, [1e-4])]
    return goal


def _check_joints(goal: Constraints, model: motion.RobotModel, group: str) -> None:
    known = {*model.group(group).joints, *model.group(group).variables}
    for entry in goal.joint_constraints:
        if entry.joint_name not in known:
            raise _refused_goal(f"names joint '{one_line(entry.joint_name, 40)}', which group '{group}' does not have")
        if entry.joint_name not in model.variables:
            continue
        limits = model.variable_limits(entry.joint_name)
        if limits.has_position and not limits.min_position - _BESIDE <= entry.position <= limits.max_position + _BESIDE:
            raise _refused_goal(
                f"has joint '{entry.joint_name}' at {entry.position:.4g}, outside its limits {limits.min_position:.4g} to "
                f"{limits.max_position:.4g}"
            )


def _check_link(link: str, scene: motion.PlanningScene, group: str, solved: bool) -> None:
    model, state = scene.model, scene.state
    tip = model.group(group).tip_link
    if not solved:
        raise _refused_goal(
            f"is a pose, and group '{group}' has no kinematics solver: give it one in kinematics.yaml, or joint values as the goal",
            MoveItErrorCodes.NO_IK_SOLUTION,
        )
    known = tip and state.has_frame(link)  # of a link, or of what the robot holds
    if not known or model.rigidly_connected(state.frame_link(link)[0])[0] != model.rigidly_connected(tip)[0]:
        raise _refused_goal(
            f"is a pose of '{one_line(link, 40)}', which the solver of group '{group}' does not move: it moves "
            + (f"'{tip}', and what is fixed to it" if tip else "no single link, as the group is no chain"),
            MoveItErrorCodes.NO_IK_SOLUTION,
        )


def _auxiliary(message: MotionPlanRequest) -> motion.AuxiliaryPoint:
    """Taken out of the path constraints: it is no constraint."""
    given = message.path_constraints
    if given.name not in ("interim", "center"):
        raise PlanningError(
            MoveItErrorCodes.INVALID_MOTION_PLAN,
            "CIRC needs path constraints named 'interim' or 'center', whose "
            f"position constraint has its auxiliary point; these are named '{one_line(given.name, 40)}'",
        )
    poses = [pose for position in given.position_constraints for pose in position.constraint_region.primitive_poses]
    if len(given.position_constraints) != 1 or len(poses) != 1:
        raise PlanningError(
            MoveItErrorCodes.INVALID_MOTION_PLAN,
            f"the path constraints '{given.name}' of CIRC need one position "
            f"constraint with one of primitive_poses: there are {len(given.position_constraints)} with {len(poses)}",
        )
    position, at = given.position_constraints[0], poses[0].position
    given.position_constraints = []
    try:
        place = convert.finite((at.x, at.y, at.z), "the auxiliary point of CIRC")
    except ValueError as error:
        raise PlanningError(MoveItErrorCodes.INVALID_MOTION_PLAN, str(error)) from error
    return motion.AuxiliaryPoint(given.name, place, convert.strip(position.header.frame_id), position.link_name)


def _check_joint_goal(message: MotionPlanRequest, goal: Constraints, point: motion.AuxiliaryPoint | None, model: motion.RobotModel) -> None:
    if point is not None and not model.has_link(point.link):
        raise PlanningError(
            MoveItErrorCodes.INVALID_LINK_NAME,
            f"CIRC to joint values moves the link that its auxiliary point names: the robot has no link '{one_line(point.link, 40)}'",
        )
    wanted = len(model.group(message.group_name).active_joints)
    if len(goal.joint_constraints) != wanted:
        raise _refused_goal(
            f"has {len(goal.joint_constraints)} joint_constraints: {message.planner_id} needs all {wanted} joints of group "
            f"'{message.group_name}'"
        )
