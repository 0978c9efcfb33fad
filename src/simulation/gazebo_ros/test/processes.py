"""Whole server processes for the rostests."""

import os
import signal
import subprocess
import xmlrpc.client

import rosgraph
from simulator import Simulator

BENCH = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worlds", "bench.world")


class Server:
    """A gzserver in a namespace of its own, ended at the end of the block.

    :param master: URI; that of the test unless given
    :param limits: options of the shell's ulimit, as "-v 250000"
    :param environment: variables that differ from the test's
    """

    def __init__(self, name, *arguments, master=None, limits="", environment=()):
        self.name = name
        self.environment = {**os.environ, "ROS_MASTER_URI": master or rosgraph.get_master_uri(), **dict(environment)}
        command = ["rosrun", "gazebo_ros", "gzserver", *arguments, f"__ns:=/{name}"]
        if limits:
            command = ["bash", "-c", f'ulimit {limits}; exec "$0" "$@"', *command]
        self.process = subprocess.Popen(
            command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True, env=self.environment
        )

    def __enter__(self):
        return self

    def simulator(self):
        return Simulator(f"/{self.name}/gazebo")

    def node_pid(self):
        uri = rosgraph.Master("/test").lookupNode(f"/{self.name}/gazebo")
        return xmlrpc.client.ServerProxy(uri).getPid("/test")[2]

    def end(self, number=signal.SIGINT):
        """(exit code, all it printed)."""
        if self.process.poll() is None:
            os.killpg(self.process.pid, number)
        text, _ = self.process.communicate(timeout=60)
        return self.process.returncode, text

    def __exit__(self, *_):
        if self.process.poll() is None:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.communicate()
