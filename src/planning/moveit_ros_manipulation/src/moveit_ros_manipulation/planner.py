"""Plans how an object is picked up and put down: free motion, straight approach, gripper, straight retreat."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import motion
import numpy as np
from geometry_msgs.msg import PoseStamped
from moveit_core import convert
from moveit_core.errors import PlanningError
from moveit_msgs.msg import GripperTranslation, MoveItErrorCodes
from moveit_ros_planning.plan_execution import Segment
from trajectory_msgs.msg import JointTrajectory

_GRIPPER_TIME = 1.0  # s that a gripper gets when its posture has no times
_CLOSER = 1.0  # m that a hand may come closer to what it is to grip
Allow = Callable[[motion.AllowedCollisionMatrix], None]


@dataclass
class Task:
    """One way to pick or place. Poses are of ``link``, the parent link of the end effector.

    ``approach`` and ``retreat``: straight motions before and after; ``close`` the posture of the gripper between them,
    ``open``
    that before them. ``allow``: what may touch during approach and retreat.
    """

    group: str
    link: str
    hand: str
    target: motion.Pose
    approach: GripperTranslation
    retreat: GripperTranslation
    open: JointTrajectory
    close: JointTrajectory
    allow_approach: Allow
    allow_retreat: Allow
    #: changes a scene as gripping (or letting go) does
    change: Callable[[motion.PlanningScene], None]
    effect: Callable[[], bool]
    #: what may touch while the hand comes as close to the target as it can; None: it stays at ``target``
    allow_closer: Allow | None = None


@dataclass
class Settings:
    """Joint configurations tried per pose; step (m) of straight motions; a joint-space step above ``jump`` times the mean one
    ends them (0: none does)."""

    tries: int = 5
    step: float = 0.02
    jump: float = 2.0


@dataclass
class Outcome:
    """Segments, or why there are none; ``reached``: how many of a way's parts could be planned."""

    segments: list[Segment] = field(default_factory=list)
    code: int = MoveItErrorCodes.PLANNING_FAILED
    message: str = ""
    reached: int = -1


