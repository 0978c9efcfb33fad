"""The whole robot: its groups, joints and links, and where they are."""

from __future__ import annotations

import motion
import rospy
from geometry_msgs.msg import PoseStamped
from moveit_core import states
from moveit_msgs.msg import RobotState
from moveit_ros_planning.robot_model import RobotDescription
from visualization_msgs.msg import MarkerArray

from . import conversions
from .exception import MoveItCommanderException
from .markers import robot_markers
from .move_group import MoveGroupCommander
from .session import session


class RobotCommander:
    """Asks for the robot. ``robot.<name>`` is a group, joint or link of that name.

    :param robot_description: parameter of the URDF. :param ns: namespace of move_group; "" is the node's own.
    :raises RuntimeError: no robot description.
    """

    class Joint:
        """One joint of the robot."""

        def __init__(self, robot: RobotCommander, name: str):
            self._robot = robot
            self._name = name

        def name(self) -> str:
            return self._name

        def variable_count(self) -> int:
            return len(self._limits())

        def bounds(self):
            """[low, high], or a list of those for a joint with several variables."""
            limits = self._limits()
            return limits[0] if len(limits) == 1 else limits

        def min_bound(self):
            limits = [low for low, _ in self._limits()]
            return limits[0] if len(limits) == 1 else limits

        def max_bound(self):
            limits = [high for _, high in self._limits()]
            return limits[0] if len(limits) == 1 else limits

        def value(self):
            """The present value, or values."""
            values = [float(value) for value in self._robot._state().get_joint(self._name)]
            return values[0] if len(values) == 1 else values

        def move(self, position, wait: bool = True) -> bool:
            """Move this joint alone to ``position`` (rad or m), with the smallest group that has it; ``wait`` as MoveGroupCommander.go."""
            group = self._robot.get_default_owner_group(self._name)
            if group is None:
                raise MoveItCommanderException(f"There is no known group containing joint {self._name}. Cannot move.")
            commander = self._robot.get_group(group)
            commander.set_joint_value_target(commander.get_current_joint_values())
            commander.set_joint_value_target(self._name, position)
            return commander.go(wait=wait)

        def _limits(self) -> list[list[float]]:
            return [[limit.min_position, limit.max_position] for limit in self._robot._model.joint(self._name).limits]

    class Link:
        """One link of the robot."""

        def __init__(self, robot: RobotCommander, name: str):
            self._robot = robot
            self._name = name

        def name(self) -> str:
            return self._name

        def pose(self) -> PoseStamped:
            """In the planning frame, now."""
            pose = self._robot._state().pose(self._name)
            return conversions.list_to_pose_stamped([*pose.position, *pose.quaternion], self._robot.get_planning_frame())

    def __init__(self, robot_description: str = "robot_description", ns: str = ""):
        self._robot_description = robot_description
        self._ns = ns
        self._session = session(robot_description, ns)
        self._model = self._session.model
        self._groups: dict[str, MoveGroupCommander] = {}

    @property
    def model(self) -> motion.RobotModel:
        """The robot as the motion library knows it."""
        return self._model

    @property
    def description(self) -> RobotDescription:
        """What the parameters say about the robot."""
        return self._session.description

    def _state(self) -> motion.RobotState:
        return self._session.state() or self._session.monitor.state()

    def get_planning_frame(self) -> str:
        """The frame in which planning is done."""
        return self._model.frame

    def get_robot_markers(self, *args) -> MarkerArray:
        """Markers that show the robot: () as it is now; (RobotState); (values); (values, links); (group); (group,
        values)."""
        return robot_markers(self._session.description, self._state(), *args)

    def get_root_link(self) -> str:
        return self._model.root_link

    def get_active_joint_names(self, group: str | None = None) -> list[str]:
        """Joints that move, mimic ones left out; of a group or of the robot."""
        return list(self._checked(group).active_joints if group is not None else self._model.active_joints)

    def get_joint_names(self, group: str | None = None) -> list[str]:
        """All joints of a group or of the robot."""
        return list(self._checked(group).joints if group is not None else self._model.joints)

    def get_link_names(self, group: str | None = None) -> list[str]:
        """Links of a group or of the robot."""
        return list(self._checked(group).links if group is not None else self._model.links)

    def _checked(self, group: str) -> motion.Group:
        if not self._model.has_group(group):
            raise MoveItCommanderException(f"There is no group named {group}")
        return self._model.group(group)

    def get_group_names(self) -> list[str]:
        return list(self._model.groups)

    def get_current_state(self) -> RobotState:
        """The whole robot now."""
        return states.robot_state_message(self._state())

    def get_current_variable_values(self) -> dict[str, float]:
        return {name: float(value) for name, value in self._state().as_dict().items()}

    def get_joint(self, name: str) -> RobotCommander.Joint:
        """The joint ``name``. :raises MoveItCommanderException: there is none"""
        if not self._model.has_joint(name):
            raise MoveItCommanderException(f"There is no joint named {name}")
        return self.Joint(self, name)

    def get_link(self, name: str) -> RobotCommander.Link:
        """The link ``name``. :raises MoveItCommanderException: there is none"""
        if not self._model.has_link(name):
            raise MoveItCommanderException(f"There is no link named {name}")
        return self.Link(self, name)

    def get_group(self, name: str) -> MoveGroupCommander:
        """The commander of the group ``name``, made once. :raises MoveItCommanderException: there is no such group"""
        if name not in self._groups:
            self._checked(name)
            self._groups[name] = MoveGroupCommander(name, self._robot_description, self._ns)
        return self._groups[name]

    def has_group(self, name: str) -> bool:
        """Whether the SRDF has the group ``name``."""
        return self._model.has_group(name)

    def get_default_owner_group(self, joint_name: str) -> str | None:
        """The group with the fewest links that has the joint ``joint_name``; None if there is none."""
        owners = [name for name in self._model.groups if joint_name in self._model.group(name).joints]
        return min(owners, key=lambda name: len(self._model.group(name).links), default=None)

    def __getattr__(self, name: str):
        model = self.__dict__.get("_model")
        if model is not None:
            if model.has_group(name):
                return self.get_group(name)
            if model.has_joint(name):
                return self.Joint(self, name)
            if model.has_link(name):
                return self.Link(self, name)
        rospy.logdebug("the robot has no group, joint or link '%s'", name)
        raise AttributeError(f"'RobotCommander' object has no attribute '{name}', and the robot no group, joint or link of that name")
