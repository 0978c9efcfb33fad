"""Handles, interfaces, claims, combination of robots, conflicts between controllers."""

from xml.etree.ElementTree import ParseError

import pytest
from hardware_interface import (
    ControllerInfo,
    EffortJointInterface,
    HardwareInterface,
    InterfaceResources,
    JointHandle,
    JointStateHandle,
    JointStateInterface,
    PositionJointInterface,
    PosVelJointHandle,
    PosVelJointInterface,
    ResourceError,
    RobotHW,
    SwitchState,
    VelocityJointInterface,
    description_root,
)


def joint(name, **state):
    return JointHandle(JointStateHandle(name, **state))


def info(name, **claims):
    """A controller; keyword: interface -> joints."""
    return ControllerInfo(name, "type", tuple(InterfaceResources(interface, tuple(joints)) for interface, joints in claims.items()))


def test_a_command_handle_shows_its_state():
    handle = joint("j", position=1.0, velocity=2.0, effort=3.0)
    handle.state.position = 4.0
    assert (handle.name, handle.position, handle.velocity, handle.effort) == ("j", 4.0, 2.0, 3.0)


def test_a_command_handle_needs_a_state_handle():
    with pytest.raises(TypeError, match="state handle"):
        JointHandle(None)


def test_two_commands():
    handle = PosVelJointHandle(JointStateHandle("j"), 1.0, 2.0)
    assert (handle.command_position, handle.command_velocity) == (1.0, 2.0)


def test_misspelled_attributes_are_refused():
    with pytest.raises(AttributeError):
        joint("j").comand = 1.0


def test_interfaces_are_named_after_package_and_class():
    assert PositionJointInterface.type_name == "hardware_interface::PositionJointInterface"
    mine = type("GripInterface", (HardwareInterface,), {"__module__": "my_package.hands"})
    renamed = type("Any", (HardwareInterface,), {"__module__": "my_package", "type_name": "theirs::Interface"})
    assert (mine.type_name, renamed.type_name) == ("my_package::GripInterface", "theirs::Interface")


def test_names_are_sorted():
    interface = PositionJointInterface(joint("b"), joint("c"), joint("a"))
    assert interface.names() == ["a", "b", "c"]
    assert [handle.name for handle in interface.handles()] == ["a", "b", "c"]


def test_unknown_resource_names_interface_and_what_there_is():
    with pytest.raises(ResourceError, match="'x'.*PositionJointInterface.*a, b"):
        PositionJointInterface(joint("a"), joint("b")).get_handle("x")


@pytest.mark.parametrize(
    "interface, claimed", [(PositionJointInterface, {"a"}), (VelocityJointInterface, {"a"}), (EffortJointInterface, {"a"})]
)
def test_commanding_interfaces_claim(interface, claimed):
    offered = interface(joint("a"), joint("b"))
    offered.get_handle("a")
    assert offered.claims == claimed
    offered.clear_claims()
    assert offered.claims == set()


def test_two_command_interface_claims():
    offered = PosVelJointInterface(PosVelJointHandle(JointStateHandle("a")))
    offered.get_handle("a")
    assert offered.claims == {"a"}


def test_state_interfaces_do_not_claim():
    offered = JointStateInterface(JointStateHandle("a"))
    offered.get_handle("a")
    assert offered.claims == set()


def test_handles_without_claim_for_the_hardware():
    offered = PositionJointInterface(joint("a"))
    assert offered.handles()[0].name == "a" and offered.claims == set()


def test_registering_twice_replaces_with_a_warning(caplog):
    first, second = joint("a"), joint("a")
    offered = PositionJointInterface(first, second)
    assert offered.get_handle("a") is second
    assert "Replacing previously registered handle 'a' in 'hardware_interface::PositionJointInterface'" in caplog.text
    robot = RobotHW()
    robot.register_interface(PositionJointInterface())
    robot.register_interface(offered)
    assert robot.get(PositionJointInterface) is offered
    assert "Replacing previously registered interface 'hardware_interface::PositionJointInterface'" in caplog.text


def test_interfaces_of_a_robot():
    robot = RobotHW()
    robot.register_interface(PositionJointInterface(joint("a")))
    assert robot.get(PositionJointInterface).names() == ["a"]
    assert robot.get("hardware_interface::PositionJointInterface") is robot.get(PositionJointInterface)
    assert robot.get(EffortJointInterface) is None
    assert robot.interface_names() == ["hardware_interface::PositionJointInterface"]


def test_interfaces_of_several_robots_are_merged_by_handle():
    parent, left, right = RobotHW(), RobotHW(), RobotHW()
    handle = joint("a")
    left.register_interface(PositionJointInterface(handle))
    right.register_interface(PositionJointInterface(joint("b")))
    right.register_interface(EffortJointInterface(joint("c")))
    parent.register_interface_manager(left)
    parent.register_interface_manager(right)
    merged = parent.get(PositionJointInterface)
    assert merged.names() == ["a", "b"]
    assert merged.get_handle("a") is handle
    assert parent.get(PositionJointInterface) is merged, "claims must not be lost between two calls"
    assert parent.get(EffortJointInterface) is right.get(EffortJointInterface)


def test_hooks_succeed_by_default():
    robot = RobotHW()
    assert robot.prepare_switch([], []) and robot.switch_result() is SwitchState.DONE


@pytest.mark.parametrize(
    "controllers, conflict",
    [
        ([info("a", pos=["j1"]), info("b", pos=["j2"])], False),
        ([info("a", pos=["j1"]), info("b", pos=["j1"])], True),
        ([info("a", pos=["j1"]), info("b", eff=["j1"])], True),  # whatever the interface
        ([info("a", pos=["j1"], eff=["j1"])], True),  # with itself
        ([info("a", pos=["j1"], eff=["j2"]), info("b", pos=["j3"])], False),
        ([info("a"), info("b")], False),
    ],
)
def test_conflicts(controllers, conflict, caplog):
    assert RobotHW().check_for_conflict(controllers) is conflict
    assert ("Resource conflict on [j1]" in caplog.text) is conflict


def test_a_robot_is_read_once():
    urdf = "\ufeff\n\n<?xml version='1.0' encoding='latin-1'?>\n<robot name='ü'><link name='{}'/></robot>"
    root = description_root(urdf.format("base"))
    assert root.get("name") == "ü" and root.find("link").get("name") == "base"
    assert description_root(urdf.format("base")) is root and description_root(urdf.format("arm")) is not root
    root = description_root("<robot name='r'><gazebo><plugin name='drive & steer' topic='a<b'/></gazebo><link name='base'/></robot>")
    assert root.find("link").get("name") == "base" and root.find("gazebo/plugin").get("topic") == "a<b"
    with pytest.raises(ParseError, match="mismatched tag: line 1, column 15"):
        description_root("<robot><link></robot>")
