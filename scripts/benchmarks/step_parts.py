#!/usr/bin/env python3
"""Where the microseconds of a step go: the simulator with a robot and its controllers, in one process, parts timed.

usage: step_parts.py ROBOT STEPS [COPIES], in an environment whose ROS master runs. Prints one line of JSON.
Times are processor time of the physics thread, so that other load on the machine does not count. What looking at the clock costs, a
call into the kernel, is measured as well and taken off.
"""

import gc
import json
import os
import resource
import sys
import tempfile
import threading
import time
from dataclasses import replace

import ode_sim
import rospy
from gazebo_ros.commands import command_line
from gazebo_ros.node import _SWITCH_INTERVAL, make_server
from gazebo_ros_control.plugin import GazeboRosControl
from robots import ROBOTS, write_world

clock = time.thread_time_ns


class Part:
    """What calls of a function take."""

    def __init__(self):
        self.ns = self.calls = 0

    def timed(self, call):
        def wrapper(*arguments):
            start = clock()
            try:
                return call(*arguments)
            finally:
                self.ns += clock() - start
                self.calls += 1

        return wrapper


def cost_of_looking(calls=20000):
    """(ns of a timed call that count as its own, ns that it takes beside them)"""

    def nothing():
        pass

    part, begin = Part(), clock()
    looked = part.timed(nothing)
    for _ in range(calls):
        looked()
    whole, begin = clock() - begin, clock()
    for _ in range(calls):
        nothing()
    bare = (clock() - begin) / calls
    inside = part.ns / calls - bare
    return inside, whole / calls - bare - inside


def main():
    robot, steps, copies = ROBOTS[sys.argv[1]], int(sys.argv[2]), int((sys.argv + ["1"])[3])
    rospy.set_param("/use_sim_time", True)
    text, config = robot.urdf(), robot.controllers()
    spaces = [f"robot{i}" for i in range(copies)]
    for space in spaces:
        rospy.set_param(f"/{space}", config)
        rospy.set_param(f"/{space}/robot_description", text)
    rospy.init_node("gazebo", disable_rostime=True, disable_signals=True, log_level=rospy.WARN)
    spent = {"core": Part(), "hardware and controllers": Part()}
    GazeboRosControl._step = spent["hardware and controllers"].timed(GazeboRosControl._step)
    ode_sim._core.World.step = spent["core"].timed(ode_sim._core.World.step)
    with tempfile.TemporaryDirectory() as folder:
        server = make_server(command_line.parse(["-u", write_world(os.path.join(folder, "bench.world"))]))
    sys.setswitchinterval(_SWITCH_INTERVAL)
    thread = threading.Thread(target=server.run, daemon=True)
    thread.start()

    for index, space in enumerate(spaces):
        model, _ = ode_sim.description.read_urdf(
            text.replace("<robotNamespace>/arm", f"<robotNamespace>/{space}"), name=space, finder=server.finder
        )
        model = replace(model, pose=ode_sim.Pose((2.0 * index, 0.0, 0.0)))
        resolved = server.plugins.resolve(model)
        server.call(lambda: server.spawn(model, resolved))
    managers = [thing._manager for thing in gc.get_objects() if isinstance(thing, GazeboRosControl)]
    server.call(server.unpause)
    for manager in managers:
        for name in robot.started:
            if not manager.load_controller(name):
                raise SystemExit(f"controller {name} cannot be loaded")
        if not manager.switch_controller(robot.started, []):
            raise SystemExit("the controllers cannot be started")
    for space in spaces:
        robot.command(f"/{space}")
    time.sleep(1.0)
    server.call(server.pause)
    for part in spent.values():
        part.ns = part.calls = 0
    inside, beside = server.call(cost_of_looking)
    begin = server.call(clock)
    wall = time.perf_counter()
    server.call(lambda: server.request_steps(steps)).result()
    wall = time.perf_counter() - wall
    total = server.call(clock) - begin - sum(part.calls for part in spent.values()) * (inside + beside)
    result = {name: (part.ns - part.calls * inside) / steps / 1e3 for name, part in spent.items()}
    result["ROS and the rest"] = total / steps / 1e3 - sum(result.values())
    result["step"] = total / steps / 1e3
    result["wall"] = wall / steps * 1e6
    result["memory"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(json.dumps(result), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
