"""Links held together while the world runs."""

import math

import pytest
from ode_sim import Pose, World
from ode_sim.math3 import norm, relative, sub
from physics_models import arm, box, gripper, ground


def held_box(world):
    """A box of 2 kg hanging on the tip of the arm, 0.3 m beside it."""
    robot, thing = world.spawn(arm()), world.spawn(box(at=(0.3, 0, 1.3), mass=2.0))
    return robot, thing, world.attach(robot.links["link5"], thing.links["link"])


def test_carried_along_exactly_by_position_commanded_joints():
    world = World()
    robot, thing, attachment = held_box(world)
    before = relative(robot.links["link5"].pose, thing.pose)
    for i in range(1000):
        robot.joints["j0"].drive_to(i / 1000)
        robot.joints["j1"].drive_to(0.3 * i / 1000)
        for name in ("j2", "j3", "j4", "j5"):
            robot.joints[name].drive_to(0.0)
        world.step()
    after = relative(robot.links["link5"].pose, thing.pose)
    assert robot.joints["j0"].position() == pytest.approx(0.999)
    assert norm(sub(after.p, before.p)) < 1e-4
    assert abs(sum(a * b for a, b in zip(after.q, before.q))) == pytest.approx(1, abs=1e-6)
    assert attachment.active
    attachment.detach()
    z = thing.pose.p[2]
    world.step(100)
    assert not attachment.active
    assert z - thing.pose.p[2] > 0.03  # falls: what moved with the arm moves on


def test_weight_is_felt_by_what_carries():
    world = World()
    robot, thing = world.spawn(gripper(lift_effort=10.0)), world.spawn(box(at=(0, 0, 0.15), mass=5.0))
    robot.joints["lift"].set_motor(0.0, 100.0)
    attachment = world.attach(robot.links["carriage"], thing.links["link"])
    world.step(300)
    assert robot.joints["lift"].position() == pytest.approx(0, abs=1e-4)
    robot.joints["lift"].set_motor(0.0, 40.0)  # less than the 60 N of all together
    world.step(100)
    assert robot.joints["lift"].position() < -0.01
    assert norm(sub(thing.pose.p, robot.links["carriage"].pose.p)) == pytest.approx(0.15, abs=1e-4)
    attachment.detach()


def test_attached_links_do_not_collide_and_others_do():
    world = World()
    world.spawn(ground())
    first, second = world.spawn(box("first")), world.spawn(box("second", at=(0.05, 0, 0.05)))
    attachment = world.attach(first.links["link"], second.links["link"])
    world.step(500)
    assert second.pose.p == pytest.approx((0.05, 0, 0.05), abs=1e-4)  # overlapping, and resting on the ground
    attachment.detach()
    world.step(500)
    assert second.pose.p[0] - first.pose.p[0] > 0.054  # pushed apart, at 0.01 m/s


def test_held_in_the_world_and_lowered():
    world = World()
    thing = world.spawn(box(at=(0, 0, 2), mass=50.0))
    attachment = world.attach(None, thing.links["link"])
    world.step(200)
    assert thing.pose.p == pytest.approx((0, 0, 2), abs=1e-5)
    for i in range(1000):
        attachment.pose = Pose((0, 0, 2 - 0.0001 * i))
        world.step()
    assert thing.pose.p[2] == pytest.approx(1.9, abs=1e-3)


def test_part_of_snapshots():
    world = World()
    robot, thing, attachment = held_box(world)
    robot.joints["j1"].set_motor(0.5, 200.0)
    world.step(50)
    saved = world.save()
    world.step(200)
    expected = world.save()
    attachment.detach()
    world.step(50)
    world.restore(saved)
    assert attachment.active
    world.step(200)
    assert bytes(world.save()) == bytes(expected)


def test_what_it_bears_is_part_of_snapshots_too():
    world = World()
    robot = world.spawn(arm(links=1, bolted=True))
    world.attach(robot.links["base"], robot.links["link0"])
    robot.joints["j0"].feedback()
    world.step(3)
    robot.joints["j0"].drive_to(0.0)  # from here on nothing solves for the attachment
    world.step(3)
    saved = world.save()
    world.step(5)
    expected = world.save()
    world.restore(saved)
    world.step(5)
    assert bytes(world.save()) == bytes(expected)


def test_ends_with_either_model():
    world = World()
    robot, thing, attachment = held_box(world)
    world.remove("box")
    world.step(10)
    assert not attachment.active


@pytest.mark.parametrize("reset", [World.reset, World.reset_poses])
def test_a_reset_lets_go_what_has_been_taken_along_and_keeps_what_was_held_from_the_start(reset):
    """As users mean it: a pin at the start is part of the robot, a box in the hand is not. Gazebo keeps both, and tears the box back."""
    world = World()
    pinned, thing = world.spawn(box(at=(0, 0, 3), name="pinned")), world.spawn(box(at=(0, 0, 5)))
    pin = world.attach(None, pinned.links["link"])
    world.step(10)
    thing.pose = Pose((1, 0, 3))
    held = world.attach(pinned.links["link"], thing.links["link"])
    world.step(10)
    reset(world)
    assert pin.active and not held.active
    world.step(100)
    assert pinned.pose.p[2] == pytest.approx(3, abs=1e-6)
    assert thing.pose.p[2] == pytest.approx(5 - 9.8 * 0.1**2 / 2, abs=1e-3)


def test_wakes_what_sleeps():
    world = World()
    world.spawn(ground())
    first = world.spawn(box("first"))
    world.step(2000)
    assert first.asleep
    attachment = world.attach(None, first.links["link"])
    attachment.pose = Pose((0, 0, 0.06))
    world.step(100)
    assert first.pose.p[2] == pytest.approx(0.06, abs=1e-3)


def test_refuses_what_cannot_be_held():
    world = World()
    floor = world.spawn(ground())
    with pytest.raises(ValueError, match="cannot be attached to the world"):
        world.attach(None, floor.links["link"])
    thing = world.spawn(box())
    with pytest.raises(ValueError, match="cannot be attached"):
        world.attach(thing.links["link"], thing.links["link"])


def test_two_robots_holding_one_thing():
    world = World()
    left, right = world.spawn(arm(links=2, at=(-0.5, 0, 0), name="left")), world.spawn(arm(links=2, at=(0.5, 0, 0), name="right"))
    thing = world.spawn(box(at=(0, 0, 0.5), mass=4.0))
    for robot in (left, right):
        for joint in robot.joints.values():
            if joint.axis_count:
                joint.set_motor(0.0, 100.0)
        world.attach(robot.links["link1"], thing.links["link"])
    world.step(500)
    assert math.dist(thing.pose.p, (0, 0, 0.5)) < 1e-3
