"""Ports."""

import socket


def free_port(kind: int = socket.SOCK_STREAM) -> int:
    """A port of this machine that nobody listens at now. :param kind: ``socket.SOCK_STREAM`` (TCP) or ``SOCK_DGRAM`` (UDP)"""
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]
