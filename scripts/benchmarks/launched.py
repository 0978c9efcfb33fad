#!/usr/bin/env python3
"""A robot launched as a student would, then run as fast as possible at 1 ms steps; what it did, as one line of JSON.

usage: launched.py arm|ur5|ur5_effort SECONDS
"""

import json
import os
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import time
import xmlrpc.client

WINDOWS = 3

with socket.socket() as probe:  # a master of its own, before rospy reads the environment
    probe.bind(("127.0.0.1", 0))
    PORT = probe.getsockname()[1]
os.environ["ROS_MASTER_URI"] = f"http://localhost:{PORT}"

import rospy  # noqa: E402
from control_msgs.msg import JointTrajectoryControllerState  # noqa: E402
from gazebo_msgs.srv import GetPhysicsProperties, SetPhysicsProperties  # noqa: E402
from robots import ROBOTS  # noqa: E402
from sensor_msgs.msg import JointState  # noqa: E402

CASES = {
    "arm": ("arm", ["arm_gazebo", "arm_gazebo.launch", "gui:=false", "rviz:=false"]),
    "ur5": ("ur5", ["myur5_description", "myur5.launch", "gui:=false"]),
    "ur5_effort": (
        "ur5",
        ["myur5_description", "myur5.launch", "gui:=false", "transmission_hw_interface:=hardware_interface/EffortJointInterface"],
    ),
}


class Watch:
    """Counts joint states and keeps their last stamp."""

    def __init__(self, topic):
        self.count, self.stamp, self.first = 0, 0.0, None
        rospy.Subscriber(topic, JointState, self._receive, buff_size=1 << 20)

    def _receive(self, message):
        self.first = self.first or time.monotonic()
        self.count, self.stamp = self.count + 1, message.header.stamp.to_sec()

    def wait(self):
        while not self.first:
            time.sleep(0.002)


def wait_for_master():
    while True:
        try:
            return xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).getPid("/bench")
        except (OSError, xmlrpc.client.Error):
            time.sleep(0.01)


def server_status():
    """(resident memory in MB, processor seconds) of the simulator."""
    _, _, uri = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).lookupNode("/bench", "/gazebo")
    pid = xmlrpc.client.ServerProxy(uri).getPid("/bench")[2]
    with open(f"/proc/{pid}/status", encoding="utf-8") as file:
        resident = next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))
    with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
        ticks = sum(map(int, file.read().rsplit(")", 1)[1].split()[11:13]))
    return resident / 1024.0, ticks / os.sysconf("SC_CLK_TCK")


def run_free():
    """1 ms steps, as fast as possible; everything else stays as the world has it."""
    now = rospy.ServiceProxy("/gazebo/get_physics_properties", GetPhysicsProperties)()
    rospy.ServiceProxy("/gazebo/set_physics_properties", SetPhysicsProperties)(0.001, 0.0, now.gravity, now.ode_config)


def measure(robot, namespace, seconds):
    errors = []
    watch = Watch(f"{namespace}/joint_states")
    watch.wait()
    result = {"start": watch.first}
    for name in robot.started:
        while not rospy.has_param(f"{namespace}/{name}/type"):
            time.sleep(0.1)
    rospy.Subscriber(
        "/arm_controller/state", JointTrajectoryControllerState, lambda message: errors.append(max(map(abs, message.error.positions)))
    )
    time.sleep(3.0)  # the launch files' other nodes come up
    run_free()
    robot.command(namespace)
    time.sleep(2.0)
    del errors[:]  # of getting to where the swings begin
    factors, rates, costs = [], [], []
    for _ in range(WINDOWS):
        wall, sim, count, (_, busy) = time.monotonic(), watch.stamp, watch.count, server_status()
        time.sleep(seconds / WINDOWS)
        now, memory_and_time = time.monotonic(), server_status()
        gone = watch.stamp - sim
        factors.append(gone / (now - wall))
        rates.append((watch.count - count) / gone)
        costs.append((memory_and_time[1] - busy) / gone * 1e3)
    return {
        **result,
        "real-time factor": statistics.median(factors),
        "joint states": statistics.median(rates),
        "processor us per step": statistics.median(costs),
        "memory": server_status()[0],
        "largest error": max(errors, default=0.0),
    }


def main():
    name, arguments = CASES[sys.argv[1]]
    robot = ROBOTS[name]
    with tempfile.TemporaryDirectory() as home:
        start = time.monotonic()
        launch = subprocess.Popen(
            ["roslaunch", "-p", str(PORT), *arguments],
            env=dict(os.environ, ROS_HOME=home),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            wait_for_master()
            rospy.init_node("bench", disable_rostime=True, disable_signals=True, log_level=rospy.FATAL)
            result = measure(robot, robot.namespace.rstrip("/"), float(sys.argv[2]))
        finally:
            launch.send_signal(signal.SIGINT)
            launch.wait(timeout=30)
    result["start"] -= start
    print(json.dumps(result), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
