"""Which controllers execute a trajectory, and each one's share of it."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import rospy
from moveit_core.controller_manager import ControllerManager
from moveit_core.errors import one_line
from moveit_msgs.msg import RobotTrajectory
from plugin_loader import PluginError, find_plugins
from trajectory_msgs.msg import JointTrajectoryPoint, MultiDOFJointTrajectoryPoint

_SIMPLE = "moveit_simple_controller_manager/MoveItSimpleControllerManager"
_WORDS = {
    "simple": _SIMPLE,
    "fake": "moveit_fake_controller_manager/MoveItFakeControllerManager",
    "ros_control": "moveit_ros_control_interface::MoveItControllerManager",
}


def load_manager(model, namespace: str = "~") -> ControllerManager | None:
    """The controller manager that ``~moveit_controller_manager`` names; None (and an error line) if there is none.

    :param model: the robot. :param namespace: where the parameter is.
    """
    found, problems = find_plugins("moveit_core")
    parameter = rospy.resolve_name(namespace + "moveit_controller_manager")
    name = rospy.get_param(namespace + "moveit_controller_manager", "")
    managers = {known: plugin for known, plugin in found.items() if plugin.base.endswith("MoveItControllerManager")}
    if name and not isinstance(name, str):
        rospy.logerr(
            "parameter %s is %s, where the name of a controller manager is expected: trajectories are planned, but cannot be executed",
            parameter,
            one_line(repr(name), 60),
        )
        return None
    if not name:
        rospy.logerr(
            "Failed to load any controller manager: parameter %s is not set (trajectory_execution.launch.xml "
            "sets it). "
            "Trajectories are planned, but cannot be executed",
            parameter,
        )
        return None
    if name not in managers and _meant(name, namespace) in managers:
        rospy.logwarn(
            "parameter %s is '%s', which is no controller manager; it is taken for the word by which "
            "trajectory_execution.launch.xml chooses a file: %s is used",
            parameter,
            name,
            _meant(name, namespace),
        )
        name = _meant(name, namespace)
    if name not in managers:
        rospy.logerr("Exception while loading controller manager '%s': nobody exports it; there are: %s", name, ", ".join(sorted(managers)))
        for problem in problems:
            rospy.logwarn("%s", problem)
        return None
    try:
        return managers[name].load()(model, namespace)
    except PluginError as error:
        rospy.logerr("Exception while loading controller manager '%s': %s", name, error)
        return None


def _meant(name: str, namespace: str) -> str:
    """The manager behind a word of launch files: trajectory_execution.launch.xml passes on "simple", "fake" or the robot's name,
    with which it finds the next file, under the very argument in which that file may have its manager as a default."""
    if "/" in name or "::" in name:  # somebody's class
        return ""
    return _WORDS.get(name, _SIMPLE if rospy.get_param(namespace + "controller_list", None) else "")


class ControllerChoice:
    """Chooses controllers by upstream's rules: as few as possible, then defaults, few joints, active ones."""

    def __init__(self, model, manager: ControllerManager, manage: bool):
        self._model = model
        self._manager = manager
        self._manage = manage

    def actuated(self, trajectory: RobotTrajectory) -> set[str]:
        """Joints of a trajectory that need a controller: not fixed, mimic or passive."""
        names = [*trajectory.joint_trajectory.joint_names, *trajectory.multi_dof_joint_trajectory.joint_names]
        return {name for name in names if self._model.has_joint(name) and self._is_actuated(self._model.joint(name))}

    @staticmethod
    def _is_actuated(joint) -> bool:
        return not joint.passive and joint.mimic is None and joint.type != "fixed"

    def choose(self, wanted: set[str], allowed: Sequence[str] = ()) -> list[str]:
        """Names of the controllers, of those ``allowed`` (none named: all), that together move the joints ``wanted``; empty if none do."""
        names = sorted(allowed or self._manager.controllers())
        joints = {name: set(self._manager.joints(name)) for name in names}
        useful = [name for name in names if joints[name] & wanted]
        fallback: list[str] = []
        for count in range(1, len(useful) + 1):
            options = [list(option) for option in itertools.combinations(useful, count) if self._covers(option, joints, wanted)]
            options.sort(key=lambda option: self._rank(option, joints))
            if options and self._manage:
                return options[0]
            for option in options:  # without the right to switch, what is active already is preferred
                if all(self._manager.is_active(name) for name in option):
                    return option
            fallback = fallback or (options[0] if options else [])
        return fallback

    @staticmethod
    def _covers(option: Sequence[str], joints: dict[str, set[str]], wanted: set[str]) -> bool:
        covered: set[str] = set()
        for name in option:
            if covered & joints[name]:
                return False
            covered |= joints[name]
        return wanted <= covered

    def _rank(self, option: Sequence[str], joints: dict[str, set[str]]):
        return (
            -sum(self._manager.is_default(name) for name in option),
            sum(len(joints[name]) for name in option),
            -sum(self._manager.is_active(name) for name in option),
            list(option),
        )

    def activate(self, controllers: Sequence[str]) -> bool:
        """Make ``controllers`` active, and inactive those that hold their joints, where this node may switch at all."""
        idle = [name for name in controllers if not self._manager.is_active(name)]
        if not idle:
            return True
        if not self._manage:
            return False
        joints = {joint for name in idle for joint in self._manager.joints(name)}
        holders = [
            name for name in self._manager.active_controllers() if name not in controllers and joints & set(self._manager.joints(name))
        ]
        return self._manager.switch(idle, holders)


def share(trajectory: RobotTrajectory, joints: Sequence[str], scaling: float = 1.0) -> RobotTrajectory:
    """The part of ``trajectory`` that moves ``joints``, which come in alphabetical order; velocities times
    ``scaling``."""
    part = RobotTrajectory()
    source, target = trajectory.joint_trajectory, part.joint_trajectory
    mine = sorted(set(joints) & set(source.joint_names))
    if mine:
        columns = [source.joint_names.index(name) for name in mine]
        target.header, target.joint_names = source.header, mine
        target.points = [_point(point, columns, scaling) for point in source.points]
    source, target = trajectory.multi_dof_joint_trajectory, part.multi_dof_joint_trajectory
    mine = sorted(set(joints) & set(source.joint_names))
    if mine:
        columns = [source.joint_names.index(name) for name in mine]
        target.header, target.joint_names = source.header, mine
        target.points = [
            MultiDOFJointTrajectoryPoint(transforms=[point.transforms[i] for i in columns], time_from_start=point.time_from_start)
            for point in source.points
        ]
    return part


def _point(point: JointTrajectoryPoint, columns: Sequence[int], scaling: float) -> JointTrajectoryPoint:
    def pick(values, factor=1.0):
        return [values[i] * factor for i in columns] if len(values) else []

    return JointTrajectoryPoint(
        pick(point.positions), pick(point.velocities, scaling), pick(point.accelerations), pick(point.effort), point.time_from_start
    )
