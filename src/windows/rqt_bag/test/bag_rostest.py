#!/usr/bin/env python3
"""Recording from topics and publishing onto them, with a real master."""

import os
import sys
import tempfile
import unittest

import rosgraph
import rospy
import rostest

from rqt_testing.in_process import errors, open_plugin, wait_until  # isort: skip
import rosbag
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Float64


class Bag(unittest.TestCase):
    def test_record_then_publish(self):
        with tempfile.TemporaryDirectory() as folder, open_plugin("rqt_bag", ["--clock"]) as gui:
            name, timeline, frame = os.path.join(folder, "a.bag"), gui.plugin._widget._timeline, gui.plugin._widget.frame
            timeline.record_bag(name, False, ["/speed"])
            publisher = rospy.Publisher("/speed", Float64, queue_size=100)  # later than the recorder
            wait_until(publisher.get_num_connections)
            for i in range(40):
                publisher.publish(Float64(i))
            wait_until(lambda: timeline._recorder.counts.get("/speed") == 40)
            self.assertIn("/speed", timeline.topics)
            timeline.stop_recording()
            with rosbag.Bag(name) as bag:
                self.assertEqual([message.data for _, message, _ in bag.read_messages()], [float(i) for i in range(40)])
            wait_until(lambda: len(timeline.stamps("/speed")) == 40 and frame.playhead is not None)
            publisher.unregister()
            self.publishes(timeline, frame)
        self.assertEqual(errors, [])

    def publishes(self, timeline, frame):
        # Recorder, player and this test are one node: what is still being taken back would be shared with what comes now.
        wait_until(lambda: not any(name == "/speed" for kind in rosgraph.Master("/bag_rostest").getSystemState()[:2] for name, _ in kind))
        got, clock = [], []
        subscriber = rospy.Subscriber("/speed", Float64, lambda message: got.append(message.data))
        clocks = rospy.Subscriber("/clock", Clock, lambda message: clock.append(message.clock.to_sec()))
        timeline.start_publishing("/speed")
        timeline.navigate_end()
        wait_until(lambda: subscriber.get_num_connections() and clocks.get_num_connections())
        player = timeline._player  # whose side of a connection comes a moment after the listener's
        wait_until(lambda: all(sender and sender.get_num_connections() for sender in (player._clock, *player._publishers.values())))
        timeline.navigate_start()
        wait_until(lambda: not timeline._player.busy)
        got.clear()
        frame.move_playhead(frame.end_stamp, True)
        wait_until(lambda: got[-39:] == [float(i) for i in range(1, 40)])
        wait_until(lambda: clock and abs(clock[-1] - frame.end_stamp.to_sec()) < 1e-6)


if __name__ == "__main__":
    rospy.init_node("bag_rostest")
    rostest.rosrun("rqt_bag", "bag", Bag, sys.argv)
