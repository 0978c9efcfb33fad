#!/usr/bin/env python3
"""The bridge, as a browser talks to it: the frames are those of https://github.com/foxglove/ws-protocol."""

import io
import json
import os
import signal
import socket
import struct
import subprocess
import unittest

import rosgraph
import rospkg
import rospy
import rostest
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

ADDRESS = "ws://127.0.0.1:28765"
PATIENCE = 20.0  # s


def hung_services(test, count=4):
    """Services of a node that is stopped: its socket takes connections, and nothing answers."""
    listening = socket.create_server(("127.0.0.1", 0), backlog=50)
    test.addCleanup(listening.close)
    master, uri = rosgraph.Master("/hung"), f"rosrpc://127.0.0.1:{listening.getsockname()[1]}"
    for number in range(count):
        master.registerService(f"/hung/{number}", uri, "http://127.0.0.1:9")
        test.addCleanup(master.unregisterService, f"/hung/{number}", uri)
    return listening


def bytes_of(message):
    out = io.BytesIO()
    message.serialize(out)
    return out.getvalue()


class Client:
    """One connection. ``channels`` and ``services``: what the server has told, by name."""

    def __init__(self, test):
        end = rospy.get_time() + PATIENCE
        while True:
            try:
                self.socket = connect(ADDRESS, subprotocols=["foxglove.sdk.v1"], max_size=None)
                break
            except OSError:
                if rospy.get_time() > end:
                    raise
                rospy.sleep(0.1)
        test.addCleanup(self.socket.close)
        self.channels, self.services, self.told, self.data = {}, {}, [], []

    def tell(self, **message):
        self.socket.send(json.dumps(message))

    def wait(self, condition, what):
        """Take in what comes until ``condition()``; its value."""
        end = rospy.get_time() + PATIENCE
        while rospy.get_time() < end:
            value = condition()
            if value:
                return value
            try:
                self.take(self.socket.recv(timeout=0.2))
            except TimeoutError:
                pass
        raise AssertionError(f"{what} did not come; told: {[m['op'] for m in self.told]}")

    def take(self, frame):
        if isinstance(frame, bytes):
            self.data.append(frame)
            return
        message = json.loads(frame)
        self.told.append(message)
        if message["op"] == "advertise":
            self.channels.update({channel["topic"]: channel for channel in message["channels"]})
        elif message["op"] == "unadvertise":
            self.channels = {name: c for name, c in self.channels.items() if c["id"] not in message["channelIds"]}
        elif message["op"] == "advertiseServices":
            self.services.update({service["name"]: service for service in message["services"]})

    def op(self, name, **fields):
        return [m for m in self.told if m["op"] == name and all(m.get(key) == value for key, value in fields.items())]

    def subscribe(self, topic, number):
        channel = self.wait(lambda: self.channels.get(topic), f"channel {topic}")
        self.tell(op="subscribe", subscriptions=[{"id": number, "channelId": channel["id"]}])
        return channel

    def received(self, number):
        """Payloads of message frames: 1, subscription, time in ns, bytes."""
        return [frame[13:] for frame in self.data if frame[0] == 1 and struct.unpack("<I", frame[1:5])[0] == number]


