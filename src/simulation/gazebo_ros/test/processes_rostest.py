#!/usr/bin/env python3
"""Whole server processes: same bits in two runs, options, signals, several servers at once."""

import io
import math
import os
import signal
import socket
import subprocess
import sys
import tempfile
import xmlrpc.client

import cv2
import numpy as np
import rosgraph
import rospy
import rostest
import test_support
from gazebo_msgs import srv
from gazebo_ros.srv import DescribeWorld, TakePicture
from ode_sim.description.exchange import loads
from ode_sim_viewer.simulation import WorldRecord
from processes import BENCH, Server
from rosgraph_msgs.msg import Clock
from simulator import Simulator, box, pose, urdf

PHYSICS = """{time_step: 0.001, max_update_rate: 1000.0, gravity: {z: -1.5}, ode_config: {sor_pgs_iters: 50, sor_pgs_w: 1.3,
contact_surface_layer: 0.001, contact_max_correcting_vel: 100.0, erp: 0.2, max_contacts: 20}}"""


def bits(message):
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()


def history(sim):
    """A pile of boxes falls over, an arm is driven, models come and go; every state on the way, as bytes."""

    def good(response):
        assert response.success, response.status_message

    good(sim.set_physics())
    for i in range(6):
        good(sim.spawn(f"box{i}", box(mass=1 + i), pose(0.13 * i, 0.07 * (i % 3), 0.6 + 1.05 * i)))
    good(sim.spawn("arm", urdf(), pose(-3, 0, 1), kind="urdf"))
    states = []
    for turn in range(12):
        good(sim.drive("hinge", (-1) ** turn * 3.0, 0.03))
        good(sim.drive("elbow", 2.0 - turn, 0.05))
        good(sim.push("box2::link", (20.0, 5.0, 0.0), 0.02))
        if turn == 6:
            good(sim.delete("box4"))
        good(sim.step(50))
        states += [bits(sim.joint(name)) for name in ("hinge", "elbow")]
        states += [bits(sim.link(f"{name}::link").link_state) for name in ("box0", "box1", "box2", "box5")]
    return states


class Determinism(test_support.TestCase):
    def test_two_processes_same_bits_though_one_fights_for_the_processor(self):
        with Server("calm", "-u", "--seed", "5", BENCH) as calm, Server("busy", "-u", "--seed", "5", BENCH) as busy:
            first = history(calm.simulator())
            load = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(3)]
            try:
                second = history(busy.simulator())
            finally:
                for process in load:
                    process.kill()
                    process.wait()
        self.assertEqual(len(first), 72)
        self.assertEqual(first, second)
        self.assertEqual(len(set(first)), 72, "the world does not even move")


class Options(test_support.TestCase):
    def test_iterations_end_the_process(self):
        with Server("short", "--iters", "300", BENCH) as server:
            text, _ = server.process.communicate(timeout=60)
            self.assertEqual(server.process.returncode, 0, text)
            self.assertIn("300 iterations done", text)

    def test_unknown_world_falls_back_to_the_empty_one_and_names_those_that_are_there(self):
        with Server("lost", "-u", "worlds/nowhere.world", "-e", "bullet", "-s", "libother.so") as server:
            self.assertEqual(server.simulator().world().model_names, ["ground_plane"])
            code, text = server.end()
        for word in ("worlds/nowhere.world", "worlds/empty.world", "worlds/shapes.world", "bullet", "libother.so"):
            self.assertIn(word, text)
        self.assertNotIn("Traceback", text)

    def test_broken_world_falls_back_too(self):
        handle, path = tempfile.mkstemp(suffix=".world")
        os.write(handle, b"<sdf version='1.6'><world name='w'>")
        os.close(handle)
        with Server("broken", "-u", path) as server:
            self.assertEqual(server.simulator().world().model_names, ["ground_plane"])
            _, text = server.end()
        os.remove(path)
        self.assertIn(path, text)
        self.assertNotIn("Traceback", text)

    def test_the_first_view_is_that_of_the_world(self):
        """Its camera looks away from the one red box, which all other views show."""
        world = """<sdf version="1.6"><world name="w">
            <gui fullscreen="1"><camera name="user_camera"><pose>3 0 1 0 0 0.5</pose></camera></gui>
            <light type="directional" name="sun"><direction>0 0.5 -1</direction></light>
            <model name="m"><static>1</static><link name="l"><visual name="v"><geometry><box><size>1 1 1</size></box></geometry>
            <material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual></link></model></world></sdf>"""
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "w.world")
            with open(path, "w", encoding="utf-8") as file:
                file.write(world)
            with Server("gazes", "-u", path) as server:
                describe = server.simulator().proxy("describe_world", DescribeWorld)
                record = loads(describe().world)
                self.assertIsInstance(record, WorldRecord)
                eye = record.view
                self.assertEqual(eye.p, (3.0, 0.0, 1.0))
                self.assertAlmostEqual(eye.q[2], math.sin(0.25), places=9)
                take = server.simulator().proxy("take_picture", TakePicture)
                reds = {}
                for model, view in (("", ""), ("", "iso"), ("m", ""), ("", "left")):
                    answer = take(model, view, 160, 100)
                    self.assertTrue(answer.success, answer.status_message)
                    pixels = cv2.imdecode(np.frombuffer(answer.png, np.uint8), cv2.IMREAD_COLOR).astype(int)
                    reds[model, view] = int(np.count_nonzero(pixels[:, :, 2] > 2 * pixels[:, :, :2].max(axis=2) + 20))
        self.assertEqual(reds.pop(("", "")), 0)
        self.assertGreater(min(reds.values()), 1000, reds)

    def test_without_network_there_is_only_the_clock_at_its_frequency(self):
        rospy.set_param("/mute/gazebo/enable_ros_network", False)
        rospy.set_param("/mute/gazebo/pub_clock_frequency", 100)
        times = []
        with Server("mute", BENCH) as server:
            clock = rospy.Subscriber("/clock", Clock, lambda m: times.append(m.clock.to_nsec()), queue_size=100)

            def steps():
                return {b - a for a, b in zip(times[1:], times[2:])}

            while len(times) < 12 or 10_000_000 not in steps():  # some may be missed
                self.assertIsNone(server.process.poll())
                rospy.rostime.wallsleep(0.01)
            clock.unregister()
            publishers, _, services = rosgraph.Master("/test").getSystemState()
            self.assertEqual([topic for topic, nodes in publishers if "/mute/gazebo" in nodes], ["/rosout", "/clock"])
            self.assertEqual([name for name, nodes in services if "/mute/gazebo" in nodes and "logger" not in name], [])
        self.assertEqual({step % 10_000_000 for step in steps()}, {0})
        self.assertEqual(min(steps()), 10_000_000)


