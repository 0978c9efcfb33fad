#!/usr/bin/env python3
"""This simulator and the real Gazebo Classic 11.1, the same files, alternating: what a step costs, start, memory, making a model, Ctrl-C.

usage: beside_gazebo.py [--json FILE] [--quick] [--worlds FOLDER]

Real Gazebo comes from the chroot that scripts/truth chroot makes; it runs alone, this simulator with its ROS node and a master. The
recorder of scripts/truth measures in both. --worlds keeps the world files.
"""

import argparse
import json
import os
import signal
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, ".."))

import garden  # noqa: E402
from real_gazebo import chroot, server  # noqa: E402
from real_gazebo.scene import Deed, Scene  # noqa: E402
from real_gazebo.scenes import SCENES  # noqa: E402
from real_gazebo.sdf import axis, ground, inertial, joint, link, model, world  # noqa: E402

LIMIT = 300.0  # s for one run
END = 40.0  # s for a server to end after Ctrl-C


def arm(name: str, y: float) -> str:
    """Six links that hang from the world and swing, each on the one before it."""
    parts = []
    for i in range(6):
        pose = f"0 0 {-0.3 * i:.9g} 0 0 0"
        parts.append(link(f"l{i}", inertial(1, (0.0075, 0.0075, 0.0002), "0 0 -0.15 0 0 0"), pose=pose))
        turn = axis("0 1 0" if i % 2 else "1 0 0", damping=0.05)
        parts.append(joint(f"j{i}", "revolute", f"l{i - 1}" if i else "world", f"l{i}", turn))
    return model(name, *parts, pose=f"0 {y} 3 0.5 0.5 0")


def timed_scenes(quick: bool):
    """(title, scene, steps): of the scenes of scripts/truth, and what they lack."""
    known = {scene.name: scene for scene in SCENES}
    arms = [(f"{n} arms of six joints" if n > 1 else "arm of six joints", n) for n in ((1, 8) if quick else (1, 8, 32))]
    for title, n in arms:
        text = world(ground(), *(arm(f"arm{i}", i) for i in range(n)))
        yield title, Scene(f"arms_{n}", "bench", title, "", text, ()), 10000 if n < 10 else 3000
    names = ("drive_turn_cylinder", "mecanum_turn", "skid_turn", "hundred_boxes", "wall_5x5", "four_bar_motor", "ray_room")
    for name in names[:4] if quick else names:
        yield known[name].what, known[name], 2000 if name in ("hundred_boxes", "mecanum_turn", "wall_5x5") else 5000
    motors = tuple(Deed("motor", f"r::{wheel}_joint", f"{garden.SPEED} {garden.TORQUE}") for wheel in garden.WHEELS)
    for name, title, text in () if quick else garden.worlds():
        yield title, Scene(name, "bench", title, "", text, (), deeds=motors, files=garden.files()), 1000


def plugin(scene: Scene, steps: int) -> str:
    return scene.plugin().replace("<seconds>", f"<timing>{steps}</timing><seconds>").replace("<sensors>1</sensors>", "")


def finished(process, out: str, limit: float) -> str:
    """The recorder's rows when it has said that it is done."""
    until = time.monotonic() + limit
    while time.monotonic() < until and process.poll() is None:
        if os.path.exists(out):
            with open(out, encoding="utf-8") as file:
                text = file.read()
            if "\nend," in text:
                return text
        time.sleep(0.1)
    raise RuntimeError(f"{out}: the server {'ended' if process.poll() is not None else 'was not done'} before it was measured")


def figures_of(text: str, launched: float) -> dict:
    rows = [line.split(",") for line in text.splitlines()]
    first = next(float(r[1]) for r in rows if r[0] == "first")
    steps, dt, wall, thread, process = (float(v) for v in next(r[1:] for r in rows if r[0] == "steps"))
    memory = next(int(r[1]) for r in rows if r[0] == "maxrss") / 1024
    return {
        "us of the stepping thread a step": thread / steps * 1e6,
        "us of all threads a step": process / steps * 1e6,
        "real-time factor, uncapped": steps * dt / wall,
        "s from start to the first step": first - launched,
        "memory, MB": memory,
        "ms to make a model, median of five": 1e3 * statistics.median(float(r[1]) for r in rows if r[0] == "spawn"),
    }


def ended(process) -> float:
    """Seconds from Ctrl-C to the end of the server; its whole group gets it, as from a terminal."""
    start = time.monotonic()
    os.killpg(process.pid, signal.SIGINT)
    try:
        process.wait(END)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    return time.monotonic() - start


def measure(command, environment, out: str) -> dict:
    if os.path.exists(out):
        os.remove(out)  # of a run before, where the world files are kept
    launched = time.time()
    process = subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        figures = figures_of(finished(process, out, LIMIT), launched)
        figures["s from Ctrl-C to the end"] = ended(process)
        return figures
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def measure_real(scene: Scene, steps: int, folder: str) -> dict:
    with tempfile.TemporaryDirectory(prefix="bench", dir=os.path.join(folder, "truth")) as place:
        inside = "/truth/" + os.path.basename(place)
        chroot.write_scene(scene, place, inside, plugin(scene, steps))
        command = ["chroot", folder, "gzserver", "-u", inside + "/scene.world"]
        return measure(command, chroot.environment(inside), os.path.join(place, "out.csv"))


def measure_ours(scene: Scene, steps: int, keep: str) -> dict:
    with tempfile.TemporaryDirectory(prefix="bench") as place:
        place = os.path.join(keep, scene.name) if keep else place
        chroot.write_scene(scene, place, place, plugin(scene, steps))
        with server.master(place) as environment:
            command = ["rosrun", "gazebo_ros", "gzserver", "-u", os.path.join(place, "scene.world")]
            return measure(command, {**environment, "GAZEBO_MODEL_PATH": place, "TRUTH_OUT": place + "/out.csv"}, place + "/out.csv")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", metavar="FILE")
    parser.add_argument("--quick", action="store_true", help="fewer scenes, one pair each")
    parser.add_argument("--worlds", metavar="FOLDER", default="", help="keep the world files there")
    options = parser.parse_args()
    folder = chroot.default_folder()
    if not chroot.installed(folder):
        print(f"there is no real Gazebo in {folder}: scripts/truth chroot makes it", file=sys.stderr)
        return 1
    chroot.build_recorder(folder)
    table = {}
    for title, scene, steps in timed_scenes(options.quick):
        print(f"{scene.name}: {title}")
        pairs = [(measure_real(scene, steps, folder), measure_ours(scene, steps, options.worlds)) for _ in range(1 if options.quick else 3)]
        for name in pairs[0][0]:
            real, ours = (statistics.median(pair[side][name] for pair in pairs) for side in (0, 1))
            better = ours / real if "factor" in name else real / ours
            table[f"{scene.name}: {name}, real : here (load {os.getloadavg()[0]:.1f})"] = f"{real:.4g} : {ours:.4g}"
            table[f"{scene.name}: {name}, times as good as real Gazebo"] = better
            print(f"  {name}: real {real:.4g}, here {ours:.4g} ({better:.2g} times as good; load {os.getloadavg()[0]:.1f})", flush=True)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as out:
            json.dump(table, out, indent=2)
    return 0


if __name__ == "__main__":
    sys.exit(main())
