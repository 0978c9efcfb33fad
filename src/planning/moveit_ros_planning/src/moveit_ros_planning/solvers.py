"""Compiled inverse kinematics (vendors' plugins, generated IKFast packages) in the robots of Python programs."""

from __future__ import annotations

import rosgraph
import rospy
from moveit_core.errors import one_line
from plugin_loader import PluginClass, find_plugins

#: The package that exports the motion library's own solver under the names of MoveIt's: no detour over a plugin for that.
_OWN = "moveit_kinematics"
_BASE = "kinematics::KinematicsBase"


def use_compiled(description) -> None:
    """Let the plugins that kinematics.yaml names solve, as far as they are built; elsewhere the motion library does.

    :param description: a :class:`moveit_ros_planning.robot_model.RobotDescription`.
    """
    named = {group: settings.solver.split() for group, settings in description.kinematics.items()}
    if not any(named.values()):
        return
    exported, problems = find_plugins("moveit_core")
    for problem in problems:
        rospy.logwarn("%s", problem)
    for group, names in named.items():
        _group(description, group, names, exported)


def _group(description, group: str, names: list[str], exported: dict[str, PluginClass]) -> None:
    reasons = []
    for name in names:
        plugin = exported.get(name)
        if plugin is None or plugin.base != _BASE:
            reasons.append("no package here exports it")
            continue
        if plugin.package == _OWN:
            return
        try:
            _install(description, group, name)
            rospy.loginfo("Kinematics solver '%s' of package %s solves for group '%s'", name, plugin.package, group)
            return
        except Exception as error:  # a third party's code and its libraries: nothing of it may take the node down
            reasons.append(one_line(error, 300))
    if names:
        rospy.logwarn(
            "kinematics_solver '%s' of group '%s' cannot be used: the motion library's own takes its place (%s)",
            " ".join(names),
            group,
            reasons[0] if reasons else "",
        )


def _install(description, group: str, name: str) -> None:
    from . import _solvers  # type: ignore[attr-defined]  # compiled, and heavy: for those who need it only

    settings = description.kinematics[group]
    _solvers.install(
        description.model,
        description.urdf,
        description.srdf,
        group,
        name,
        description=description.name,
        tips=settings.links,
        resolution=settings.resolution,
        timeout=settings.timeout,
        node=rospy.get_name(),
        master=rosgraph.get_master_uri(),
    )
