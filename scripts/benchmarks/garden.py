#!/usr/bin/env python3
"""What a base on mecanum wheels costs whose 48 rollers are meshes of 6 000 triangles, on a plane and among meshes.

usage: garden.py [--json FILE] [--steps N] [GROUND...]
"""

import argparse
import json
import math
import os
import random
import sys
import tempfile
import time

import numpy as np
import ode_sim

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))

from real_gazebo.scenes_robots import stl  # noqa: E402
from real_gazebo.sdf import axis, collision, ground, inertial, joint, link, mesh, model, surface, world  # noqa: E402

ROLLERS, WHEEL, ROLLER = 12, 0.08, 0.018  # on a wheel; radii, m
SPEED, TORQUE = 2.5, 10.0  # rad/s, N m
WHEELS = {"fl": (0.2, 0.2, 1), "fr": (0.2, -0.2, -1), "rl": (-0.2, 0.2, -1), "rr": (-0.2, -0.2, 1)}  # m, m, which way rollers lean


def turned(profile, around):
    """Triangles of the surface that a profile (radius, z) leaves behind when it turns about z."""
    angles = [2 * math.pi * i / around for i in range(around + 1)]
    out = []
    for (r, z), (s, w) in zip(profile, profile[1:]):
        for a, b in zip(angles, angles[1:]):
            low = [(r * math.cos(t), r * math.sin(t), z) for t in (a, b)]
            high = [(s * math.cos(t), s * math.sin(t), w) for t in (a, b)]
            if r > 0:
                out.append((low[0], low[1], high[1]))
            if s > 0:
                out.append((low[0], high[1], high[0]))
    return out


def barrel():
    inside = [(ROLLER * math.sqrt(1 - (z / 0.03) ** 2), z) for z in np.linspace(-0.02, 0.02, 50)]
    return turned([(0.0, -0.02), *inside, (0.0, 0.02)], 60)


def bush(rings=40, radius=0.4):
    ring = [math.pi * i / rings for i in range(1, rings)]
    profile = [(radius * math.sin(a) * (1 + 0.1 * math.sin(40 * a)), radius * (1 - math.cos(a))) for a in ring]
    return turned([(0.0, 0.0), *profile, (0.0, 2 * radius)], 40)


def lawn(squares=200, side=20.0, height=0.05):
    at = np.linspace(-side / 2, side / 2, squares + 1)
    x, y = np.meshgrid(at, at, indexing="ij")
    p = np.stack([x, y, height * np.sin(1.3 * x) * np.cos(0.9 * y)], axis=-1)
    a, b, c, d = p[:-1, :-1], p[1:, :-1], p[1:, 1:], p[:-1, 1:]
    return np.concatenate([np.stack([a, b, c], axis=2).reshape(-1, 3, 3), np.stack([a, c, d], axis=2).reshape(-1, 3, 3)])


def of_mesh(file):
    return collision(mesh(file), surface(1.0))


def hinge(parent, child, xyz):
    return joint(f"{child}_joint", "revolute", parent, child, axis(xyz, of_model=False))


def robot(z):
    parts = [link("base", inertial(10, 0.2), pose=f"0 0 {WHEEL} 0 0 0")]
    for name, (x, y, sign) in WHEELS.items():
        parts += [link(name, inertial(0.5, 0.001), pose=f"{x} {y} {WHEEL} 0 0 0"), hinge("base", name, "0 1 0")]
        for i in range(ROLLERS):
            a = 2 * math.pi * (i + 0.5) / ROLLERS
            ahead, up = (WHEEL - ROLLER) * math.cos(a), (WHEEL - ROLLER) * math.sin(a)
            lean = np.array([-math.sin(a), sign, math.cos(a)]) / math.sqrt(2)
            turn = f"0 {math.atan2(math.hypot(lean[0], lean[1]), lean[2]):.9g} {math.atan2(lean[1], lean[0]):.9g}"
            pose = f"{x + ahead:.9g} {y} {WHEEL + up:.9g} {turn}"
            parts += [link(f"{name}{i}", inertial(0.02, 4e-6), of_mesh("barrel.stl"), pose=pose), hinge(name, f"{name}{i}", "0 0 1")]
    return model("r", *parts, pose=f"0 0 {z} 0 0 0")


def standing(name, shape, x=0.0, y=0.0):
    return model(name, link("l", shape), pose=f"{x} {y} 0 0 0 0", static=True)


def bushes():
    chance = random.Random(1)
    for i in range(20):
        x, y = chance.uniform(-3, 3), chance.choice((-1, 1)) * chance.uniform(0.8, 3)
        yield standing(f"bush{i}", of_mesh("bush.stl"), x, y)


def files():
    return {f"{name}.stl": stl(make()) for name, make in (("barrel", barrel), ("bush", bush), ("lawn", lawn))}


def worlds():
    """(name, title, text of the world, in which {folder} is where the files lie)."""
    hills = standing("g", of_mesh("lawn.stl"))
    for name, title, models, z in (
        ("rollers_plane", "a plane", [ground(1.0, 1.0)], 0.0),
        ("rollers_lawn", "a lawn of 80 000 triangles", [hills], 0.06),
        ("rollers_garden", "a garden, that lawn and 20 bushes of 3 120", [hills, *bushes()], 0.06),
    ):
        text = world(*models, robot(z))
        yield name, f"48 mesh rollers of 6 000 triangles on {title}", text


def cost(path, steps):
    """us of processor time a step."""
    loaded = ode_sim.World.load(path)
    if loaded.problems:
        raise RuntimeError(loaded.problems[0].message)
    for wheel in WHEELS:
        loaded.find_joint(f"r::{wheel}_joint").set_motor(SPEED, TORQUE)
    loaded.step(300)
    start, before = time.process_time(), loaded.models["r"].pose.p[0]
    loaded.step(steps)
    spent, way = time.process_time() - start, loaded.models["r"].pose.p[0] - before
    meant = SPEED * WHEEL * steps * loaded.dt
    if not 0.8 * meant < way < 1.2 * meant:
        raise RuntimeError(f"the base drove {way:.3f} m instead of {meant:.3f}")
    return spent / steps * 1e6


def figures(steps, names=()):
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for file, content in files().items():
            with open(os.path.join(folder, file), "wb") as out:
                out.write(content)
        for name, title, text in worlds():
            if names and not any(word in name for word in names):
                continue
            path = os.path.join(folder, name + ".world")
            with open(path, "w", encoding="utf-8") as out:
                out.write(text.replace("{folder}", folder))
            found[f"{title}: us per step"] = cost(path, steps)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", metavar="FILE")
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("grounds", nargs="*", metavar="GROUND", help="part of a ground's name: plane, lawn, garden")
    options = parser.parse_args()
    found = figures(options.steps, options.grounds)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as out:
            json.dump(found, out)
    for name, value in found.items():
        print(f"{name:80} {value:8.0f}")


if __name__ == "__main__":
    main()
