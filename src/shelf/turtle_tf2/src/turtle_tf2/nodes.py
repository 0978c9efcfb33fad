"""The nodes of the tf2 tutorials, one function each."""

import math
import sys

import node_signals
import rospy
import tf2_geometry_msgs  # noqa: F401  lets a tf2 buffer transform points
import tf2_ros
from geometry_msgs.msg import PointStamped, TransformStamped, Twist
from turtle_tf.turtles import RATE, spawn, steer
from turtlesim.msg import Pose


def _stamped(parent: str, child: str, x: float, y: float, yaw: float = 0.0) -> TransformStamped:
    """The pose of child in parent, now."""
    stamped = TransformStamped(child_frame_id=child)
    stamped.header.frame_id, stamped.header.stamp = parent, rospy.Time.now()
    stamped.transform.translation.x, stamped.transform.translation.y = x, y
    stamped.transform.rotation.z, stamped.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return stamped


def broadcast_turtle(node_name: str) -> int:
    """The node ``node_name``: the frame of a turtle in "world", as its pose topic has it. The name comes from ~turtle or the command
    line.
    """
    node_signals.init_node(node_name)
    arguments = rospy.myargv(sys.argv)[1:]
    turtle = rospy.get_param("~turtle", arguments[0] if len(arguments) == 1 else None)
    if turtle is None:
        rospy.logerr("need turtle name as argument, or as parameter %s", rospy.resolve_name("~turtle"))
        return 1
    broadcaster = tf2_ros.TransformBroadcaster()
    rospy.Subscriber(
        f"/{turtle}/pose",
        Pose,
        queue_size=10,
        callback=lambda pose: broadcaster.sendTransform(_stamped("world", turtle, pose.x, pose.y, pose.theta)),
    )
    node_signals.spin()
    return 0


def broadcast_fixed_carrot() -> None:
    """carrot1 two metres to the left of turtle1."""
    _broadcast_carrot("fixed_tf2_broadcaster", lambda now: (0.0, 2.0))


def broadcast_dynamic_carrot() -> None:
    """carrot1 on a circle of ten metres about turtle1, once round in two seconds."""
    _broadcast_carrot("dynamic_tf2_broadcaster", lambda now: (10 * math.sin(now * math.pi), 10 * math.cos(now * math.pi)))


def _broadcast_carrot(node_name: str, place) -> None:
    node_signals.init_node(node_name)
    broadcaster = tf2_ros.TransformBroadcaster()
    rospy.Timer(
        rospy.Duration(1 / RATE),
        reset=True,
        callback=lambda event: broadcaster.sendTransform(_stamped("turtle1", "carrot1", *place(rospy.get_time()))),
    )
    node_signals.spin()


def follow(node_name: str, timeout: float = 0.0) -> None:
    """The node ``node_name``: turtle2 (or the one that the parameter turtle names) runs after turtle1.

    :param timeout: s to wait for the transform of this moment; 0 takes the newest there is
    """
    node_signals.init_node(node_name)
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer)
    name = rospy.get_param("turtle", "turtle2")
    spawn(4, 2, name)
    publisher = rospy.Publisher(f"{name}/cmd_vel", Twist, queue_size=1)

    def turn(_event):
        when = rospy.Time.now() if timeout else rospy.Time()
        try:
            place = buffer.lookup_transform(name, "turtle1", when, rospy.Duration(timeout)).transform.translation
        except tf2_ros.TransformException:  # before both are there
            return
        publisher.publish(steer(place.x, place.y))

    rospy.Timer(rospy.Duration(1 / RATE), turn, reset=True)
    node_signals.spin()


def print_points() -> None:
    """turtle_point_stamped as turtle1 sees it, as soon as tf2 knows where turtle1 was at that time."""
    node_signals.init_node("pose_drawer")
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer)

    def show(point):
        try:
            seen = buffer.transform(point, "turtle1", rospy.Duration(1.0)).point
        except tf2_ros.TransformException as error:
            rospy.logwarn("Failure %s", error)
        else:
            rospy.loginfo("point of turtle 3 in frame of turtle 1 Position(x:%f y:%f z:%f)", seen.x, seen.y, seen.z)

    rospy.Subscriber("turtle_point_stamped", PointStamped, show, queue_size=10)
    node_signals.spin()