class Bridge(unittest.TestCase):
    def test_who_it_is(self):
        client = Client(self)
        info = client.wait(lambda: client.op("serverInfo"), "serverInfo")[0]
        self.assertEqual(
            set(info["capabilities"]) - {"parametersSubscribe"}, {"clientPublish", "parameters", "services", "connectionGraph", "assets"}
        )
        self.assertEqual(info["supportedEncodings"], ["ros1"])

    def test_a_topic_comes_and_goes_and_its_bytes_are_those_of_ros(self):
        client = Client(self)
        publisher = rospy.Publisher("/numbers", Float64, queue_size=10)
        channel = client.subscribe("/numbers", 7)
        self.assertEqual(
            (channel["encoding"], channel["schemaName"], channel["schemaEncoding"], channel["schema"].strip()),
            ("ros1", "std_msgs/Float64", "ros1msg", "float64 data"),
        )
        client.wait(publisher.get_num_connections, "the bridge as a subscriber")
        for number in range(5):
            publisher.publish(Float64(number / 3))
        client.wait(lambda: len(client.received(7)) == 5, "five messages")
        self.assertEqual(client.received(7), [bytes_of(Float64(number / 3)) for number in range(5)])
        client.tell(op="unsubscribe", subscriptionIds=[7])
        client.wait(lambda: not publisher.get_num_connections(), "the bridge to listen no more")
        publisher.unregister()
        client.wait(lambda: "/numbers" not in client.channels, "the end of the channel")

    def test_what_is_latched_comes_to_whoever_comes_later(self):
        publisher = rospy.Publisher("/latched", String, queue_size=1, latch=True)
        publisher.publish("once")
        for _ in range(2):
            client = Client(self)
            client.subscribe("/latched", 3)
            client.wait(lambda: bytes_of(String("once")) in client.received(3), "the latched message")

    def test_a_client_publishes(self):
        got = []
        subscriber = rospy.Subscriber("/from_page", String, lambda m: got.append(m.data))
        client = Client(self)
        client.tell(op="advertise", channels=[{"id": 5, "topic": "/from_page", "encoding": "ros1", "schemaName": "std_msgs/String"}])
        client.wait(subscriber.get_num_connections, "the bridge as a publisher")
        # said again until it comes: the publisher may know the connection later than the subscriber
        client.wait(lambda: got or client.socket.send(struct.pack("<BI", 1, 5) + bytes_of(String("hello"))), "the message")
        self.assertEqual(set(got), {"hello"})
        client.socket.send(struct.pack("<BI", 1, 5) + b"\xff\xff")
        client.wait(lambda: [m for m in client.op("status") if "2 bytes are no std_msgs/String" in m["message"]], "a line about bad bytes")
        client.tell(op="unadvertise", channelIds=[5])
        client.wait(lambda: not subscriber.get_num_connections(), "the end of the publisher")

    def test_a_client_that_leaves_takes_its_topics_with_it(self):
        subscriber = rospy.Subscriber("/from_leaver", String, lambda m: None)
        publisher = rospy.Publisher("/for_leaver", String, queue_size=1)
        client, other = Client(self), Client(self)
        client.tell(op="advertise", channels=[{"id": 5, "topic": "/from_leaver", "encoding": "ros1", "schemaName": "std_msgs/String"}])
        client.subscribe("/for_leaver", 9)
        client.wait(lambda: subscriber.get_num_connections() and publisher.get_num_connections(), "the bridge")
        client.socket.close()
        other.wait(lambda: not subscriber.get_num_connections(), "the end of the publisher")
        other.wait(lambda: not publisher.get_num_connections(), "the bridge to listen no more")

    def test_what_may_not_be_published_is_told(self):
        client = Client(self)
        for number, (topic, kind, said) in enumerate(
            (("/other", "std_msgs/String", "client_topic_whitelist"), ("/from_x", "no_such/Type", "no package here defines no_such/Type")),
            10,
        ):
            client.tell(op="advertise", channels=[{"id": number, "topic": topic, "encoding": "ros1", "schemaName": kind}])
            client.wait(lambda said=said: [m for m in client.op("status") if said in m["message"]], said)

    def test_a_service_is_called(self):
        def answer(request):
            if request.data:
                return SetBoolResponse(True, "on")
            raise ValueError("not off")

        service = rospy.Service("/switch", SetBool, answer)
        self.addCleanup(service.shutdown)
        client = Client(self)
        offer = client.wait(lambda: client.services.get("/switch"), "the service")
        self.assertEqual(
            (offer["type"], offer["request"]["encoding"], offer["request"]["schema"].strip().split()[:2]),
            ("std_srvs/SetBool", "ros1", ["bool", "data"]),
        )
        call = struct.pack("<BIII", 2, offer["id"], 77, 4) + b"ros1"
        client.socket.send(call + bytes_of(SetBoolRequest(True)))
        frame = client.wait(lambda: next((f for f in client.data if f[0] == 3), None), "the answer")
        self.assertEqual(struct.unpack("<III", frame[1:13]), (offer["id"], 77, 4))
        self.assertEqual(frame[13:], b"ros1" + bytes_of(SetBoolResponse(True, "on")))
        for request, said in ((bytes_of(SetBoolRequest(False)), "not off"), (b"", "0 bytes are no request")):
            client.told.clear()
            client.socket.send(call + request)
            failure = client.wait(lambda: client.op("serviceCallFailure", callId=77), "the failure")[0]
            self.assertIn(said, failure["message"])

    def test_services_that_hang_hold_up_nothing(self):
        listening = hung_services(self)
        client = Client(self)
        listening.accept()[0].close()  # the bridge has begun to ask
        begin = rospy.get_time()
        publisher = rospy.Publisher("/beside_hung", String, queue_size=1)
        service = rospy.Service("/switch_beside_hung", SetBool, lambda _: SetBoolResponse())
        self.addCleanup(service.shutdown)
        client.wait(lambda: "/beside_hung" in client.channels and "/switch_beside_hung" in client.services, "what is new")
        self.assertLess(rospy.get_time() - begin, 4.0)  # one look at the graph, 0.5 s; rosservice waits 5 s for each that hangs
        publisher.unregister()

    def test_services_that_hang_do_not_keep_it_from_ending(self):
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        listening = hung_services(self)
        listening.settimeout(PATIENCE)
        bridge = subprocess.Popen(["rosrun", "foxglove_bridge", "foxglove_bridge", f"_port:={port}", "__name:=ending"])
        self.addCleanup(bridge.kill)
        for _ in range(8):  # more than one round
            listening.accept()
        bridge.send_signal(signal.SIGTERM)
        bridge.wait(5)

    def test_parameters(self):
        client = Client(self)
        client.tell(op="getParameters", parameterNames=[], id="all")
        values = client.wait(lambda: client.op("parameterValues", id="all"), "parameters")[0]["parameters"]
        self.assertEqual([(p["name"], p["value"]) for p in values], [("/bridged/number", 3)])
        client.tell(
            op="setParameters",
            parameters=[{"name": "/bridged/list", "value": [1.5, 2.5]}, {"name": "/secret/word", "value": "x"}],
            id="set",
        )
        client.wait(lambda: client.op("parameterValues", id="set"), "what was set")
        self.assertEqual((rospy.get_param("/bridged/list"), rospy.get_param("/secret/word")), ([1.5, 2.5], "hidden"))

    def followed(self, client, *names):
        """The values that are set are told once, from then on what ``client`` is told is news."""
        values = {name: [rospy.get_param(name)] for name in names if rospy.has_param(name)}
        client.told.clear()
        client.tell(op="subscribeParameterUpdates", parameterNames=list(names))
        client.wait(lambda: self.changes(client) == values, f"{values}")
        client.told.clear()

    def changes(self, client):
        """name -> its values, one after the other; {}: it is not set."""
        found = {}
        for parameter in (p for m in client.op("parameterValues") if "id" not in m for p in m["parameters"]):
            found.setdefault(parameter["name"], []).append(parameter.get("value"))
        return found

    def test_parameters_that_are_followed(self):
        """Changes from outside, of a part, to nothing and back are told as they come, long before the next look at the graph."""
        client, other = Client(self), Client(self)
        self.addCleanup(lambda: rospy.has_param("/bridged/box") and rospy.delete_param("/bridged/box"))
        rospy.set_param("/bridged/box/side", 1)
        self.followed(client, "/bridged/box/side", "/bridged/box/later", "/bridged/box")
        box, side, later = "/bridged/box", "/bridged/box/side", "/bridged/box/later"
        expected = {}
        for act, told in (
            (lambda: rospy.set_param(side, 2), {box: {"side": 2}, side: 2}),
            (lambda: rospy.set_param(later, "x"), {box: {"side": 2, "later": "x"}, later: "x"}),
            (lambda: rospy.delete_param(later), {box: {"side": 2}, later: {}}),
            (lambda: rospy.delete_param(box), {box: {}, side: {}}),
            (lambda: rospy.set_param(side, [True]), {box: {"side": [True]}, side: [True]}),
        ):
            act()
            for name, value in told.items():
                expected.setdefault(name, []).append(value)
            begin = rospy.get_time()
            client.wait(lambda: self.changes(client) == expected, f"{told}")
            self.assertLess(rospy.get_time() - begin, 2.0, "the graph is looked at every 5 s")
        # Another client's own setting, and deleting, is told to those who follow, each once.
        other.tell(op="setParameters", parameters=[{"name": side, "value": 7}], id="set")
        other.wait(lambda: other.op("parameterValues", id="set"), "what was set")
        client.wait(lambda: self.changes(client)[side][-1] == 7, "what the other set")
        other.tell(op="setParameters", parameters=[{"name": side}], id="unset")
        client.wait(lambda: self.changes(client)[side][-1] == {}, "what the other deleted")
        self.assertEqual(self.changes(client)[side], [*expected[side], 7, {}])
        client.tell(op="unsubscribeParameterUpdates", parameterNames=[box, side, later])
        self.followed(client, "/bridged/number")
        rospy.set_param(side, 8)
        rospy.set_param("/bridged/number", 4)
        client.wait(lambda: self.changes(client), "the number")
        self.assertEqual(self.changes(client), {"/bridged/number": [4]})
        rospy.set_param("/bridged/number", 3)

    def test_parameters_that_are_not_there(self):
        client = Client(self)
        client.tell(op="getParameters", parameterNames=["/bridged/number", "/bridged/none", "/secret/word"], id="some")
        values = client.wait(lambda: client.op("parameterValues", id="some"), "parameters")[0]["parameters"]
        self.assertEqual([(p["name"], p["value"]) for p in values], [("/bridged/number", 3)])
        (status,) = client.wait(lambda: client.op("status"), "a word of the others")
        self.assertEqual(status["level"], 2)  # error
        self.assertIn("/bridged/none, /secret/word", status["message"])

    def test_the_graph(self):
        publisher = rospy.Publisher("/graph_topic", String, queue_size=1)
        client = Client(self)
        client.tell(op="subscribeConnectionGraph")

        def told():
            return any(
                {"name": "/graph_topic", "publisherIds": [rospy.get_name()]} in m["publishedTopics"]
                for m in client.op("connectionGraphUpdate")
            )

        client.wait(told, "the topic in the graph")
        publisher.unregister()

    def asset(self, client, number, uri):
        """Its bytes, or the message of the failure. Frames: 4, request, 0 or 1, length of the message, message, bytes."""
        client.tell(op="fetchAsset", uri=uri, requestId=number)
        frame = client.wait(lambda: next((f for f in client.data if f[0] == 4 and struct.unpack("<I", f[1:5])[0] == number), None), uri)
        (length,) = struct.unpack("<I", frame[6:10])
        return frame[10 : 10 + length].decode() if frame[5] else frame[10 + length :]

    def test_files_of_packages(self):
        client = Client(self)
        inside = "meshes/base_link.stl"
        with open(os.path.join(rospkg.RosPack().get_path("arm_description"), inside), "rb") as file:
            self.assertEqual(self.asset(client, 1, f"package://arm_description/{inside}"), file.read())
        for number, uri in enumerate(
            (
                "package://foxglove_bridge/package.xml",
                "package://foxglove_bridge/../../README.stl",
                "package://no_such/a.stl",
                "file:///etc/passwd",
                "package://foxglove_bridge/%2e%2e/%2e%2e/x.stl",
            ),
            2,
        ):
            self.assertIsInstance(self.asset(client, number, uri), str, uri)

    def test_clients_that_do_not_read_stop_nobody(self):
        """Topics enough that many of its threads find the client's queue full at the same time."""
        count = 40
        publishers = [rospy.Publisher(f"/flood/{number}", String, queue_size=5) for number in range(count)]
        lazy, other = Client(self), Client(self)
        for number in range(count):
            lazy.subscribe(f"/flood/{number}", number)
        other.wait(lambda: all(publisher.get_num_connections() for publisher in publishers), "the bridge")
        text = String("x" * 50000)
        for _ in range(50):  # 100 MB
            for publisher in publishers:
                publisher.publish(text)
        other.subscribe("/flood/0", 1)
        last = String("the last")
        other.wait(lambda: bytes_of(last) in other.received(1) or publishers[0].publish(last), "the last message")
        Client(self).wait(lambda: True, "a new connection")
        for publisher in publishers:
            publisher.unregister()

    def test_bad_words_leave_it_running(self):
        client = Client(self)
        try:
            for frame in (
                "no json",
                json.dumps({"op": "subscribe"}),
                b"",
                b"\x01\x05",
                b"\xfe" * 50,
                json.dumps({"op": "subscribe", "subscriptions": [{"id": 1, "channelId": 999999}]}),
            ):
                client.socket.send(frame)
        except ConnectionClosed:
            pass  # as it may
        client = Client(self)
        client.wait(lambda: client.op("serverInfo"), "serverInfo")


if __name__ == "__main__":
    rospy.init_node("bridge_rostest")
    rostest.rosrun("foxglove_bridge", "bridge", Bridge)
