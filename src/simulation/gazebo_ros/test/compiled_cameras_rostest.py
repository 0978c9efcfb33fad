#!/usr/bin/env python3
"""Plugins in C++ that read cameras: what they see, when, and that nothing is drawn for nobody."""

import importlib.util
import math
import os
import sys
import tempfile
import unittest

import rospy
import rostest
from std_msgs.msg import Float64MultiArray, String
from test_support.hearing import heard

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from processes import Server  # noqa: E402
from simulator import Case, HearingCase  # noqa: E402

BOX = """<sdf version="1.6"><model name="box"><static>1</static><pose>3 0 0.5 0 0 0</pose><link name="l"><visual name="v">
<geometry><box><size>1 1 1</size></box></geometry><material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material>
</visual></link></model></sdf>"""
MODEL = """<sdf version="1.6"><model name="{name}"><static>1</static><pose>0 0 0.5 0 0 0</pose><link name="l">{sensor}</link>
{plugin}</model></sdf>"""
CAMERA = """<camera name="{name}">{pose}<horizontal_fov>1</horizontal_fov><image><width>320</width><height>240</height>
<format>{format}</format></image><clip><near>0.05</near><far>20</far></clip>{more}</camera>"""
SENSOR = """<sensor name="{name}" type="{type}"><update_rate>20</update_rate><always_on>{on}</always_on>{cameras}{plugin}</sensor>"""
VIEWER = """<plugin name="viewer" filename="libgazebo_ros_test_viewer.so"><sensor>{sensor}</sensor>{more}</plugin>"""
RANGER = """<plugin name="ranger" filename="libgazebo_ros_test_ranger.so"/>"""
F = 160 / math.tan(0.5)  # pixels, of the cameras
TIME, NUMBER, WIDTH, HEIGHT, DEPTH, HASH, RED, LEFT, RIGHT, TOP, BOTTOM, ASIDE, SAME, HFOV = range(14)


def camera(name="c", pose="", image_format="R8G8B8", more=""):
    return CAMERA.format(name=name, pose=pose, format=image_format, more=more)


def robot(name="robot", kind="camera", cameras="", on=1, plugin="", viewer=True, more=""):
    sensor = SENSOR.format(name=name + "_eye", type=kind, on=on, cameras=cameras or camera(), plugin=plugin)
    return MODEL.format(name=name, sensor=sensor, plugin=VIEWER.format(sensor=name + "_eye", more=more) if viewer else "")


