"""The node turtle_mimic: one turtle does what another does."""

import node_signals
import rospy
from geometry_msgs.msg import Twist

from .msg import Pose


def main() -> None:
    node_signals.init_node("turtle_mimic")
    # "input" and "output" are remapped as namespaces, which rospy would not apply to input/pose
    publisher = rospy.Publisher(rospy.resolve_name("output") + "/cmd_vel", Twist, queue_size=1)

    def copy(pose):
        twist = Twist()
        twist.linear.x, twist.angular.z = pose.linear_velocity, pose.angular_velocity
        publisher.publish(twist)

    rospy.Subscriber(rospy.resolve_name("input") + "/pose", Pose, copy, queue_size=1)
    node_signals.spin()
