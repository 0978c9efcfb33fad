#!/usr/bin/env python3
"""What one client is told and what it cannot do to others."""

import json
import os
import socket
import sys
import time

import rosgraph
import rospy
import rostest
from rosbridge_msgs.msg import ConnectedClients
from sensor_msgs.msg import Image
from std_msgs.msg import Int32, String
from test_support.waiting import wait_until

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talking import Case, connected, gone  # noqa: E402


class Connection(Case):
    def test_fragments_of_a_client_in_any_order(self):
        _, got = self.listener("/cut", String)
        client = self.client()
        text = json.dumps({"op": "publish", "topic": "/cut", "msg": {"data": 'a{"op": 1}' * 50}})
        parts = [text[place : place + 99] for place in range(0, len(text), 99)]
        for place in reversed(range(len(parts))):
            client.tell("fragment", id="m", num=place, total=len(parts), data=parts[place])
        wait_until(lambda: [m.data for m in got] == ['a{"op": 1}' * 50], "the message")
        for fields, said in (
            ({"num": 0, "total": 2}, "a field 'data' is missing"),
            ({"num": 2, "total": 2, "data": ""}, "from 0 to 1"),
            ({"num": 0, "total": "x", "data": ""}, "'total' should be a whole number"),
        ):
            client.tell("fragment", id="bad", **fields)
            client.complaint("fragment: ", said)

    def test_fragments_that_come_too_late(self):
        client = self.client()
        client.tell("set_level", level="warning")
        client.tell("fragment", id="late", num=0, total=2, data="{")
        client.settled()

        def complained():
            """What came in time is looked at when the next fragment comes."""
            client.tell("fragment", id="other", num=0, total=2, data="{")
            return any("the fragments of late took more than 1 s" in status["msg"] for status in client.ops("status"))

        client.wait(complained, "the complaint")  # after the launch file's fragment_timeout

    def test_levels(self):
        self.publisher("/levelled", String)
        client = self.client()
        client.tell("subscribe", topic="/levelled", id="quiet")
        client.settled()
        self.assertFalse(client.ops("status", level="info"))
        client.tell("set_level", level="info")
        client.tell("subscribe", topic="/levelled", id="loud")
        client.wait(lambda: client.ops("status", level="info", id="loud"), "the word")
        client.tell("set_level", level="none")
        client.tell("no_such_operation", id="unheard")
        self.assertTrue(client.call("/rosapi/get_time")["result"])
        self.assertFalse(client.ops("status", id="unheard"))
        client.tell("set_level", level="error")
        client.tell("set_level", level="loud")
        client.complaint("there is no level 'loud'; there are none, error, warning, info")

    def test_bad_words_leave_it_running(self):
        client = self.client()
        for frame, said in (
            ("no json", "is no JSON"),
            (b"\xff\xfe", "is no JSON"),
            ("[" * 100000, "is no JSON"),
            ("[]", "field 'op'"),
            ("5", "field 'op'"),
            ("{}", "field 'op'"),
            ('{"op": 5}', "no operation 5"),
            ('{"op": "fly"}', "no operation 'fly'"),
            ('{"op": "png", "data": "AAAA"}', "no picture"),
            ('{"op": "publish"}', "a field 'topic' is missing"),
        ):
            client.told.clear()
            client.socket.send(frame)
            client.complaint(said)
        client.socket.send(
            '{"op": "set_level", "level": "info"} {"op": "advertise_service", "service": "/two", "type": "std_srvs/Trigger"}'
        )
        client.complaint("advertised service /two")

    def test_a_client_that_leaves_takes_all_with_it(self):
        publisher = self.publisher("/for_leaver", String)
        subscriber, _ = self.listener("/from_leaver", String)
        client = self.client()
        client.tell("subscribe", topic="/for_leaver")
        client.tell("subscribe", topic="/for_leaver", id="queued", queue_length=5, throttle_rate=1000)
        client.tell("advertise", topic="/from_leaver", type="std_msgs/String")
        client.tell("advertise_service", service="/of_leaver", type="std_srvs/Trigger")
        wait_until(lambda: connected(publisher) and connected(subscriber))
        rospy.wait_for_service("/of_leaver", 20)
        client.socket.socket.shutdown(socket.SHUT_RDWR)  # as when a cable is pulled
        gone(self, publisher, "the bridge to listen no more")
        gone(self, subscriber, "the end of the publisher")
        wait_until(lambda: not any(name == "/of_leaver" for name, _ in rosgraph.Master(rospy.get_name()).getSystemState()[2]))

    def test_who_is_connected(self):
        _, counts = self.listener("/client_count", Int32)
        _, lists = self.listener("/connected_clients", ConnectedClients)
        wait_until(lambda: counts and counts[-1].data == 0 and lists, "nobody")
        client = self.client()
        wait_until(lambda: counts[-1].data == 1 and [c.ip_address for c in lists[-1].clients] == ["127.0.0.1"], "one client")
        client.socket.close()
        wait_until(lambda: counts[-1].data == 0 and not lists[-1].clients, "nobody")

    def test_a_client_that_does_not_read_stops_nobody(self):
        """Its messages are dropped, the newest last; what is latched and what it asked for comes when it reads again."""
        publisher = self.publisher("/big", Image)
        latched = self.publisher("/small_latched", String, latch=True)
        latched.publish("still here")
        lazy = self.client()
        lazy.tell("subscribe", topic="/small_latched")
        lazy.tell("subscribe", topic="/big", compression="cbor")
        other = self.client()
        other.tell("subscribe", topic="/big", compression="cbor", throttle_rate=0)
        wait_until(lambda: connected(publisher))
        lazy.settled()
        other.settled()
        for number in range(120):  # 240 MB, far more than what may wait
            publisher.publish(Image(height=number, data=bytes(2000000)))
            other.wait(lambda number=number: other.heard("/big") and other.heard("/big")[-1]["height"] == number, f"picture {number}")
            other.frames.clear()
        lazy.wait(lambda: lazy.heard("/big") and lazy.heard("/big")[-1]["height"] == 119, "the last picture", 60)
        self.assertLess(len(lazy.heard("/big")), 60)
        self.assertEqual(lazy.heard("/small_latched"), [{"data": "still here"}])


if __name__ == "__main__":
    rospy.init_node("connection_rostest")
    rostest.rosrun("rosbridge_server", "connection", Connection)
