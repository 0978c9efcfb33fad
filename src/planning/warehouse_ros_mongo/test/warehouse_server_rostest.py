#!/usr/bin/env python3
"""The launch files of generated packages give a warehouse: the nodes that fill it, empty it and show it."""

import os
import subprocess
import tempfile
import unittest

import rospy
import rostest
from moveit_msgs.msg import CollisionObject, Constraints, MotionPlanRequest, PlanningScene, RobotState
from moveit_ros_warehouse.location import connect
from shape_msgs.msg import SolidPrimitive
from test_support import wait_until

PATIENCE = 150.0  # s, for a busy machine


def run(program, *arguments, folder=None):
    """(exit code, what a node of moveit_ros_warehouse said)."""
    done = subprocess.run(
        ["rosrun", "moveit_ros_warehouse", program, *arguments], cwd=folder, capture_output=True, text=True, timeout=PATIENCE
    )
    return done.returncode, done.stdout + done.stderr


def send(topic, message):
    """Publish once, to one who listens."""
    publisher = rospy.Publisher(topic, type(message), queue_size=1)
    wait_until(publisher.get_num_connections, f"a listener on {topic}")
    publisher.publish(message)
    return publisher


def kitchen():
    box = CollisionObject(id="box", primitives=[SolidPrimitive(SolidPrimitive.BOX, [0.1, 0.2, 0.3])])
    box.pose.position.x = box.pose.orientation.w = 1.0
    scene = PlanningScene(name="kitchen", is_diff=True)
    scene.robot_state.is_diff = True
    scene.world.collision_objects = [box]
    return scene


class WarehouseServer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = connect(patience=PATIENCE)

    def test_1_what_is_sent_is_saved(self):
        base = self.base
        self.assertNotIn(".ros/warehouse", base.path)
        publishers = [send("planning_scene", kitchen())]
        wait_until(lambda: base.scenes.has("kitchen"), "the scene")
        self.assertEqual([item.id for item in base.scenes.load("kitchen").world.collision_objects], ["box"])
        publishers.append(send("motion_plan_request", MotionPlanRequest(group_name="manipulator")))
        wait_until(lambda: base.requests.names(scene="kitchen"), "the request")
        publishers.append(send("constraints", Constraints(name="kitchen:upright")))
        wait_until(lambda: base.constraints.names() == ["kitchen:upright"], "the constraints")
        state = RobotState()
        state.joint_state.name, state.joint_state.position = ["joint_1"], [0.5]
        publishers.append(send("robot_state", state))
        wait_until(lambda: base.states.names() == ["S0"], "the state")

    def test_2_through_text_files(self):
        base = self.base
        base.states.rename("S0", "kitchen_start")
        with tempfile.TemporaryDirectory() as folder:
            code, text = run("moveit_warehouse_save_as_text", folder=folder)
            self.assertEqual(code, 0, text)
            scene, query = (os.path.join(folder, f"kitchen.{ending}") for ending in ("scene", "queries"))
            with open(scene, encoding="utf-8") as file:
                words = file.read()
            self.assertIn("* box\n1 0 0\n0 0 0 1\n1\nbox\n0.1 0.2 0.3\n", words)
            with open(scene, "w", encoding="utf-8") as file:
                file.write(words.replace("kitchen", "office").replace("* box", "* chest"))
            with open(query, "a", encoding="utf-8") as file:
                file.write("goal\n1\nlink_constraint\ngrasp\nhand\nxyz 0.3 0 0.5\nrpy 0 0 0\n.\n")
            code, text = run("moveit_warehouse_import_from_text", "--scene", scene, "--queries", query)
            self.assertEqual(code, 0, text)
            code, text = run("moveit_warehouse_import_from_text", "--scene", query)
            self.assertEqual((code, "Traceback" in text), (1, False))
            self.assertIn("kitchen.queries: line ", text)
        self.assertEqual([item.id for item in base.scenes.load("office").world.collision_objects], ["chest"])
        self.assertEqual(
            dict(zip(*(getattr(base.states.load("kitchen_start").joint_state, field) for field in ("name", "position"))))["joint_1"], 0.5
        )
        self.assertEqual(base.constraints.load("grasp").position_constraints[0].link_name, "hand")

    def test_3_broadcast(self):
        heard = []
        rospy.Subscriber("planning_scene", PlanningScene, lambda message: heard.append(("scene", message.name)))
        rospy.Subscriber("constraints", Constraints, lambda message: heard.append(("constraints", message.name)))
        code, text = run("moveit_warehouse_broadcast", "--scene", "kit.*", "--constraint", "gra.*")
        self.assertEqual(code, 0, text)
        wait_until(lambda: len(heard) == 2, "the messages")
        self.assertEqual(heard, [("scene", "kitchen"), ("constraints", "grasp")])

    def test_4_reset(self):
        code, text = run("moveit_init_demo_warehouse")
        self.assertEqual(code, 0, text)
        self.assertEqual((self.base.scenes.names(), self.base.states.names()), (["default"], ["default"]))
        self.assertEqual(self.base.constraints.names(planning_group="manipulator"), ["hand:upright"])
        self.assertEqual(self.base.scenes.load("default").robot_model_name, "arm")


if __name__ == "__main__":
    rospy.init_node("warehouse_server_rostest")
    rostest.rosrun("warehouse_ros_mongo", "warehouse_server", WarehouseServer)
