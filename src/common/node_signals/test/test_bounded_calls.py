"""Calls to a master or a node that answers late, never, or that this process has no means to ask."""

import contextlib
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


DROPS = {
    "answer": (b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\nContent-Length: 10000\r\n\r\n", b" "),
    "answer without a length": (b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\n\r\n", b" "),
    "chunks": (b"HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\n\r\n", b"1\r\n \r\n"),
    "status": (b"HTTP/1.0 200 O", b"K"),
    "header": (b"HTTP/1.0 200 OK\r\nX: ", b"x"),
    "continue": (b"", b"HTTP/1.1 100 Continue\r\n\r\n"),
}


@pytest.fixture
def serve():
    """``serve(answer)`` -> URI; ``answer(connection)`` is called in a thread for each request, until the connection or the test ends."""
    doors = []

    def start(answer):
        door = socket.create_server(("localhost", 0))
        doors.append(door)

        def run():
            with contextlib.suppress(OSError):
                while True:
                    connection, _ = door.accept()
                    threading.Thread(target=talk, args=(connection,), daemon=True).start()

        def talk(connection):
            with connection, contextlib.suppress(OSError):
                while connection.recv(1 << 16):
                    answer(connection)

        threading.Thread(target=run, daemon=True).start()
        return f"http://localhost:{door.getsockname()[1]}"

    yield start
    for door in doors:
        door.close()


@pytest.mark.parametrize("what", DROPS)
def test_an_answer_in_drops_is_given_up_after_its_time(serve, what):
    begins, drop = DROPS[what]

    def answer(connection):
        connection.sendall(begins)
        while True:
            connection.sendall(drop)
            time.sleep(0.02)

    uri, begin = serve(answer), time.monotonic()
    with pytest.raises(TimeoutError):
        xmlrpc.client.ServerProxy(uri, transport=Transport(0.3)).getPid("/test")
    assert 0.3 <= time.monotonic() - begin < 5.0


OK = b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\n\r\n"
NO_XMLRPC = {
    "no HTTP": b"SSH-2.0-OpenSSH\r\n",
    "no XML": OK + b"\xff" * 100,
    "another XML": OK + b"<html/>",
    "half of it": OK + b"<methodResponse><params>",
    "no number": OK + b"<methodResponse><params><param><value><int>one</int></value></param></params></methodResponse>",
    "no length": b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\nContent-Length: many\r\n\r\n" + b"\xff",
    "deep": OK + b"<methodResponse><params><param>" + b"<value><array><data>" * 100_000,
    "out of order": OK + b"<methodResponse><params><param></array></param></params></methodResponse>",
}


@pytest.mark.parametrize("what", NO_XMLRPC)
def test_what_is_no_xmlrpc_is_one_kind_of_error(serve, what):
    def answer(connection):
        connection.sendall(NO_XMLRPC[what])
        connection.shutdown(socket.SHUT_RDWR)

    with pytest.raises((OSError, xmlrpc.client.Error)):
        xmlrpc.client.ServerProxy(serve(answer), transport=Transport(10.0)).getPid("/test")


def test_who_hangs_up_does_not_get_the_time_twice(serve):
    """A call is made anew where the first connection ends without an answer."""

    def answer(connection):
        time.sleep(0.7)
        connection.shutdown(socket.SHUT_RDWR)

    uri, begin = serve(answer), time.monotonic()
    with pytest.raises(TimeoutError):
        xmlrpc.client.ServerProxy(uri, transport=Transport(1.0)).getPid("/test")
    assert time.monotonic() - begin < 1.3


def test_an_answer_without_end_is_given_up(serve):
    def answer(connection):
        connection.sendall(DROPS["answer without a length"][0])
        while True:
            connection.sendall(b" " * (1 << 20))

    with pytest.raises(OSError, match="64 MiB"):
        xmlrpc.client.ServerProxy(serve(answer), transport=Transport(60.0)).getPid("/test")


def test_each_call_of_a_connection_has_its_time(serve):
    """The connection is kept; the three together take longer than one may."""
    asked = []

    def answer(connection):
        asked.append(connection)
        time.sleep(0.4)
        body = xmlrpc.client.dumps((len(asked),), methodresponse=True).encode()
        connection.sendall(b"HTTP/1.1 200 OK\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n\r\n%s" % (len(body), body))

    proxy = xmlrpc.client.ServerProxy(serve(answer), transport=Transport(1.0))
    assert [proxy.getPid("/test") for _ in range(3)] == [1, 2, 3] and len(set(asked)) == 1


def test_a_master_that_is_away(monkeypatch):
    with socket.create_server(("localhost", 0)) as server:
        monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{server.getsockname()[1]}")
    assert not master_answers("/test")


def test_one_that_speaks_no_xmlrpc(monkeypatch):
    with socket.create_server(("localhost", 0)) as server:
        monkeypatch.setenv("ROS_MASTER_URI", f"http://localhost:{server.getsockname()[1]}")

        def answer():
            with contextlib.suppress(OSError):  # closed before it is asked again
                for _ in range(2):  # xmlrpc.client asks a second time where the connection was reset
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
