#!/usr/bin/env python3
"""What mobile robots cost: mbot with laser and kinect in the playground, and one to sixteen of them side by side.

    scripts/benchmarks/mobile.py                   a table
    scripts/benchmarks/mobile.py --json out.json   the same, for programs

The server runs in a process of its own with the sensors' topics subscribed, the robot driving circles. The sensors are
mbot's own, set to 10 Hz: 360 rays; 640x480 pixels of colour, depth and cloud. The world's step is set to 1 ms.
"""

import argparse
import contextlib
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import xmlrpc.client

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from robots import find, write_world, xacro  # noqa: E402
from run import master  # noqa: E402

SETTLE = 1.5  # s of wall time before a measurement
SECONDS = 4.0  # s of wall time of a measurement
SENSORS = {"laser": ("/scan",), "kinect": ("/kinect/rgb/image_raw", "/kinect/depth/image_raw", "/kinect/depth/points")}


def robot(variant, prefix=""):
    """URDF of mbot with its sensors at 10 Hz; topics begin with ``prefix`` instead of /."""
    text = xacro(find("mbot_description", "urdf", "xacro", "gazebo", f"mbot_{variant}gazebo.xacro"))
    text = re.sub(r"<(update_rate|updateRate)>(5\.5|20\.0|10)</", r"<\1>10</", text)
    text = text.replace("<robotNamespace>/<", f"<robotNamespace>{prefix or '/'}<")
    return text.replace("<topicName>/scan<", f"<topicName>{prefix}/scan<")


def world(folder, throttled):
    """The playground with steps of 1 ms, at real time or as fast as the machine goes."""
    with open(find("mbot_gazebo", "worlds", "playground.world"), encoding="utf-8") as file:
        text = file.read()
    for element, value in (("max_step_size", 0.001), ("real_time_update_rate", 1000 if throttled else 0)):
        text, count = re.subn(f"<{element}>.*?</", f"<{element}>{value}</", text)
        if count != 1:
            raise ValueError(f"playground.world: expected one <{element}>, found {count}")
    path = os.path.join(folder, "bench.world")
    with open(path, "w", encoding="utf-8") as out:
        out.write(text)
    return path


@contextlib.contextmanager
def server(path):
    """The simulator on a world file. :returns: its process"""
    process = subprocess.Popen(["rosrun", "gazebo_ros", "gzserver", path], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield process
    finally:
        pid = pid_of("/gazebo")
        os.kill(pid, signal.SIGINT)
        process.wait(timeout=30)


def pid_of(node):
    """Process number of a node of this master."""
    _, _, uri = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).lookupNode("/mobile_bench", node)
    return xmlrpc.client.ServerProxy(uri).getPid("/mobile_bench")[2]


def processor_seconds(pid):
    """Of a process and the render process that it may have started."""
    with open(f"/proc/{pid}/task/{pid}/children", encoding="utf-8") as file:
        family = [pid, *map(int, file.read().split())]
    total = 0
    for member in family:
        with open(f"/proc/{member}/stat", encoding="utf-8") as file:
            total += sum(map(int, file.read().rsplit(")", 1)[1].split()[11:13]))
    return total / os.sysconf("SC_CLK_TCK")


def spawn(robots):
    """:param robots: URDF texts, put in a row 3 m apart, away from the playground's things."""
    import rospy
    from gazebo_msgs.srv import SpawnModel
    from geometry_msgs.msg import Point, Pose, Quaternion

    rospy.wait_for_service("/gazebo/spawn_urdf_model", 30)
    call = rospy.ServiceProxy("/gazebo/spawn_urdf_model", SpawnModel)
    for index, text in enumerate(robots):
        pose = Pose(Point(0, -3.0 * index, 0), Quaternion(0, 0, 0, 1))
        answer = call(f"mbot{index}", text, "", pose, "")
        if not answer.success:
            raise RuntimeError(f"mbot{index} cannot be spawned: {answer.status_message}")


