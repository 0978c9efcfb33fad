"""Executes trajectories through controllers, watches that they take the time they should, and stops them."""

from __future__ import annotations

import bisect
import io
import math
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import genpy
import rospy
from dynamic_parameters import Server
from moveit_core.controller_manager import ControllerHandle, ControllerManager, ExecutionStatus
from moveit_core.errors import MoveItError
from moveit_msgs.msg import MoveItErrorCodes, RobotTrajectory
from std_msgs.msg import String

from . import _execution  # type: ignore[attr-defined]  # compiled
from .controllers import ControllerChoice, load_manager
from .parameter_tables import table
from .state_monitor import CurrentStateMonitor

#: parameters that an entry of controller_list may have for its own controller
_DURATIONS = ("allowed_execution_duration_scaling", "allowed_goal_duration_margin")
#: a line about the remaining time is printed this often (s)
_REPORT = 5.0
#: wall s: a stop that comes this little before a goal which was stamped no later was meant for it
_TOGETHER = 0.1


class ExecutionError(MoveItError):
    """A trajectory cannot be executed; one line saying why and what to do."""


@dataclass
class _Step:
    """One trajectory of an execution: its controllers and their shares."""

    controllers: list[str]
    parts: list[_execution.Trajectory]
    times: list[float]

    @property
    def joints(self) -> list[str]:
        return [name for part in self.parts for name in part.joint_names]


