#!/usr/bin/env python3
"""Whole server processes in lock-step: with one seed their pictures are the same, byte by byte."""

import contextlib
import hashlib
import os
import pathlib
import signal
import subprocess

import rospy
import rostest
import test_support
from gazebo_msgs.srv import SpawnModel
from gazebo_ros.srv import StepWorld
from geometry_msgs.msg import Point, Pose, Quaternion
from listening import Ear
from sensor_msgs.msg import CameraInfo, CompressedImage, Image, PointCloud2
from std_msgs.msg import Bool

WORLD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worlds", "cameras.world")
TUMBLING = """<sdf version="1.6"><model name="any"><link name="l"><inertial><mass>1</mass></inertial>
    <collision name="c"><geometry><box><size>0.3 0.2 0.4</size></box></geometry></collision>
    <visual name="v"><geometry><box><size>0.3 0.2 0.4</size></box></geometry>
    <material><ambient>{} 0 1 1</ambient></material></visual></link></model></sdf>"""
#: topic -> type and how many messages STEPS bring
STREAMS = {
    "eye/image_raw": (Image, 15),
    "eye/image_raw/compressed": (CompressedImage, 15),
    "robot/camera/image": (Image, 5),
    "kinect/depth/image_raw": (Image, 5),
    "kinect/points": (PointCloud2, 5),
}
STEPS = 500


class Server:
    """A gzserver in a namespace of its own, ended at the end of the block."""

    def __init__(self, name, seed):
        self.name = name
        options = ["-u", "--lockstep", "--seed", str(seed), WORLD, f"__ns:=/{name}"]
        self.process = subprocess.Popen(["rosrun", "gazebo_ros", "gzserver", *options], start_new_session=True)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        os.killpg(self.process.pid, signal.SIGINT)
        self.process.wait(timeout=60)

    def ready(self):
        """Its step function."""
        rospy.wait_for_message(f"/{self.name}/gazebo/ready", Bool, 60)
        return rospy.ServiceProxy(f"/{self.name}/gazebo/step", StepWorld)

    def hear(self, topic, kind):
        return Ear(f"/{self.name}/{topic}", kind, f"/{self.name}/gazebo")

    def draws(self):
        """Whether it has a process that draws: the only child that a server has."""
        children = pathlib.Path("/proc", str(self.process.pid), "task").glob("*/children")
        return any(of_thread.read_text() for of_thread in children)

    def pictures(self):
        """topic -> every picture of STEPS, as (stamp in ns, digest of the bytes)."""
        step = self.ready()
        spawn = rospy.ServiceProxy(f"/{self.name}/gazebo/spawn_sdf_model", SpawnModel)
        for i in range(3):  # they fall onto each other before the cameras
            where = Pose(Point(1.6, 0.05 * i, 0.2 + 0.6 * i), Quaternion(0.2, 0.1 * i, 0.3, 0.9))
            answer = spawn(f"box{i}", TUMBLING.format(i / 2), "", where, "")
            if not answer.success:
                raise AssertionError(answer.status_message)
        with contextlib.ExitStack() as ears:
            heard = {topic: ears.enter_context(self.hear(topic, kind)) for topic, (kind, _) in STREAMS.items()}
            step(STEPS)
            return {
                topic: [(m.header.stamp.to_nsec(), hashlib.sha1(m.data).hexdigest()) for m in ear.wait(STREAMS[topic][1])]
                for topic, ear in heard.items()
            }


class Runs(test_support.TestCase):
    def test_two_processes_take_the_same_pictures(self):
        with Server("one", 5) as one, Server("two", 5) as two:
            first, second = one.pictures(), two.pictures()
        for topic, (_, count) in STREAMS.items():
            with self.subTest(topic=topic):
                self.assertEqual(first[topic], second[topic])
                self.assertEqual(len(first[topic]), count)
                digests = {digest for _, digest in first[topic]}
                self.assertGreater(len(digests), count // 2, "nothing moves in the pictures")

    def test_nothing_is_drawn_until_somebody_looks(self):
        with Server("blind", 0) as server:
            step = server.ready()
            step(500)
            with server.hear("eye/camera_info", CameraInfo) as infos:
                step(100)
                infos.wait(3)
            self.assertFalse(server.draws())
            with server.hear("eye/image_raw", Image) as images:
                self.assertFalse(server.draws())  # paused
                step(40)
                images.wait(1)
            self.assertTrue(server.draws())


if __name__ == "__main__":
    rospy.init_node("camera_runs_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "camera_runs", Runs)
