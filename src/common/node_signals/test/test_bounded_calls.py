"""Calls to a master or a node that answers late, never, or that this process has no means to ask."""

import errno
import socket
import subprocess
import sys
import threading
import time
import xmlrpc.client

import pytest
import rosgraph
from node_signals.bounded_calls import Transport, master_answers


@pytest.fixture
def deaf(monkeypatch):
    """URI of somebody who accepts and never answers."""
    with socket.create_server(("localhost", 0)) as server:
        uri = f"http://localhost:{server.getsockname()[1]}"
        monkeypatch.setenv("ROS_MASTER_URI", uri)
        yield uri


def test_a_call_is_given_up_after_its_time(deaf):
    begin = time.monotonic()
    with pytest.raises(TimeoutError):
        xmlrpc.client.ServerProxy(deaf, transport=Transport(0.2)).getPid("/test")
    assert 0.2 <= time.monotonic() - begin < 5.0


def test_a_master_that_is_away(monkeypatch):
    with socket.create_server(("localhost", 0)) as server:
        monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{server.getsockname()[1]}")
    assert not master_answers("/test")


def test_one_that_speaks_no_xmlrpc(monkeypatch):
    with socket.create_server(("localhost", 0)) as server:
        monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{server.getsockname()[1]}")

        def answer():
            for _ in range(2):  # http.client asks a second time
                connection, _ = server.accept()
                connection.sendall(b"SSH-2.0-OpenSSH\r\n")
                connection.close()

        threading.Thread(target=answer, daemon=True).start()
        assert not master_answers("/test")


@pytest.mark.parametrize(
    "error",
    [
        MemoryError(),
        OSError(errno.ENOMEM, "no memory"),
        OSError(errno.EMFILE, "too many open files"),
        socket.gaierror(socket.EAI_MEMORY, "no memory"),
        SystemError("error return without exception set"),  # what CPython says where there is no memory for a MemoryError
        SystemError("<built-in function exec> returned NULL without setting an exception"),
    ],
    ids=repr,
)
def test_want_of_memory_or_files_is_no_missing_master(monkeypatch, error):
    def refuse(self):
        raise error

    monkeypatch.setattr(rosgraph.Master, "getPid", refuse)
    with pytest.raises(type(error)):
        master_answers("/test")


@pytest.mark.parametrize("error", ["MemoryError()", "SystemError('error return without exception set')"])
def test_a_bare_thread_without_memory_ends_the_process_with_one_line(error):
    """rosgraph starts a node's XML-RPC server by ``_thread``, and rospy waits for it for ever."""
    words = f"import node_signals, _thread, time\nwith node_signals.silent():\n  def run(): raise {error}\n"
    ended = subprocess.run(
        [sys.executable, "-c", words + "  _thread.start_new_thread(run, ())\n  time.sleep(20)"], capture_output=True, text=True, timeout=60
    )
    assert ended.returncode == 1 and ended.stderr.count("\n") == 1 and "ulimit" in ended.stderr, ended.stderr
