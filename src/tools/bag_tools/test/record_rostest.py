#!/usr/bin/env python3
"""rosbag record --mcap, as typed."""

import glob
import os
import signal
import subprocess
import tempfile
import unittest

import rospy
import rostest
from mcap.reader import make_reader
from std_msgs.msg import String
from test_support.hearing import deliver


class Record(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.publisher = rospy.Publisher("/said", String, queue_size=10, latch=True)

    def wait(self, condition, otherwise):
        end = rospy.get_time() + 30
        while not condition() and rospy.get_time() < end:
            rospy.sleep(0.05)
        self.assertTrue(condition(), otherwise)

    def record(self, *options):
        """Until Ctrl-C, which comes when the recorder has been told five times. :returns: what it printed"""
        self.wait(lambda: not self.publisher.get_num_connections(), "the recorder of the test before is still there")
        process = subprocess.Popen(
            ["rosbag", "record", "--mcap", *options, "/said"],
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        self.addCleanup(process.kill)
        self.wait(self.publisher.get_num_connections, "the recorder did not come")
        for number in range(5):
            deliver(self.publisher, f"word {number}")
        deliver(self.publisher, "end")  # those before it are written when it comes
        os.killpg(process.pid, signal.SIGINT)
        output, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 0, output)
        return output

    def words(self, file):
        with open(file, "rb") as stream:
            reader = make_reader(stream)
            self.assertEqual(reader.get_header().profile, "ros1")
            return [
                (channel.topic, channel.metadata["latching"], channel.metadata["callerid"], String().deserialize(message.data).data)
                for _, channel, message in reader.iter_messages()
            ]

    def test_named(self):
        output = self.record("-O", "talk")
        self.assertEqual(sorted(os.listdir(self.folder)), ["talk.mcap"])
        words = self.words(os.path.join(self.folder, "talk.mcap"))
        said = [("/said", "true", rospy.get_name(), f"word {number}") for number in range(5)]
        start = words.index(said[0])
        self.assertEqual(words[start : start + 5], said)
        self.assertIn(f"talk.mcap: {len(words)} messages", output)

    def test_by_prefix_beside_older_bags(self):
        older = os.path.join(self.folder, "old.bag")
        with open(older, "w") as file:
            file.write("of somebody else")
        self.record("-o", "drive", "--lz4")
        (made,) = glob.glob(os.path.join(self.folder, "drive_*.mcap"))
        self.assertEqual(len(self.words(made)[-5:]), 5)
        self.assertEqual(sorted(os.listdir(self.folder)), [os.path.basename(made), "old.bag"])

    def test_without_the_option_it_is_rosbag(self):
        done = subprocess.run(["rosbag", "record"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertIn("You must specify a topic name or else use the '-a' option", done.stderr)
        self.assertIn("--mcap", subprocess.run(["rosbag", "record", "--mcap", "--help"], capture_output=True, text=True, timeout=60).stdout)


if __name__ == "__main__":
    rospy.init_node("record_rostest")
    rostest.rosrun("bag_tools", "record", Record)
