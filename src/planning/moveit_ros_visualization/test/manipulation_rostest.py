#!/usr/bin/env python3
"""The tab Manipulation in RViz on a private display, used by real clicks: detect, pick, place."""

import os
import shutil
import tempfile
import unittest

import actionlib
import rospy
import rostest
from geometry_msgs.msg import Point, PoseStamped
from moveit_msgs.msg import CollisionObject, Grasp, GripperTranslation, MoveItErrorCodes, PickupActionGoal, PlaceActionGoal, PlanningScene
from moveit_msgs.srv import GetPlanningScene, GetPlanningSceneRequest, GraspPlanning, GraspPlanningResponse
from object_recognition_msgs.msg import ObjectRecognitionAction, ObjectRecognitionResult, RecognizedObject, Table, TableArray
from rqt_testing.desktop import Desktop
from rviz_desktop import run_rviz
from shape_msgs.msg import SolidPrimitive
from tf.transformations import quaternion_from_euler
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

HERE = os.path.dirname(os.path.abspath(__file__))
REACH = 0.075  # m from the hand's frame to between the finger tips
TOP = 0.21  # m, of the table


def stamped(x, y, z, rpy=(0, 0, 0)):
    pose = PoseStamped()
    pose.header.frame_id = "world"
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
    turn = pose.pose.orientation
    turn.x, turn.y, turn.z, turn.w = quaternion_from_euler(*rpy)
    return pose


def box(name, size, x, y, z):
    pose = stamped(x, y, z)
    item = CollisionObject(
        id=name, header=pose.header, pose=pose.pose, operation=CollisionObject.ADD, primitives=[SolidPrimitive(SolidPrimitive.BOX, size)]
    )
    item.primitive_poses.append(stamped(0, 0, 0).pose)
    return item


def along_z(sign):
    move = GripperTranslation(desired_distance=0.1, min_distance=0.05)
    move.direction.header.frame_id = "world"
    move.direction.vector.z = sign
    return move


def fingers(position):
    return JointTrajectory(
        joint_names=["finger_joint"], points=[JointTrajectoryPoint(positions=[position], time_from_start=rospy.Duration(0.5))]
    )


def from_above(request):
    """A grasp planner."""
    at = request.target.pose.position
    return GraspPlanningResponse(
        error_code=MoveItErrorCodes(MoveItErrorCodes.SUCCESS),
        grasps=[
            Grasp(
                id="from above",
                grasp_pose=stamped(at.x, at.y, at.z + REACH, (0, 3.14159, 0)),
                pre_grasp_approach=along_z(-1.0),
                post_grasp_retreat=along_z(1.0),
                pre_grasp_posture=fingers(0.04),
                grasp_posture=fingers(0.015),
            )
        ],
    )


