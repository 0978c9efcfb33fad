#!/usr/bin/env python3
"""Plugins in C++, as their authors build them, on models and on the world."""

import importlib.util
import os
import sys
import unittest

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import PointStamped
from rosgraph_msgs.msg import Log
from std_msgs.msg import Float64, Float64MultiArray, String
from std_srvs.srv import Empty
from test_support.hearing import heard

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulator import Case, pose  # noqa: E402

URDF = """<robot name="arm"><link name="world"/><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="tip"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="0.5" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="bolt" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>
<joint name="elbow" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
<limit lower="-3" upper="3" effort="5" velocity="50"/></joint>
<gazebo><plugin name="worker" filename="libgazebo_ros_test_{library}.so">{more}</plugin></gazebo></robot>"""
BOX = """<sdf version="1.6"><model name="box"><pose>5 0 50 0 0 0</pose><link name="tip"><inertial><mass>2</mass></inertial></link>
<plugin name="worker" filename="gazebo_ros_test_worker"><force>0 6 0</force></plugin></model></sdf>"""

ACTOR = """<sdf version="1.6"><actor name="walker"><skin><filename>walk.dae</filename></skin>
<animation name="walking"><filename>walk.dae</filename><interpolate_x>true</interpolate_x></animation>
<script><trajectory id="0" type="walking"><waypoint><time>0</time><pose>9 9 0 0 0 0</pose></waypoint>
<waypoint><time>9</time><pose>0 9 0 0 0 0</pose></waypoint></trajectory></script>
<plugin name="walker" filename="libgazebo_ros_test_walker.so">{more}</plugin></actor></sdf>"""
CRATE = """<sdf version="1.6"><model name="crate"><pose>1 0 0.5 0 0 0</pose><link name="l"><inertial><mass>5</mass></inertial>
<collision name="c"><geometry><box><size>0.2 1 1</size></box></geometry>
<surface><friction><ode><mu>0.3</mu><mu2>0.3</mu2></ode></friction></surface></collision></link></model></sdf>"""


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class CompiledTest(Case):
    def setUp(self):
        self.told, self.log, self.seen = [], [], []
        self.subscribers = [
            rospy.Subscriber("/keeper/told", String, lambda m: self.told.append(m.data)),
            rospy.Subscriber("/rosout", Log, lambda m: self.log.append(m.msg)),
            rospy.Subscriber("/arm/seen", PointStamped, self.seen.append),
            rospy.Subscriber("/box/seen", PointStamped, self.seen.append),
        ]
        self.orders = rospy.Publisher("/keeper/orders", String, queue_size=10)
        self.wait(lambda: heard(self.subscribers[:2]) and self.orders.get_num_connections())
        self.sim.empty("reset_simulation")

    def tearDown(self):
        self.clear(self.subscribers[2:])
        for subscriber in self.subscribers:
            subscriber.unregister()
        self.orders.unregister()

    def step_until(self, condition):
        def one_more():
            self.sim.step(1)
            return condition()

        self.wait(one_more)

    def spawn_arm(self, library="worker", more=""):
        self.done(self.sim.spawn("arm", URDF.format(library=library, more=more), kind="urdf"))

    def test_model_plugin_drives_a_joint(self):
        self.spawn_arm(more="<effort>0.25</effort>")
        self.sim.step(1)
        self.wait(lambda: heard(self.subscribers[2:3]))
        self.sim.step(399)
        self.wait(lambda: self.seen)  # 0.25 N m on 0.5 kg m2 for 0.4 s
        joint = self.sim.joint("elbow")
        self.assertAlmostEqual(joint.rate[0], 0.2, delta=1e-3)
        self.assertAlmostEqual(joint.position[0], 0.04, delta=1e-3)
        self.assertEqual({m.header.frame_id for m in self.seen}, {"same"})  # ros::Time::now() is that of the step
        effort = rospy.Publisher("/arm/effort", Float64, queue_size=1, latch=True)
        effort.publish(-3.0)
        self.step_until(lambda: self.sim.joint("elbow").rate[0] < -0.1)
        self.orders.publish("go 4")  # over Gazebo's transport, from the world's plugin
        self.step_until(lambda: self.sim.joint("elbow").rate[0] > 0.1)
        effort.unregister()

    def test_a_joint_put_in_place_in_every_step_keeps_what_is_beyond_it_falling(self):
        bolt = URDF[URDF.index('<joint name="bolt"') : URDF.index('<joint name="elbow"')]
        free = URDF.replace('<link name="world"/>', "").replace(bolt, "")
        self.done(self.sim.spawn("arm", free.format(library="worker", more="<effort>0.25</effort><hold>true</hold>"), kind="urdf"))
        self.sim.step(200)
        twist = self.sim.model("arm").twist
        self.assertAlmostEqual(twist.linear.z, -1.96, delta=0.01)
        self.assertLess(abs(twist.angular.x) + abs(twist.angular.y), 1e-3)
        self.assertAlmostEqual(self.sim.joint("elbow").position[0], 0.0, delta=1e-3)

    def test_gains_of_the_joint_controller_that_are_too_high_for_the_step_hold(self):
        """0.5 kg m2 without friction: held through a step, the first would swing for ever, the second be thrown to and fro."""
        self.spawn_arm(more="<position_gain>1e5</position_gain><target>4e-5</target>")  # within its 5 N m
        self.sim.step(1000)
        joint = self.sim.joint("elbow")
        self.assertAlmostEqual(joint.position[0], 4e-5, delta=1e-9)
        self.assertAlmostEqual(joint.rate[0], 0.0, delta=1e-9)
        self.clear(self.subscribers[2:])
        self.spawn_arm(more="<speed_gain>2000</speed_gain><target>0.5</target>")
        self.sim.step(200)
        for _ in range(5):
            self.sim.step(1)
            self.assertAlmostEqual(self.sim.joint("elbow").rate[0], 0.5, delta=1e-6)

    def test_model_plugin_walks_an_actor_through_what_it_meets(self):
        self.done(self.sim.spawn("walker", ACTOR.format(more=""), pose(z=1.2)))
        self.done(self.sim.spawn("crate", CRATE))
        self.sim.step(500)
        at = self.sim.model("walker").pose
        self.near((at.position.x, at.position.y, at.position.z), (0.4, 0.0, 1.2), 6)  # not where the script would have it
        knees = [self.sim.link(f"walker::{side}Leg").link_state.pose.position for side in ("Left", "Right")]
        self.assertGreater(abs(knees[0].x - knees[1].x) + abs(knees[0].z - knees[1].z), 0.05)
        self.sim.step(1500)
        self.near([self.sim.model("crate").pose.position.x], [1.0], 3)
        self.sim.empty("reset_simulation")
        self.sim.step(250)
        self.near([self.sim.model("walker").pose.position.x], [0.2], 3)

    def test_an_actor_that_its_plugin_lets_collide_pushes(self):
        self.done(self.sim.spawn("walker", ACTOR.format(more="<thick>6</thick>"), pose(z=1.0)))
        self.done(self.sim.spawn("crate", CRATE))
        self.sim.step(2000)
        walked = self.sim.model("walker").pose.position.x
        self.assertAlmostEqual(walked, 1.6, delta=1e-6)
        self.assertTrue(walked < self.sim.model("crate").pose.position.x < 5.0, self.sim.model("crate").pose.position)

    def test_model_plugin_moves_its_model_along_an_animation(self):
        moved = CRATE.replace("</model>", '<static>1</static><plugin name="m" filename="gazebo_ros_test_mover"/></model>')
        self.done(self.sim.spawn("crate", moved))
        for steps, x, z in ((1000, 1.0, 1.0), (500, 1.5625, 1.0), (499, 1.9995, 1.0), (2, 2.0, 5.0), (500, 2.0, 5.0)):
            self.sim.step(steps)
            place = self.sim.model("crate").pose.position
            self.assertAlmostEqual(place.x, x, delta=2e-3)
            self.assertAlmostEqual(place.z, z, delta=1e-9)

    def test_a_plugin_of_an_actor_on_a_model_is_one_line(self):
        self.spawn_arm(library="walker")
        self.logged("plugin worker", "of model arm", "its Load() threw this is no actor")

    def test_private_parameters_are_those_of_the_simulator(self):
        rospy.set_param("/gazebo/worker_effort", 0.5)
        try:
            self.spawn_arm()
            self.sim.step(400)
            self.assertAlmostEqual(self.sim.joint("elbow").rate[0], 0.4, delta=1e-3)
        finally:
            rospy.delete_param("/gazebo/worker_effort")

    def test_the_graph_has_no_clock_but_clock(self):
        self.spawn_arm()
        self.sim.step(1)
        topics = {topic for _, registered in zip("ps", rosgraph.Master("/test").getSystemState()) for topic, _ in registered}
        self.assertIn("/arm/effort", topics)  # the plugin's node is there
        self.assertEqual({topic for topic in topics if "clock" in topic}, {"/clock"})
        self.assertTrue(rospy.get_param("/use_sim_time"))

    def test_model_plugin_pushes_and_moves_its_model(self):
        self.done(self.sim.spawn("box", BOX))
        self.sim.step(100)
        state = self.sim.model("box")
        self.assertAlmostEqual(state.twist.linear.y, 6.0 / 2.0 * 0.1, delta=1e-6)
        self.assertAlmostEqual(state.twist.linear.z, -0.98, delta=1e-3)
        rospy.wait_for_service("/box/lift", 10)
        rospy.ServiceProxy("/box/lift", Empty)()
        state = self.sim.model("box")
        self.assertEqual((state.pose.position.x, state.pose.position.z), (0.0, 5.0))
        self.done(self.sim.delete("box"))
        self.wait(lambda: "/box/lift" not in self.services())  # the plugin ended with its model

    def test_a_joint_tells_what_it_bears(self):
        """The recorded bench of Gazebo 11.1, 2 kg on a wrist that is rolled by 0.4 rad: body 2 is the child, and what it bears on its
        parent, in its own axes; body 1 the parent, and what it bears on its child, in its own."""
        bench = """<sdf version="1.6"><model name="any"><pose>0 0 3 0 0 0</pose><link name="base"/>
            <link name="weight"><pose>0 -0.5 1 0.4 0 0</pose><inertial><pose>0.1 0 0.05 0 0 0</pose><mass>2</mass></inertial></link>
            <joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
            <joint name="wrist" type="revolute"><parent>base</parent><child>weight</child><axis><xyz>0 0 1</xyz>
            <limit><lower>0</lower><upper>0</upper></limit></axis></joint>
            <plugin name="w" filename="libgazebo_ros_test_weigher.so"><joint>wrist</joint></plugin></model></sdf>"""
        borne = []
        self.subscribers.append(rospy.Subscriber("/borne", Float64MultiArray, lambda m: borne.append(m.data)))
        self.done(self.sim.spawn("bench", bench))
        self.step_until(lambda: len(borne) > 200)
        for got, wanted in zip(borne[-1][:6], (0.0, -7.632, -18.053, 0.3816, 1.8053, -0.7632)):
            self.assertAlmostEqual(got, wanted, delta=0.02)
        for got, wanted in zip(borne[-1][6:9], (0.0, 0.0, 2 * 9.8)):
            self.assertAlmostEqual(got, wanted, delta=0.02)

    @staticmethod
    def services():
        return {name for name, _ in rospy.get_master().getSystemState()[2][2]}

    def test_the_element_of_a_world_plugin_stands_in_its_world(self):
        told = []
        subscriber = rospy.Subscriber("/neighbour/told", String, lambda m: told.append(m.data))
        self.wait(lambda: told)
        subscriber.unregister()
        self.assertEqual(told, ["world compiled, plugin wind, world compiled, plugin neighbour"])

    def test_world_plugin_inserts_hears_and_removes(self):
        self.wait(lambda: "loaded hello in compiled" in self.told or "reset" in self.told)
        self.orders.publish("insert")
        self.wait(lambda: "inserted" in self.sim.world().model_names)
        self.step_until(lambda: "weight 10" in self.told)  # forces of its contacts with the ground
        for order, told, low, high in (("hold", "held", 0.499, 0.501), ("free", "freed", 0.55, 0.7)):
            self.orders.publish(order)  # a joint that is made, and made firm, while the simulation runs
            self.wait(lambda: told in self.told)
            self.sim.push("inserted::l", (0.0, 0.0, 30.0), 0.1)
            self.sim.step(110)
            self.assertTrue(low < self.sim.model("inserted").pose.position.z < high, (order, self.sim.model("inserted").pose.position))
        self.orders.publish("below")
        self.wait(lambda: "inserted" in self.told)
        self.orders.publish("remove")
        self.wait(lambda: "inserted" not in self.sim.world().model_names)
        self.orders.publish("below")
        self.wait(lambda: "ground_plane" in self.told)

    def test_a_message_places_a_model_of_a_file(self):
        self.orders.publish("place model://construction_cone")
        self.wait(lambda: "Construction Cone" in self.sim.world().model_names)
        at = self.sim.model("Construction Cone").pose.position
        self.assertEqual((round(at.x, 6), round(at.y, 6)), (3.0, -2.0))
        self.orders.publish("place /nowhere/model.sdf")
        self.logged("no file /nowhere/model.sdf")
        self.done(self.sim.delete("Construction Cone"))

    def logged(self, *words):
        self.wait(lambda: any(all(word in line for word in words) for line in self.log))

    def test_what_plugins_do_wrong_is_one_line(self):
        self.spawn_arm(library="incomplete")
        self.logged("plugin worker", "model arm", "libgazebo_ros_test_incomplete.so lacks the symbol gazebo::defined_nowhere()")
        self.assertIn("arm", self.sim.world().model_names)
        self.sim.delete("arm")
        self.spawn_arm(library="keeper")
        self.logged("model arm", "is a world plugin, and stands where a model plugin does")
        self.orders.publish("fail")
        self.step_until(lambda: any("told to fail" in line for line in self.log))
        self.logged("plugin keeper", "of world compiled", "its update threw: told to fail")
        before = self.sim.world().sim_time
        self.sim.step(10)
        self.assertAlmostEqual(self.sim.world().sim_time, before + 0.01, delta=1e-9)

    def test_a_plugin_of_a_visual_is_left_out(self):
        """Its package builds, so that the others of it are there."""
        library = "libgazebo_ros_test_drawer.so"
        model = (
            f"<sdf version='1.6'><model name='arm'><link name='l'><visual name='v'><geometry><sphere><radius>1</radius></sphere>"
            f"</geometry><plugin name='draws' filename='{library}'/></visual></link>"
            f"<plugin name='astray' filename='{library}'/></model></sdf>"
        )
        self.done(self.sim.spawn("arm", model))
        self.logged(library, "plugins of a visual have no effect")
        self.logged("plugin astray", "is a visual plugin: there is nothing here that it could draw on")
        self.assertIn("arm", self.sim.world().model_names)

    def test_two_classes_of_one_name_and_what_fails_before_the_first_step(self):
        self.spawn_arm(library="twin_one")
        self.logged("twin one loaded")
        self.sim.delete("arm")
        self.spawn_arm(library="twin_other")
        self.logged("twin other loaded")
        for place, words in (
            ("Load", ("its Load() threw told to fail",)),
            ("Init", ("its Init() threw something that is no",)),
            ("time", ("libgazebo_ros_test_twin_one.so", "has not come back from its Load() for 5 s")),
        ):
            self.sim.delete("arm")
            self.spawn_arm(library="twin_one", more=f"<fail_in>{place}</fail_in>")
            self.logged("plugin worker", "of model arm", *words)
            self.assertIn("arm", self.sim.world().model_names)


if __name__ == "__main__":
    rospy.init_node("compiled_rostest")
    rostest.rosrun("gazebo_ros", "compiled", CompiledTest)
