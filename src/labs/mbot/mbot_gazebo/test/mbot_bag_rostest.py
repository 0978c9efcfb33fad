#!/usr/bin/env python3
"""A slow drive through the room, recorded as one would for mapping: the bag holds every scan, and replays them."""

import os
import signal
import subprocess
import tempfile
import time
import unittest
import xmlrpc.client

import rosbag
import rosgraph
import rospy
import rostest
from geometry_msgs.msg import Twist
from lab_tools.simulation import PATIENCE, Topic, run_free
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan

NOISE = 0.01  # m, standard deviation of a ray
WALL = 5.18 - 0.075  # m, ahead of where the robot starts
SPEED, SECONDS = 0.3, 4.0
RECORDED = 15.0  # s of the simulation: more than the drive takes


def content(scan):
    """What has to survive the bag."""
    return (scan.header.stamp, scan.header.frame_id, scan.angle_min, scan.angle_increment, scan.range_max, scan.ranges, scan.intensities)


def wait_for_recorder():
    """Until the simulator sends its scans and odometry to /recorder."""
    simulator = xmlrpc.client.ServerProxy(rosgraph.Master(rospy.get_name()).lookupNode("/gazebo"))
    deadline = time.monotonic() + PATIENCE
    while time.monotonic() < deadline:
        connections = simulator.getBusInfo(rospy.get_name())[2]
        if {"/scan", "/odom"} <= {topic for _, node, _, _, topic, *_ in connections if node == "/recorder"}:
            return
        time.sleep(0.05)
    raise AssertionError("rosbag record does not listen to /scan and /odom")


class MbotBag(unittest.TestCase):
    def drive(self, scans, commands):
        """Ahead at SPEED for SECONDS, then to rest. :returns: stamps of the first and last scan of the drive"""
        odometry = Topic("/odom", Odometry)
        go = Twist()
        go.linear.x = SPEED
        seen = len(scans.messages)
        scans.wait_for(lambda m: len(scans.messages) > seen, "a scan before the drive")
        first = scans.messages[-1].header.stamp
        commands.publish(go)

        def there(message):
            return message.pose.pose.position.x > SPEED * SECONDS

        odometry.wait_for(there, "way")
        commands.publish(Twist())
        end = odometry.wait_for(lambda m: there(m) and m.twist.twist.linear.x < 1e-3, "rest")
        last = scans.wait_for(lambda m: m.header.stamp > end.header.stamp, "a scan after the drive").header.stamp
        return first, last

    def test_recorded_and_replayed(self):
        scans = Topic("/scan", LaserScan)
        scans.wait_for(lambda m: True, "scan")
        commands = rospy.Publisher("/cmd_vel", Twist, queue_size=1, latch=True)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "room.bag")
            # the recorder ends by its own count of the time: a signal of ours would cost what it has not yet read
            recorder = subprocess.Popen(
                ["rosbag", "record", "-q", "-O", file, f"--duration={RECORDED}", "/scan", "/odom", "/tf", "/tf_static", "__name:=recorder"]
            )
            try:
                wait_for_recorder()
                run_free(5)
                first, last = self.drive(scans, commands)
                self.assertEqual(recorder.wait(timeout=PATIENCE), 0)
            finally:
                recorder.send_signal(signal.SIGINT)
                recorder.wait(timeout=PATIENCE)
            with rosbag.Bag(file) as bag:
                recorded, received = zip(*((message, stamp) for _, message, stamp in bag.read_messages("/scan")))
                self.assertGreater(bag.get_message_count("/tf"), 0)
                self.assertGreater(bag.get_message_count("/odom"), len(recorded))
            self.check_recorded(recorded, scans.messages, first, last)
            self.replay(file, recorded, received)

    def check_recorded(self, recorded, sent, first, last):
        """The bag holds the scans of the drive, as they were sent and in that order. A simulator that runs faster than the
        clock on a busy machine may drop one on its way to the recorder or to us, for its queue is one message long."""
        self.assertLessEqual(recorded[0].header.stamp, first + rospy.Duration(0.5))
        self.assertGreaterEqual(recorded[-1].header.stamp, last)
        known = {scan.header.stamp: content(scan) for scan in sent}
        both = [scan for scan in recorded if scan.header.stamp in known]
        self.assertEqual([content(scan) for scan in both], [known[scan.header.stamp] for scan in both])
        self.assertGreater(len(both), 15)
        stamps = [scan.header.stamp for scan in recorded]
        self.assertEqual(stamps, sorted(set(stamps)))

    def replay(self, file, recorded, received):
        scans, odometry = Topic("/replayed/scan", LaserScan), Topic("/replayed/odom", Odometry)
        clock = Topic("/replayed/clock", Clock)
        # a clock of its own: the simulator's still runs
        subprocess.run(
            [
                "rosbag",
                "play",
                "-q",
                "--clock",
                "--rate",
                "4",
                "--queue",
                "10000",
                "--wait-for-subscribers",
                "--prefix",
                "/replayed",
                file,
                "--topics",
                "/scan",
                "/odom",
                "/clock:=/replayed/clock",
            ],
            check=True,
            timeout=PATIENCE,
        )
        last = recorded[-1].header.stamp
        scans.wait_for(lambda m: m.header.stamp == last, "the last scan")
        # rosbag play tells the times at which messages were recorded. It leaves with the last message, and where it was late, the
        # times of what it then caught up with are not told
        clock.wait_for(lambda m: m.clock >= received[-1] - rospy.Duration(1), "time of the drive's end")
        self.assertEqual([content(scan) for scan in scans.messages], [content(scan) for scan in recorded])
        times = [message.clock for message in clock.messages]
        self.assertEqual(times, sorted(times))
        # what a mapper sees: the wall stays where it is while odometry moves
        along = {message.header.stamp: message.pose.pose.position.x for message in odometry.messages}
        ways = []
        for scan in scans.messages:
            before = [stamp for stamp in along if stamp <= scan.header.stamp]
            if before and (scan.header.stamp - max(before)).to_sec() <= 0.02:  # odometry may be dropped on a busy machine
                ways.append(along[max(before)])
                ahead = scan.ranges[round(-scan.angle_min / scan.angle_increment)]
                self.assertAlmostEqual(ahead + ways[-1], WALL, delta=5 * NOISE + 0.02 * SPEED)
        self.assertGreater(ways[-1] - ways[0], SPEED * SECONDS - 0.2)


if __name__ == "__main__":
    rospy.init_node("mbot_bag_rostest")
    rostest.rosrun("mbot_gazebo", "mbot_bag", MbotBag)
