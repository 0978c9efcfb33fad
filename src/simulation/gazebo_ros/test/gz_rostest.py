#!/usr/bin/env python3
"""gz from the command line, as students type it. Options, lines and what becomes of a model's own pose are Gazebo 11's."""

import os
import re
import subprocess
import tempfile

import rospy
import rostest
import test_support
from gazebo_msgs.srv import GetLightProperties
from processes import BENCH, Server
from simulator import box

LINE = r"Factor\[(\d+\.\d\d)\] SimTime\[(\d+\.\d\d)\] RealTime\[(\d+\.\d\d)\] Paused\[([TF])\]"
COLUMNS = r" *(\d+\.\d\d), +(\d+\.\d{6}), +(\d+\.\d{6}), ([TF])"
CAMERA = '<sensor name="eye" type="camera"><camera/></sensor>'


def gz(*words, namespace="/room", stdin=None):
    """What a finished ``gz`` has said."""
    environment = {**os.environ, "ROS_NAMESPACE": namespace}
    return subprocess.run(["gz", *words], env=environment, input=stdin, text=True, capture_output=True, timeout=60)


class Gz(test_support.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = Server("room", "-u", BENCH)
        cls.sim = cls.server.simulator()

    @classmethod
    def tearDownClass(cls):
        cls.server.end()

    def setUp(self):
        self.sim.empty("pause_physics")
        self.sim.empty("reset_simulation")

    def good(self, done):
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def place(self, name):
        return [float(word) for word in self.good(gz("model", "-m", name, "-p")).split()]

    # ---------------------------------------------------------------------------------------------------- which simulator

    def test_the_namespace_is_that_of_the_environment_or_of_the_command_line(self):
        self.assertIn("crate", self.good(gz("model")))
        self.assertIn("crate", self.good(gz("model", "__ns:=/room", namespace="")))
        lost = gz("model", namespace="")
        self.assertEqual(lost.returncode, 1)
        self.assertRegex(lost.stderr, r"no simulator answers at .* as /gazebo; there is one in /room: put ROS_NAMESPACE=/room before")
        self.assertEqual(lost.stderr.count("\n"), 1)

    def test_one_at_the_root_answers_whoever_has_none_of_his_own(self):
        with Server("", "-u", BENCH) as server:
            root = server.simulator()
            self.assertTrue(root.spawn("stool", box()).success)
            for namespace, there in (("", True), ("/robot", True), ("/room", False)):
                self.assertEqual("stool" in self.good(gz("model", namespace=namespace)).split(), there, namespace)
            server.end()

    # ---------------------------------------------------------------------------------------------------- models

    def test_where_a_model_is_put_takes_the_place_of_its_own_pose(self):
        link = '<link name="l"><pose>0 0 0.1 0 0 0</pose><inertial><pose>0 1 0 0 0 0</pose></inertial></link>'
        plain = '<sdf version="1.6"><model name="m">%s' + link + "%s</model></sdf>"
        texts = {
            "before": plain % ("<pose>1 2 3 0 0 0.5</pose>", ""),
            "behind": plain % ("", '<pose degrees="true">\n1 2 3\n0 0 90</pose>'),
            "none": plain % ("", ""),
            "empty": plain % ("<pose/>", ""),
            "world": '<sdf version="1.6"><world name="w"><!-- <pose> --><model name="m"><pose>5 0 0 0 0 0</pose>%s</model></world></sdf>'
            % link,
            "nested": '<sdf version="1.7"><model name="m"><model name="n"><pose>0 0 9 0 0 0</pose>%s</model></model></sdf>' % link,
        }
        for name, text in texts.items():
            with self.subTest(name), tempfile.NamedTemporaryFile("w", suffix=".sdf") as file:
                file.write(text)
                file.flush()
                self.good(gz("model", "-f", file.name, "-m", name, "-x", "4", "-z", "0.5", "-Y", "0.25"))
                for value, wanted in zip(self.place(name), (4, 0, 0.5, 0, 0, 0.25)):
                    self.assertAlmostEqual(value, wanted, places=6)
                self.assertTrue(self.sim.delete(name).success)

    def test_an_included_model(self):
        for name, pose in (("with", "<pose>7 0 0 0 0 0</pose>"), ("without", "")):
            text = f'<sdf version="1.6"><include><uri>model://cafe_table</uri>{pose}</include></sdf>'
            self.good(gz("model", "--spawn-string", "-m", name, "-x", "-4", "-y", "8", stdin=text))
            self.assertEqual(self.place(name)[:3], [-4, 8, 0])
            self.assertTrue(self.sim.delete(name).success)

    def test_text_from_a_pipe(self):
        self.good(gz("model", "-s", "-m", "piped", "-x", "2", stdin=box(extra="<pose>0 0 9 0 0 0</pose>")))
        self.assertEqual(self.place("piped")[:3], [2, 0, 0])
        lamp = '<sdf version="1.6"><light name="bulb" type="point"><pose>0 0 3 0 0 0</pose><diffuse>1 0 0 1</diffuse></light></sdf>'
        self.good(gz("model", "-s", "-m", "bulb", "-z", "2", stdin=lamp))
        self.assertTrue(self.sim.proxy("get_light_properties", GetLightProperties)("bulb").success)
        for text, words in ((b"<sdf>\n\n<model", "standard input:3"), (b"\xff\xfe", "no text in UTF-8 (byte 0)")):
            broken = subprocess.run(
                ["gz", "model", "-s", "-m", "x"], input=text, capture_output=True, env={**os.environ, "ROS_NAMESPACE": "/room"}, timeout=60
            )
            self.assertEqual(broken.returncode, 1)
            self.assertIn(words, broken.stderr.decode())
            self.assertNotIn("Traceback", broken.stderr.decode())
        self.assertTrue(self.sim.delete("piped").success)

    def test_words_of_the_original(self):
        self.good(gz("model", "-w", "default", "-m", "crate", "--pose-x", "3", "--pose-Y", "1"))
        self.assertEqual([round(value, 5) for value in self.place("crate")], [3, 0, 0, 0, 0, 1])
        self.good(gz("world", "-w", "default", "-p", "1"))
        self.assertIn("targets", gz("joint", "-m", "swing", "-j", "hinge", "--pos-t", "1", "--pos-p", "3").stderr)

    # ---------------------------------------------------------------------------------------------------- cameras

    def test_cameras(self):
        self.assertEqual(self.good(gz("camera", "-l")), "")
        self.assertTrue(self.sim.spawn("seeing", box(extra=f'<link name="head">{CAMERA}</link>')).success)
        self.assertEqual(self.good(gz("camera", "-l")), "seeing::head::eye\n")
        refused = gz("camera", "-c", "gzclient_camera", "-f", "crate")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("Follow what is picked", refused.stderr)
        self.assertTrue(self.sim.delete("seeing").success)

    # ---------------------------------------------------------------------------------------------------- statistics

    def test_while_paused_its_times_stand_still(self):
        self.assertTrue(self.sim.step(250).success)
        lines = self.good(gz("stats", "-d", "0.5")).splitlines()
        self.assertTrue(lines)
        for line in lines:
            found = re.fullmatch(LINE, line)
            self.assertTrue(found, line)
            self.assertEqual((found[1], found[2], found[4]), ("0.00", "0.25", "T"))
        self.assertEqual(len({re.fullmatch(LINE, line)[3] for line in lines}), 1)

    def test_while_it_runs_the_factor_is_of_the_two_times(self):
        self.sim.empty("unpause_physics")
        lines = self.good(gz("stats", "-d", "2")).splitlines()
        self.assertGreater(len(lines), 2)
        told = [[float(word) for word in re.fullmatch(LINE, line).groups()[:3]] for line in lines]
        self.assertEqual({re.fullmatch(LINE, line)[4] for line in lines}, {"F"})
        (_, sim, real), (factor, last_sim, last_real) = told[0], told[-1]
        self.assertGreater(last_real, real)
        self.assertAlmostEqual(factor, (last_sim - sim) / (last_real - real), delta=0.3 * factor)

    def test_columns_for_programs(self):
        self.sim.empty("unpause_physics")
        heading, *lines = self.good(gz("stats", "-p", "-d", "0.5")).splitlines()
        self.assertEqual(heading, "# real-time factor (percent), simtime (sec), realtime (sec), paused (T or F)")
        self.assertTrue(lines)
        for line in lines:
            self.assertRegex(line, f"^{COLUMNS}$")


if __name__ == "__main__":
    rospy.init_node("gz_rostest")
    rostest.rosrun("gazebo_ros", "gz", Gz)
