"""``new``: a first spec for a launch file, of what the file itself tells: packages, models, joints, controllers, nodes. With a comment to
each line that a teacher will want to change."""

from __future__ import annotations

import argparse
import math
import pathlib
import re
import shlex
import sys
import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

import lenient_xml

from ..errors import LabError
from ..examination.window_nodes import is_window

_MOVING = ("revolute", "continuous", "prismatic")
_STATES = "joint_state_controller/JointStateController"


class NewError(LabError, ValueError):
    """No spec can be written for this launch file; one line with the reason."""


@dataclass
class Joint:
    name: str
    type: str
    goal: float  # rad or m, within its limits


@dataclass
class Found:
    """What a launch file starts."""

    package: str
    launch: str
    model: str = ""
    joints: list[Joint] = field(default_factory=list)
    transmissions: int = 0
    description: str = ""  # the parameter
    controllers: dict[str, str] = field(default_factory=dict)  # name with its namespace -> type
    joint_of: dict[str, str] = field(default_factory=dict)  # controller -> its joint
    joints_of: dict[str, list[str]] = field(default_factory=dict)  # controller -> its joints
    driven_by: str = ""  # topic of a plugin that drives a base
    nodes: list[str] = field(default_factory=list)  # names of those that are no spawner and not the simulator
    packages: list[str] = field(default_factory=list)


def look(package: str, file: str, arguments: list[str]) -> Found:
    """What the launch file ``file`` of ``package`` with ``arguments`` (``name:=value``) tells.

    :raises NewError: roslaunch cannot read it
    """
    import roslaunch
    import rospkg

    try:
        path = roslaunch.rlutil.resolve_launch_arguments([package, file])[0]
        config = roslaunch.config.ROSLaunchConfig()
        roslaunch.xmlloader.XmlLoader().load(path, config, argv=arguments, verbose=False)
    except (roslaunch.RLException, rospkg.ResourceNotFound, OSError) as error:
        raise NewError(f"{package} {file} cannot be read: {' '.join(str(error).split())[:400]}") from error
    found = Found(package, " ".join([package, file, *arguments]))
    parameters = {name: parameter.value for name, parameter in config.params.items()}
    for name, value in sorted(parameters.items()):
        if name.endswith("robot_description") and isinstance(value, str) and not found.joints:
            _describe(found, name, value)
    spawned: list[str] = []
    for node in config.nodes:
        words = shlex.split(node.args or "")
        if node.type == "spawn_model":
            found.model = found.model or next((b for a, b in zip(words, words[1:]) if a == "-model"), "")
        elif node.package == "controller_manager":
            spawned += [_joined(node.namespace, word) for word in words if not word.startswith("-")]
        elif node.package != "gazebo_ros" and not is_window(node.package, node.type):
            found.nodes.append(_joined(node.namespace, node.name))
    found.controllers = {name: str(parameters.get(f"{name}/type", "")) for name in spawned if f"{name}/type" in parameters}
    found.joint_of = {name: str(parameters.get(f"{name}/joint", "")) for name in found.controllers}
    found.joints_of = {name: [str(one) for one in parameters.get(f"{name}/joints", [])] for name in found.controllers}
    files = [name for file in config.roslaunch_files if (name := rospkg.get_package_name(file))]
    found.packages = _own_packages(package, [node.package for node in config.nodes] + files)
    return found


def _joined(namespace: str, name: str) -> str:
    return name if name.startswith("/") else f"{namespace.rstrip('/')}/{name}"


def _own_packages(package: str, named: list[str]) -> list[str]:
    """Those of the launch file that lie in the folder of its own package's, as packages of one submission do."""
    import rospkg

    rospack = rospkg.RosPack()
    beside = pathlib.Path(rospack.get_path(package)).parent
    return sorted({package} | {name for name in named if name in rospack.list() and pathlib.Path(rospack.get_path(name)).parent == beside})


