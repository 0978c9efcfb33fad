"""Parameters of controllers, through a controller manager, and of gazebo_ros_control, under a model in a world."""

from __future__ import annotations

import math
import threading
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import yaml

from fuzzing import ros, seeds, tree_cases, worlds, xml_cases
from fuzzing.findings import Found, refused
from fuzzing.kinds import Kind
from fuzzing.kinds.plans import readable

_CYCLES = 20
_MODES = ["position", "velocity", "effort", "pos_vel", "pos_vel_acc"]
_ROBOTS = [
    f"{name}.urdf" for name in ("diff_drive_robot", "ackermann_robot", "four_wheel_robot", "trajectory_robot", "gripper_robot", "arm")
]
_PLUGIN = """
parameters:
  pid_gains: {j: {p: 100.0, i: 0.1, d: 1.0, i_clamp: 1.0}, k: {p: 10.0, i: 0.0, d: 0.1, antiwindup: true}}
  joint_limits:
    j: {has_position_limits: true, min_position: -1.0, max_position: 1.0, has_velocity_limits: true, max_velocity: 2.0,
        has_effort_limits: true, max_effort: 20.0, has_acceleration_limits: true, max_acceleration: 5.0, has_soft_limits: true,
        k_position: 10.0, k_velocity: 10.0, soft_lower_limit: -0.9, soft_upper_limit: 0.9}
  gazebo_ros_control: {pid_gains: {j: {p: 100.0, i: 0.1, d: 1.0}, k: {p: 100.0}}}
elements: {robotNamespace: /robot, robotParam: robot_description, robotSimType: gazebo_ros_control/DefaultRobotHWSim,
           controlPeriod: 0.001, eStopTopic: stop, legacyModeNS: true}
interfaces: {j: [hardware_interface/PositionJointInterface], k: [VelocityJointInterface, EffortJointInterface]}
limits: {j: {lower: -1.0, upper: 1.0, effort: 10.0, velocity: 1.0}, k: {lower: 0.0, upper: 0.0, effort: 5.0, velocity: 2.0}}
controller: {type: position_controllers/JointPositionController, joint: j}
"""
_ROBOT = """<robot name="r"><link name="world"/>{joints}{transmissions}</robot>"""
_JOINT = """<joint name="{name}" type="revolute"><parent link="world"/><child link="{name}_link"/><origin xyz="0 {y} 1"/><axis xyz="0 1 0"/>
<limit {limit}/></joint><link name="{name}_link"><inertial><origin xyz="0.3 0 0"/><mass value="0.5"/><inertia ixx="0.01" ixy="0" ixz="0"
iyy="0.01" iyz="0" izz="0.01"/></inertial></link>"""
_TRANSMISSION = """<transmission name="t_{name}"><type>transmission_interface/SimpleTransmission</type><joint name="{name}">{tags}</joint>
<actuator name="m_{name}"><mechanicalReduction>{reduction}</mechanicalReduction></actuator></transmission>"""