class Manipulation:
    """Plans tasks.

    :param free_motion: plans a motion to joint values: ``(scene, group, values, seconds) -> PlanResult``.
    """

    def __init__(
        self, free_motion: Callable, time_limit: float, cancelled: Callable[[], bool] = lambda: False, settings: Settings | None = None
    ):
        self._settings = settings or Settings()
        self._free_motion = free_motion
        self._end = time.monotonic() + time_limit
        self._cancelled = cancelled

    @property
    def left(self) -> float:
        """Wall seconds left."""
        return self._end - time.monotonic()

    def plan(self, scene: motion.PlanningScene, task: Task) -> Outcome:
        """Plan one task from the scene's state."""
        outcome = Outcome(message=f"'{task.link}' cannot get to where the object is to be gripped or put")
        for values in self._configurations(scene, task):
            if self.left <= 0 or self._cancelled():
                return outcome if outcome.reached >= 0 else self.ended()
            found = self._with_configuration(scene, task, values)
            if found.segments:
                return found
            if found.reached > outcome.reached:  # what stopped the most promising one is what is told
                outcome = found
        return outcome

    def ended(self) -> Outcome:
        """Why no more is tried: somebody said stop, or the time is over."""
        if self._cancelled():
            return Outcome(code=MoveItErrorCodes.PREEMPTED, message="stopped")
        return Outcome(code=MoveItErrorCodes.TIMED_OUT, message="the time for planning is over")

    def _configurations(self, scene, task: Task) -> Sequence[np.ndarray]:
        loose = self._loosened(scene, task.allow_approach)
        self._set_posture(loose, task.open)
        found = motion.ik(
            loose,
            task.group,
            task.target,
            link=task.link,
            seed=loose.state,
            avoid_collisions=True,
            timeout=min(0.5, max(0.05, self.left)),
            solutions=self._settings.tries,
        )
        return list(found.solutions) if found else []

    @staticmethod
    def _loosened(scene, allow: Allow) -> motion.PlanningScene:
        copy = scene.copy()
        matrix = copy.acm
        allow(matrix)
        copy.set_acm(matrix)
        return copy

    @staticmethod
    def _set_posture(scene, posture: JointTrajectory) -> None:
        if posture.points:
            state = scene.state
            state.set(clamped(scene.model, posture, -1))
            scene.set_state(state)

    def _with_configuration(self, scene, task: Task, values) -> Outcome:
        near = self._loosened(scene, task.allow_approach)
        self._set_posture(near, task.open)
        state = near.state
        state.set_group(task.group, values)
        if task.allow_closer is not None:
            state.set_group(task.group, self._closer(scene, task, state))
            values = state.get_group(task.group)
        approach = self._straight(near, task, state, task.approach, -1.0)
        if approach is None:
            return Outcome(message=f"the straight approach cannot be made for {task.approach.min_distance:.3f} m", reached=0)
        approach = approach.reversed()
        retreat = None
        if moves(task.retreat):
            retreat = self._retreat(scene, task, state)
            if retreat is None:
                return Outcome(message=f"the straight retreat cannot be made for {task.retreat.min_distance:.3f} m", reached=1)
        free = self._free_motion(scene, task.group, approach.positions[0], max(0.1, self.left))
        if not free:
            return Outcome(code=free.code, message=free.message, reached=2)
        return Outcome(self._segments(scene, task, free.trajectory, approach, retreat), MoveItErrorCodes.SUCCESS)

    def _retreat(self, scene, task: Task, state) -> motion.Trajectory | None:
        after = self._loosened(scene, task.allow_retreat)
        after.set_state(state)
        task.change(after)
        self._set_posture(after, task.close)
        held = after.state
        held.set_group(task.group, state.get_group(task.group))
        return self._straight(after, task, held, task.retreat, 1.0)

    def _closer(self, scene, task: Task, state) -> np.ndarray:
        """Joint values of the hand moved along the approach, to a step before it meets something."""
        assert task.allow_closer is not None  # asked for by tasks that have one
        near = self._loosened(scene, task.allow_closer)
        self._set_posture(near, task.open)
        rows = self._line(near, task, state, task.approach, _CLOSER)[0]
        return rows.positions[-2] if rows is not None and len(rows) > 1 else state.get_group(task.group)

    def _straight(self, scene, task: Task, state, move: GripperTranslation, sign: float) -> motion.Trajectory | None:
        """A straight motion of the hand from ``state``; None if not even the least distance can be gone."""
        distance = max(move.desired_distance, move.min_distance)
        if not moves(move) and distance <= 0:
            return motion.Trajectory(scene.model, task.group, state, np.array([state.get_group(task.group)]))
        trajectory, gone = self._line(scene, task, state, move, sign * distance)
        return trajectory if trajectory is not None and gone >= move.min_distance - 1e-6 else None

    def _line(self, scene, task: Task, state, move: GripperTranslation, distance: float) -> tuple[motion.Trajectory | None, float]:
        """The hand's motion along the direction of ``move`` (against it below zero), and the metres that it gets."""
        direction = move.direction.vector
        vector = np.array((direction.x, direction.y, direction.z), dtype=float)
        length = np.linalg.norm(vector)
        if length < 1e-9:
            return None, 0.0
        here = state.pose(task.link)
        frame = convert.strip(move.direction.header.frame_id)
        rotation = here if frame == task.link else scene.frame_pose(frame, state) if frame else motion.Pose.identity()
        step = motion.Pose(np.zeros(3), rotation.quaternion) * motion.Pose(vector / length * distance, motion.Pose.identity().quaternion)
        goal = motion.Pose(np.asarray(here.position) + np.asarray(step.position), here.quaternion)
        found = motion.cartesian_path(
            scene,
            task.group,
            [goal],
            link=task.link,
            start=state,
            max_step=self._settings.step,
            jump_threshold=self._settings.jump,
            avoid_collisions=True,
        )
        return found.trajectory, found.fraction * abs(distance)

    @staticmethod
    def _segments(scene, task: Task, free, approach, retreat) -> list[Segment]:
        segments = [Segment(free, "plan")]
        opening = gripper_motion(scene, scene.state, task.hand, task.open)
        if opening is not None:
            segments.append(Segment(opening, "pre_grasp", monitor=False))
        segments.append(Segment(timed(scene.model, approach), "approach", allowed=task.allow_approach))
        before = scene.state
        if task.open.points:
            before.set(clamped(scene.model, task.open, -1))
        closing = gripper_motion(scene, before, task.hand, task.close)
        if closing is not None:
            segments.append(Segment(closing, "grasp", monitor=False, effect=task.effect))
        else:
            segments[-1].effect = task.effect
        if retreat is not None:
            segments.append(Segment(timed(scene.model, retreat), "retreat", allowed=task.allow_retreat))
        return segments


