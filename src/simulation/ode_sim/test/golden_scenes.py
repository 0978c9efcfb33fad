"""Small worlds that between them take every road through the core. Each function makes one: models and the commands of each step."""

import math
from dataclasses import replace

import ode_sim
from ode_sim.description.model import Axis, Box, Capsule, Collision, Cylinder, Inertial, Joint, Link, Model, Pose, Surface
from ode_sim.math3 import quat_from_rpy
from physics_models import arm, box, box_inertia, car_urdf, diff_drive, gripper, ground, pendulum, sphere


def world_with(*models, **more):
    """A world with a floor that feels its contacts, and the handles of the models in it."""
    world = ode_sim.World(**more)
    world.watch_contacts(world.spawn(ground()).links["link"].collisions["plane"])
    return (world, *(world.spawn(model) for model in models))


def ur5():
    """Six joints with the masses, lengths and limits of the real arm, bolted to the world. Efforts N m, speeds rad/s."""
    parts = (
        (3.7, 0.15, 0.089, (0, 0, 1), 150, 3.15),
        (8.393, 0.425, 0.136, (0, 1, 0), 150, 3.15),
        (2.275, 0.392, 0.425, (0, 1, 0), 150, 3.15),
        (1.219, 0.1, 0.392, (0, 1, 0), 28, 3.2),
        (1.219, 0.1, 0.095, (0, 0, 1), 28, 3.2),
        (0.1879, 0.05, 0.095, (0, 1, 0), 28, 3.2),
    )
    links = [Link("base", Pose(), box_inertia(4.0, (0.15, 0.15, 0.09)), (Collision("c", Pose(), Cylinder(0.075, 0.09)),))]
    joints, height = [Joint("bolt", "fixed", "world", "base")], 0.0
    for i, (mass, length, rise, axis, effort, speed) in enumerate(parts):
        height += rise
        middle = Pose((0, 0, length / 2))
        links.append(
            Link(
                f"link{i}",
                Pose((0, 0, height)),
                box_inertia(mass, (0.1, 0.1, length), middle),
                (Collision("c", middle, Cylinder(0.05, length)),),
            )
        )
        joints.append(Joint(f"j{i}", "revolute", links[-2].name, f"link{i}", axes=(Axis(axis, -2 * math.pi, 2 * math.pi, effort, speed),)))
    return Model("ur5", Pose(), tuple(links), tuple(joints))


def position_drives():
    """An arm that stands on the floor without bolts runs into a box."""
    world, robot, _ = world_with(arm(4, bolted=False), box(at=(0.3, 0, 0.4), size=(0.2, 0.2, 0.8)))

    def command(w):
        for i, joint in enumerate(list(robot.joints.values())):
            joint.drive_to(math.sin(2 * w.time) * (0.8 - 0.1 * i))

    world.before_step.append(command)
    return world


def effort():
    """Forces, laws of controllers, motors, springs and a soft stop on one arm."""
    world, robot = world_with(arm(6, damping=0.1))
    joints = list(robot.joints.values())[1:]
    joints[3].set_limits(-0.2, 0.3)
    joints[5].friction = 0.2

    def command(w):
        for i, joint in enumerate(joints[:5]):
            wanted = 0.5 * math.sin(3 * w.time + i)
            if i % 2:
                joint.add_law(80 * (wanted - joint.position()) - 4 * joint.velocity(), 4.0, 60.0)
            else:
                joint.add_force(80 * (wanted - joint.position()) - 4 * joint.velocity())
        joints[5].set_motor(math.cos(w.time), 3.0)

    world.before_step.append(command)
    return world


def drive():
    """A robot on two wheels takes a curve over the floor and runs into a box."""
    world, robot, _ = world_with(diff_drive(), box(at=(0.45, 0.05, 0.05), mass=0.3))

    def command(w):
        robot.joints["left"].set_motor(6.0, 3.0)
        robot.joints["right"].set_motor(6.5 + math.sin(w.time), 3.0)

    world.before_step.append(command)
    return world


def ur5_on_efforts():
    """A trajectory followed with forces; force and torque in the wrist are read."""
    world, robot = world_with(ur5())
    robot.joints["j5"].feedback()

    def command(w):
        for i, joint in enumerate(list(robot.joints.values())[1:]):
            gain = (800.0, 800.0, 400.0, 60.0, 30.0, 5.0)[i]
            wanted = 0.6 * math.sin(1.5 * w.time + 0.7 * i)
            joint.add_law(gain * (wanted - joint.position()) - 0.1 * gain * joint.velocity(), 0.1 * gain, 150.0)

    world.before_step.append(command)
    return world


def pile():
    """Twenty boxes fall in a heap: the iterative solver and its random numbers."""
    (world,) = world_with(seed=3)
    rng = world.rng("heap")
    for i in range(20):
        world.spawn(box(f"box{i}", tuple(rng.uniform(-0.04, 0.04, 2)) + (0.06 + 0.07 * i,), rpy=tuple(rng.uniform(-0.2, 0.2, 3))))
    return world


def platform():
    """A kinematic deck carries a box, a ball and a pendulum that hangs on it."""
    deck = box("deck", at=(0, 0, 1), size=(3, 3, 0.2), kinematic=True)
    bob = Link("bob", Pose((0, 0, -0.5)), box_inertia(0.5, (0.1, 0.1, 0.1)))
    deck = replace(deck, links=deck.links + (bob,), joints=(Joint("hang", "revolute", "link", "bob", axes=(Axis((0, 1, 0)),)),))
    world, deck, *_ = world_with(deck, box(at=(0, 0, 1.15)), sphere(at=(0.5, 0.2, 1.2)))
    world.before_step.append(lambda w: deck.set_twist((0.5 * math.sin(4 * w.time), 0.1, 0), (0, 0, 0.3)))
    return world


