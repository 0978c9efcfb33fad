#!/usr/bin/env python3
"""RViz with MotionPlanning and a UR5: how soon it is there, and pictures and inverse kinematics a second while the goal is dragged.

On a private X server, drawn by the processor, without anti-aliasing (as scripts/offscreen and rviz_offscreen have it) and with it (as
RViz has it on a desktop); the 3-D view has 800 x 600 pixels.
"""

import argparse
import ctypes
import json
import math
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

import psutil

SIZE = (800, 600)  # of the 3-D view, pixels
MOUSE = 60  # movements a second
CIRCLE = 40  # pixels, the radius of the goal's way, once in three seconds
CONFIG = {
    "Panels": [],
    "Visualization Manager": {
        "Class": "",
        "Name": "root",
        "Enabled": True,
        "Value": True,
        "Displays": [
            {"Class": "rviz/Grid", "Name": "Grid", "Enabled": True, "Value": True},
            {
                "Class": "moveit_rviz_plugin/MotionPlanning",
                "Name": "MotionPlanning",
                "Enabled": True,
                "Value": True,
                "JointsTab_Use_Radians": True,
                "Planning Request": {"Planning Group": "manipulator", "Goal State Alpha": 0.6},
            },
        ],
        "Global Options": {"Fixed Frame": "world", "Frame Rate": 60},
        "Tools": [{"Class": "rviz/Interact"}],
    },
}


def window(config, smooth):
    """RViz's window, in a process of its own; its label "figures" says [answers of inverse kinematics, pictures a second, the
    view's size, the display's status]."""
    if not smooth:
        ctypes.CDLL("librviz.so.7d")._ZN4rviz12RenderSystem19disableAntiAliasingEv()
    from python_qt_binding.QtCore import QTimer
    from python_qt_binding.QtWidgets import QApplication, QDoubleSpinBox, QLabel, QWidget
    from rviz import bindings as rviz

    app = QApplication(sys.argv[:1])
    frame = rviz.VisualizationFrame()
    frame.setSplashPath("")
    frame.initialize(config)
    figures, answers, found = QLabel(), [0], {}
    figures.setObjectName("figures")
    frame.statusBar().addWidget(figures)
    frame.show()

    def count(_value):
        answers[0] += 1

    def look():
        display = frame.getManager().getRootDisplayGroup().getDisplayAt(1)
        status = display.childAt(0).getName() if display is not None else ""
        if "pictures" not in found:
            found.update(("pictures", label) for label in frame.findChildren(QLabel) if label.text().endswith("fps"))
        if "joint" not in found and status == "Status: Ok":
            for box in frame.findChildren(QDoubleSpinBox, "joint_value_shoulder_pan_joint"):
                found["joint"] = box
                box.valueChanged.connect(count)
        view = next(w for w in frame.findChildren(QWidget) if w.inherits("rviz::RenderPanel"))
        view.setObjectName("view")
        if (view.width(), view.height()) != SIZE:
            frame.resize(frame.width() + SIZE[0] - view.width(), frame.height() + SIZE[1] - view.height())
        pictures = found["pictures"].text().split()[0] if "pictures" in found else "0"
        figures.setText(json.dumps([answers[0], int(pictures), [view.width(), view.height()], status]))

    timer = QTimer()
    timer.timeout.connect(look)
    timer.start(200)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: app.quit())
    return app.exec_()


def hand():
    """Where the hand of the UR5 is, in the world, m."""
    import rospy
    from moveit_msgs.srv import GetPositionFK, GetPositionFKRequest
    from sensor_msgs.msg import JointState

    rospy.init_node("desk_bench", disable_signals=True)
    rospy.wait_for_service("compute_fk", 60)
    request = GetPositionFKRequest(fk_link_names=["tool0"])
    request.robot_state.joint_state = rospy.wait_for_message("joint_states", JointState, 60)
    position = rospy.ServiceProxy("compute_fk", GetPositionFK)(request).pose_stamped[0].pose.position
    return {"X": position.x, "Y": position.y, "Z": position.z}


