"""The nodes of the tf tutorials, one function each."""
import math
import sys

import node_signals
import rospy
import tf
from geometry_msgs.msg import PointStamped, Twist
from turtlesim.msg import Pose
from turtlesim.srv import Spawn

RATE = 10.0  # Hz
_UPRIGHT = (0.0, 0.0, 0.0, 1.0)


def broadcast_turtle(node_name: str) -> int:
    """The frame of a turtle in "world", as its pose topic has it. The name comes from ~turtle or the command line."""
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
    rospy.Timer(rospy.Duration(1 / RATE), reset=True, callback=lambda event: broadcaster.sendTransform(
        place(rospy.get_time()), _UPRIGHT, rospy.Time.now(), "carrot1", "turtle1"))
    node_signals.spin()


def spawn(x: float, y: float, name: str) -> None:
    """A turtle of that name; if it is there already, a line says so."""
    while not rospy.is_shutdown():
        try:
            rospy.wait_for_service("spawn", timeout=0.5)
            rospy.ServiceProxy("spawn", Spawn)(x, y, 0, name)
            return
        except rospy.ServiceException as error:
            rospy.logwarn("%s is not spawned: %s", name, error)
            return
        except rospy.ROSException:  # not there yet, or the node is being shut down
            pass


def follow(node_name: str, target: str = "turtle1", source: str = "turtle2", newest: bool = True) -> None:
    """turtle2 runs after a frame.

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
        twist = Twist()
        twist.angular.z, twist.linear.x = 4 * math.atan2(y, x), 0.5 * math.hypot(x, y)
        publisher.publish(twist)

    rospy.Timer(rospy.Duration(1 / RATE), turn, reset=True)
    node_signals.spin()


def broadcast_points() -> None:
    """turtle3 runs in circles; where it is in "world" goes out as turtle_point_stamped."""
    node_signals.init_node("turtle_tf_msg_broadcaster")
    spawn(4, 2, "turtle3")
    points = rospy.Publisher("turtle_point_stamped", PointStamped, queue_size=1)
    velocity = rospy.Publisher("turtle3/cmd_vel", Twist, queue_size=1)

    def tell(pose):
        point = PointStamped()
        point.header.stamp, point.header.frame_id = rospy.Time.now(), "world"
        point.point.x, point.point.y = pose.x, pose.y
        points.publish(point)

    rospy.Subscriber("/turtle3/pose", Pose, tell, queue_size=1)
    circle = Twist()
    circle.linear.x = circle.angular.z = 1.0
    rospy.Timer(rospy.Duration(1 / RATE), lambda event: velocity.publish(circle), reset=True)
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
