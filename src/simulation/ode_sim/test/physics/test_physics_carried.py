"""What hangs by free or driven joints beyond position-commanded ones: it pushes, weighs and swings as on a real robot."""

import math

import numpy as np
import ode_sim
import pytest
from ode_sim import Pose
from ode_sim.description.model import Axis, Box, Collision, Inertial, Joint, Link, Model
from ode_sim.math3 import norm, quat_from_rpy, sub, to_rpy
from physics_models import arm, box, box_inertia, car_urdf, diff_drive, ground

G = 9.8
WHEELBASE, TRACK, RADIUS = 0.5, 0.3, 0.06


def world_with(*models):
    world = ode_sim.World()
    world.spawn(ground())
    return (world, *(world.spawn(m) for m in models))


def car(**kind):
    (world,) = world_with()
    return world, world.spawn_urdf(car_urdf(**kind), pose=Pose((0, 0, RADIUS)))


def steer(robot, curvature, ends):
    """Ackermann angles for a turn of ``curvature`` (1/m) of the middle of the car; ``ends``: +1 front, -1 rear, steered ones."""
    for end, sign in ends.items():
        reach = WHEELBASE if len(ends) == 1 else WHEELBASE / 2  # from the line that the centre of the turn lies on
        for side, y in (("left", TRACK / 2), ("right", -TRACK / 2)):
            robot.joints[f"{end}_{side}_steer"].drive_to(sign * math.atan2(reach * curvature, 1 - y * curvature))


def drive(robot, speed, kind, wheels):
    """Drive by ODE's motor (VelocityJointInterface) or a force that regulates the speed (EffortJointInterface)."""
    for name in wheels:
        joint = robot.joints[f"{name}_wheel"]
        if kind == "velocity":
            joint.set_motor(speed / RADIUS, 10.0)
        else:
            joint.add_force(0.5 * (speed / RADIUS - joint.velocity()))


def circle(points):
    """Centre and radius of the circle through (N, 2) points, least squares."""
    x, y = np.asarray(points).T
    a, b, c = np.linalg.lstsq(np.column_stack((x, y, np.ones_like(x))), x * x + y * y, rcond=None)[0]
    return (a / 2, b / 2), math.sqrt(c + (a * a + b * b) / 4)


def total_weight(*models):
    return G * sum(link.mass for model in models for link in model.links.values())


def scale(world, steps=200):
    """Mean force (3,) N that the ground gives everything on it."""
    plate = world.models["ground_plane"].links["link"].collisions["plane"]
    world.watch_contacts(plate)
    sums = []
    for _ in range(steps):
        world.step()
        contacts = world.contacts()
        sign = np.where(contacts["collision1"] == plate.id, -1.0, 1.0)
        sums.append((contacts["force"] * sign[:, None]).sum(axis=0))
    return np.mean(sums, axis=0)


# ------------------------------------------------------------------------------------------ wheels beyond steering joints

REAR, FRONT = ("rear_left", "rear_right"), ("front_left", "front_right")


@pytest.mark.parametrize("kind", ["velocity", "effort"])
@pytest.mark.parametrize("wheels", [REAR, FRONT])
def test_car_with_position_commanded_steering_drives_straight(kind, wheels):
    world, robot = car()
    rolled = 0.0
    for i in range(5500):
        steer(robot, 0.0, {"front": 1})
        drive(robot, 1.0, kind, wheels)
        world.step()
        if i == 1000:  # wheels that spin at the start have gripped
            rolled = robot.joints["front_left_wheel"].position() - robot.pose.p[0] / RADIUS
    x, y, z = robot.pose.p
    assert x > 5.0
    assert abs(y) < 0.01 and abs(to_rpy(robot.pose)[2]) < 0.005
    assert z == pytest.approx(RADIUS, abs=1e-3)
    assert robot.joints["front_left_wheel"].position() - rolled == pytest.approx(x / RADIUS, rel=0.003)
    assert robot.links["front_left_tyre"].pose.p == pytest.approx((x + 0.25, 0.15 + y, RADIUS), abs=0.01)


