"""`solver: gazebo`: what Gazebo Classic's solver is known for, and what must not depend on the solver."""

import math
from dataclasses import replace

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Model, Pose, Surface
from ode_sim.physics import SOLVER_VARIABLE
from physics_models import arm, box, diff_drive, ground, pendulum, sphere

G = 9.8


def world_with(*models, solver="gazebo"):
    world = ode_sim.World()
    world.physics.solver = solver
    world.spawn(ground())
    return (world, *(world.spawn(model) for model in models))


def test_the_world_file_or_the_environment_chooses(monkeypatch):
    text = "<sdf version='1.6'><world name='w'><physics type='ode'><ode><solver><type>{}</type></solver></ode></physics></world></sdf>"
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
    world.step(2800)
    forces = []
    for _ in range(200):  # from step to step they come and go between wheels and casters
        world.step()
        forces.append(-world.contacts()["force"][:, 2].sum())
    assert robot.twist().linear[0] == pytest.approx(0.2, rel=0.03)
    assert np.mean(forces) == pytest.approx(5.6 * G, rel=0.03)


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


# What Gazebo Classic 11.1.0 made of bodies of 1 kg boxes of 0.2 m and balls of 0.05 m and 0.2 kg over plates whose upper side is at 1.1 m,
# at 1 ms: surface of the body, surface of the plate, height above it, and the height of the middle at these times, s.
LOOSE, FAST, LIVELY = dict(max_vel=1000.0), dict(max_vel=1.0), dict(restitution=0.8, bounce_threshold=0.01)
SOFT, TOLERANT = dict(kp=1e4, kd=1.0), dict(min_depth=0.005)
RECORDED = {
    "ball, a loose plate": (0.05, {}, LOOSE, 1.0, {0.5: 1.15, 0.6: 1.15, 2.48: 1.15}),
    "loose ball": (0.05, LOOSE, {}, 1.0, {0.5: 1.29425, 0.6: 1.52914, 0.9: 1.64581, 2.48: 1.15}),
    "loose ball, a loose plate": (0.05, LOOSE, LOOSE, 1.0, {0.5: 1.29425, 0.6: 1.52914, 0.9: 1.64581}),
    "ball of 1 m/s": (0.05, FAST, {}, 1.0, {0.5: 1.18595, 0.6: 1.1904, 0.9: 1.1633}),
    "ball of 0.1 m/s": (0.05, dict(max_vel=0.1), {}, 1.0, {0.5: 1.15, 0.6: 1.15}),
    "lively ball and plate": (0.05, LIVELY, LIVELY, 1.0, {0.5: 1.15, 0.6: 1.15}),
    "loose lively ball, a lively plate": (
        0.05,
        dict(LOOSE, **LIVELY),
        LIVELY,
        1.0,
        {0.5: 1.30574, 0.6: 1.56456, 0.9: 1.75301, 2.48: 1.28776},
    ),
    "soft box": (0.2, SOFT, {}, 0.0, {0.6: 1.19495, 2.48: 1.19495}),
    "soft box and plate": (0.2, SOFT, SOFT, 0.0, {0.6: 1.18269, 2.48: 1.18269}),
    "box set 5 cm in": (0.2, {}, {}, -0.05, {0.6: 1.2, 2.48: 1.2}),
    "loose box set 5 cm in": (0.2, LOOSE, {}, -0.05, {0.6: 29.3889, 2.48: 95.0251}),
    "box of 0.1 m/s set 5 mm in": (0.2, dict(max_vel=0.1), {}, -0.005, {0.6: 1.2, 2.48: 1.2}),
    "tolerant box": (0.2, TOLERANT, {}, -0.002, {0.6: 1.198, 2.48: 1.198}),
    "tolerant box and plate": (0.2, TOLERANT, TOLERANT, -0.002, {0.6: 1.198, 2.48: 1.198}),
}


