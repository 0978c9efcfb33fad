"""Position-commanded joints: exact, no recoil, whatever the inertias; and real when they touch something."""

import math

import numpy as np
import ode_sim
import pytest
from ode_sim.description.model import Axis, Inertial, Joint, Link, Model, Pose, Surface
from ode_sim.math3 import compose, inverse, to_rpy
from physics_models import arm, box, diff_drive, gripper, ground, pendulum


def world_with(*models):
    world = ode_sim.World()
    world.spawn(ground())
    return (world, *(world.spawn(m) for m in models))


def turning(model):
    return [j for j in model.joints.values() if j.description.type != "fixed"]


@pytest.mark.parametrize("inertia", [1e8, 1.5e8])
def test_free_standing_arm_with_absurd_inertias_moves_exactly_and_its_base_stays(inertia):
    world, model = world_with(arm(8, bolted=False, inertia=inertia, mass=0.1, length=0.1, base_size=(0.3, 0.3, 1.0)))
    joints = turning(model)
    for joint in joints:
        joint.drive_to(0.0)
    world.step(1000)
    start = model.links["base"].pose
    for i in range(1, 1001):
        for joint in joints:
            joint.drive_to(i * 1e-3)
        world.step()
        assert all(joint.position() == i * 1e-3 for joint in joints)
        assert all(joint.velocity() == pytest.approx(1.0) for joint in joints)
    world.step(1000)
    moved = compose(inverse(start), model.links["base"].pose)
    assert np.abs(moved.p).max() < 1e-6 and np.abs(to_rpy(moved)).max() < 1e-6
    assert world.joint_positions[joints[3].index] == 1.0
    assert not world.messages


def test_links_are_where_the_angles_say():
    world, model = world_with(arm(3))
    for joint, q in zip(turning(model), (0.5, 1.0, -0.7)):
        joint.drive_to(q)
    world.step()
    tip = model.links["link2"].pose
    x = 0.2 * math.sin(1.0)
    assert tip.p == pytest.approx((x * math.cos(0.5), x * math.sin(0.5), 0.1 + 0.2 + 0.2 * math.cos(1.0)))
    assert world.link_poses[model.links["link2"].index, :3] == pytest.approx(tip.p)


def test_commands_stop_at_the_limits_and_refuse_nan():
    world, model = world_with(arm(1))
    joint = turning(model)[0]
    joint.drive_to(50.0)
    world.step()
    assert joint.position() == 3.0
    with pytest.raises(ValueError, match="arm::j0"):
        joint.drive_to(math.nan)


def test_letting_go():
    world = ode_sim.World()
    joint = world.spawn(pendulum()).joints["hinge"]
    joint.drive_to(1.0)
    world.step(100)
    assert joint.position() == 1.0 and joint.drive_active
    joint.drive_off()
    world.step(300)
    assert joint.position() < 0.9 and not joint.drive_active


def test_velocity_of_moved_links_is_true():
    world, model = world_with(arm(2))
    first, second = turning(model)
    second.drive_to(math.pi / 2)
    for i in range(100):
        first.drive_to(i * 2e-3)
        world.step()
    tip = model.links["link1"]
    assert tip.angular_velocity() == pytest.approx((0, 0, 2.0))
    assert np.linalg.norm(tip.com_velocity()) == pytest.approx(0.2, rel=1e-6)


