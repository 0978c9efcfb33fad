#!/usr/bin/env python3
"""What the node gazebo answers to calls that fail, and what stands on the graph: in the world of services_rostest.py, after it."""

import math
import subprocess
import tempfile
import time

import rosgraph
import rospy
import rostest
from gazebo_msgs import srv
from gazebo_msgs.msg import LinkState, ModelState
from gazebo_ros.msg import WorldContacts, WorldView
from gazebo_ros.srv import TakePicture
from geometry_msgs.msg import Pose, Vector3
from rosgraph_msgs.msg import Clock
from simulator import Case, box, pose, twist, urdf, xyz
from std_msgs.msg import Bool, ColorRGBA

NAN = float("nan")


class Words(Case):
    """What Gazebo 11.1 with gazebo_ros_pkgs of Noetic answers to each call that fails: scripts compare with it, so the answer here
    begins with it. Those that it could be seen to give are its own record; the others are in its source."""

    NOBODY = [
        ("get_model_properties", srv.GetModelProperties, {"model_name": "nobody"}, "GetModelProperties: model does not exist"),
        ("get_model_state", srv.GetModelState, {"model_name": "nobody"}, "GetModelState: model does not exist"),
        (
            "get_model_state",
            srv.GetModelState,
            {"model_name": "crate", "relative_entity_name": "nobody"},
            "GetModelState: reference relative_entity_name not found, did you forget to scope the body by model name?",
        ),
        (
            "get_link_state",
            srv.GetLinkState,
            {"link_name": "nobody"},
            "GetLinkState: link not found, did you forget to scope the link by model name?",
        ),
        (
            "get_link_state",
            srv.GetLinkState,
            {"link_name": "crate::box", "reference_frame": "nobody"},
            "GetLinkState: reference reference_frame not found, did you forget to scope the link by model name?",
        ),
        (
            "get_link_properties",
            srv.GetLinkProperties,
            {"link_name": "nobody"},
            "GetLinkProperties: link not found, did you forget to scope the link by model name?",
        ),
        (
            "set_link_properties",
            srv.SetLinkProperties,
            {"link_name": "nobody"},
            "SetLinkProperties: link not found, did you forget to scope the link by model name?",
        ),
        ("get_joint_properties", srv.GetJointProperties, {"joint_name": "nobody"}, "GetJointProperties: joint not found"),
        ("set_joint_properties", srv.SetJointProperties, {"joint_name": "nobody"}, "SetJointProperties: joint not found"),
        ("apply_joint_effort", srv.ApplyJointEffort, {"joint_name": "nobody"}, "ApplyJointEffort: joint not found"),
        ("apply_body_wrench", srv.ApplyBodyWrench, {"body_name": "nobody"}, "ApplyBodyWrench: body does not exist"),
        (
            "apply_body_wrench",
            srv.ApplyBodyWrench,
            {"body_name": "crate::box", "reference_frame": "nobody"},
            "ApplyBodyWrench: reference_frame not found",
        ),
        ("set_model_state", srv.SetModelState, {"model_state": ModelState(model_name="nobody")}, "SetModelState: model does not exist"),
        (
            "set_model_state",
            srv.SetModelState,
            {"model_state": ModelState(model_name="crate", reference_frame="nobody")},
            "SetModelState: specified reference frame entity does not exist",
        ),
        ("set_link_state", srv.SetLinkState, {"link_state": LinkState(link_name="nobody")}, "SetLinkState: link does not exist"),
        (
            "set_link_state",
            srv.SetLinkState,
            {"link_state": LinkState(link_name="crate::box", reference_frame="nobody")},
            "SetLinkState: failed",
        ),
        ("set_model_configuration", srv.SetModelConfiguration, {"model_name": "nobody"}, "SetModelConfiguration: model does not exist"),
        (
            "set_model_configuration",
            srv.SetModelConfiguration,
            {"model_name": "swing", "joint_names": ["hinge"]},
            "SetModelConfiguration: joint name and position list have different lengths",
        ),
        ("get_light_properties", srv.GetLightProperties, {"light_name": "nobody"}, "getLightProperties: Requested light nobody not found!"),
        ("set_light_properties", srv.SetLightProperties, {"light_name": "nobody"}, "setLightProperties: Requested light nobody not found!"),
        ("delete_light", srv.DeleteLight, {"light_name": "nobody"}, 'DeleteLight: Timeout reached while removing light "nobody"'),
        ("delete_model", srv.DeleteModel, {"model_name": "nobody"}, "DeleteModel: model does not exist"),
        ("spawn_sdf_model", srv.SpawnModel, {"model_name": "crate", "model_xml": box()}, "SpawnModel: Failure - entity already exists."),
        ("spawn_urdf_model", srv.SpawnModel, {"model_name": "crate", "model_xml": urdf()}, "SpawnModel: Failure - entity already exists."),
        (
            "spawn_sdf_model",
            srv.SpawnModel,
            {"model_name": "b", "model_xml": box(), "reference_frame": "nobody"},
            "SpawnModel: reference reference_frame not found, did you forget to scope the link by model name?",
        ),
        ("spawn_urdf_model", srv.SpawnModel, {"model_name": "b", "model_xml": box()}, "SpawnModel: Failure - entity format is invalid."),
        (
            "spawn_urdf_model",
            srv.SpawnModel,
            {"model_name": "b", "model_xml": "nonsense"},
            "SpawnModel: Failure - entity format is invalid.",
        ),
    ] + [
        (
            "spawn_sdf_model",
            srv.SpawnModel,
            {"model_name": "b", "model_xml": text},
            "GazeboRosApiPlugin SpawnModel Failure: input model_xml not SDF or URDF, or cannot be converted to Gazebo compatible format.",
        )
        for text in ("nonsense", "", "<html/>")
    ]

    def test_each_failure_begins_with_gazebos_words_and_goes_on(self):
        for name, service, request, words in self.NOBODY:
            with self.subTest(name=name, words=words):
                answer = self.sim.proxy(name, service)(**request)
                self.refused(answer)
                self.assertEqual(answer.status_message[: len(words)], words)
                self.assertGreater(len(answer.status_message), len(words) + 10)  # and says what to do

    def test_a_header_is_filled_though_the_frame_is_unknown(self):
        self.sim.step(20)
        before = self.sim.model("crate").header.seq
        header = self.sim.model("crate", "nobody").header
        self.assertEqual((header.seq, header.stamp.to_nsec(), header.frame_id), (before + 1, 20_000_000, "nobody"))
        self.assertEqual(self.sim.model("nobody").header.stamp.to_nsec(), 0)

    def test_attenuations_are_single_precision(self):
        light = (
            '<sdf version="1.6"><light name="any" type="point"><attenuation><range>10</range><constant>0.9</constant>'
            "<linear>0.01</linear><quadratic>0.001</quadratic></attenuation></light></sdf>"
        )
        self.done(self.sim.spawn("bulb", light, pose(1, 2, 3)))
        got = self.sim.proxy("get_light_properties", srv.GetLightProperties)("bulb")
        self.assertEqual(
            (got.attenuation_constant, got.attenuation_linear, got.attenuation_quadratic),
            (0.8999999761581421, 0.009999999776482582, 0.0010000000474974513),
        )  # as recorded of Gazebo's sun
        deleted = self.done(self.sim.proxy("delete_light", srv.DeleteLight)("bulb"))
        self.assertEqual(deleted.status_message, "DeleteLight: bulb successfully deleted")
        self.assertEqual(self.done(self.sim.set_physics()).status_message, "physics engine updated")


