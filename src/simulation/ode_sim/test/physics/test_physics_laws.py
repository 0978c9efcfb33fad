"""Forces of controllers whose gains are too high for the inertia and the step."""

from dataclasses import replace

import ode_sim
import pytest
from physics_models import arm, pendulum

INERTIA = 4e-4  # kg m^2
GAIN = 1.0  # N m s/rad: makes good 2.5 times a speed error in one step of 1 ms


def wheel(solver="quick", **more):
    world = ode_sim.World()
    world.physics.solver = solver
    spin = world.spawn(pendulum(length=0.0, mass=0.1, inertia=INERTIA, **more))
    return world, spin.joints["hinge"]


def driven(world, joint, target, gain=GAIN, steps=200, load=0.0, **bound):
    for _ in range(steps):
        joint.add_law(gain * (target - joint.velocity()), gain, **bound)
        joint.add_force(-load)
        world.step(1)
    return joint.velocity()


def test_a_wheel_keeps_the_speed_that_the_law_asks_for():
    assert driven(*wheel(), target=5.0) == pytest.approx(5.0, abs=1e-6)
    assert driven(*wheel(), target=5.0, gain=100 * GAIN) == pytest.approx(5.0, abs=1e-6)
    assert abs(driven(*wheel("gazebo"), target=5.0, steps=20)) > 1e3  # the same from step to step


def test_it_lags_by_the_load_over_the_gain_as_the_law_says():
    assert driven(*wheel(), target=5.0, load=0.7) == pytest.approx(5.0 - 0.7 / GAIN, abs=1e-6)
    assert driven(*wheel(friction=0.4), target=5.0) == pytest.approx(5.0 - 0.4 / GAIN, abs=1e-6)
    assert driven(*wheel(friction=0.4), target=0.3) == pytest.approx(0.0, abs=1e-6)


def test_dry_friction_holds_what_the_law_does_not_move_against_other_forces_too():
    world, joint = wheel(friction=0.4)
    assert driven(world, joint, target=0.3, load=0.6) == pytest.approx(0.0, abs=1e-9)
    assert joint.position() == pytest.approx(0.0, abs=1e-9)
    assert -0.5 < driven(world, joint, target=0.3, load=0.8) < -0.05  # the law slows what pulls it along


@pytest.mark.parametrize("gain", [40.0, 4000.0])
def test_a_law_of_the_position_alone_comes_to_rest(gain):
    world, joint = wheel()
    for _ in range(1000):
        joint.add_law(gain * (0.1 - joint.position()), -gain * world.dt)
        world.step(1)
    assert joint.position() == pytest.approx(0.1, abs=1e-9) and abs(joint.velocity()) < 1e-9


def test_the_bounds_of_the_force_hold():
    for effort, bound in ((-1.0, 0.02), (0.02, 1e9)):
        model = pendulum(length=0.0, mass=0.1, inertia=INERTIA)
        (joint,) = model.joints
        model = replace(model, joints=(replace(joint, axes=(replace(joint.axes[0], effort=effort),)),))
        world = ode_sim.World()
        hinge = world.spawn(model).joints["hinge"]
        assert driven(world, hinge, 5.0, steps=40, bound=bound) == pytest.approx(0.02 / INERTIA * 0.04, rel=1e-3)


def limited(solver, inertia, velocity):
    """A joint that may turn at ``velocity`` and is told 5 rad/s by a law that is strong for it."""
    model = pendulum(length=0.0, mass=0.1, inertia=inertia)
    (joint,) = model.joints
    model = replace(model, joints=(replace(joint, axes=(replace(joint.axes[0], velocity=velocity),)),))
    world = ode_sim.World()
    world.physics.solver = solver
    hinge = world.spawn(model).joints["hinge"]
    begin = hinge.position()
    for _ in range(400):
        hinge.add_law(max(min(GAIN * (5.0 - hinge.velocity()), 25.0), -25.0), GAIN, 25.0)
        world.step(1)
    return (hinge.position() - begin) / 0.4


def test_a_limit_of_speed_takes_the_force_away_and_no_more():
    """As in Gazebo: what a single step gives a light joint may be beyond the limit, and it keeps that; a heavy one stays there."""
    one_step = 0.001 * GAIN / INERTIA
    assert limited("quick", INERTIA, 1.5) == pytest.approx(5.0 * one_step / (1 + one_step), rel=0.01)
    assert limited("quick", 0.1, 1.5) == pytest.approx(limited("gazebo", 0.1, 1.5), rel=0.01) == pytest.approx(1.5, rel=0.03)


def test_where_the_gain_is_low_it_is_the_force_of_add_force():
    gain = 0.1 * GAIN
    world, joint = wheel()
    other, alike = wheel()
    for _ in range(50):
        joint.add_law(gain * (2.0 - joint.velocity()), gain)
        alike.add_force(gain * (2.0 - alike.velocity()))
        assert joint.effort() == alike.effort()
        world.step(1)
        other.step(1)
    assert joint.velocity() == alike.velocity()


def test_an_arm_holds_still_at_a_step_of_ten_milliseconds():
    world = ode_sim.World()
    world.physics.max_step_size = 0.01
    robot = world.spawn(arm(6, effort=1e4))
    joints = [joint for joint in robot.joints.values() if joint.axis_count]
    p, d = 3000.0, 100.0
    for _ in range(500):
        for joint in joints:
            joint.add_law(p * (0.2 - joint.position()) - d * joint.velocity(), d + p * world.dt)
        world.step(1)
    assert [joint.position() for joint in joints] == pytest.approx([0.2] * 6, abs=0.02)
    assert max(abs(joint.velocity()) for joint in joints) < 1e-3


def test_continued_from_a_snapshot_every_bit_is_the_same():
    world, joint = wheel()
    joint.add_law(GAIN * 3.0, GAIN)
    saved = world.save()
    world.step(1)
    first = bytes(world.save())
    world.restore(saved)
    world.step(1)
    assert bytes(world.save()) == first


def test_a_force_that_is_no_number_is_refused():
    _, joint = wheel()
    for bad in ((float("nan"), 1.0), (1.0, float("inf"))):
        with pytest.raises(ValueError, match="force of a controller"):
            joint.add_law(*bad)
