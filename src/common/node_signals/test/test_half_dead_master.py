"""Commands that ask a master which answers no more: Ctrl-C ends them."""

import os
import signal
import subprocess
import threading
import time
from pathlib import Path
from socketserver import ThreadingMixIn
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

import pytest

SRC = Path(__file__).resolve().parents[3]
COMMANDS = {
    "gz": [SRC / "simulation/gazebo_ros/scripts/gz", "model"],
    "controller_manager": [SRC / "control/controller_manager/scripts/controller_manager", "list"],
}


class HalfDeadMaster(ThreadingMixIn, SimpleXMLRPCServer):
    """Says that it lives; whatever else it is asked it never answers."""

    daemon_threads = True

    def __init__(self):
        super().__init__(("localhost", 0), SimpleXMLRPCRequestHandler, logRequests=False)
        self.asked = threading.Event()
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def _dispatch(self, method, params):
        if method != "getPid":
            self.asked.set()
            time.sleep(120.0)
        return 1, "", 1

    @property
    def uri(self):
        return f"http://localhost:{self.server_address[1]}"


@pytest.fixture
def half_dead_master():
    master = HalfDeadMaster()
    yield master
    master.shutdown()
    master.server_close()


@pytest.mark.slow
@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_ctrl_c_ends_it_while_it_waits_for_the_master(half_dead_master, tmp_path, name):
    command = subprocess.Popen(
        COMMANDS[name],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**os.environ, "ROS_MASTER_URI": half_dead_master.uri, "ROS_HOME": str(tmp_path)},
    )
    try:
        assert half_dead_master.asked.wait(60.0)
        command.send_signal(signal.SIGINT)
        output, _ = command.communicate(timeout=20.0)
    finally:
        command.kill()
    assert "Traceback" not in output and command.returncode != 0
