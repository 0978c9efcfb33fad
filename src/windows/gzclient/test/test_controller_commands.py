"""What the sliders of a controller send."""

import numpy as np
import pytest
from control_msgs.msg import GripperCommandActionGoal
from four_wheel_steering_msgs.msg import FourWheelSteering
from geometry_msgs.msg import Twist
from gzclient.controller_commands import command_of, joints_of
from ode_sim.description import model as d
from ode_sim.description import read_model
from ode_sim_viewer.simulation import Frame, ModelRecord, WorldRecord
from std_msgs.msg import Float64, Float64MultiArray

NAMES = ("lift", "turn")
JOINTS = (
    d.Joint("turn", "revolute", "base", "arm", axes=(d.Axis(lower=-1.0, upper=2.0, effort=30.0, velocity=4.0),)),
    d.Joint("lift", "prismatic", "arm", "hand", axes=(d.Axis(lower=0.0, upper=0.5, effort=200.0),)),
)
KNOWN = {"turn": (JOINTS[0], 0.5), "lift": (JOINTS[1], 0.1)}


def sliders(kind, names=NAMES):
    return [(slider.label, slider.low, slider.high, slider.now) for slider in command_of(kind, names, KNOWN).sliders]


def test_sliders_go_through_what_the_joints_can_do():
    assert sliders("position_controllers/JointPositionController", ("turn",)) == [("turn", -1.0, 2.0, 0.5)]
    assert sliders("effort_controllers/JointPositionController", ("turn",)) == [("turn", -1.0, 2.0, 0.5)]
    assert sliders("velocity_controllers/JointVelocityController", ("turn",)) == [("turn", -4.0, 4.0, 0.0)]
    assert sliders("effort_controllers/JointGroupEffortController") == [("lift", -100.0, 100.0, 0.0), ("turn", -30.0, 30.0, 0.0)]


def test_messages_have_the_numbers_in_the_order_of_the_controller():
    single = command_of("position_controllers/JointPositionController", ("turn",), KNOWN)
    assert (single.topic, single.cls, single.make([1.5], [0.5])) == ("command", Float64, Float64(1.5))
    group = command_of("position_controllers/JointGroupPositionController", NAMES, KNOWN)
    assert (group.cls, group.make([0.2, 1.5], [0.1, 0.5]).data) == (Float64MultiArray, [0.2, 1.5])


@pytest.mark.parametrize("values, lasts", (((0.1, 1.5), 0.5), ((0.4, 0.5), 0.6), ((0.1, 0.5), 0.1)))
def test_a_trajectory_goes_at_half_of_the_speed_that_the_joints_bear(values, lasts):
    command = command_of("effort_controllers/JointTrajectoryController", NAMES, KNOWN)
    made = command.make(values, (0.1, 0.5))
    assert (tuple(made.joint_names), tuple(made.points[0].positions)) == (NAMES, values)
    assert made.points[0].time_from_start.to_sec() == pytest.approx(lasts)


def test_a_drive_wants_to_be_told_again_and_again():
    command = command_of("diff_drive_controller/DiffDriveController", ("left", "right"), {})
    made = command.make((0.5, -1.0), ())
    assert (command.topic, command.cls, command.lasting) == ("cmd_vel", Twist, False)
    assert (made.linear.x, made.angular.z) == (0.5, -1.0)


def test_four_wheels_are_steered_at_both_axles():
    command = command_of("four_wheel_steering_controller/FourWheelSteeringController", ("a", "b", "c", "d"), {})
    made = command.make((0.5, 0.3, -0.2), ())
    assert (command.topic, command.cls, command.lasting) == ("cmd_four_wheel_steering", FourWheelSteering, False)
    assert (made.speed, made.front_steering_angle, made.rear_steering_angle) == (0.5, 0.3, -0.2)


def test_a_gripper_is_sent_to_a_place_with_the_force_of_its_joint():
    for kind in ("position_controllers", "effort_controllers"):
        assert sliders(f"{kind}/GripperActionController", ("lift",)) == [("lift", 0.0, 0.5, 0.1)]
    made = command_of("effort_controllers/GripperActionController", ("turn",), KNOWN)
    assert (made.topic, made.cls, made.lasting) == ("gripper_cmd/goal", GripperCommandActionGoal, True)
    goal = made.make([0.7], [0.5]).goal.command
    assert (goal.position, goal.max_effort) == (0.7, 30.0)


@pytest.mark.parametrize(
    "kind, names",
    (
        ("joint_state_controller/JointStateController", ()),
        ("x/Y", NAMES),
        ("position_controllers/JointPositionController", ("gone",)),
        ("position_controllers/GripperActionController", ("gone",)),
    ),
)
def test_others_have_no_sliders(kind, names):
    assert command_of(kind, names, KNOWN) is None


def robot(name, namespace, rows):
    text = f"""<sdf version='1.6'><model name='{name}'><link name='l'/><plugin name='c' filename='libgazebo_ros_control.so'>
        <robotNamespace>{namespace}</robotNamespace></plugin></model></sdf>"""
    from dataclasses import replace

    return ModelRecord(name, replace(read_model(text)[0], joints=JOINTS), joints=dict(zip(("turn", "lift"), rows)))


def test_of_two_robots_with_the_same_joints_the_one_of_the_namespace_is_meant():
    world = WorldRecord(3, models=(robot("one", "/first", (0, 1)), robot("two", "/second", (2, 3))))
    frame = Frame(3, 0.0, 0.0, 0, False, 1.0, np.zeros((0, 7), np.float32), np.array([0.1, 0.2, 0.3, 0.4], np.float32))
    for manager, row in (("/first", 0.1), ("/second", 0.3), ("/two", 0.3), ("", 0.1)):
        assert joints_of(world, frame, ("turn",), manager)["turn"] == (JOINTS[0], pytest.approx(row))
    assert joints_of(world, frame, ("turn", "wheel"), "") == {}
    assert joints_of(WorldRecord(4, models=world.models), frame, ("turn",), "") == {}
