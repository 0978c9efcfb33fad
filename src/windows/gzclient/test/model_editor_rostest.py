#!/usr/bin/env python3
"""The model editor in a real browser: a pendulum on a post is made by clicks, saved, spawned from its folder, and swings."""

import os
import shutil
import sys
import xml.etree.ElementTree as ET

import numpy as np
import rospy
import rostest
from gazebo_msgs.srv import SpawnModel
from geometry_msgs.msg import Pose
from nav_msgs.msg import Odometry

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from browser import wait  # noqa: E402
from session import FIELD, Session, call, names, paused, world  # noqa: E402

EYE, TARGET = (2.5, -2.5, 2.0), (0.5, 0.0, 0.5)  # of ModelPanel
FLAG = """solid flag
facet normal 0 1 0
outer loop
vertex 0 0 -0.2
vertex 0.6 0 -0.2
vertex 0 0 0.2
endloop
endfacet
facet normal 0 1 0
outer loop
vertex 0.6 0 -0.2
vertex 0.6 0 0.2
vertex 0 0 0.2
endloop
endfacet
endsolid flag
"""
TRUTH = "<bodyName>flag</bodyName><topicName>flag_truth</topicName><frameName>world</frameName><updateRate>0</updateRate>"


class Editor(Session):
    def at(self, x, y, z):
        return self.page.pixel((x, y, z), EYE, TARGET, FIELD)

    def folder(self, *below):
        return os.path.join(self.home.name, "model_editor_models", *below)

    def test_1_links_of_shapes_and_a_mesh_are_joined_by_clicks(self):
        page = self.page
        page.click("Model")
        before = page.scene()
        page.check("Edit a model")
        page.settled(before)
        page.click("Box")
        page.see("1 link,", "Link link")
        for part, size in enumerate((0.2, 0.2, 1.0), 1):
            page.fill("Size (m)", size, part)
        page.fill("Link name", "post")
        page.see("Link post")
        page.click("Cylinder")
        page.see("2 links", "Link link")
        page.click("Delete link")
        page.see("1 link,")
        file = os.path.join(self.home.name, "flag.stl")
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(FLAG)
        page.upload("Add a mesh (STL, OBJ, DAE)", file)
        page.see("2 links", "Link link")
        page.fill("Link name", "flag")
        page.see("Link flag")
        page.fill("Axis", 1, 2)
        page.fill("Axis", 0, 3)
        before = page.scene()
        page.check("Join by clicks")
        page.settled(before)  # without the gizmo, which would be in the way
        page.mouse(self.at(0.0, 0.0, 0.2))
        page.see("joint of post and ...?")
        page.mouse(self.at(1.3, 0.0, 0.5))
        page.see("1 joint,")
        before = page.scene()
        page.check("Join by clicks")
        page.settled(before)
        page.mouse(self.at(0.0, 0.0, 0.2))
        page.see("Link post")
        page.click("Fix the picked link to the world")
        page.see("2 joints")
        self.assertNotIn("joint of", page.text())

    def saved(self):
        """The model as it is saved now."""
        if self.page.value("Model name") != "swing":
            self.page.fill("Model name", "swing")

        def there():
            """A name that was typed comes to the program a little later than a click on the button may."""
            self.page.click("Save model")
            self.page.see("saved in")
            return os.path.exists(self.folder("swing", "model.sdf"))

        wait(there, "swing saved")
        return ET.parse(self.folder("swing", "model.sdf")).getroot().find("model")

    def test_2_a_link_is_moved_by_the_gizmo_and_back(self):
        page = self.page
        before = page.scene()
        page.mouse(self.at(1.3, 0.0, 0.5))
        page.see("Link flag")
        page.settled(before)
        page.mouse(self.at(1.0, 0.0, 0.94), self.at(1.0, 0.0, 1.1), self.at(1.0, 0.0, 1.24), drag=True)  # the arrow upwards

        def place():
            return np.array(self.saved().find("link[@name='flag']/pose").text.split(), float)

        wait(lambda: place()[2] > 0.7, "the flag moved up")
        np.testing.assert_allclose(place(), (1.0, 0.0, 0.8, 0.0, 0.0, 0.0), atol=0.01)
        page.click("Undo")
        wait(lambda: place()[2] < 0.6, "undo")
        np.testing.assert_allclose(place(), (1.0, 0.0, 0.5, 0.0, 0.0, 0.0), atol=1e-6)

    def test_3_a_plugin_is_added_and_all_is_saved(self):
        page = self.page
        page.unfold("Plugin")
        page.fill("Plugin name", "truth")
        page.fill("File name", "libgazebo_ros_p3d.so")
        page.fill("Parameters (XML)", TRUTH)
        page.click("Add plugin")
        page.see("1 plugin")
        model = self.saved()
        self.assertEqual([link.get("name") for link in model.findall("link")], ["post", "flag"])
        self.assertEqual(
            [(joint.get("type"), joint.findtext("parent"), joint.findtext("child")) for joint in model.findall("joint")],
            [("revolute", "post", "flag"), ("fixed", "world", "post")],
        )
        self.assertEqual(model.findtext("plugin/topicName"), "flag_truth")
        self.assertAlmostEqual(float(model.findtext("link[@name='post']/inertial/inertia/ixx")), (0.2**2 + 1.0) / 12, places=6)
        self.assertEqual([float(part) for part in model.findtext("link[@name='flag']/inertial/pose").split()[:3]], [0.3, 0.0, 0.0])
        self.assertEqual({uri.text for uri in model.iter("uri") if uri.text.endswith(".stl")}, {"model://swing/meshes/flag.stl"})
        wait(lambda: sorted(os.listdir(self.folder("swing"))) == ["meshes", "model.config", "model.sdf"], "three files")

    def test_4_what_was_saved_is_inserted_and_swings(self):
        page, told = self.page, []
        page.check("Edit a model")
        page.click("Insert")
        page.check("Put it down with the mouse")
        page.fill("Search", "swing")
        page.click("swing")
        wait(lambda: "swing" in names(), "the model in the world")
        rospy.Subscriber("/flag_truth", Odometry, lambda message: told.append(message.pose.pose.orientation.y))
        page.click("Play")
        wait(lambda: told and max(told) > 0.2, "a flag that swings to the ground")
        page.click("Pause")
        wait(paused, "pause")

    def test_5_its_folder_can_be_moved_and_opened_again(self):
        page = self.page
        elsewhere = os.path.join(self.home.name, ".gazebo", "models", "swing")
        shutil.copytree(self.folder("swing"), elsewhere)
        shutil.rmtree(self.folder("my_model"))
        shutil.rmtree(self.folder("swing"))
        with open(os.path.join(elsewhere, "model.sdf"), encoding="utf-8") as stream:
            answer = call("spawn_sdf_model", SpawnModel, "moved", stream.read(), "/moved", Pose(), "world")
        self.assertTrue(answer.success, answer.status_message)
        flag = next(link for link in world().model("moved").description.links if link.name == "flag")
        self.assertEqual(
            [part.geometry.path for part in (*flag.visuals, *flag.collisions)], 2 * [os.path.join(elsewhere, "meshes", "flag.stl")]
        )
        shutil.copytree(elsewhere, self.folder("swing"))
        page.click("Model")
        page.check("Edit a model")
        page.choose("Saved models", "swing")
        page.click("New model")
        page.see("0 links")
        page.click("Open model")
        page.see("2 links, 2 joints, 1 plugin")


if __name__ == "__main__":
    rospy.init_node("model_editor_test", disable_rostime=True)
    rostest.rosrun("gzclient", "model_editor", "__main__")