class ControllerKind(Kind):
    """YAML: ``controller`` (parameters) and ``robot_description`` (a URDF of the workspace), or ``gazebo_ros_control`` (see _PLUGIN)."""

    name, suffix = "yaml", ".yaml"
    time_limit = 20.0
    wall_limit = 60.0
    silent = False  # rospy logs there; its lines are looked at one by one
    cases_per_worker = 400

    def prepare(self) -> None:
        import control_test_robots.robot  # noqa: F401
        import controller_manager  # noqa: F401
        import gazebo_ros_control.plugin  # noqa: F401
        import rosmaster.master  # noqa: F401

        self._controllers: list[dict[str, Any]] = []
        for path in seeds.files(".yaml"):
            self._controllers += _controllers_in(readable(path.read_bytes()))
        self._plugin = yaml.safe_load(_PLUGIN)
        self._joints = sorted({name for entry in self._controllers for name in _names_in(entry)} | {"a", "b", "j"})

    def start(self, folder: Path, number: int) -> None:
        ros.start_master(folder, number)
        import rospy
        from control_test_robots.robot import TestRobot
        from controller_manager import ControllerManager

        rospy.init_node("fuzz", disable_signals=True, anonymous=True)
        self._log = ros.Log()
        self._robot = TestRobot(
            {
                "joints": {name: {"interfaces": _MODES} for name in self._joints},
                "imus": {"imu": {"frame_id": "imu_link"}},
                "force_torque_sensors": {"wrist": {"frame_id": "wrist_link"}},
            }
        )
        self._manager = ControllerManager(self._robot, "/bench")
        self._time = 10.0
        self._texts = {name: seeds.robots()[name].decode() for name in _ROBOTS if name in seeds.robots()}

    # ------------------------------------------------------------------------------------------ making

    def generate(self, random: Random) -> bytes:
        times = random.choice((1, 1, 2, 2, 3, 5, 10))
        if random.random() < 0.25:
            tree: Any = {"gazebo_ros_control": tree_cases.changed(random, self._plugin, times, tree_cases.odd_value)}
        else:
            parameters = random.choice(self._controllers)
            kind = parameters["type"]
            parameters = tree_cases.changed(random, parameters, times, tree_cases.odd_value)
            if isinstance(parameters, dict) and random.random() < 0.9:
                parameters["type"] = kind
            tree = {"controller": parameters, "robot_description": random.choice(_ROBOTS)}
        return yaml.safe_dump(_sendable(tree), default_flow_style=None, width=10**6).encode()

    def smaller(self, case: bytes) -> Iterator[bytes]:
        tree = readable(case)
        if tree is None:
            yield from xml_cases.smaller_bytes(case)
            return
        for candidate in tree_cases.smaller(tree):
            yield yaml.safe_dump(candidate, default_flow_style=None, width=10**6).encode()

    # ------------------------------------------------------------------------------------------ running

    def run(self, case: bytes) -> None:
        import rospy

        tree = readable(case)
        if not isinstance(tree, dict):
            return
        for name in ("/bench", "/robot", "/robot_description"):
            if rospy.has_param(name):
                rospy.delete_param(name)
        if isinstance(tree.get("gazebo_ros_control"), dict):
            self._simulate(tree["gazebo_ros_control"])
        elif tree.get("controller"):
            self._control(tree)
        self._log.check()

    def _control(self, tree: dict[str, Any]) -> None:
        import rospy

        rospy.set_param("/robot_description", self._texts.get(str(tree.get("robot_description")), ""))
        rospy.set_param("/bench/fuzzed", tree["controller"])
        if self._manager.load_controller("fuzzed"):
            self._switch(["fuzzed"], [])
            self._cycle(_CYCLES)
            self._switch([], ["fuzzed"])
            if not self._manager.unload_controller("fuzzed"):
                raise Found("left behind", "a controller that cannot be unloaded", str(tree["controller"].get("type")))
        left = [name for name, _ in rospy.topics.get_topic_manager().get_publications() if name.startswith("/bench/fuzzed")]
        if left:
            raise Found("left behind", "topics of a controller that is not there", " ".join(left))

    def _switch(self, start: list[str], stop: list[str]) -> None:
        request = threading.Thread(target=lambda: self._manager.switch_controller(start, stop), daemon=True)
        request.start()
        while request.is_alive():
            self._cycle(1)
            request.join(0.001)

    def _cycle(self, count: int) -> None:
        for _ in range(count):
            self._time += 0.01
            self._robot.read(self._time, 0.01)
            self._manager.update(self._time, 0.01)
            self._check_commands()
            self._robot.write(self._time, 0.01)

    def _check_commands(self) -> None:
        for name, joint in self._robot.joints.items():
            handle = joint.handles.get(joint.mode)
            told = getattr(handle, "command", None) if hasattr(handle, "command") else getattr(handle, "command_position", 0.0)
            if told is not None and not math.isfinite(told):
                joint.reset()
                if hasattr(handle, "command"):
                    handle.command = 0.0
                else:
                    handle.command_position = 0.0
                raise Found("silent NaN", f"command of a {joint.mode} joint", f"{name}: {told}")

    def _simulate(self, told: dict[str, Any]) -> None:
        import xml.etree.ElementTree as ET

        import ode_sim
        import rospy
        from gazebo_ros.plugin import PluginError
        from gazebo_ros.sdf_element import SdfElement
        from gazebo_ros_control.plugin import GazeboRosControl

        text = _robot_text(told)
        world = ode_sim.World()
        model, error = refused(lambda: world.spawn_urdf(text, name="robot"), ode_sim.DescriptionError)
        if error is not None:
            return
        rospy.set_param("/robot_description", text)
        rospy.set_param("/robot", _mapping(told.get("parameters")))
        rospy.set_param("/robot/fuzzed", _mapping(told.get("controller")))
        elements = ET.Element("plugin")
        for name, value in _mapping(told.get("elements")).items():
            ET.SubElement(elements, name if name.isidentifier() else "x").text = str(value)
        plugin, loaded = GazeboRosControl(), False
        try:
            _, error = refused(lambda: plugin.load(_Server(world), model, SdfElement(elements)), PluginError)
            loaded = error is None
            if loaded:
                _, error = refused(lambda: self._go_on(plugin, world), PluginError)
            if error is not None:
                ros.check_line(str(error))
            worlds.check_state(world)
        finally:
            if loaded:
                plugin.shutdown()

    @staticmethod
    def _go_on(plugin, world) -> None:
        world.step(_CYCLES)
        if plugin._manager is not None and plugin._manager.load_controller("fuzzed"):
            request = threading.Thread(target=lambda: plugin._manager.switch_controller(["fuzzed"], []), daemon=True)
            request.start()
            while request.is_alive():
                world.step(1)
                request.join(0.001)
        world.step(_CYCLES)


