"""The arm lab's main job from outside, as a student does it with three terminals: launch, command, watch, look."""
from __future__ import annotations

import argparse
import contextlib
import csv
import html
import math
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

JOINTS = ("j0", "j1", "j2", "j3")
TOLERANCE = 1e-4  # rad


class DemoError(RuntimeError):
    """The demo cannot go on; one line."""


def parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="scripts/demo", description=__doc__)
    parser.add_argument("target", nargs="*", type=float, default=[1.0] * 4, help="joint positions in rad (default 1 1 1 1)")
    parser.add_argument("--headless", action="store_true", help="open no window even if there is a display")
    parser.add_argument("--out", default="out/demo", help="folder for pictures, plot, table and report (default out/demo)")
    parser.add_argument("--check", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if len(options.target) != 4 or not all(map(math.isfinite, options.target)):
        parser.error(f"expected four joint positions in rad, got {' '.join(map(str, options.target))}")
    try:
        os.makedirs(options.out, exist_ok=True)
        with tempfile.TemporaryFile(dir=options.out) as probe:
            probe.write(b"\0" * 4096)
    except OSError as error:
        parser.error(f"cannot write into --out {options.out}: {error.strerror}; name another folder")
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
    pixels = np.frombuffer(message.data, np.uint8).reshape(message.height, message.step)[:, :message.width * 3]
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


def save_report(out: Path, figures: dict, pictures: list, title: str = "The arm moves") -> None:
    rows = "\n".join(f"<tr><td>{html.escape(k)}</td><td>{html.escape(v)}</td></tr>" for k, v in figures.items())
    images = "\n".join(f'<figure><img src="{p.name}" alt="{html.escape(t)}"><figcaption>{html.escape(t)}</figcaption></figure>'
                       for p, t in pictures)
    (out / "report.html").write_text(f"""<!doctype html>
<html lang="en"><meta charset="utf-8"><title>{html.escape(title)}</title>
<style>body {{font: 15px sans-serif; max-width: 1100px; margin: 2em auto; padding: 0 1em}} img {{max-width: 100%; border: 1px solid #ccc}}
figure {{display: inline-block; width: 48%; margin: 0.5%; vertical-align: top}} figure:first-of-type {{width: 98%}}
td {{padding: 0.2em 1.2em 0.2em 0; border-bottom: 1px solid #ddd}} figcaption {{color: #555; font-size: 90%}}</style>
<h1>{html.escape(title)}</h1>
<table>
{rows}
</table>
{images}
</html>
""")


def run(options: argparse.Namespace, out: Path, environment: dict) -> int:
    import rosgraph
    import rospy
    from launch_gallery.session import running
    from sensor_msgs.msg import JointState
    target = options.target
    begin = time.monotonic()
    say("roslaunch arm_gazebo arm_gazebo.launch")
    port = environment["ROS_MASTER_URI"].rsplit(":", 1)[1]
    with running(["roslaunch", "-p", port, "arm_gazebo", "arm_gazebo.launch", "gui:=false"], environment,
                 out / "launch.log") as launch:
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

        words = [f"{value:g}" for value in target]
        say("rosrun arm_controller arm_controller_node " + " ".join(words))
        recorder.rows.clear()
        recorder.wait(launch, 20)
        with running(["rosrun", "arm_controller", "arm_controller_node", *words], environment, out / "arm_controller_node.log"):
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
                    break
                if now[0] - start[0] > 120:
                    raise DemoError(f"not arrived after 120 s of sim time at {now[2:]}; targets beyond a joint limit are not reached")
        rows = list(recorder.rows)
        moving = [row for row in rows if any(abs(q - s) > 0 for q, s in zip(row[2:], start[2:]))]
        first = moving[0] if moving else start
        pictures += [(Path(p), f"RViz after: {' '.join('%.4f' % q for q in now[2:])}") for p in save_rviz(out, "rviz-after")]
        if save_camera(out / "camera.png"):
            pictures.append((out / "camera.png", "The arm's own camera, /camera/image_raw"))

    with open(out / "joints.csv", "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["sim_time", *JOINTS])
        writer.writerows([f"{row[0]:.3f}", *(f"{q:.9f}" for q in row[2:])] for row in rows)
    save_plot(out / "joints.png", rows, target)
    steps = [max(abs(b - a) for a, b in zip(p[2:], q[2:])) for p, q in zip(moving, moving[1:])]
    simulated, wall = now[0] - start[0], now[1] - start[1]
    figures = {
        "launch command to first joint state": f"{ready:.1f} s",
        "motion, sim time": f"{now[0] - first[0]:.2f} s from the first step to arrival",
        "largest step between two joint states": f"{max(steps or [0]):.6f} rad",
        "final positions": "  ".join(f"{n} {q:.6f}" for n, q in zip(JOINTS, now[2:])) + " rad",
        "real-time factor": f"{simulated / wall:.3f} ({simulated:.2f} s simulated in {wall:.2f} s)",
    }
    save_report(out, figures, [(out / "joints.png", "The four joints over sim time"), *pictures])
    for key, value in figures.items():
        say(f"{key}: {value}")
    say(f"report: {out / 'report.html'}")
    return 0


def main() -> int:
    options = parse()
    if options.check:
        return 0
    out = Path(options.out).resolve()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    from launch_gallery.session import free_port
    from rviz_offscreen.display import DisplayError, private_display
    environment = dict(os.environ, ROS_MASTER_URI=f"http://localhost:{free_port()}", ROS_HOME=str(out / "ros_home"))
    try:
        with contextlib.ExitStack() as stack:
            if options.headless or not environment.get("DISPLAY"):
                environment.update(stack.enter_context(private_display()))
            os.environ.update({k: environment[k] for k in ("ROS_MASTER_URI", "ROS_HOME")})
            return run(options, out, environment)
    except (DemoError, DisplayError) as error:
        print(f"scripts/demo: {error} (folder {out})", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # rospy's threads wait for a master that is gone