class Manipulation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rospy.init_node("manipulation_test")
        rospy.wait_for_service("get_planning_scene", 60)
        cls.ask = rospy.ServiceProxy("get_planning_scene", GetPlanningScene)
        cls.publisher = rospy.Publisher("planning_scene", PlanningScene, queue_size=5)
        cls.folder = tempfile.mkdtemp()
        config = os.path.join(cls.folder, "moveit.rviz")
        shutil.copy(os.path.join(HERE, "moveit.rviz"), config)
        cls.desktop = Desktop("1280x940x24")
        cls.desktop.__enter__()
        cls.rviz = run_rviz(cls.desktop, config, "1270x900")
        cls.rviz.wait(lambda: '"Status: Ok"' in (cls.rviz.ask("text", "statuses") or ""), "display without a complaint")
        cls.rviz.click_text("Manipulation")

    @classmethod
    def tearDownClass(cls):
        if os.environ.get("PANEL_PICTURE"):
            cls.desktop.screenshot(os.environ["PANEL_PICTURE"])
        code = cls.rviz.end()
        cls.desktop.__exit__(None, None, None)
        shutil.rmtree(cls.folder)
        assert code == 0, code

    def scene(self):
        """Objects of the world, {attached object: link}, as move_group has them."""
        request = GetPlanningSceneRequest()
        request.components.components = 2 | 4 | 8 | 16
        scene = self.ask(request).scene
        return (
            {item.id: item for item in scene.world.collision_objects},
            {item.object.id: item.link_name for item in scene.robot_state.attached_collision_objects},
        )

    def put(self, *objects):
        message = PlanningScene(is_diff=True)
        message.robot_state.is_diff = True
        message.world.collision_objects = objects
        self.rviz.wait(lambda: self.publisher.get_num_connections() > 0, "subscriber")
        self.publisher.publish(message)
        self.rviz.wait(lambda: set(self.scene()[0]) >= {item.id for item in objects}, "objects in move_group")

    def result(self, begin, timeout=60):
        self.rviz.wait(lambda: self.rviz.text("manipulation_result").startswith(begin), f"result {begin}", timeout)
        return self.rviz.text("manipulation_result")

    def first_row(self, name):
        x, y, *_ = self.rviz.rect(name)
        self.desktop.click_at(x + 20, y + 12)

    def test_1_without_a_recognizer_the_scene_is_listed(self):
        self.assertFalse(self.rviz.ask("enabled", "pick_button"))
        self.put(box("block", (0.03, 0.03, 0.08), 0.45, 0.0, TOP + 0.04), box("far", (0.1, 0.1, 0.1), 5.0, 0.0, 0.5))
        self.rviz.click("detect_objects_button")
        self.assertIn("no node recognizes objects", self.result("Listed"))
        self.rviz.wait(lambda: self.rviz.ask("entry", "block"), "object in the list")
        self.assertIsNone(self.rviz.ask("entry", "far"), "out of the region")
        self.rviz.click("roi_center_x", at=(0.3, 0.5))
        self.desktop.keys("ctrl+a")
        self.desktop.type("5\n")
        self.rviz.wait(lambda: self.rviz.ask("entry", "far") and not self.rviz.ask("entry", "block"), "the other region")
        self.rviz.click("roi_center_x", at=(0.3, 0.5))
        self.desktop.keys("ctrl+a")
        self.desktop.type("0\n")

    def test_2_a_recognizer_is_asked_and_tables_come_into_the_scene(self):
        asked = []

        def recognize(goal):
            asked.append(goal)
            result = ObjectRecognitionResult()
            result.recognized_objects.objects.append(RecognizedObject())
            server.set_succeeded(result)

        server = actionlib.SimpleActionServer("recognize_objects", ObjectRecognitionAction, recognize, auto_start=False)
        server.start()
        tables = rospy.Publisher("table_array", TableArray, queue_size=1)
        self.rviz.wait(tables.get_num_connections, "who listens for tables")
        table = Table(header=stamped(0, 0, 0).header, pose=stamped(0.5, 0.0, TOP).pose)
        table.convex_hull = [Point(x, y, 0.0) for x, y in ((-0.15, -0.4), (0.15, -0.4), (0.15, 0.4), (-0.15, 0.4))]
        tables.publish(TableArray(tables=[Table(), table]))  # the first has no outline
        self.rviz.wait(lambda: "table_0" in self.scene()[0], "table in move_group")
        self.rviz.click("detect_objects_button")
        self.result("Recognized: 1 object")
        self.assertEqual(len(asked), 1)
        self.rviz.wait(lambda: self.rviz.ask("entry", "table_0"), "table in the list")

    def test_3_without_grasps_move_group_makes_its_own_and_says_why_it_cannot(self):
        goals = []
        subscriber = rospy.Subscriber("pickup/goal", PickupActionGoal, goals.append)
        self.rviz.wait(lambda: self.rviz.ask("entry", "block"), "object in the list")
        self.first_row("detected_objects_list")
        self.rviz.wait(lambda: self.rviz.ask("enabled", "pick_button"), "object that is chosen")
        self.rviz.click("pick_button")
        said = self.result("Failed: ")
        subscriber.unregister()
        goal = goals[-1].goal
        self.assertEqual(
            (goal.target_name, goal.group_name, goal.end_effector, goal.possible_grasps), ("block", "manipulator", "gripper", [])
        )
        self.assertEqual((goal.support_surface_name, goal.allow_gripper_support_collision), ("table_0", True))
        self.assertIn("PLANNING_FAILED", said)
        self.assertNotIn("\n", said)

    def test_4_an_object_is_picked_up_with_planned_grasps_and_put_down(self):
        rospy.Service("plan_grasps", GraspPlanning, from_above)
        places = []
        rospy.Subscriber("place/goal", PlaceActionGoal, places.append)
        self.rviz.click("pick_button")
        self.result("Picked up 'block' by a grasp of")
        self.assertEqual(self.scene()[1], {"block": "hand"})
        self.rviz.wait(lambda: not self.rviz.ask("entry", "block"), "list without what is in the hand")
        self.assertFalse(self.rviz.ask("enabled", "place_button"))
        self.first_row("support_surfaces_list")
        self.rviz.wait(lambda: self.rviz.ask("enabled", "place_button"), "surface that is chosen")
        self.rviz.click("place_button")
        self.result("Put 'block' on 'table_0'")
        objects, attached = self.scene()
        self.assertEqual(attached, {})
        self.assertAlmostEqual(objects["block"].pose.position.z, TOP + 0.04, delta=2e-3)
        location = places[-1].goal.place_locations[0]
        self.assertEqual(
            (location.pre_place_approach.direction.vector.z, location.post_place_retreat.direction.vector.z),
            (-1.0, 1.0),
            "down, and back up the way it came",
        )
        self.assertGreater(len(places[-1].goal.place_locations), 10)


if __name__ == "__main__":
    rostest.rosrun("moveit_ros_visualization", "manipulation_test", Manipulation)
