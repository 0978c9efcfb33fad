"""The robot from the parameter server: description, semantics, limits, kinematics, padding."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import motion
import rospkg
import rospy
from moveit_core.errors import MoveItError, one_line
from node_signals.parameters import number_or

from . import solvers
from .parameters import joint_limits, table


class DescriptionError(MoveItError):
    """The robot cannot be loaded; one line saying which parameter, why and what to do."""


@dataclass
class Kinematics:
    """What kinematics.yaml says about one group. Seconds, metres, radians."""

    solver: str
    timeout: float = 0.5
    joint_tolerance: float = 1e-4
    position_tolerance: float = 1e-4
    orientation_tolerance: float = 1e-3
    position_only: bool = False
    epsilon: float = 1e-5
    links: list[str] = field(default_factory=list)
    resolution: float = 0.1


@dataclass
class RobotDescription:
    """A robot as the parameters describe it. ``name`` is the resolved parameter of the URDF."""

    name: str
    model: motion.RobotModel
    kinematics: dict[str, Kinematics]
    urdf: str
    srdf: str
    joint_limits: dict[str, dict[str, Any]] = field(default_factory=dict)

    def planning(self, key: str, default: Any) -> Any:
        """Parameter ``key`` below ``<name>_planning``, or ``default``."""
        return rospy.get_param(f"{self.name}_planning/{key}", default)

    def solved_parts(self, group: str) -> list[str]:
        """Groups with a kinematics solver whose joints are all among those of ``group``, itself left out."""
        whole = set(self.model.group(group).active_joints)
        return [name for name in self.kinematics if name != group and whole.issuperset(self.model.group(name).active_joints)]


def resolve(name: str) -> str:
    """The full name of a description parameter: searched upward from the node's private namespace, as upstream does."""
    if name.startswith("/"):
        return name
    found = None if rospy.get_name() in ("", "/unnamed") else rospy.search_param(name)
    return found or rospy.resolve_name(name)


def load(
    name: str = "robot_description", meshes: bool = True, own_namespace: str | None = "~", compiled_solvers: bool = False
) -> RobotDescription:
    """Read a robot from the parameter server.

    :param name: of the parameter with the URDF. :param meshes: read them; without, links collide with nothing.
    :param own_namespace: where ``<group>/kinematics_solver`` is looked up first.
    :param compiled_solvers: let compiled plugins that kinematics.yaml names solve inverse kinematics.
    :raises DescriptionError: no or an unusable description.
    """
    where = resolve(name)
    urdf = rospy.get_param(where, None)
    if not urdf or not isinstance(urdf, str):
        raise DescriptionError(
            f"Robot model parameter not found! Did you remap '{name}'? '{where}' is "
            f"{'empty' if urdf is not None else 'not set'}: load the robot first "
            f"(planning_context.launch "
            f"with load_robot_description:=true, or the launch file that starts the robot)"
        )
    srdf = rospy.get_param(f"{where}_semantic", None)
    if not srdf:
        rospy.logerr(
            "Could not find parameter '%s_semantic': the robot has no planning groups. Load the SRDF there, "
            "as "
            "planning_context.launch does",
            where,
        )
    limits = joint_limits(f"{where}_planning/joint_limits")
    try:
        model = motion.load_model(urdf, srdf or None, joint_limits=limits, find_package=Packages().directory, meshes=meshes)
    except (motion.MotionError, ValueError, LookupError) as error:
        raise DescriptionError(f"the robot description in {where} cannot be used: {one_line(error, 400)}") from error
    for warning in model.warnings:
        kind, _, rest = warning.partition("error: ")
        (rospy.logwarn if kind or not rest else rospy.logerr)("%s", warning if kind or not rest else rest)
    description = RobotDescription(where, model, _kinematics(where, model, own_namespace), urdf, srdf or "", limits)
    if compiled_solvers:
        solvers.use_compiled(description)
    return description


class Packages:
    """Package directories, looked up once."""

    def __init__(self) -> None:
        self._rospack = rospkg.RosPack()

    def directory(self, name: str) -> str | None:
        """The folder of the package ``name``, or None."""
        try:
            return self._rospack.get_path(name)
        except rospkg.ResourceNotFound:
            return None


