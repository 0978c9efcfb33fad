#!/usr/bin/env python3
"""The arm of rm_controls_tutorials in simulation and on the motor bench: same controllers, same commands, one plot.

Position 0.0 for four seconds, then velocity 3.1415 for six, each run with a roscore of its own::

    scripts/benchmarks/arm_on_motor.py --picture out/arm_on_motor.png
"""

import argparse
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time

import matplotlib
import numpy

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

POSITION, VELOCITY, STATES = (
    f"controllers/{name}" for name in ("joint1_position_controller", "joint1_velocity_controller", "joint_state_controller")
)
POSITION_SECONDS, VELOCITY_SECONDS = 4.0, 6.0
RUNS = {"simulation": ["load_gazebo.launch", "gui:=false"], "motor bench": ["load_rm_hw.launch", "interface:=slcan"]}


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def record(path):
    """Command the controllers of the running robot and save (N, 3) time s, position rad, velocity rad/s."""
    import rospy
    from controller_manager_msgs.srv import SwitchController
    from sensor_msgs.msg import JointState
    from std_msgs.msg import Float64

    rospy.init_node("arm_on_motor")
    samples = []
    rospy.Subscriber(
        "/joint_states",
        JointState,
        lambda m: samples.append((m.header.stamp.to_sec(), m.position[m.name.index("joint1")], m.velocity[m.name.index("joint1")])),
    )
    publishers = {name: rospy.Publisher(f"/{name}/command", Float64, queue_size=1) for name in (POSITION, VELOCITY)}
    rospy.wait_for_service("/controller_manager/switch_controller", 30)
    switch = rospy.ServiceProxy("/controller_manager/switch_controller", SwitchController)

    def run(name, other, command, seconds):
        assert switch([name], [other], 1, True, 0.0).ok
        while publishers[name].get_num_connections() == 0:
            rospy.sleep(0.01)
        publishers[name].publish(command)
        begun = samples[-1][0] if samples else rospy.get_time()
        while not samples or samples[-1][0] < begun + seconds:
            rospy.sleep(0.05)
        return begun

    assert switch([STATES], [""], 1, True, 0.0).ok
    begun = run(POSITION, VELOCITY, 0.0, POSITION_SECONDS)
    run(VELOCITY, POSITION, 3.1415, VELOCITY_SECONDS)
    assert switch([], [VELOCITY], 1, True, 0.0).ok
    numpy.save(path, numpy.array(samples) - [begun, 0.0, 0.0])


def run(name, arguments, folder):
    """Samples of one run."""
    environment = {**os.environ, "RM_BENCH_DIR": folder, "ROS_MASTER_URI": f"http://localhost:{free_port()}", "ROS_HOME": folder}
    quiet, log = {"env": environment}, open(os.path.join(folder, f"{name}.log"), "w")
    quiet.update(stdout=log, stderr=log)
    path = os.path.join(folder, f"{name}.npy")
    processes = [subprocess.Popen(["roscore", "-p", environment["ROS_MASTER_URI"].rsplit(":")[-1]], **quiet)]
    try:
        if name == "motor bench":
            processes.append(subprocess.Popen(["rosrun", "rm_hw", "motor_bench", "--no-ros"], **quiet))
        mon = ["rosrun", "rosmon_core", "rosmon", "--disable-ui", "rm_controls_tutorials"]
        processes.append(subprocess.Popen([*mon, *arguments], **quiet))
        processes.append(subprocess.Popen([*mon, "load_controllers.launch"], **quiet))
        wait = ["rosservice", "call", "/controller_manager/list_controllers"]
        end = time.monotonic() + 60.0
        while VELOCITY not in subprocess.run(wait, env=environment, capture_output=True, text=True).stdout:
            if time.monotonic() > end:
                raise RuntimeError(f"the controllers are never loaded, see {log.name}")
            time.sleep(0.2)
        subprocess.run([sys.executable, __file__, "--record", path], check=True, timeout=120, env=environment)
    finally:
        for process in reversed(processes):
            process.send_signal(signal.SIGINT)
            process.wait()
    return numpy.load(path)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--picture", default="out/arm_on_motor.png")
    parser.add_argument("--record", metavar="FILE", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.record:
        record(options.record)
        return 0
    _, (above, below) = plt.subplots(2, 1, sharex=True, figsize=(9, 6))
    for name, arguments in RUNS.items():
        with tempfile.TemporaryDirectory(prefix="arm_on_motor") as folder:
            samples = run(name, arguments, folder)
        seconds, position, velocity = samples.T
        held = (seconds > POSITION_SECONDS - 1.0) & (seconds < POSITION_SECONDS)
        turning = seconds > POSITION_SECONDS + 1.0
        print(
            f"{name}: rests at {position[held].mean():+.4f} rad; turns at {velocity[turning].min():.2f} to "
            f"{velocity[turning].max():.2f} rad/s, mean {velocity[turning].mean():.2f}"
        )
        above.plot(seconds, position, label=name)
        below.plot(seconds, velocity, label=name)
    above.set(ylabel="joint1, rad", title="position 0.0, then velocity 3.1415")
    below.set(ylabel="joint1, rad/s", xlabel="s")
    below.axhline(3.1415, color="grey", linewidth=0.5)
    above.legend()
    plt.tight_layout()
    os.makedirs(os.path.dirname(options.picture) or ".", exist_ok=True)
    plt.savefig(options.picture, dpi=90)
    return 0


if __name__ == "__main__":
    sys.exit(main())
