#!/usr/bin/env python3
"""Rosbridge's protocol, version 2, through a websocket: what upstream's own tests and its specification ask."""

import base64
import io
import json
import os
import struct
import sys
import threading
import time

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import PointStamped, Twist
from nav_msgs.msg import Odometry
from rosbridge_library.internal import pngcompression
from rosbridge_library.msg import TestHeaderArray, TestUInt8FixedSizeArray16
from rosbridge_library.srv import AddTwoInts, TestNestedService, TestNestedServiceResponse
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import Float64, Int32, String, UInt8MultiArray
from std_srvs.srv import SetBool, SetBoolResponse, Trigger
from test_support.waiting import never, wait_until

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talking import Case, connected, gone  # noqa: E402


class Publishing(Case):
    def test_advertise_publish_unadvertise(self):
        subscriber, got = self.listener("/from_page", Twist)
        client = self.client()
        client.tell("advertise", topic="/from_page", type="geometry_msgs/Twist")
        client.tell("publish", topic="/from_page", msg={"linear": {"x": 0.5}, "angular": {"z": -1}})
        wait_until(lambda: got, "what is said before the subscriber is connected")
        self.assertEqual((got[0].linear.x, got[0].angular.z, got[0].linear.y), (0.5, -1.0, 0.0))
        client.tell("unadvertise", topic="/from_page")
        gone(self, subscriber, "the end of the publisher")

    def test_a_type_is_known_from_who_listens(self):
        _, got = self.listener("/listened_to", String)
        client = self.client()
        client.tell("publish", topic="/listened_to", msg={"data": "hello"})
        wait_until(lambda: [m.data for m in got] == ["hello"], "the message")
        client.tell("publish", topic="/nobody_knows", msg={"data": 1}, id="n")
        client.complaint("publish: nobody publishes or reads /nobody_knows")
        self.assertEqual(client.ops("status")[0]["id"], "n")
        client.tell("publish", topic="/told_by_itself", type="std_msgs/String", msg={"data": "hello"}, latch=True)
        client.tell("publish", topic="/listened_to", type="std_msgs/Float64", msg={"data": "the topic's type counts, as upstream"})
        wait_until(lambda: len(got) == 2, "the second message")
        _, later = self.listener("/told_by_itself", String)
        wait_until(lambda: [m.data for m in later] == ["hello"], "the message of a type that the operation says")

    def test_what_cannot_be_published(self):
        self.listener("/strings", String)
        client = self.client()
        for fields, said in (
            ({"type": "std_msgs/Float64"}, "/strings has messages of the type std_msgs/String, not std_msgs/Float64"),
            ({"type": "no_such/Type"}, "no package here defines the message no_such/Type"),
            ({"type": "std_msgs"}, "'std_msgs' is no type"),
            ({}, "a field 'type' is missing"),
            ({"type": 5}, "field 'type' should be a text, not 5"),
            ({"type": "std_msgs/String", "topic": None}, "field 'topic' should be a text"),
            ({"type": "std_msgs/String", "latch": "yes"}, "field 'latch' should be true or false"),
        ):
            client.tell("advertise", **{"topic": "/strings", **fields})
            client.complaint("advertise: ", said)
        for msg, said in (
            ({"data": 5}, "std_msgs/String.data should be string, not a whole number (5)"),
            ({"text": ""}, "std_msgs/String has no field text; there is data"),
            ([], "std_msgs/String should be"),
        ):
            client.tell("publish", topic="/strings", msg=msg)
            client.complaint("publish: ", said)

    def test_latched(self):
        client = self.client()
        client.tell("advertise", topic="/kept", type="std_msgs/String", latch=True)
        client.tell("publish", topic="/kept", msg={"data": "old"}, latch=True)
        client.settled()
        _, got = self.listener("/kept", String)
        wait_until(lambda: [m.data for m in got] == ["old"], "the latched message")

    def test_ids_of_advertisements(self):
        subscriber, _ = self.listener("/twice", String)
        client = self.client()
        for number in ("a", "b"):
            client.tell("advertise", topic="/twice", type="std_msgs/String", id=number)
        client.tell("unadvertise", topic="/twice", id="a")
        client.settled()
        wait_until(lambda: connected(subscriber))
        never(lambda: not connected(subscriber), "the end of the publisher", 1.0)  # an unused one stays for half of that
        client.tell("unadvertise", topic="/twice", id="b")
        gone(self, subscriber, "the end of the publisher")

    def test_headers_times_and_bytes(self):
        _, points = self.listener("/points", PointStamped)
        _, headers = self.listener("/headers", TestHeaderArray)
        _, arrays = self.listener("/arrays", TestUInt8FixedSizeArray16)
        client = self.client()
        before = rospy.Time.now()
        client.tell("publish", topic="/points", msg={"header": {"frame_id": "map"}, "point": {"x": 1}})
        client.tell("publish", topic="/points", msg={"header": {"stamp": {"secs": 12, "nsecs": 34}}})
        client.tell("publish", topic="/points", msg={"header": {"stamp": "now"}})
        client.tell("publish", topic="/headers", msg={"header": [{"stamp": {"secs": 1, "nsecs": 2}}, {"frame_id": "b"}]})
        client.tell("publish", topic="/arrays", msg={"data": base64.b64encode(bytes(range(16))).decode()})
        client.tell("publish", topic="/arrays", msg={"data": list(range(16))})
        wait_until(lambda: len(points) == 3 and headers and len(arrays) == 2, "all of them")
        self.assertLessEqual(before, points[0].header.stamp)
        self.assertEqual(points[1].header.stamp, rospy.Time(12, 34))
        self.assertLessEqual(before, points[2].header.stamp)
        self.assertEqual(headers[0].header[0].stamp, rospy.Time(1, 2))
        self.assertEqual([m.data for m in arrays], [bytes(range(16))] * 2)


