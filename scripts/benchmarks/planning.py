#!/usr/bin/env python3
"""What planning costs: collision checks, inverse kinematics on the published protocol, whole plans; processor time of one core.

usage: planning.py [--json FILE] [--quick]
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
sys.path.insert(0, os.path.join(ROOT, "src", "planning", "motion", "test"))

import motion  # noqa: E402
import robots  # noqa: E402

ADJACENT = [
    ("pedestal", "base_link"),
    ("base_link", "shoulder_link"),
    ("shoulder_link", "upper_arm_link"),
    ("forearm_link", "upper_arm_link"),
    ("forearm_link", "wrist_1_link"),
    ("wrist_1_link", "wrist_2_link"),
    ("wrist_2_link", "wrist_3_link"),
    ("ee_link", "wrist_3_link"),
    ("ee_link", "wrist_1_link"),
    ("ee_link", "wrist_2_link"),
    ("pedestal", "shoulder_link"),
    ("wrist_1_link", "wrist_3_link"),
]


def pedestal_ur5():
    """The lab's UR5 on its pedestal, with its meshes; None without the lab's packages."""
    xacro = motion.find_package("myur5_description")
    if not xacro:
        return None
    text = subprocess.run(["xacro", os.path.join(xacro, "urdf", "myur5.urdf.xacro")], check=True, capture_output=True, text=True).stdout
    pairs = "".join(f'<disable_collisions link1="{a}" link2="{b}" reason="Adjacent"/>' for a, b in ADJACENT)
    srdf = f'<robot name="myur5"><group name="manipulator"><chain base_link="pedestal" tip_link="tool0"/></group>{pairs}</robot>'
    return motion.load_model(text, srdf)


def inverse(count):
    """TRAC-IK's protocol: random reachable poses, random seeds, 1e-5, 5 ms of processor time each."""
    figures = {}
    for name in robots.ARMS:
        model = motion.load_model(*robots.arm(name))
        state, seed, times, solved = model.state(), model.state(), [], 0
        for i in range(count):
            state.randomize("arm", seed=2 * i)
            seed.randomize("arm", seed=2 * i + 1)
            goal, start = state.pose("tool"), time.thread_time()
            found = motion.ik(model, "arm", goal, seed=seed, timeout=1.0, random_seed=i)
            times.append((time.thread_time() - start) * 1e3)
            solved += bool(found) and times[-1] <= 5.0
        figures[f"IK of {name}: solved within 5 ms at 1e-5, %"] = 100.0 * solved / count
        figures[f"IK of {name}: median, ms"] = float(np.median(times))
        figures[f"IK of {name}: 99th percentile, ms"] = float(np.percentile(times, 99))
    return figures


def scene_of(model):
    """A table, a post and 20 boxes round the robot."""
    scene = motion.PlanningScene(model)
    state = scene.state
    state.set_group("manipulator", [0.0, -1.57, 1.2, -1.2, -1.57, 0.0])
    scene.set_state(state)
    scene.add_object("table", [motion.Box(0.8, 1.4, 0.04)], pose=((0.75, 0, 0.9), (0, 0, 0, 1)))
    scene.add_object("post", [motion.Cylinder(0.05, 1.4)], pose=((0.1, 0.6, 1.3), (0, 0, 0, 1)))
    random = np.random.default_rng(7)
    while len(scene.objects) < 22:
        name, place = f"box{len(scene.objects)}", random.uniform((-0.9, -0.9, 0.95), (0.9, 0.9, 1.9))
        scene.add_object(name, [motion.Box(*random.uniform(0.04, 0.12, 3))], pose=(place, (0, 0, 0, 1)))
        if scene.check() or np.linalg.norm(place[:2]) < 0.25:
            scene.remove_object(name)
    return scene


