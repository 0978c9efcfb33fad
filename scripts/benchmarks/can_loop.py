#!/usr/bin/env python3
"""Cycle times of rm_hw's control loop against the motor bench, with one and with four motors.

Starts a roscore of its own, the bench, rm_hw with a position controller on every motor, and plots the histograms::

    scripts/benchmarks/can_loop.py --seconds 20 --picture out/can_loop.png
"""

import argparse
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

import matplotlib
import numpy
import yaml

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

BINS_MS = numpy.arange(0.0, 3.05, 0.05)
JOINT = """<joint name="{0}" type="continuous"><parent link="base"/><child link="{0}_link"/><axis xyz="0 0 1"/>
<limit effort="3" velocity="100"/></joint><link name="{0}_link"/>
<transmission name="{0}_transmission"><type>transmission_interface/SimpleTransmission</type>
<joint name="{0}"><hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
<actuator name="{0}_motor"><mechanicalReduction>19.2032</mechanicalReduction></actuator></transmission>"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def parameters(joints, log):
    """Everything rm_hw and the controllers need, as one mapping."""
    robot = "<robot name='bench'><link name='base'/>" + "".join(JOINT.format(joint) for joint in joints) + "</robot>"
    controllers = {
        f"{joint}_controller": {
            "type": "effort_controllers/JointPositionController",
            "joint": joint,
            "pid": {"p": 3.0, "i": 0.0, "d": 0.05},
        }
        for joint in joints
    }
    controllers["joint_state_controller"] = {"type": "joint_state_controller/JointStateController", "publish_rate": 50}
    return {
        "robot_description": robot,
        **controllers,
        "rm_hw": {
            "bus": ["can0"],
            "interface": "slcan",
            "loop_frequency": 1000,
            "cycle_time_error_threshold": 0.001,
            "cycle_time_log": log,
            "actuators": {f"{joint}_motor": {"bus": "can0", "id": 0x201 + i, "type": "rm_3508"} for i, joint in enumerate(joints)},
        },
    }


def run(motors, seconds, folder):
    """Cycle times in ms, without the first second."""
    joints = [f"joint{i + 1}" for i in range(motors)]
    log, port = os.path.join(folder, f"{motors}.npy"), free_port()
    environment = {**os.environ, "RM_BENCH_DIR": folder, "ROS_HOME": folder, "ROS_MASTER_URI": f"http://localhost:{port}"}
    quiet = {"env": environment, "stdout": subprocess.DEVNULL}
    files = {
        "bench.yaml": {"motors": {f"{joint}_motor": {"bus": "can0", "id": 0x201 + i, "type": "rm_3508"} for i, joint in enumerate(joints)}},
        "parameters.yaml": parameters(joints, log),
    }
    for name, content in files.items():
        with open(os.path.join(folder, name), "w") as file:
            yaml.safe_dump(content, file)
    processes = [subprocess.Popen(["roscore", "-p", str(port)], **quiet)]
    try:
        while subprocess.run(["rosparam", "load", os.path.join(folder, "parameters.yaml")], stderr=subprocess.DEVNULL, **quiet).returncode:
            time.sleep(0.2)
        processes.append(
            subprocess.Popen(["rosrun", "rm_hw", "motor_bench", "--no-ros", "--config", os.path.join(folder, "bench.yaml")], **quiet)
        )
        processes.append(subprocess.Popen(["rosrun", "rm_hw", "rm_hw", "__name:=rm_hw"], **quiet))
        subprocess.run(
            [
                "rosrun",
                "controller_manager",
                "controller_manager",
                "spawn",
                "joint_state_controller",
                *(f"{joint}_controller" for joint in joints),
            ],
            check=True,
            timeout=60,
            **quiet,
        )
        time.sleep(seconds)
    finally:
        for process in reversed(processes):
            process.send_signal(signal.SIGINT)
            process.wait()
    return numpy.load(log)[-int(seconds * 1000) :] * 1000.0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--picture", default="out/can_loop.png")
    parser.add_argument("--json", metavar="FILE", help="write the figures there as well")
    parser.add_argument("--motors", type=int, nargs="+", default=[1, 4])
    options = parser.parse_args()
    _, axes = plt.subplots(len(options.motors), 1, figsize=(8, 3 * len(options.motors)), squeeze=False)
    worst, figures = 0.0, {}
    for axis, motors in zip(axes[:, 0], options.motors):
        with tempfile.TemporaryDirectory(prefix="can_loop") as folder:
            cycles = run(motors, options.seconds, folder)
        p50, p99, p999 = numpy.percentile(cycles, [50, 99, 99.9])
        worst = max(worst, p99)
        text = (
            f"{motors} motor{'s' * (motors > 1)}: {len(cycles)} cycles, median {p50:.3f} ms, p99 {p99:.3f} ms, "
            f"p99.9 {p999:.3f} ms, longest {cycles.max():.3f} ms"
        )
        print(text, flush=True)
        figures.update(
            {
                f"rm_hw at 1 kHz, {motors} motors: {name} cycle, ms": value
                for name, value in (("median", p50), ("p99", p99), ("p99.9", p999), ("longest", cycles.max()))
            }
        )
        axis.hist(numpy.clip(cycles, BINS_MS[0], BINS_MS[-1]), BINS_MS, log=True)
        axis.axvline(p99, color="red", linewidth=1)
        axis.set(title=text, xlabel="cycle time in ms (longer ones in the last bin)", ylabel="cycles")
        axis.title.set_fontsize(8)
    plt.tight_layout()
    os.makedirs(os.path.dirname(options.picture) or ".", exist_ok=True)
    plt.savefig(options.picture, dpi=100)
    if options.json:
        with open(options.json, "w", encoding="utf-8") as out:
            json.dump(figures, out, indent=2)
    return 0 if worst < 1.5 else 1


if __name__ == "__main__":
    sys.exit(main())