class _Server:
    """What the plugin needs of the simulator's server."""

    def __init__(self, world):
        self.world = world

    def before_step(self, f) -> None:
        self.world.before_step.append(lambda world: f())

    after_step = before_step

    def call(self, f):
        return f()

    def drives(self, *joints) -> None:
        """There is no second plugin to be warned of."""


def _mapping(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _robot_text(told: dict[str, Any]) -> str:
    from xml.sax.saxutils import escape, quoteattr

    joints = transmissions = ""
    for i, (name, limit) in enumerate(_mapping(told.get("limits")).items()):
        limits = " ".join(f"{key}={quoteattr(str(value))}" for key, value in _mapping(limit).items() if str(key).isidentifier())
        joints += _JOINT.format(name=escape(str(name), {'"': "&quot;"}), y=i, limit=limits)
    for name, interfaces in _mapping(told.get("interfaces")).items():
        tags = "".join(
            f"<hardwareInterface>{escape(str(interface))}</hardwareInterface>"
            for interface in (interfaces if isinstance(interfaces, list) else [interfaces])
        )
        name = escape(str(name), {'"': "&quot;"})
        transmissions += _TRANSMISSION.format(name=name, tags=tags, reduction=escape(str(told.get("reduction", 1))))
    return _ROBOT.format(joints=joints, transmissions=transmissions)


def _controllers_in(tree: Any) -> list[dict[str, Any]]:
    """Maps that describe a controller, at any depth."""
    if not isinstance(tree, dict):
        return []
    kind = tree.get("type")
    if isinstance(kind, str) and "controller" in kind.lower() and "/" in kind and not kind.startswith("controller_manager_tests/"):
        return [tree]
    return [entry for value in tree.values() for entry in _controllers_in(value)]


def _names_in(parameters: Any) -> list[str]:
    """Joints that a controller's parameters name."""
    if isinstance(parameters, str):
        return [parameters]
    if isinstance(parameters, list):
        return [name for entry in parameters for name in _names_in(entry)]
    if isinstance(parameters, dict):
        return [name for key, value in parameters.items() if key in _JOINT_KEYS for name in _names_in(value)]
    return []


_JOINT_KEYS = (
    "joint",
    "joints",
    "left_wheel",
    "right_wheel",
    "front_wheel",
    "rear_wheel",
    "front_steering",
    "rear_steering",
    "rear_steer",
    "front_steer",
)


def _sendable(tree: Any) -> Any:
    """As a parameter server can hold it: keys are texts, whole numbers have 32 bits, texts are XML's."""
    if isinstance(tree, dict):
        return {_text(str(key)) or "x": _sendable(value) for key, value in tree.items() if value is not None}
    if isinstance(tree, list):
        return [_sendable(value) for value in tree if value is not None]
    if isinstance(tree, int) and not isinstance(tree, bool):
        return max(-(2**31), min(2**31 - 1, tree))
    return _text(tree) if isinstance(tree, str) else tree


def _text(text: str) -> str:
    return "".join(character for character in text if character >= " ")
