"""What the wiring does for all joints in one call is what a robot does that limits its commands by joint_limits_interface and gives them
to the joints of ode_sim one by one, to the last bit. Without ROS."""

import math
import random

import ode_sim
import pytest
from gazebo_ros_control.joint_sim import EffortMode, JointSim, PositionMode, VelocityMode
from gazebo_ros_control.wiring import Wiring
from hardware_interface import JointHandle, JointStateHandle
from joint_limits_interface import (
    EffortJointSaturationHandle,
    EffortJointSoftLimitsHandle,
    JointLimits,
    PositionJointSaturationHandle,
    PositionJointSoftLimitsHandle,
    SoftJointLimits,
    VelocityJointSaturationHandle,
    VelocityJointSoftLimitsHandle,
)

DT = 0.001
ARM = """<robot name="arm"><link name="world"/><link name="bar"><inertial><mass value="0.1"/>
<inertia ixx="4e-4" ixy="0" ixz="0" iyy="4e-4" iyz="0" izz="4e-4"/></inertial></link><joint name="hinge" type="revolute">
<parent link="world"/><child link="bar"/><axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="9" velocity="40"/></joint></robot>"""
HARD = JointLimits(
    min_position=-1.5,
    max_position=1.5,
    max_velocity=20.0,
    max_acceleration=900.0,
    max_effort=8.0,
    has_position_limits=True,
    has_velocity_limits=True,
    has_acceleration_limits=True,
    has_effort_limits=True,
)
ENDLESS = JointLimits(max_velocity=20.0, max_effort=8.0, has_velocity_limits=True, has_effort_limits=True)
NONE = JointLimits(max_velocity=math.inf, max_effort=math.inf, has_velocity_limits=True, has_effort_limits=True)
SOFT = SoftJointLimits(min_position=-0.8, max_position=0.8, k_position=20.0, k_velocity=40.0)
MODES = {
    PositionMode: (PositionJointSaturationHandle, PositionJointSoftLimitsHandle),
    VelocityMode: (VelocityJointSaturationHandle, VelocityJointSoftLimitsHandle),
    EffortMode: (EffortJointSaturationHandle, EffortJointSoftLimitsHandle),
}


class Robot:
    """One joint in a world, with a mode for each interface."""

    def __init__(self, hard, soft):
        self.world = ode_sim.World()
        self.joint = self.world.spawn_urdf(ARM).joints["hinge"]
        self.state = JointStateHandle("hinge")
        self.sim = JointSim(self.joint, self.state)
        for mode, handles in MODES.items():
            handle = JointHandle(self.state, 0.0)
            limits = handles[1](handle, hard, SOFT) if soft else handles[0](handle, hard)
            more = () if mode is PositionMode else (hard.max_effort,)
            self.sim.add(mode.__name__, mode(self.joint, handle, limits, *more))

    def seen(self):
        commanded_effort = None if self.sim.mode.bears else self.state.effort
        return [
            (
                self.sim.mode.handle.command,
                self.state.position,
                self.state.velocity,
                commanded_effort,
                self.joint.core.drive_mode,
                self.joint.core.drive_target,
                self.joint.motor(),
                self.joint.effort(),
            )
        ]


class ByHand(Robot):
    """The same, whose commands go one by one."""

    def __init__(self, hard, soft):
        super().__init__(hard, soft)
        self.stopped_at = None  # rad

    def stop(self, active):
        self.stopped_at = self.state.position if active else None

    def switch(self, mode):
        if self.sim.switch(mode) and self.stopped_at is not None:
            self.stop(True)

    def write(self):
        mode, handle, stopped = self.sim.mode, self.sim.mode.handle, self.stopped_at is not None
        if stopped and type(mode) is PositionMode:
            handle.command = self.stopped_at
        wanted = handle.command
        mode.limits.enforce_limits(DT)
        allowed = handle.command
        if type(mode) is PositionMode:
            self.joint.drive_to(allowed)
        elif type(mode) is VelocityMode:
            self.joint.set_motor(0.0 if stopped else allowed, mode.effort_limit)
        else:
            cut_by_effort = mode.effort_limit <= abs(allowed) < abs(wanted) < math.inf
            if stopped:
                self.joint.add_force(0.0)
            elif handle.slope != 0.0 and (wanted == allowed or cut_by_effort):
                self.joint.add_law(wanted, handle.slope, mode.effort_limit)
            else:
                self.joint.add_force(allowed)
            self.state.effort = self.joint.effort()


