"""A configuration from a short YAML file, for those who would rather type than click.

    groups:
      manipulator: {chain: [base_link, tool0], solver: kdl, planner: RRTConnect}
      gripper: {joints: [left_finger_joint, right_finger_joint]}
    poses:
      - {name: home, group: manipulator, joints: {shoulder_lift_joint: -1.57}}
    end_effectors:
      - {name: hand, group: gripper, parent_link: tool0}
    virtual_joints:
      - {name: fixed_base, type: fixed, parent_frame: world, child_link: base_link}
    passive_joints: [caster_joint]
    collisions: {trials: 10000, always: 0.95}
    controllers: auto                        # or a list of {name, type, joints or group}
    simulation: true                         # writes a URDF that is fit for simulation
    sensors: []
    author: {name: Ada Example, email: ada@example.org}

A group has ``chain`` [base, tip], ``joints``, ``links``, ``groups``, or several of these; keys of kinematics.yaml (timeout,
search_resolution, tolerances) may stand beside ``solver``.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import yaml
from srdfdom import srdf

from moveit_setup_assistant import collisions, planners
from moveit_setup_assistant.configuration import ACTION_TYPES, SOLVERS, TRAJECTORY_TYPES, Configuration, Controller, Kinematics
from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.robot_source import RobotSource
from moveit_setup_assistant.simulation import simulated_urdf

_SHORT_SOLVERS = {"kdl": SOLVERS[0], "lma": SOLVERS[1], "cached": SOLVERS[2], "trac_ik": SOLVERS[4]}
_KEYS = (
    "groups",
    "poses",
    "end_effectors",
    "virtual_joints",
    "passive_joints",
    "collisions",
    "controllers",
    "simulation",
    "sensors",
    "author",
)
_SOLVER_NUMBERS = ("timeout", "search_resolution", "goal_joint_tolerance", "goal_position_tolerance", "goal_orientation_tolerance")
_GROUP_KEYS = ("chain", "joints", "links", "groups", "solver", "planner", "parameters_file", *_SOLVER_NUMBERS)


class _Reader:
    """Takes values out of the file's mappings; every complaint names the file and the place."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def error(self, place: str, problem: str) -> AssistantError:
        return AssistantError(f"'{self.path}': {place}: {problem}")

    def mapping(self, value: Any, place: str, keys=None) -> dict[str, Any]:
        value = {} if value is None else value
        if not isinstance(value, dict):
            raise self.error(place, "must be a mapping (name: value)")
        for key in value:
            if keys is not None and key not in keys:
                raise self.error(place, f"'{key}' is not known; there are: {', '.join(keys)}")
        return value

    def names(self, value: Any, place: str, count: int | None = None) -> list[str]:
        value = [] if value is None else value
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            raise self.error(place, "must be a list of names")
        if count is not None and len(value) != count:
            raise self.error(place, f"must have {count} names, not {len(value)}")
        return value

    def entries(self, value: Any, place: str, required, optional=()) -> list[dict[str, Any]]:
        value = [] if value is None else value
        if not isinstance(value, list):
            raise self.error(place, "must be a list")
        for index, entry in enumerate(value):
            self.mapping(entry, f"{place}[{index}]", (*required, *optional))
            for key in required:
                if key not in entry:
                    raise self.error(f"{place}[{index}]", f"'{key}' is missing")
        return value

    def number(self, value: Any, place: str) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float)) or value != value or abs(value) == float("inf"):
            raise self.error(place, f"'{value}' is no number")
        return float(value)


