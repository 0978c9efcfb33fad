"""From URDF to working pipelines."""

import math
import re

import pytest
from hardware_interface import (
    ActuatorHandle,
    ActuatorStateHandle,
    ActuatorStateInterface,
    EffortActuatorInterface,
    EffortJointInterface,
    JointStateInterface,
    PositionActuatorInterface,
    PositionJointInterface,
    RobotHW,
    VelocityActuatorInterface,
    VelocityJointInterface,
)
from transmission_interface import RobotTransmissions, TransmissionInterfaceLoader


def joint(name, *interfaces, inside=""):
    tags = "".join(f"<hardwareInterface>hardware_interface/{interface}</hardwareInterface>" for interface in interfaces)
    return f'<joint name="{name}">{inside}{tags}</joint>'


def actuator(name, reduction=10, role=""):
    return f'<actuator name="{name}"><role>{role}</role><mechanicalReduction>{reduction}</mechanicalReduction></actuator>'


def simple(name, joint_name, actuator_name, *interfaces, reduction=10):
    return (
        f'<transmission name="{name}"><type>transmission_interface/SimpleTransmission</type>'
        f"{joint(joint_name, *interfaces)}{actuator(actuator_name, reduction)}</transmission>"
    )


def two(kind, *interfaces, inside=""):
    return (
        f'<transmission name="two"><type>transmission_interface/{kind}</type>'
        + joint("j2", *interfaces, inside="<role>joint2</role>" + inside)  # order in the file must not matter
        + joint("j1", *interfaces, inside="<role>joint1</role>" + inside)
        + actuator("b", role="actuator2")
        + actuator("a", role="actuator1")
        + "</transmission>"
    )


class Robot:
    def __init__(self):
        self.hw = RobotHW()
        self.states = {name: ActuatorStateHandle(name, 1.0, 2.0, 3.0) for name in ("a", "b")}
        self.hw.register_interface(ActuatorStateInterface(*self.states.values()))
        self.commands = {}
        for interface in (PositionActuatorInterface, VelocityActuatorInterface, EffortActuatorInterface):
            handles = [ActuatorHandle(state) for state in self.states.values()]
            self.commands[interface] = {handle.name: handle for handle in handles}
            self.hw.register_interface(interface(*handles))
        self.pipelines = RobotTransmissions()
        self.loader = TransmissionInterfaceLoader(self.hw, self.pipelines)

    def load(self, *transmissions):
        return self.loader.load(f"<robot name='r'>{''.join(transmissions)}</robot>")

    def joint_state(self, name):
        return self.hw.get(JointStateInterface).get_handle(name)


@pytest.fixture
def robot():
    return Robot()


def test_simple_end_to_end(robot):
    assert robot.load(simple("t", "j", "a", "EffortJointInterface"))
    assert math.isnan(robot.joint_state("j").position), "unknown until the first propagation"
    robot.pipelines.actuator_to_joint_state.propagate()
    state = robot.joint_state("j")
    assert (state.position, state.velocity, state.effort) == (0.1, 0.2, 30.0)
    handle = robot.hw.get(EffortJointInterface).get_handle("j")
    assert handle.state is state
    handle.command = 50.0
    robot.pipelines.joint_to_actuator_effort.propagate()
    assert robot.commands[EffortActuatorInterface]["a"].command == 5.0


@pytest.mark.parametrize("kind", ["DifferentialTransmission", "FourBarLinkageTransmission"])
def test_two_joints(robot, kind):
    assert robot.load(two(kind, "PositionJointInterface"))
    robot.states["b"].position = 0.0
    robot.pipelines.actuator_to_joint_state.propagate()
    first, second = robot.joint_state("j1").position, robot.joint_state("j2").position
    assert (first, second) == ((0.05, 0.05) if kind.startswith("Diff") else (0.1, -0.1))
    handles = robot.hw.get(PositionJointInterface)
    handles.get_handle("j1").command, handles.get_handle("j2").command = first, second
    robot.pipelines.joint_to_actuator_position.propagate()
    commands = robot.commands[PositionActuatorInterface]
    assert (commands["a"].command, commands["b"].command) == pytest.approx((1.0, 0.0))


