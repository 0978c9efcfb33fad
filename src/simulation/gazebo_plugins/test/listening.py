"""What the rostests share: a subscriber that keeps everything, and conditions that come true in the end."""

import time
import xmlrpc.client

import rosgraph
import rospy


def until(condition, what, seconds=60.0):
    """ROS delivers when it pleases; what has been sent arrives within ``seconds`` or the test fails."""
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise AssertionError(f"no {what}")
        time.sleep(0.002)


def connections(topic, node="/gazebo"):
    """Numbers of the connections that subscribers of ``topic`` have to ``node``, as that node sees them."""
    uri = rosgraph.Master(rospy.get_name()).lookupNode(node)
    _, _, rows = xmlrpc.client.ServerProxy(uri).getBusInfo(rospy.get_name())
    return {row[0] for row in rows if row[2] == "o" and row[4] == topic and row[5]}


class Ear:
    """A subscriber that keeps everything; when it is made the simulator is connected: an older, closed connection to
    the same topic does not count."""

    def __init__(self, topic, kind, node="/gazebo"):
        self.messages = []
        before = connections(topic, node)
        self.subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=None, buff_size=1 << 24, tcp_nodelay=True)
        until(lambda: connections(topic, node) - before, f"connection of {topic}")

    def wait(self, count):
        """All messages, once there are at least ``count``."""
        until(lambda: len(self.messages) >= count, f"{count} messages on {self.subscriber.name}, only {len(self.messages)}")
        return self.messages

    def close(self):
        self.subscriber.unregister()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Mouth:
    """A publisher that the simulator listens to."""

    def __init__(self, topic, kind):
        self.publisher = rospy.Publisher(topic, kind, queue_size=10)
        until(lambda: self.publisher.get_num_connections(), f"subscriber of {topic}")

    def say(self, *values, **fields):
        self.publisher.publish(*values, **fields)
