"""The C++ twin of a robot, and Python's view of a robot in C++: the same numbers everywhere."""

import gc

import pytest
from hardware_interface import (
    ControllerInfo,
    EffortJointInterface,
    ForceTorqueSensorHandle,
    ForceTorqueSensorInterface,
    ImuSensorHandle,
    ImuSensorInterface,
    InterfaceResources,
    JointHandle,
    JointMode,
    JointModeHandle,
    JointModeInterface,
    JointStateHandle,
    JointStateInterface,
    PosVelJointHandle,
    PosVelJointInterface,
    RobotHW,
    SwitchState,
)
from hardware_interface.compiled import CompiledRobotHW, twin


def robot(*interfaces):
    result = RobotHW()
    for interface in interfaces:
        result.register_interface(interface)
    return result


def test_commands_and_states_are_the_same_numbers_on_both_sides():
    state = JointStateHandle("a", 1.0, 2.0, 3.0, absolute_position=4.0)
    joint, both = JointHandle(state), PosVelJointHandle(state)
    view = CompiledRobotHW(twin(robot(JointStateInterface(state), EffortJointInterface(joint), PosVelJointInterface(both))))
    seen = view.get(EffortJointInterface).get_handle("a")
    seen.command = 5.0
    state.position = 9.0
    view.get(PosVelJointInterface).get_handle("a").command_velocity = 7.0
    assert (joint.command, seen.position, seen.velocity, seen.effort, both.command_velocity) == (5.0, 9.0, 2.0, 3.0, 7.0)
    assert (seen.absolute_position, seen.torque_sensor) == (4.0, None)
    assert view.get(EffortJointInterface).claims == {"a"}


def test_sensors_and_modes():
    imu, mode = ImuSensorHandle("imu", "link", orientation=(0, 0, 0, 1)), JointModeHandle("m", JointMode.EFFORT)
    wrench = ForceTorqueSensorHandle("wrist", "link", force=(1, 2, 3))
    view = CompiledRobotHW(twin(robot(ImuSensorInterface(imu), JointModeInterface(mode), ForceTorqueSensorInterface(wrench))))
    imu.orientation = (1.0, 0.0, 0.0, 0.0)
    seen = view.get(ImuSensorInterface).get_handle("imu")
    assert (seen.orientation, seen.angular_velocity, seen.frame_id) == ((1.0, 0.0, 0.0, 0.0), None, "link")
    view.get(JointModeInterface).get_handle("m").mode = JointMode.ERROR
    assert mode.mode is JointMode.ERROR
    assert view.get(ForceTorqueSensorInterface).get_handle("wrist").force == (1.0, 2.0, 3.0)
    with pytest.raises(ValueError, match="orientation has 4 numbers"):
        imu.orientation = (1.0, 2.0)


def test_what_is_registered_later_is_added():
    states = JointStateInterface(JointStateHandle("a"))
    mine = robot(states)
    view = CompiledRobotHW(twin(mine))
    assert view.get(JointStateInterface).names() == ["a"]
    states.register_handle(JointStateHandle("b"))
    mine.register_interface(EffortJointInterface())
    twin(mine)
    assert view.get(JointStateInterface).names() == ["a", "b"]
    assert view.interface_names() == ["hardware_interface::EffortJointInterface", "hardware_interface::JointStateInterface"]


def test_robots_of_parts():
    parent = RobotHW()
    for name in ("a", "b"):
        parent.register_interface_manager(robot(JointStateInterface(JointStateHandle(name))))
    assert CompiledRobotHW(twin(parent)).get(JointStateInterface).names() == ["a", "b"]


def test_interfaces_in_cpp_of_a_robot_in_python():
    joint = JointHandle(JointStateHandle("a"))

    class Mixed(RobotHW):
        asked = 0

        def compiled_part(self):
            self.asked += 1
            return twin(robot(EffortJointInterface(joint)))

    mixed = Mixed()
    mixed.register_interface(JointStateInterface(joint.state))
    assert twin(mixed) is twin(mixed) and mixed.asked == 1
    view = CompiledRobotHW(twin(mixed))
    assert view.interface_names() == ["hardware_interface::EffortJointInterface", "hardware_interface::JointStateInterface"]
    view.get(EffortJointInterface).get_handle("a").command = 3.0
    assert joint.command == 3.0
    assert mixed.get(EffortJointInterface) is None  # Python's controllers do not see it


def test_the_numbers_outlive_the_robot():
    view = CompiledRobotHW(twin(robot(EffortJointInterface(JointHandle(JointStateHandle("a"))))))
    gc.collect()
    handle = view.get(EffortJointInterface).get_handle("a")
    handle.command = 3.0
    del view
    gc.collect()
    assert handle.command == 3.0


def test_hooks_of_a_robot_in_cpp():
    view = CompiledRobotHW(twin(robot()))
    one = ControllerInfo("one", "type", (InterfaceResources("x", ("j",)),))
    assert view.check_for_conflict([one, ControllerInfo("two", "type", one.claimed_resources)])
    assert not view.check_for_conflict([one])
    assert view.prepare_switch([one], []) and view.switch_result() is view.switch_result(one) is SwitchState.DONE
    view.do_switch([one], [])
    view.read(1.0, 0.1)
    view.write(1.0, 0.1)
