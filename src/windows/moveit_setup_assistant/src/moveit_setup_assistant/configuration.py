"""A MoveIt configuration package as data: what the screens edit, what the generator writes, what a package on disk holds."""

from __future__ import annotations

import copy
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from moveit_setup_assistant.errors import AssistantError, files_told
from moveit_setup_assistant.robot_source import Robot, RobotSource
from moveit_setup_assistant.semantics import Semantics

MARKER = ".setup_assistant"
SOLVERS = (
    "kdl_kinematics_plugin/KDLKinematicsPlugin",
    "lma_kinematics_plugin/LMAKinematicsPlugin",
    "cached_ik_kinematics_plugin/CachedKDLKinematicsPlugin",
    "cached_ik_kinematics_plugin/CachedTRACKinematicsPlugin",
    "trac_ik_kinematics_plugin/TRAC_IKKinematicsPlugin",
    "srv_kinematics_plugin/SrvKinematicsPlugin",
)
TRAJECTORY_TYPES = (
    "effort_controllers/JointTrajectoryController",
    "position_controllers/JointTrajectoryController",
    "velocity_controllers/JointTrajectoryController",
)
ACTION_TYPES = {"FollowJointTrajectory": "follow_joint_trajectory", "GripperCommand": "gripper_action"}

SUBSTITUTED = "$("  # roslaunch fills such names in, with rosparam's subst_value


@dataclass
class Kinematics:
    """One group's entry of kinematics.yaml; ``solver`` "" means that poses of the group are not solved."""

    solver: str = ""
    search_resolution: float = 0.005
    timeout: float = 0.005
    goal_joint_tolerance: float = 1e-4
    goal_position_tolerance: float = 1e-4
    goal_orientation_tolerance: float = 1e-3
    parameters_file: str = ""
    others: dict[str, Any] = field(default_factory=dict)  # keys of solvers that this program does not know

    _KEYS = {
        "kinematics_solver": "solver",
        "kinematics_solver_search_resolution": "search_resolution",
        "kinematics_solver_timeout": "timeout",
        "goal_joint_tolerance": "goal_joint_tolerance",
        "goal_position_tolerance": "goal_position_tolerance",
        "goal_orientation_tolerance": "goal_orientation_tolerance",
    }

    @classmethod
    def from_mapping(cls, values: dict[str, Any]) -> Kinematics:
        """The entry of kinematics.yaml."""
        made = cls()
        for key, value in values.items():
            if key in cls._KEYS:
                setattr(made, cls._KEYS[key], value)
            else:
                made.others[key] = value
        return made

    def to_mapping(self) -> dict[str, Any]:
        """The entry of kinematics.yaml."""
        return {**{key: getattr(self, name) for key, name in self._KEYS.items()}, **self.others}


@dataclass
class Controller:
    """One controller: of ros_control, or an action that somebody else serves (a type of ACTION_TYPES)."""

    name: str
    type: str
    joints: list[str] = field(default_factory=list)

    @property
    def is_action(self) -> bool:
        """Whether move_group only calls it, and nobody here starts it."""
        return self.type in ACTION_TYPES

    @property
    def action(self) -> str:
        """The type of the action through which move_group sends it motions; "" for one of ros_control that has none."""
        return "FollowJointTrajectory" if self.type.endswith("/JointTrajectoryController") else self.type if self.is_action else ""


