"""Types of services, asked from their servers."""

from __future__ import annotations

import io
import socket
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor

import rosgraph
import rospy

TIMEOUT = 0.25  # s that a server has to answer, as foxglove_bridge's
AT_ONCE = 16  # servers that are asked at the same time


def type_of(name: str, timeout: float) -> str | None:
    """The type of the service ``name``, asked from its server; None where that does not answer within ``timeout`` s.

    rosservice waits 5 s, too long for a server that hangs.
    """
    try:
        host, port = rospy.core.parse_rosrpc_uri(rosgraph.Master(rospy.get_name()).lookupService(name))
        with socket.create_connection((host, port), timeout) as connection:
            header = {"probe": "1", "md5sum": "*", "callerid": rospy.get_name(), "service": name}
            rosgraph.network.write_ros_handshake_header(connection, header)
            return rosgraph.network.read_ros_handshake_header(connection, io.BytesIO(), 2048).get("type")
    except Exception:  # a server that is going, hangs, is of another language, behind a wall
        return None


def types_of(names: Iterable[str], timeout: float = TIMEOUT) -> dict[str, str]:
    """The types of those services of ``names`` whose servers answer, asked at the same time.

    :param timeout: s, for all of them
    """
    asked = sorted(names)
    if not asked:
        return {}
    with ThreadPoolExecutor(AT_ONCE) as pool:
        found = pool.map(lambda name: type_of(name, timeout), asked)
        return {name: kind for name, kind in zip(asked, found) if kind}
