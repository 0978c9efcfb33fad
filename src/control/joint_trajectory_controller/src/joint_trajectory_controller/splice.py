"""From trajectory messages to segments, joined to the motion that is running."""

from __future__ import annotations

import math
from collections.abc import Sequence

from controller_interface import one_line
from hardware_interface import ControlError

from ._sampler import has_passed, joining_time, turns_to_add
from .segment import Segment, State, active_index, point_segments
from .tolerances import JointTolerances

# error codes of FollowJointTrajectoryResult that a message can earn
INVALID_GOAL = -1
INVALID_JOINTS = -2
#: rad, m and their derivatives; beyond it the polynomials are no longer numbers
LARGEST = 1e12


class InvalidTrajectory(ControlError):
    """A message that cannot be executed; the running motion stays as it is.

    :ivar code: error code of FollowJointTrajectoryResult
    """

    def __init__(self, code: int, text: str):
        super().__init__(one_line(text))
        self.code = code


class Late(InvalidTrajectory):
    """All of the message lies in the past: whoever streams commands sends one now and then, which is no fault."""


def map_joints(names: Sequence[str], joints: Sequence[str], partial: bool) -> list[int]:
    """Index into ``joints`` of every name of a message.

    :param partial: whether fewer names than joints will do
    """
    missing = [joint for joint in joints if joint not in names]
    unknown = [name for name in names if name not in joints]
    repeated = sorted({name for name in names if names.count(name) > 1})
    if not names:
        problem = f"joint_names is empty, it must list {', '.join(joints)}"
    elif unknown:
        problem = f"unknown: {', '.join(unknown)}; this controller moves {', '.join(joints)}"
    elif repeated:
        problem = f"named more than once: {', '.join(repeated)}"
    elif missing and not partial:
        problem = f"missing: {', '.join(missing)}; name them all, or set the parameter allow_partial_joints_goal"
    else:
        return [joints.index(name) for name in names]
    raise InvalidTrajectory(INVALID_JOINTS, "Joints on incoming goal don't match the controller joints. " + problem)


class Command:
    """The way-points of a message, checked and turned into polynomials; what motion they will join is not known yet.

    :param message: JointTrajectory with at least one point
    :param columns: controller joint of each column of the message, as from map_joints
    :param elapsed: seconds from the start of the message to the earliest instant it can begin; older points are dropped
    :ivar surplus: how many values a point has more than joints are named; they are left out, as upstream does
    """

    def __init__(self, message, columns: Sequence[int], elapsed: float):
        points = message.points
        self.times = [point.time_from_start.to_sec() for point in points]
        check_times(self.times)
        self.first = self.first_after(elapsed)
        width = len(columns)
        length = max(len(points[self.first].positions), width)
        self.surplus = length - width
        for number, point in enumerate(points[self.first :], self.first):
            _check_point(number, point, width, length)
        self.states: dict[int, list[State]] = {}
        self.segments: dict[int, list[Segment]] = {}
        for column, joint in enumerate(columns):
            states = [_state(point, column) for point in points[self.first :]]
            self.states[joint] = states
            self.segments[joint] = point_segments(states, self.times[self.first :])

    def first_after(self, elapsed: float) -> int:
        """Index of the first point later than ``elapsed`` seconds after the start of the message."""
        for index, time in enumerate(self.times):
            if not has_passed(time, elapsed):
                return index
        raise Late(
            INVALID_GOAL,
            f"Dropping all {len(self.times)} trajectory points, as they occur before the current time. "
            f"Last point is {elapsed - self.times[-1]:.6f}s in the past; give points a time_from_start after the start "
            "of motion, and a header.stamp of 0 to start at once.",
        )


def check_times(times: Sequence[float]) -> None:
    """Refuse way-points whose ``times`` (s) are not in strictly increasing order.

    :raises InvalidTrajectory: one line
    """
    for index in range(1, len(times)):
        if times[index] <= times[index - 1]:
            raise InvalidTrajectory(
                INVALID_GOAL,
                "Trajectory message contains waypoints that are not strictly increasing in time: point "
                f"{index} at {times[index]:g} s follows {times[index - 1]:g} s",
            )


def _check_point(number: int, point, width: int, length: int) -> None:
    """:param width: number of joints named; ``length``: number of values that every point has"""
    if len(point.positions) != length:
        raise InvalidTrajectory(
            INVALID_GOAL,
            f"Point {number} has {len(point.positions)} positions for {width} joints; every point needs one position per joint",
        )
    for name, values in (("velocities", point.velocities), ("accelerations", point.accelerations)):
        if values and len(values) != length:
            raise InvalidTrajectory(INVALID_GOAL, f"Point {number} has {len(values)} {name} for {width} joints; give one per joint or none")
    for name, values in (("positions", point.positions), ("velocities", point.velocities), ("accelerations", point.accelerations)):
        wrong = next((value for value in values[:width] if not abs(value) <= LARGEST), None)
        if wrong is not None:
            raise InvalidTrajectory(
                INVALID_GOAL,
                f"Point {number} has {name} that are not finite numbers: {wrong}"
                if not math.isfinite(wrong)
                else f"Point {number} has {name} beyond {LARGEST:g}, which no joint can follow: {wrong:g}",
            )


def _state(point, column: int) -> State:
    return State(
        point.positions[column],
        point.velocities[column] if point.velocities else None,
        point.accelerations[column] if point.accelerations else None,
    )


def splice(
    current: Sequence[Sequence[Segment]],
    command: Command,
    start: float,
    uptime: float,
    next_uptime: float,
    continuous: Sequence[bool],
    tolerances: Sequence[JointTolerances],
    goal: object | None,
) -> list[list[Segment]]:
    """The running motion continued by ``command``. Uses ``command`` up.

    The old motion runs on to the joining instant; a bridge leads from its desired state there to the first way-point:
    the splice of ``tracking_law.h``.
    What is kept of it until then is whose it was: its tolerances are no reason to abort ``goal``, which has not begun.
    Joints that the command does not name keep their motion, which belongs to ``goal`` from now on.

    :param current: segments of every joint, the running motion
    :param start: start of the message in controller time, seconds
    :param uptime: controller time of the last update, seconds
    :param next_uptime: controller time of the next update, the earliest possible joining instant, seconds
    :param continuous: per joint, whether it turns without end and takes the short way
    :returns: segments of every joint
    """
    skip = command.first_after(next_uptime - start) - command.first
    join = joining_time(start, next_uptime)
    result = []
    for joint, segments in enumerate(current):
        active = max(active_index(segments, uptime), 0)
        states = command.states.get(joint)
        if states is None:
            result.append([segment.owned_by(goal) for segment in segments[active:]])
            continue
        last = max(active_index(segments, join), active)
        spliced = list(segments[active : last + 1])
        now = State(*segments[last].sample(join))
        target = states[skip]
        offset = turns_to_add(now.position, target.position) if continuous[joint] else 0.0
        target = target._replace(position=target.position + offset)
        spliced.append(Segment(join, now, start + command.times[command.first + skip], target, 0.0, goal, tolerances[joint]))
        spliced.extend(segment.moved(start, offset, goal, tolerances[joint]) for segment in command.segments[joint][skip:])
        result.append(spliced)
    return result
