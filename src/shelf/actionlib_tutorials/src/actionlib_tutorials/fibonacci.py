"""The action ``fibonacci``: so many of Fibonacci's numbers, one each second."""
from typing import List

import actionlib
import node_signals
import rospy
from actionlib_msgs.msg import GoalStatus

from .msg import FibonacciAction, FibonacciFeedback, FibonacciGoal, FibonacciResult

PATIENCE = 30.0  # s, of the client that tells how it ended
MOST = 2 ** 31 - 1  # what an int32 holds


class Server:
    """One goal at a time; the next one ends it.

    :param name: of the action
    :param rate: numbers a second
    """

    def __init__(self, name: str, rate: float = 1.0):
        self._name, self._rate = name, rate
        self._server = actionlib.SimpleActionServer(name, FibonacciAction, execute_cb=self._execute, auto_start=False)
        self._server.start()

    def _execute(self, goal: FibonacciGoal) -> None:
        sequence = [0, 1]
        rospy.loginfo("%s: Executing, creating fibonacci sequence of order %i with seeds %i, %i", self._name, goal.order, *sequence)
        rate = rospy.Rate(self._rate)
        for _ in range(1, goal.order):
            if self._server.is_preempt_requested() or rospy.is_shutdown():
                rospy.loginfo("%s: Preempted", self._name)
                self._server.set_preempted(FibonacciResult(sequence))
                return
            if sequence[-1] + sequence[-2] > MOST:
                self._server.set_aborted(FibonacciResult(sequence), "the next number is larger than an int32 can be")
                return
            sequence.append(sequence[-1] + sequence[-2])
            self._server.publish_feedback(FibonacciFeedback(sequence))
            try:
                rate.sleep()
            except rospy.ROSInterruptException:
                return
        rospy.loginfo("%s: Succeeded", self._name)
        self._server.set_succeeded(FibonacciResult(sequence))


def serve() -> None:
    """The node fibonacci."""
    node_signals.init_node("fibonacci")
    Server(rospy.get_name())
    node_signals.spin()


def _client() -> actionlib.SimpleActionClient:
    client = actionlib.SimpleActionClient("fibonacci", FibonacciAction)
    rospy.loginfo("Waiting for action server to start.")
    client.wait_for_server()
    rospy.loginfo("Action server started, sending goal.")
    client.send_goal(FibonacciGoal(order=20))
    return client


def ask_and_tell_state() -> int:
    """The node test_fibonacci, as the client in C++ has it."""
    node_signals.init_node("test_fibonacci")
    client = _client()
    if client.wait_for_result(rospy.Duration(PATIENCE)):
        rospy.loginfo("Action finished: %s", GoalStatus.to_string(client.get_state()))
    elif not rospy.is_shutdown():
        rospy.loginfo("Action did not finish before the time out.")
    return 0


def ask_and_print() -> int:
    """The node fibonacci_client_py, as the client in Python has it: prints the numbers."""
    node_signals.init_node("fibonacci_client_py")
    client = _client()
    client.wait_for_result()
    result = client.get_result()
    if result is not None:
        print(told(result.sequence))
    return 0


def told(sequence: List[int]) -> str:
    return "Result: " + ", ".join(str(number) for number in sequence)
