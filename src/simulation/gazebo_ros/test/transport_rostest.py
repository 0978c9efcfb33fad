#!/usr/bin/env python3
"""Gazebo's transport between processes: gz topic, a program that is its client, and bytes by hand, against whole servers."""

import importlib.util
import math
import os
import random
import re
import socket
import struct
import subprocess
import sys
import tempfile
import unittest

import rospy
import rostest
import test_support
from gazebo_wire import Wire, field, fields
from std_msgs.msg import String

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from compiled_rostest import URDF  # noqa: E402
from processes import Server  # noqa: E402

WORLD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worlds", "compiled.world")
RAY = """<sdf version="1.6"><model name="post"><static>1</static><link name="l"><sensor name="eye" type="ray"><update_rate>50</update_rate>
<ray><scan><horizontal><samples>3</samples><min_angle>-0.5</min_angle><max_angle>0.5</max_angle></horizontal></scan>
<range><min>0.1</min><max>5</max></range></ray></sensor></link></model></sdf>"""


def free_port():
    """Of the first that is free among those that the system gives to nobody by itself."""
    for port in random.sample(range(15000, 30000), 100):
        with socket.socket() as place:
            try:
                place.bind(("", port))
            except OSError:
                continue
            return port
    raise RuntimeError("no free port")