def moves(move: GripperTranslation) -> bool:
    """Whether ``move`` has a distance and a direction."""
    direction = move.direction.vector
    return move.desired_distance > 0 and math.hypot(direction.x, direction.y, direction.z) > 1e-9


def check_motion(move: GripperTranslation, what: str) -> None:
    """:raises PlanningError: a number of ``move`` is not finite; the line begins with ``what`` it is."""
    direction = move.direction.vector
    if not np.isfinite((direction.x, direction.y, direction.z, move.desired_distance, move.min_distance)).all():
        raise PlanningError(MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS, f"{what} holds a number that is not finite")


def check_posture(model, posture: JointTrajectory, what: str) -> None:
    """:raises PlanningError: a joint of ``posture`` is none of ``model``'s, or a point does not fit the joints; ``what`` it is."""
    unknown = [name for name in posture.joint_names if not model.has_joint(name)]
    if unknown:
        raise PlanningError(
            MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS, f"{what} names joint '{unknown[0]}', which the robot '{model.name}' does not have"
        )
    for point in posture.points:
        if len(point.positions) != len(posture.joint_names) or np.isnan(point.positions).any():
            raise PlanningError(
                MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS,
                f"a point of {what} needs one number for each of its {len(posture.joint_names)} joints; it has: {list(point.positions)}",
            )


def timed(model, trajectory: motion.Trajectory) -> motion.Trajectory:
    """``trajectory`` with times, at a fifth of the speed of the robot ``model``: the hand is close to things."""
    if len(trajectory) < 2:
        return trajectory
    return motion.time_parameterize(model, trajectory, "iterative_parabolic", velocity_scaling=0.2, acceleration_scaling=0.2)


def clamped(model, posture: JointTrajectory, point: int) -> dict[str, float]:
    """Joint values of ``posture``'s ``point`` (index), inside ``model``'s limits: grippers are told to open or close as far as they can."""
    values = {}
    for name, value in zip(posture.joint_names, posture.points[point].positions):
        if not model.has_joint(name) or model.joint(name).mimic is not None or len(model.joint(name).variables) != 1:
            continue
        limit = model.joint(name).limits[0]
        values[name] = min(max(value, limit.min_position), limit.max_position) if limit.has_position else value
    return values


def gripper_motion(scene, before, hand: str, posture: JointTrajectory) -> motion.Trajectory | None:
    """The trajectory of the group ``hand`` by ``posture``, from the state ``before`` it in ``scene``; None when it moves nothing."""
    if not posture.points or not hand:
        return None
    model, group = scene.model, scene.model.group(hand)
    variables = list(group.variables)
    if not any(name in variables for name in posture.joint_names):
        return None
    state = before.copy()
    rows, times = [], [point.time_from_start.to_sec() for point in posture.points]
    if times[-1] <= 0.0:
        times = [_GRIPPER_TIME * (number + 1) / len(times) for number in range(len(times))]
    if times[0] > 0.0:
        rows, times = [state.get_group(hand)], [0.0, *times]
    for number in range(len(posture.points)):
        state.set({name: value for name, value in clamped(model, posture, number).items() if name in variables})
        rows.append(state.get_group(hand))
    return motion.Trajectory(model, hand, before, np.array(rows), times=np.array(times))


def hand_pose(scene, stamped: PoseStamped, default: str = "") -> motion.Pose:
    """A ``stamped`` pose in the model frame of ``scene``; ``default``: its frame where the header has none.

    :raises PlanningError: unknown frame or no orientation.
    """
    try:
        pose = convert.pose(stamped.pose, "a grasp or place", empty_is_identity=False)
        return convert.in_model_frame(scene, stamped.header.frame_id or default, pose)
    except motion.UnknownNameError as error:
        raise PlanningError(MoveItErrorCodes.FRAME_TRANSFORM_FAILURE, f"frame '{stamped.header.frame_id}': {error}") from error
    except ValueError as error:
        raise PlanningError(MoveItErrorCodes.INVALID_GOAL_CONSTRAINTS, str(error)) from error


def allowing(firsts: Sequence[str], seconds: Sequence[str]) -> Allow:
    """A change of a collision matrix: each of ``firsts`` may touch each of ``seconds``."""

    def change(matrix: motion.AllowedCollisionMatrix) -> None:
        for first in firsts:
            for second in seconds:
                if first != second:
                    matrix.set(first, second, True)

    return change
