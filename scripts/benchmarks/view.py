#!/usr/bin/env python3
"""What the simulator's window costs: processor time of the server while nobody looks and while somebody does, and how
soon a page is there.

    scripts/benchmarks/view.py                   a table
    scripts/benchmarks/view.py --json out.json   the same, for programs

Times of processes are processor time, so that a loaded machine changes them little; seconds to the page are wall time.
"""

import argparse
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

import psutil

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from run import master  # noqa: E402

BODIES = 30


def world_text(count):
    """A world of ``count`` balls of one link each, resting on the ground."""
    ball = """<model name="b{0}"><pose>{1} {2} 0.1 0 0 0</pose><link name="l"><collision name="c"><geometry><sphere>
<radius>0.1</radius></sphere></geometry></collision><visual name="v"><geometry><sphere><radius>0.1</radius></sphere></geometry>
</visual>
<inertial><mass>1</mass><inertia><ixx>0.004</ixx><iyy>0.004</iyy><izz>0.004</izz></inertia></inertial></link></model>"""
    models = "".join(ball.format(i, i % 20, i // 20) for i in range(count))
    return (
        "<sdf version='1.6'><world name='default'><include><uri>model://sun</uri></include>"
        f"<include><uri>model://ground_plane</uri></include>{models}</world></sdf>"
    )


def processor(process):
    times = process.cpu_times()
    return times.user + times.system


def server_load(process, seconds):
    """Part of a core."""
    before, begin = processor(process), time.monotonic()
    time.sleep(seconds)
    return (processor(process) - before) / (time.monotonic() - begin)


WATCHER = """
import sys, time, rospy
from gazebo_ros.msg import WorldView
rospy.init_node("view_bench", disable_rostime=True)
count = [0]
rospy.Subscriber("/gazebo/view", WorldView, lambda m: count.__setitem__(0, count[0] + 1), tcp_nodelay=True)
end = time.monotonic() + 60
while not count[0] and time.monotonic() < end:
    time.sleep(0.05)
begin, first = time.monotonic(), count[0]
print("ready", flush=True)
sys.stdin.readline()
print((count[0] - first) / (time.monotonic() - begin), flush=True)
"""


def stream_figures(environment, folder, seconds):
    """Loads of the server, paused so that only what the window asks for is counted, and of a stream at its rate."""
    file = os.path.join(folder, "bench.world")
    with open(file, "w", encoding="utf-8") as world:
        world.write(world_text(BODIES))
    quiet = {"env": environment, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    server = subprocess.Popen(["rosrun", "gazebo_ros", "gzserver", "-u", file], **quiet)
    try:
        while subprocess.run(["rosservice", "call", "/gazebo/get_world_properties"], **quiet).returncode:
            time.sleep(0.2)  # it is paused: there is no clock to wait by
        time.sleep(1.0)
        process = psutil.Process(server.pid)
        alone = server_load(process, seconds)
        watcher = subprocess.Popen(
            [sys.executable, "-c", WATCHER], env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        watcher.stdout.readline()
        watched = server_load(process, seconds)
        rate = float(watcher.communicate("\n", timeout=60)[0])
        time.sleep(0.5)
        after = server_load(process, seconds)
        return {
            f"view, {BODIES} bodies: messages per second": rate,
            f"view, {BODIES} bodies: part of a core in the server": watched - alone,
            f"view, {BODIES} bodies: the same scaled to 60 messages per second": (watched - alone) * 60.0 / max(rate, 1.0),
            "view, nobody looks any more: part of a core in the server": max(0.0, after - alone),
            "view, from a hand's move to the pose in the stream: median ms": hand_latency(environment),
            **page_figures(environment),
        }
    finally:
        server.send_signal(signal.SIGINT)
        server.wait(timeout=30)


HAND = """
import sys, time, rospy
from gzclient.ros_simulation import RosSimulation
from ode_sim.math3 import Pose
rospy.init_node("hand_bench", disable_rostime=True)
simulation = RosSimulation()
simulation.look(True)
row = simulation.describe().model("b0").links["l"]
while simulation.frame() is None:
    time.sleep(0.01)
took = []
for number in range(100):
    begin, x = time.monotonic(), 5.0 + 0.01 * number
    simulation.set_pose("b0", Pose((x, 0.0, 3.0)))
    while abs(simulation.frame().poses[row][0] - x) > 1e-4:
        time.sleep(0.0005)
    took.append(time.monotonic() - begin)
print(1e3 * sorted(took)[len(took) // 2], flush=True)
"""


def hand_latency(environment):
    """What of the way from the gizmo to the page is not the browser's: service, world, stream."""
    return float(
        subprocess.run([sys.executable, "-c", HAND], env=environment, stdout=subprocess.PIPE, text=True, timeout=60, check=True).stdout
    )


def page_figures(environment):
    """Seconds from the command to the whole page, the least of three, and what of the processor gzclient takes until it has an address."""
    import urllib.request

    times, idle = [], []
    plain = {name: value for name, value in environment.items() if name not in ("DISPLAY", "WAYLAND_DISPLAY")}
    for _ in range(3):
        begin = time.monotonic()
        client = subprocess.Popen(
            ["rosrun", "gazebo_ros", "gzclient", "--port", "0"],
            env=plain,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        try:
            address = client.stdout.readline().split()[-1]
            process = psutil.Process(client.pid)
            idle.append(sum(processor(part) for part in (process, *process.children(recursive=True))))
            with urllib.request.urlopen(address, timeout=60) as answer:
                answer.read()
            times.append(time.monotonic() - begin)
        finally:
            os.killpg(client.pid, signal.SIGINT)
            client.wait(timeout=30)
    return {
        "view: first page served, s after the command": min(times),
        "view: processor s of gzclient until it says its address": min(idle),
    }


def drawing_figures():
    """Processor seconds until 200 models are drawn for a page, and per frame in which all of them move."""
    import numpy as np
    from ode_sim import World
    from ode_sim_viewer import LocalSimulation, Page

    world = World.load(world_text(200))
    page = Page(LocalSimulation(world, paused=True), port=0)
    try:
        before = time.thread_time()
        while page.frame is None:
            page.turn()
        drawn = time.thread_time() - before
        frame, moves = page.frame, 20
        poses = [frame.poses + np.float32(0.001 * i) for i in range(1, moves + 1)]
        before = time.thread_time()
        for moved in poses:
            page.drawing.move(type(frame)(**{**vars(frame), "poses": moved}))
        per_frame = (time.thread_time() - before) / moves
    finally:
        page.close()
    return {
        "view, 200 models: processor seconds until they are drawn": drawn,
        "view, 200 models that all move: processor ms per frame in gzclient": per_frame * 1e3,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", metavar="FILE")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    with master() as environment, tempfile.TemporaryDirectory() as folder:
        figures = stream_figures(environment, folder, 3.0 if options.quick else 10.0)
    figures.update(drawing_figures())
    for name, value in figures.items():
        print(f"{name:75} {value:.4g}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(figures, file)


if __name__ == "__main__":
    main()