@dataclass
class Configuration:
    """Everything a configuration package says of one robot."""

    source: RobotSource
    robot: Robot
    semantics: Semantics
    kinematics: dict[str, Kinematics] = field(default_factory=dict)
    default_planners: dict[str, str] = field(default_factory=dict)
    controllers: list[Controller] = field(default_factory=list)
    sensors: list[dict[str, Any]] = field(default_factory=list)
    gazebo_urdf: str = ""
    author_name: str = ""
    author_email: str = ""
    srdf_path: str = ""  # below the package; "" for config/<robot>.srdf
    generated_timestamp: int = 0
    warnings: list[str] = field(default_factory=list)

    @classmethod
    def new(cls, source: RobotSource) -> Configuration:
        """An empty configuration of the robot.

        :raises AssistantError: the description cannot be loaded.
        """
        robot = source.load()
        return cls(source, robot, Semantics(robot.name), warnings=list(robot.warnings))

    @classmethod
    @files_told()
    def load(cls, package: Path) -> Configuration:
        """The configuration that a package of MoveIt's assistant, or of this one, holds.

        :raises AssistantError: the folder is no such package, or one of its files cannot be read.
        """
        package = Path(package)
        marker = package / MARKER
        if not marker.is_file():
            raise AssistantError(f"'{package}' has no file {MARKER}: it is no package that a setup assistant made")
        values = _read(marker).get("moveit_setup_assistant_config") or {}
        urdf, author = values.get("URDF") or {}, values.get("CONFIG") or {}
        srdf = (values.get("SRDF") or {}).get("relative_path") or ""
        made = cls.new(RobotSource(urdf.get("package") or "", urdf.get("relative_path") or "", str(urdf.get("xacro_args") or "")))
        made.srdf_path = srdf
        made.semantics = Semantics.load(package / made.srdf_file, made.source.xacro_args)
        made.author_name, made.author_email = str(author.get("author_name") or ""), str(author.get("author_email") or "")
        made.generated_timestamp = written_at(package)
        made._load_yaml(package / "config")
        return made

    def _load_yaml(self, config: Path) -> None:
        kinematics = _read(config / "kinematics.yaml", optional=True)
        self.kinematics = {name: Kinematics.from_mapping(values) for name, values in kinematics.items() if isinstance(values, dict)}
        planning = _read(config / "ompl_planning.yaml", optional=True)
        self.default_planners = {
            group.name: str(planning[group.name]["default_planner_config"])
            for group in self.semantics.groups
            if isinstance(planning.get(group.name), dict) and planning[group.name].get("default_planner_config")
        }
        self.sensors = [s for s in _read(config / "sensors_3d.yaml", optional=True).get("sensors") or [] if isinstance(s, dict) and s]
        self.controllers = _controllers(config)
        gazebo = config / f"gazebo_{self.robot.name}.urdf"
        self.gazebo_urdf = gazebo.read_text(encoding="utf-8") if gazebo.is_file() else ""

    @property
    def srdf_file(self) -> str:
        """The SRDF's path below the package."""
        return self.srdf_path or f"config/{self.robot.name}.srdf"

    def model(self):
        """The robot with these groups, states and end effectors.

        :raises AssistantError: the SRDF does not fit.
        """
        return self.robot.with_srdf(self.semantics.to_text())

    def add_default_controllers(self, kind: str = TRAJECTORY_TYPES[0]) -> None:
        """Add :meth:`default_controllers`."""
        self.controllers += self.default_controllers(kind)

    def default_controllers(self, kind: str = TRAJECTORY_TYPES[0]) -> list[Controller]:
        """A trajectory controller for every group that moves joints which no controller moves yet.

        :raises AssistantError: the SRDF does not fit.
        """
        model = self.model()
        made: list[Controller] = []
        taken = {joint for controller in self.controllers for joint in controller.joints}
        for group in self.semantics.groups:
            if not model.has_group(group.name):
                continue
            joints = list(model.group(group.name).active_joints)
            if joints and not taken.intersection(joints):
                taken.update(joints)
                made.append(Controller(f"{group.name}_controller", kind, joints))
        return made

    def contents(self) -> tuple:
        """What the screens edit, in a copy: equal to that of another time if nothing has been changed."""
        edited = (
            self.kinematics,
            self.default_planners,
            self.controllers,
            self.sensors,
            self.gazebo_urdf,
            self.author_name,
            self.author_email,
        )
        return self.semantics.to_text(), *copy.deepcopy(edited)

    def problems(self) -> list[str]:
        """What must be mended before a package can be written, one line each."""
        found = self.semantics.problems(self.robot.model)
        if not self.author_name.strip() or "@" not in self.author_email.strip("@ "):
            found.append("the author's name and e-mail address are missing: package.xml needs both")
        joints = set(self.robot.model.joints)
        for controller in self.controllers:
            found += [
                f"controller '{controller.name}' names the joint '{joint}', which the robot does not have"
                for joint in controller.joints
                if joint not in joints and SUBSTITUTED not in joint
            ]
            if not controller.name or any(c.isspace() for c in controller.name) and SUBSTITUTED not in controller.name:
                found.append(f"controller '{controller.name}' has a name with blanks, or none; use letters, digits and _")
        for group in self.semantics.groups:
            if not group.name or any(c.isspace() for c in group.name):
                found.append(f"group '{group.name}' has a name with blanks, or none; use letters, digits and _")
        return found

    def incomplete(self) -> list[str]:
        """What most robots need and this one lacks; a package can be written all the same."""
        found = [] if self.semantics.groups else ["There is no planning group: nothing can be planned."]
        if not self.semantics.disable_collisionss:
            found.append("No collisions are disabled: planning is slow, and touching links may forbid every motion.")
        if not self.semantics.end_effectors:
            found.append("There is no end effector; pick and place, and RViz's marker at a gripper, want one.")
        if not self.semantics.virtual_joints:
            found.append("There is no virtual joint; the robot's root link is then the planning frame.")
        return found + self.semantics.unreachable_poses(self.model())


