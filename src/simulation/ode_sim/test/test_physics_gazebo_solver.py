"""`solver: gazebo`: what Gazebo Classic's solver is known for, and what must not depend on the solver."""
import math

import numpy as np
import pytest

import ode_sim
from ode_sim.description.model import Surface
from ode_sim.physics import SOLVER_VARIABLE
from physics_models import arm, box, diff_drive, ground, pendulum

G = 9.8


def world_with(*models, solver="gazebo"):
    world = ode_sim.World()
    world.physics.solver = solver
    world.spawn(ground())
    return (world, *(world.spawn(model) for model in models))


def test_the_world_file_or_the_environment_chooses(monkeypatch):
    text = ("<sdf version='1.6'><world name='w'><physics type='ode'><ode><solver><type>{}</type></solver></ode></physics></world></sdf>")
    monkeypatch.delenv(SOLVER_VARIABLE, raising=False)
    assert [ode_sim.World.load(text.format(kind)).core.like_gazebo for kind in ("quick", "world", "gazebo")] == [False, False, True]
    monkeypatch.setenv(SOLVER_VARIABLE, "gazebo")
    assert ode_sim.World.load(text.format("quick")).core.like_gazebo and ode_sim.World().core.like_gazebo


def test_sliding_friction_is_a_pyramid_along_the_axes_of_the_world():
    def left(heading):
        world, load = world_with(box(surface=Surface(mu=0.4, mu2=0.4)))
        world.step(50)
        load.set_twist((2 * math.cos(heading), 2 * math.sin(heading), 0), (0, 0, 0))
        world.step(200)
        return np.linalg.norm(load.twist().linear)

    assert left(0.0) == pytest.approx(2 - 0.4 * G * 0.2, abs=0.03)
    assert left(math.pi / 4) == pytest.approx(2 - math.sqrt(2) * 0.4 * G * 0.2, abs=0.05)


def test_a_pendulum_swings_as_with_the_other_solver():
    readings = []
    for solver in ("quick", "gazebo"):
        world, swing = world_with(pendulum(), solver=solver)
        swing.joints["hinge"].set_position(1.0)
        world.step(2500)
        readings.append(swing.joints["hinge"].position())
    assert readings[0] == pytest.approx(readings[1], abs=5e-3)


def test_an_arm_on_motors_lags_by_what_fifty_iterations_leave():
    world, robot = world_with(arm(6))
    joints = [joint for joint in robot.joints.values() if joint.axis_count]
    for joint in joints:
        joint.set_motor(0.05, 100.0)
    world.step(2000)
    assert [joint.position() for joint in joints] == pytest.approx([0.1] * 6, abs=0.01)


def test_a_robot_drives_and_its_contacts_carry_it():
    world, robot = world_with(diff_drive())
    for link in robot.links.values():
        for collision in link.collisions.values():
            world.watch_contacts(collision)
    for joint in robot.joints.values():
        joint.set_motor(4.0, 5.0)
    world.step(3000)
    assert robot.twist().linear[0] == pytest.approx(0.2, rel=0.03)
    assert -world.contacts()["force"][:, 2].sum() == pytest.approx(5.6 * G, rel=0.03)


def test_overlap_is_undone_at_once_and_leaves_no_speed():
    world, load = world_with(box(at=(0, 0, 0.02)))
    world.step(20)
    assert load.pose.p[2] == pytest.approx(0.05, abs=2e-3) and abs(load.twist().linear[2]) < 0.05


def test_continued_from_a_snapshot_every_bit_is_the_same():
    world, robot, _ = world_with(diff_drive(), box(at=(0.5, 0, 0.05)))
    for joint in robot.joints.values():
        joint.set_motor(4.0, 5.0)
    world.step(500)
    saved = world.save()
    world.step(300)
    first = bytes(world.save())
    world.restore(saved)
    world.step(300)
    assert bytes(world.save()) == first
