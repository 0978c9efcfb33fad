"""The joint trajectory controller; what it writes to the hardware is left to its variants."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import rospy
from control_msgs.msg import (
    FollowJointTrajectoryAction,
    FollowJointTrajectoryFeedback,
    FollowJointTrajectoryResult,
    JointTrajectoryControllerState,
)
from control_msgs.srv import QueryTrajectoryState, QueryTrajectoryStateResponse
from controller_interface import NodeHandle, ParameterError, RateGate, RealtimePublisher, to_stamp
from controller_interface.action_controller import ActionController
from hardware_interface import JointHandle, JointStateHandle, addresses
from realtime_tools.action_server import RealtimeGoal
from trajectory_msgs.msg import JointTrajectory
from urdf_geometry_parser import robot_geometry

from . import tolerances
from ._sampler import Sampler, position_error
from .segment import Segment, active_index, stop_segment
from .splice import Command, InvalidTrajectory, Late, map_joints, splice

Result = FollowJointTrajectoryResult


class JointTrajectoryController(ActionController):
    """Follows trajectories on the joints of parameter ``joints``.

    Threads: ``update`` runs in the control loop; commands, goals and queries come in threads of rospy. They parse on
    their own time and hold ``_lock`` only to join the new motion to the running one, so the loop waits microseconds.
    """

    # set by a variant whose output depends on the state error
    feeds_back = False
    # whether ordinary cycles are answered in one call of C++; the long way follows the same laws, to the last bit
    fast_way = True

    # -- what a variant adds -------------------------------------------------------------------------------------------

    def init_output(self, handles: list[Any], controller_nh: NodeHandle) -> None:
        """Read the variant's parameters.

        :param handles: of the joints, in their order
        :param controller_nh: namespace of the controller
        """

    def start_output(self) -> None:
        """Write the first command; the joints are to stay where they are."""

    def write_output(self, desired: list[tuple[float, float, float]], errors: list[tuple[float, float]], period: float) -> None:
        """Write the commands of this cycle.

        :param desired: position, velocity, acceleration of each joint
        :param errors: position and velocity error of each joint; empty unless ``feeds_back``
        :param period: s since the cycle before
        """
        raise NotImplementedError

    # -- life-cycle ----------------------------------------------------------------------------------------------------

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        self._name = controller_nh.namespace
        self._joints = controller_nh.strings("joints")
        repeated = sorted({joint for joint in self._joints if self._joints.count(joint) > 1})
        if repeated:
            raise ParameterError(f"parameter {self._name}/joints names {', '.join(repeated)} more than once")
        state_rate = _positive(controller_nh, "state_publish_rate", 50.0)
        self._monitor_period = 1.0 / _positive(controller_nh, "action_monitor_rate", 20.0)
        self._stop_duration = controller_nh.param("stop_trajectory_duration", 0.0)
        if not 0.0 <= self._stop_duration < math.inf:
            raise ParameterError(f"parameter {self._name}/stop_trajectory_duration must not be negative, it is {self._stop_duration}")
        self._partial = controller_nh.param("allow_partial_joints_goal", False)
        try:
            self._tolerances = tolerances.from_parameters(self._joints, controller_nh.param("constraints", {}))
        except ValueError as error:
            raise ParameterError(f"{self._name}: {error}") from None
        robot = robot_geometry(root_nh)
        types = [robot.joint(joint).type for joint in self._joints]
        self._continuous = [kind == "continuous" for kind in types]
        # the difference of two angles is the short way round; of two lengths it is just their difference
        self._angular = [kind != "prismatic" for kind in types]

        handles = [hw.get_handle(joint) for joint in self._joints]
        self._states = [handle.state for handle in handles]
        self._sampler = _sampler_of(self._states, self._angular) if self.fast_way else None
        self._quick: Callable = self._sampler.quick if self._sampler else lambda *_: None
        self._writes = False
        self._sampled: tuple = (None, None, [])  # trajectory, goal and cursors that the sampler knows of
        self.init_output(handles, controller_nh)

        self._time = self._uptime = self._period = 0.0
        self._done = [False] * len(self._joints)
        self._follow([[stop_segment(0.0, 0.0, 0.0, 0.0, None, t)] for t in self._tolerances])

        self.serve(controller_nh, "follow_joint_trajectory", FollowJointTrajectoryAction)
        self._gate = RateGate(state_rate)
        self._state_publisher = RealtimePublisher(controller_nh, "state", JointTrajectoryControllerState, queue_size=1)
        controller_nh.subscriber("command", JointTrajectory, self._on_command, queue_size=1)
        controller_nh.service("query_state", QueryTrajectoryState, self._on_query)

    def starting(self, time: float) -> None:
        with self._lock:
            self._time, self._uptime, self._period = time, 0.0, 0.0
            self._next_monitor = 0.0
            self._known = self._hold_measured(None)
            if not self._known:
                rospy.logerr(
                    "%s: the hardware reports no position for %s yet; waiting for it before moving",
                    self._name,
                    ", ".join(s.name for s in self._states if not math.isfinite(s.position)),
                )
            self._gate.restart(0.0)
            self._running = True
        self.start_output()

    # -- the loop ------------------------------------------------------------------------------------------------------

    def update(self, time: float, period: float) -> None:
        with self._lock:
            self._time, self._period = time, period
            self._uptime = uptime = self._uptime + period
            if not self._known:
                self._known = self._hold_measured(None)
                if not self._known:
                    return
            trajectory, cursor, next_start = self._trajectory, self._cursor, self._next_start
            goal, done = self._goal, self._done

        publish = self._gate.due(uptime)
        report = goal is not None and uptime >= self._next_monitor
        known = self._sampled[0] is trajectory and self._sampled[1] is goal
        quick = self._quick(uptime, goal is not None, self.feeds_back or publish or report) if known else None
        if quick is not None:
            desired, errors = quick
            if not self._writes:
                self.write_output(desired, errors, period)
        else:
            desired, errors, left = self._sample(uptime, trajectory, cursor, next_start, goal, done, publish)
            self._remember(trajectory, cursor, next_start, goal)
            goal = left
            self.write_output(desired, errors, period)

        first = trajectory[0][cursor[0]]
        if goal is not None and all(done) and self._release(goal):
            goal.succeed(Result(error_code=Result.SUCCESSFUL))
        elif report and goal is not None:
            self._next_monitor = max(self._next_monitor + self._monitor_period, uptime)
            goal.feedback(self._fill(FollowJointTrajectoryFeedback(), time, uptime, first, desired, errors))
        if publish and self._state_publisher.has_subscribers:
            self._state_publisher.publish(self._fill(JointTrajectoryControllerState(), time, uptime, first, desired, errors))

    def write_positions_to(self, handles: Sequence[Any]) -> None:
        """For a variant that writes desired positions to ``handles`` and nothing else: ordinary cycles write them without
        ``write_output``.
        """
        if self._sampler is None or not all(isinstance(handle, JointHandle) for handle in handles):
            return
        for joint, handle in enumerate(handles):
            self._sampler.add_command(joint, addresses(handle)[0])
        self._writes = True

    def _sample(
        self,
        uptime: float,
        trajectory: list[list[Segment]],
        cursor: list[int],
        next_start: list[float],
        goal: RealtimeGoal | None,
        done: list[bool],
        publish: bool,
    ):
        """Every joint at ``uptime``, and what becomes of the goal: (desired states, errors, the goal or None if it was aborted)."""
        need_errors = self.feeds_back or goal is not None or publish
        desired = []
        errors = []
        for joint, segments in enumerate(trajectory):
            if uptime >= next_start[joint]:
                index = cursor[joint] = active_index(segments, uptime)
                next_start[joint] = segments[index + 1].start if index + 1 < len(segments) else math.inf
            segment = segments[cursor[joint]]
            point = segment.sample(uptime)
            desired.append(point)
            if not need_errors:
                continue
            state = self._states[joint]
            error = position_error(state.position, point[0], self._angular[joint])
            velocity_error = point[1] - state.velocity
            errors.append((error, velocity_error))
            if goal is not None and segment.goal is goal:
                if uptime < segment.end:
                    broken = segment.tolerances.path.violation(error, velocity_error)
                    if broken:
                        self._abort(goal, Result.PATH_TOLERANCE_VIOLATED, joint, "path", error, broken)
                        goal = None
                elif next_start[joint] == math.inf:
                    broken = segment.tolerances.goal.violation(error, velocity_error)
                    if not broken:
                        done[joint] = True
                    elif not done[joint] and uptime >= segment.end + segment.tolerances.goal_time:
                        self._abort(goal, Result.GOAL_TOLERANCE_VIOLATED, joint, "goal", error, broken)
                        goal = None
        return desired, errors, goal

    def _remember(self, trajectory: list[list[Segment]], cursor: list[int], next_start: list[float], goal: RealtimeGoal | None) -> None:
        """Hand the segments that are under way to the sampler, which answers from then on until something happens."""
        if self._sampler is None:
            return
        known = self._sampled[0] is trajectory and self._sampled[1] is goal
        for joint, index in enumerate(cursor):
            if known and self._sampled[2][joint] == index:
                continue
            segment = trajectory[joint][index]
            path = segment.tolerances.path
            self._sampler.follow(joint, segment, next_start[joint], goal is not None and segment.goal is goal, path.position, path.velocity)
        self._sampled = trajectory, goal, list(cursor)

    def _fill(self, message, time: float, uptime: float, segment: Segment, desired, errors):
        """State and feedback messages carry the same fields."""
        elapsed = uptime - segment.start
        message.header.stamp = to_stamp(time)
        message.joint_names = self._joints
        message.desired.positions, message.desired.velocities, message.desired.accelerations = map(list, zip(*desired))
        message.desired.time_from_start = rospy.Duration.from_sec(segment.point_time)
        message.actual.positions = [state.position for state in self._states]
        message.actual.velocities = [state.velocity for state in self._states]
        message.actual.time_from_start = rospy.Duration.from_sec(segment.point_time + elapsed)
        message.error.positions, message.error.velocities = map(list, zip(*errors))
        message.error.time_from_start = rospy.Duration.from_sec(-elapsed)
        return message

    def _abort(self, goal: RealtimeGoal, code: int, joint: int, phase: str, error: float, broken: str) -> None:
        """End the goal and stop the joints where they are, from the next cycle on."""
        with self._lock:
            if self._goal is not goal:  # a thread of rospy was quicker
                return
            self._goal = None
            if not self._hold_measured(None):  # what was desired proved out of reach; a ramp would go on from there
                self._hold(None)
        text = f"{self._joints[joint]} {phase} error {error:.6f}: {broken}"
        goal.abort(Result(error_code=code, error_string=text), text)

    # -- motions (called with _lock held) ------------------------------------------------------------------------------

    def _follow(self, trajectory: list[list[Segment]]) -> None:
        self._trajectory = trajectory
        self._cursor = [0] * len(trajectory)
        self._next_start = [segments[1].start if len(segments) > 1 else math.inf for segments in trajectory]

    def _hold_measured(self, goal: RealtimeGoal | None) -> bool:
        """Rest where the joints are now; False when the hardware does not say where that is."""
        positions = [state.position for state in self._states]
        if not all(map(math.isfinite, positions)):
            return False
        self._follow(
            [[stop_segment(self._uptime, position, 0.0, 0.0, goal, default)] for position, default in zip(positions, self._tolerances)]
        )
        return True

    def _hold(self, goal: RealtimeGoal | None) -> None:
        if self._stop_duration == 0.0 and self._hold_measured(goal):
            return
        states = [segments[max(active_index(segments, self._uptime), 0)].sample(self._uptime) for segments in self._trajectory]
        self._follow(
            [
                [stop_segment(self._uptime, position, velocity, self._stop_duration, goal, default)]
                for (position, velocity, _), default in zip(states, self._tolerances)
            ]
        )

    # -- commands, in threads of rospy ---------------------------------------------------------------------------------

    def _on_command(self, message: JointTrajectory) -> None:
        try:
            self._take(message, None, self._tolerances, named=False)
        except InvalidTrajectory as error:
            self._complain(error)

    def _complain(self, error: Exception) -> None:
        log = rospy.logwarn if isinstance(error, Late) else rospy.logerr
        log("%s: %s", self._name, error)

    def _on_goal(self, goal: RealtimeGoal) -> None:
        try:
            wanted = tolerances.overridden(self._tolerances, self._joints, goal.goal)
            self._take(goal.goal.trajectory, goal, wanted, named=True)
        except (InvalidTrajectory, ValueError) as error:
            self._complain(error)
            code = getattr(error, "code", Result.INVALID_GOAL)
            goal.reject(Result(error_code=code, error_string=str(error)), str(error))

    def _take(self, message: JointTrajectory, goal: RealtimeGoal | None, wanted: list[tolerances.JointTolerances], named: bool) -> None:
        """Join a message to the running motion; its goal, or none, takes the place of the active one.

        :param named: whether an empty trajectory must name the joints, as that of an action goal
        :raises InvalidTrajectory: the motion goes on as it was
        """
        if not self._running:
            raise InvalidTrajectory(
                Result.INVALID_GOAL,
                f"Can't accept new {'action goals' if named else 'commands'}. Controller is not running; start it first",
            )
        if not self._known:
            raise InvalidTrajectory(Result.INVALID_GOAL, "The hardware has not reported where the joints are yet")
        command = None
        if message.points or named:
            columns = map_joints(message.joint_names, self._joints, self._partial)
        if message.points:
            stamp = message.header.stamp.to_sec()
            command = Command(message, columns, self._time + self._period - stamp if stamp else 0.0)
        with self._lock:
            if command is None:
                self._hold(goal)
            else:
                next_uptime = self._uptime + self._period
                start = next_uptime + (stamp - self._time - self._period if stamp else 0.0)
                self._follow(splice(self._trajectory, command, start, self._uptime, next_uptime, self._continuous, wanted, goal))
            self._replace(goal, "Replaced by " + ("another goal" if goal else "a trajectory from the command topic"))
            self._done = [False] * len(self._joints)
            self._next_monitor = self._uptime
        # a first point at 0 s that starts at once says where the motion begins: nobody misses it
        if command is not None and command.first > (0 if stamp or command.times[0] != 0.0 else 1):
            rospy.logwarn(
                "%s: Dropping first %d trajectory point(s) out of %d, as they occur before the current time.",
                self._name,
                command.first,
                len(command.times),
            )
        if command is not None and command.surplus:
            rospy.logwarn_throttle(
                5.0, f"{self._name}: points with {command.surplus} value(s) more than joints are named; the last ones are left out"
            )

    def _on_query(self, request) -> QueryTrajectoryStateResponse:
        with self._lock:
            if not self._running:
                raise rospy.ServiceException(f"{self._name}: Can't sample trajectory. Controller is not running.")
            trajectory = self._trajectory
            time = self._uptime + request.time.to_sec() - self._time
        if any(active_index(segments, time) < 0 for segments in trajectory):
            raise rospy.ServiceException(
                f"{self._name}: Requested sample time precedes trajectory start time: {request.time.to_sec():.3f} s"
            )
        samples = [segments[active_index(segments, time)].sample(time) for segments in trajectory]
        return QueryTrajectoryStateResponse(self._joints, *map(list, zip(*samples)))


def _sampler_of(states: Sequence[JointStateHandle], angular: Sequence[bool]) -> Sampler | None:
    """In C++, for handles whose numbers it may read; None for those of other classes."""
    sampler = Sampler()
    for state, turns in zip(states, angular):
        if not isinstance(state, JointStateHandle):
            return None
        position, velocity = addresses(state)[:2]
        sampler.add_joint(position, velocity, turns)
    return sampler


def _positive(nh: NodeHandle, name: str, default: float) -> float:
    value = nh.param(name, default)
    if not 0.0 < value < math.inf:
        raise ParameterError(f"parameter {nh.resolve(name)} must be a positive number of Hz, it is {value}")
    return value
