#!/usr/bin/env python3
"""A joystick made of a pipe is plugged in, moved, pulled out and plugged in again."""

import os
import queue
import tempfile
import unittest

import pexpect
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from joystick.state import AXIS, BUTTON, EVENT, INIT
from sensor_msgs.msg import Joy, JoyFeedback, JoyFeedbackArray


class Joystick(unittest.TestCase):
    def node(self, *arguments, there=False):
        """The node with a pipe in the place of a device, which may be there at once, its path, and what it publishes."""
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        device = os.path.join(folder.name, "js0")
        if there:
            os.mkfifo(device)
        seen = queue.Queue()
        listener = rospy.Subscriber("joy", Joy, seen.put)
        self.addCleanup(listener.unregister)
        node = pexpect.spawn("rosrun", ["joy", "joy_node", f"_dev:={device}", *arguments], encoding="utf-8", timeout=60)
        self.addCleanup(node.close, force=True)
        return node, device, seen

    def test_numbers_out_of_bounds_are_told_and_bounded(self):
        """As joy_node 1.15.1: a deadzone from 1 on is one of 32767, the largest is 0.9, what is negative is 0."""
        negative = ["deadzone", "autorepeat_rate", "coalesce_interval"]
        cases = (
            (["_deadzone:=2000"], ["parameter ~deadzone is 2000"], 2000 / 32767),
            (["_deadzone:=1"], ["parameter ~deadzone is 1"], 1 / 32767),
            (["_deadzone:=0.95"], ["~deadzone is 0.95, more than 0.9"], 0.9),
            ([f"_{name}:=-1" for name in negative], [f"~{name} is -1, less than 0" for name in negative], 0.0),
        )
        nodes = [self.node(f"__name:=bounded_{i}", *arguments, there=True) for i, (arguments, _, _) in enumerate(cases)]  # at the same time
        for (node, _, _), (_, lines, deadzone) in zip(nodes, cases):
            for line in lines:
                node.expect_exact(line)
            node.expect(r"deadzone_: ([\d.]+)\.\s")
            self.assertAlmostEqual(float(node.match[1]), deadzone, places=6)
            node.sendintr()
        for node, _, _ in nodes:
            node.expect(pexpect.EOF)

    def test_what_a_message_and_the_diagnostics_say(self):
        statuses = queue.Queue()
        listener = rospy.Subscriber("/diagnostics", DiagnosticArray, lambda array: [statuses.put(status) for status in array.status])
        self.addCleanup(listener.unregister)
        node, device, seen = self.node("_default_trig_val:=true", "__name:=pad")

        def status(message):
            while True:
                found = statuses.get(timeout=60)
                if (found.name, found.message) == ("pad: Joystick Driver Status", message):
                    return found.level, {entry.key: entry.value for entry in found.values}

        self.assertEqual(status("Joystick not open.")[0], 2)
        os.mkfifo(device)
        node.expect_exact(f"Opened joystick: {device}.")
        level, values = status("OK")
        self.assertEqual((level, values["device"], values["dead zone"], values["topic"]), (0, device, "0.05", "/joy"))
        pipe = os.open(device, os.O_WRONLY)
        os.write(pipe, EVENT.pack(0, -32767, AXIS | INIT, 2))
        message = seen.get(timeout=60)
        self.assertEqual((message.axes, message.header.frame_id), ((0.0, 0.0, 1.0), device))
        feedback = rospy.Publisher("joy/set_feedback", JoyFeedbackArray, queue_size=1, latch=True)
        feedback.publish([JoyFeedback(type=1, id=0, intensity=1.0)])  # a pipe has no motors, and lives on
        os.write(pipe, EVENT.pack(0, 1, BUTTON, 0))
        while not seen.get(timeout=60).buttons:
            pass
        os.close(pipe)
        node.sendintr()
        node.expect(pexpect.EOF)

    def test_plugged_in_late_and_again(self):
        node, device, seen = self.node("_deadzone:=0")
        node.expect_exact(f"Couldn't open joystick {device}. Will retry every second. (No such file or directory)")
        os.mkfifo(device)
        node.expect_exact(f"Opened joystick: {device}.")
        for _ in range(2):
            pipe = os.open(device, os.O_WRONLY)
            while not seen.empty():
                seen.get()
            for value, kind, number in ((0, AXIS | INIT, 1), (0, BUTTON | INIT, 3), (-32767, AXIS, 0), (1, BUTTON, 3)):
                os.write(pipe, EVENT.pack(0, value, kind, number))
            message = seen.get(timeout=60)
            while message.buttons != (0, 0, 0, 1):
                message = seen.get(timeout=60)
            self.assertEqual(message.axes, (1.0, 0.0))
            os.close(pipe)
            node.expect_exact("is gone; waiting for it to come back.")
            node.expect_exact(f"Opened joystick: {device}.")
        node.sendintr()
        node.expect(pexpect.EOF)


if __name__ == "__main__":
    rospy.init_node("joy_rostest")
    rostest.rosrun("joy", "joy_rostest", Joystick)
