"""Subscribers hear of a new publisher when the examiner lets them, and not before."""

import os
import socket
import subprocess
import sys
import threading
import time
import xmlrpc.client
from xmlrpc.server import SimpleXMLRPCServer

import pytest
import rosgraph
from lab_check.examination import connections
from test_support import never


@pytest.fixture
def master(monkeypatch, tmp_path):
    with socket.socket() as s:
        s.bind(("localhost", 0))
        port = s.getsockname()[1]
    monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{port}")
    process = subprocess.Popen(
        [sys.executable, "-m", "lab_check.examination.guarded_master", str(port), "1000000000"],
        env={**os.environ, "ROS_LOG_DIR": str(tmp_path)},
    )
    end = time.monotonic() + 60
    while not rosgraph.is_master_online():
        assert process.poll() is None and time.monotonic() < end
        time.sleep(0.02)
    yield rosgraph.Master("/lab_check")
    process.kill()
    process.wait()


@pytest.fixture
def subscriber():
    """A node's own interface; what it is told is kept."""
    told = []
    server = SimpleXMLRPCServer(("localhost", 0), logRequests=False)
    server.register_function(lambda caller, topic, publishers: (told.append((topic, publishers)), (1, "", 0))[1], "publisherUpdate")
    threading.Thread(target=server.serve_forever, daemon=True).start()
    yield f"http://localhost:{server.server_address[1]}/", told
    server.shutdown()


def test_news_of_publishers_wait_for_the_examiner(master, subscriber):
    uri, told = subscriber
    proxy = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
    assert proxy.registerSubscriber("/listener", "/chatter", "std_msgs/String", uri)[2] == []
    assert connections.release(master) == 0
    assert proxy.registerPublisher("/a", "/chatter", "std_msgs/String", "http://localhost:1/")[0] == 1
    assert proxy.registerPublisher("/b", "/chatter", "std_msgs/String", "http://localhost:2/")[0] == 1
    assert proxy.registerPublisher("/a", "/elsewhere", "std_msgs/String", "http://localhost:1/")[0] == 1
    never(lambda: told, "news", 0.2)
    assert connections.release(master) == 2
    end = time.monotonic() + 10
    while len(told) < 2 and time.monotonic() < end:
        time.sleep(0.01)
    assert told == [("/chatter", ["http://localhost:1/"]), ("/chatter", ["http://localhost:1/", "http://localhost:2/"])]
    assert connections.release(master) == 0


def test_who_subscribes_later_is_answered_at_once(master, subscriber):
    proxy = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
    proxy.registerPublisher("/a", "/chatter", "std_msgs/String", "http://localhost:1/")
    assert proxy.registerSubscriber("/listener", "/chatter", "std_msgs/String", subscriber[0])[2] == ["http://localhost:1/"]