def _describe(found: Found, parameter: str, text: str) -> None:
    try:
        robot = lenient_xml.fromstring(text)
    except (ET.ParseError, ValueError) as error:
        raise NewError(f"the parameter {parameter} is no XML: {error}") from error
    found.description, found.model = parameter, found.model or robot.get("name", "")
    found.transmissions = len(robot.findall("transmission"))
    for plugin in robot.iter("plugin"):
        if "_drive" in (plugin.get("filename") or "") and plugin.find("commandTopic") is not None:
            found.driven_by = "/" + (plugin.findtext("commandTopic") or "cmd_vel").strip().strip("/")
    for joint in robot.findall("joint"):
        if joint.get("type") in _MOVING and joint.find("mimic") is None:
            found.joints.append(Joint(joint.get("name", ""), joint.get("type", ""), _goal(joint)))


def _goal(joint: ET.Element) -> float:
    """A place that it can reach: 0.5, or half of its way where that is less."""
    limit = joint.find("limit")
    if limit is None:
        return 0.5
    try:
        low, high = float(limit.get("lower", "")), float(limit.get("upper", ""))
    except ValueError:
        return 0.5
    if joint.get("type") == "continuous" or low <= 0.5 <= high:
        return 0.5
    goal = 0.5 * high if high > 0 else 0.5 * (low + high)
    return round(goal, 2 - int(math.floor(math.log10(abs(goal))))) if goal else 0.0


def text(found: Found) -> str:
    """The spec for what was ``found``."""
    lines = [
        f"# Written for: roslaunch {found.launch}. All of it can be changed;",
        "# docs/grading.md has a line for everything that can be asked.",
        f"title: {_quoted(f'Homework: {found.package}')}",
        f"packages: [{', '.join(found.packages)}]   # that a submission must hold, and that must build",
        "build: {points: 10}   # shared by the packages",
        "quantum: 0.05   # s of simulated time between two looks: no longer than the period of the fastest loop that is judged",
        f"launch: {found.launch}",
        *_ready(found),
        "tasks:",
    ]
    for part in (_description, _controllers, _movement, _nodes):
        lines += part(found)
    lines += [
        "  - name: Nothing complains",
        "    points: 5",
        "    expect:",
        '      - no_errors: {}   # ignore: ["No p gain"] leaves lines out, by regular expressions',
    ]
    return "\n".join(lines) + "\n"


def _ready(found: Found) -> list[str]:
    parts = [f"models: [{_quoted(found.model)}]"] if found.model else []
    parts.append("at: 2")
    return [f"ready: {{{', '.join(parts)}}}   # what must be there before the first task, and at which second of simulated time it begins"]


def _description(found: Found) -> list[str]:
    if not found.joints:
        return []
    names = ", ".join(_quoted(joint.name) for joint in found.joints)
    return [
        "  - name: The robot's description",
        "    points: 10",
        "    hint: Shown to whoever loses points here.",
        "    expect:",
        f"      - urdf: {{param: {found.description}, moving: {len(found.joints)}, joints: [{names}]}}",
        "      - urdf: {collisions: true, limits: true, inertias: sane}",
    ] + ([f"      - urdf: {{transmissions: {found.transmissions}}}   # at least"] if found.transmissions else [])


def _controllers(found: Found) -> list[str]:
    if not found.controllers:
        return []
    lines = [
        "  - name: Controllers run",
        "    points: 10",
        "    expect:",
        f"      - controllers: {{count: {len(found.controllers)}}}   # at least so many; running: [NAME, ...] names them, * allowed",
    ]
    for name, kind in sorted(found.controllers.items()):
        if kind == _STATES:
            topic = f"{name.rpartition('/')[0]}/joint_states"
            lines.append(f"      - topic: {{name: {topic}, type: sensor_msgs/JointState, rate: [20, 1100]}}   # least and most, Hz")
    return lines


def _movement(found: Found) -> list[str]:
    followers = [name for name, kind in sorted(found.controllers.items()) if kind.endswith("/JointTrajectoryController")]
    return _single_joints(found) + [line for name in followers for line in _trajectory(found, name)] + _drive(found)


