"""How long servers that hang are waited for."""

import socket
import time

import pytest
from rosbridge_library.internal import service_types


@pytest.fixture
def hung(monkeypatch):
    """Every service has the socket of a node that is stopped: it takes connections, and nothing answers."""
    with socket.create_server(("127.0.0.1", 0), backlog=50) as listening:
        uri = f"rosrpc://127.0.0.1:{listening.getsockname()[1]}"
        monkeypatch.setattr(service_types.rosgraph.Master, "lookupService", lambda self, name: uri)
        yield


def test_servers_that_hang_are_asked_at_the_same_time(hung):
    begin = time.monotonic()
    assert service_types.types_of([f"/hung/{number}" for number in range(16)]) == {}
    assert time.monotonic() - begin < 1.5  # one after the other: 4 s


def test_one_that_nobody_knows_has_no_type(monkeypatch):
    def unknown(self, name):
        raise service_types.rosgraph.MasterError("unknown service")

    monkeypatch.setattr(service_types.rosgraph.Master, "lookupService", unknown)
    assert service_types.type_of("/none", 0.2) is None
    assert service_types.types_of([]) == {}