def master_place(case):
    """The URI of a master that may be started in this test; its port is kept from others."""
    place = socket.socket()
    case.addCleanup(place.close)
    place.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    place.bind(("", 0))
    return f"http://localhost:{place.getsockname()[1]}"


def start_master(case, uri):
    """The process of a master that answers."""
    process = subprocess.Popen(
        ["rosmaster", "--core", "-p", uri.rpartition(":")[2]], stdout=subprocess.DEVNULL, env={**os.environ, "ROS_MASTER_URI": uri}
    )
    case.addCleanup(lambda: (process.kill(), process.wait()))
    while not rosgraph.is_master_online(uri):
        case.assertIsNone(process.poll())
        rospy.rostime.wallsleep(0.01)
    return process


class Masters(test_support.TestCase):
    def test_simulators_of_the_same_name_under_two_masters_do_not_meet(self):
        uri = master_place(self)
        start_master(self, uri)
        with Server("", "-u", BENCH) as near, Server("", "-u", BENCH, master=uri) as far:

            def gz(*command):
                return subprocess.run(["gz", *command], env=far.environment, text=True, capture_output=True, timeout=60)

            sim = Simulator("/gazebo")
            while gz("world", "-m", "1").returncode:  # until it is there
                self.assertIsNone(far.process.poll())
            self.assertEqual(gz("world", "-m", "99").stderr, "")
            self.assertEqual(gz("model", "-m", "crate", "-x", "9", "-z", "4").stderr, "")
            self.assertEqual((sim.world().sim_time, sim.model("crate").pose.position.x), (0.0, 5.0))
            self.assertTrue(sim.step(3).success)
            near.end()
            self.assertEqual(gz("world", "-s").stderr, "")
            self.assertEqual(gz("model", "-m", "crate", "-p").stdout.split()[:3], ["9", "0", "4"])
            self.assertIn("swing has no joint knee; it has ", gz("joint", "-m", "swing", "-j", "knee", "-f", "1").stderr)
            self.assertEqual(gz("joint", "-m", "swing", "-j", "hinge", "-f", "0").stderr, "")
            self.assertIn("rosbag record", gz("log", "-d", "1").stderr)
            self.assertIn("--model-name", gz("help", "joint").stdout)
            self.assertEqual((gz("help").returncode, gz("help", "nothing").returncode), (0, 1))
            self.assertIn("SimTime[0.10]", gz("stats", "-d", "0.1").stdout)  # 101 steps of its own, none of the other's

    def test_a_master_that_stands_still_and_one_that_is_killed_and_comes_back_know_the_simulator_again(self):
        uri = master_place(self)
        process = start_master(self, uri)
        master = xmlrpc.client.ServerProxy(uri)
        with Server("", "-u", BENCH, master=uri) as server:

            def known():
                """Topics, services and parameters of the node."""
                state = master.getSystemState("/t")[2]
                return [sorted(name for name, nodes in kind if "/gazebo" in nodes) for kind in state] + [master.getParam("/t", "/")[2]]

            def wait_until(condition):
                while not condition():
                    self.assertIsNone(server.process.poll())
                    rospy.rostime.wallsleep(0.05)

            def command(*words):
                return subprocess.run(words, env=server.environment, text=True, capture_output=True, timeout=60)

            wait_until(lambda: "/gazebo/parameter_updates" in known()[0])
            wait_until(lambda: "success: True" in command("rosservice", "call", "/gazebo/set_physics_properties", PHYSICS).stdout)
            before = known()
            self.assertEqual((before[3]["use_sim_time"], before[3]["gazebo"]["gravity_z"]), (True, -1.5))
            process.send_signal(signal.SIGSTOP)
            rospy.rostime.wallsleep(6.5)  # longer than a question to it is left open
            process.send_signal(signal.SIGCONT)
            wait_until(lambda: known() == before)
            self.assertEqual(command("gz", "world", "-m", "5").returncode, 0)
            process.kill()
            process.wait()
            start_master(self, uri)
            wait_until(lambda: known() == before)
            self.assertEqual(command("gz", "world", "-m", "5").returncode, 0)
            self.assertIn("secs", command("rostopic", "echo", "-n", "1", "/clock").stdout)
            code, text = server.end()
            self.assertEqual((code, known()[:3]), (0, [[], [], []]))
        self.assertEqual(text.count("this node has registered with it"), 1, text)
        self.assertNotIn("Traceback", text)