@pytest.mark.parametrize("wheels, kind", [(REAR, "velocity"), (REAR, "effort"), (FRONT, "effort")])
def test_car_turns_on_the_circle_that_the_geometry_says(wheels, kind):
    world, robot = car()
    track = []
    for i in range(6000):
        steer(robot, 1 / 1.5, {"front": 1})  # about the middle of the rear axle, at once
        drive(robot, 0.5, kind, wheels)
        world.step()
        if i > 1000 and i % 50 == 0:
            yaw = to_rpy(robot.pose)[2]
            track.append((robot.pose.p[0] - 0.25 * math.cos(yaw), robot.pose.p[1] - 0.25 * math.sin(yaw)))
    assert circle(track)[1] == pytest.approx(1.5, rel=0.03)
    assert robot.joints["front_left_steer"].position() == pytest.approx(math.atan2(0.5, 1.35))


def test_four_steered_wheels_turn_about_the_middle():
    world, robot = car(rear_steering=True)
    track = []
    for i in range(5000):
        steer(robot, 1 / 0.8, {"front": 1, "rear": -1})
        drive(robot, 0.4, "effort", REAR + FRONT)
        world.step()
        if i > 1000 and i % 50 == 0:
            track.append(robot.pose.p[:2])
    assert circle(track)[1] == pytest.approx(0.8, rel=0.03)


def test_four_steered_wheels_drive_sideways():
    world, robot = car(rear_steering=True)
    for _i in range(4000):
        for corner in REAR + FRONT:
            robot.joints[f"{corner}_steer"].drive_to(0.7)
        drive(robot, 0.5, "velocity", REAR + FRONT)
        world.step()
    assert math.atan2(robot.pose.p[1], robot.pose.p[0]) == pytest.approx(0.7, abs=0.01)
    assert math.hypot(*robot.pose.p[:2]) == pytest.approx(2.0, rel=0.03)
    assert abs(to_rpy(robot.pose)[2]) < 0.01


def test_car_pushes_a_box_and_is_held_by_a_wall():
    world, robot = car()
    load = world.spawn(box(at=(0.6, 0, 0.05), size=(0.1, 0.3, 0.1), mass=1.0))
    world.spawn(box("wall", at=(1.6, 0, 0.2), size=(0.1, 1.0, 0.4), static=True))
    for i in range(4000):
        steer(robot, 0.0, {"front": 1})
        for name in FRONT:
            robot.joints[f"{name}_wheel"].add_force(0.4 if i < 1500 else 1.0)
        world.step()
        if i == 1500:
            assert load.pose.p[0] > 0.7
            start = load.pose.p[0]
    assert load.pose.p[0] > start and load.pose.p[0] == pytest.approx(1.5, abs=0.01)  # pressed to the wall
    assert robot.pose.p[0] == pytest.approx(1.5 - 0.05 - 0.25, abs=0.06)
    assert not world.messages


def test_a_driven_wheel_beyond_a_steering_joint_gives_its_force_to_the_car():
    """Torque over radius is the force that speeds up car and wheels."""
    world, robot = car()
    for _ in range(200):
        steer(robot, 0.0, {"front": 1})
        world.step()
    start = robot.twist().linear[0]
    for _ in range(500):
        steer(robot, 0.0, {"front": 1})
        for name in FRONT:
            robot.joints[f"{name}_wheel"].add_force(0.2)
        world.step()
    mass = total_weight(robot) / G
    effective = mass + 4 * 7e-4 / RADIUS**2
    assert robot.twist().linear[0] - start == pytest.approx(2 * 0.2 / RADIUS / effective * 0.5, rel=0.02)