def bare_loop(folder, scene, states):
    """A function that times FCL's bare loop over the pairs of links that a check looks at: (us per state, states that touch).

    The poses are computed beforehand: the loop does not even know where the joints are."""
    model = scene.model
    bodies = [(name, i) for name in model.links for i in range(len(model.link(name).shapes))]
    lines = [str(len(bodies))]
    for name, i in bodies:
        lines += shape_lines(model.link(name).shapes[i])
    moving = set(model.group("manipulator").updated_links)
    pairs = [
        (i, j)
        for i, (a, _) in enumerate(bodies)
        for j, (b, _) in enumerate(bodies)
        if i < j and a != b and (a in moving or b in moving) and not scene.acm.allowed(a, b)
    ]
    lines += [str(len(pairs)), *(f"{i} {j}" for i, j in pairs), str(len(states))]
    state = model.state()
    for values in states:
        state.set_group("manipulator", values)
        for name, i in bodies:
            pose = (state.pose(name) * model.link(name).shape_poses[i]).matrix()
            lines.append(" ".join(repr(float(v)) for v in np.asarray(pose)[:3].ravel()))
    data, program = os.path.join(folder, "bodies.txt"), os.path.join(folder, "bare_fcl")
    with open(data, "w", encoding="utf-8") as file:
        file.write("\n".join(lines))
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "fcl", "eigen3"], check=True, capture_output=True, text=True).stdout.split()
    flags = [flag for flag in flags if not flag.startswith("-std")]
    subprocess.run(["c++", "-std=c++17", "-O2", os.path.join(HERE, "bare_fcl.cpp"), "-o", program, *flags], check=True)

    def run():
        with open(data, encoding="utf-8") as file:
            us, touching = subprocess.run([program, "3"], stdin=file, check=True, capture_output=True, text=True).stdout.split()
        return float(us), int(touching)

    return run, len(pairs)


def shape_lines(shape):
    """A shape as bare_fcl reads it."""
    if isinstance(shape, motion.Mesh):
        return [
            f"mesh {len(shape.vertices)} {len(shape.triangles)}",
            *(" ".join(repr(float(v)) for v in row) for row in shape.vertices),
            *(" ".join(str(int(v)) for v in row) for row in shape.triangles),
        ]
    if isinstance(shape, motion.Box):
        return ["box " + " ".join(repr(float(v)) for v in shape.size)]
    return [f"cylinder {shape.radius} {shape.length}" if isinstance(shape, motion.Cylinder) else f"sphere {shape.radius}"]


def against_fcl(model, count):
    """A whole-robot check, joints to yes or no, against FCL's bare loop: pairs of runs, one after the other."""
    scene = motion.PlanningScene(model)
    states = np.random.default_rng(2).uniform(-np.pi, np.pi, (count, 6))
    ratios, own, bare, hits = [], [], [], []
    with tempfile.TemporaryDirectory() as folder:
        run, pairs = bare_loop(folder, scene, states)
        for _ in range(5):
            start = time.thread_time()
            hit = scene.check_states("manipulator", states)
            own.append((time.thread_time() - start) / count * 1e6)
            us, touching = run()
            bare.append(us)
            hits = [int(np.sum(hit)), touching]
            ratios.append(own[-1] / us)
    return {
        f"FCL's bare loop over {pairs} pairs, poses given: a random state, us": float(np.median(bare)),
        "the same states, whole check from joint values, us": float(np.median(own)),
        "whole-robot check / FCL's bare loop": float(np.median(ratios)),
        "states that touch: whole check, bare loop differ by": float(abs(hits[0] - hits[1])),
    }


def checks(model, count):
    scene = motion.PlanningScene(model)
    states = np.random.default_rng(1).uniform(-np.pi, np.pi, (count, 6))
    start = time.thread_time()
    hit = scene.check_states("manipulator", states)
    every = (time.thread_time() - start) / count * 1e6
    free = states[~hit]
    start = time.thread_time()
    scene.check_states("manipulator", free)
    figures = {
        "pedestal UR5 with meshes: check of a random state, us": every,
        "pedestal UR5 with meshes: check of a free state, us": (time.thread_time() - start) / len(free) * 1e6,
    }
    for number in range(1000):
        scene.add_object(f"o{number}", [motion.Sphere(0.02)], pose=((2, 0.01 * number, 0), (0, 0, 0, 1)))
    start = time.thread_time()
    child = scene.diff()
    child.add_object("one more", [motion.Sphere(0.02)], pose=((2, -1, 0), (0, 0, 0, 1)))
    child.check()
    figures["copy of a scene with 1 000 objects, one added, checked, ms"] = (time.thread_time() - start) * 1e3
    return figures


