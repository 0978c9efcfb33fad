#!/usr/bin/env python3
"""Spawning and deleting, and the topics of states: after services_rostest.py, in the same world."""

import math

import rospy
import rostest
import test_support
from gazebo_msgs.msg import LinkStates, ModelStates
from gazebo_ros import names
from simulator import Case, box, pose, twist, urdf, xyz

NAN = float("nan")


class Spawning(Case):
    def tearDown(self):
        for name in set(self.sim.world().model_names) - {"ground_plane", "crate", "swing"}:
            self.sim.delete(name)

    def test_pose_in_the_text_comes_on_top(self):
        half = math.sqrt(0.5)
        text = box(extra="<pose>1 0 0 0 0 0</pose>")
        self.done(self.sim.spawn("a", text, pose(0, 10, 1, qz=half, qw=half)))
        self.near(xyz(self.sim.model("a").pose.position), (0, 11, 1))
        self.done(self.sim.spawn("b", box(), pose(1, 0, 0), frame="a"))
        self.near(xyz(self.sim.model("b").pose.position), (0, 12, 1))

    def test_urdf_by_both_services(self):
        self.done(self.sim.spawn("a", urdf(), pose(z=5), kind="urdf"))
        self.done(self.sim.spawn("b", urdf(), pose(z=8), kind="sdf"))
        self.assertIn("b", self.sim.world().model_names)
        self.assertEqual(self.done(self.sim.link("b::tip")).link_state.pose.position.z, 8)
        self.refused(self.sim.spawn("c", box(), kind="urdf"), "SpawnModel: ", "spawn_sdf_model")

    def test_spawned_models_come_last_and_fall(self):
        self.done(self.sim.spawn("z", box(), pose(-9, 0, 10)))
        self.done(self.sim.spawn("a", box(), pose(-12, 0, 10)))
        self.assertEqual(self.sim.world().model_names[-2:], ["z", "a"])
        self.done(self.sim.set_physics(gravity=(0, 0, -10)))
        self.sim.step(100)
        self.assertAlmostEqual(self.sim.model("z").twist.linear.z, -1.0, 6)

    def test_failures_say_why_and_leave_the_world_alone(self):
        before = self.sim.world().model_names
        bad = [
            ("m", "<sdf version='1.6'><model name='m'>", pose(), "", ["XML"]),
            ("m", "", pose(), "", ["empty"]),
            ("m", "hello", pose(), "", ["XML"]),
            ("m", "<html/>", pose(), "", ["html"]),
            ("m", box(mass=-1), pose(), "", ["mass", "-1"]),
            ("m", box(mass=0), pose(), "", ["mass"]),
            ("m", box(mass="nan"), pose(), "", ["mass", "finite"]),
            ("m", "<sdf version='1.6'><model name='m'/></sdf>", pose(), "", ["link"]),
            ("m", box(), pose(NAN, 0, 0), "", ["nan"]),
            ("m", box(), pose(), "nowhere", ["reference_frame", "nowhere"]),
            ("crate", box(), pose(), "", ["Failure - entity already exists.", "crate"]),
        ]
        for name, text, where, frame, words in bad:
            with self.subTest(text=text, words=words):
                self.refused(self.sim.spawn(name, text, where, frame), "SpawnModel", *words)
        self.assertEqual(self.sim.world().model_names, before)
        self.sim.step(10)
        self.done(self.sim.spawn("good", box(), pose(30, 0, 3)))

    def test_a_missing_mesh_leaves_out_the_shape_only(self):
        self.done(self.sim.spawn("m", box(geometry="<mesh><uri>model://nothing/here.stl</uri></mesh>"), pose(30, 0, 3)))
        mesh = urdf(
            extra="""<link name="extra"><visual><geometry><mesh filename="package://no_such_package/x.dae"/>
            </geometry></visual></link>
            <joint name="f" type="fixed"><parent link="tip"/><child link="extra"/></joint>"""
        )
        self.done(self.sim.spawn("n", mesh, pose(30, 5, 3), kind="urdf"))
        self.sim.step(10)

    def test_unknown_plugins_are_left_out(self):
        plugin = "<plugin name='p' filename=' libno_such_thing.so\n'>...</plugin>"
        self.done(self.sim.spawn("m", box(extra=plugin), pose(30, 0, 3)))
        self.sim.step(10)

    def test_delete(self):
        self.done(self.sim.spawn("m", urdf(), pose(30, 0, 3), kind="urdf"))
        self.sim.push("m::tip", (1, 0, 0), -1)
        self.sim.drive("elbow", 1, -1)
        self.sim.step(5)
        self.done(self.sim.delete("m"))
        self.assertNotIn("m", self.sim.world().model_names)
        self.sim.step(5)
        self.refused(self.sim.delete("m"), "DeleteModel: ", "m", "crate")
        self.done(self.sim.spawn("m", urdf(), pose(30, 0, 3), kind="urdf"))
        self.sim.step(5)
        self.near(xyz(self.sim.link("m::tip").link_state.twist.linear), (0, 0, 0))  # the jobs are gone


