"""The nodes of the tf tutorials, one function each."""

import math
import sys

import node_signals
import rospy
import tf
from geometry_msgs.msg import PointStamped, Twist
from turtlesim.msg import Pose

from turtle_tf.turtles import RATE, spawn, steer

_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


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
    broadcaster = tf.TransformBroadcaster()

    def tell(pose):
        rotation = tf.transformations.quaternion_from_euler(0, 0, pose.theta)
        broadcaster.sendTransform((pose.x, pose.y, 0), rotation, rospy.Time.now(), turtle, "world")

    rospy.Subscriber(f"/{turtle}/pose", Pose, tell, queue_size=10)
    node_signals.spin()
    return 0


def broadcast_fixed_carrot() -> None:
    """carrot1 two metres to the left of turtle1."""
    _broadcast_carrot("fixed_tf_broadcaster", lambda now: (0.0, 2.0, 0.0))


def broadcast_dynamic_carrot() -> None:
    """carrot1 on a circle of ten metres about turtle1, once round in two seconds."""
    _broadcast_carrot("dynamic_tf_broadcaster", lambda now: (10 * math.sin(now * math.pi), 10 * math.cos(now * math.pi), 0.0))


def _broadcast_carrot(node_name: str, place) -> None:
    node_signals.init_node(node_name)
    broadcaster = tf.TransformBroadcaster()
    rospy.Timer(
        rospy.Duration(1 / RATE),
        reset=True,
        callback=lambda event: broadcaster.sendTransform(place(rospy.get_time()), _UPRIGHT, rospy.Time.now(), "carrot1", "turtle1"),
    )
    node_signals.spin()


def follow(node_name: str, target: str = "turtle1", source: str = "turtle2", newest: bool = True) -> None:
    """The node ``node_name``: turtle2 runs after the frame ``target``.

    :param source: the frame in which the target is looked up; the tutorial on debugging has a wrong one
    :param newest: False asks for the transform of this moment, and waits up to 1 s for it
    """
    node_signals.init_node(node_name)
    listener = tf.TransformListener()
    spawn(4, 2, "turtle2")
    publisher = rospy.Publisher("turtle2/cmd_vel", Twist, queue_size=1)

    def turn(_event):
        when = rospy.Time() if newest else rospy.Time.now()
        try:
            if not newest:
                listener.waitForTransform(source, target, when, rospy.Duration(1.0))
            (x, y, _), _ = listener.lookupTransform(source, target, when)
        except tf.Exception as error:
            if source == "turtle2":  # before both are there
                return
            rospy.logerr_throttle(1.0, str(error))
            return
        publisher.publish(steer(x, y))

    rospy.Timer(rospy.Duration(1 / RATE), turn, reset=True)
    node_signals.spin()


def print_points() -> None:
    """turtle_point_stamped as turtle1 sees it, as soon as tf knows where turtle1 was at that time."""
    node_signals.init_node("pose_drawer")
    listener = tf.TransformListener()

    def show(point):
        try:
            listener.waitForTransform("turtle1", point.header.frame_id, point.header.stamp, rospy.Duration(1.0))
            seen = listener.transformPoint("turtle1", point).point
        except tf.Exception as error:
            print(f"Failure {error}", flush=True)
        else:
            print("point of turtle 3 in frame of turtle 1 Position(x:%f y:%f z:%f)" % (seen.x, seen.y, seen.z), flush=True)

    rospy.Subscriber("turtle_point_stamped", PointStamped, show, queue_size=10)
    node_signals.spin()
