#!/usr/bin/env python3
"""The same bodies moved by this project's solvers and by `solver: gazebo`, which is Gazebo Classic's own; side by side.

usage: gazebo_like.py [--json FILE]
"""

import argparse
import json
import math
import os
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "src", "simulation", "ode_sim", "test"))

import ode_sim  # noqa: E402
from ode_sim.description.model import Axis, Collision, Cylinder, Inertial, Joint, Link, Model, Pose, Sphere, Surface  # noqa: E402
from ode_sim.math3 import quat_from_rpy, to_rpy  # noqa: E402
from physics_models import arm, box, box_inertia, car_urdf, ground  # noqa: E402

TYRE = Pose(q=quat_from_rpy(math.pi / 2, 0, 0))


def world_with(solver, step=0.001):
    world = ode_sim.World()
    world.physics.solver = solver
    world.physics.max_step_size = step
    world.spawn(ground())
    return world


def moved(world, model, seconds):
    """Way (m) and angle (rad) of the base in that time."""
    start, heading, turned = model.pose, to_rpy(model.pose)[2], 0.0
    for _ in range(round(seconds / 0.02)):
        world.step(round(0.02 / world.dt))
        now = to_rpy(model.pose)[2]
        turned += (now - heading + math.pi) % (2 * math.pi) - math.pi
        heading = now
    return float(np.linalg.norm(np.subtract(model.pose.p, start.p)[:2])), turned


def rover(wheels, casters, radius, width, mass, wheel_mass, caster_mu, size, height=0.0):
    balls = tuple(
        Collision(f"c{i}", Pose((x, y, 0.03 - radius)), Sphere(0.03), Surface(mu=caster_mu, mu2=caster_mu))
        for i, (x, y) in enumerate(casters)
    )
    links = [Link("base", Pose((0, 0, radius)), box_inertia(mass, size, Pose((0, 0, height))), balls)]
    joints = []
    for i, (x, y) in enumerate(wheels):
        spin, across = wheel_mass * radius**2 / 2, wheel_mass * (3 * radius**2 + width**2) / 12
        links.append(
            Link(
                f"w{i}",
                Pose((x, y, radius)),
                Inertial(wheel_mass, Pose(), across, 0, 0, spin, 0, across),
                (Collision("tyre", TYRE, Cylinder(radius, width)),),
            )
        )
        joints.append(Joint(f"w{i}", "revolute", "base", f"w{i}", axes=(Axis((0, 1, 0)),)))
    return Model("rover", Pose(), tuple(links), tuple(joints))


def driven(solver, model, wheels, radius, commands, torque, separation=None):
    """Part of the commanded way and angle that is really moved, each over 6 s; drift in 20 s of standing."""
    world = world_with(solver)
    handle = world.spawn(model)
    world.step(500)
    out = {}
    for name, forward, turn in commands:
        for i, (_, y) in enumerate(wheels):
            arm_length = y if separation is None else math.copysign(separation / 2, y)
            handle.joints[f"w{i}"].set_motor((forward - turn * arm_length) / radius, torque)
        world.step(500)
        way, angle = moved(world, handle, 6.0)
        out[name] = way / (6 * forward) if forward else angle / (6 * turn) if turn else way
    return out


def skid_steering(solver):
    """A four-wheeled field robot with the sizes of a Husky."""
    wheels = ((0.256, 0.2854), (0.256, -0.2854), (-0.256, 0.2854), (-0.256, -0.2854))
    model = rover(wheels, (), 0.1651, 0.1143, 46.0, 2.6, 1.0, (0.99, 0.57, 0.3), 0.05)
    return driven(solver, model, wheels, 0.1651, (("ahead", 0.5, 0.0), ("turn", 0.0, 0.5), ("standing, m", 0.0, 0.0)), 30.0)