class Names(test_support.TestCase):
    def test_tf_prefix_is_searched_upwards(self):
        self.assertEqual(names.tf_prefix("/"), "")
        self.assertEqual(names.tf_prefix("/robot/eye"), "")
        rospy.set_param("/robot/tf_prefix", "r1")
        self.assertEqual([names.tf_prefix(where) for where in ("/robot/eye", "/robot", "robot", "/", "/other")], ["r1", "r1", "r1", "", ""])
        rospy.set_param("/tf_prefix", "all")
        self.assertEqual([names.tf_prefix(where) for where in ("/robot", "/", "/other")], ["r1", "all", "all"])
        rospy.delete_param("/tf_prefix")
        rospy.delete_param("/robot/tf_prefix")


class States(Case):
    def test_topics_agree_with_the_services(self):
        self.sim.set_model("crate", pose(5, 1, 3), twist((0.5, 0, 0), (0, 0, 0.25)))
        messages = {}
        topics = [
            rospy.Subscriber("/gazebo/model_states", ModelStates, lambda m: messages.update(models=m)),
            rospy.Subscriber("/gazebo/link_states", LinkStates, lambda m: messages.update(links=m)),
        ]
        while len(messages) < 2 and not rospy.is_shutdown():
            self.sim.step(1)
            rospy.rostime.wallsleep(0.01)
        self.sim.step(7)
        state = self.sim.model("crate")
        self.wait(lambda: messages["models"].pose[1] == state.pose == messages["links"].pose[1])
        for topic in topics:
            topic.unregister()
        self.assertEqual(messages["models"].name, ["ground_plane", "crate", "swing"])
        self.assertEqual(messages["links"].name, ["ground_plane::link", "crate::box", "swing::stand", "swing::rod"])
        self.assertEqual(messages["models"].twist[1], state.twist)
        self.assertEqual(messages["links"].twist[1], self.sim.link("crate::box").link_state.twist)
        self.assertEqual(len(messages["links"].pose), 4)

    def test_links_of_models_in_models_are_told_too(self):
        self.done(
            self.sim.spawn(
                "outer",
                """<sdf version="1.6"><model name="any"><link name="own"/><include>
            <uri>model://unit_box</uri><name>sub</name></include></model></sdf>""",
                pose(30, 0, 3),
            )
        )
        names = []
        topic = rospy.Subscriber("/gazebo/link_states", LinkStates, lambda m: names.append(m.name[-2:]))
        while ["outer::own", "outer::sub::link"] not in names and not rospy.is_shutdown():
            self.sim.step(1)
            rospy.rostime.wallsleep(0.01)
        topic.unregister()
        self.assertTrue(self.sim.link("outer::sub::link").success)
        self.done(self.sim.delete("outer"))


if __name__ == "__main__":
    rospy.init_node("spawning_rostest")
    rostest.rosrun("gazebo_ros", "spawning", "__main__")