class TrajectoryExecution:
    """The one place through which this process moves the robot.

    :param namespace: where the parameters are.
    :param states_monitor: the robot's current state.
    """

    def __init__(self, model, state_monitor: CurrentStateMonitor, namespace: str = "~"):
        self.model = model
        self.monitor = state_monitor
        self.namespace = namespace
        self._lock = threading.Lock()
        self._running: Execution | None = None
        #: how often it was said to stop; who has seen it change is not to start a motion
        self.stops = 0
        self._last_stop = (-math.inf, rospy.Time())  # when it came: monotonic and ROS time
        self._on_stop: list[Callable[[], None]] = []
        self.config: dict[str, Any] = {}
        self._server = Server(namespace + "trajectory_execution", table(_execution.parameters()), self._reconfigure)
        manage = bool(rospy.get_param(namespace + "moveit_manage_controllers", False))
        rospy.loginfo("MoveIt %s allowed to manage controllers", "is" if manage else "is not")
        self.manager: ControllerManager | None = load_manager(model, namespace)
        self.choice = ControllerChoice(self.manager, manage) if self.manager else None
        self._own = self._read_own()
        self._subscriber = rospy.Subscriber("trajectory_execution_event", String, self._on_event, queue_size=100)
        if self.manager:
            rospy.loginfo("Trajectory execution is managing controllers")

    def _reconfigure(self, config, _level) -> None:
        self.config = config

    def _read_own(self) -> dict[tuple[str, str], float]:
        """What entries of ``~controller_list`` allow their own controllers, whatever manager is used."""
        entries = rospy.get_param(self.namespace + "controller_list", None)
        return {
            (str(entry.get("name")), key): float(entry[key])
            for entry in (entries if isinstance(entries, list) else [])
            if isinstance(entry, dict)
            for key in _DURATIONS
            if _is_number(entry.get(key))
        }

    def own_or_common(self, controller: str, key: str) -> float:
        """The parameter ``key`` of :data:`_DURATIONS` as it holds for ``controller``."""
        return self._own.get((controller, key), float(self.config[key]))

    def shutdown(self) -> None:
        """Stop what moves."""
        self.stop()
        self._subscriber.unregister()

    def _on_event(self, message: String) -> None:
        if message.data == "stop":
            self._last_stop = (time.monotonic(), rospy.Time.now())
            self.stop()
        else:
            rospy.logwarn("Unknown event type: '%s'; the only one is 'stop'", message.data[:40])

    @property
    def busy(self) -> bool:
        """True while a trajectory is being executed."""
        running = self._running
        return running is not None and not running.done

    def stop(self) -> None:
        """Stop what is being executed, or is about to be."""
        self.stops += 1
        for call in list(self._on_stop):
            call()
        running = self._running
        if running is not None:
            running.stop()

    def stops_before(self, stamp: rospy.Time) -> int:
        """The ``stops`` of :meth:`start` for a goal of this stamp that arrives now.

        Goals and stops come on two connections, so that a stop which was sent right after a goal may arrive before it.
        """
        wall, ros = self._last_stop
        return self.stops - int(time.monotonic() - wall < _TOGETHER and stamp <= ros)

    @contextmanager
    def calling_at_stop(self, call: Callable[[], None]) -> Iterator[None]:
        """``call()`` whenever it is said to stop, inside the block."""
        self._on_stop.append(call)
        try:
            yield
        finally:
            self._on_stop.remove(call)

    def start(
        self, trajectories: Sequence[RobotTrajectory], on_segment: Callable[[int], bool] | None = None, stops: int | None = None
    ) -> Execution:
        """Start to execute trajectories one after the other.

        :param on_segment: called with the index of each that has ended well; False stops.
        :param stops: ``self.stops``, or :meth:`stops_before`, when the motion was asked for, default now; a stop since then
            ends it at once.
        :raises ExecutionError: nothing can execute them, they do not start where the robot is, or another is running.
        """
        stops = self.stops if stops is None else stops
        steps = [self._step(trajectory) for trajectory in trajectories]
        first = next((step for step in steps if step.parts), None)
        with self._lock:
            if self.busy:
                raise ExecutionError("Cannot push a new trajectory while another is being executed: wait for it, or stop it")
            if first is not None:
                self._check_start(first)
            execution = Execution(self, steps, on_segment)
            self._running = execution
        execution.begin(self.stops != stops)
        return execution

    def _step(self, message: RobotTrajectory) -> _Step:
        trajectory = _read(message)
        fault = trajectory.fault(self.model)
        if fault:
            raise ExecutionError(fault)
        if trajectory.takes_no_time:
            return _Step([], [], [])
        if self.manager is None or self.choice is None:
            raise ExecutionError(
                f"no controller manager is loaded: "
                f"{rospy.resolve_name(self.namespace + 'moveit_controller_manager')} "
                "names none that could be used, so nothing can be executed"
            )
        wanted = _execution.actuated([*trajectory.joint_names, *trajectory.multi_dof_joint_names], self.model)
        if not wanted:
            raise ExecutionError("The trajectory to execute specifies no joints that a controller could move")
        chosen = self.choice.choose(wanted)
        if not chosen:
            self.manager.reload()
            chosen = self.choice.choose(wanted)
        if not chosen:
            raise ExecutionError(
                "Unable to identify any set of controllers that can actuate the specified joints: "
                f"[ {' '.join(sorted(wanted))} ]. Known controllers and their joints: "
                f"{self.manager.describe()}"
            )
        scaling = float(self.config["execution_velocity_scaling"])
        return _Step(chosen, [trajectory.share(set(self.manager.joints(name)), scaling) for name in chosen], trajectory.times)

    def tolerance(self) -> _execution.StartTolerance:
        """Allowed distances of joints from a trajectory's first point, as the parameters are now."""
        table = rospy.get_param(self.namespace + "trajectory_execution/joints_allowed_start_tolerance", {})
        own = {}
        for name, value in table.items() if isinstance(table, dict) else ():
            if not _is_number(value) or value < 0:
                rospy.logwarn("joints_allowed_start_tolerance/%s is %r: ignored, a number of 0 or more is expected", name, value)
            else:
                own[name] = float(value)
        return _execution.StartTolerance(float(self.config["allowed_start_tolerance"]), own)

    def _check_start(self, step: _Step) -> None:
        tolerance = self.tolerance()
        if not tolerance.any():
            return
        now = rospy.Time.now()
        if not self._heard_of(step.joints, now):
            raise ExecutionError(
                "Failed to validate trajectory: couldn't receive full current joint state within 1s. " + self.monitor.explain(1.0, now)
            )
        state = self.monitor.state()
        for part in step.parts:
            line = part.start_deviation(state, tolerance)
            if line:
                raise ExecutionError(line)

    def _heard_of(self, joints: Sequence[str], since: rospy.Time) -> bool:
        self.monitor.wait_for_current(since, 1.0)
        return not set(self.monitor.missing(since)) & set(joints)


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _read(message: RobotTrajectory) -> _execution.Trajectory:
    buffer = io.BytesIO()
    try:
        message.serialize(buffer)
    except genpy.SerializationError as error:
        raise ExecutionError(f"Wrong trajectory: {error}") from None
    return _execution.Trajectory(buffer.getvalue())


