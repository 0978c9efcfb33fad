#!/usr/bin/env python3
"""A node that talks to the master all the time ends at every signal, its shutdown hook run."""
import signal
import subprocess
import sys
import unittest

import rostest

NODE = """
import node_signals, rospy, sys
node_signals.init_node("chatter", anonymous=True)
rospy.on_shutdown(lambda: (rospy.get_param("/run_id"), print("hook", flush=True)))
print("up", flush=True)
while not rospy.is_shutdown():
    rospy.get_param("/run_id")  # holds the master proxy's lock nearly all the time
"""


class NodeSignals(unittest.TestCase):
    def test_a_busy_node_ends_at_every_signal(self):
        for number in (signal.SIGINT, signal.SIGTERM) * 3:
            node = subprocess.Popen([sys.executable, "-c", NODE], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            self.assertEqual(node.stdout.readline(), "up\n")
            node.send_signal(number)
            try:
                output, _ = node.communicate(timeout=60)
            finally:
                node.kill()
            self.assertEqual(output, "hook\n")


if __name__ == "__main__":
    rostest.rosrun("node_signals", "node_signals", NodeSignals, sys.argv)