class Subscribing(Case):
    def test_a_topic_and_its_end(self):
        publisher = self.publisher("/numbers", Float64)
        client = self.client()
        client.tell("subscribe", topic="/numbers", type="std_msgs/Float64")
        wait_until(lambda: connected(publisher))
        for number in range(5):
            publisher.publish(number / 4)
        client.wait(lambda: len(client.heard("/numbers")) == 5, "five messages")
        self.assertEqual(client.heard("/numbers"), [{"data": number / 4} for number in range(5)])
        client.tell("unsubscribe", topic="/numbers")
        gone(self, publisher, "the bridge to listen no more")

    def test_ids_of_subscriptions(self):
        publisher = self.publisher("/by_ids", Float64)
        client = self.client()
        for number in ("a", "b"):
            client.tell("subscribe", topic="/by_ids", id=number)  # the type is the topic's
        wait_until(lambda: connected(publisher))
        client.tell("unsubscribe", topic="/by_ids", id="a")
        client.settled()
        publisher.publish(1.0)
        client.wait(lambda: client.heard("/by_ids") == [{"data": 1.0}], "one message, once")
        client.tell("unsubscribe", topic="/by_ids", id="b")
        gone(self, publisher, "the bridge to listen no more")

    def test_latched_for_whoever_comes(self):
        publisher = self.publisher("/latched", String, latch=True)
        publisher.publish("once")
        for _ in range(3):
            client = self.client()
            client.tell("subscribe", topic="/latched")
            client.wait(lambda client=client: client.heard("/latched") == [{"data": "once"}], "the latched message")

    def test_latched_for_each_subscription_of_a_client(self):
        """MultiSubscriber.subscribe of rosbridge_library hands it over whenever the client subscribes."""
        publisher = self.publisher("/latched_again", String, latch=True)
        publisher.publish("kept")
        client = self.client()

        def times(count):
            client.wait(lambda: len(client.heard("/latched_again")) >= count, f"the latched message, {count} times")
            client.settled(f"settled {count}")
            self.assertEqual(client.heard("/latched_again"), [{"data": "kept"}] * count)

        client.tell("subscribe", topic="/latched_again", id="a", throttle_rate=60000)
        times(1)
        client.tell("subscribe", topic="/latched_again", id="b", throttle_rate=60000)
        times(2)
        client.tell("subscribe", topic="/latched_again", id="b", type="std_msgs/String")
        times(3)
        client.tell("unsubscribe", topic="/latched_again", id="a")
        client.tell("subscribe", topic="/latched_again", id="a")
        times(4)
        client.tell("unsubscribe", topic="/latched_again")
        client.tell("subscribe", topic="/latched_again", id="a", queue_length=1)
        times(5)
        client.tell("subscribe", topic="/latched_again", id="c", type="std_msgs/Int32")
        client.complaint("/latched_again has messages of the type std_msgs/String")
        client.tell("subscribe", topic="/latched_again", id="d", compression="cbor", queue_length=2)
        times(6)
        self.assertTrue(any(isinstance(frame, bytes) for frame in client.frames), "it comes in the form that is asked for last")

    def test_what_cannot_be_subscribed(self):
        self.publisher("/typed", String)
        client = self.client()
        for fields, said in (
            ({"topic": "/not_there"}, "nobody publishes or reads /not_there"),
            ({"type": "std_msgs/Int32"}, "/typed has messages of the type std_msgs/String, not std_msgs/Int32"),
            ({"type": "no_such/Type"}, "no package here defines"),
            ({"compression": "zip"}, "no compression 'zip'"),
            ({"throttle_rate": -1}, "throttle_rate is -1"),
            ({"queue_length": "x"}, "'queue_length' should be a whole"),
            ({"fragment_size": -5}, "fragment_size is -5"),
            ({"topic": 7}, "field 'topic' should be a text, not 7"),
        ):
            client.tell("subscribe", **{"topic": "/typed", **fields})
            client.complaint("subscribe: ", said)

    def test_what_json_has_not(self):
        publisher = self.publisher("/scan", LaserScan)
        client = self.client()
        client.tell("subscribe", topic="/scan")
        wait_until(lambda: connected(publisher))
        publisher.publish(LaserScan(ranges=[1.0, float("inf"), float("nan"), -float("inf")], range_max=float("inf")))
        client.wait(lambda: client.heard("/scan"), "the scan")
        found = client.heard("/scan")[0]
        self.assertEqual(
            (found["ranges"], found["range_max"], found["header"]["stamp"]), ([1.0, None, None, None], None, {"secs": 0, "nsecs": 0})
        )

    def test_throttled(self):
        """A message at once, and then the first that comes 300 ms later."""
        publisher = self.publisher("/fast", Int32)
        client = self.client()
        client.tell("subscribe", topic="/fast", throttle_rate=300)
        wait_until(lambda: connected(publisher))
        begin = time.monotonic()
        for number in range(50):
            publisher.publish(number)
            rospy.sleep(0.02)
        took = time.monotonic() - begin
        client.settled()
        heard = [m["data"] for m in client.heard("/fast")]
        self.assertEqual(heard[0], 0)
        self.assertTrue(2 <= len(heard) <= took / 0.3 + 1, heard)

    def test_queued(self):
        """What comes too fast waits, the newest three."""
        publisher = self.publisher("/burst", Int32)
        client = self.client()
        client.tell("subscribe", topic="/burst", throttle_rate=400, queue_length=3)
        wait_until(lambda: connected(publisher))
        for number in range(20):
            publisher.publish(number)
        client.wait(lambda: client.heard("/burst")[-1:] == [{"data": 19}], "the last of them")
        heard = [m["data"] for m in client.heard("/burst")]
        self.assertEqual(heard[-3:], [17, 18, 19])
        self.assertLessEqual(len(heard), 5)

    def test_cbor(self):
        publisher = self.publisher("/odom", Odometry)
        image = self.publisher("/image", Image)
        client = self.client()
        client.tell("subscribe", topic="/odom", compression="cbor")
        client.tell("subscribe", topic="/image", compression="cbor")
        wait_until(lambda: connected(publisher) and connected(image))
        message = Odometry(child_frame_id="base")
        message.pose.covariance = [n / 8 for n in range(36)]
        message.header.stamp = rospy.Time(3, 4)
        publisher.publish(message)
        image.publish(Image(data=bytes(range(200))))
        client.wait(lambda: client.heard("/odom") and client.heard("/image"), "both")
        odom = client.heard("/odom")[0]
        self.assertEqual((odom["child_frame_id"], odom["header"]["stamp"]), ("base", {"secs": 3, "nsecs": 4}))
        self.assertEqual(
            (odom["pose"]["covariance"].tag, struct.unpack("<36d", odom["pose"]["covariance"].value)), (86, tuple(n / 8 for n in range(36)))
        )
        self.assertEqual(client.heard("/image")[0]["data"], bytes(range(200)))
        self.assertTrue(all(isinstance(frame, bytes) for frame in client.frames))

    def test_cbor_raw_beside_json(self):
        """The bytes of ROS as they are, and the time at which they came; another client has the same topic as JSON."""
        publisher = self.publisher("/raw", String)
        raw, words = self.client(), self.client()
        raw.tell("subscribe", topic="/raw", compression="cbor-raw")
        wait_until(lambda: connected(publisher))
        words.tell("subscribe", topic="/raw")
        words.settled()
        publisher.publish("grüße")
        out = io.BytesIO()
        String("grüße").serialize(out)
        found = raw.wait(lambda: raw.heard("/raw"), "the bytes")[0]
        self.assertEqual(found["bytes"], out.getvalue())
        self.assertLess(abs(found["secs"] + found["nsecs"] / 1e9 - rospy.get_time()), 30)
        words.wait(lambda: words.heard("/raw") == [{"data": "grüße"}], "the words")

    def test_png(self):
        publisher = self.publisher("/map_like", UInt8MultiArray)
        client = self.client()
        client.tell("subscribe", topic="/map_like", compression="png")
        wait_until(lambda: connected(publisher))
        publisher.publish(UInt8MultiArray(data=bytes(10000)))
        packed = client.wait(lambda: client.ops("png"), "the picture")[0]["data"]
        self.assertLess(len(packed), 2000)
        self.assertEqual(json.loads(pngcompression.decode(packed))["msg"]["data"], base64.b64encode(bytes(10000)).decode())

    def test_fragments(self):
        publisher = self.publisher("/long", String)
        client = self.client()
        client.tell("subscribe", topic="/long", fragment_size=100)
        wait_until(lambda: connected(publisher))
        publisher.publish("ü" * 300)
        parts = client.wait(
            lambda: len(client.ops("fragment")) == (client.ops("fragment") or [{"total": 1}])[0]["total"] and client.ops("fragment"),
            "all fragments",
        )
        self.assertEqual([part["num"] for part in parts], list(range(parts[0]["total"])))
        self.assertTrue(all(len(part["data"]) <= 100 and part["id"] == parts[0]["id"] for part in parts))
        self.assertEqual(
            json.loads("".join(part["data"] for part in parts)), {"op": "publish", "topic": "/long", "msg": {"data": "ü" * 300}}
        )