def _message(trajectory: _execution.Trajectory) -> RobotTrajectory:
    return RobotTrajectory().deserialize(trajectory.bytes())


class Execution:
    """One run of trajectories, in a thread of its own. ``status``, ``reason`` (one line), :meth:`wait`,
    :meth:`stop`."""

    def __init__(self, owner: TrajectoryExecution, steps: list[_Step], on_segment: Callable[[int], bool] | None):
        self._owner = owner
        self._steps = steps
        self._on_segment = on_segment
        self._lock = threading.Lock()
        self._stopped = threading.Event()
        self._finished = threading.Event()
        self._handles: list[ControllerHandle] = []
        self._where: tuple[int, rospy.Time | None] = (-1, None)
        self.status = ExecutionStatus.RUNNING
        self.reason = ""

    def begin(self, stopped: bool = False) -> None:
        """Start; ``stopped``: it was said to stop already."""
        if stopped:
            self._stopped.set()
            self.status = ExecutionStatus.PREEMPTED
        threading.Thread(target=self._run, name="trajectory execution", daemon=True).start()

    @property
    def done(self) -> bool:
        return self._finished.is_set()

    def wait(self, timeout: float | None = None) -> bool:
        """Wait for the end; ``timeout`` in wall seconds."""
        return self._finished.wait(timeout)

    def stop(self) -> None:
        """Cancel, and wait (2 s at most) until the run has ended. A run that is stopped is PREEMPTED."""
        with self._lock:
            if self.done:
                return
            self._stopped.set()
            self.status = ExecutionStatus.PREEMPTED
            self._cancel()
        rospy.loginfo("Stopped trajectory execution.")
        self._finished.wait(2.0)

    def _cancel(self) -> None:
        for handle in self._handles:
            handle.cancel()

    def expected_index(self) -> tuple[int, int]:
        """(trajectory, way point) where the robot should be now; (-1, -1) before the start."""
        step, since = self._where
        if step < 0 or since is None:
            return step, -1
        return step, bisect.bisect_left(self._steps[step].times, (rospy.Time.now() - since).to_sec())

    def _run(self) -> None:
        status = ExecutionStatus.SUCCEEDED
        last: _Step | None = None
        try:
            for index, step in enumerate(self._steps):
                status, last = self._execute(index, step), step
                if not status or self._stopped.is_set():
                    break
                if self._on_segment is not None and not self._on_segment(index):
                    status = ExecutionStatus.FAILED
                    break
            if last is not None and (status or self._stopped.is_set()):
                self._wait_for_rest(last)
        except Exception as error:  # a controller manager of a third party; the node must live on
            self.reason, status = f"{type(error).__name__}: {error}", ExecutionStatus.FAILED
            self._cancel()
        with self._lock:
            if not self._stopped.is_set():
                self.status = status
            self._where = (-1, None)
            self._handles = []
            self._finished.set()
        rospy.loginfo("Completed trajectory execution with status %s ...", self.status.value)

    def _execute(self, index: int, step: _Step) -> ExecutionStatus:
        if not step.parts:
            return ExecutionStatus.SUCCEEDED
        owner = self._owner
        assert owner.choice is not None  # the step has parts
        if not owner.choice.activate(step.controllers):
            return self._fail(f"controllers {', '.join(step.controllers)} are not active, and could not be activated")
        with self._lock:
            if self._stopped.is_set():
                return ExecutionStatus.PREEMPTED
            problem = self._send(step)
            if problem:
                return self._fail(problem)
            started = rospy.Time.now()  # of the controllers: an action server that comes up first takes none of their time
            self._where = (index, started)
        return self._watch(step, started)

    def _fail(self, reason: str, status: ExecutionStatus = ExecutionStatus.ABORTED) -> ExecutionStatus:
        self.reason = reason
        rospy.logerr("%s", reason)
        return status

    @property
    def _manager(self) -> ControllerManager:
        assert self._owner.manager is not None  # without one no step has parts
        return self._owner.manager

    def _send(self, step: _Step) -> str:
        self._handles = []
        manager = self._manager
        for number, (name, part) in enumerate(zip(step.controllers, step.parts), 1):
            handle = manager.handle(name)
            if handle is None:
                self._cancel()
                return f"No controller handle for controller '{name}'. Aborting. {manager.describe()}"
            if not handle.send(_message(part)):
                self._cancel()
                return f"Failed to send trajectory part {number} of {len(step.parts)} to controller {name}: {handle.reason}"
            self._handles.append(handle)
        return ""

    def _allowed(self, step: _Step) -> float:
        longest = 0.0
        for name, part in zip(step.controllers, step.parts):
            scaling, margin = (self._owner.own_or_common(name, key) for key in _DURATIONS)
            longest = max(longest, part.allowed_duration(rospy.Time.now().to_sec(), scaling, margin))
        return longest

    def _watch(self, step: _Step, started: rospy.Time) -> ExecutionStatus:
        allowed, planned = self._allowed(step), max(part.duration for part in step.parts)
        if planned > _REPORT:
            rospy.loginfo("Executing a trajectory of %.1f s", planned)
        told = 0.0
        for handle in list(self._handles):
            while not handle.wait(0.02):
                if self._stopped.is_set():
                    return ExecutionStatus.PREEMPTED
                gone = (rospy.Time.now() - started).to_sec()
                if planned - gone > 1.0 and gone - told > _REPORT:
                    told = gone
                    rospy.loginfo("Executing: %.1f s of %.1f s remain", planned - gone, planned)
                if gone > allowed and self._owner.config["execution_duration_monitoring"]:
                    self._cancel()
                    return self._fail(
                        "Controller is taking too long to execute trajectory (the expected upper bound "
                        "for the "
                        f"trajectory execution was {allowed:f} seconds). Stopping trajectory. Controller "
                        f"{handle.name} "
                        "has not said that it is done; parameter "
                        "trajectory_execution/allowed_execution_duration_scaling "
                        "gives it more time",
                        ExecutionStatus.TIMED_OUT,
                    )
            if self._stopped.is_set():
                return ExecutionStatus.PREEMPTED
            if handle.status is not ExecutionStatus.SUCCEEDED:
                self._cancel()
                self.reason = f"Controller handle {handle.name} reports status {handle.status.value}" + (
                    f": {handle.reason}" if handle.reason else ""
                )
                rospy.logwarn("%s", self.reason)
                return handle.status
        return ExecutionStatus.SUCCEEDED

    def _wait_for_rest(self, step: _Step) -> None:
        """The end is told when the robot has come to rest: three states in a row without motion, one second at most. After a
        stop a controller still slows down, and who plans from there meanwhile starts where the robot no longer is.
        """
        stopped = self._stopped.is_set()
        share = 0.1 if stopped else 1.0  # of the tolerance; slowing down is a small motion from state to state
        owner = self._owner
        tolerance = owner.tolerance()
        if not tolerance.any() or not owner.config["wait_for_trajectory_completion"]:
            return
        end, still, before = time.monotonic() + 1.0, 0, owner.monitor.state()
        while still < 3 and time.monotonic() < end and (stopped or not self._stopped.is_set()):
            if not owner.monitor.wait_for_next(step.joints, end - time.monotonic()):
                return
            now = owner.monitor.state()
            still = 0 if _execution.moved(step.joints, before, now, tolerance, share) else still + 1
            before = now


def error_code(status: ExecutionStatus) -> int:
    """The MoveItErrorCodes value of an execution that ended with ``status``."""
    return {
        ExecutionStatus.SUCCEEDED: MoveItErrorCodes.SUCCESS,
        ExecutionStatus.PREEMPTED: MoveItErrorCodes.PREEMPTED,
        ExecutionStatus.TIMED_OUT: MoveItErrorCodes.TIMED_OUT,
    }.get(status, MoveItErrorCodes.CONTROL_FAILED)
