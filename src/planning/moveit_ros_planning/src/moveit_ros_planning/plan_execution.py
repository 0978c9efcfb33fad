"""Plan, execute while watching the scene, and plan again where that was asked for."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import motion
import rospy
from dynamic_parameters import Parameter, Server
from moveit_core import states
from moveit_core.controller_manager import ExecutionStatus
from moveit_core.errors import PlanningError
from moveit_msgs.msg import MoveItErrorCodes, PlanningScene, RobotTrajectory
from trajectory_msgs.msg import JointTrajectoryPoint

from . import _execution  # type: ignore[attr-defined]  # compiled
from .parameter_tables import table
from .scene_monitor import GEOMETRY, TRANSFORMS, SceneMonitor
from .trajectory_execution import ExecutionError, TrajectoryExecution

#: of looking around before a motion: known to clients, but no sensor here can be turned to look
_SENSING = [
    Parameter("max_safe_path_cost", float, 0.01, 0.0, 1000.0, "The cost of a path above which sensors should look first"),
    Parameter("max_look_attempts", int, 3, 0, 100, "How often sensors may look"),
    Parameter("max_cost_sources", int, 100, 1, 10000, "Places on a path that are looked at"),
    Parameter("discard_overlapping_cost_sources", float, 0.8, 0.01, 1.0, "Places that overlap by more count as one"),
]


@dataclass
class Segment:
    """One trajectory of a plan. ``allowed`` are the collisions it may make (an AllowedCollisionMatrix; None: the
    scene's);
    ``effect`` is called when it has ended well, and returns False to stop; ``monitor``: stop when the scene gets in
    the way."""

    trajectory: motion.Trajectory | None
    description: str = "plan"
    effect: Callable[[], bool] | None = None
    allowed: Callable[[motion.AllowedCollisionMatrix], None] | None = None
    monitor: bool = True


@dataclass
class Plan:
    """What planning gave: segments, or a code and a line saying why there are none."""

    code: int = 0
    message: str = ""
    segments: list[Segment] = field(default_factory=list)
    planning_time: float = 0.0
    executed: RobotTrajectory | None = None


class Stop(threading.Event):
    """A request to stop, which planning (``token``) and execution obey."""

    def __init__(self) -> None:
        super().__init__()
        self.token = motion.CancelToken()

    def set(self) -> None:
        super().set()
        self.token.cancel()


class PlanExecution:
    """Runs plans on the robot."""

    def __init__(self, monitor: SceneMonitor, execution: TrajectoryExecution, namespace: str = "~"):
        self._monitor = monitor
        self._execution = execution
        self.config: dict[str, Any] = {}
        self._server = Server(namespace + "plan_execution", table(_execution.plan_parameters()), self._reconfigure)
        self._sensing = Server(namespace + "sense_for_plan", _SENSING, lambda config, level: None)

    def _reconfigure(self, config, _level) -> None:
        self.config = config

    def plan_and_execute(
        self,
        make: Callable[[motion.PlanningScene], Plan],
        diff: PlanningScene,
        stop: Stop,
        replan: bool = False,
        attempts: int = 0,
        delay: float = 0.0,
        before: Callable[[], None] = lambda: None,
        stops: int | None = None,
    ) -> Plan:
        """Plan with ``make(scene)`` and execute; with ``replan``, again after failures that planning again may mend.

        :param diff: what is changed in the scene for this plan alone.
        :param stop: ends it from another thread.
        :param attempts: how often it is planned at most, with ``replan``; 0 is what the parameters say.
        :param delay: wall seconds between attempts.
        :param before: called before each execution.
        :param stops: see TrajectoryExecution.start.
        """
        stops = self._execution.stops if stops is None else stops
        left = (attempts or int(self.config["max_replan_attempts"])) if replan else 1
        while True:
            left -= 1
            with self._execution.calling_at_stop(stop.token.cancel):
                plan = self._plan(make, diff)
            if stop.is_set() or self._execution.stops != stops:
                plan.code, plan.message = MoveItErrorCodes.PREEMPTED, "stopped before the execution"
                return plan
            if plan.code == MoveItErrorCodes.SUCCESS:
                before()
                self.execute(plan, diff, stop, stops)
            if not _execution.may_plan_again(plan.code) or left <= 0 or stop.is_set():
                return plan
            rospy.loginfo("Planning attempt failed (%s); %d of them are left", plan.message, left)
            if delay > 0 and _execution.waits_before_planning(plan.code):
                rospy.loginfo("Waiting for a %f seconds before attempting a new plan ...", delay)
                stop.wait(delay)

    def _plan(self, make: Callable[[motion.PlanningScene], Plan], diff: PlanningScene) -> Plan:
        try:
            return make(self._monitor.copy(diff))
        except PlanningError as error:
            rospy.logerr("%s", error)
            return Plan(error.code, str(error))
        except motion.MotionError as error:
            rospy.logerr("Planning failed: %s", error)
            return Plan(MoveItErrorCodes.FAILURE, str(error))

    def execute(self, plan: Plan, diff: PlanningScene | None, stop: Stop, stops: int | None = None) -> None:
        """Execute the segments of ``plan``, write the outcome into it; for ``stops`` see TrajectoryExecution.start.

        :param diff: what the scene was changed by when it was planned; None: nothing. :param stop: ends it from another thread.
        """
        run = _Run(self._monitor, self._execution, plan, diff, stop, stops)
        recorder = _Recorder(self._monitor, float(self.config["record_trajectory_state_frequency"]))
        try:
            run.go()
        except ExecutionError as error:
            rospy.logerr("%s", error)
            plan.code, plan.message = MoveItErrorCodes.CONTROL_FAILED, str(error)
        plan.executed = recorder.end()


class _Run:
    """One execution of a plan, watched."""

    def __init__(self, monitor: SceneMonitor, execution: TrajectoryExecution, plan: Plan, diff, stop: Stop, stops: int | None):
        self._monitor = monitor
        self._execution = execution
        self._plan = plan
        self._diff = diff
        self._stop = stop
        self._stops = stops
        self._changed = threading.Event()
        self._bad: str | None = None
        self._effect_failed = False

    def go(self) -> None:
        self._unwind()
        messages = [states.trajectory_message(segment.trajectory) for segment in self._plan.segments]
        self._monitor.on_change(self._scene_changed)
        try:
            execution = self._execution.start(messages, self._segment_done, self._stops)
            self._watch(execution)
        finally:
            self._monitor.off_change(self._scene_changed)

    def _unwind(self) -> None:
        """Continuous joints go on from where the trajectory before leaves them, those of the first from where they are."""
        trajectories = [segment.trajectory if segment.trajectory and len(segment.trajectory) else None for segment in self._plan.segments]
        groups = [trajectory.group if trajectory else None for trajectory in trajectories]
        for index, trajectory in enumerate(trajectories):
            before = _execution.goes_on_from(groups, index)
            if trajectory:
                trajectory.unwind(trajectories[before].state(-1) if before >= 0 else self._monitor.states.state())

    def _scene_changed(self, kinds: int) -> None:
        if kinds & (GEOMETRY | TRANSFORMS):
            self._changed.set()

    def _watch(self, execution) -> None:
        while not execution.wait(0.01):
            if self._stop.is_set() or rospy.is_shutdown():
                rospy.loginfo("Stopping execution due to preempt request")
                execution.stop()
                break
            if self._changed.is_set():
                self._changed.clear()
                index, point = execution.expected_index()
                if index >= 0 and self._invalid(index, point):
                    execution.stop()
                    break
        self._judge(execution)

    def _judge(self, execution) -> None:
        plan, codes = self._plan, MoveItErrorCodes
        if self._bad is not None:
            plan.code, plan.message = codes.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE, self._bad
        elif self._stop.is_set() or self._effect_failed:
            plan.code, plan.message = codes.PREEMPTED, "stopped while executing"
        elif execution.status is ExecutionStatus.SUCCEEDED:
            plan.code, plan.message = codes.SUCCESS, ""
        elif execution.status is ExecutionStatus.TIMED_OUT:
            plan.code, plan.message = codes.TIMED_OUT, execution.reason
        else:
            plan.code = codes.CONTROL_FAILED
            plan.message = execution.reason or (
                "it was said to stop" if execution.status is ExecutionStatus.PREEMPTED else f"the execution ended {execution.status.value}"
            )

    def _segment_done(self, index: int) -> bool:
        segment = self._plan.segments[index]
        if segment.effect is not None and not segment.effect():
            rospy.logerr("Execution of path-completion side-effect failed. Preempting.")
            self._effect_failed = True
            return False
        following = index + 1
        return following >= len(self._plan.segments) or not self._invalid(following, 0)

    def _invalid(self, index: int, expected: int) -> bool:
        """Whether the rest of a segment, from about the way point ``expected`` on, collides in the present scene; says where."""
        segment = self._plan.segments[index]
        trajectory = segment.trajectory
        if trajectory is None or len(trajectory) == 0 or not segment.monitor:
            return False
        scene = self._monitor.copy(self._diff)
        matrix = scene.acm
        if segment.allowed is not None:
            segment.allowed(matrix)
            scene.set_acm(matrix)
        found = None

        def valid(state: motion.RobotState) -> bool:
            nonlocal found
            found = scene.check(state, trajectory.group, contacts=1, padded=False)
            return not found.collision

        number = _execution.first_invalid(len(trajectory), expected, trajectory.state, scene.state, valid)
        if number < 0:
            return False
        self._bad = self._describe(segment, number, len(trajectory), found)
        rospy.logwarn("%s", self._bad)
        return True

    @staticmethod
    def _describe(segment: Segment, number: int, count: int, found) -> str:
        between = f" ('{found.contacts[0].body_1}' meets '{found.contacts[0].body_2}')" if found.contacts else ""
        return (
            f"Trajectory component '{segment.description}' is invalid after scene update: way point {number} of "
            f"{count} is in "
            f"collision{between}. Stopping the execution"
        )


class _Recorder:
    """States during an execution, at a given rate (Hz; 0: none)."""

    def __init__(self, monitor: SceneMonitor, rate: float):
        self._monitor = monitor
        self._rows: list = []
        self._end = threading.Event()
        self._thread = None
        if rate > 0:
            self._thread = threading.Thread(target=self._run, args=(rate,), daemon=True)
            self._thread.start()

    def _run(self, rate: float) -> None:
        start, due = rospy.Time.now(), 0.0
        while not self._end.is_set() and not rospy.is_shutdown():
            now = (rospy.Time.now() - start).to_sec()
            if now >= due:
                self._rows.append((now, self._monitor.states.state()))
                due = now + 1.0 / rate
            time.sleep(0.002)

    def end(self) -> RobotTrajectory | None:
        """The recorded trajectory of all joints; None if nothing was recorded."""
        self._end.set()
        if self._thread is None:
            return None
        self._thread.join(1.0)
        message = RobotTrajectory()
        names = states.one_variable_joints(self._monitor.model)
        message.joint_trajectory.header.frame_id = self._monitor.model.frame
        message.joint_trajectory.joint_names = names
        for seconds, state in self._rows:
            message.joint_trajectory.points.append(
                JointTrajectoryPoint(positions=[state.get(name) for name in names], time_from_start=rospy.Duration.from_sec(seconds))
            )
        return message