class Calling(Case):
    def test_arguments_in_order_by_name_and_none(self):
        service = rospy.Service("/add", AddTwoInts, lambda request: request.a + request.b)
        self.addCleanup(service.shutdown)
        client = self.client()
        for args, total in (([3, 4], 7), ({"b": 5, "a": 1}, 6), ({"b": 5}, 5), ([], 0), (None, 0)):
            answer = client.call("/add", f"{args}", args=args)
            self.assertEqual((answer["values"], answer["result"], answer["service"]), ({"sum": total}, True, "/add"))
        client.tell("call_service", service="/add#33", args=[1, 1])  # as old pages write an id
        client.wait(lambda: client.ops("service_response", id="33", service="/add#33", values={"sum": 2}), "the answer")

    def test_nested(self):
        service = rospy.Service(
            "/nested", TestNestedService, lambda request: TestNestedServiceResponse(Float64(request.pose.position.x * 2))
        )
        self.addCleanup(service.shutdown)
        self.assertEqual(self.client().call("/nested", args={"pose": {"position": {"x": 1.5}}})["values"], {"data": {"data": 3.0}})

    def test_a_large_answer_in_fragments_and_packed(self):
        service = rospy.Service("/speech", Trigger, lambda request: (True, "word " * 500))
        self.addCleanup(service.shutdown)
        client = self.client()
        client.tell("call_service", service="/speech", id="f", fragment_size=1000)
        parts = client.wait(lambda: len(client.ops("fragment")) == 3 and client.ops("fragment"), "three fragments")
        self.assertEqual(json.loads("".join(part["data"] for part in parts))["values"]["message"], "word " * 500)
        client.tell("call_service", service="/speech", id="p", compression="png")
        packed = client.wait(lambda: client.ops("png"), "the picture")[0]["data"]
        self.assertEqual(json.loads(pngcompression.decode(packed))["id"], "p")
        self.assertTrue(client.call("/speech", "c", compression="cbor")["result"])
        self.assertIsInstance(client.frames[-1], bytes)

    def test_what_fails(self):
        def refuse(request):
            raise rospy.ServiceException("not today")

        service = rospy.Service("/refuse", SetBool, refuse)
        self.addCleanup(service.shutdown)
        client = self.client()
        for name, args, said in (
            ("/no_such", [], "there is no service /no_such"),
            ("/refuse", [True], "not today"),
            ("/refuse", [1], "data should be bool"),
            ("/refuse", {"x": 1}, "has no field x; there is data"),
            ("/refuse", [True, 2], "/refuse takes 1 arguments, not 2"),
        ):
            answer = client.call(name, f"{name} {args}", args=args)
            self.assertEqual(answer["result"], False)
            self.assertIn(said, answer["values"])

    def test_a_slow_service_does_not_stop_the_client(self):
        go = threading.Event()
        service = rospy.Service("/slow", Trigger, lambda request: (go.wait(30), "done"))
        self.addCleanup(service.shutdown)
        client = self.client()
        client.tell("call_service", service="/slow", id="slow")
        self.assertTrue(client.call("/rosapi/get_time", "quick")["result"])
        self.assertFalse(client.ops("service_response", id="slow"))
        go.set()
        client.wait(lambda: client.ops("service_response", id="slow", result=True), "the slow answer")


