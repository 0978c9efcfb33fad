"""The nodes of ROS 2 that tests use, in a domain that no other test on this machine has; importing this chooses it."""

import json
import os
import struct
import subprocess
import threading
import time
from urllib.parse import urlparse

import rospy
from ros1_bridge.link import environment, prefix
from sensor_msgs.msg import JointState

PATIENCE = 30.0  # s of wall time

# Each test has a master of its own, and so a port. Domains from 102 on take ports that the system gives to others.
os.environ["ROS_DOMAIN_ID"] = str((urlparse(os.environ["ROS_MASTER_URI"]).port or 0) % 101 + 1)
os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"


def wait(condition, what):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    raise AssertionError(f"{what} did not come")


class Other:
    """The node of ROS 2."""

    def __init__(self):
        here = os.path.join(os.path.dirname(os.path.realpath(__file__)), "node_of_ros2.py")
        folder = prefix()
        self.process = subprocess.Popen(
            [folder / "bin" / "python", here], env=environment(folder), stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        self.told = []
        threading.Thread(target=self._read, daemon=True).start()
        wait(lambda: self.told, "ROS 2's node")

    def _read(self):
        for line in self.process.stdout:
            self.told.append(json.loads(line))

    def do(self, what, **words):
        self.process.stdin.write(json.dumps({"do": what, **words}) + "\n")
        self.process.stdin.flush()

    def heard(self, topic):
        return [bytes.fromhex(one["data"]) for one in self.told if one.get("heard") == topic]

    def answer(self, **key):
        ((name, value),) = key.items()
        return wait(lambda: [one for one in self.told if one.get(name) == value], f"{name} {value}")[-1]

    def progress(self, name):
        return [one for one in self.told if one.get("progress") == name]

    def count(self, **key):
        """How often it was told."""
        return sum(key.items() <= one.items() for one in self.told)


class SameStates:
    """Joint states on ``topic`` as both sides see them."""

    def __init__(self, other, topic):
        self._other, self._topic, self._ours = other, topic, {}
        rospy.Subscriber(topic, JointState, self._keep)
        other.do("hear", topic=topic, kind="JointState", profile="sensor")

    def _keep(self, message):
        stamp = struct.pack("<2I", message.header.stamp.secs, message.header.stamp.nsecs)
        self._ours[stamp] = message.name, struct.pack(f"<{len(message.position)}d", *message.position)

    def newest(self):
        """Positions by joint in ROS 2's newest message that ROS 1 has seen too; {} where there is none."""
        for data in reversed(self._other.heard(self._topic)):
            names, bits = self._ours.get(data[4:12], ([], b""))
            at = data.find(bits)
            if names and at > 0:
                return dict(zip(names, struct.unpack_from(f"<{len(names)}d", data, at)))
        return {}

    def compare(self, case):
        """Positions are the same bits in all messages of one stamp. :return: how many were compared"""
        both = [(self._ours[data[4:12]][1], data) for data in self._other.heard(self._topic) if data[4:12] in self._ours]
        for bits, data in both:
            case.assertIn(bits, data)
        return len(both)