def doubles(message):
    """All floating-point numbers of a message, in its messages' order: each is a field of 8 bytes."""
    found, at = [], 0
    while at < len(message):
        tag, at = message[at], at + 1
        if tag & 7 == 1:
            found.append(struct.unpack("<d", message[at : at + 8])[0])
            at += 8
        elif tag & 7 == 2:
            size, at = message[at], at + 1
            found += doubles(message[at : at + size])
            at += size
        else:
            while message[at] > 127:
                at += 1
            at += 1
    return found


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class TransportTest(test_support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.port = free_port()
        cls.server = Server("near", "-u", WORLD, environment={"GAZEBO_MASTER_URI": f"http://localhost:{cls.port}"})
        cls.sim = cls.server.simulator()

    @classmethod
    def tearDownClass(cls):
        with cls.server:
            cls.server.end()

    def setUp(self):
        self.sim.clear()

    def gz(self, *words, port=None):
        environment = {**os.environ, "GAZEBO_MASTER_URI": f"http://localhost:{port or self.port}"}
        return subprocess.run(["gz", "topic", *words], env=environment, text=True, capture_output=True, timeout=60)

    def stranger(self, *words):
        process = subprocess.Popen(
            ["rosrun", "gazebo_ros", "gazebo_ros_test_stranger", *words],
            env=self.server.environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(lambda: process.poll() is None and os.killpg(process.pid, 9))
        return process

    def wire(self):
        """A connection to the master that has been greeted, and the three packets of that."""
        wire = Wire(self.port)
        self.addCleanup(wire.close)
        return wire, [wire.packet() for _ in range(3)]

    def address(self, topic):
        """(type, port) of the publisher of a topic, as the master says."""
        wire, _ = self.wire()
        wire.tell("request", field(1, 1) + field(2, "topic_info") + field(3, topic))
        publisher = fields(fields(wire.packet("topic_info_response")[1])[2][0])
        self.assertEqual(publisher[1], [topic.encode()])
        return publisher[2][0].decode(), publisher[4][0]

    def listen(self, topic, latching=0, receive_buffer=0):
        """A connection on which the messages of a topic come."""
        kind, port = self.address(topic)
        wire = Wire(port, receive_buffer)
        self.addCleanup(wire.close)
        wire.tell("sub", field(1, topic) + field(2, "127.0.0.1") + field(3, 1) + field(4, kind) + field(5, latching))
        self.address(topic)  # who answers this has read the line before: what is sent from now on is heard
        return wire

    def test_a_program_hears_the_simulator_and_its_plugin(self):
        process = self.stranger("hear")
        lines = iter(process.stdout.readline, "")
        self.assertEqual(next(lines), "listening\n")
        self.assertRegex(next(line for line in lines if line.startswith("stats")), r"stats \d+ paused")
        orders = rospy.Publisher("/near/keeper/orders", String, queue_size=10)
        test_support.wait_until(orders.get_num_connections)
        orders.publish("go 4")
        self.assertEqual(next(line for line in lines if line.startswith("go")), "go 4\n")
        before = self.sim.world().sim_time
        self.sim.empty("unpause_physics")
        self.assertRegex(next(line for line in lines if "paused" not in line), r"stats \d+")
        self.sim.empty("pause_physics")
        self.assertGreater(self.sim.world().sim_time, before)

    def test_a_program_drives_a_plugin(self):
        self.assertTrue(self.sim.spawn("arm", URDF.format(library="worker", more=""), kind="urdf").success)
        process = self.stranger("say", "3")
        self.assertEqual(process.communicate(timeout=60)[0], "")
        self.assertEqual(process.returncode, 0)

        def turns():
            self.sim.step(1)
            return self.sim.joint("elbow").rate[0] > 0.1

        test_support.wait_until(turns)

    def test_gz_topic(self):
        self.assertTrue(self.sim.spawn("post", RAY).success)
        names = self.gz("-l").stdout.split()
        scan = "/gazebo/compiled/post/l/eye/scan"
        for name in ("pose/info", "world_stats", "physics/contacts", "model/info", "factory", "world_control", "go"):
            self.assertIn("/gazebo/compiled/" + name, names)
        self.assertIn(scan, names)
        self.assertRegex(self.gz("-i", "~/go").stdout, r"Type: gazebo.msgs.Int\n\nPublishers:\n\t[\d.]+:\d+\n\nSubscribers:\n")
        self.assertIn("paused: true", self.gz("-e", "~/world_stats", "-d", "1").stdout)
        self.assertRegex(self.gz("-e", "~/pose/info", "-u", "-d", "1").stdout, r'^time \{.*name: "post".*\}\s*\n')
        self.sim.empty("unpause_physics")
        self.assertRegex(self.gz("-e", scan, "-d", "1").stdout, r'frame: "post::l"[^?]*ranges: ')
        self.assertRegex(self.gz("-z", "~/pose/info", "-d", "1").stdout, r"^(Hz: +\d+\.\d\d\n)+$")
        self.assertRegex(self.gz("-b", "~/pose/info", "-d", "2.5").stdout, r"^Total\[[\d.]+ K?B/s\] Mean\[[\d.]+ B\] .*Messages\[\d+\]\n")
        self.sim.empty("pause_physics")
        self.assertIn("no topic /gazebo/compiled/nothing", self.gz("-e", "~/nothing").stderr)
        self.assertIn("no simulator answers at localhost:1 ", self.gz("-l", port=1).stderr)

    def said(self, *words):
        """What a gz topic that does its work prints."""
        done = self.gz(*words)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout

    def test_gz_topic_publishes(self):
        def ticks():
            return round(self.sim.world().sim_time * 1000)

        before = ticks()
        self.assertEqual(self.said("-p", "/gazebo/compiled/world_control", "-m", "multi_step: 5"), "")
        test_support.wait_until(lambda: ticks() == before + 5)
        self.said("--publish", "~/world_control", "gazebo.msgs.WorldControl", "--msg", "step: true, pause: true")  # the type, as many write
        test_support.wait_until(lambda: ticks() == before + 6)
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            model = RAY.replace("\n", " ").replace('"', "'")
            file.write(f'sdf: "{model}"\npose {{ name: "" id: 0 position {{ x: 3 y: 0 z: 1 }} orientation {{ x: 0 y: 0 z: 0 w: 1 }} }}\n')
            file.flush()
            self.said("-p", "~/factory", "-f", file.name)
        test_support.wait_until(lambda: "post" in self.sim.world().model_names)
        self.assertEqual(self.sim.model("post").pose.position.x, 3.0)
        self.said("-p", "~/request", "-m", 'id: 1 request: "entity_delete" data: "post"')
        test_support.wait_until(lambda: "post" not in self.sim.world().model_names)

    def test_gz_topic_drives_a_plugin(self):
        self.assertTrue(self.sim.spawn("arm", URDF.format(library="worker", more=""), kind="urdf").success)
        self.said("-p", "~/go", "-m", "data: 3")

        def turns():
            self.sim.step(1)
            return self.sim.joint("elbow").rate[0] > 0.1

        test_support.wait_until(turns)

    def test_gz_topic_asks(self):
        self.assertTrue(self.sim.spawn("post", RAY).success)
        self.assertRegex(self.said("-r", "entity_list"), r'models \{\n  name: "post"')
        self.assertRegex(self.said("-r", "entity_info", "-m", "post\n"), r'^name: "post"\n[^?]*is_static: true')
        self.assertIn('request: "entity_delete"', self.said("--request", "entity_delete", "-m", "post"))
        test_support.wait_until(lambda: "post" not in self.sim.world().model_names)

    def test_gz_topic_says_what_it_cannot_say(self):
        for words, line in (
            (("-p", "~/world_control"), "its message is needed"),
            (("-p", "~/world_control", "-m", "paus: true"), 'WorldControl" has no field named "paus"'),
            (("-p", "~/world_control", "-m", "pause: maybe"), "-m is no gazebo.msgs.WorldControl: 1:"),
            (("-p", "~/request", "-m", 'id: 1 data: "a"'), "missing required fields:  request"),
            (("-p", "~/world_control", "-f", "/nowhere.txt"), "/nowhere.txt: No such file"),
            (("-p", "~/nothing", "-m", "data: 1"), "nobody listens to /gazebo/compiled/nothing; gz topic -l"),
            (("-p", "~/light/modify", "-m", "name: 'sun'"), "set_light_properties"),
            (("-p", "~/world_stats", "-m", "paused: true"), "nobody listens to /gazebo/compiled/world_stats"),
            (("-r", "entity_info", "-m", "ghost"), "there is no 'ghost'"),
            (("-r", "entity_info", "-w", "other"), "nobody answers requests on /gazebo/other/request"),
            (("-m", "pause: true"), "-p TOPIC -m MESSAGE publishes one"),
        ):
            done = self.gz(*words)
            self.assertEqual((done.returncode, done.stdout, done.stderr.count("\n")), (1, "", 1), words)
            self.assertIn(line, done.stderr)

    def test_bytes(self):
        wire, (version, spaces, publishers) = self.wire()
        self.assertEqual(version, ("version_init", field(1, "gazebo 11.0")))
        self.assertEqual(spaces, ("topic_namepaces_init", field(1, "compiled") + field(1, "/gazebo")))
        self.assertEqual(publishers[0], "publishers_init")
        known = {fields(each)[1][0].decode(): fields(each)[2][0].decode() for each in fields(publishers[1])[1]}
        self.assertEqual(known["/gazebo/compiled/world_stats"], "gazebo.msgs.WorldStatistics")
        stats = fields(self.listen("/gazebo/compiled/world_stats").read())
        iterations = stats[6][0]
        self.assertEqual(stats[5], [1])  # paused
        # Now as a publisher: the simulator comes to where it is told.
        with socket.create_server(("127.0.0.1", 0)) as place:
            place.settimeout(60)
            me = field(1, "/gazebo/compiled/world_control") + field(2, "gazebo.msgs.WorldControl") + field(3, "127.0.0.1")
            wire.tell("advertise", me + field(4, place.getsockname()[1]))
            self.assertEqual(fields(wire.packet("publisher_add")[1])[2], [b"gazebo.msgs.WorldControl"])
            other = Wire.__new__(Wire)
            other.socket, _ = place.accept()
            self.addCleanup(other.close)
            kind, asked = other.packet()
            self.assertEqual((kind, fields(asked)[1]), ("sub", [b"/gazebo/compiled/world_control"]))
            other.send(b"\xff\xff")  # no message: is left out
            other.send(field(1, 1) + field(3, 5))  # paused, and five steps
            self.near_steps(iterations + 5)
            other.send(field(1, 1) + field(2, 1))  # one more, and then the news that nobody publishes any more
            wire.tell("unadvertise", me + field(4, place.getsockname()[1]))
            self.near_steps(iterations + 6)

    def near_steps(self, count):
        wire = self.listen("/gazebo/compiled/world_stats")
        while fields(wire.read())[6][0] < count:
            self.assertIsNone(self.server.process.poll())

    def typing(self):
        """A publisher on ~/keyboard/keypress: a function that presses a key."""
        wire, _ = self.wire()
        place = socket.create_server(("127.0.0.1", 0))
        self.addCleanup(place.close)
        place.settimeout(60)
        me = field(1, "/gazebo/compiled/keyboard/keypress") + field(2, "gazebo.msgs.Any") + field(3, "127.0.0.1")
        wire.tell("advertise", me + field(4, place.getsockname()[1]))
        other = Wire.__new__(Wire)
        other.socket, _ = place.accept()
        self.addCleanup(other.close)
        other.packet()
        return lambda key: other.send(field(1, 3) + field(3, key))

    def test_keys_become_velocities(self):
        """Steps of <linear_increment> and <angular_increment>, positive to the right, up to the greatest."""
        inside = (
            "<cmd_vel_topic>~/keyed/cmd_vel</cmd_vel_topic><linear_increment>0.4</linear_increment><min_linear_vel>-0.2</min_linear_vel>"
            "<key_controls><accelerate>119</accelerate><accelerate>38</accelerate><decelerate>115</decelerate><left>97</left>"
            "<right>100</right><stop>32</stop></key_controls>"
        )
        keyed = f'<plugin name="k" filename="libKeysToCmdVelPlugin.so">{inside}</plugin>'
        self.assertTrue(self.sim.spawn("keyed", RAY.replace("</model>", keyed + "</model>")).success)
        press, hears = self.typing(), self.listen("/gazebo/compiled/keyed/cmd_vel")
        for key, ahead, aside in (
            (119, 0.4, 0),
            (38, 0.8, 0),
            (119, 1.0, 0),
            (100, 1.0, 0.5),
            (97, 1.0, 0.0),
            (97, 1.0, -0.5),
            (115, 0.6, -0.5),
            (32, 0, 0),
            (115, -0.2, 0),
        ):
            press(7)  # of no meaning
            press(key)
            command = doubles(hears.read())
            self.assertAlmostEqual(command[0], ahead, places=6, msg=key)
            self.assertAlmostEqual(2 * math.atan2(command[-2], command[-1]), aside, places=6, msg=key)

    def moved_by(self, key, what):
        """0.5 kg m2 on a joint with 5 N m, as the key has begun to move it: the one of its model, since the last key of a test is heard
        in the next one.

        :param what: attributes of its <map>
        """
        maps = f'<map key="{key}" {what}><joint>elbow</joint></map>'
        text = URDF.format(library="worker", more="").replace("libgazebo_ros_test_worker.so", "libKeysToJointsPlugin.so")
        self.assertTrue(self.sim.spawn("arm", text.replace("</plugin>", maps + "</plugin>"), kind="urdf").success)
        press = self.typing()
        press(7)  # of no meaning
        self.sim.step(1)
        self.assertEqual(self.sim.joint("elbow").rate[0], 0.0)

        def moves():
            self.sim.step(1)
            return abs(self.sim.joint("elbow").rate[0]) > 1e-4

        press(key)
        test_support.wait_until(moves)

    def test_a_key_moves_a_joint_on(self):
        self.moved_by(49, 'type="position" scale="0.5" kp="20" kd="4"')
        self.sim.step(5000)
        self.assertAlmostEqual(self.sim.joint("elbow").position[0], 0.5, delta=1e-3)
        self.assertAlmostEqual(self.sim.joint("elbow").rate[0], 0.0, delta=1e-3)

    def test_a_key_turns_a_joint(self):
        self.moved_by(50, 'type="velocity" scale="-1.5" kp="10"')
        self.sim.step(1000)
        self.assertAlmostEqual(self.sim.joint("elbow").rate[0], -1.5, delta=1e-3)

    def test_a_key_pushes_a_joint_for_a_step(self):
        self.moved_by(51, 'type="force" scale="2"')
        self.sim.step(5)
        self.assertAlmostEqual(self.sim.joint("elbow").rate[0], 2 * 0.001 / 0.5, delta=1e-6)

    def test_how_far_a_place_is_off_another(self):
        """The arm's base, 1 m up, as the first place 0.2 m ahead of it and turned by 90 degrees sees it. Spawned into the world, as a
        plugin of a world of its own."""
        with open(WORLD, encoding="utf-8") as file:
            world = file.read()
        inside = (
            '<pose frame="post::l">0.2 0 0 0 0 1.5707963267948966</pose><pose>3 2 1 0 0 1.5707963267948966</pose><namespace>off</namespace>'
            "<debug>1</debug>"
        )
        off = f'<plugin name="off" filename="libMisalignmentPlugin.so">{inside}</plugin>'
        with tempfile.NamedTemporaryFile("w", suffix=".world") as file:
            file.write(world.replace("</world>", off + "</world>"))
            file.flush()
            port = free_port()
            with Server("off", "-u", file.name, environment={"GAZEBO_MASTER_URI": f"http://localhost:{port}"}) as server:
                sim = server.simulator()
                sim.spawn("post", RAY.replace("<static>1</static>", "<static>1</static><pose>3 1 1 0 0 0</pose>"))
                mine, self.port = self.port, port
                self.addCleanup(setattr, self, "port", mine)
                hears = self.listen("/off/misalignment")
                sim.step(3)
                found = doubles(hears.read())
                for got, wanted in zip(found, (1.0, 0.2, 0.0, 0.0, 0.0, 0.0, 1.0)):
                    self.assertAlmostEqual(got, wanted, places=6)
                self.assertIn("/off/debug/first_pose", self.gz("-l", port=port).stdout)
                server.end()

    def test_who_listens_late_gets_the_last_message_if_it_wants(self):
        orders = rospy.Publisher("/near/keeper/orders", String, queue_size=10)
        test_support.wait_until(orders.get_num_connections)
        first = self.listen("/gazebo/compiled/go")
        test_support.wait_until(lambda: orders.publish("go 7") or self.waiting(first))
        self.assertEqual(first.read(), field(1, 7))
        self.assertEqual(self.listen("/gazebo/compiled/go", latching=1).read(), field(1, 7))

    @staticmethod
    def waiting(wire):
        wire.socket.settimeout(0.1)
        try:
            return wire.socket.recv(1, socket.MSG_PEEK)
        except TimeoutError:
            return False
        finally:
            wire.socket.settimeout(60)

    def test_who_does_not_read_stops_nobody(self):
        for i in range(4):
            self.assertTrue(
                self.sim.spawn(
                    f"post{i}",
                    RAY.replace("<static>1</static>", f"<pose>{i} 0 0.5 0 0 0</pose>").replace(
                        "<sensor", '<collision name="c"><geometry><box><size>0.5 0.5 1</size></box></geometry></collision><sensor'
                    ),
                ).success
            )
        deaf = self.listen("/gazebo/compiled/physics/contacts", receive_buffer=4096)
        hears = self.listen("/gazebo/compiled/world_stats")
        for _ in range(6):
            self.assertTrue(self.sim.step(500).success)
        self.assertTrue(hears.read())
        deaf.close()

    def test_noise_on_its_ports_does_no_harm(self):
        for port in (self.port, self.address("/gazebo/compiled/world_stats")[1]):
            for noise in (b"GET / HTTP/1.1\r\n\r\n", b"ffffffff", b"       3abc", b"       0", os.urandom(4000), b""):
                wire = Wire(port)
                wire.socket.sendall(noise)
                wire.close()
        self.assertTrue(self.sim.step(10).success)
        self.assertIn("/gazebo/compiled/world_stats", self.gz("-l").stdout)

    def test_a_second_simulator_has_its_own_or_says_that_it_has_none(self):
        other = free_port()
        with Server("far", "-u", environment={"GAZEBO_MASTER_URI": f"http://localhost:{other}"}) as far:
            sim = far.simulator()
            self.assertIn("/gazebo/default/world_stats", self.gz("-l", port=other).stdout)
            self.assertIn("/gazebo/compiled/world_stats", self.gz("-l").stdout)
            self.assertTrue(sim.step(1).success)
        with Server("blocked", "-u", environment={"GAZEBO_MASTER_URI": f"http://localhost:{self.port}"}) as blocked:
            self.assertTrue(blocked.simulator().step(1).success)
            text = blocked.end()[1]
        with socket.socket() as held:
            held.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                held.bind(("", 11345))
                held.listen()
            except OSError:  # somebody else's simulator has it, which does as well
                pass
            with Server("plain", "-u", environment={"GAZEBO_MASTER_URI": ""}) as plain:  # as on every shared machine
                self.assertTrue(plain.simulator().step(1).success)
                self.assertNotIn("11345", plain.end()[1])
        line = rf"port {self.port} is taken.*GAZEBO_MASTER_URI=http://localhost:{self.port + 1}\b"
        self.assertEqual(len(re.findall(line, text)), 1, text)


if __name__ == "__main__":
    rospy.init_node("transport_rostest")
    rostest.rosrun("gazebo_ros", "transport", TransportTest)
