#!/usr/bin/env python3
"""Who may connect, and what is open to them: patterns, codes, tokens, TLS, addresses that are taken; and BSON."""

import hashlib
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import bson
import rospy
import rostest
from rosauth.srv import Authentication
from sensor_msgs.msg import Image
from std_msgs.msg import Float64, String
from test_support.network import free_port
from test_support.waiting import wait_until
from websockets.exceptions import ConnectionClosed, InvalidStatus

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from talking import PATIENCE, Client, connected  # noqa: E402

NARROW, CODED = 29091, 29092
SECRET = "abcdefghijklmnop"


def mac(now, level="any", end=None, secret=SECRET):
    """What upstream's README says how a client makes it: SHA-512 of secret, client, dest, rand, t, level, end."""
    end = now + 60 if end is None else end
    code = hashlib.sha512(f"{secret}127.0.0.1127.0.0.1random{now}{level}{end}".encode()).hexdigest()
    return {"mac": code, "client": "127.0.0.1", "dest": "127.0.0.1", "rand": "random", "t": now, "level": level, "end": end}


class Doors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.wait_for_service("/rosapi/get_time", 60)  # the last of them

    def server(self, *words):
        """A server of its own; its process, with what it prints in ``lines``."""
        process = subprocess.Popen(
            ["rosrun", "rosbridge_server", "rosbridge_websocket", *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        self.addCleanup(process.kill)
        return process

    def closed(self, client):
        """Reason of the server."""
        with self.assertRaises(ConnectionClosed) as end:
            client.wait(lambda: False, "", PATIENCE)
        self.assertEqual(end.exception.rcvd.code, 1008)
        return end.exception.rcvd.reason

    # ------------------------------------------------------------------------------------------ patterns

    def test_patterns(self):
        publisher = rospy.Publisher("/open/numbers", Float64, queue_size=10)
        hidden = rospy.Publisher("/closed", String, queue_size=10)
        client = Client(self, NARROW)
        client.tell("subscribe", topic="/open/numbers")
        wait_until(lambda: connected(publisher))
        publisher.publish(1.0)
        client.wait(lambda: client.heard("/open/numbers"), "the number")
        for op, fields, said in (
            ("subscribe", {"topic": "/closed"}, "topics_glob"),
            ("advertise", {"topic": "/closed", "type": "std_msgs/String"}, "topics_glob"),
            ("publish", {"topic": "/closed", "msg": {}}, "topics_glob"),
            ("advertise_service", {"service": "/closed", "type": "std_srvs/Trigger"}, "services_glob"),
        ):
            client.tell(op, **fields)
            client.complaint(op, f"~{said} does not allow /closed")
        self.assertFalse(hidden.get_num_connections())
        answer = client.call("/closed_service")
        self.assertEqual((answer["result"], answer["values"]), (False, "~services_glob does not allow /closed_service"))
        self.assertIn("there is no service /open_service", client.call("/open_service", "o")["values"])
        self.assertTrue(client.call("/rosapi/topics", "t")["result"])  # always open

    # ------------------------------------------------------------------------------------------ BSON

    def test_bson(self):
        port = wait_until(lambda: rospy.get_param("/binary/rosbridge_websocket/actual_port", None), "the port")
        publisher = rospy.Publisher("/picture", Image, queue_size=10)
        client = Client(self, port, decode=bson.decode, encode=bson.encode)
        client.tell("subscribe", topic="/picture")
        wait_until(lambda: connected(publisher))
        publisher.publish(Image(width=5, data=bytes(range(100))))
        client.wait(lambda: client.heard("/picture"), "the picture")
        self.assertEqual((client.heard("/picture")[0]["data"], client.heard("/picture")[0]["width"]), (bytes(range(100)), 5))
        publisher.publish(Image(width=6, data=bytes(2000)))  # longer than max_message_size
        parts = client.wait(
            lambda: (
                len(client.ops("fragment")) > 1
                and len(client.ops("fragment")) == client.ops("fragment")[0]["total"]
                and client.ops("fragment")
            ),
            "the fragments",
        )
        self.assertEqual(bson.decode(b"".join(part["data"] for part in parts))["msg"]["data"], bytes(2000))
        got = []
        subscriber = rospy.Subscriber("/sent_picture", Image, got.append)
        client.tell("advertise", topic="/sent_picture", type="sensor_msgs/Image")
        wait_until(lambda: connected(subscriber))
        client.tell("publish", topic="/sent_picture", msg={"data": bytes(range(50))})
        wait_until(lambda: [m.data for m in got] == [bytes(range(50))], "the picture")
        whole = bson.encode({"op": "publish", "topic": "/sent_picture", "msg": {"height": 9}})
        for place in (1, 0):
            client.tell("fragment", id="x", num=place, total=2, data=whole[place * 20 : (place + 1) * 20 if place == 0 else None])
        wait_until(lambda: got[-1].height == 9, "the picture in two parts")
        client.socket.send(b"no bson")
        client.complaint("are no BSON")

    # ------------------------------------------------------------------------------------------ codes and tokens

    def test_codes(self):
        rospy.wait_for_service("/coded/authenticate", 30)
        now = int(time.time())
        for fields, said in (
            (mac(now, secret="wrong wrong wron"), "no valid"),
            (mac(now - 30), "no valid"),
            (mac(now, end=now - 1), "no valid"),
            ({**mac(now), "level": "more"}, "no valid"),
            ({"mac": ""}, "a field 'client' is missing"),
            ({**mac(now), "t": "x"}, "auth: "),
        ):
            client = Client(self, CODED)
            client.tell("auth", **fields)
            self.assertIn(said, self.closed(client))
        client = Client(self, CODED)
        client.tell("advertise", topic="/from_stranger", type="std_msgs/String")
        self.assertIn("authenticate first", self.closed(client))
        client = Client(self, CODED)
        client.tell("auth", **mac(int(time.time())))
        self.assertTrue(client.call("/rosapi/get_time")["result"])
        client.tell("auth", **mac(0))  # known is known
        self.assertTrue(client.call("/rosapi/get_time", "again")["result"])

    def test_definition(self):
        self.assertEqual(Authentication._md5sum, "0297b5bdd9c066699bfaf0157aad17e7")

    def test_tokens(self):
        port = free_port()
        with tempfile.NamedTemporaryFile("w") as file:
            file.write("open sesame\n")
            file.flush()
            self.server("--port", str(port), "--token_file", file.name, "__name:=with_token")
            client = Client(self, port, "?token=open%20sesame")
            self.assertTrue(client.call("/rosapi/get_time")["result"])
        for query in ("", "?token=", "?token=open"):
            self.assertIn("?token=...", self.closed(Client(self, port, query)))

    def test_pages_of_files(self):
        port = free_port()
        self.server("--port", str(port), "__name:=no_files", "_websocket_null_origin:=false")
        Client(self, port)
        with self.assertRaises(InvalidStatus) as refused:
            Client(self, port, origin="null")
        self.assertEqual(refused.exception.response.status_code, 403)
        Client(self, port, origin="http://some.where")
        Client(self, NARROW, origin="null")

    # ------------------------------------------------------------------------------------------ TLS and addresses

    def test_tls(self):
        import ssl

        port = free_port()
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [
                    "openssl",
                    "req",
                    "-x509",
                    "-newkey",
                    "rsa:2048",
                    "-nodes",
                    "-subj",
                    "/CN=localhost",
                    "-days",
                    "2",
                    "-keyout",
                    f"{folder}/key",
                    "-out",
                    f"{folder}/cert",
                ],
                check=True,
                capture_output=True,
            )
            self.server("--port", str(port), "--certfile", f"{folder}/cert", "--keyfile", f"{folder}/key", "__name:=with_tls")
            context = ssl.create_default_context(cafile=f"{folder}/cert")
            self.assertTrue(Client(self, port, ssl=context, server_hostname="localhost").call("/rosapi/get_time")["result"])

    def test_a_port_that_is_taken_is_tried_again(self):
        with socket.socket() as other:
            other.bind(("127.0.0.1", 0))
            other.listen()
            port = other.getsockname()[1]
            process = self.server("--port", str(port), "--retry_startup_delay", "0.3", "__name:=patient")
            for line in process.stdout:
                if "Unable to start server" in line:
                    break
            self.assertIn(f"127.0.0.1 port {port} cannot be listened on: Address already in use", line)
        self.assertTrue(Client(self, port).call("/rosapi/get_time")["result"])

    def test_only_this_machine_is_listened_to(self):
        """All of 127/8 is this machine; what listens on 127.0.0.1 alone does not have the others, as it has not the network's."""
        Client(self, NARROW)
        with self.assertRaises(OSError):
            socket.create_connection(("127.0.0.2", NARROW), 5)
        port = free_port()
        self.server("--port", str(port), "--address", "0.0.0.0", "__name:=everywhere")
        Client(self, port)
        socket.create_connection(("127.0.0.2", port), 5).close()

    def test_what_cannot_be_used_is_one_line(self):
        for words, said in (
            (["--port", "ninety"], "port should be a whole number, not 'ninety'"),
            (["--port", "99999"], "out of range"),
            (["--certfile", "/no/such", "--keyfile", "/no/such"], "No such file"),
            (["--certfile", "x"], "give both, or none"),
            (["--token_file", "/no/such"], "token_file: /no/such cannot be read"),
            (["_topics_glob:=5"], "list of patterns"),
        ):
            process = self.server(*words, "__name:=wrong")
            out, _ = process.communicate(timeout=60)
            self.assertEqual(process.returncode, 1, out)
            lines = [line for line in out.splitlines() if "FATAL" in line]
            self.assertTrue(len(lines) == 1 and said in lines[0], out)
            self.assertNotIn("Traceback", out)

    def test_it_ends_at_once(self):
        port = free_port()
        process = self.server("--port", str(port), "__name:=ends")
        client = Client(self, port)
        client.tell("subscribe", topic="/rosout", queue_length=2)
        client.settled()
        for child in [process.pid]:
            os.kill(child, signal.SIGINT)
        out, _ = process.communicate(timeout=10)
        self.assertNotIn("Traceback", out)
        self.assertNotIn("Exception", out)


if __name__ == "__main__":
    rospy.init_node("doors_rostest")
    rostest.rosrun("rosbridge_server", "doors", Doors)
