"""The arm lab's main job from outside, as a student does it with three terminals: launch, command, watch, look."""

from __future__ import annotations

import argparse
import concurrent.futures
import csv
import math
import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import demonstration
from demonstration import DemoError, save_report

JOINTS = ("j0", "j1", "j2", "j3")
TOLERANCE = 1e-4  # rad


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="scripts/demo", description=__doc__)
    parser.add_argument("target", nargs="*", type=float, default=[1.0] * 4, help="joint positions in rad (default 1 1 1 1)")
    demonstration.add_options(parser, "out/demo")
    options = parser.parse_args()
    if len(options.target) != 4 or not all(map(math.isfinite, options.target)):
        parser.error(f"expected four joint positions in rad, got {' '.join(map(str, options.target))}")
    demonstration.check_folder(parser, options.out)
    return options


def say(text: str) -> None:
    print(f"\033[1m[demo]\033[0m {text}" if sys.stdout.isatty() else f"[demo] {text}", flush=True)


class Recorder:
    """Joint positions (rad) over sim time (s), and the wall time of each message."""

    def __init__(self):
        self.rows = []
        self.event = threading.Event()

    def __call__(self, message) -> None:
        at = dict(zip(message.name, message.position))
        if all(name in at for name in JOINTS):
            self.rows.append((message.header.stamp.to_sec(), time.monotonic(), *(at[name] for name in JOINTS)))
            self.event.set()

    def wait(self, launch: subprocess.Popen, seconds: float) -> None:
        """Until another message has come.

        :raises DemoError: none within ``seconds`` of wall time, or the launch ended.
        """
        self.event.clear()
        end = time.monotonic() + seconds
        while not self.event.wait(0.1):
            if launch.poll() is not None:
                raise DemoError(f"roslaunch ended with code {launch.returncode}; see launch.log")
            if time.monotonic() > end:
                raise DemoError(f"no joint states for {seconds:.0f} s; see launch.log")


def save_camera(path: Path) -> bool:
    """The next image of the arm's camera as PNG."""
    import numpy as np
    import rospy
    from PIL import Image as Picture
    from sensor_msgs.msg import Image

    try:
        message = rospy.wait_for_message("/camera/image_raw", Image, timeout=20)
    except rospy.ROSException:
        say("no picture came from /camera/image_raw")
        return False
    pixels = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, : message.width * 3]
    Picture.fromarray(np.ascontiguousarray(pixels.reshape(message.height, message.width, 3))).save(path)
    return True


def save_rviz(out: Path, name: str) -> list:
    """RViz pictures of the arm: the configuration's view and one from the front."""
    import rospkg
    from rviz_offscreen.cli import ScreenshotError, take
    from rviz_offscreen.views import parse_view

    config = os.path.join(rospkg.RosPack().get_path("arm_description"), "manipulator.rviz")
    views = [parse_view(f"{view}:distance=0.75,x=0,y=0,z=0.17") for view in ("iso", "front")]
    try:
        return take(config, views, str(out / f"{name}.png"), size="900x700")["pictures"]
    except ScreenshotError as error:
        say(f"no RViz picture: {error}")
        return []


def save_plot(path: Path, rows, target) -> None:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(9, 4.5))
    for column, name in enumerate(JOINTS):
        axes.plot([row[0] for row in rows], [row[2 + column] for row in rows], label=name, linewidth=6 - 1.4 * column)
    for value in sorted(set(target)):
        axes.axhline(value, color="grey", linewidth=0.8, linestyle=":")
    axes.set(xlabel="sim time [s]", ylabel="joint position [rad]", title="/arm/joint_states")
    axes.legend()
    axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def wait_for_build() -> None:
    """scripts/demo compiles the arm's node while the simulator starts, where the platform is installed."""
    build = os.environ.get("DEMO_BUILD")
    if build and os.waitpid(int(build), 0)[1]:
        raise DemoError("the arm's node was not compiled; see build/demo/build.log")


def drive(recorder: Recorder, launch, target) -> tuple:
    """Tell how the arm moves until it is there. :return: rows of its start and of its arrival"""
    start = recorder.rows[0]
    reported = start[0]
    while True:
        recorder.wait(launch, 20)
        now = recorder.rows[-1]
        arrived = all(abs(q - t) <= TOLERANCE for q, t in zip(now[2:], target))
        if arrived or now[0] - reported >= 1.0:
            reported = now[0]
            say(f"t = {now[0] - start[0]:5.2f} s   " + "   ".join(f"{n} {q:+.6f}" for n, q in zip(JOINTS, now[2:])))
        if arrived:
            return start, now
        if now[0] - start[0] > 120:
            raise DemoError(f"not arrived after 120 s of sim time at {now[2:]}; targets beyond a joint limit are not reached")