def answer_of(case, topic, text):
    """Of the viewer plugin to an order. Without waiting for it, the publisher might be gone before the order is sent."""
    answers = []
    subscriber = rospy.Subscriber(topic + "/done", String, lambda m: answers.append(m.data))
    publisher = rospy.Publisher(topic + "/order", String, queue_size=10)
    case.wait(lambda: heard([subscriber]) and publisher.get_num_connections())
    before = len(answers)
    publisher.publish(text)
    case.wait(lambda: len(answers) > before and answers[-1].split()[0] == text.split()[0])
    subscriber.unregister()
    publisher.unregister()
    return answers[-1]


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class CamerasTest(HearingCase):
    def setUp(self):
        super().setUp()
        self.orders = {}
        self.done(self.sim.spawn("box", BOX, kind="sdf"))

    def spawned(self, name="robot", topic="/view/", **more):
        """All that the plugin of this robot publishes."""
        got = []
        self.listen(f"{topic}{name}_eye", Float64MultiArray, lambda m: got.append(m.data))
        text = robot(name, **more)
        self.done(self.sim.spawn(name, text))
        self.wait(lambda: heard(self.subscribers[-1:]))
        return got

    def frames(self, got, steps, count):
        """So many are there after so many steps, and no more: in lock-step all of them have come by then."""
        self.sim.step(steps)
        self.wait(lambda: len(got) >= count)
        self.assertEqual(len(got), count)
        return got

    def order(self, name, text):
        return answer_of(self, f"/view/{name}_eye", text)

    # -- pictures

    def test_a_red_box_is_where_it_stands(self):
        got = self.frames(self.spawned(), 100, 2)
        for frame in got:
            self.assertEqual(frame[WIDTH:HASH], (320, 240, 3))
            for place, wanted in (
                (LEFT, 159.5 - F * 0.5 / 2.5),
                (RIGHT, 159.5 + F * 0.5 / 2.5),
                (TOP, 119.5 - F * 0.5 / 2.5),
                (BOTTOM, 119.5 + F * 0.5 / 2.5),
            ):
                self.assertAlmostEqual(frame[place], wanted, delta=1.0)
            self.assertAlmostEqual(frame[RED], (2 * F * 0.5 / 2.5) ** 2, delta=300)
            self.assertEqual(frame[SAME], 1)

    def test_the_rate_is_that_of_simulated_time(self):
        got = self.frames(self.spawned(), 250, 5)
        self.assertEqual([round(frame[TIME], 6) for frame in got], [0.05, 0.1, 0.15, 0.2, 0.25])

    def test_two_runs_give_the_same_bytes(self):
        noise = "<noise><type>gaussian</type><mean>0</mean><stddev>0.02</stddev></noise>"
        got = self.spawned(cameras=camera(more=noise))
        first = list(self.frames(got, 150, 3))
        self.assertEqual(len({frame[HASH] for frame in first}), 3)  # it is noise
        self.sim.empty("reset_simulation")
        self.assertEqual(self.frames(got, 150, 6)[3:], first)

    def test_a_grey_picture(self):
        got = self.frames(self.spawned(cameras=camera(image_format="L8")), 50, 1)
        self.assertEqual(got[0][DEPTH], 1)

    def test_both_cameras_of_a_sensor(self):
        two = camera("left", "<pose>0 0.2 0 0 0 0</pose>") + camera("right", "<pose>0 -0.2 0 0 0 0</pose>")
        got = self.frames(self.spawned(kind="multicamera", cameras=two), 100, 4)
        self.assertEqual([(round(frame[TIME], 6), frame[NUMBER]) for frame in got], [(0.05, 0), (0.05, 1), (0.1, 0), (0.1, 1)])
        self.assertAlmostEqual(got[0][LEFT] - got[1][LEFT], F * 0.4 / 2.5, delta=1.0)
        self.assertEqual((got[0][ASIDE], got[1][ASIDE]), (0.2, -0.2))

    def test_depth(self):
        cameras = camera(more="<depth_camera/>")
        got = self.frames(self.spawned(topic="/range/", kind="depth", cameras=cameras, plugin=RANGER, viewer=False), 100, 2)
        for frame in got:
            time, kind, middle, side, corner, same, red, green, blue = frame
            self.assertEqual((kind, same), (1, 1))
            self.assertAlmostEqual(middle, 2.5, delta=2e-3)
            self.assertAlmostEqual(side, 20.0, delta=1e-3)  # level, past the box: where nothing is, the far clip
            self.assertAlmostEqual(corner, 20.0, delta=1e-3)
            self.assertGreater(red, 2 * max(green, blue))
        self.assertEqual([round(frame[0], 6) for frame in got], [0.05, 0.1])

    def test_points(self):
        cameras = camera(more="<depth_camera><output>points</output></depth_camera>")
        got = self.frames(self.spawned(topic="/range/", kind="depth", cameras=cameras, plugin=RANGER, viewer=False), 50, 1)
        _, kind, x, y, z, blue, green, red, *pixel = got[0]
        self.assertEqual(kind, 4)
        self.near((x, y, z), (0.5 * 2.5 / F, 0.5 * 2.5 / F, 2.5), 2)
        self.assertEqual((red, green, blue), tuple(pixel))

    # -- what plugins change

    def test_a_camera_that_is_moved(self):
        got = self.frames(self.spawned(), 50, 1)
        self.order("robot", "aside 0.25")
        self.frames(got, 50, 2)
        self.assertAlmostEqual(got[1][LEFT] - got[0][LEFT], F * 0.25 / 2.5, delta=1.0)
        self.assertEqual((got[0][ASIDE], got[1][ASIDE]), (0.0, 0.25))

    def test_another_lens_and_another_size(self):
        got = self.frames(self.spawned(), 50, 1)
        self.order("robot", "hfov 0.5")
        self.frames(got, 50, 2)
        self.assertAlmostEqual(got[1][RIGHT], 159.5 + 160 / math.tan(0.25) * 0.5 / 2.5, delta=1.0)
        self.order("robot", "width 160")
        self.frames(got, 50, 3)
        self.assertEqual(got[2][WIDTH:DEPTH], (160, 240))
        self.assertAlmostEqual(got[2][RIGHT], 79.5 + 80 / math.tan(0.25) * 0.5 / 2.5, delta=1.0)

    def test_what_no_camera_can_be_is_one_line(self):
        got = self.frames(self.spawned(), 50, 1)
        self.order("robot", "hfov 7")
        self.sim.step(100)
        self.wait(lambda: any("robot_eye" in line and "horizontal_fov 7" in line for line in self.log))
        self.assertEqual(len(got), 1)
        self.order("robot", "hfov 0.9")
        self.frames(got, 50, 2)
        self.assertEqual(len([line for line in self.log if "horizontal_fov 7" in line]), 1)

    def test_a_picture_is_saved(self):
        import cv2

        self.frames(self.spawned(), 50, 1)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "deep", "picture.png")
            self.assertEqual(self.order("robot", f"save {file}"), "save true")
            image = cv2.imread(file)
            self.assertEqual(image.shape, (240, 320, 3))
            blue, green, red = (int(value) for value in image[119, 159])
            self.assertGreater(red, 2 * max(green, blue, 20))
            self.assertEqual(self.order("robot", f"save {folder}/picture.nothing"), "save false")
        self.wait(lambda: any("picture.nothing" in line for line in self.log))

    def test_the_scene_knows_where_visuals_are(self):
        self.spawned(on=0)
        self.assertEqual(self.order("robot", "visual box::l::v"), "visual 3.000000")
        self.assertEqual(self.order("robot", "visual box"), "visual 3.000000")
        self.assertEqual(self.order("robot", "visual nobody"), "visual none")

    # -- who looks, and how it ends

    def test_a_sensor_that_is_switched_on_and_off(self):
        got = self.frames(self.spawned(on=0), 120, 0)
        self.order("robot", "active 1")
        self.frames(got, 100, 2)
        self.order("robot", "active 0")
        self.frames(got, 100, 2)
        self.assertEqual([round(frame[TIME], 6) for frame in got], [0.15, 0.2])  # of the same clock as if it had always been on

    def test_removal_and_coming_again(self):
        for _ in range(3):
            self.frames(self.spawned(), 50, 1)
            self.done(self.sim.delete("robot"))
            self.sim.step(50)
            self.clear(self.subscribers[1:])
            self.sim.empty("reset_simulation")
            self.done(self.sim.spawn("box", BOX))
            for subscriber in self.subscribers[1:]:
                subscriber.unregister()
            del self.subscribers[1:]

    def test_a_callback_that_throws_is_one_line_and_others_go_on(self):
        bad, good = self.spawned(more="<throws>1</throws>"), self.spawned("other")
        self.sim.step(200)
        self.wait(lambda: len(good) == 4 and any("no film" in line for line in self.log))
        self.assertEqual(len(bad), 1)
        self.assertEqual(len([line for line in self.log if "no film" in line and "plugin viewer" in line]), 1)

    def test_a_plugin_of_cameras_in_another_sensor_is_one_line(self):
        self.done(self.sim.spawn("robot", robot(plugin=RANGER, viewer=False)))
        self.wait(lambda: any("plugin ranger" in line and "belongs into a sensor of type depth" in line for line in self.log))

    def test_a_size_that_no_picture_has_is_one_line(self):
        cameras = camera().replace("<width>320", "<width>-3")
        self.done(self.sim.spawn("robot", robot(cameras=cameras, viewer=False)))
        self.wait(lambda: any("robot_eye" in line and "-3x240" in line for line in self.log))


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class ProcessTest(Case):
    """A server of its own, that does not wait for pictures."""

    @classmethod
    def setUpClass(cls):
        pass

    def setUp(self):
        pass

    @staticmethod
    def drawing(server):
        """Processes that draw for this server."""
        pid, found = server.node_pid(), []
        for each in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{each}/stat", encoding="utf-8") as file:
                    parent = int(file.read().rpartition(")")[2].split()[1])
                with open(f"/proc/{each}/cmdline", encoding="utf-8") as file:
                    if parent == pid and "ode_sim_rendering.worker" in file.read():
                        found.append(int(each))
            except OSError:
                continue
        return found

    def listened(self):
        got = []
        subscriber = rospy.Subscriber("/eyes/view/robot_eye", Float64MultiArray, lambda m: got.append(m.data[TIME]))
        self.wait(lambda: heard([subscriber]))
        return got, subscriber

    def passes(self, sim, seconds):
        end = sim.world().sim_time + seconds
        self.wait(lambda: sim.world().sim_time > end)

    def test_nothing_is_drawn_for_nobody_and_running_worlds_lose_their_cameras(self):
        world = os.path.join(os.path.dirname(os.path.abspath(__file__)), "worlds", "compiled.world")
        with Server("eyes", world) as server:
            sim = server.simulator()
            sim.spawn("box", BOX)
            self.done(sim.spawn("robot", robot(on=0)))
            self.done(sim.spawn("blind", robot("blind", viewer=False)))  # always on, but nobody looks
            self.passes(sim, 0.5)
            self.assertEqual(self.drawing(server), [])
            got, subscriber = self.listened()
            answer_of(self, "/eyes/view/robot_eye", "active 1")
            self.wait(lambda: len(got) > 3)
            self.assertEqual(len(self.drawing(server)), 1)
            self.assertEqual([round((time - got[0]) / 0.05, 6) % 1 for time in got], [0] * len(got))
            sim.empty("reset_simulation")
            self.wait(lambda: any(late < early for early, late in zip(got, got[1:])))
            self.done(sim.delete("robot"))
            self.passes(sim, 0.2)
            subscriber.unregister()
            self.wait(lambda: not [name for name, _ in rospy.get_published_topics() if name.startswith("/eyes/view/")])
            self.done(sim.spawn("robot", robot()))
            got, subscriber = self.listened()
            self.wait(lambda: got)
            subscriber.unregister()
            code, text = server.end()
        self.assertEqual(code, 0, text)
        self.assertNotIn("Traceback", text)


if __name__ == "__main__":
    rospy.init_node("compiled_cameras_rostest")
    rostest.rosrun("gazebo_ros", "compiled_cameras", "__main__")
