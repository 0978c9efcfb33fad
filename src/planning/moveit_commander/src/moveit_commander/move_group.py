"""Planning and moving one group of joints."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import genpy
import motion
import numpy as np
import rospy
from geometry_msgs.msg import Pose, PoseStamped
from moveit_core import states
from moveit_msgs.msg import (
    Constraints,
    Grasp,
    MotionPlanRequest,
    MoveItErrorCodes,
    PlaceLocation,
    PlannerInterfaceDescription,
    RobotState,
    RobotTrajectory,
    TrajectoryConstraints,
)
from tf.transformations import euler_from_quaternion

from . import conversions
from .exception import MoveItCommanderException
from .group_requests import GroupRequests
from .session import session
from .target_commands import TargetCommands
from .targets import Targets

_ALGORITHMS = {
    "iterative_time_parameterization": "iterative_parabolic",
    "iterative_spline_parameterization": "iterative_spline",
    "time_optimal_trajectory_generation": "time_optimal",
}


class PlanTuple(tuple):
    """(success, trajectory, time, code), with the fields of the trajectory: that is what plan() returned once."""

    @property
    def joint_trajectory(self):
        return self[1].joint_trajectory

    @property
    def multi_dof_joint_trajectory(self):
        return self[1].multi_dof_joint_trajectory


class MoveGroupCommander(TargetCommands):
    """Commands for the group ``name``: targets, plans, motions.

    :param robot_description: parameter of the URDF. :param ns: namespace of move_group; "" is the node's own.
    :param wait_for_servers: wall seconds to wait for move_group; 0 waits for ever.
    :raises RuntimeError: no robot description, no such group, or no move_group.
    """

    def __init__(self, name: str, robot_description: str = "robot_description", ns: str = "", wait_for_servers: float = 5.0):
        self._session = session(robot_description, ns)
        self._model = self._session.model
        if not self._model.has_group(name):
            raise RuntimeError(
                f"Group '{name}' was not found. The robot '{self._model.name}' has the groups: "
                + (", ".join(self._model.groups) or "none; is the SRDF loaded?")
            )
        self._name = name
        self._warehouse: Any = None  # StoredConstraints, which not everybody has the database for
        self._group = self._model.group(name)
        settings = self._session.description.kinematics.get(name)
        self._targets = Targets(
            self._model,
            name,
            *((settings.joint_tolerance, settings.position_tolerance, settings.orientation_tolerance) if settings else ()),
        )
        self._requests = GroupRequests(self._session, name, self._targets)
        self._remembered: dict[str, list[float]] = {}
        self._reference = self._model.frame
        self._eef = self._group.tip_link or ""
        self._requests.wait(wait_for_servers)
        rospy.loginfo("Ready to take commands for planning group %s.", name)

    # --- the group ---

    def get_name(self) -> str:
        return self._name

    def get_active_joints(self) -> list[str]:
        """Joints that can be commanded: no fixed or mimic ones."""
        return list(self._group.active_joints)

    def get_joints(self) -> list[str]:
        """All joints of the group."""
        return list(self._group.joints)

    def get_variable_count(self) -> int:
        return len(self._group.variables)

    def has_end_effector_link(self) -> bool:
        return bool(self._eef)

    def get_end_effector_link(self) -> str:
        """The link that poses are for; "" if there is none."""
        return self._eef

    def set_end_effector_link(self, link_name: str) -> None:
        """``link_name``: a link, or a thing that the robot holds, or a subframe of one (``thing/subframe``)."""
        if not self._eef or not link_name:
            raise MoveItCommanderException("Unable to set end effector link")
        self._eef = self._link(link_name)

    def get_interface_description(self) -> PlannerInterfaceDescription:
        """Which planner move_group uses."""
        return self._requests.interface() or PlannerInterfaceDescription()

    def get_pose_reference_frame(self) -> str:
        """The frame of poses that do not name theirs."""
        return self._reference

    def set_pose_reference_frame(self, reference_frame: str) -> None:
        """Poses without a frame are in ``reference_frame`` from now on."""
        self._reference = reference_frame

    def get_planning_frame(self) -> str:
        return self._model.frame

    # --- the present state ---

    def get_current_pose(self, end_effector_link: str = "") -> PoseStamped:
        """Of ``end_effector_link`` ("": the group's), in the planning frame."""
        link = self._link(end_effector_link, "There is no end effector to get the pose of")
        return conversions.list_to_pose_stamped(self._current_pose(link), self._model.frame)

    def get_current_rpy(self, end_effector_link: str = "") -> list[float]:
        """[roll, pitch, yaw] of ``end_effector_link`` ("": the group's), in the planning frame, radians."""
        link = self._link(end_effector_link, "There is no end effector to get the rpy of")
        return list(euler_from_quaternion(self._current_pose(link)[3:]))

    def get_random_joint_values(self) -> list[float]:
        """Values within the limits."""
        state = self._model.state()
        state.randomize(self._name)
        return [float(value) for value in state.get_group(self._name)]

    def get_random_pose(self, end_effector_link: str = "") -> PoseStamped:
        """A pose that ``end_effector_link`` ("": the group's) can have, in the planning frame."""
        link = self._link(end_effector_link, "There is no end effector to get the pose of")
        state = self._state(link) or self._model.state()
        state.randomize(self._name)
        pose = state.pose(link)
        return conversions.list_to_pose_stamped([*pose.position, *pose.quaternion], self._model.frame)

    def get_current_state(self) -> RobotState:
        state = self._session.state()
        return states.robot_state_message(state) if state is not None else RobotState()

    def get_current_state_bounded(self) -> RobotState:
        """The present state, with what lies outside the limits put on them."""
        state = self._session.state()
        if state is None:
            return RobotState()
        state.enforce_bounds()
        return states.robot_state_message(state)

    def set_start_state_to_current_state(self) -> None:
        self._requests.start_state = None

    def set_start_state(self, msg: RobotState) -> None:
        """Plans start from ``msg`` until :meth:`set_start_state_to_current_state`; joints that it lacks are as now."""
        self._requests.start_state = msg

    # --- tolerances ---

    def get_goal_tolerance(self) -> tuple[float, float, float]:
        """(joint, position, orientation)."""
        return self._targets.joint_tolerance, self._targets.position_tolerance, self._targets.orientation_tolerance

    def get_goal_joint_tolerance(self) -> float:
        """rad or m."""
        return self._targets.joint_tolerance

    def get_goal_position_tolerance(self) -> float:
        """Radius of a sphere, m."""
        return self._targets.position_tolerance

    def get_goal_orientation_tolerance(self) -> float:
        """About each axis, rad."""
        return self._targets.orientation_tolerance

    def set_goal_tolerance(self, value: float) -> None:
        """All three: ``value`` is rad or m of a joint, m of a position, rad of an orientation."""
        self.set_goal_joint_tolerance(value)
        self.set_goal_position_tolerance(value)
        self.set_goal_orientation_tolerance(value)

    def set_goal_joint_tolerance(self, value: float) -> None:
        """``value``: rad or m, of each joint."""
        self._targets.joint_tolerance = float(value)

    def set_goal_position_tolerance(self, value: float) -> None:
        """``value``: m, radius of a ball."""
        self._targets.position_tolerance = float(value)

    def set_goal_orientation_tolerance(self, value: float) -> None:
        """``value``: rad, about each axis."""
        self._targets.orientation_tolerance = float(value)

    # --- settings of requests ---

    def allow_looking(self, value: bool) -> None:
        self._requests.look = bool(value)

    def allow_replanning(self, value: bool) -> None:
        self._requests.replan = bool(value)

    def get_known_constraints(self) -> list[str]:
        """Names of the constraints that the warehouse has for this group; see :meth:`set_constraints_database`."""
        return self._warehouse.names() if self._warehouse else []

    def get_path_constraints(self) -> Constraints:
        return self._requests.path_constraints or Constraints()

    def set_path_constraints(self, value: Constraints | str | None) -> None:
        """``value``: constraints that hold all along the path, or their name in the warehouse; None clears them."""
        if value is not None and not isinstance(value, Constraints):
            if self._warehouse is None:
                raise MoveItCommanderException(
                    f"Unable to set path constraints {value}: names are those of a warehouse, "
                    f"which set_constraints_database(host, port) opens; or give a "
                    f"moveit_msgs/Constraints"
                )
            value = self._warehouse.load(str(value))
        self._requests.path_constraints = value

    def clear_path_constraints(self) -> None:
        self._requests.path_constraints = None

    def get_trajectory_constraints(self) -> TrajectoryConstraints:
        return self._requests.trajectory_constraints or TrajectoryConstraints()

    def set_trajectory_constraints(self, value: TrajectoryConstraints | None) -> None:
        if value is not None and not isinstance(value, TrajectoryConstraints):
            raise MoveItCommanderException(f"Unable to set trajectory constraints {value}")
        self._requests.trajectory_constraints = value

    def clear_trajectory_constraints(self) -> None:
        self._requests.trajectory_constraints = None

    def set_constraints_database(self, host: str, port: int) -> None:
        """Take names of constraints from the warehouse that runs, or from the database file that ``host`` names; ``port`` is not used.

        :raises MoveItCommanderException: there is none.
        """
        from .constraints import StoredConstraints

        self._warehouse = StoredConstraints(host, self._model.name, self._name)

    def set_planning_time(self, seconds: float) -> None:
        """Plan for up to ``seconds``; 0 or less changes nothing."""
        if seconds > 0:
            self._requests.planning_time = float(seconds)

    def get_planning_time(self) -> float:
        return self._requests.planning_time

    def set_planning_pipeline_id(self, planning_pipeline: str) -> None:
        """Plan with ``planning_pipeline``, for example ompl or pilz_industrial_motion_planner; another one clears the planner."""
        if planning_pipeline != self._requests.pipeline_id:
            self._requests.pipeline_id, self._requests.planner_id = planning_pipeline, ""

    def get_planning_pipeline_id(self) -> str:
        return self._requests.pipeline_id

    def set_planner_id(self, planner_id: str) -> None:
        """Plan with ``planner_id``, a configuration of the pipeline; "" is the group's default."""
        self._requests.planner_id = planner_id

    def get_planner_id(self) -> str:
        return self._requests.planner_id

    def set_num_planning_attempts(self, num_planning_attempts: int) -> None:
        """Plan ``num_planning_attempts`` times, and take the shortest path."""
        self._requests.attempts = int(num_planning_attempts)

    def set_workspace(self, ws: Sequence[float]) -> None:
        """``ws``: [], [minX, minY, maxX, maxY] or [minX, minY, minZ, maxX, maxY, maxZ]; m. For planar and floating joints."""
        if len(ws) not in (0, 4, 6):
            raise MoveItCommanderException("Expected 0, 4 or 6 values in list specifying workspace")
        values = list(ws) or [0.0] * 6
        self._requests.workspace = tuple([*values[:2], 0.0, *values[2:], 0.0] if len(values) == 4 else values)

    def set_max_velocity_scaling_factor(self, value: float) -> None:
        """``value``: share of the joints' velocity limits, above 0 and up to 1."""
        self._requests.velocity = self._factor(value)

    def set_max_acceleration_scaling_factor(self, value: float) -> None:
        """``value``: share of the joints' acceleration limits, above 0 and up to 1."""
        self._requests.acceleration = self._factor(value)

    @staticmethod
    def _factor(value: float) -> float:
        if not 0 < value <= 1:
            raise MoveItCommanderException("Expected value in the range from 0 to 1 for scaling factor")
        return float(value)

    def limit_max_cartesian_link_speed(self, speed: float, link_name: str = "") -> None:
        """The largest ``speed`` (m/s) of link ``link_name`` (default: the end effector)."""
        if not speed > 0.0:
            raise MoveItCommanderException("Expected speed value to be greater than 0")
        self._requests.speed, self._requests.speed_link = float(speed), link_name or self._eef

    def clear_max_cartesian_link_speed(self) -> None:
        self._requests.speed, self._requests.speed_link = 0.0, ""

    # --- doing ---

    def go(self, joints=None, wait: bool = True) -> bool:
        """Plan and move to the target, or to ``joints``: values, a dict, a JointState, a Pose, or a remembered name.

        :param wait: until the motion has ended; False returns as soon as it is asked for. :return: whether that worked.
        """
        if isinstance(joints, bool):
            wait, joints = joints, None
        self._take_target(joints)
        return self._requests.move(wait)

    def _take_target(self, joints) -> None:
        if joints is None:
            return
        if isinstance(joints, str):
            if joints not in self._remembered:
                raise MoveItCommanderException(
                    f"No joint values are remembered as '{joints}'; targets of the SRDF are "
                    f"for "
                    f"set_named_target: {', '.join(self.get_named_targets()) or 'none'}"
                )
            self.set_joint_value_target(self._remembered[joints])
        elif isinstance(joints, Pose):
            self.set_pose_target(joints)
        else:
            self.set_joint_value_target(joints)

    def plan(self, joints=None) -> tuple[bool, RobotTrajectory, float, MoveItErrorCodes]:
        """(success, trajectory, planning time in s, error code); scripts for Melodic may take it for the trajectory. ``joints``: as for
        :meth:`go`.
        """
        self._take_target(joints)
        result = self._requests.plan()
        return PlanTuple(
            (result.error_code.val == MoveItErrorCodes.SUCCESS, result.planned_trajectory, result.planning_time, result.error_code)
        )

    def execute(self, trajectory, wait: bool = True) -> bool:
        """Execute ``trajectory``, a RobotTrajectory (or JointTrajectory, or what :meth:`plan` returned); ``wait`` as for :meth:`go`."""
        if isinstance(trajectory, tuple):
            if not isinstance(trajectory, PlanTuple):
                raise MoveItCommanderException("plan() returns (success, trajectory, time, code): execute its second element, plan()[1]")
            trajectory = trajectory[1]
        if not hasattr(trajectory, "joint_trajectory"):
            trajectory = RobotTrajectory(joint_trajectory=trajectory)
        return self._requests.execute(trajectory, wait)

    def stop(self) -> None:
        """Stop the motion."""
        self._requests.stop()

    def construct_motion_plan_request(self) -> MotionPlanRequest:
        """What :meth:`plan` would ask."""
        return self._requests.request()

    def compute_cartesian_path(
        self,
        waypoints: Sequence[Pose],
        eef_step: float,
        jump_threshold=0.0,
        avoid_collisions: bool = True,
        path_constraints: Constraints | None = None,
    ) -> tuple[RobotTrajectory, float]:
        """Straight lines of the end effector through ``waypoints`` (in the pose reference frame), a point every ``eef_step`` m:
        (trajectory, fraction that could be followed); the fraction is -1.0 on an error.

        ``jump_threshold`` may be left out: ``compute_cartesian_path(waypoints, step, True)``. The path ends before what collides
        (with ``avoid_collisions``) or breaks ``path_constraints``.
        """
        if isinstance(jump_threshold, bool):  # newer versions have no jump_threshold
            if not isinstance(avoid_collisions, bool):
                path_constraints = avoid_collisions
            jump_threshold, avoid_collisions = 0.0, jump_threshold
        if path_constraints is not None and not isinstance(path_constraints, Constraints):
            raise MoveItCommanderException(f"Unable to set path constraints, unknown constraint type {type(path_constraints)}")
        poses = [self._pose_target(pose).pose for pose in waypoints]
        response = self._requests.cartesian(
            poses, float(eef_step), float(jump_threshold), avoid_collisions, path_constraints, self._reference, self._eef
        )
        if response is None or response.error_code.val != MoveItErrorCodes.SUCCESS:
            return RobotTrajectory(), -1.0
        return response.solution, response.fraction

    def retime_trajectory(
        self,
        ref_state_in: RobotState,
        traj_in: RobotTrajectory,
        velocity_scaling_factor: float = 1.0,
        acceleration_scaling_factor: float = 1.0,
        algorithm: str = "iterative_time_parameterization",
    ) -> RobotTrajectory:
        """``traj_in`` with new times, within these shares of the joints' limits. An unknown ``algorithm`` gives an empty one.

        :param ref_state_in: where the joints are that it does not move.
        :param velocity_scaling_factor, acceleration_scaling_factor: above 0 and up to 1.
        """
        if algorithm not in _ALGORITHMS:
            rospy.logerr("Unknown time parameterization algorithm: %s; there are: %s", algorithm, ", ".join(_ALGORITHMS))
            return RobotTrajectory()
        state = self._state_of(ref_state_in)
        trajectory = states.trajectory_from_message(self._model, self._name, state, traj_in)
        timed = motion.time_parameterize(
            self._model,
            trajectory,
            _ALGORITHMS[algorithm],
            velocity_scaling=velocity_scaling_factor,
            acceleration_scaling=acceleration_scaling_factor,
        )
        return states.trajectory_message(timed)

    def _state_of(self, message: RobotState) -> motion.RobotState:
        state = self._model.state()
        states.apply_robot_state(None, state, message)
        return state

    def get_jacobian_matrix(self, joint_values: Sequence[float], reference_point: Sequence[float] | None = None) -> np.ndarray:
        """The (6, n) Jacobian of the end effector's ``reference_point`` (its frame, m) at ``joint_values``, rows v and w."""
        state = self._model.state()
        state.set_group(self._name, np.asarray(joint_values, dtype=float))
        point = (0.0, 0.0, 0.0) if reference_point is None else tuple(reference_point)
        return np.asarray(state.jacobian(self._name, "", point))

    def enforce_bounds(self, robot_state_msg: RobotState) -> RobotState:
        """``robot_state_msg`` with values outside the limits put on them.

        :raises genpy.DeserializationError: the state is empty (as compiled clients do).
        """
        if states.is_empty(robot_state_msg):
            raise genpy.DeserializationError("the robot state is empty: it names no joint")
        state = self._state_of(robot_state_msg)
        state.enforce_bounds()
        return states.robot_state_message(state)

    # --- objects ---

    def attach_object(self, object_name: str, link_name: str = "", touch_links: Sequence[str] = ()) -> bool:
        """Ask move_group to attach ``object_name`` of the scene to ``link_name`` (default: the end effector). True: it was asked.

        ``touch_links`` may touch the object; none named: the link itself.
        """
        link = link_name or self._eef or (self._group.links[0] if self._group.links else "")
        if not link:
            rospy.logerr("No known link to attach object '%s' to", object_name)
            return False
        return self._requests.attach(object_name, link, touch_links)

    def detach_object(self, name: str = "") -> bool:
        """Detach ``name``, an object or all of a link, or ("") all of this group's links. True: the request was sent."""
        return self._requests.detach(name, self._group.links)

    def pick(self, object_name: str, grasp: Grasp | Sequence[Grasp] = (), plan_only: bool = False) -> int:
        """Pick ``object_name`` by ``grasp``, or the best of several, with ``plan_only`` without moving; the error code."""
        return self._requests.pick(object_name, [grasp] if isinstance(grasp, Grasp) else list(grasp), plan_only)

    def place(self, object_name: str, location=None, plan_only: bool = False) -> bool:
        """Place the attached ``object_name`` at ``location``: a Pose, PoseStamped or PlaceLocation, or any of a list of the latter two.

        ``plan_only``: do not move.
        """
        locations = location if isinstance(location, list) else [location] if location else []
        wrong = [entry for entry in locations if not isinstance(entry, (Pose, PoseStamped, PlaceLocation))]
        if wrong:
            raise MoveItCommanderException(
                "Parameter location must be a Pose, PoseStamped, PlaceLocation, list of PoseStamped or list of PlaceLocation object"
            )
        return self._requests.place(object_name, [self._location(entry) for entry in locations], plan_only) == MoveItErrorCodes.SUCCESS

    def _location(self, entry) -> PlaceLocation:
        if isinstance(entry, PlaceLocation):
            return entry
        location = PlaceLocation(place_pose=entry if isinstance(entry, PoseStamped) else self._stamped(entry))
        approach, retreat = location.pre_place_approach, location.post_place_retreat
        approach.direction.header.frame_id, approach.direction.vector.z = self._model.frame, -1.0  # down
        approach.min_distance, approach.desired_distance = 0.1, 0.2
        retreat.direction.header.frame_id, retreat.direction.vector.x = self._eef, -1.0  # out of the gripper, as far as it goes
        retreat.min_distance, retreat.desired_distance = 0.0, 0.2
        return location

    def set_support_surface_name(self, value: str) -> None:
        """``value``: the object on which others stand: touching it is no collision while picking and placing."""
        self._requests.support_surface = value
