"""A snapshot is the whole state: what is restored goes on with the same bits, and what is refused changes nothing."""

import math
import random
from dataclasses import replace

import ode_sim
import pytest
from ode_sim.description.model import Inertial, Pose
from physics_checks import refused, runs_on
from physics_determinism import busy_world
from physics_models import arm, box, diff_drive, ground, sphere


def test_a_refused_snapshot_changes_nothing():
    world = ode_sim.World()
    world.spawn(ground())
    world.spawn(sphere())
    first = world.spawn(box("thing", at=(1, 0, 1)))
    held = world.attach(None, first.links["link"])
    world.step(10)
    saved = world.save()
    world.remove("thing")
    assert not held.active
    world.spawn(box("thing", at=(1, 0, 2)))
    world.physics.max_step_size, world.gravity = 0.002, (0, 0, -1)
    world.rng("noise").normal()
    world.step(5)
    before, time = bytes(world.save()), world.time
    assert "other models" in refused(lambda: world.restore(saved))
    assert bytes(world.save()) == before and world.time == time and world.dt == 0.002 and world.gravity == (0, 0, -1)
    assert world.core.welds() == []
    world.remove("thing")
    runs_on(world)


def test_a_damaged_snapshot_changes_nothing():
    world = busy_world()
    robot = world.models["robot"]
    world.attach(robot.links["base"], world.models["box3"].links["link"])
    world.models["hand"].joints["left"].follow(world.models["mover"].joints["j1"], 0.1)
    world.rng("noise").normal()
    world.step(30)
    good = world.save()
    world.step(30)
    before = bytes(world.save())
    rng, n = random.Random(1), len(good.state)
    damaged = [replace(good, state=good.state[:k]) for k in (0, 7, 8, 16, 100, n // 2, n - 1)]
    damaged += [
        replace(good, state=good.state + b"\0"),
        replace(good, welds=()),
        replace(good, generators=b"{}"),
        replace(good, generators=b"\x80\x04."),
    ]
    for _ in range(200):
        at = rng.randrange(n)
        damaged.append(replace(good, state=good.state[:at] + bytes([good.state[at] ^ (1 << rng.randrange(8))]) + good.state[at + 1 :]))
    for snapshot in damaged:
        refused(lambda: world.restore(snapshot))
    assert bytes(world.save()) == before
    world.restore(good)
    assert world.save() == good


def test_an_attachment_is_never_taken_for_a_later_one():
    world = ode_sim.World()
    first, second = world.spawn(box("first", at=(0, 0, 1))), world.spawn(box("second", at=(1, 0, 1)))
    empty = world.save()
    one = world.attach(None, first.links["link"])
    held = world.save()
    world.restore(empty)
    assert not one.active
    two = world.attach(None, second.links["link"])
    assert two.active and not one.active
    one.detach()
    assert two.active
    world.restore(held)
    assert one.active and not two.active
    world.step(10)
    assert first.pose.p[2] == pytest.approx(1.0, abs=1e-6) and second.pose.p[2] < 1.0


def test_settings_and_seed_come_back_with_a_snapshot():
    world = ode_sim.World(seed=3)
    world.physics.max_step_size, world.physics.iters = 0.002, 33
    saved = world.save()
    number = ode_sim.World(seed=3).rng("new").normal()
    other = ode_sim.World(seed=9)
    other.restore(saved)
    assert (other.physics.max_step_size, other.physics.iters, other.dt, other.seed) == (0.002, 33, 0.002, 3)
    assert other.rng("new").normal() == number


# ---------------------------------------------------------------------------------------------- the same bits


def goes_on_the_same(world, steps=20):
    """Saving, and going on from what was saved: as if nothing had been done."""
    saved = world.save()
    world.step(steps)
    end = world.save()
    world.restore(saved)
    assert world.save() == saved
    world.step(steps)
    assert world.save() == end


def test_what_an_attachment_bears_is_never_a_silent_nan():
    """The solver loses its way where links are held far from each other: the state says nothing rather than NaN."""
    world = ode_sim.World()
    robot = world.spawn(diff_drive(at=(0, 0, 0.3)))
    held = world.attach(robot.links["right"], robot.links["base"])
    world.step(3)
    held.pose = Pose((0, 1e6, 0))
    for _ in range(10):
        world.step(5)
        goes_on_the_same(world, 5)
    assert any("infinite" in line for line in world.messages)


@pytest.mark.parametrize("upper", [50.0, math.inf])
def test_a_hinge_that_leaves_its_stop_fast_forgets_it(upper):
    """ODE looks at no stop of a hinge that cannot reach either within a turn, and would hold the hinge at the one it saw last."""
    world = ode_sim.World()
    wheel = world.spawn(diff_drive(at=(0, 0, 0.5))).joints["left"]
    wheel.set_limits(2.9, upper)
    wheel.set_position(2.9)
    world.step(2)
    wheel.set_motor(600.0, 1e6)
    world.step(3)
    start = wheel.position()
    goes_on_the_same(world, 20)
    assert wheel.velocity() == pytest.approx(600.0, rel=1e-3)
    assert wheel.position() == pytest.approx(start + 20 * 0.6, abs=0.01)


def test_settings_of_a_moment_ago_are_part_of_the_state():
    """What changes the plan of bodies puts them in place anew; a snapshot taken then holds exactly that."""
    world = ode_sim.World()
    world.spawn(ground())
    robot = world.spawn(diff_drive(at=(0.1, 0.2, 0.05)), pose=Pose((0.3, 0.1, 0.2), (0.1, 0.2, 0.3, 0.9)))
    for i in range(40):
        world.step(7)
        robot.joints["left"].damping = 1e-3 * i
        goes_on_the_same(world, 5)


def test_masses_come_back_with_all_that_follows_from_them():
    world = ode_sim.World()
    world.spawn(ground())
    robot = world.spawn(arm(2, bolted=False))
    robot.joints["j1"].drive_to(0.4)
    world.step(30)
    saved = world.save()
    world.step(30)
    end = world.save()
    robot.links["base"].set_inertial(Inertial(70.0, ixx=1e6, iyy=1e6, izz=1e6))
    world.step(10)
    world.restore(saved)
    assert robot.links["base"].mass == 1.0
    world.step(30)
    assert world.save() == end
