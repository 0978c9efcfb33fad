"""The nodes of ROS 2 that tests use, in a domain that no other test on this machine has; importing this chooses it."""

import json
import os
import subprocess
import threading
import time
from urllib.parse import urlparse

from ros1_bridge.link import environment, prefix

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
