"""The node twist_marker: draws a twist as an arrow above the robot, for RViz."""

import node_signals
import rospy
from geometry_msgs.msg import Point, Twist
from visualization_msgs.msg import Marker


def arrow(twist: Twist, frame_id: str, scale: float, height: float) -> Marker:
    """``twist`` as an arrow in ``frame_id``.

    Ahead and sideways as fast as the robot (1 m for 1 m/s); a turn (rad/s) counts sideways where it is the greater.

    :param scale: of the arrow's thickness
    :param height: m above the frame's origin
    """
    marker = Marker(type=Marker.ARROW, action=Marker.ADD)
    marker.header.frame_id = frame_id
    marker.pose.position.z, marker.pose.orientation.w = height, 1.0
    marker.scale.x, marker.scale.y = 0.05 * scale, 0.1 * scale
    marker.color.g = marker.color.a = 1.0
    sideways = max(twist.linear.y, twist.angular.z, key=abs)
    marker.points = [Point(), Point(twist.linear.x, sideways, 0.01)]  # RViz refuses an arrow without length
    return marker


def main() -> None:
    node_signals.init_node("twist_marker")
    frame_id = rospy.get_param("~frame_id", "base_footprint")
    scale, height = rospy.get_param("~scale", 1.0), rospy.get_param("~vertical_position", 2.0)
    publisher = rospy.Publisher("marker", Marker, queue_size=1, latch=True)
    rospy.Subscriber("twist", Twist, lambda twist: publisher.publish(arrow(twist, frame_id, scale, height)), queue_size=1)
    node_signals.spin()
