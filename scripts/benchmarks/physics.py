#!/usr/bin/env python3
"""What a physics step costs here and in a bare C loop of ODE on the same bodies, and what a ray costs.

usage: physics.py [--json FILE]
"""

import argparse
import importlib.util
import json
import math
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "src", "simulation", "ode_sim", "test"))

import ode_sim  # noqa: E402
from physics_models import arm, box, diff_drive, ground  # noqa: E402

PILE = [(0.15 * (i % 3) + 0.01 * (i % 7), 0.15 * (i // 3 % 3), 0.1 + 0.12 * (i // 9)) for i in range(100)]  # m, of boxes of 1 kg, 0.1 m


def per_step(world, steps):
    start = time.process_time()
    world.step(steps)
    return (time.process_time() - start) / steps * 1e6


def motor_arm(steps=4000):
    world = ode_sim.World()
    world.spawn(ground())
    model = world.spawn(arm(6))
    for joint in list(model.joints.values())[1:]:
        joint.set_motor(0.02, 100.0)
    world.step(100)
    return per_step(world, steps)


def position_driven_arm(steps=4000):
    world = ode_sim.World()
    world.spawn(ground())
    joints = list(world.spawn(arm(6)).joints.values())[1:]

    def command(w):
        for joint in joints:
            joint.drive_to(0.02 * w.time)

    world.before_step.append(command)
    world.step(100)
    return per_step(world, steps)


def boxes(steps=1500):
    """Cost of a falling step, its contacts, how many boxes sleep in the end, cost of a step asleep."""
    world = ode_sim.World()
    world.spawn(ground())
    for i, place in enumerate(PILE):
        world.spawn(box(f"box{i}", place))
    cost = contacts = 0.0
    for _ in range(0, steps, 10):
        cost += per_step(world, 10) * 10 / steps
        contacts += world.core.counters.contacts * 10 / steps
    world.step(8000)
    asleep = sum(model.asleep for model in world.models.values())
    return cost, contacts, asleep, per_step(world, 500)


def robots(count, steps=3000):
    world = ode_sim.World()
    world.spawn(ground())
    for i in range(count):
        for joint in world.spawn(diff_drive(name=f"robot{i}", at=(0.0, 1.0 * i, 0.0))).joints.values():
            joint.set_motor(5.0, 5.0)
    return per_step(world, steps)


def rays(count=360, obstacles=40, repeats=50):
    world = ode_sim.World()
    world.spawn(ground())
    for i in range(obstacles):
        a = 2 * math.pi * i / obstacles
        world.spawn(box(f"box{i}", (4 * math.cos(a), 4 * math.sin(a), 0.5), (0.4, 0.4, 1.0), static=True))
    angles = np.linspace(-math.pi, math.pi, count, endpoint=False)
    directions = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    origins = np.tile([0.0, 0.0, 0.3], (count, 1))
    start = time.perf_counter()
    for _ in range(repeats):
        world.cast_rays(origins, directions, 30.0)
    return (time.perf_counter() - start) / repeats * 1e6


def bare(kind, steps, joints=6):
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "bare_ode")
        subprocess.run(["cc", "-O2", "-DdDOUBLE", os.path.join(HERE, "bare_ode.c"), "-o", program, "-lode", "-lm"], check=True)
        output = subprocess.run([program, kind, str(steps), str(joints)], check=True, capture_output=True, text=True).stdout
        return tuple(float(word) for word in output.split())


def pile_elsewhere(ours, steps=1500):
    """The same boxes in MuJoCo, where scripts/setup --bench has installed it."""
    if importlib.util.find_spec("mujoco") is None:
        return {}
    run = subprocess.run(
        [sys.executable, os.path.join(HERE, "other_engines.py"), "mujoco", "pile", str(steps)], check=True, capture_output=True, text=True
    )
    found = json.loads(run.stdout[run.stdout.rindex("{") :])
    return {
        "100 falling boxes: MuJoCo (us/step)": found["us per step"],
        "100 falling boxes: MuJoCo, contacts per step": found["contacts"],
        "100 falling boxes: ode_sim / MuJoCo": ours / found["us per step"],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", metavar="FILE")
    options = parser.parse_args()
    bare_arm, ours_arm = min(bare("arm", 4000)[0] for _ in range(3)), min(motor_arm() for _ in range(3))
    bare_robots, our_robots = min(bare("robots", 3000, 16)[0] for _ in range(3)), min(robots(16) for _ in range(3))
    bare_boxes, bare_contacts = bare("boxes", 1500)
    our_boxes, our_contacts, asleep, sleeping = boxes()
    figures = {
        "arm, 6 hinge motors: bare ODE (us/step)": bare_arm,
        "arm, 6 hinge motors: ode_sim (us/step)": ours_arm,
        "arm, 6 hinge motors: ratio": ours_arm / bare_arm,
        "arm, 6 position-commanded joints from a Python callback (us/step)": position_driven_arm(),
        "two-wheeled robot driving (us/step)": robots(1),
        "16 two-wheeled robots driving: bare ODE (us/step)": bare_robots,
        "16 two-wheeled robots driving: ode_sim (us/step)": our_robots,
        "16 two-wheeled robots driving: ode_sim / bare ODE": our_robots / bare_robots,
        "100 falling boxes: bare ODE quickStep (us/step)": bare_boxes,
        "100 falling boxes: ode_sim (us/step)": our_boxes,
        "100 falling boxes: bare ODE, contacts per step": bare_contacts,
        "100 falling boxes: ode_sim, contacts per step": our_contacts,
        "100 boxes: asleep after 9.5 s": asleep,
        "100 boxes asleep (us/step)": sleeping,
        "360 rays among 41 shapes (us)": rays(),
    }
    figures.update(pile_elsewhere(our_boxes))
    for name, value in figures.items():
        print(f"{name:70s} {value:10.2f}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(figures, file, indent=2)


if __name__ == "__main__":
    main()