class Count:
    """Messages of a topic, taken as bytes: that they are read must not cost the figures."""

    def __init__(self, topic):
        import rospy

        self.number = 0
        self.subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._receive, buff_size=1 << 24)

    def _receive(self, _):
        self.number += 1


def measure(path, robots, topics, commands=("/cmd_vel",)):
    """:returns: real-time factor, processor seconds per second of wall time and of sim time, rate of topics (sim Hz)"""
    import rospy
    from gazebo_msgs.srv import GetWorldProperties
    from geometry_msgs.msg import Twist

    with server(path):
        spawn(robots)
        counts = [Count(topic) for topic in topics]
        circle = Twist()
        circle.linear.x, circle.angular.z = 0.3, 0.6
        drivers = [rospy.Publisher(topic, Twist, queue_size=1, latch=True) for topic in commands]
        for driver in drivers:
            driver.publish(circle)
        state = rospy.ServiceProxy("/gazebo/get_world_properties", GetWorldProperties)
        end = time.monotonic() + 30
        while not all(count.number for count in counts):
            if time.monotonic() > end:
                raise RuntimeError(f"no message in 30 s on one of {', '.join(topics)}")
            time.sleep(0.05)
        time.sleep(SETTLE)
        pid = pid_of("/gazebo")
        before = time.monotonic(), state().sim_time, processor_seconds(pid), [c.number for c in counts]
        time.sleep(SECONDS)
        after = time.monotonic(), state().sim_time, processor_seconds(pid), [c.number for c in counts]
        for thing in (*drivers, *(count.subscriber for count in counts)):
            thing.unregister()
    wall, sim, busy = (b - a for a, b in zip(before[:3], after[:3]))
    return sim / wall, busy / wall, busy / sim, [(b - a) / sim for a, b in zip(before[3], after[3])]


def playground(folder):
    figures = {}
    for sensor, topics in SENSORS.items():
        factor, load, _, rates = measure(world(folder, True), [robot(f"with_{sensor}_")], topics)
        title = {"laser": "mbot with 360 rays at 10 Hz", "kinect": "mbot with kinect 640x480 at 10 Hz"}[sensor]
        figures[f"{title}: real-time factor, throttled"] = factor
        figures[f"{title}: processors used, throttled"] = load
        for topic, rate in zip(topics, rates):
            figures[f"{title}: {topic}, per sim second"] = rate
    figures["mbot with 360 rays at 10 Hz: real-time factor, uncapped"] = measure(
        world(folder, False), [robot("with_laser_")], SENSORS["laser"]
    )[0]
    return figures


def scaling(folder):
    """Processor time per robot on empty ground, all driving, without sensors."""
    figures, one = {}, None
    for copies in (1, 2, 4, 8, 16):
        spaces = [f"/mbot{index}" for index in range(copies)]
        cost = measure(
            write_world(os.path.join(folder, "empty.world")),
            [robot("", space) for space in spaces],
            (),
            [f"{space}/cmd_vel" for space in spaces],
        )[2]
        one = one or cost
        figures[f"{copies} mbots: processor time per step and robot, us"] = cost * 1e3 / copies
        if copies > 1:
            figures[f"{copies} mbots: cost per mbot against one mbot"] = cost / one / copies
    return figures


def main(argv=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--json", metavar="FILE", help="write the figures there as well")
    options = parser.parse_args(argv)
    with master() as environment, tempfile.TemporaryDirectory() as folder:
        os.environ.update(environment)  # before rospy reads it
        import rospy

        rospy.set_param("/use_sim_time", True)
        rospy.init_node("mobile_bench", disable_rostime=True, disable_signals=True, log_level=rospy.FATAL)
        figures = {**playground(folder), **scaling(folder)}
    for name, value in figures.items():
        print(f"{name:72} {value:10.4g}")
    if options.json:
        with open(options.json, "w", encoding="utf-8") as out:
            json.dump(figures, out, indent=2)


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)  # rospy's threads would wait for the master that has gone