def furnished(model, seed):
    """A scene of one of three kinds, moved about a little: a table with things on it, a shelf, a cage of bars."""
    random = np.random.default_rng(seed)
    scene, boxes = motion.PlanningScene(model), []
    state = scene.state
    state.set_group("manipulator", [0.0, -1.57, 1.2, -1.2, -1.57, 0.0])
    scene.set_state(state)
    x, y, z = random.uniform((0.6, -0.2, 0.85), (0.7, 0.2, 0.95))
    if seed % 3 == 0:
        boxes = [((0.6, 1.2, 0.04), (x, y, z))] + [
            (random.uniform(0.04, 0.15, 3), (x + dx, y + dy, z + 0.1)) for dx, dy in random.uniform((-0.25, -0.5), (0.25, 0.5), (8, 2))
        ]
    elif seed % 3 == 1:
        boxes = (
            [((0.3, 0.8, 0.03), (x + 0.1, y, z + 0.35 * level)) for level in range(3)]
            + [((0.3, 0.03, 0.73), (x + 0.1, y + side, z + 0.35)) for side in (-0.4, 0.4)]
            + [
                (random.uniform(0.04, 0.12, 3), (x + 0.1, y + dy, z + 0.1 + 0.35 * (i % 2)))
                for i, dy in enumerate(random.uniform(-0.3, 0.3, 5))
            ]
        )
    else:
        boxes = [
            ((0.04, 0.04, 1.6), (0.55 * np.cos(a), 0.55 * np.sin(a), 1.3)) for a in np.arange(6) * np.pi / 3 + random.uniform(0.3, 0.7)
        ]
    for size, at in boxes:
        scene.add_object(f"box{len(scene.objects)}", [motion.Box(*size)], pose=(at, (0, 0, 0, 1)))
        if scene.check():
            scene.remove_object(f"box{len(scene.objects) - 1}")
    return scene


def plans(model, count, title, scene_for):
    """Random reachable free pose goals, from goal to timed trajectory; ``scene_for(number)`` gives each one's scene."""
    goal_state = model.state()
    pipeline, times, solved, seed = motion.Pipeline(), [], 0, 0
    while len(times) < count:
        scene = scene_for(len(times))
        goal_state.randomize("manipulator", seed=seed)
        seed += 1
        if scene.check(goal_state, group="manipulator"):
            continue
        goal = motion.pose_goal("tool0", goal_state.pose("tool0"))
        start = time.thread_time()
        result = pipeline.generate(
            scene, motion.MotionRequest("manipulator", goals=[goal], seed=seed, longest_valid_segment_fraction=0.005)
        )
        times.append((time.thread_time() - start) * 1e3)
        solved += bool(result)
    title = f"{title}: pose goal to timed trajectory"
    return {
        f"{title}: solved, %": 100.0 * solved / count,
        f"{title}: p50, ms": float(np.percentile(times, 50)),
        f"{title}: p95, ms": float(np.percentile(times, 95)),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json")
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    figures = inverse(500 if arguments.quick else 10000)
    model = pedestal_ur5()
    if model is not None:
        figures.update(against_fcl(model, 1000 if arguments.quick else 5000))
        figures.update(checks(model, 2000 if arguments.quick else 20000))
        cluttered = scene_of(model)
        figures.update(plans(model, 20 if arguments.quick else 100, "pedestal UR5, table, post, 20 boxes", lambda number: cluttered))
        figures.update(
            plans(model, 21 if arguments.quick else 100, "pedestal UR5, tables, shelves, cages", lambda number: furnished(model, number))
        )
    for name, value in figures.items():
        print(f"{name:80} {value:10.4g}")
    if arguments.json:
        with open(arguments.json, "w", encoding="utf-8") as file:
            json.dump(figures, file)


if __name__ == "__main__":
    main()
