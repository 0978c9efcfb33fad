"""What the rostests share: a simulated clock, and waiting for messages with time running."""

import threading

import rospy
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState

STEP = 0.01  # s of simulated time per tick
TICK = 0.002  # s of wall time between ticks
LEAD = 0.15  # s of simulated time by which the clock may be ahead of the joint states, which come every 0.1 s


class RunningClock:
    """Publishes /clock from a thread, five times faster than the wall, but not faster than the driver can follow."""

    def __init__(self):
        self._publisher = rospy.Publisher("/clock", Clock, queue_size=1)
        self._stopped = threading.Event()
        self._followed = None  # s, stamp of the last joint states
        rospy.Subscriber("/joint_states", JointState, self._follow, tcp_nodelay=True)
        threading.Thread(target=self._run, daemon=True).start()

    def _follow(self, state):
        self._followed = state.header.stamp.to_sec()

    def _run(self):
        ticks = 0
        while not self._stopped.wait(TICK):
            if self._followed is None or ticks * STEP < self._followed + LEAD:
                ticks += 1
                self._publisher.publish(Clock(rospy.Time(ticks * STEP)))

    def stop(self):
        self._stopped.set()


class Collector:
    """Keeps the messages of a topic."""

    def __init__(self, topic, kind):
        self.messages = []
        self._changed = threading.Condition()
        self._subscriber = rospy.Subscriber(topic, kind, self._receive)

    def _receive(self, message):
        with self._changed:
            self.messages.append(message)
            self._changed.notify_all()

    def wait_for(self, condition, what):
        """The first message, old or new, for which `condition` holds; AssertionError after a minute of wall time."""

        def found():
            return next((message for message in list(self.messages) if condition(message)), None)

        with self._changed:
            assert self._changed.wait_for(lambda: found() is not None, timeout=60), what + " did not come"
            return found()

    def close(self):
        self._subscriber.unregister()