def _expected(joints: list[Joint]) -> list[str]:
    return [
        f"      - joint: {{name: {_quoted(joint.name)}, value: {joint.goal:g}, tolerance: 0.05, within: 10, hold: 0.2}}" for joint in joints
    ]


def _single_joints(found: Found) -> list[str]:
    single = {found.joint_of[name] for name, kind in found.controllers.items() if kind.endswith("/JointPositionController")}
    joints = [joint for joint in found.joints if joint.name in single]
    if not joints:
        return []
    lines = [
        "  - name: The joints obey",
        "    points: 20",
        f"    model: {_quoted(found.model)}",
        "    do:",
        "      # 'command of JOINT' is the topic of the running controller that claims it, whatever students called it",
    ]
    lines += [
        f"      - publish: {{topic: command of {joint.name}, type: std_msgs/Float64, message: {{data: {joint.goal:g}}}}}"
        for joint in joints
    ]
    return [*lines, "    expect:", *_expected(joints)]


def _trajectory(found: Found, controller: str) -> list[str]:
    joints = [joint for name in found.joints_of[controller] for joint in found.joints if joint.name == name]
    if not joints:
        return []
    names, goals = ", ".join(_quoted(joint.name) for joint in joints), ", ".join(f"{joint.goal:g}" for joint in joints)
    return [
        f"  - name: {_quoted(f'{controller} follows a trajectory')}",
        "    points: 20",
        f"    model: {_quoted(found.model)}",
        "    do:",
        f"      - action: {{topic: {controller}/follow_joint_trajectory, type: control_msgs/FollowJointTrajectoryAction, within: 20,",
        f"          goal: {{trajectory: {{joint_names: [{names}],",
        f"            points: [{{positions: [{goals}], time_from_start: {{secs: 3, nsecs: 0}}}}]}}}}}}",
        "    expect:",
        *_expected(joints),
    ]


def _drive(found: Found) -> list[str]:
    topics = [f"{name}/cmd_vel" for name, kind in sorted(found.controllers.items()) if kind.endswith("/DiffDriveController")]
    topic = next(iter(topics), found.driven_by)
    if not topic:
        return []
    return [
        "  - name: It drives",
        "    points: 20",
        f"    model: {_quoted(found.model)}",
        "    do:",
        f"      - publish: {{topic: {topic}, type: geometry_msgs/Twist, message: {{linear: {{x: 0.2}}}}, rate: 10, for: 5}}   # Hz, s",
        "    expect:",
        "      - moved: {by: [0.8, 1.2], turned: [-0.2, 0.2]}   # least and most: m, rad",
    ]


def _nodes(found: Found) -> list[str]:
    if not found.nodes:
        return []
    return ["  - name: The nodes run", "    points: 5", "    expect:", *(f"      - node: {name}" for name in sorted(set(found.nodes)))]


def _quoted(word: str) -> str:
    """As YAML has it."""
    plain = re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", word) and word.lower() not in _NO_TEXT
    return word if plain else "'" + word.replace("'", "''") + "'"


_NO_TEXT = ("true", "false", "yes", "no", "on", "off", "null", "y", "n")  # to a reader of YAML


def main(arguments: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(prog="rosrun lab_check new", description="Write a first spec for a launch file, with comments.")
    parser.add_argument("package")
    parser.add_argument("launch", help="the launch file's name, or its path")
    parser.add_argument("arguments", nargs="*", help="of the launch file: NAME:=VALUE")
    parser.add_argument("--out", type=pathlib.Path, help="the file; default: the terminal")
    options = parser.parse_args(arguments)
    if options.out and options.out.exists():
        print(f"lab_check: {options.out} is there already", file=sys.stderr)
        return 2
    try:
        written = text(look(options.package, options.launch, options.arguments))
    except NewError as error:
        print(f"lab_check: {error}", file=sys.stderr)
        return 2
    if options.out:
        options.out.write_text(written, encoding="utf-8")
        print(f"{options.out}; look at it, then: rosrun lab_check check {options.out} SUBMISSION")
    else:
        print(written, end="")
    return 0
