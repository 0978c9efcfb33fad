#!/usr/bin/env python3
"""What a compiled controller and a compiled model plugin cost in a step, beside what they do themselves; see scripts/bench."""

import argparse
import json
import os
import shutil
import subprocess
import tempfile

import run
import yaml

HERE = os.path.dirname(os.path.abspath(__file__))
MANY = 20
ROUNDS = 11


def built(folder: str) -> dict:
    """The environment of a workspace with the package bench_compiled in it, as a user builds one. The labs stay visible."""
    shutil.copytree(os.path.join(HERE, "bench_compiled"), os.path.join(folder, "src", "bench_compiled"))
    subprocess.run(["catkin", "build", "--workspace", folder, "--no-notify", "--no-status"], check=True, stdout=subprocess.DEVNULL)
    devel = os.path.join(folder, "devel")
    before = {"CMAKE_PREFIX_PATH": devel, "LD_LIBRARY_PATH": os.path.join(devel, "lib"), "ROS_PACKAGE_PATH": os.path.join(folder, "src")}
    return {**os.environ, **{name: f"{value}:{os.environ.get(name, '')}" for name, value in before.items()}}


def step(environment: dict, steps: int, controllers: int = 0, rounds: int = 1, plugins: int = 0) -> float:
    """Processor time of the physics thread in a step, us; the least of three runs."""
    times = []
    for _ in range(3):
        with run.master() as own:
            environment = {**environment, "ROS_MASTER_URI": own["ROS_MASTER_URI"], "ROS_HOME": own["ROS_HOME"]}
            times.append(run.program("compiled_steps.py", steps, controllers, rounds, plugins, environment=environment)["step"])
    return min(times)


LOOP = """
states: {type: joint_state_controller/JointStateController, publish_rate: 50}
left: {type: position_controllers/JointPositionController, joint: left}
lamp: {type: controller_manager_tests/CompiledLamp}
"""


def loop(cycles: int) -> list:
    """Of the periods of a robot in C++ at 1 kHz, with two controllers in Python and one in C++: median, p99, longest, ms."""
    with run.master() as environment:
        quiet = {"env": environment, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        subprocess.run(["rosparam", "load", "-"], input=LOOP.encode(), check=True, **quiet)
        robot = subprocess.Popen(["rosrun", "controller_manager_tests", "cpp_robot", f"_measured_cycles:={cycles}"], **quiet)
        try:
            spawn = ["rosrun", "controller_manager", "controller_manager", "spawn", *yaml.safe_load(LOOP)]
            subprocess.run(spawn, check=True, timeout=60, **quiet)
            echo = subprocess.run(
                ["rostopic", "echo", "-n1", "/lateness/data"],
                env=environment,
                stdout=subprocess.PIPE,
                text=True,
                check=True,
                timeout=60 + cycles / 500,
            )
        finally:
            robot.terminate()
            robot.wait(timeout=30)
    return [value * 1e3 for value in yaml.safe_load(echo.stdout.split("---")[0])]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--json", required=True)
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    steps = 4000 if options.quick else 20000
    with tempfile.TemporaryDirectory() as folder:
        environment = built(folder)
        alone = step(environment, steps)
        read = step(environment, steps, controllers=MANY)
        itself = (step(environment, steps, controllers=MANY, rounds=ROUNDS) - read) / MANY / (ROUNDS - 1)
        one, many = (step(environment, steps, plugins=count) for count in (1, 1 + MANY))
    median, p99, longest = loop(5000 if options.quick else 20000)
    figures = {
        "UR5 with Python's controllers alone, us per step": alone,
        "compiled controller that reads 6 joints, us per step": (read - alone) / MANY,
        "compiled controller: what it does itself, us per step": itself,
        "compiled controller: what calling it costs more, us": (read - alone) / MANY - itself,
        "first compiled model plugin, with the mirror of the world that it brings, us per step": one - alone,
        "compiled model plugin that reads a pose and adds a force, us per step": (many - one) / MANY,
        "robot in C++ at 1 kHz, controllers of both languages: median period, ms": median,
        "robot in C++ at 1 kHz, controllers of both languages: p99 period, ms": p99,
        "robot in C++ at 1 kHz, controllers of both languages: longest period, ms": longest,
    }
    with open(options.json, "w", encoding="utf-8") as file:
        json.dump(figures, file)


if __name__ == "__main__":
    main()