class Twice(test_support.TestCase):
    def test_a_second_one_of_the_same_name_ends_and_the_first_goes_on(self):
        """A launch file that spawns a robot often brings a simulator along, though a world runs already."""
        with Server("twice", "-u", BENCH) as first:
            sim = first.simulator()
            self.assertTrue(sim.step(3).success)
            with Server("twice") as second:
                text, _ = second.process.communicate(timeout=60)
            self.assertEqual(second.process.returncode, 255, text)
            self.assertEqual(len(text.strip().splitlines()), 1, text)
            for word in ("/twice/gazebo", str(first.node_pid()), "rosnode kill"):
                self.assertIn(word, text)
            self.assertAlmostEqual(sim.world().sim_time, 0.003)
            self.assertTrue(sim.step(2).success)
            self.assertIsNone(first.process.poll())


class Ends(test_support.TestCase):
    def test_signals_end_it_cleanly_also_while_paused_and_stepping(self):
        for number, arguments in ((signal.SIGINT, ["-u"]), (signal.SIGTERM, []), (signal.SIGINT, [])):
            with self.subTest(number=number, arguments=arguments), Server("ends", *arguments, BENCH) as server:
                server.simulator()
                code, text = server.end(number)
                self.assertEqual(code, 0, text)
                self.assertNotIn("Traceback", text)
                self.assertNotIn("/ends/gazebo", [node for _, nodes in rosgraph.Master("/t").getSystemState()[0] for node in nodes])

    def test_a_killed_server_can_be_started_again_under_its_name(self):
        with Server("again", BENCH) as server:
            server.simulator()
            server.end(signal.SIGKILL)
        with Server("again", "-u", BENCH) as server:
            sim = server.simulator()
            self.assertEqual(sim.world().model_names, ["ground_plane", "crate", "swing"])
            self.assertTrue(sim.step(3).success)


class Alone(test_support.TestCase):
    def test_gazebo_typed_without_a_master_brings_its_own_and_takes_it_along(self):
        with socket.socket() as probe:
            probe.bind(("localhost", 0))
            uri = f"http://localhost:{probe.getsockname()[1]}"
        process = subprocess.Popen(
            ["gazebo", "--lockstep"],
            env={**os.environ, "ROS_MASTER_URI": uri},
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        try:
            said = ""
            for line in process.stdout:
                said += line
                if "Physics dynamic reconfigure ready" in line:
                    break
            else:
                self.fail(f"it ended before it was ready: {said}")
            master = rosgraph.Master("/test", uri)
            self.assertEqual(xmlrpc.client.ServerProxy(master.lookupNode("/gazebo")).getPid("/test")[2], process.pid)
            os.killpg(process.pid, signal.SIGINT)
            self.assertEqual(process.wait(60), 0)
            for _ in range(600):
                if not rosgraph.is_master_online(uri):
                    break
                rospy.rostime.wallsleep(0.1)
            self.assertFalse(rosgraph.is_master_online(uri), "its master stayed behind")
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
            process.stdout.close()


if __name__ == "__main__":
    rospy.init_node("processes_rostest")
    rostest.rosrun("gazebo_ros", "processes", "__main__")