def commands(chance, kind):
    """Mostly small steps, now and then a jump, a command far out of all limits, or none that is a number."""
    sizes = {PositionMode: 1.0, VelocityMode: 20.0, EffortMode: 8.0}
    command = 0.0
    while True:
        what = chance.random()
        if what < 0.02:
            yield chance.choice((math.nan, math.inf, -math.inf, 1e300))
        else:
            command = chance.uniform(-2, 2) * sizes[kind] if what < 0.1 else command + chance.uniform(-0.05, 0.05) * sizes[kind]
            yield command


@pytest.mark.parametrize("hard", [HARD, ENDLESS, NONE], ids=["limits", "endless", "unlimited"])
@pytest.mark.parametrize("soft", [False, True], ids=["saturation", "soft"])
def test_commands_get_to_the_joints(hard, soft):
    by_hand, wired = ByHand(hard, soft), Robot(hard, soft)
    wiring = Wiring([wired.sim])
    chance = random.Random(5)
    mode, stopped = PositionMode, False
    source = commands(chance, mode)
    for step in range(1500):
        what = chance.random()
        if what < 0.01:  # a controller of another interface takes over
            mode = chance.choice(list(MODES))
            source = commands(chance, mode)
            by_hand.switch(mode.__name__)
            wired.sim.switch(mode.__name__)
            wiring.engage()
        elif what < 0.02:
            stopped = not stopped
            by_hand.stop(stopped)
            wiring.stop(stopped)
        elif what < 0.025:
            for robot in (by_hand, wired):
                for each in robot.sim.modes.values():
                    each.limits.reset()
        by_hand.state.position, by_hand.state.velocity = by_hand.joint.position(), by_hand.joint.velocity()
        wiring.read()
        command, slope = next(source), chance.choice((0.0, 0.0, 3.0))
        for robot in (by_hand, wired):
            robot.sim.mode.handle.command = command
            if mode is EffortMode:
                robot.sim.mode.handle.slope = slope
        by_hand.write()
        wiring.write(DT)
        assert wired.seen() == by_hand.seen(), (step, mode.__name__, command, stopped)
        by_hand.world.step()
        wired.world.step()
    assert wired.world.link_poses.tobytes() == by_hand.world.link_poses.tobytes()


CRANE = """<robot name="crane"><link name="world"/>
<link name="boom"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
<link name="hook"><inertial><mass value="3"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
<joint name="luff" type="revolute"><parent link="world"/><child link="boom"/><axis xyz="0 1 0"/>
<limit lower="-2" upper="2" effort="90" velocity="4"/></joint>
<joint name="lift" type="prismatic"><parent link="boom"/><child link="hook"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="90" velocity="4"/></joint></robot>"""
GRAVITY = 9.8  # of a world that says nothing else


@pytest.mark.parametrize("lifting", [PositionMode, VelocityMode])
def test_a_robot_that_holds_itself_up_reports_what_its_joints_bear(lifting):
    world = ode_sim.World()
    model = world.spawn_urdf(CRANE)
    sims = {}
    for name, mode in (("luff", PositionMode), ("lift", lifting)):
        sim = sims[name] = JointSim(model.joints[name], JointStateHandle(name))
        handle = JointHandle(sim.state, 0.0)
        limits = MODES[mode][0](handle, HARD)
        sim.add(mode.__name__, mode(sim.joint, handle, limits, *(() if mode is PositionMode else (HARD.max_effort * 10,))))
    wiring = Wiring(sims.values())
    for step in range(1500):
        wiring.read()
        sims["luff"].mode.handle.command = -0.6 * min(step * DT, 1.0)  # the boom rises
        sims["lift"].mode.handle.command = 0.0
        wiring.write(DT)
        world.step()
    wiring.read()
    reach = math.cos(0.6) - math.sin(0.6) * sims["lift"].state.position  # m, of the hook; a motor that keeps a speed has sagged a little
    assert sims["luff"].state.effort == pytest.approx(-(2 * 0.5 * math.cos(0.6) + 3 * reach) * GRAVITY, rel=1e-6)
    assert sims["lift"].state.effort == pytest.approx(3 * math.cos(0.6) * GRAVITY, rel=1e-6)
    sims["luff"].add(
        "EffortMode",
        EffortMode(
            sims["luff"].joint,
            JointHandle(sims["luff"].state, 0.0),
            EffortJointSaturationHandle(JointHandle(sims["luff"].state, 0.0), HARD),
            90.0,
        ),
    )
    sims["luff"].switch("EffortMode")
    assert sims["luff"].state.effort == 0.0
