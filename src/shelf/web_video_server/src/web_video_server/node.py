"""The node web_video_server."""

from __future__ import annotations

import sys
import threading

import node_signals
import rosgraph.network
import rospy
from node_signals.parameters import ParameterError, get, number

from web_video_server.request import AS_SENT, ENCODED
from web_video_server.server import Server


def main() -> int:
    node_signals.init_node("web_video_server")
    try:
        # As the rest of ROS: all interfaces, but where ROS_IP or ROS_HOSTNAME says that this machine is alone.
        everywhere = rosgraph.network.get_bind_address() or "0.0.0.0"
        address, port = get("~address", everywhere, str), int(number("~port", 8080, least=0))
        kind = get("~default_stream_type", "mjpeg", str)
        if kind not in (*ENCODED, AS_SENT):
            rospy.logwarn("parameter %s is %s, which is not supplied here: mjpeg is used", rospy.resolve_name("~default_stream_type"), kind)
            kind = "mjpeg"
        server = Server(address, port, kind, get("~verbose", True, bool), number("~publish_rate", -1.0))
    except ParameterError as error:
        print(f"web_video_server: {error}", file=sys.stderr)
        return 1
    except (OSError, OverflowError) as error:
        print(
            f"web_video_server: port {port} of {address} cannot be had: {getattr(error, 'strerror', None) or error}; "
            "give another one with _port:=8081",
            file=sys.stderr,
        )
        return 1
    rospy.loginfo("Waiting For connections on %s:%d", address, server.server_address[1])
    threading.Thread(target=server.serve_forever, daemon=True).start()
    node_signals.spin()
    server.shutdown()
    return 0
