#!/usr/bin/env python3
"""What a base on mecanum wheels costs whose 48 rollers are meshes of 6 000 triangles, on a plane and among meshes.

usage: garden.py [--json FILE] [--steps N] [GROUND...]
"""

import argparse
import json
import math
import os
import random
import struct
import tempfile
import time

import numpy as np
import ode_sim

ROLLERS, WHEEL, ROLLER = 12, 0.08, 0.018  # on a wheel; radii, m
SPEED, TORQUE = 2.5, 10.0  # rad/s, N m
WHEELS = {"fl": (0.2, 0.2, 1), "fr": (0.2, -0.2, -1), "rl": (-0.2, 0.2, -1), "rr": (-0.2, -0.2, 1)}  # m, m, which way rollers lean


def stl(triangles):
    """A binary file of these. triangles: (n, 3, 3), m."""
    record = np.zeros(len(triangles), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")])
    record["corners"] = triangles
    return b"\0" * 80 + struct.pack("<I", len(triangles)) + record.tobytes()


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


def inertial(mass, moment):
    moments = "".join(f"<{axis}>{moment}</{axis}>" for axis in ("ixx", "iyy", "izz"))
    return f"<inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>"


def of_mesh(file):
    friction = "<surface><friction><ode><mu>1</mu><mu2>1</mu2></ode></friction></surface>"
    return f"<collision name='c'><geometry><mesh><uri>file://{{folder}}/{file}</uri></mesh></geometry>{friction}</collision>"


def hinge(parent, child, axis):
    return (
        f"<joint name='{child}_joint' type='revolute'><parent>{parent}</parent><child>{child}</child><axis><xyz>{axis}</xyz>"
        "<limit><lower>-1e16</lower><upper>1e16</upper></limit></axis></joint>"
    )


def robot(z):
    parts = [f"<link name='base'><pose>0 0 {WHEEL} 0 0 0</pose>{inertial(10, 0.2)}</link>"]
    for name, (x, y, sign) in WHEELS.items():
        parts += [f"<link name='{name}'><pose>{x} {y} {WHEEL} 0 0 0</pose>{inertial(0.5, 0.001)}</link>", hinge("base", name, "0 1 0")]
        for i in range(ROLLERS):
            a = 2 * math.pi * (i + 0.5) / ROLLERS
            ahead, up = (WHEEL - ROLLER) * math.cos(a), (WHEEL - ROLLER) * math.sin(a)
            axis = np.array([-math.sin(a), sign, math.cos(a)]) / math.sqrt(2)
            turn = f"0 {math.atan2(math.hypot(axis[0], axis[1]), axis[2]):.9g} {math.atan2(axis[1], axis[0]):.9g}"
            pose = f"<pose>{x + ahead:.9g} {y} {WHEEL + up:.9g} {turn}</pose>"
            parts += [f"<link name='{name}{i}'>{pose}{inertial(0.02, 4e-6)}{of_mesh('barrel.stl')}</link>"]
            parts += [hinge(name, f"{name}{i}", "0 0 1")]
    return f"<model name='r'><pose>0 0 {z} 0 0 0</pose>{''.join(parts)}</model>"


def standing(name, collision, x=0.0, y=0.0):
    return f"<model name='{name}'><static>true</static><pose>{x} {y} 0 0 0 0</pose><link name='l'>{collision}</link></model>"


def bushes():
    chance = random.Random(1)
    for i in range(20):
        x, y = chance.uniform(-3, 3), chance.choice((-1, 1)) * chance.uniform(0.8, 3)
        yield standing(f"bush{i}", of_mesh("bush.stl"), x, y)


def files():
    return {f"{name}.stl": stl(np.array(make())) for name, make in (("barrel", barrel), ("bush", bush), ("lawn", lawn))}


def worlds():
    """(name, title, text of the world, in which {folder} is where the files lie)."""
    plane = standing("g", "<collision name='c'><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>")
    hills = standing("g", of_mesh("lawn.stl"))
    for name, title, models, z in (
        ("rollers_plane", "a plane", [plane], 0.0),
        ("rollers_lawn", "a lawn of 80 000 triangles", [hills], 0.06),
        ("rollers_garden", "a garden, that lawn and 20 bushes of 3 120", [hills, *bushes()], 0.06),
    ):
        physics = "<physics type='ode'><max_step_size>0.001</max_step_size></physics>"
        text = f"<sdf version='1.6'><world name='w'>{physics}{''.join(models)}{robot(z)}</world></sdf>"
        yield name, f"48 mesh rollers of 6 000 triangles on {title}", text


def cost(path, steps):
    """us of processor time a step."""
    world = ode_sim.World.load(path)
    if world.problems:
        raise RuntimeError(world.problems[0].message)
    for wheel in WHEELS:
        world.find_joint(f"r::{wheel}_joint").set_motor(SPEED, TORQUE)
    world.step(300)
    start, before = time.process_time(), world.models["r"].pose.p[0]
    world.step(steps)
    spent, way = time.process_time() - start, world.models["r"].pose.p[0] - before
    meant = SPEED * WHEEL * steps * world.dt
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
