"""For tests that run a lab in the simulator."""

import threading
import time

import rospy
from gazebo_msgs.srv import GetPhysicsProperties, SetPhysicsProperties

PATIENCE = 60  # s of wall time in which something must happen


def run_free(times_real=None):
    """Makes the simulator run as fast as the machine goes, or `times_real` as fast as the wall clock."""
    rospy.wait_for_service("/gazebo/set_physics_properties", PATIENCE)
    now = rospy.ServiceProxy("/gazebo/get_physics_properties", GetPhysicsProperties)()
    rate = times_real / now.time_step if times_real else 0.0
    rospy.ServiceProxy("/gazebo/set_physics_properties", SetPhysicsProperties)(
        time_step=now.time_step, max_update_rate=rate, gravity=now.gravity, ode_config=now.ode_config
    )


class Topic:
    """The messages of a topic, kept."""

    def __init__(self, name, kind):
        self.messages = []
        self._name = name
        self._changed = threading.Condition()
        rospy.Subscriber(name, kind, self._receive, queue_size=10000, tcp_nodelay=True)

    def _receive(self, message):
        with self._changed:
            self.messages.append(message)
            self._changed.notify_all()

    def wait_for(self, condition, what):
        """The first message, among those that came and those to come, for which `condition` holds; each is asked once.

        :raises AssertionError: `what` did not come
        """
        deadline = time.monotonic() + PATIENCE
        asked = 0
        with self._changed:
            while True:
                for message in self.messages[asked:]:
                    if condition(message):
                        return message
                asked = len(self.messages)
                if not self._changed.wait(timeout=deadline - time.monotonic()):
                    last = self.messages[-1] if self.messages else "nothing"
                    raise AssertionError("%s: %s did not come; last was %s" % (self._name, what, last))
