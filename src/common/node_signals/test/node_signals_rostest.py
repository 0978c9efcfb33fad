#!/usr/bin/env python3
"""Nodes end at every signal, whatever they are doing, their shutdown hooks run and the master told."""

import signal
import subprocess
import sys
import unittest

import rosgraph
import rostest

NODE = """
import node_signals, rospy, sys
node_signals.init_node("chatter", anonymous=True)
rospy.on_shutdown(lambda: (rospy.get_param("/run_id"), print("hook", flush=True)))
print("up", flush=True)
while not rospy.is_shutdown():
    rospy.get_param("/run_id")  # holds the master proxy's lock nearly all the time
"""


WAITING = """
import node_signals, rospy, sys
from std_msgs.msg import Empty
with node_signals.silent():
    {starter}.init_node("waiting")
    topic = rospy.Publisher("/of_waiting", Empty, queue_size=1)
    rospy.on_shutdown(lambda: print("hook", flush=True))
    print("up", flush=True)
    {waits}
    print("end", flush=True)
    node_signals.leave(7)
"""


class NodeSignals(unittest.TestCase):
    def end(self, waits, number, starter="node_signals"):
        """(what it printed after the signal, exit code) of a node that waits in a way of its own."""
        node = subprocess.Popen([sys.executable, "-c", WAITING.format(waits=waits, starter=starter)], text=True, stdout=subprocess.PIPE)
        self.assertEqual(node.stdout.readline(), "up\n")
        self.assertIn("/waiting", self.publishers())
        node.send_signal(number)
        try:
            output, _ = node.communicate(timeout=60)
        finally:
            node.kill()
        self.assertNotIn("/waiting", self.publishers())
        return output, node.returncode

    def test_a_service_is_waited_for(self):
        code = """
import node_signals, rospy, threading
from node_signals.services import wait_for_service
from std_srvs.srv import Empty
node_signals.init_node("asks", anonymous=True)
try:
    wait_for_service("late_service", timeout=0.2)
except rospy.ROSException as error:
    print(error, flush=True)
threading.Timer(0.3, lambda: rospy.Service("late_service", Empty, lambda request: [])).start()
wait_for_service("late_service")
rospy.ServiceProxy("late_service", Empty)()
print("called", flush=True)
threading.Timer(0.2, lambda: rospy.signal_shutdown("")).start()
try:
    wait_for_service("never")
except rospy.ROSInterruptException:
    print("interrupted", flush=True)
"""
        run = subprocess.run([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True, timeout=60)
        self.assertEqual(run.stdout.splitlines(), ["timeout exceeded while waiting for service /late_service", "called", "interrupted"])

    def test_a_thread_that_publishes_until_the_end_says_nothing(self):
        """As the status timer of actionlib's servers, which looks at nothing before it publishes."""
        for late, said in (("topic.publish()", False), ("raise ValueError('a fault')", True)):
            code = f"""
import node_signals, rospy, threading
from std_msgs.msg import Empty
with node_signals.silent():
    node_signals.init_node("late", anonymous=True)
    topic = rospy.Publisher("/late", Empty, queue_size=1)
    over = threading.Event()
    def publish():
        over.wait()
        {late}
    thread = threading.Thread(target=publish, daemon=True)
    thread.start()
    rospy.on_shutdown(lambda: (topic.unregister(), over.set(), thread.join(20)))
    print("up", flush=True)
    node_signals.spin()
"""
            node = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            self.assertEqual(node.stdout.readline(), "up\n")
            node.send_signal(signal.SIGINT)
            _, errors = node.communicate(timeout=60)
            self.assertEqual("Traceback" in errors, said, errors)

    @staticmethod
    def publishers():
        return [node for topic, nodes in rosgraph.Master("/test").getSystemState()[0] for node in nodes if topic == "/of_waiting"]

    def test_one_that_spins_ends_with_its_own_code(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.assertEqual(self.end("node_signals.spin()", number), ("hook\nend\n", 7))

    def test_one_that_rospy_has_started_spins_and_leaves_too(self):
        self.assertEqual(self.end("node_signals.spin()", signal.SIGINT, "rospy"), ("hook\nend\n", 7))

    def test_one_whose_main_thread_hangs_is_left_behind(self):
        """As in a service call to a simulator that has stopped answering."""
        for number in (signal.SIGINT, signal.SIGTERM):
            self.assertEqual(self.end("import threading; threading.Event().wait()", number), ("hook\n", 128 + number))

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
