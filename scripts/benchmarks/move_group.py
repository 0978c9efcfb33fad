#!/usr/bin/env python3
"""The node move_group of the pedestal UR5: how long it takes to be ready, its memory, and a thousand plans; as one line of JSON.

usage: move_group.py PLANS
"""

import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import xmlrpc.client

with socket.socket() as probe:  # a master of its own, before rospy reads the environment
    probe.bind(("127.0.0.1", 0))
    PORT = probe.getsockname()[1]
os.environ["ROS_MASTER_URI"] = f"http://localhost:{PORT}"
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)  # whoever sets it compiles all messages anew at every start

import numpy as np  # noqa: E402
import rospy  # noqa: E402
from moveit_msgs.msg import Constraints, JointConstraint, MotionPlanRequest, RobotState  # noqa: E402
from moveit_msgs.srv import GetMotionPlan  # noqa: E402

JOINTS = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
READY = "You can start planning now!"
WARM = 100  # plans before memory is looked at for growth


def processor_seconds(pid):
    with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
        return sum(map(int, file.read().rsplit(")", 1)[1].split()[11:13])) / os.sysconf("SC_CLK_TCK")


def of_children(pid):
    """Processor seconds of a process and all that it started, as far as they live or were waited for."""
    total, parents = 0.0, {}
    for entry in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{entry}/stat", encoding="utf-8") as file:
                fields = file.read().rsplit(")", 1)[1].split()
        except OSError:
            continue
        parents[int(entry)] = (int(fields[1]), sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK"))
    for number, (_, seconds) in parents.items():
        ancestor = number
        while ancestor not in (pid, 0, 1) and ancestor in parents:
            ancestor = parents[ancestor][0]
        total += seconds if ancestor == pid else 0.0
    return total


def memory(pid):
    """Resident MB."""
    with open(f"/proc/{pid}/status", encoding="utf-8") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS")) / 1024.0


def launch(home):
    """(process, wall s until move_group says that planning may start, processor s of all nodes by then)."""
    start = time.monotonic()
    process = subprocess.Popen(
        ["roslaunch", "-p", str(PORT), "myur5_moveit_config", "demo.launch", "use_rviz:=false"],
        env=dict(os.environ, ROS_HOME=home, PYTHONUNBUFFERED="1"),
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    )
    said = []
    for line in process.stdout:
        said.append(line.strip())
        if READY in line:
            threading.Thread(target=process.stdout.read, daemon=True).start()  # a pipe that nobody empties stops the node
            return process, time.monotonic() - start, of_children(process.pid)
    raise RuntimeError("move_group did not come up: " + " / ".join(said[-5:]))


def pid_of(node):
    _, _, uri = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).lookupNode("/bench", node)
    return xmlrpc.client.ServerProxy(uri).getPid("/bench")[2]


def request(random):
    message = MotionPlanRequest(
        group_name="manipulator",
        allowed_planning_time=5.0,
        num_planning_attempts=1,
        start_state=RobotState(is_diff=True),
        max_velocity_scaling_factor=1.0,
        max_acceleration_scaling_factor=1.0,
    )
    values = random.uniform((-3, -2.6, -2.2, -3, -3, -3), (3, -0.6, 2.2, 3, 3, 3))
    message.goal_constraints = [
        Constraints(joint_constraints=[JointConstraint(name, value, 1e-4, 1e-4, 1.0) for name, value in zip(JOINTS, values)])
    ]
    return message


def plan(count, pid):
    """Memory after the first plans and at the end, MB; processor ms of a plan; share that was solved."""
    service, random = rospy.ServiceProxy("/plan_kinematic_path", GetMotionPlan, persistent=True), np.random.default_rng(1)
    warm = min(WARM, count // 2)
    solved, first, busy = 0, None, processor_seconds(pid)
    for number in range(count):
        solved += service(request(random)).motion_plan_response.error_code.val == 1
        if number + 1 == warm:
            first = memory(pid)
    return first, memory(pid), (processor_seconds(pid) - busy) / count * 1e3, solved / count


def main():
    count = int(sys.argv[1])
    with tempfile.TemporaryDirectory() as home:
        process, ready, launched = launch(home)
        try:
            rospy.init_node("bench", disable_rostime=True, disable_signals=True, log_level=rospy.FATAL)
            pid = pid_of("/move_group")
            figures = {
                "ready": ready,
                "processor seconds of the launch": launched,
                "processor seconds": processor_seconds(pid),
                "memory": memory(pid),
                "plans": count,
            }
            if count:
                first, last, cost, solved = plan(count, pid)
                figures.update({"memory after plans": last, "growth": last - first, "solved": solved, "ms per plan": cost})
        finally:
            process.send_signal(signal.SIGINT)
            process.wait(timeout=60)
    print(json.dumps(figures), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