@pytest.mark.parametrize("bolted", [True, False])
@pytest.mark.parametrize("inertia", [None, 1e8])
def test_an_arm_pushes_a_box_along(bolted, inertia):
    world, model = world_with(
        arm(3, bolted=bolted, inertia=inertia, mass=0.3, length=0.3, effort=50.0, velocity=3.0, base_size=(0.3, 0.3, 0.05))
    )
    joints = turning(model)
    for i in range(1000):
        for joint, q in zip(joints, (0.0, 2.0, 0.0)):
            joint.drive_to(q * i / 999)
        world.step()
    load = world.spawn(box(at=(0.5, 0.19, 0.05), mass=0.5, surface=Surface(mu=0.6, mu2=0.6)))
    world.step(100)
    worst = 0.0
    for i in range(2000):
        joints[0].drive_to(i * 5e-4)
        world.step()
        worst = max(worst, abs(joints[0].position() - i * 5e-4))
    assert math.atan2(load.pose.p[1], load.pose.p[0]) > 0.6  # ahead of the arm, from 0.36
    assert load.pose.p[2] == pytest.approx(0.05, abs=1e-3)
    assert worst < 5e-3
    assert np.linalg.norm(load.twist().linear) < 1e-6 or load.twist().linear[2] < 0.05
    assert not world.messages


def test_an_arm_pressed_into_a_wall_stalls_and_recovers():
    world, model = world_with(arm(3, length=0.3, mass=0.3, effort=20.0, velocity=3.0, base_size=(0.3, 0.3, 0.05)))
    joints = turning(model)
    joints[1].drive_to(math.pi / 2)
    joints[2].drive_to(0.0)
    joints[0].drive_to(0.0)
    world.step(10)
    world.spawn(box("wall", at=(0.3, 0.35, 0.3), size=(0.8, 0.1, 0.6), static=True))
    fastest = 0.0
    for i in range(2000):
        joints[0].drive_to(i * 1e-3)
        world.step()
        fastest = max(fastest, max(np.linalg.norm(link.com_velocity()) for link in model.links.values()))
    stalled = joints[0].position()
    assert 0.3 < stalled < 0.6  # at the wall, though told to go to 2
    assert joints[0].drive_pushing
    assert fastest < 2.0
    for i in range(2000):
        joints[0].drive_to(2.0 - i * 1e-3)
        world.step()
    world.step(200)
    assert joints[0].position() == joints[0].core.drive_target
    assert not joints[0].drive_pushing
    assert not world.messages


def test_a_gripper_closes_on_a_box_lifts_and_holds_it():
    world, hand, load, _ = world_with(
        gripper(effort=20.0),
        box(at=(0, 0, 0.225), size=(0.05, 0.05, 0.05), mass=0.2),
        box("stand", at=(0, 0, 0.1), size=(0.1, 0.03, 0.2), static=True),
    )
    lift, left, right = (hand.joints[n] for n in ("lift", "left", "right"))
    lift.drive_to(0.0)
    for i in range(500):
        for finger in (left, right):
            finger.drive_to(min(0.1, i * 2e-4))
        world.step()
    assert left.position() == pytest.approx(0.07, abs=1e-4) and right.position() == pytest.approx(0.07, abs=1e-4)
    world.watch_contacts(hand.links["left"].collisions["pad"])
    world.step()
    assert abs(world.contacts()["force"][:, 1].sum()) == pytest.approx(20.0, rel=0.01)  # the effort limit

    def in_hand():
        return np.subtract(load.pose.p, hand.links["carriage"].pose.p)

    for i in range(1000):
        lift.drive_to(0.3 * (1 - math.cos(math.pi * i / 999)) / 2)
        world.step()
    world.step(100)
    lifted = in_hand()
    assert load.pose.p[2] == pytest.approx(0.525, abs=1e-3)
    world.step(10000)
    assert np.linalg.norm(in_hand() - lifted) < 1e-3
    assert np.abs(to_rpy(load.pose)).max() < 1e-3
    for finger in (left, right):
        finger.drive_to(0.0)
    world.step(600)
    assert load.pose.p[2] < 0.3  # back on the stand or the floor
    assert left.position() == 0.0 and not left.drive_pushing


def test_ground_contact_of_the_base_changes_nothing():
    world, model = world_with(arm(2, bolted=False))
    for joint in turning(model):
        joint.drive_to(0.1)
    world.step(200)
    assert len(world.contacts()) > 0
    assert not any(joint.drive_pushing for joint in turning(model))


