"""``complementary_filter_node``."""

from __future__ import annotations

import rospy
from imu_filters.node import QUEUE, Node, numbers
from node_signals.parameters import number
from std_msgs.msg import Bool

from . import Complementary


class ComplementaryNode(Node):
    """``complementary_filter_node``."""

    def prepare(self, name: str, debug: bool) -> None:
        bias = rospy.get_param("~do_bias_estimation", True)
        gains = {key: number(f"~{key}", 0.01) for key in ("gain_acc", "gain_mag", "bias_alpha")}
        for key, value in gains.items():
            if not 0.0 <= value <= 1.0:
                rospy.logwarn("parameter ~%s is %g, and has to lie between 0 and 1; 0.01 is taken", key, value)
                gains[key] = 0.01
        self.filter = Complementary(
            gains["gain_acc"], gains["gain_mag"], rospy.get_param("~do_adaptive_gain", True), gains["bias_alpha"] if bias else None
        )
        self._steady = rospy.Publisher(f"{name}/steady_state", Bool, queue_size=QUEUE) if debug and bias else None
        self._started = False

    def reset(self) -> None:
        self.filter.reset()
        self._started = False

    def answer(self, reading, field, dt):
        if not self._started:  # the first reading gives the time alone
            self._started = True
            return None
        self.filter.update(numbers(reading.linear_acceleration), numbers(reading.angular_velocity), field, dt)
        return self.filter.orientation

    def finish(self, message, orientation):
        rate = message.angular_velocity
        rate.x, rate.y, rate.z = (w - b for w, b in zip(numbers(rate), self.filter.bias))
        if self._steady:
            self._steady.publish(self.filter.steady)
