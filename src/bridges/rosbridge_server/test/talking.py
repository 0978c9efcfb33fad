"""A client of the websocket, for tests; by a library that is not the server's."""

import json
import time
import unittest

import cbor2
import rospy
from websockets.sync.client import connect

PATIENCE = 20.0  # s
PORT = 29090  # of protocol.test


class Client:
    """One connection. ``told``: what came, decoded, ``frames``: as it came."""

    def __init__(self, test, port, query="", decode=None, encode=json.dumps, **options):
        end = time.monotonic() + PATIENCE
        while True:
            try:
                self.socket = connect(f"ws{'s' if 'ssl' in options else ''}://127.0.0.1:{port}/{query}", max_size=None, **options)
                break
            except OSError:
                if time.monotonic() > end:
                    raise
                time.sleep(0.05)
        test.addCleanup(self.socket.close)
        self.told, self.frames, self._encode = [], [], encode
        self._decode = decode or (lambda frame: cbor2.loads(frame) if isinstance(frame, bytes) else json.loads(frame))

    def tell(self, op, **fields):
        self.socket.send(self._encode({"op": op, **fields}))

    def wait(self, condition, what, seconds=PATIENCE):
        """Take in what comes until ``condition()``; its value."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = condition()
            if value:
                return value
            try:
                self.frames.append(self.socket.recv(timeout=0.1))
                self.told.append(self._decode(self.frames[-1]))
            except TimeoutError:
                pass
        raise AssertionError(f"{what} did not come; told: {str(self.told)[-600:]}")

    def ops(self, op, **fields):
        return [m for m in self.told if m["op"] == op and all(m.get(key) == value for key, value in fields.items())]

    def heard(self, topic):
        return [m["msg"] for m in self.ops("publish", topic=topic)]

    def complaint(self, *words):
        """The status with all ``words``, once it has come."""
        return self.wait(lambda: next((m for m in self.ops("status") if all(word in m["msg"] for word in words)), None), f"status {words}")

    def call(self, service, number="call", **fields):
        """The answer."""
        self.tell("call_service", service=service, id=number, **fields)
        return self.wait(lambda: self.ops("service_response", id=number), f"answer of {service}")[-1]

    def settled(self, number="settled"):
        """All that was said before is done: what a client says is done in its order."""
        self.tell("no_such_operation", id=number)
        self.wait(lambda: self.ops("status", id=number), "the answer to the last word")


def connected(publisher_or_subscriber):
    return publisher_or_subscriber.get_num_connections()


def gone(test, thing, what):
    """Wait until nobody is connected to it any more."""
    end = time.monotonic() + PATIENCE
    while thing.get_num_connections():
        test.assertLess(time.monotonic(), end, what)
        rospy.sleep(0.02)


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_service("/rosapi/get_time", 60)  # the last of them

    def client(self):
        return Client(self, PORT)

    def publisher(self, topic, kind, **options):
        made = rospy.Publisher(topic, kind, queue_size=100, **options)
        self.addCleanup(made.unregister)
        return made

    def listener(self, topic, kind):
        """Subscriber, and what it hears."""
        got = []
        made = rospy.Subscriber(topic, kind, got.append)
        self.addCleanup(made.unregister)
        return made, got