def test_position_driven_arm_on_a_driving_robot_rides_along():
    base = diff_drive()
    pole = Link("pole", Pose((0, 0, 0.15)), Inertial(0.2, Pose((0, 0, 0.1)), 1e-3, 0, 0, 1e-3, 0, 1e-4))
    joint = Joint("pan", "revolute", "base", "pole", axes=(Axis((0, 0, 1)),))
    world, robot = world_with(Model("robot", base.pose, base.links + (pole,), base.joints + (joint,)))
    for wheel in ("left", "right"):
        robot.joints[wheel].set_motor(10.0, 5.0)
    for i in range(2000):
        robot.joints["pan"].drive_to(i * 1e-3)
        world.step()
    assert robot.joints["pan"].position() == 1.999
    assert robot.pose.p[0] == pytest.approx(1.0, rel=0.03)
    assert robot.links["pole"].pose.p[0] == pytest.approx(robot.links["base"].pose.p[0], abs=1e-6)
    assert abs(to_rpy(robot.pose)[2]) < 0.01


def test_a_free_joint_on_a_position_driven_arm_swings():
    model = arm(1)
    bob = Link("bob", Pose((0, 0, 0.3)), Inertial(0.2, Pose((0, 0, -0.2)), 1e-3, 0, 0, 1e-3, 0, 1e-3))
    hinge = Joint("swing", "revolute", "link0", "bob", axes=(Axis((0, 1, 0)),))
    world, model = world_with(Model("arm", Pose(), model.links + (bob,), model.joints + (hinge,)))
    drive, swing = model.joints["j0"], model.joints["swing"]
    swing.set_position(0.5)
    drive.drive_to(0.0)
    seen = []
    for i in range(2000):
        drive.drive_to(0.5 * i / 1999)
        world.step()
        seen.append(swing.position())
    assert drive.position() == 0.5
    assert min(seen) < -0.4 and max(seen) < 0.52
    assert model.links["bob"].pose.p == pytest.approx((0, 0, 0.3), abs=1e-9)


def test_mimic_follows_its_leader():
    world, hand = world_with(gripper())
    left, right = hand.joints["left"], hand.joints["right"]
    right.follow(left, 0.5, 0.01)
    for i in range(100):
        left.drive_to(i * 1e-4)
        world.step()
        assert right.position() == pytest.approx(0.5 * left.position() + 0.01, abs=1e-12)
    right.follow(None)
    world.step()
    assert not right.drive_active


@pytest.mark.parametrize("gain, closed", [(1e3, 0.072), (1e4, 0.0701), (3e5, 0.0701)])
def test_a_follower_and_the_finger_that_it_follows_hold_a_block_still(gain, closed):
    """What one gives way the other is pushed: a follower that made it good at once would drive both to and fro."""
    world, hand, block, _ = world_with(
        gripper(),
        box("part", at=(0, 0, 0.225), size=(0.05, 0.05, 0.05), mass=0.05),
        box("stand", at=(0, 0, 0.1), size=(0.1, 0.03, 0.2), static=True),
    )
    left, right, lift = (hand.joints[n] for n in ("left", "right", "lift"))
    right.follow(left, 1.0, 0.0)
    lift.drive_to(0.0)

    def close(w):
        left.add_law(np.clip(gain * (closed - left.position()), -20, 20), gain * w.dt, 20.0)

    world.before_step.append(close)
    world.step(1000)
    speeds = []
    for i in range(500):
        lift.drive_to(i * 1e-4)
        world.step()
        speeds.append(right.velocity())
    assert block.pose.p[2] == pytest.approx(0.225 + 0.05, abs=1e-3)
    assert np.abs(speeds).max() < 0.01


def test_touching_from_the_start_is_no_collision_course():
    """A link that stands in the floor when its joint is first commanded moves on as commanded."""
    model = arm(1, base_size=(0.3, 0.3, 0.02), length=0.2, at=(0, 0, -0.05))
    world, model = world_with(model)
    joint = turning(model)[0]
    for i in range(200):
        joint.drive_to(i * 1e-3)
        world.step()
        assert joint.position() == i * 1e-3
