"""The action ``fibonacci``: so many of Fibonacci's numbers, one each second."""

import actionlib
import node_signals
import rospy

from .asking import ask, tell_state
from .msg import FibonacciAction, FibonacciFeedback, FibonacciGoal, FibonacciResult


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


def ask_and_tell_state() -> None:
    """The node test_fibonacci, as the client in C++ has it."""
    node_signals.init_node("test_fibonacci")
    tell_state(ask("fibonacci", FibonacciAction, FibonacciGoal(order=20)))


def ask_and_print() -> None:
    """The node fibonacci_client_py, as the client in Python has it: prints the numbers."""
    node_signals.init_node("fibonacci_client_py")
    client = ask("fibonacci", FibonacciAction, FibonacciGoal(order=20))
    if client is not None and client.wait_for_result():
        print("Result:", ", ".join(str(number) for number in client.get_result().sequence))