def _kinematics(where: str, model: motion.RobotModel, own_namespace: str | None) -> dict[str, Kinematics]:
    shared = table(f"{where}_kinematics")
    result = {}
    for group in model.groups:
        entry = shared.get(group, {})
        if own_namespace is not None and rospy.has_param(f"{own_namespace}{group}/kinematics_solver"):
            entry = rospy.get_param(f"{own_namespace}{group}")
        if not isinstance(entry, dict):
            rospy.logerr(
                "parameter %s_kinematics/%s is %s, where a table with kinematics_solver is expected: group '%s' has no kinematics",
                where,
                group,
                one_line(repr(entry), 60),
                group,
            )
            continue
        if entry.get("kinematics_solver"):
            result[group] = _group_kinematics(f"{where}_kinematics/{group}", entry)
    unknown = [name for name in shared if name not in model.groups]
    if unknown:
        rospy.logwarn(
            "kinematics.yaml (%s_kinematics) names %s, which the robot '%s' has no group for; its groups: %s",
            where,
            ", ".join(f"'{name}'" for name in unknown),
            model.name,
            ", ".join(model.groups) or "none",
        )
    if model.groups and not result:
        rospy.logwarn(
            "No kinematics plugins defined. Fill and load kinematics.yaml! Goals given as poses will fail "
            "(%s_kinematics "
            "names no group of '%s')",
            where,
            model.name,
        )
    return result


def _group_kinematics(where: str, entry: dict[str, Any]) -> Kinematics:
    def read(key: str, default: float) -> float:
        return number_or(f"{where}/{key}", entry.get(key, default), default)

    links = entry.get("kinematics_solver_ik_links", [])
    return Kinematics(
        solver=_words(entry["kinematics_solver"]),
        timeout=read("kinematics_solver_timeout", 0.5),
        joint_tolerance=read("goal_joint_tolerance", 1e-4),
        position_tolerance=read("goal_position_tolerance", 1e-4),
        orientation_tolerance=read("goal_orientation_tolerance", 1e-3),
        position_only=bool(entry.get("position_only_ik", False)) or read("orientation_vs_position", 1.0) == 0.0,
        epsilon=read("epsilon", 1e-5),
        links=[str(link) for link in links] if isinstance(links, list) else [],
        resolution=read("kinematics_solver_search_resolution", 0.1),
    )


def _words(value: Any) -> str:
    return " ".join(str(one) for one in value) if isinstance(value, list) else str(value)


def prepare_scene(description: RobotDescription) -> motion.PlanningScene:
    """An empty scene of ``description``'s robot with the paddings and collision operations of the parameters."""
    scene = motion.PlanningScene(description.model)
    scene.name = "(noname)"
    model = description.model
    padding = _planning_number(description, "default_robot_padding", 0.0)
    scale = _planning_number(description, "default_robot_scale", 1.0)
    links = {name: padding for name in model.links}
    links.update(_numbers(description, "default_robot_link_padding", model))
    scales = {name: scale for name in model.links}
    scales.update(_numbers(description, "default_robot_link_scale", model))
    scene.set_padding({name: value for name, value in links.items() if model.link(name).has_geometry})
    scene.set_scale({name: value for name, value in scales.items() if model.link(name).has_geometry})
    _collision_operations(description, scene)
    return scene


def _numbers(description: RobotDescription, key: str, model) -> dict[str, float]:
    values = description.planning(key, {})
    if not isinstance(values, dict):
        return {}
    return {
        name: number_or(f"{description.name}_planning/{key}/{name}", value, 0.0 if "padding" in key else 1.0)
        for name, value in values.items()
        if model.has_link(name)
    }


def _planning_number(description: RobotDescription, key: str, default: float) -> float:
    return number_or(f"{description.name}_planning/{key}", description.planning(key, default), default)


def _collision_operations(description: RobotDescription, scene) -> None:
    operations = description.planning("default_collision_operations", [])
    if not isinstance(operations, list):
        rospy.logwarn("default_collision_operations is not an array")
        return
    matrix = scene.acm
    for entry in operations:
        try:
            matrix.set(entry["object1"], entry["object2"], entry["operation"] == "disable")
        except (KeyError, TypeError):
            rospy.logwarn("All collision operations must have two objects and an operation, not %s", one_line(repr(entry), 80))
    if operations:
        scene.set_acm(matrix)


def scaling_factors(description: RobotDescription) -> tuple[float, float]:
    """Default velocity and acceleration scaling of clients, by ``description``."""
    return (
        _planning_number(description, "default_velocity_scaling_factor", 0.1),
        _planning_number(description, "default_acceleration_scaling_factor", 0.1),
    )
