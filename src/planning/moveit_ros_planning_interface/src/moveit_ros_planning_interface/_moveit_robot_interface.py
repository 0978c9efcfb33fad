"""The robot as a whole, under the names of the compiled module."""

from __future__ import annotations

from moveit_commander.conversions import msg_from_string, msg_to_string, pose_to_list
from moveit_commander.robot import RobotCommander
from moveit_msgs.msg import RobotState


class RobotInterface:
    """Groups, joints, links and the present state; messages are serialised. Of what the robot does not have, the
    answer is empty."""

    def __init__(self, robot_description: str, ns: str = ""):
        self._robot = RobotCommander(robot_description, ns)
        self._model = self._robot.model

    # --- names ---

    def get_robot_name(self) -> str:
        return self._model.name

    def get_planning_frame(self) -> str:
        return self._robot.get_planning_frame()

    def get_robot_root_link(self) -> str:
        return self._robot.get_root_link()

    def get_joint_names(self) -> list[str]:
        return self._robot.get_joint_names()

    def get_active_joint_names(self) -> list[str]:
        return self._robot.get_active_joint_names()

    def get_link_names(self) -> list[str]:
        return self._robot.get_link_names()

    def get_group_names(self) -> list[str]:
        return self._robot.get_group_names()

    def has_group(self, group: str) -> bool:
        return self._robot.has_group(group)

    def get_group_joint_names(self, group: str) -> list[str]:
        return self._robot.get_joint_names(group) if self.has_group(group) else []

    def get_group_active_joint_names(self, group: str) -> list[str]:
        return self._robot.get_active_joint_names(group) if self.has_group(group) else []

    def get_group_link_names(self, group: str) -> list[str]:
        return self._robot.get_link_names(group) if self.has_group(group) else []

    def get_group_joint_tips(self, group: str) -> list[str]:
        """Links at which the group's end effectors begin, else its tip."""
        if not self.has_group(group):
            return []
        found = self._model.group(group)
        hands = [hand.parent_link for hand in self._model.end_effectors if hand.name in found.attached_end_effectors]
        return hands or ([found.tip_link] if found.tip_link else [])

    def get_group_default_states(self, group: str) -> list[str]:
        return list(self._model.group(group).named_states) if self.has_group(group) else []

    def get_parent_group(self, group: str) -> tuple[str, str]:
        """The group at which an end effector's group hangs, and the link."""
        for hand in self._model.end_effectors:
            if hand.group == group:
                return hand.parent_group, hand.parent_link
        return "", ""

    # --- values ---

    def get_joint_limits(self, name: str) -> list[list[float]]:
        """[lowest, highest] of each of the joint's variables."""
        return self._robot.Joint(self._robot, name)._limits() if self._model.has_joint(name) else []

    def get_joint_values(self, group: str, named_state: str) -> dict[str, float]:
        """Joint values of a named state."""
        if named_state not in self.get_group_default_states(group):
            return {}
        return {joint: float(values[0]) for joint, values in self._model.group(group).named_state(named_state).items() if len(values) == 1}

    def get_link_pose(self, name: str) -> list[float]:
        """[x, y, z, qx, qy, qz, qw] in the planning frame, now."""
        return pose_to_list(self._robot.get_link(name).pose().pose) if self._model.has_link(name) else []

    def get_current_joint_values(self, name: str) -> list[float]:
        if not self._model.has_joint(name):
            return []
        present = self._robot.get_current_variable_values()
        return [present[variable] for variable in self._model.joint(name).variables]

    def get_current_variable_values(self) -> dict[str, float]:
        return self._robot.get_current_variable_values()

    def get_current_state(self) -> bytes:
        return msg_to_string(self._robot.get_current_state())

    # --- markers ---

    def get_robot_markers(self, *args: bytes | dict | list) -> bytes:
        """Of the robot now; of a state (RobotState); of links; of joint values; of joint values and links."""
        if not args:
            return msg_to_string(self._robot.get_robot_markers())
        if isinstance(args[0], bytes):
            state = RobotState()
            msg_from_string(state, args[0])
            return msg_to_string(self._robot.get_robot_markers(state))
        if isinstance(args[0], dict):
            return msg_to_string(self._robot.get_robot_markers(*args))
        return msg_to_string(self._robot.get_robot_markers({}, list(args[0])))

    def get_group_markers(self, group: str, *values: dict[str, float]) -> bytes:
        """Of a group's links, now or with joint values; empty if there is no such group."""
        return msg_to_string(self._robot.get_robot_markers(group, *values)) if self.has_group(group) else b""
