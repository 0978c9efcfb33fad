#!/usr/bin/env python3
"""Plans MotionBenchMaker's problems: solved within a second, how long to the timed trajectory, and OMPL alone on the same checker.

usage: problem_sets.py DIR [--json FILE] [--robots NAME...] [--count N]

DIR holds a folder for each robot: NAME/NAME.urdf, NAME/NAME.srdf, its meshes, and NAME/problems, or problems.tar.bz2, with a folder of
scene0001.yaml and request0001.yaml for each set. They are public and are not part of this project: docs/performance.md says where
they are.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import motion
import numpy as np
import yaml

Loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
LIMIT = 1.0  # s


def read(path):
    return yaml.load(path.read_text(encoding="utf-8"), Loader)


def robot_model(folder):
    """:raises OSError: a file is missing"""
    name = folder.name
    urdf = (folder / f"{name}.urdf").read_text(encoding="utf-8").replace('filename="meshes/', f'filename="{folder}/meshes/')
    srdf = (folder / f"{name}.srdf").read_text(encoding="utf-8")
    model = motion.load_model(urdf, srdf, find_package=lambda package: str(folder / package))
    for line in model.warnings:
        if line.startswith("error: ") or "mesh" in line:
            raise OSError(f"{folder}: {line}")
    return model


def pose_of(words):
    return (words["position"], words["orientation"])


def shape_of(primitive):
    make = {"box": motion.Box, "sphere": motion.Sphere, "cylinder": lambda height, radius: motion.Cylinder(radius, height)}
    return make[primitive["type"]](*primitive["dimensions"])


def scene_of(model, words):
    """A planning scene of moveit_msgs/PlanningScene as these files write it."""
    scene = motion.PlanningScene(model)
    acm = scene.acm
    matrix = words.get("allowed_collision_matrix", {})
    names = matrix.get("entry_names", [])
    for a, row in zip(names, matrix.get("entry_values", [])):
        for b, allowed in zip(names, row):
            if allowed:
                acm.set(a, b, True)
    scene.set_acm(acm)
    for one in words["world"]["collision_objects"]:
        pose = pose_of(one["pose"]) if "pose" in one else None
        scene.add_object(one["id"], [shape_of(p) for p in one["primitives"]], [pose_of(p) for p in one["primitive_poses"]], pose)
    return scene


def start_of(model, words):
    state, names = model.state(), set(model.variables)
    joints = words["start_state"]["joint_state"]
    for name, value in zip(joints["name"], joints["position"]):
        if name in names:
            state.set(name, value)
    return state


def goal_of(model, group, words):
    wanted = {c["joint_name"]: c["position"] for c in words["goal_constraints"][0]["joint_constraints"]}
    return motion.joint_goal(model, group, wanted)


def problems(folder):
    """(set, scene file, request file) of a robot, in order."""
    for where in sorted((folder / "problems").iterdir()):
        for request in sorted(where.glob("request*.yaml")):
            yield where.name.replace(f"_{folder.name}", ""), where / request.name.replace("request", "scene"), request


Run = collections.namedtuple("Run", "solved ms alone_solved alone_ms")


def planned(scene, request):
    """What a problem costs; None where start or goal touch something."""
    model, group = scene.model, request["group_name"]
    start, goal = start_of(model, request), goal_of(model, group, request)
    end = start.copy()
    for one in request["goal_constraints"][0]["joint_constraints"]:
        end.set(one["joint_name"], one["position"])
    if scene.check(start, group=group) or scene.check(end, group=group):
        return None
    wanted = motion.MotionRequest(group, goals=[goal], start=start, planning_time=LIMIT, seed=1, longest_valid_segment_fraction=0.005)
    began = time.thread_time()
    whole = motion.Pipeline().generate(scene, wanted)
    between = time.thread_time()
    alone = motion.plan(
        scene,
        motion.MotionRequest(
            group,
            goals=[goal],
            start=start,
            planning_time=LIMIT,
            seed=1,
            simplify=False,
            interpolate=False,
            hybridize=False,
            longest_valid_segment_fraction=0.005,
        ),
    )
    return Run(bool(whole), (between - began) * 1e3, bool(alone), (time.thread_time() - between) * 1e3)


def figures_of(title, runs):
    return {
        f"{title}: solved within {LIMIT:g} s, %": 100.0 * np.mean([run.solved for run in runs]),
        f"{title}: p50, ms": float(np.percentile([run.ms for run in runs], 50)),
        f"{title}: p95, ms": float(np.percentile([run.ms for run in runs], 95)),
        f"{title}: OMPL alone, p50, ms": float(np.percentile([run.alone_ms for run in runs], 50)),
        f"{title}: OMPL alone, p95, ms": float(np.percentile([run.alone_ms for run in runs], 95)),
    }


def robot_figures(folder, count):
    model = robot_model(folder)
    kept = motion.PlanningScene(model)  # as move_group does: what is known of the robot's shapes stays from one plan to the next
    kept.check()
    runs, blocked = collections.defaultdict(list), 0
    for name, scene_file, request_file in problems(folder):
        if len(runs[name]) >= count:
            continue
        run = planned(scene_of(model, read(scene_file)), read(request_file))
        blocked += run is None
        if run is not None:
            runs[name].append(run)
    figures = {}
    for name, found in runs.items():
        if found:
            figures.update(figures_of(f"MotionBenchMaker, {folder.name}, {name}", found))
    everything = [run for found in runs.values() for run in found]
    if everything:
        figures.update(figures_of(f"MotionBenchMaker, {folder.name}, all {len(everything)}", everything))
    figures[f"MotionBenchMaker, {folder.name}: left out, as start or goal touch something"] = blocked
    return figures


def unpacked(folder, into):
    """The robot's folder, or one in `into` that has its problems unpacked."""
    if (folder / "problems").is_dir():
        return folder
    place = pathlib.Path(into) / folder.name
    place.mkdir()
    for one in folder.iterdir():
        (place / one.name).symlink_to(one.resolve())
    subprocess.run(["tar", "-xf", folder / "problems.tar.bz2", "-C", place], check=True)
    return place


def figures(folder, names=(), count=100):
    """:raises OSError: no robot is there, or one lacks a file"""
    found = {}
    folders = [f for f in sorted(pathlib.Path(folder).resolve().iterdir()) if (f / f"{f.name}.srdf").exists()]
    folders = [f for f in folders if ((f / "problems").exists() or (f / "problems.tar.bz2").exists()) and (not names or f.name in names)]
    if not folders:
        raise OSError(f"{folder} has no folder NAME with NAME.urdf, NAME.srdf and problems")
    with tempfile.TemporaryDirectory() as place:
        for one in folders:
            found.update(robot_figures(unpacked(one, place), count))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="DIR")
    parser.add_argument("--json", metavar="FILE")
    parser.add_argument("--robots", nargs="+", default=(), metavar="NAME")
    parser.add_argument("--count", type=int, default=100, help="problems of each set")
    options = parser.parse_args()
    try:
        found = figures(options.folder, options.robots, options.count)
    except OSError as error:
        print(f"problem_sets.py: {error}", file=sys.stderr)
        return 1
    for name, value in found.items():
        print(f"{name:80} {value:10.4g}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(found, file)
    return 0


if __name__ == "__main__":
    sys.exit(main())
