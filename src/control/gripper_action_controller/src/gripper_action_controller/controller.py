"""The gripper action controllers."""

from __future__ import annotations

import math

import rospy
from control_msgs.msg import GripperCommandAction, GripperCommandResult
from control_toolbox import load_pid
from controller_interface import NodeHandle, ParameterError
from controller_interface.action_controller import ActionController
from hardware_interface import EffortJointInterface, PositionJointInterface
from realtime_tools.action_server import RealtimeGoal
from urdf_geometry_parser import robot_geometry


class GripperActionController(ActionController):
    """Moves joint ``joint`` to the position of a GripperCommand goal.

    A goal succeeds inside ``goal_tolerance``. A joint that has not moved for ``stall_timeout`` seconds ends it as
    aborted with ``stalled`` set: that is how a gripper tells that it holds something.
    """

    # -- what a variant adds -------------------------------------------------------------------------------------------

    def init_output(self, controller_nh: NodeHandle) -> None:
        """Read the variant's parameters below ``controller_nh``."""

    def start_output(self) -> None:
        """Called when the controller starts."""

    def write_output(self, target: float, max_effort: float, error: float, velocity: float, period: float) -> float:
        """Command the joint. :return: the effort to report, N or Nm

        :param target: position to reach, rad or m
        :param max_effort: of the goal, N or Nm
        :param error: from the measured position to ``target``, rad or m
        :param velocity: measured, rad/s or m/s
        :param period: s since the cycle before
        """
        raise NotImplementedError

    # -- life-cycle ----------------------------------------------------------------------------------------------------

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        self._name = controller_nh.namespace
        joint = controller_nh.get_param("joint", str)
        self._tolerance = abs(controller_nh.param("goal_tolerance", 0.01))
        self._default_effort = abs(controller_nh.param("max_effort", 0.0))
        self._stall_velocity = abs(controller_nh.param("stall_velocity_threshold", 0.001))
        self._stall_timeout = controller_nh.param("stall_timeout", 1.0)
        if not controller_nh.param("action_monitor_rate", 20.0) > 0.0:
            raise ParameterError(f"parameter {self._name}/action_monitor_rate must be a positive number of Hz")
        robot_geometry(root_nh).joint(joint)  # a gripper joint that the URDF does not have is a mistake
        self._handle = hw.get_handle(joint)
        self.init_output(controller_nh)

        self._time = self._last_movement = 0.0
        self._effort = 0.0  # as reported by the last update
        self._command = (0.0, 0.0)  # position, max_effort
        self.serve(controller_nh, "gripper_cmd", GripperCommandAction)

    def starting(self, time: float) -> None:
        with self._lock:
            self._time = self._last_movement = time
            self._hold(None)
            self._running = True
        self.start_output()

    def update(self, time: float, period: float) -> None:
        with self._lock:
            self._time = time
            goal, (target, max_effort) = self._goal, self._command
        position, velocity = self._handle.position, self._handle.velocity
        error = target - position
        if goal is not None:
            self._supervise(goal, time, error, position, velocity)
        self._effort = self.write_output(target, max_effort, error, velocity, period)

    def _supervise(self, goal: RealtimeGoal, time: float, error: float, position: float, velocity: float) -> None:
        reached = abs(error) < self._tolerance
        if not reached:
            if abs(velocity) > self._stall_velocity or time < self._last_movement:  # or a simulation was reset
                self._last_movement = time
            if time - self._last_movement <= self._stall_timeout:
                return
        if not self._release(goal):
            return
        result = GripperCommandResult(position=position, effort=self._effort, stalled=not reached, reached_goal=reached)
        if reached:
            goal.succeed(result)
        else:
            goal.abort(
                result, f"Stalled {abs(error):.6g} before the goal: no movement over {self._stall_velocity:g} for {self._stall_timeout:g} s"
            )

    # -- goals, in threads of rospy ------------------------------------------------------------------------------------

    def _on_goal(self, goal: RealtimeGoal) -> None:
        wanted = goal.goal.command
        if not self._running:
            return self._reject(goal, "Can't accept new action goals. Controller is not running.")
        if not (math.isfinite(wanted.position) and math.isfinite(wanted.max_effort)):
            return self._reject(goal, f"The goal is not finite: position {wanted.position}, max_effort {wanted.max_effort}")
        with self._lock:
            self._replace(goal, "Replaced by another goal")
            self._command = (wanted.position, wanted.max_effort)
            self._last_movement = self._time

    def _reject(self, goal: RealtimeGoal, text: str) -> None:
        rospy.logerr("%s: %s", self._name, text)
        goal.reject(text=text)

    def _hold(self, goal: RealtimeGoal | None) -> None:
        self._command = (self._handle.position, self._default_effort)


class PositionGripperController(GripperActionController):
    """Commands the position; the effort is left to the drive."""

    interface = PositionJointInterface

    def write_output(self, target, max_effort, error, velocity, period):
        self._handle.command = target
        return max_effort


class EffortGripperController(GripperActionController):
    """PID on the position (parameters ``gains/JOINT``), bounded by the goal's max_effort: 0 there is no force."""

    interface = EffortJointInterface

    def init_output(self, controller_nh):
        self._pid = load_pid(controller_nh.sub(f"gains/{self._handle.name}"))

    def start_output(self):
        self._pid.reset()
        self._handle.command = 0.0

    def write_output(self, target, max_effort, error, velocity, period):
        limit = abs(max_effort)
        wanted = self._pid.compute_command(error, period, -velocity)
        effort = min(max(wanted, -limit), limit)
        self._handle.command = effort
        self._handle.slope = self._pid.slope_of_position(period) if effort == wanted else 0.0
        return effort
