"""Gains that are too high for the inertia and the step drive a joint, whoever computes the effort. Without ROS."""

import math
import sys
from types import SimpleNamespace

import ode_sim
import pytest
from control_toolbox import Pid
from gazebo_ros_control.joint_sim import EffortMode, JointSim, PositionPidMode, VelocityPidMode
from gazebo_ros_control.wiring import Wiring
from hardware_interface import JointHandle, JointStateHandle
from joint_limits_interface import EffortJointSaturationHandle, JointLimits

DT = 0.001
WHEEL = """<robot name="wheel"><link name="world"/>
<link name="wheel"><inertial><mass value="0.1"/>
<inertia ixx="4e-4" ixy="0" ixz="0" iyy="4e-4" iyz="0" izz="4e-4"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="world"/><child link="wheel"/><axis xyz="0 0 1"/></joint></robot>"""
LIMITS = SimpleNamespace(enforce_limits=lambda dt: None, reset=lambda: None)


@pytest.fixture
def joint():
    world = ode_sim.World()
    joint = world.spawn_urdf(WHEEL, name="wheel").joints["hinge"]
    joint.world = world
    return joint


def run(joint, mode, each=lambda state: None, steps=400):
    sim = JointSim(joint, mode.state)
    sim.add("its mode", mode)
    wiring = Wiring([sim])
    for _ in range(steps):
        wiring.read()
        each(mode.state)
        wiring.write(DT)
        joint.world.step(1)


def handle_of(joint):
    return JointHandle(JointStateHandle(joint.name))


def efforts_of(joint, handle, most):
    limits = JointLimits(max_velocity=math.inf, max_effort=most, has_velocity_limits=True, has_effort_limits=True)
    return EffortMode(joint, handle, EffortJointSaturationHandle(handle, limits), most)


def test_of_a_controller_on_the_effort_interface(joint):
    handle, pid = handle_of(joint), Pid(p=1.0)
    mode = efforts_of(joint, handle, 10.0)

    def control(state):
        handle.command = pid.compute_command(3.0 - state.velocity, DT)
        handle.slope = pid.slope_of_velocity(DT)

    run(joint, mode, control)
    assert joint.velocity() == pytest.approx(3.0, abs=1e-6)
    assert handle.state.effort == pytest.approx(0.0, abs=1e-6)
    mode.enter()  # whoever comes next may command a bare effort
    handle.command = 1e-3
    run(joint, mode, steps=100)
    assert joint.velocity() == pytest.approx(3.0 + 1e-3 * 100 * DT / 4e-4, abs=1e-6)


def test_of_the_simulated_drives(joint):
    speed = VelocityPidMode(joint, handle_of(joint), LIMITS, sys.float_info.max, Pid(p=1.0, d=0.001))
    speed.handle.command = 3.0
    run(joint, speed)
    assert joint.velocity() == pytest.approx(3.0, abs=1e-6)
    place = PositionPidMode(
        joint,
        handle_of(joint),
        LIMITS,
        Pid(p=500.0, d=1.0),
        SimpleNamespace(error=lambda position, target: target - position),
        sys.float_info.max,
    )
    place.handle.command = 4.0
    run(joint, place, steps=4000)
    assert joint.position() == pytest.approx(4.0, abs=1e-4) and abs(joint.velocity()) < 1e-3


def test_a_command_beyond_the_limit_is_the_limit_at_first(joint):
    handle = handle_of(joint)
    mode = efforts_of(joint, handle, 0.05)

    def control(state):
        handle.command, handle.slope = 3.0 - state.velocity, 1.0

    run(joint, mode, control, steps=10)
    assert joint.velocity() == pytest.approx(0.05 * 10 * DT / 4e-4, rel=1e-6)
    run(joint, mode, control)
    assert joint.velocity() == pytest.approx(3.0, abs=1e-6)
