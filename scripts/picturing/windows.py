"""Pictures of rqt's windows, on a private screen with real clicks."""

from __future__ import annotations

import contextlib
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

from rqt_multiplot.config import Curve, FieldType, Plot, ScaleType, Table, write
from rqt_testing.desktop import Desktop, Program

from .common import ROOT, Options, Trouble, launched, of_ros

ARM = ("roslaunch", "arm_gazebo", "arm_gazebo.launch", "gui:=false", "rviz:=false")
WAVES = (sys.executable, str(ROOT / "scripts" / "picturing" / "waves.py"))
MBOT = ("roslaunch", "mbot_gazebo", "view_mbot_with_camera_gazebo.launch", "gui:=false")
CIRCLE = ("rostopic", "pub", "-r", "10", "/cmd_vel", "geometry_msgs/Twist", "{linear: {x: 0.2}, angular: {z: 0.5}}")
SHOWN = 14.0  # s of curves in a plot
TITLE = 22  # pixels of a window's title bar


class Screen:
    """A private screen of one picture's size, and the programs whose windows fill parts of it."""

    def __init__(self, desktop: Desktop, environment: dict[str, str], size: tuple[int, int]):
        self.desktop, self.size = desktop, size
        desktop.environment.update(of_ros(environment))

    def run(self, *command: str, title: str, part: tuple[float, float] = (0.0, 1.0)) -> Program:
        """Start ``command``; its window, with ``title`` in its title, gets the screen from ``part[0]`` to ``part[1]`` of the width."""
        program = self.desktop.run(list(command))
        program.window(title)
        left, right = (round(self.size[0] * where) for where in part)
        number = self.desktop.xdotool("search", "--onlyvisible", "--name", title).split()[-1]
        self.desktop.xdotool("windowmove", number, left, TITLE)
        self.desktop.xdotool("windowsize", number, right - left - 2, self.size[1] - TITLE - 4)
        program.wait(lambda: program.window(title)[4] <= right - left, "window in its place")
        return program


@contextlib.contextmanager
def screen(size: tuple[int, int], topic: str, *commands: tuple[str, ...]) -> Iterator[Screen]:
    """A screen of ``size`` pixels beside what ``commands`` launch, once ``topic`` comes."""
    with launched(*commands) as environment, Desktop(f"{size[0]}x{size[1]}x24") as desktop:
        echo = ["timeout", "60", "rostopic", "echo", "-n", "1", topic]
        if subprocess.run(echo, env=environment, stdout=subprocess.DEVNULL).returncode:
            raise Trouble(f"nothing comes on {topic} within 60 s")
        time.sleep(3.0)  # the spawners end
        yield Screen(desktop, environment, size)


def rqt_plot(seen: Screen) -> None:
    """Four joints of the arm over time."""
    fields = [f"/arm/joint_states/position[{joint}]" for joint in range(4)]
    seen.run("rqt_plot", *fields, title="rqt")
    time.sleep(SHOWN)


def rqt_graph(seen: Screen) -> None:
    """Nodes and topics of the arm lab."""
    window = seen.run("rqt_graph", title="rqt")
    window.click("graph_type_combo_box")
    window.click_text("Nodes/Topics (active)")
    time.sleep(2.0)
    seen.desktop.keys("ctrl+r")
    time.sleep(2.0)


def _curve(title: str, y: str, x: str = "") -> Curve:
    curve = Curve(title)
    for axis, field in ((curve.axes.x_axis, x), (curve.axes.y_axis, y)):
        axis.topic, axis.type, axis.field = "/arm/joint_states", "sensor_msgs/JointState", field
    if not x:
        curve.axes.x_axis.field_type = FieldType.RECEIPT_TIME
        curve.axes.x_axis.scale.type = ScaleType.RELATIVE
        curve.axes.x_axis.scale.relative_minimum = -SHOWN
    return curve


def rqt_multiplot(seen: Screen) -> None:
    """Two joints of the arm over time and over each other."""
    names = ("joint 0", "joint 1")
    plots = [
        [Plot("positions", curves=[_curve(name, f"position/{i}") for i, name in enumerate(names)])],
        [Plot("one over the other", curves=[_curve("1 over 0", "position/1", "position/0")])],
    ]
    velocities = Plot("velocities", curves=[_curve(name, f"velocity/{i}") for i, name in enumerate(names)])
    phases = Plot("velocity over position", curves=[_curve(name, f"velocity/{i}", f"position/{i}") for i, name in enumerate(names)])
    plots[0].append(velocities)
    plots[1].append(phases)
    file = Path(seen.desktop.home) / "arm.xml"
    file.write_text(write(Table(link_cursor=True, plots=plots)))
    seen.run("rqt_multiplot", "--multiplot-config", "home://arm.xml", "--multiplot-run-all", title="rqt")
    time.sleep(SHOWN)


def rqt_tools(seen: Screen) -> None:
    """Dynamic Reconfigure and Topic Monitor at the arm lab."""
    seen.run("rosrun", "rqt_reconfigure", "rqt_reconfigure", "gazebo", title="Reconfigure", part=(0.0, 0.42))
    topics = seen.run("rqt_topic", title="Topic", part=(0.42, 1.0))
    topics.click_text("/arm/joint_states")
    seen.desktop.keys("space", "Right")  # watches the topic, and unfolds its fields
    time.sleep(3.0)


def rqt_bag(seen: Screen) -> None:
    """A bag of the mobile robot with thumbnails of its camera."""
    file = Path(seen.desktop.home) / "mbot.bag"
    topics = ("/camera/image_raw", "/odom", "/joint_states", "/tf")
    command = ["rosbag", "record", "-q", "--duration=12", "-O", str(file), *topics]
    recorded = subprocess.run(command, env=seen.desktop.environment)
    if recorded.returncode or not file.exists():
        raise Trouble("rosbag record has failed")
    window = seen.run("rqt_bag", str(file), title="rqt")
    window.click("thumbnails")
    time.sleep(4.0)


#: name -> size in pixels, what comes once all is there, what is launched, what is run and clicked
WINDOWS: dict[str, tuple[tuple[int, int], str, tuple[tuple[str, ...], ...], Callable[[Screen], None]]] = {
    "rqt_plot": ((660, 496), "/arm/joint_states", (ARM, WAVES), rqt_plot),
    "rqt_graph": ((670, 510), "/arm/joint_states", (ARM,), rqt_graph),
    "rqt_multiplot": ((760, 560), "/arm/joint_states", (ARM, WAVES), rqt_multiplot),
    "rqt_tools": ((1500, 440), "/arm/joint_states", (ARM, WAVES), rqt_tools),
    "rqt_bag": ((760, 420), "/camera/image_raw/compressed", (MBOT, CIRCLE), rqt_bag),
}


def make(name: str, options: Options) -> Path:
    """:raises AssertionError: something did not appear."""
    size, topic, commands, act = WINDOWS[name]
    file = options.out / f"{name}.png"
    with screen(size, topic, *commands) as seen:
        try:
            act(seen)
        except AssertionError:
            seen.desktop.screenshot(str(file.with_stem(name + "_failed")))  # to look at what was there instead
            raise
        seen.desktop.screenshot(str(file))
    return file