def rigid_casters(solver):
    """25 kg on two wheels between two rigid balls of the same friction."""
    wheels = ((0.0, 0.15), (0.0, -0.15))
    model = rover(wheels, ((-0.15, 0.0), (0.15, 0.0)), 0.1, 0.05, 15.0, 5.0, 1.0, (0.4, 0.2, 0.1), 0.1)
    return driven(
        solver, model, wheels, 0.1, (("ahead", 0.3, 0.0), ("turn", 0.0, 1.0), ("ahead again", 0.3, 0.0), ("standing, m", 0.0, 0.0)), 10.0
    )


def light_finger(solver):
    """A finger of 1 g on a slide, pulled to its place by 100 N/m without damping: the swing after 0.1 s and after 5 s, mm."""
    world = world_with(solver)
    links = (
        Link("palm", Pose((0, 0, 1)), Inertial(1.0)),
        Link("finger", Pose((0, 0, 1)), Inertial(0.001, Pose(), 1e-6, 0, 0, 1e-6, 0, 1e-6)),
    )
    joints = (
        Joint("bolt", "fixed", "world", "palm"),
        Joint("slide", "prismatic", "palm", "finger", axes=(Axis((1, 0, 0), -0.1, 0.1, 1.0, 10.0),)),
    )
    joint = world.spawn(Model("gripper", Pose(), links, joints)).joints["slide"]
    swing = []
    for _ in range(5000):
        joint.add_force(100.0 * (0.005 - joint.position()))
        world.step()
        swing.append(abs(joint.position() - 0.005))
    return {"swing at once, mm": 1e3 * max(swing[:100]), "swing after 5 s, mm": 1e3 * max(swing[-100:])}


def proportional_wheels(solver):
    """A car whose rear wheels follow 5 rad/s by a torque of 1 N m s/rad times what is missing, at 1 ms."""
    world = world_with(solver)
    car = world.spawn_urdf(car_urdf(), name="car", pose=Pose((0, 0, 0.06)))
    wheels = [car.joints[f"rear_{side}_wheel"] for side in ("left", "right")]
    start, chatter = None, []
    for k in range(6000):
        for joint in wheels:
            joint.add_force(max(-10.0, min(10.0, 1.0 * (5.0 - joint.velocity()))))
        world.step()
        if k == 1000:
            start = to_rpy(car.pose)[2]
        if k > 1000:
            chatter.append(wheels[0].velocity())
    return {
        "speed, m/s": float(np.hypot(*car.twist().linear[:2])),
        "chatter of a wheel, rad/s": float(np.std(chatter)),
        "heading drift in 5 s, rad": to_rpy(car.pose)[2] - start,
    }


def arm_at_ten_milliseconds(solver):
    """Six joints held by PD torques (100, 10) at a step of 10 ms: the largest error after 5 s, and what still moves."""
    world = world_with(solver, 0.01)
    joints = list(world.spawn(arm(6, mass=1.0, inertia=0.05)).joints.values())[1:]
    for _ in range(500):
        for joint in joints:
            joint.add_force(100.0 * (0.3 - joint.position()) - 10.0 * joint.velocity())
        world.step()
    return {"error, rad": max(abs(j.position() - 0.3) for j in joints), "speed left, rad/s": max(abs(j.velocity()) for j in joints)}


def pile(solver):
    """Ten boxes let go above each other: height of the topmost after 4 s (1.0 m stands)."""
    world = world_with(solver)
    for i in range(10):
        world.spawn(box(f"b{i}", (0, 0, 0.05 + 0.101 * i)))
    world.step(4000)
    return {"top, m": max(m.pose.p[2] for m in world.models.values()) + 0.05}


SCENES = (skid_steering, rigid_casters, light_finger, proportional_wheels, arm_at_ten_milliseconds, pile)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", metavar="FILE")
    options = parser.parse_args()
    figures = {}
    for scene in SCENES:
        ours, theirs = scene("quick"), scene("gazebo")
        for name, value in ours.items():
            print(f"{scene.__name__.replace('_', ' '):24s} {name:28s} {value:12.4f} {theirs[name]:12.4f}", flush=True)
            figures[f"{scene.__name__}, {name}"] = {"own": value, "gazebo": theirs[name]}
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(figures, file, indent=2)


if __name__ == "__main__":
    main()