class Offering(Case):
    def offered(self, name, kind="std_srvs/SetBool"):
        client = self.client()
        client.tell("advertise_service", service=name, type=kind)
        rospy.wait_for_service(name, 20)
        return client

    def ask(self, client, name, kind=SetBool, *args):
        """Call it in a thread; the request that the client gets, and what came out once it is there."""
        out = []

        def call():
            try:
                out.append(rospy.ServiceProxy(name, kind)(*args))
            except rospy.ServiceException as error:
                out.append(str(error))

        before = len(client.ops("call_service"))
        threading.Thread(target=call, daemon=True).start()
        request = client.wait(lambda: client.ops("call_service")[before:], "the request")[0]
        return request, out

    def test_a_page_answers(self):
        client = self.offered("/page_switch")
        request, out = self.ask(client, "/page_switch", SetBool, True)
        self.assertEqual((request["service"], request["args"]), ("/page_switch", {"data": True}))
        client.tell("service_response", service="/page_switch", id=request["id"], values={"success": True, "message": "on"}, result=True)
        wait_until(lambda: out == [SetBoolResponse(True, "on")], "the answer")

    def test_a_page_that_fails_or_answers_wrongly(self):
        client = self.offered("/page_fails")
        for fields, said in (
            ({"result": False, "values": {"message": "no"}}, "the client says that it failed"),
            ({"result": True, "values": {"success": 5}}, "success should be bool"),
            ({"values": {"success": True}}, "the response needs a field 'result'"),
        ):
            request, out = self.ask(client, "/page_fails", SetBool, True)
            client.tell("service_response", service="/page_fails", id=request["id"], **fields)
            wait_until(lambda out=out: out and said in out[0], said)  # noqa: B023
        client.tell("service_response", service="/page_fails", id="nobody", result=True)
        client.complaint("service_response: /page_fails: there is no request with the id 'nobody'")

    def test_unadvertised_with_a_request_under_way(self):
        client = self.offered("/page_ends")
        _, out = self.ask(client, "/page_ends", SetBool, True)
        client.tell("unadvertise_service", service="/page_ends")
        wait_until(lambda: out and "unadvertised" in out[0], "the caller's error")
        client.tell("unadvertise_service", service="/page_ends")
        client.complaint("you do not offer a service /page_ends")

    def test_gone_with_a_request_under_way(self):
        client = self.offered("/page_leaves")
        _, out = self.ask(client, "/page_leaves", SetBool, True)
        client.socket.close()
        wait_until(lambda: out and "gone" in out[0], "the caller's error")
        wait_until(lambda: not any(name == "/page_leaves" for name, _ in rosgraph.Master(rospy.get_name()).getSystemState()[2]))

    def test_the_last_that_offers_it_has_it(self):
        first = self.offered("/page_twice")
        second = self.offered("/page_twice")
        second.settled()
        request, out = self.ask(second, "/page_twice", SetBool, False)
        first.tell("service_response", service="/page_twice", id=request["id"], values={}, result=True)
        first.complaint("you do not offer a service /page_twice")
        first.socket.close()
        second.tell("service_response", service="/page_twice", id=request["id"], values={"success": True}, result=True)
        wait_until(lambda: out == [SetBoolResponse(True, "")], "the answer")

    def test_what_cannot_be_offered(self):
        client = self.client()
        for fields, said in (
            ({"service": "/x"}, "a field 'type' is missing"),
            ({"service": None, "type": "std_srvs/SetBool"}, "should be a text"),
            ({"service": "/x", "type": "no_such/Type"}, "no package here defines the service no_such/Type"),
        ):
            client.tell("advertise_service", **fields)
            client.complaint("advertise_service: ", said)


class Protocol(Publishing, Subscribing, Calling, Offering):
    """All of it."""


if __name__ == "__main__":
    rospy.init_node("protocol_rostest")
    rostest.rosrun("rosbridge_server", "protocol", Protocol)