@pytest.mark.parametrize("speed", [0.0, 0.5])
def test_jumping_steering_commands_do_not_throw_the_car(speed):
    world, robot = car()
    highest = 0.0
    for i in range(3000):
        steer(robot, (1.2 if i // 300 % 2 else -1.2), {"front": 1})
        drive(robot, speed, "velocity", REAR)
        world.step()
        highest = max(highest, abs(robot.pose.p[2] - RADIUS), *(abs(a) for a in to_rpy(robot.pose)[:2]))
    assert highest < 2e-3
    assert norm(robot.twist().linear) < speed * 1.3 + 1e-3


def test_parked_car_stays_where_it_is_while_its_wheels_are_steered():
    world, robot = car()
    drive(robot, 0.0, "velocity", REAR + FRONT)
    world.step(500)
    before = robot.pose
    for i in range(2000):
        steer(robot, 1.2 * math.sin(i * 2e-3), {"front": 1})
        world.step()
    assert norm(sub(robot.pose.p, before.p)) < 1e-3
    assert abs(to_rpy(robot.pose)[2] - to_rpy(before)[2]) < 1e-3


# ------------------------------------------------------------------------------------------ weight, reaction, swing


def loaded_arm(inertia=None, lower=-1e16, upper=1e16, effort=-1.0):
    """A free-standing base, two position-driven joints, and a heavy bar on a free hinge beyond."""
    model = arm(2, bolted=False, inertia=inertia, mass=1.0, base_size=(0.8, 0.8, 0.1))
    bar = Link("bar", Pose((0, 0, 0.5)), Inertial(3.0, Pose((0, 0, -0.15)), 0.02, 0, 0, 0.02, 0, 0.02))
    hinge = Joint("swing", "revolute", "link1", "bar", axes=(Axis((0, 1, 0), lower, upper, effort),))
    return Model("arm", Pose(), model.links + (bar,), model.joints + (hinge,))


@pytest.mark.parametrize("kind", ["free", "driven", "motor"])
def test_scale_shows_the_weight_of_what_hangs_beyond(kind):
    world, model = world_with(loaded_arm())
    swing = model.joints["swing"]
    for i in range(1500):
        model.joints["j0"].drive_to(0.3)
        model.joints["j1"].drive_to(min(i * 1e-3, 0.6))
        if kind == "driven":
            swing.add_force(60 * (-0.6 - swing.position()) - 5 * swing.velocity())
        elif kind == "motor":
            swing.set_motor(0.0, 50.0)
        world.step()
    if kind == "free":
        swing.damping = 2.0
        world.step(3000)
    world.before_step.append(lambda w: kind == "driven" and swing.add_force(60 * (-0.6 - swing.position()) - 5 * swing.velocity()))
    assert scale(world) == pytest.approx((0, 0, total_weight(model)), abs=0.05)
    assert model.joints["j1"].position() == 0.6
    assert not world.messages


def test_weight_beyond_can_tip_the_base_over():
    model = arm(1, bolted=False, mass=0.5, length=0.1, base_size=(0.2, 0.2, 0.1))
    boom = Link("boom", Pose((0, 0, 0.2)), Inertial(2.0, Pose((0.4, 0, 0)), 1e-3, 0, 0, 0.03, 0, 0.03))
    hinge = Joint("boom", "revolute", "link0", "boom", axes=(Axis((0, 1, 0)),))
    world, model = world_with(Model("crane", Pose(), model.links + (boom,), model.joints + (hinge,)))
    model.joints["j0"].drive_to(0.0)
    model.joints["boom"].set_motor(0.0, 100.0)
    world.step(1500)
    assert to_rpy(model.links["base"].pose)[1] > 0.2


def test_a_swinging_pendulum_moves_the_trolley_that_stands_free():
    """Momentum of a floating base, a position-driven joint and a free pendulum beyond it is kept."""
    world = ode_sim.World()
    world.gravity = (0.0, 0.0, 0.0)
    model = world.spawn(loaded_arm())
    for name in ("j0", "j1"):
        model.joints[name].drive_to(0.0)
    world.step()
    links = model.links.values()
    model.links["bar"].set_twist((0.6, 0, 0), (0, -4.0, 0))  # about its hinge

    def momentum():
        return sum(np.array(link.com_velocity()) * link.mass for link in links)

    start = momentum()
    world.step(500)
    assert momentum() == pytest.approx(start, abs=1e-6)
    assert norm(model.links["base"].com_velocity()) > 0.05


def test_gantry_crane_load_swings_as_its_trolley_speeds_up():
    """A position-commanded trolley on a free-standing frame: the rope hangs back at atan(a/g)."""
    frame = Link("frame", Pose((0, 0, 0.5)), box_inertia(200.0, (2, 1, 1)), (Collision("c", Pose(), Box((2, 1, 1))),))
    trolley = Link("trolley", Pose((0, 0, 1.0)), box_inertia(1.0, (0.1, 0.1, 0.1)))
    rope = Link("load", Pose((0, 0, 1.0)), Inertial(0.5, Pose((0, 0, -0.4)), 1e-5, 0, 0, 1e-5, 0, 1e-5))
    joints = (
        Joint("rail", "prismatic", "frame", "trolley", axes=(Axis((1, 0, 0)),)),
        Joint("rope", "revolute", "trolley", "load", axes=(Axis((0, 1, 0), damping=1.0),)),
    )
    world, crane = world_with(Model("crane", Pose(), (frame, trolley, rope), joints))
    for i in range(3000):
        crane.joints["rail"].drive_to(0.5 * 1.0 * (i * 1e-3) ** 2)
        world.step()
    assert crane.joints["rope"].position() == pytest.approx(math.atan2(1.0, G), rel=0.02)
    assert crane.joints["rail"].position() == pytest.approx(0.5 * 2.999**2)
    assert norm(sub(crane.links["frame"].pose.p, (0, 0, 0.5))) < 1e-3


@pytest.mark.parametrize("bolted", [True, False])
def test_pendulum_on_a_turning_driven_joint_flies_out(bolted):
    """Governor: at w^2 l > g the angle is acos(g / (w^2 l))."""
    post = Link("post", Pose((0, 0, 0.5)), box_inertia(500.0, (1, 1, 1)), (Collision("c", Pose(), Box((1, 1, 1))),))
    head = Link("head", Pose((0, 0, 1.8)), box_inertia(1.0, (0.1, 0.1, 0.1)))
    bob = Link("bob", Pose((0, 0, 1.8)), Inertial(0.2, Pose((0, 0, -0.5)), 1e-6, 0, 0, 1e-6, 0, 1e-6))
    joints = (
        Joint("turn", "revolute", "post", "head", axes=(Axis((0, 0, 1)),)),
        Joint("out", "revolute", "head", "bob", axes=(Axis((0, 1, 0), damping=0.2),)),
    )
    if bolted:
        joints += (Joint("bolt", "fixed", "world", "post"),)
    world, model = world_with(Model("governor", Pose(), (post, head, bob), joints))
    model.joints["out"].set_position(0.5)
    for i in range(6000):
        model.joints["turn"].drive_to(6.0 * i * 1e-3)
        world.step()
    assert abs(model.joints["out"].position()) == pytest.approx(math.acos(G / (36 * 0.5)), rel=0.01)


def test_absurd_inertias_beyond_do_not_move_the_base():
    """A hand with free fingers of 1e8 kg m2 at the end of a position-commanded arm: no recoil."""
    model = arm(4, bolted=False, inertia=1e8, mass=0.1, length=0.1, base_size=(0.3, 0.3, 1.0))
    fingers, joints = [], []
    for i, y in enumerate((0.02, -0.02)):
        fingers.append(Link(f"finger{i}", Pose((0, y, 1.4)), Inertial(0.1, Pose((0, 0, 0.02)), 1e8, 0, 0, 1e8, 0, 1e8)))
        joints.append(Joint(f"f{i}", "revolute", "link3", f"finger{i}", axes=(Axis((1, 0, 0), -0.5, 0.5),)))
    world, model = world_with(Model("arm", Pose(), model.links + tuple(fingers), model.joints + tuple(joints)))
    moving = [model.joints[f"j{i}"] for i in range(4)]
    for joint in moving:
        joint.drive_to(0.0)
    world.step(500)
    start = model.links["base"].pose
    for i in range(1000):
        for joint in moving:
            joint.drive_to(i * 3e-4)
        world.step()
        assert all(joint.position() == i * 3e-4 for joint in moving)
    assert norm(sub(model.links["base"].pose.p, start.p)) < 1e-6
    assert abs(to_rpy(model.links["base"].pose)[2] - to_rpy(start)[2]) < 1e-6
    assert not world.messages


def test_position_commanded_head_leaves_driving_alone():
    """(c) A pan-tilt head with a dangling cable on a robot with passive casters: the same way as without commands."""

    def robot():
        base = diff_drive()
        pan = Link("pan", Pose((0, 0, 0.2)), box_inertia(0.2, (0.05, 0.05, 0.05)))
        tilt = Link("tilt", Pose((0, 0, 0.25)), box_inertia(0.2, (0.05, 0.05, 0.05)))
        cable = Link("cable", Pose((0, 0, 0.25)), Inertial(0.02, Pose((0, 0, -0.1)), 1e-4, 0, 0, 1e-4, 0, 1e-4))
        fork = Link("fork", Pose((-0.13, 0, 0.04)), box_inertia(0.05, (0.02, 0.02, 0.02)))
        more = (
            Joint("pan", "revolute", "base", "pan", axes=(Axis((0, 0, 1)),)),
            Joint("tilt", "revolute", "pan", "tilt", axes=(Axis((0, 1, 0)),)),
            Joint("cable", "revolute", "tilt", "cable", axes=(Axis((0, 1, 0), damping=1e-3),)),
            Joint("fork", "revolute", "base", "fork", axes=(Axis((0, 0, 1)),)),
        )
        return Model("robot", base.pose, base.links + (pan, tilt, cable, fork), base.joints + more)

    ends = []
    for moving in (False, True):
        world, model = world_with(robot())
        for i in range(3000):
            model.joints["pan"].drive_to(0.5 * math.sin(i * 2e-3) if moving else 0.0)
            model.joints["tilt"].drive_to(0.3 * math.sin(i * 3e-3) if moving else 0.0)
            model.joints["left"].set_motor(9.0, 5.0)
            model.joints["right"].set_motor(11.0, 5.0)
            world.step()
        ends.append(model.pose)
    assert norm(sub(ends[0].p, ends[1].p)) < 5e-3
    assert to_rpy(ends[0])[2] == pytest.approx(2.0 * 0.05 / 0.3 * 3, rel=0.03)
    assert to_rpy(ends[1])[2] == pytest.approx(to_rpy(ends[0])[2], abs=5e-3)


def test_same_bits_again_and_from_a_snapshot():
    def run(world, robot, first, last):
        for i in range(first, last):
            steer(robot, 0.8 * math.sin(i * 5e-3), {"front": 1})
            drive(robot, 0.5, "effort", FRONT)
            world.step()

    world, robot = car()
    run(world, robot, 0, 700)
    middle = world.save()
    run(world, robot, 700, 1400)
    end = bytes(world.save())
    world.restore(middle)
    run(world, robot, 700, 1400)
    assert bytes(world.save()) == end
    again, other = car()
    run(again, other, 0, 1400)
    assert bytes(again.save()) == end


def test_a_closed_loop_over_two_driven_joints_holds_together():
    """A bar between two position-driven cranks of a free-standing frame."""
    frame = Link("frame", Pose((0, 0, 0.05)), box_inertia(20.0, (1, 1, 0.1)), (Collision("c", Pose(), Box((1, 1, 0.1))),))
    light = Inertial(0.1, Pose(), 1e-3, 0, 0, 1e-3, 0, 1e-3)
    links = (frame, Link("a", Pose((-0.2, 0, 0.2)), light), Link("b", Pose((0.2, 0, 0.2)), light), Link("bar", Pose((-0.2, 0, 0.4)), light))
    y = (Axis((0, 1, 0)),)
    up = Pose((0.4, 0, 0))
    joints = (
        Joint("ja", "revolute", "frame", "a", axes=y),
        Joint("jb", "revolute", "frame", "b", axes=y),
        Joint("pa", "revolute", "a", "bar", axes=y),
        Joint("pb", "ball", "b", "bar", up),
    )
    world, model = world_with(Model("m", Pose(), links, joints))
    for i in range(1000):
        for name in ("ja", "jb"):
            model.joints[name].drive_to(i * 5e-4)
        world.step()
    bar, b = model.links["bar"].pose, model.links["b"].pose
    assert model.joints["ja"].position() == 999 * 5e-4
    assert bar.p == pytest.approx((-0.2 + 0.2 * math.sin(0.4995), 0, 0.2 + 0.2 * math.cos(0.4995)), abs=1e-3)
    assert abs(to_rpy(bar)[1]) < 5e-3
    assert b.p == pytest.approx((0.2, 0, 0.2), abs=1e-3)


# ------------------------------------------------------------------------------------------ what a held joint bears


def wrist(bolted=True, tool=2.0, payload=None):
    """An arm whose last joint carries a tool of ``tool`` kg, 0.1 m beyond it; ``payload``: a hinge hangs another kg on the tool."""
    model = arm(2, bolted=bolted, base_size=(1.0, 1.0, 0.2), mass=3.0)
    links = [Link("tool", Pose((0, 0, 0.6)), Inertial(tool, Pose((0, 0, 0.1)), 0.01, 0, 0, 0.01, 0, 0.01))]
    joints = [Joint("wrist", "revolute", "link1", "tool", axes=(Axis((0, 0, 1)),))]
    if payload:
        links.append(Link("payload", Pose((0, 0, 0.7)), Inertial(payload, Pose((0, 0, -0.2)), 1e-3, 0, 0, 1e-3, 0, 1e-3)))
        joints.append(Joint("hook", "revolute", "tool", "payload", axes=(Axis((0, 1, 0), damping=1.0),)))
    return Model("arm", Pose(), model.links + tuple(links), model.joints + tuple(joints))


def hold(world, model, q, steps, wrist_q=0.0):
    for _ in range(steps):
        model.joints["j0"].drive_to(0.0)
        model.joints["j1"].drive_to(q)
        model.joints["wrist"].drive_to(wrist_q)
        world.step()


@pytest.mark.parametrize("bolted", [True, False])
def test_held_joint_bears_the_weight_beyond(bolted):
    world, model = world_with(wrist(bolted))
    joint = model.joints["wrist"]
    joint.feedback()
    hold(world, model, math.pi / 2, 600)
    force = joint.feedback()
    assert force.child_force == pytest.approx((0, 0, 2 * G), abs=1e-3)
    assert force.child_torque == pytest.approx((0, -0.1 * 2 * G, 0), abs=1e-3)
    assert force.parent_force == pytest.approx((0, 0, -2 * G), abs=1e-3)
    shoulder = model.joints["j1"].feedback() and (hold(world, model, math.pi / 2, 2) or model.joints["j1"].feedback())
    assert shoulder.child_force == pytest.approx((0, 0, 5 * G), abs=1e-3)
    assert shoulder.child_torque[1] == pytest.approx(-G * (3 * 0.1 + 2 * 0.3), abs=1e-3)


@pytest.mark.parametrize("bolted", [True, False])
def test_held_joint_bears_what_hangs_on_a_free_joint_and_what_is_attached(bolted):
    world, model = world_with(wrist(bolted, payload=1.0))
    load = world.spawn(box("load", at=(0, 0, 0.9), mass=0.5))
    world.attach(model.links["tool"], load.links["link"])
    model.joints["wrist"].feedback()
    hold(world, model, 0.0, 2000)
    assert model.joints["wrist"].feedback().child_force == pytest.approx((0, 0, 3.5 * G), abs=0.02)


def test_held_joint_feels_acceleration_pushes_and_contacts():
    world, model = world_with(wrist())
    joint = model.joints["wrist"]
    joint.feedback()
    for i in range(500):  # swings about the shoulder, which the tool is 0.3 m away from, at 4 rad/s2
        model.joints["j0"].drive_to(0.0)
        model.joints["j1"].drive_to(2.0 * (i * 1e-3) ** 2)
        joint.drive_to(0.0)
        world.step()
    q, speed = model.joints["j1"].position(), 4.0 * 0.4985
    along, outward = np.array((math.cos(q), 0, -math.sin(q))), np.array((math.sin(q), 0, math.cos(q)))
    expected = 2 * (np.array((0, 0, G)) + 4.0 * 0.3 * along - speed**2 * 0.3 * outward)
    assert joint.feedback().child_force == pytest.approx(tuple(expected), abs=0.05)
    hold(world, model, q, 100)
    model.links["tool"].add_force((0, 7.0, 0))
    hold(world, model, q, 1)
    assert joint.feedback().child_force == pytest.approx((0, -7.0, 2 * G), abs=1e-6)


def test_a_held_joint_bears_less_when_its_load_stands_on_something():
    """A plate that lies on a scale when its joint is first commanded."""
    model = arm(1, bolted=True, base_size=(0.1, 0.1, 0.1), length=0.2, at=(0, 0, -0.15))
    size = (0.2, 0.2, 0.05)
    foot = Link("foot", Pose((0.4, 0, 0.17499)), box_inertia(3.0, size), (Collision("c", Pose(), Box(size)),))
    hinge = Joint("knee", "revolute", "link0", "foot", Pose((-0.4, 0, 0)), (Axis((0, 1, 0), damping=0.1),))
    world, model = world_with(Model("m", model.pose, model.links + (foot,), model.joints + (hinge,)))
    held = model.joints["j0"]
    held.feedback()
    held.drive_to(0.0)
    world.step(1000)
    stands = scale(world)[2]
    assert held.feedback().child_force[2] + stands == pytest.approx(4 * G, rel=0.02)
    assert stands > 5.0
