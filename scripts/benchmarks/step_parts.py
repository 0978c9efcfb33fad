#!/usr/bin/env python3
"""Where the microseconds of a step go: the simulator with a robot and its controllers, in one process, parts timed.

usage: step_parts.py ROBOT STEPS [COPIES], in an environment whose ROS master runs. Prints one line of JSON.
Times are processor time of the physics thread, so that other load on the machine does not count.
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
from gazebo_ros import command_line
from gazebo_ros.node import _SWITCH_INTERVAL, make_server
from gazebo_ros_control.plugin import GazeboRosControl
from robots import ROBOTS, write_world

clock = time.thread_time_ns


def timed(call, spent, name):
    def wrapper(*arguments):
        start = clock()
        try:
            return call(*arguments)
        finally:
            spent[name] += clock() - start
    return wrapper


def main():
    robot, steps, copies = ROBOTS[sys.argv[1]], int(sys.argv[2]), int((sys.argv + ["1"])[3])
    rospy.set_param("/use_sim_time", True)
    text, config = robot.urdf(), robot.controllers()
    spaces = [f"robot{i}" for i in range(copies)]
    for space in spaces:
        rospy.set_param(f"/{space}", config)
        rospy.set_param(f"/{space}/robot_description", text)
    rospy.init_node("gazebo", disable_rostime=True, disable_signals=True, log_level=rospy.WARN)
    spent = dict.fromkeys(("core", "hardware and controllers"), 0)
    GazeboRosControl._step = timed(GazeboRosControl._step, spent, "hardware and controllers")
    ode_sim._core.World.step = timed(ode_sim._core.World.step, spent, "core")
    with tempfile.TemporaryDirectory() as folder:
        server = make_server(command_line.parse(["-u", write_world(os.path.join(folder, "bench.world"))]))
    sys.setswitchinterval(_SWITCH_INTERVAL)
    thread = threading.Thread(target=server.run, daemon=True)
    thread.start()

    for index, space in enumerate(spaces):
        model, _ = ode_sim.description.read_urdf(text.replace("<robotNamespace>/arm", f"<robotNamespace>/{space}"),
                                                 name=space, finder=server.finder)
        model = replace(model, pose=ode_sim.Pose((2.0 * index, 0.0, 0.0)))
        resolved = server.resolve(model)
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
    server.call(lambda: [spent.update({key: 0}) for key in spent])
    begin = server.call(clock)
    wall = time.perf_counter()
    server.call(lambda: server.request_steps(steps)).result()
    wall = time.perf_counter() - wall
    total = server.call(clock) - begin
    result = {name: value / steps / 1e3 for name, value in spent.items()}
    result["ROS and the rest"] = total / steps / 1e3 - sum(result.values())
    result["step"] = total / steps / 1e3
    result["wall"] = wall / steps * 1e6
    result["memory"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    print(json.dumps(result), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main()
