#!/usr/bin/env python3
"""A server among unfriendly neighbours: limits of the system, other locales, many clients, stopped for a while."""

import os
import signal
import threading
import unittest
from pathlib import Path

import rosgraph
import rospy
import rostest
from gazebo_msgs.srv import GetWorldProperties
from processes import BENCH, Server
from simulator import box, pose

KILLERS = [dict(time_step=1e300), dict(rate=1e-300), dict(time_step=1e9), dict(time_step=1e-12), dict(max_contacts=0)]
FAR_SHAPE = box().replace('<collision name="c">', '<collision name="c"><pose>4e9 0 0 0 0 0</pose>')


class Limits(unittest.TestCase):
    def test_with_too_little_memory_it_works_or_says_so_in_one_line(self):
        endings = {}
        for kilobytes in (120_000, 200_000, 260_000, 350_000, 450_000, 1_000_000):
            name = f"poor{kilobytes}"
            with Server(name, "-u", BENCH, limits=f"-v {kilobytes}") as server:
                while server.process.poll() is None and not self.ready(name):
                    rospy.rostime.wallsleep(0.05)
                if server.process.poll() is not None:
                    code, text = server.end()
                    lines = [line for line in text.splitlines() if "ulimit" in line]
                    endings[kilobytes] = (code, len(lines), "Traceback" in text)
                    self.assertEqual(endings[kilobytes], (1, 1, False), text)
        self.assertIn(120_000, endings)

    @staticmethod
    def ready(name):
        return any(topic == f"/{name}/gazebo/parameter_updates" for topic, _ in rosgraph.Master("/t").getSystemState()[0])

    def test_sixty_four_open_files(self):
        with Server("files", "-u", BENCH, limits="-n 64") as server:
            sim = server.simulator()
            self.assertTrue(sim.spawn("crate2", box(), pose(9, 0, 1)).success)
            self.assertTrue(sim.step(10).success)
            many = [threading.Thread(target=self.ask, args=(server.name,)) for _ in range(80)]
            for thread in many:
                thread.start()
            for thread in many:
                thread.join()
            self.assertTrue(sim.step(10).success)
            self.ask(server.name)
            self.assertTrue(sim.step(10).success)

    @staticmethod
    def ask(name):
        try:
            rospy.ServiceProxy(f"/{name}/gazebo/get_world_properties", GetWorldProperties)()
        except (rospy.ServiceException, OSError):  # refused for want of files
            pass

    def test_locales(self):
        for name in ("C", "tr_TR.UTF-8", "de_DE.UTF-8"):  # one that is not installed falls back to C, with other warnings
            with Server("abroad", "-u", BENCH, environment={"LC_ALL": name, "LANG": name}) as server:
                sim = server.simulator()
                self.assertTrue(sim.spawn("kr\u00e4n", box(1.5), pose(9, 0, 1.25)).success, name)
                self.assertTrue(sim.step(3).success)
                self.assertAlmostEqual(sim.model("kr\u00e4n").pose.position.z, 1.25, places=3)
                self.assertNotIn("Traceback", server.end()[1])


class Clients(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server("busy", BENCH)
        cls.sim = cls.server.simulator()

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()

    def goes_on(self):
        """Time passes, and the server answers."""
        self.assertIsNone(self.server.process.poll())
        before = self.sim.world().sim_time
        while self.sim.world().sim_time < before + 0.05:
            rospy.rostime.wallsleep(0.01)

    def test_a_thousand_calls_at_once(self):
        answers = []

        def ask():
            call = rospy.ServiceProxy("/busy/gazebo/get_world_properties", GetWorldProperties, persistent=True)
            answers.extend(call().success for _ in range(20))
            call.close()

        threads = [threading.Thread(target=ask) for _ in range(50)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual((len(answers), all(answers)), (1000, True))
        self.goes_on()

    def test_values_that_would_end_the_simulation(self):
        for values in KILLERS:
            self.assertFalse(self.sim.set_physics(**values).success, values)
        answer = self.sim.spawn("far", FAR_SHAPE, pose(9, 0, 1))
        self.assertNotIn("internal error", answer.status_message)
        self.goes_on()
        if answer.success:
            self.assertTrue(self.sim.delete("far").success)

    def test_models_that_come_and_go_leave_nothing(self):
        place = Path("/proc", str(self.server.node_pid()))

        def round_trips(count):
            for _ in range(count):
                self.assertTrue(self.sim.spawn("guest", box(), pose(20, 0, 1)).success)
                self.assertTrue(self.sim.delete("guest").success)
            status = dict(line.split(":", 1) for line in (place / "status").read_text().splitlines())
            return int(status["Threads"]), len(list((place / "fd").iterdir())), int(status["VmRSS"].split()[0])

        threads, files, memory = round_trips(60)
        after = round_trips(200)
        self.assertLessEqual(after[0], threads)
        self.assertLessEqual(after[1], files)
        self.assertLess(after[2] - memory, 5000)  # kB: 25 for each
        self.goes_on()

    def test_one_that_was_stopped_for_a_while_goes_on(self):
        os.killpg(self.server.process.pid, signal.SIGSTOP)
        rospy.rostime.wallsleep(2.0)
        os.killpg(self.server.process.pid, signal.SIGCONT)
        self.goes_on()


if __name__ == "__main__":
    rospy.init_node("hostile_rostest", disable_rostime=True)
    rostest.rosrun("gazebo_ros", "hostile", "__main__")
