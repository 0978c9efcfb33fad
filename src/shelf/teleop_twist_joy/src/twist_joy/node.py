"""The node teleop_twist_joy: ``joy`` in, ``cmd_vel`` out."""

import sys

import node_signals
import rospy
from geometry_msgs.msg import Twist
from sensor_msgs.msg import Joy

from .driving import Driver


def main() -> int:
    node_signals.init_node("teleop_twist_joy")
    try:
        driver = Driver(rospy.get_param("~", {}))
    except (TypeError, ValueError) as error:
        print(f"teleop_twist_joy: parameters of {rospy.get_name()}: {error}", file=sys.stderr)
        return 1
    for line, values in driver.lines():
        rospy.loginfo(line, *values)
    publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1, latch=True)

    def take(joy: Joy) -> None:
        velocities = driver.drive(joy.axes, joy.buttons)
        if velocities is not None:
            twist = Twist()
            twist.linear.x, twist.linear.y, twist.linear.z = (velocities[field] for field in "xyz")
            twist.angular.x, twist.angular.y, twist.angular.z = (velocities[field] for field in ("roll", "pitch", "yaw"))
            publisher.publish(twist)

    rospy.Subscriber("joy", Joy, take, queue_size=1)
    node_signals.spin()
    return 0