def test_absolute_encoders_and_torque_sensors(robot):
    assert robot.load(simple("t", "j", "a", "EffortJointInterface"))
    assert robot.joint_state("j").absolute_position is None
    robot.states["a"].absolute_position = 4.0
    robot.states["a"].torque_sensor = 5.0
    robot.pipelines.actuator_to_joint_state.propagate()
    assert (robot.joint_state("j").absolute_position, robot.joint_state("j").torque_sensor) == (0.4, 50.0)


@pytest.mark.parametrize("mark, expected", [("", (0.15, -0.05)), ("<ignoreTransmissionAbsoluteEncoder/>", (2.0, 1.0))])
def test_absolute_encoders_of_a_differential(robot, mark, expected):
    robot.states["a"].absolute_position, robot.states["b"].absolute_position = 1.0, 2.0
    assert robot.load(two("DifferentialTransmission", "EffortJointInterface", inside=mark))
    robot.pipelines.actuator_to_joint_state.propagate()
    assert (robot.joint_state("j1").absolute_position, robot.joint_state("j2").absolute_position) == pytest.approx(expected)


def test_several_interfaces_of_one_joint(robot):
    assert robot.load(simple("t", "j", "a", "PositionJointInterface", "VelocityJointInterface", "EffortJointInterface"))
    for interface in (PositionJointInterface, VelocityJointInterface, EffortJointInterface):
        assert robot.hw.get(interface).names() == ["j"]


def test_bidirectional(robot):
    assert robot.load(simple("t", "j", "a", "BiDirectionalEffortJointInterface"))
    robot.joint_state("j").position = 3.0
    robot.joint_state("j").velocity = robot.joint_state("j").effort = 0.0
    robot.pipelines.joint_to_actuator_state.propagate()
    assert robot.states["a"].position == 30.0
    robot.commands[EffortActuatorInterface]["a"].command = 2.0
    robot.pipelines.actuator_to_joint_effort.propagate()
    assert robot.hw.get(EffortJointInterface).get_handle("j").command == 20.0


def test_unknown_interface_is_left_out_with_a_warning(robot, caplog):
    assert robot.load(simple("t", "j", "a", "NoSuchInterface", "EffortJointInterface"))
    assert "NoSuchInterface" in caplog.text


@pytest.mark.parametrize(
    "transmissions, says",
    [
        ([], "no usable <transmission>"),
        ([simple("t", "j", "a", "NoSuchInterface")], "no hardware interface that can be used"),
        ([simple("t", "j", "zzz", "EffortJointInterface")], "'zzz'.*a, b"),
        ([simple("t", "j", "a", "EffortJointInterface", reduction=0)], "reduction of 0"),
        ([simple("t", "j", "a", "EffortJointInterface", reduction="fast")], "fast.*is no number"),
        (
            [simple("t", "j", "a", "EffortJointInterface").replace("Simple", "Magic")],
            "MagicTransmission' does not exist.*DifferentialTransmission",
        ),
        ([simple("t", "j", "a", "EffortJointInterface").replace("Simple", "FourBarLinkage")], "needs 2 actuators.*has 1"),
        ([two("DifferentialTransmission", "EffortJointInterface").replace("joint2", "joint1")], "joint1, joint2, each once"),
    ],
)
def test_failures_say_why(robot, transmissions, says, caplog):
    assert not robot.load(*transmissions)
    assert re.search(says, caplog.text), caplog.text


def test_those_before_a_failure_stay(robot):
    assert not robot.load(simple("t", "j", "a", "EffortJointInterface"), simple("u", "k", "zzz", "EffortJointInterface"))
    assert robot.hw.get(EffortJointInterface).names() == ["j"]
