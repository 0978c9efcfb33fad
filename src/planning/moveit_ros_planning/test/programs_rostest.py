#!/usr/bin/env python3
"""The small programs beside a running move_group, started as the tutorials start them."""

import os
import shutil
import subprocess
import tempfile
import unittest

import motion
import rospy
import rostest
from geometry_msgs.msg import Pose, Quaternion
from moveit_msgs.msg import CollisionObject, PlanningScene
from moveit_msgs.srv import ApplyPlanningScene, GetPlanningScene
from shape_msgs.msg import SolidPrimitive

SCENE = "arm_scene\n* {}\n1\nbox\n0.2 0.3 0.4\n1 0 0.5\n0 0 0 1\n0 0 0 0\n.\n"


def run(*words, given="", package="moveit_ros_planning", cwd=None):
    return subprocess.run(["rosrun", package, *words], input=given, capture_output=True, text=True, timeout=60, cwd=cwd)


class Programs(unittest.TestCase):
    def test_model(self):
        said = run("moveit_print_planning_model_info")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("Model arm in frame world, using 8 variables\nJoints: \n", said.stdout)
        self.assertIn("Group 'hand' using 2 variables\n", said.stdout)

    def test_model_that_is_not_loaded(self):
        said = run("moveit_print_planning_model_info", "robot_description:=nothing")
        self.assertEqual(said.returncode, 1)
        self.assertIn("'/nothing' is not set", said.stderr)
        self.assertNotIn("Traceback", said.stderr)

    def test_scene(self):
        rospy.wait_for_service("apply_planning_scene", 30)
        box = CollisionObject(id="crate", operation=CollisionObject.ADD)
        box.header.frame_id = "world"
        box.primitives = [SolidPrimitive(type=SolidPrimitive.BOX, dimensions=[0.1, 0.1, 0.1])]
        box.primitive_poses = [Pose(orientation=Quaternion(0, 0, 0, 1))]
        box.pose.position.x, box.pose.orientation.w = 2.0, 1.0
        scene = PlanningScene(is_diff=True)
        scene.world.collision_objects = [box]
        self.assertTrue(rospy.ServiceProxy("apply_planning_scene", ApplyPlanningScene)(scene).success)
        said = run("moveit_print_planning_scene_info")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("  - Collision World Objects:\n", said.stdout)
        self.assertIn("\t- crate\n", said.stdout)

    def test_scene_without_move_group(self):
        said = run("moveit_print_planning_scene_info", "get_planning_scene:=nowhere")
        self.assertEqual(said.returncode, 1)
        self.assertIn("/nowhere: have you launched move_group?", said.stderr)

    def test_scene_from_text(self):
        for name, options in (("shelf", ["--scene"]), ("board", [])):
            with tempfile.NamedTemporaryFile("w", suffix=".scene") as file:
                file.write(SCENE.format(name))
                file.flush()
                said = run("moveit_publish_scene_from_text", *options, file.name)
                self.assertEqual(said.returncode, 0, said.stderr)
                scene = rospy.ServiceProxy("get_planning_scene", GetPlanningScene)().scene
                self.assertIn(name, [item.id for item in scene.world.collision_objects])

    def test_scene_from_no_text(self):
        for words, told in ([], "a file name was expected"), (["/no/such.scene"], "/no/such.scene"):
            said = run("moveit_publish_scene_from_text", *words)
            self.assertEqual(said.returncode, 1)
            self.assertIn(told, said.stderr)
            self.assertNotIn("Traceback", said.stderr)

    def test_random_states(self):
        heard = []
        listener = rospy.Subscriber("planning_scene", PlanningScene, heard.append)
        self.addCleanup(listener.unregister)
        said = run("moveit_display_random_state", "--valid", given="many\n2\n")
        self.assertEqual(said.returncode, 0, said.stderr)
        self.assertIn("'many' is no number of states", said.stdout)
        self.assertEqual(said.stdout.count("joint_1="), 2)
        self.assertTrue(heard and heard[-1].is_diff)
        self.assertIn("joint_1", heard[-1].robot_state.joint_state.name)

    def test_lists(self):
        said = run("list_move_group_capabilities", package="moveit_ros_move_group").stdout.splitlines()
        self.assertEqual(said[0], "Available capabilities:")
        self.assertIn("move_group/MoveGroupMoveAction", said)
        said = run("moveit_list_request_adapter_plugins").stdout
        self.assertIn(" \t default_planner_request_adapters/FixStartStateBounds\n", said)

    def test_map_from_a_file_and_to_one(self):
        folder = tempfile.mkdtemp()
        self.addCleanup(shutil.rmtree, folder)
        motion.OcTree.from_points([[2.0, 0.0, 0.0]], 0.1).save(os.path.join(folder, "given.bt"))
        for program, file in (("load_map", "given.bt"), ("save_map", "written.bt")):
            said = run(program, file, package="moveit_ros_move_group", cwd=folder)
            self.assertEqual(said.returncode, 0, said.stderr)
        self.assertTrue(motion.OcTree.load(os.path.join(folder, "written.bt")).contains([2.0, 0.0, 0.0]))
        self.assertIn("\t- <octomap>\n", run("moveit_print_planning_scene_info").stdout)

    def test_map_that_is_not_there(self):
        said = run("load_map", "/no/such.bt", package="moveit_ros_move_group")
        self.assertEqual(said.returncode, 1)
        self.assertIn("could not take an octomap from a file", said.stderr)
        self.assertNotIn("Traceback", said.stderr)


if __name__ == "__main__":
    rospy.init_node("programs_rostest")
    rostest.rosrun("moveit_ros_planning", "programs", Programs)