class Graph(Case):
    """What stands on the graph of a simulator that nobody looks at, as `rostopic list` and `rosnode info` show it."""

    OWN = ("/gazebo/ready", "/gazebo/view", "/gazebo/view_contacts")

    def topics(self):
        publishers, subscribers, _ = rosgraph.Master("/test").getSystemState()
        return {name for name, nodes in publishers + subscribers if nodes}

    def test_topics_that_gazebo_lacks_are_there_only_for_those_who_ask(self):
        self.wait(lambda: not self.topics() & set(self.OWN))  # those of who waited for it at first go after a while
        for topic, kind in zip(self.OWN, (Bool, WorldView, WorldContacts)):
            got = []
            subscriber = rospy.Subscriber(topic, kind, got.append)
            self.wait(lambda: got)
            self.assertIn("/gazebo", dict(rosgraph.Master("/test").getSystemState()[0]).get(topic, []))
            subscriber.unregister()
            self.assertTrue(topic != "/gazebo/ready" or got[0].data)
        self.wait(lambda: not self.topics() & set(self.OWN))
        self.assertTrue(rospy.wait_for_message("/gazebo/ready", Bool, 30).data)  # once more

    def test_it_is_a_subscriber_of_the_clock(self):
        self.assertIn("/gazebo", dict(rosgraph.Master("/test").getSystemState()[1])["/clock"])
        told = subprocess.run(["rosnode", "info", "/gazebo"], capture_output=True, text=True, timeout=60).stdout
        self.assertRegex(told, r"Subscriptions:\s*\n(?: \* .*\n)* \* /clock ")
        self.assertRegex(told, r"topic: /clock\s+\* to: /gazebo\s")


if __name__ == "__main__":
    rospy.init_node("answers_rostest")
    rostest.rosrun("gazebo_ros", "answers", "__main__")