def rolling():
    """Balls, a cylinder and a capsule roll down a slope, with friction of every kind."""
    world = ode_sim.World()
    world.spawn(ground(pitch=0.15, surface=Surface(mu=0.8, mu2=0.8)))
    for i, surface in enumerate(
        (
            Surface(),
            Surface(mu=0.05, mu2=0.05),
            Surface(mu=1.0, mu2=0.2, fdir1=(1.0, 1.0, 0.0)),
            Surface(restitution=0.5, bounce_threshold=0.01),
            Surface(slip1=0.1, slip2=0.3),
            Surface(kp=1e4, kd=10.0),
        )
    ):
        world.spawn(sphere(f"ball{i}", (0.0, 0.3 * i, 0.12), surface=surface))
    turned = quat_from_rpy(math.pi / 2, 0, 0)
    for i, shape in enumerate((Cylinder(0.08, 0.2), Capsule(0.08, 0.2), Cylinder(0.1, 0.1))):
        link = Link("link", inertial=box_inertia(1.0, (0.15, 0.15, 0.2)), collisions=(Collision("c", Pose(), shape),))
        world.spawn(Model(f"roller{i}", Pose((0.35 * i, -0.4, 0.15), turned), (link,)))
    return world


def grip():
    """A hand with position-commanded fingers takes a block and lifts it; the fingers become motors as they touch."""
    world, hand, *_ = world_with(
        gripper(),
        box("part", at=(0, 0, 0.225), size=(0.05, 0.05, 0.05), mass=0.2),
        box("stand", at=(0, 0, 0.1), size=(0.1, 0.03, 0.2), static=True),
    )
    for joint in hand.joints.values():
        joint.feedback()

    def command(w):
        for name in ("left", "right"):
            hand.joints[name].drive_to(min(0.1, 0.2 * w.time))
        hand.joints["lift"].drive_to(max(0.0, min(0.2, 0.3 * (w.time - 0.45))))

    world.before_step.append(command)
    return world


def loop():
    """A linkage of four bars that a force drives; a finger whose second joint follows the first, and whose third hangs free."""

    def bar(name, at, length, rpy=(0, 0, 0)):
        return Link(name, Pose(at, quat_from_rpy(*rpy)), box_inertia(0.5, (length, 0.04, 0.04), Pose((length / 2, 0, 0))))

    links = (bar("crank", (0, 0, 1), 0.2), bar("rocker", (0.6, 0, 1), 0.2), bar("coupler", (0.2, 0, 1), 0.6))
    hinge = (Axis((0, 1, 0), damping=0.01),)
    joints = (
        Joint("drive", "revolute", "world", "crank", axes=hinge),
        Joint("pin", "revolute", "world", "rocker", axes=hinge),
        Joint("a", "revolute", "crank", "coupler", axes=hinge),
        Joint("b", "revolute", "coupler", "rocker", pose=Pose((0.2, 0, 0)), axes=hinge),
    )
    world, linkage, finger, swing = world_with(
        Model("linkage", Pose(), links, joints), arm(3, name="finger", at=(0, 2, 0)), pendulum(name="swing")
    )
    finger.joints["j1"].follow(finger.joints["j0"], 0.5, 0.1)
    swing.joints["hinge"].set_position(0.7)

    def command(w):
        linkage.joints["drive"].add_force(2.0 * math.sin(2 * w.time))
        finger.joints["j0"].drive_to(0.8 * math.sin(3 * w.time))

    world.before_step.append(command)
    return world


def islands():
    """Boxes side by side fall asleep; a ball that rolls wakes one after the other."""
    (world,) = world_with()
    for i in range(12):
        world.spawn(box(f"box{i}", at=(0.4 * i, 0, 0.0505)))
    ball = world.spawn(sphere(at=(-2.5, 0.0, 0.1), mass=3.0))
    ball.set_twist((2.2, 0, 0), (0, 22.0, 0))
    return world


def carried():
    """A car whose steering is position-commanded and whose wheels turn by motors; a load tied to it; a trailer on a rope of welds."""
    (world,) = world_with()
    robot = world.spawn_urdf(car_urdf(), pose=Pose((0, 0, 0.06)))
    load = world.spawn(box("load", at=(0, 0, 0.22)))
    world.step(5)
    world.attach(robot.links["base"], load.links["link"])
    robot.joints["front_left_steer"].feedback()

    def command(w):
        for side in ("left", "right"):
            robot.joints[f"front_{side}_steer"].drive_to(0.3 * math.sin(2 * w.time))
            robot.joints[f"rear_{side}_wheel"].set_motor(8.0, 5.0)

    world.before_step.append(command)
    return world


def like_gazebo():
    """`solver: gazebo`: a robot, an arm and a heap."""
    world = ode_sim.World()
    world.physics.solver = "gazebo"
    world.spawn(ground())
    robot, mover = world.spawn(diff_drive()), world.spawn(arm(4, name="mover", at=(0, 2, 0)))
    for i in range(6):
        world.spawn(box(f"box{i}", at=(0.4, 0.01 * i, 0.06 + 0.11 * i), rpy=(0.1 * i, 0, 0)))

    def command(w):
        for wheel in ("left", "right"):
            robot.joints[wheel].set_motor(5.0, 3.0)
        for joint in list(mover.joints.values())[1:]:
            joint.add_force(30 * (0.4 - joint.position()) - 2 * joint.velocity())

    world.before_step.append(command)
    return world


SCENES = (position_drives, effort, drive, ur5_on_efforts, pile, platform, rolling, grip, loop, islands, carried, like_gazebo)
