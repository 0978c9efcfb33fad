"""Who is asked for connections, and what comes of answers that are none."""

import contextlib
import socket
import threading
import time
import types

import pytest
from lab_check.examination import connections

OK = b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\n"


def in_drops(near):
    near.sendall(OK + b"Content-Length: 10000\r\n\r\n")
    while True:
        near.sendall(b" ")
        time.sleep(0.05)


def never(near):
    near.recv(1)


def no_xml(near):
    near.sendall(OK + b"\r\n" + b"\xff" * 100)


def another(near):
    near.sendall(OK + b"\r\n<methodResponse><params><param><value><int>1</int></value></param></params></methodResponse>")


@pytest.mark.parametrize("answer", [in_drops, never, no_xml, another], ids=lambda f: f.__name__)
def test_a_node_that_answers_nonsense_is_asked_once_and_for_two_seconds(answer):
    asked = []

    def serve(door):
        with contextlib.suppress(OSError):
            while True:
                near, _ = door.accept()
                asked.append(near)
                with near, contextlib.suppress(OSError):
                    near.recv(10000)
                    answer(near)

    with socket.create_server(("localhost", 0)) as door:
        threading.Thread(target=serve, args=(door,), daemon=True).start()
        master = types.SimpleNamespace(
            getSystemState=lambda: ([["/clock", ["/gazebo"]]], [["/clock", ["/odd"]]], []),
            lookupNode=lambda name: f"http://localhost:{door.getsockname()[1]}",
        )
        begin, deaf = time.monotonic(), set()
        assert connections.complete(master, deaf) and deaf == {"/odd"}
        assert time.monotonic() - begin < 5.0 and asked
        before = len(asked)
        assert connections.complete(master, deaf) and len(asked) == before
