"""The node turtle_shape, which is also the name of its action."""

import threading

import actionlib
import node_signals
import rospy
from geometry_msgs.msg import Twist
from turtlesim.msg import Pose

from .msg import ShapeAction, ShapeResult
from .polygon import Polygon, PolygonError


class ShapeServer:
    """Takes a goal, drives /turtle1 along it; a new goal takes the place of the old one."""

    def __init__(self, name: str):
        self._name = name
        self._lock = threading.Lock()  # goals come in one thread, poses in another
        self._polygon: Polygon | None = None
        self._publisher = rospy.Publisher("/turtle1/cmd_vel", Twist, queue_size=1)
        self._server = actionlib.SimpleActionServer(name, ShapeAction, auto_start=False)
        self._server.register_goal_callback(self._accept)
        self._server.register_preempt_callback(self._preempt)
        rospy.Subscriber("/turtle1/pose", Pose, self._drive, queue_size=1)
        self._server.start()

    def _accept(self) -> None:
        with self._lock:
            goal = self._server.accept_new_goal()
            try:
                self._polygon = Polygon(goal.edges, goal.radius)
            except PolygonError as error:
                self._publisher.publish(Twist())
                self._give_up(error)

    def _preempt(self) -> None:
        with self._lock:
            if self._server.is_active() and not self._server.is_new_goal_available():
                rospy.loginfo("%s: Preempted", self._name)
                self._polygon = None
                self._publisher.publish(Twist())  # else the last velocity would count for a second
                self._server.set_preempted()

    def _drive(self, pose: Pose) -> None:
        with self._lock:
            if self._polygon is None:
                return
            if self._polygon.done:
                rospy.loginfo("%s: Succeeded", self._name)
                self._server.set_succeeded(ShapeResult(self._polygon.interior_angle, self._polygon.apothem))
                self._polygon = None
                return
            twist = Twist()
            try:
                twist.linear.x, twist.angular.z = self._polygon.velocity(pose.x, pose.y, pose.theta)
            except PolygonError as error:
                self._give_up(error)
            self._publisher.publish(twist)

    def _give_up(self, error: PolygonError) -> None:
        rospy.logerr("%s: %s", self._name, error)
        self._polygon = None
        self._server.set_aborted(text=str(error))


def main() -> None:
    node_signals.init_node("turtle_shape")
    ShapeServer(rospy.get_name())
    node_signals.spin()
