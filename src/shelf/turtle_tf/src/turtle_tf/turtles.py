"""What the tutorials of tf and of tf2 share: turtles that come, run in circles and are steered."""

import math

import node_signals
import rospy
from geometry_msgs.msg import PointStamped, Twist
from turtlesim.msg import Pose
from turtlesim.srv import Spawn

RATE = 10.0  # Hz


def spawn(x: float, y: float, name: str) -> None:
    """A turtle ``name`` at ``x``, ``y``, m; if it is there already, a line says so."""
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


def steer(x: float, y: float) -> Twist:
    """The velocity towards the point ``x``, ``y`` (m) of the turtle's own frame."""
    twist = Twist()
    twist.angular.z, twist.linear.x = 4 * math.atan2(y, x), 0.5 * math.hypot(x, y)
    return twist


def broadcast_points(node_name: str) -> None:
    """The node ``node_name``: turtle3 runs in circles; where it is in "world" goes out as turtle_point_stamped."""
    node_signals.init_node(node_name)
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