def written_at(package: Path) -> int:
    """When an assistant last wrote the package, seconds since 1970; 0 if that is not known."""
    values = _read(package / MARKER, optional=True).get("moveit_setup_assistant_config") or {}
    try:
        return int((values.get("CONFIG") or {}).get("generated_timestamp") or 0)
    except (TypeError, ValueError, AttributeError):
        return 0


def _controllers(config: Path) -> list[Controller]:
    """Those of the folder ``config``, in an order that both files keep; one of ros_control is in both files, and one controller."""
    actions = _entries(_read(config / "simple_moveit_controllers.yaml", optional=True).get("controller_list"))
    running = _read(config / "ros_controllers.yaml", optional=True)
    started = _entries([{**c, "name": name} for name, c in running.items() if isinstance(c, dict) and "joints" in c])
    known = {c.name for c in started if c.action == "FollowJointTrajectory"}
    listed = [*actions, *_entries(running.get("controller_list"))]
    rest = list({c.name: c for c in reversed(listed)}.values())[::-1]
    merged: list[Controller] = []
    for controller in started:
        if any(c.name == controller.name for c in rest) and controller.name in known:
            while rest[0].name != controller.name:
                entry = rest.pop(0)
                merged += [] if entry.name in known else [entry]
            rest.pop(0)
        merged.append(controller)
    return merged + [c for c in rest if c.name not in known]


def _entries(listed: Any) -> list[Controller]:
    """The controllers of a list of tables; ``joints`` may be the name of a single one."""
    made = []
    for entry in listed if isinstance(listed, list) else []:
        if isinstance(entry, dict) and entry.get("name") and entry.get("type"):
            joints = entry.get("joints") or []
            names = joints if isinstance(joints, list) else [joints]
            made.append(Controller(str(entry["name"]), str(entry["type"]), [str(name) for name in names]))
    return made


def _read(path: Path, optional: bool = False) -> dict[str, Any]:
    """The mapping of a YAML file; ``{}`` if an optional one is missing."""
    try:
        values: Any | None = yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as error:
        if optional:
            return {}
        raise AssistantError(f"'{path}' cannot be read: {error.strerror}") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise AssistantError(f"'{path}' is no YAML: {' '.join(str(error).split())[:200]}") from error
    if values is None:
        return {}
    if not isinstance(values, dict):
        raise AssistantError(f"'{path}' holds no mapping at its top")
    return values
