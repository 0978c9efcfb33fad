"""The action ``averaging``: mean and standard deviation of the next numbers on ``/random_number``."""

import contextlib
import math
import random

import actionlib
import node_signals
import rospy
from std_msgs.msg import Float32

from .asking import ask, tell_state
from .msg import AveragingAction, AveragingFeedback, AveragingGoal, AveragingResult

LEAST = 5.0  # a mean below this is a failure


class Server:
    """Works whenever a number comes, not in a thread of the goal's own."""

    def __init__(self, name: str):
        self._name = name
        self._wanted = 0
        self._feedback: AveragingFeedback | None = None
        self._sum = self._squares = 0.0
        self._server = actionlib.SimpleActionServer(name, AveragingAction, auto_start=False)
        self._lock = self._server.action_server.lock  # which is held where goals come in: another one would be taken in another order
        self._server.register_goal_callback(self._on_goal)
        self._server.register_preempt_callback(self._on_preempt)
        self._subscriber = rospy.Subscriber("/random_number", Float32, self._on_number, queue_size=1)
        self._server.start()

    def _on_goal(self) -> None:
        with self._lock:
            self._wanted = self._server.accept_new_goal().samples
            self._feedback, self._sum, self._squares = AveragingFeedback(), 0.0, 0.0

    def _on_preempt(self) -> None:
        rospy.loginfo("%s: Preempted", self._name)
        with self._lock:
            if self._server.is_active():
                self._server.set_preempted()

    def _on_number(self, message: Float32) -> None:
        with self._lock:
            feedback = self._feedback
            if feedback is None or not self._server.is_active():
                return
            feedback.sample += 1
            feedback.data = message.data
            self._sum += message.data
            self._squares += message.data**2
            feedback.mean = self._sum / feedback.sample
            feedback.std_dev = math.sqrt(abs(self._squares / feedback.sample - feedback.mean**2))
            self._server.publish_feedback(feedback)
            if feedback.sample >= self._wanted:
                self._end(AveragingResult(feedback.mean, feedback.std_dev))

    def _end(self, result: AveragingResult) -> None:
        self._feedback = None
        if result.mean < LEAST:
            rospy.loginfo("%s: Aborted", self._name)
            self._server.set_aborted(result)
        else:
            rospy.loginfo("%s: Succeeded", self._name)
            self._server.set_succeeded(result)


def serve() -> None:
    """The node averaging."""
    node_signals.init_node("averaging")
    Server(rospy.get_name())
    node_signals.spin()


def ask_and_tell_state() -> None:
    """The node test_averaging: the mean of 100 numbers."""
    node_signals.init_node("test_averaging")
    tell_state(ask("averaging", AveragingAction, AveragingGoal(samples=100)))


def generate() -> None:
    """The node random_number_generator: normal numbers about 5, twenty a second."""
    node_signals.init_node("random_number_generator")
    publisher = rospy.Publisher("/random_number", Float32, queue_size=1)
    rospy.loginfo("Generating random numbers")
    rate = rospy.Rate(20)
    with contextlib.suppress(rospy.ROSInterruptException):
        while not rospy.is_shutdown():
            publisher.publish(Float32(random.normalvariate(5, 1)))
            rate.sleep()