def save_joints(path: Path, rows: list) -> None:
    with open(path, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["sim_time", *JOINTS])
        writer.writerows([f"{row[0]:.3f}", *(f"{q:.9f}" for q in row[2:])] for row in rows)


def figures_of(rows: list, start: tuple, now: tuple, ready: float) -> dict:
    """What the report says in numbers. :param ready: s from the launch command to the first joint state"""
    moving = [row for row in rows if any(abs(q - s) > 0 for q, s in zip(row[2:], start[2:]))]
    first = moving[0] if moving else start
    steps = [max(abs(b - a) for a, b in zip(p[2:], q[2:])) for p, q in zip(moving, moving[1:])]
    simulated, wall = now[0] - start[0], now[1] - start[1]
    return {
        "launch command to first joint state": f"{ready:.1f} s",
        "motion, sim time": f"{now[0] - first[0]:.2f} s from the first step to arrival",
        "largest step between two joint states": f"{max(steps or [0]):.6f} rad",
        "final positions": "  ".join(f"{n} {q:.6f}" for n, q in zip(JOINTS, now[2:])) + " rad",
        "real-time factor": f"{simulated / wall:.3f} ({simulated:.2f} s simulated in {wall:.2f} s)",
    }


def run(options: argparse.Namespace, out: Path, environment: dict, window: bool) -> int:
    import rosgraph
    import rospy
    from launch_gallery.session import running
    from sensor_msgs.msg import JointState

    target = options.target
    begin = time.monotonic()
    say("roslaunch arm_gazebo arm_gazebo.launch")
    port = environment["ROS_MASTER_URI"].rsplit(":", 1)[1]
    with running(["roslaunch", "-p", port, "arm_gazebo", "arm_gazebo.launch", "gui:=false"], environment, out / "launch.log") as launch:
        while not rosgraph.is_master_online():
            if launch.poll() is not None or time.monotonic() - begin > 60:
                raise DemoError("the ROS master did not start; see launch.log")
            time.sleep(0.1)
        rospy.init_node("demo", disable_signals=True, log_level=rospy.ERROR)
        recorder = Recorder()
        rospy.Subscriber("/arm/joint_states", JointState, recorder, queue_size=100)
        recorder.wait(launch, 60)
        ready = time.monotonic() - begin
        say(f"the arm stands in the simulator and reports its joints, {ready:.1f} s after the launch command")
        pictures = [(Path(p), f"RViz before: {' '.join('%.2f' % q for q in recorder.rows[-1][2:])}") for p in save_rviz(out, "rviz-before")]

        wait_for_build()
        words = [f"{value:g}" for value in target]
        say("rosrun arm_controller arm_controller_node " + " ".join(words))
        recorder.rows.clear()
        recorder.wait(launch, 20)
        with concurrent.futures.ThreadPoolExecutor(1) as desk:  # the plot's library loads while the arm moves
            desk.submit(__import__, "matplotlib.pyplot")
            with running(["rosrun", "arm_controller", "arm_controller_node", *words], environment, out / "arm_controller_node.log"):
                start, now = drive(recorder, launch, target)
            rows = list(recorder.rows)
            table = desk.submit(save_joints, out / "joints.csv", rows)
            plot = desk.submit(save_plot, out / "joints.png", rows, target)
            pictures += [(Path(p), f"RViz after: {' '.join('%.4f' % q for q in now[2:])}") for p in save_rviz(out, "rviz-after")]
            if save_camera(out / "camera.png"):
                pictures.append((out / "camera.png", "The arm's own camera, /camera/image_raw"))
            table.result(), plot.result()

    figures = figures_of(rows, start, now, ready)
    save_report(out, figures, [(out / "joints.png", "The four joints over sim time"), *pictures], "The arm moves")
    for key, value in figures.items():
        say(f"{key}: {value}")
    say(f"report: {out / 'report.html'}")
    return 0


if __name__ == "__main__":
    demonstration.main("demo", parse(), run)