@pytest.mark.parametrize("what", RECORDED)
def test_contacts_are_those_of_gazebo_to_four_digits(what):
    size, body, plate, height, recorded = RECORDED[what]
    world = ode_sim.World()
    world.physics.solver = "gazebo"
    world.spawn(box("plate", at=(0, 0, 1), size=(2, 2, 0.2), surface=Surface(**plate), static=True))
    if size == 0.05:
        model = world.spawn(sphere(at=(0, 0, 1.15 + height), radius=0.05, mass=0.2, surface=Surface(**body)))
    else:
        model = world.spawn(box(at=(0, 0, 1.2 + height), size=(0.2, 0.2, 0.2), surface=Surface(**body)))
    heights = {}
    for time in recorded:
        world.step(round(time / world.dt) - world.iterations)
        heights[time] = model.pose.p[2]
    assert heights == pytest.approx(recorded, rel=1e-4)


def test_of_two_that_move_the_slower_and_less_tolerant_counts_and_the_last_collision_is_the_bodys():
    """As Gazebo's ODELink and its ODE have it: each collision of a link writes its max_vel and min_depth over the body's."""

    def comes_up(upper, lower, last=None):
        world, low, high = world_with(
            box("low", size=(0.2, 0.2, 0.1), mass=1000.0, surface=Surface(**lower)), box("high", at=(0, 0, 0.1), surface=Surface(**upper))
        )
        if last is not None:
            world.remove("high")
            link = box("high", at=(0, 0, 0.1), surface=Surface(**upper)).links[0]
            off = replace(link.collisions[0], name="off", pose=Pose((0, 0, 3)), surface=Surface(**last))
            high = world.spawn(Model("high", Pose((0, 0, 0.1)), (replace(link, collisions=(*link.collisions, off)),)))
        assert low.pose.p[2] == pytest.approx(0.05, abs=1e-3)
        world.step(2)
        return high.twist().linear[2]

    assert comes_up(LOOSE, LOOSE) > 5.0
    assert comes_up(LOOSE, {}) == pytest.approx(0.01, abs=0.03) and comes_up({}, LOOSE) == pytest.approx(0.01, abs=0.03)
    assert comes_up(LOOSE, LOOSE, last={}) == pytest.approx(0.01, abs=0.03)
    assert comes_up({}, LOOSE, last=LOOSE) > 5.0


def cubes(count, masses=None):
    """Gazebo 11.1.0 was given the same: cubes of 0.2 m on each other, friction 1, on the stock ground plane."""
    world = ode_sim.World()
    world.physics.solver = "gazebo"
    world.spawn(ground())
    return world, [
        world.spawn(box(f"s{i}", at=(0, 0, round(0.2 * (i + 0.5), 9)), size=(0.2, 0.2, 0.2), mass=(masses or [1.0] * count)[i]))
        for i in range(count)
    ]


def test_a_stack_leans_as_it_does_in_gazebo():
    """It should stand straight: which way the iterations move it follows from the order of bodies, pairs and contacts alone."""
    world, stack = cubes(3)
    world.step(4900)
    assert np.hypot(*stack[2].pose.p[:2]) == pytest.approx(0.042, abs=0.01)  # the last bits decide about the rest
    assert stack[2].pose.p[2] == pytest.approx(0.5, abs=1e-3)


@pytest.mark.parametrize("count", [5, 7])
def test_stacks_that_stand_in_gazebo_stand(count):
    world, stack = cubes(count)
    world.step(4900)
    assert stack[-1].pose.p[2] == pytest.approx(0.2 * count - 0.1, abs=1e-3)


def test_a_heavy_cube_falls_from_a_light_one_when_it_does_in_gazebo():
    world, (_, heavy) = cubes(2, [1.0, 100.0])
    while heavy.pose.p[2] > 0.2 and world.time < 1.0:
        world.step()
    assert world.time == pytest.approx(0.244, rel=0.02)
