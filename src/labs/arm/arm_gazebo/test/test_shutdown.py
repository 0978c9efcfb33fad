"""Ctrl-C on the launch file ends every process it started."""

import os
import signal
import socket
import subprocess
import time

import psutil
import pytest


@pytest.fixture
def port():
    """One that nobody else takes: kept for the roscore, which may bind it too."""
    with socket.socket() as place:
        place.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        place.bind(("", 0))
        yield place.getsockname()[1]


@pytest.mark.slow
def test_ctrl_c_leaves_no_process(tmp_path, port):
    environment = dict(os.environ, ROS_MASTER_URI="http://localhost:%d" % port, ROS_HOME=str(tmp_path))
    log = tmp_path / "launch.log"
    with open(log, "w") as out:
        launch = subprocess.Popen(
            ["roslaunch", "-p", str(port), "arm_gazebo", "arm_gazebo.launch", "gui:=false", "rviz:=false"],
            env=environment,
            stdout=out,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )
    try:
        end = time.monotonic() + 120
        while "Started controllers" not in log.read_text():
            assert launch.poll() is None and time.monotonic() < end, log.read_text()
            time.sleep(0.1)
        started = psutil.Process(launch.pid).children(recursive=True)
        assert {"gzserver", "spawner", "rosmaster"} <= {p.name() for p in started}
        os.killpg(launch.pid, signal.SIGINT)  # what a terminal does
        assert launch.wait(60) == 0
        gone, alive = psutil.wait_procs(started, timeout=60)
        assert not alive, [p.cmdline() for p in alive]
        text = log.read_text()
        assert "Traceback" not in text and "escalating" not in text, text
    finally:
        if launch.poll() is None:  # roslaunch puts each node into a session of its own
            for process in [*psutil.Process(launch.pid).children(recursive=True), launch]:
                process.kill()