def configuration(source: RobotSource, path: Path, progress: Callable[[float], bool] | None = None) -> Configuration:
    """The configuration that the file ``path`` describes for the robot of ``source``; collisions are computed.

    :param progress: as :func:`collisions.compute_disabled` takes it
    :raises AssistantError: the robot or the file cannot be used; one line that names the place.
    """
    path, reader = Path(path), _Reader(Path(path))
    try:
        values = yaml.safe_load(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise AssistantError(f"'{path}' cannot be read: {error.strerror}") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise AssistantError(f"'{path}' is no YAML: {' '.join(str(error).split())[:200]}") from error
    values = reader.mapping(values, "the file", _KEYS)
    config = Configuration.new(source)
    _groups(config, reader, reader.mapping(values.get("groups"), "groups"))
    _rest_of_semantics(config, reader, values)
    problems = config.semantics.problems(config.robot.model)
    if problems:
        raise AssistantError(f"'{path}': " + "; ".join(problems))
    _controllers(config, reader, values.get("controllers", "auto"))
    config.sensors = reader.entries(values.get("sensors"), "sensors", ("sensor_plugin",), _AnyKey())
    author = reader.mapping(values.get("author"), "author", ("name", "email"))
    config.author_name, config.author_email = str(author.get("name") or ""), str(author.get("email") or "")
    if values.get("simulation"):
        config.gazebo_urdf = simulated_urdf(config.robot.urdf, config.controllers)
    wanted = reader.mapping(values.get("collisions"), "collisions", ("trials", "always", "seed"))
    set_collisions(
        config,
        collisions.compute_disabled(
            config.robot.model,
            int(reader.number(wanted.get("trials", 10000), "collisions: trials")),
            reader.number(wanted.get("always", 0.95), "collisions: always"),
            int(wanted.get("seed", 1)),
            progress=progress,
        ),
    )
    return config


class _AnyKey(tuple):
    """Stands for "any further keys": a sensor's parameters are its plugin's."""

    def __contains__(self, _key: object) -> bool:
        return True


def set_collisions(config: Configuration, reasons: dict[collisions.Pair, str]) -> None:
    """Replace the disabled collisions of the SRDF of ``config`` by the pairs of ``reasons``."""
    config.semantics.disable_collisionss = [srdf.DisableCollisions(one, other, reason) for (one, other), reason in sorted(reasons.items())]


def _groups(config: Configuration, reader: _Reader, groups: dict[str, Any]) -> None:
    for name, entry in groups.items():
        place = f"groups: {name}"
        entry = reader.mapping(entry, place, _GROUP_KEYS)
        group = srdf.Group(str(name))
        if "chain" in entry:
            group.chains.append(srdf.Chain(*reader.names(entry["chain"], f"{place}: chain", 2)))
        group.joints += [srdf.Joint(joint) for joint in reader.names(entry.get("joints"), f"{place}: joints")]
        group.links += [srdf.Link(link) for link in reader.names(entry.get("links"), f"{place}: links")]
        group.groups += [srdf.Group(other) for other in reader.names(entry.get("groups"), f"{place}: groups")]
        config.semantics.add_group(group)
        solver = entry.get("solver")
        if solver:
            solved = Kinematics(solver=_SHORT_SOLVERS.get(str(solver), str(solver)))
            for key in _SOLVER_NUMBERS:
                if key in entry:
                    setattr(solved, key, reader.number(entry[key], f"{place}: {key}"))
            solved.parameters_file = str(entry.get("parameters_file") or "")
            config.kinematics[group.name] = solved
        planner = entry.get("planner")
        if planner and planner not in planners.PARAMETERS:
            raise reader.error(f"{place}: planner", f"'{planner}' is not known; there are: {', '.join(planners.names())}")
        if planner:
            config.default_planners[group.name] = str(planner)


def _rest_of_semantics(config: Configuration, reader: _Reader, values: dict[str, Any]) -> None:
    document = config.semantics
    for entry in reader.entries(values.get("poses"), "poses", ("name", "group", "joints")):
        state = srdf.GroupState(str(entry["name"]), str(entry["group"]))
        for joint, value in reader.mapping(entry["joints"], f"poses: {entry['name']}: joints").items():
            state.joints.append(srdf.JointVal(str(joint), [reader.number(value, f"poses: {entry['name']}: {joint}")]))
        document.add_group_state(state)
    for entry in reader.entries(values.get("end_effectors"), "end_effectors", ("name", "group", "parent_link"), ("parent_group",)):
        document.end_effectors.append(srdf.EndEffector(entry["name"], entry["group"], entry["parent_link"], entry.get("parent_group")))
    for entry in reader.entries(values.get("virtual_joints"), "virtual_joints", ("name", "type", "parent_frame", "child_link")):
        if entry["type"] not in ("fixed", "floating", "planar"):
            raise reader.error(f"virtual_joints: {entry['name']}", f"type '{entry['type']}' is none of fixed, floating, planar")
        document.virtual_joints.append(srdf.VirtualJoint(entry["name"], entry["child_link"], entry["parent_frame"], entry["type"]))
    for name in reader.names(values.get("passive_joints"), "passive_joints"):
        document.add_passive_joint(srdf.PassiveJoint(name))


def _controllers(config: Configuration, reader: _Reader, wanted: Any) -> None:
    if wanted == "auto":
        config.add_default_controllers()
        return
    model = config.model()
    for entry in reader.entries(wanted, "controllers", ("name", "type"), ("joints", "group")):
        place = f"controllers: {entry['name']}"
        joints = reader.names(entry.get("joints"), place)
        if entry.get("group"):
            if not model.has_group(entry["group"]):
                raise reader.error(place, f"there is no group '{entry['group']}'")
            joints = list(model.group(entry["group"]).active_joints)
        if not joints:
            raise reader.error(place, "has no joints; give it 'joints' or a 'group'")
        if entry["type"] not in (*TRAJECTORY_TYPES, *ACTION_TYPES) and "/" not in str(entry["type"]):
            raise reader.error(
                place, f"type '{entry['type']}' is not known; usual ones are {', '.join((*TRAJECTORY_TYPES, *ACTION_TYPES))}"
            )
        config.controllers.append(Controller(str(entry["name"]), str(entry["type"]), joints))