def open_window(desktop, config, *options):
    """Seconds from the command to a display that has its robot and scene; the least of two starts."""
    least, program = math.inf, None
    for _ in range(2):
        if program is not None:
            program.end()
        begin = time.monotonic()
        program = desktop.run([os.path.abspath(__file__), "--window", config, *options], DRI_NO_MSAA="0" if "--smooth" in options else "1")
        program.wait(lambda: program.ask("text", "figures") and json.loads(program.ask("text", "figures"))[3] == "Status: Ok")
        least = min(least, time.monotonic() - begin)
    return least, program


def drag(desktop, program, seconds, how):
    """Pictures and answers of inverse kinematics a second while the goal goes in circles; ms of processor time a picture."""
    program.click_text("Joints")
    program.wait(lambda: json.loads(program.text("figures"))[2] == list(SIZE), "view of the wanted size")
    time.sleep(2.0)
    x, y, width, height = program.rect("view")
    x, y = x + width // 2, y + height // 2
    desktop.xdotool("mousemove", x, y)
    time.sleep(0.5)
    desktop.xdotool("mousedown", 1)
    way = []
    for step in range(int(seconds * MOUSE)):
        angle = 2 * math.pi * step / MOUSE / 3
        way.append(
            f"mousemove {round(x - CIRCLE + CIRCLE * math.cos(angle))} {round(y + CIRCLE * math.sin(angle))}\nsleep {1 / MOUSE:.4f}\n"
        )
    before, begin, pictures = json.loads(program.text("figures"))[0], time.monotonic(), []
    times = psutil.Process(program.process.pid).cpu_times
    spent = sum(times()[:2])
    mouse = subprocess.Popen(["xdotool", "-"], env=desktop.environment, stdin=subprocess.PIPE, text=True)
    mouse.stdin.write("".join(way))
    mouse.stdin.close()
    while mouse.poll() is None:
        time.sleep(1.0)
        pictures.append(json.loads(program.text("figures"))[1])
    passed = time.monotonic() - begin
    answers = (json.loads(program.text("figures"))[0] - before) / passed
    desktop.xdotool("mouseup", 1)
    mean = sum(pictures[1:]) / max(1, len(pictures) - 1)
    name = f"goal dragged, 800x600, UR5{how}: "
    return {
        name + "pictures a second": mean,
        name + "answers of inverse kinematics a second": answers,
        name + "processor ms of RViz a picture, all threads": 1000 * (sum(times()[:2]) - spent) / max(1.0, mean * passed),
    }


def measure(seconds):
    """All figures."""
    import yaml
    from rqt_testing.desktop import Desktop

    with tempfile.TemporaryDirectory() as folder:
        config = os.path.join(folder, "desk.rviz")
        CONFIG["Visualization Manager"]["Views"] = {
            "Current": {"Class": "rviz/Orbit", "Distance": 2.2, "Focal Point": hand(), "Pitch": 0.3, "Yaw": 0.8}
        }
        with open(config, "w", encoding="utf-8") as file:
            yaml.safe_dump(CONFIG, file)
        with Desktop("1600x900x24") as desktop:
            opened, program = open_window(desktop, config)
            figures = {"RViz with MotionPlanning: seconds to its robot and scene": opened, **drag(desktop, program, seconds, "")}
            program.end()
            _, program = open_window(desktop, config, "--smooth")
            figures.update(drag(desktop, program, seconds, ", anti-aliased"))
            program.end()
    return figures


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", metavar="FILE")
    parser.add_argument("--seconds", type=float, default=10.0, help="of dragging")
    parser.add_argument("--window", metavar="CONFIG", help=argparse.SUPPRESS)
    parser.add_argument("--smooth", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.window:
        return window(options.window, options.smooth)
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with tempfile.TemporaryDirectory() as home:
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOME=home)
        demo = subprocess.Popen(
            ["roslaunch", "-p", str(port), "myur5_moveit_config", "demo.launch", "use_rviz:=false"],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        try:
            while subprocess.run(["rosparam", "list"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode:
                time.sleep(0.2)
            figures = measure(options.seconds)
        finally:
            demo.send_signal(signal.SIGINT)
            demo.wait(30)
    for name, value in figures.items():
        print(f"{name:80} {value:10.4g}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as file:
            json.dump(figures, file)
    return 0


if __name__ == "__main__":
    sys.exit(main())
