"""The node twist_marker_server: a marker on the robot; ``~cmd_vel`` while it is dragged."""

import math
import sys

import node_signals
import rospy
from geometry_msgs.msg import Pose, Quaternion, Twist
from interactive_markers.interactive_marker_server import InteractiveMarkerServer
from node_signals.parameters import number
from visualization_msgs.msg import InteractiveMarker, InteractiveMarkerControl

from .drive import Drive

_HALF = math.sqrt(0.5)
_ALONG = {"x": Quaternion(_HALF, 0, 0, _HALF), "y": Quaternion(0, 0, _HALF, _HALF), "z": Quaternion(0, _HALF, 0, _HALF)}


def marker(drive: Drive, robot: str, link: str, size: float) -> InteractiveMarker:
    """The marker of ``robot``, ``size`` m large, in the frame ``link``, with a handle for each axis that ``drive`` drives, and one to
    turn.
    """
    made = InteractiveMarker(name=robot + "_twist_marker", description="twist controller for " + robot, scale=size)
    made.header.frame_id = link
    made.pose.orientation.w = 1.0
    for axis in drive.axes:
        made.controls.append(
            InteractiveMarkerControl(
                name="move_" + axis,
                orientation=_ALONG[axis],
                orientation_mode=InteractiveMarkerControl.FIXED,
                interaction_mode=InteractiveMarkerControl.MOVE_AXIS,
            )
        )
    made.controls.append(
        InteractiveMarkerControl(
            name="rotate_z",
            orientation=_ALONG["z"],
            orientation_mode=InteractiveMarkerControl.FIXED,
            interaction_mode=InteractiveMarkerControl.ROTATE_AXIS,
        )
    )
    return made


def main() -> int:
    node_signals.init_node("twist_marker_server")
    try:
        drive = Drive(rospy.get_param("~", {}))
        size = number("~marker_size_scale", 1.0)
    except (TypeError, ValueError) as error:
        print(f"twist_marker_server: parameters of {rospy.get_name()}: {error}", file=sys.stderr)
        return 1
    shown = marker(drive, rospy.get_param("~robot_name", "robot"), rospy.get_param("~link_name", "base_link"), size)
    publisher = rospy.Publisher("~cmd_vel", Twist, queue_size=1)
    server = InteractiveMarkerServer("twist_marker_server")

    def dragged(feedback) -> None:
        twist, turn = Twist(), feedback.pose.orientation
        for axis in drive.axes:
            setattr(twist.linear, axis, drive.linear(axis, getattr(feedback.pose.position, axis)))
        twist.angular.z = drive.angular(math.atan2(2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y**2 + turn.z**2)))
        publisher.publish(twist)
        server.setPose(shown.name, Pose(orientation=Quaternion(w=1.0)))  # it snaps back onto the robot
        server.applyChanges()

    server.insert(shown, dragged)
    server.applyChanges()
    rospy.loginfo("[interactive_marker_twist_server] Initialized.")
    node_signals.spin()
    return 0
