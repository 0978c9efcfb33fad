"""One group's commands, under the names of the compiled module."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TypeVar

import rospy
from geometry_msgs.msg import Pose, PoseStamped
from moveit_commander import conversions
from moveit_commander.conversions import msg_to_string
from moveit_commander.exception import MoveItCommanderException
from moveit_commander.move_group import MoveGroupCommander
from moveit_msgs.msg import Constraints, Grasp, PlaceLocation, RobotState, RobotTrajectory, TrajectoryConstraints
from sensor_msgs.msg import JointState

Message = TypeVar("Message")

# What MoveGroupCommander does with the same arguments and the same answer.
_SAME = frozenset(
    """
    allow_looking allow_replanning attach_object clear_max_cartesian_link_speed clear_path_constraints clear_pose_target
    clear_pose_targets clear_trajectory_constraints detach_object forget_joint_values get_active_joints
    get_current_joint_values get_current_rpy get_end_effector_link get_goal_joint_tolerance get_goal_orientation_tolerance
    get_goal_position_tolerance get_jacobian_matrix get_joint_value_target get_joints get_known_constraints get_name
    get_named_target_values get_named_targets get_planner_id get_planning_frame get_planning_pipeline_id get_planning_time
    get_pose_reference_frame get_random_joint_values get_remembered_joint_values get_variable_count
    limit_max_cartesian_link_speed remember_joint_values set_constraints_database set_goal_joint_tolerance
    set_goal_orientation_tolerance set_goal_position_tolerance set_goal_tolerance set_max_acceleration_scaling_factor
    set_max_velocity_scaling_factor set_num_planning_attempts set_planner_id set_planning_pipeline_id set_planning_time
    set_pose_reference_frame set_random_target set_start_state_to_current_state set_support_surface_name stop
    """.split()
)


def _message(kind: type[Message], data: bytes) -> Message:
    found = kind()
    conversions.msg_from_string(found, data)
    return found


class MoveGroupInterface:
    """Commands for one group; messages are serialised, and setters answer whether they did.

    :raises RuntimeError: no robot description, no such group, or no move_group within ``wait_for_servers`` wall seconds.
    """

    def __init__(self, group_name: str, robot_description: str, ns: str = "", wait_for_servers: float = 5.0):
        self._group = MoveGroupCommander(group_name, robot_description, ns, wait_for_servers)

    def __getattr__(self, name: str):
        if name in _SAME:
            return getattr(self.__dict__["_group"], name)
        raise AttributeError(f"'MoveGroupInterface' object has no attribute '{name}'")

    def __dir__(self) -> Iterable[str]:
        return sorted({*super().__dir__(), *_SAME})

    @staticmethod
    def _did(set_it: Callable, *args) -> bool:
        try:
            set_it(*args)
        except MoveItCommanderException as error:
            rospy.logerr("%s", error)
            return False
        return True

    # --- the group and its state ---

    def get_variables(self) -> list[str]:
        """As joints are named that have one variable."""
        return [str(name) for name in self._group._group.variables]

    def get_interface_description(self) -> bytes:
        return msg_to_string(self._group.get_interface_description())

    def set_end_effector_link(self, link: str) -> bool:
        return self._did(self._group.set_end_effector_link, link)

    def start_state_monitor(self, wait: float = 1.0) -> bool:
        """Listen to the joint states; whether all came within ``wait`` wall seconds."""
        return self._group._session.state(wait) is not None

    def get_current_state(self) -> bytes:
        return msg_to_string(self._group.get_current_state())

    def get_current_state_bounded(self) -> dict:
        """Joint values within the limits, by name."""
        joints = self._group.get_current_state_bounded().joint_state
        return dict(zip(joints.name, joints.position))

    def enforce_bounds(self, state: bytes) -> bytes:
        return msg_to_string(self._group.enforce_bounds(_message(RobotState, state)))

    def set_start_state(self, state: bytes) -> None:
        self._group.set_start_state(_message(RobotState, state))

    def get_current_pose(self, end_effector_link: str = "") -> list[float]:
        """[x, y, z, qx, qy, qz, qw]."""
        return conversions.pose_to_list(self._group.get_current_pose(end_effector_link).pose)

    def get_random_pose(self, end_effector_link: str = "") -> list[float]:
        return conversions.pose_to_list(self._group.get_random_pose(end_effector_link).pose)

    # --- targets ---

    def set_joint_value_target(self, target, value=None) -> bool:
        """Values, {joint: value}, or a joint and its value or values."""
        return self._did(self._group.set_joint_value_target, target, value)

    def set_joint_value_target_from_pose(self, pose: bytes, end_effector_link: str, approximate: bool) -> bool:
        return self._did(self._group.set_joint_value_target, _message(Pose, pose), end_effector_link, approximate)

    def set_joint_value_target_from_pose_stamped(self, pose: bytes, end_effector_link: str, approximate: bool) -> bool:
        return self._did(self._group.set_joint_value_target, _message(PoseStamped, pose), end_effector_link, approximate)

    def set_joint_value_target_from_joint_state_message(self, joints: bytes) -> bool:
        return self._did(self._group.set_joint_value_target, _message(JointState, joints))

    def set_named_target(self, name: str) -> bool:
        return self._did(self._group.set_named_target, name)

    def set_pose_target(self, pose: Sequence[float], end_effector_link: str = "") -> bool:
        """[x, y, z, roll, pitch, yaw] or [x, y, z, qx, qy, qz, qw]."""
        return self._did(self._group.set_pose_target, list(pose), end_effector_link)

    def set_pose_targets(self, poses: Sequence[Sequence[float]], end_effector_link: str = "") -> bool:
        return self._did(self._group.set_pose_targets, [list(pose) for pose in poses], end_effector_link)

    def set_position_target(self, x: float, y: float, z: float, end_effector_link: str = "") -> bool:
        return self._did(self._group.set_position_target, [x, y, z], end_effector_link)

    def set_rpy_target(self, roll: float, pitch: float, yaw: float, end_effector_link: str = "") -> bool:
        return self._did(self._group.set_rpy_target, [roll, pitch, yaw], end_effector_link)

    def set_orientation_target(self, x: float, y: float, z: float, w: float, end_effector_link: str = "") -> bool:
        return self._did(self._group.set_orientation_target, [x, y, z, w], end_effector_link)

    def set_workspace(self, minx: float, miny: float, minz: float, maxx: float, maxy: float, maxz: float) -> None:
        self._group.set_workspace([minx, miny, minz, maxx, maxy, maxz])

    # --- constraints ---

    def set_path_constraints(self, name: str) -> bool:
        """Constraints of the warehouse."""
        return self._did(self._group.set_path_constraints, name)

    def set_path_constraints_from_msg(self, constraints: bytes) -> None:
        self._group.set_path_constraints(_message(Constraints, constraints))

    def get_path_constraints(self) -> bytes:
        return msg_to_string(self._group.get_path_constraints())

    def set_trajectory_constraints_from_msg(self, constraints: bytes) -> None:
        self._group.set_trajectory_constraints(_message(TrajectoryConstraints, constraints))

    def get_trajectory_constraints(self) -> bytes:
        return msg_to_string(self._group.get_trajectory_constraints())

    # --- plans and motions ---

    def construct_motion_plan_request(self) -> bytes:
        return msg_to_string(self._group.construct_motion_plan_request())

    def plan(self) -> tuple[bytes, bytes, float]:
        """(error code, trajectory, planning time in s)."""
        _success, trajectory, seconds, code = self._group.plan()
        return msg_to_string(code), msg_to_string(trajectory), seconds

    def move(self) -> bool:
        return self._group.go(wait=True)

    def async_move(self) -> bool:
        return self._group.go(wait=False)

    def execute(self, trajectory: bytes) -> bool:
        return self._group.execute(_message(RobotTrajectory, trajectory), wait=True)

    def async_execute(self, trajectory: bytes) -> bool:
        return self._group.execute(_message(RobotTrajectory, trajectory), wait=False)

    def compute_cartesian_path(self, waypoints: Sequence[Sequence[float]], eef_step: float, *options) -> tuple[bytes, float]:
        """(trajectory, fraction); ``options`` are, as the version has it, the jump threshold or not, whether to avoid
        collisions, and perhaps path constraints."""
        poses = [conversions.list_to_pose(pose) for pose in waypoints]
        rest = [_message(Constraints, option) if isinstance(option, bytes) else option for option in options]
        trajectory, fraction = self._group.compute_cartesian_path(poses, eef_step, *rest)
        return msg_to_string(trajectory), fraction

    def retime_trajectory(
        self, reference_state: bytes, trajectory: bytes, velocity_scaling_factor: float, acceleration_scaling_factor: float, algorithm: str
    ) -> bytes:
        timed = self._group.retime_trajectory(
            _message(RobotState, reference_state),
            _message(RobotTrajectory, trajectory),
            velocity_scaling_factor,
            acceleration_scaling_factor,
            algorithm,
        )
        return msg_to_string(timed)

    # --- objects ---

    def pick(self, name: str, grasps: bytes | Sequence[bytes] | bool = (), plan_only: bool = False) -> int:
        """With move_group's own grasps, one, or several; the error code."""
        if isinstance(grasps, bool):
            return self._group.pick(name, [], grasps)
        given = [grasps] if isinstance(grasps, bytes) else grasps
        return self._group.pick(name, [_message(Grasp, grasp) for grasp in given], plan_only)

    def place(self, name: str, location: bytes | Sequence[float] | bool | None = None, plan_only: bool = False) -> bool:
        """Anywhere, at a PlaceLocation, or at [x, y, z, qx, qy, qz, qw] in the pose reference frame."""
        if isinstance(location, bool):
            return self._group.place(name, None, location)
        if location is None:
            return self._group.place(name, None, plan_only)
        if isinstance(location, bytes):
            return self._group.place(name, _message(PlaceLocation, location), plan_only)
        return self._group.place(name, conversions.list_to_pose(location), plan_only)

    def place_poses_list(self, name: str, poses: Sequence[bytes], plan_only: bool = False) -> bool:
        return self._group.place(name, [_message(PoseStamped, pose) for pose in poses], plan_only)

    def place_locations_list(self, name: str, locations: Sequence[bytes], plan_only: bool = False) -> bool:
        return self._group.place(name, [_message(PlaceLocation, location) for location in locations], plan_only)
