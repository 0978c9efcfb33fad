#!/usr/bin/env python3
"""A block is picked from a table and put down elsewhere."""

import unittest

import moveit_commander
import rospy
import rostest
from dynamic_reconfigure.client import Client
from geometry_msgs.msg import PoseStamped
from moveit_msgs.msg import Grasp, GripperTranslation, MoveItErrorCodes, PlaceActionGoal, PlaceLocation
from sensor_msgs.msg import JointState
from test_support.hearing import heard
from test_support.waiting import wait_until
from tf.transformations import quaternion_from_euler
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

HOME = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]
REACH = 0.075  # m from the hand's frame to between the finger tips
Codes = MoveItErrorCodes


def stamped(x, y, z, rpy=(0, 0, 0)):
    pose = PoseStamped()
    pose.header.frame_id = "world"
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
    turn = pose.pose.orientation
    turn.x, turn.y, turn.z, turn.w = quaternion_from_euler(*rpy)
    return pose


def along_z(sign, desired=0.1, least=0.05):
    move = GripperTranslation(desired_distance=desired, min_distance=least)
    move.direction.header.frame_id = "world"
    move.direction.vector.z = sign
    return move


def fingers(position):
    return JointTrajectory(
        joint_names=["finger_joint"], points=[JointTrajectoryPoint(positions=[position], time_from_start=rospy.Duration(0.5))]
    )


def grasp(x, y, z, name="from above"):
    return Grasp(
        id=name,
        grasp_pose=stamped(x, y, z + REACH, (0, 3.14159, 0)),
        pre_grasp_approach=along_z(-1.0),
        post_grasp_retreat=along_z(1.0),
        pre_grasp_posture=fingers(0.04),
        grasp_posture=fingers(0.015),
    )


class PickPlace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = moveit_commander.PlanningSceneInterface()
        cls.arm = moveit_commander.MoveGroupCommander("manipulator", wait_for_servers=60.0)
        cls.arm.set_max_velocity_scaling_factor(1.0)
        cls.arm.set_planning_time(20.0)

    def setUp(self):
        self.scene.clear()
        self.assertTrue(self.arm.go(HOME))
        self.scene.add_box("table", stamped(0.5, 0.0, 0.2), (0.3, 0.8, 0.02))
        self.scene.add_box("block", stamped(0.45, 0.0, 0.25), (0.03, 0.03, 0.08))
        self.arm.set_support_surface_name("table")

    def finger(self):
        return rospy.wait_for_message("joint_states", JointState, 10).position[6]

    def test_pick_then_place(self):
        ways = [grasp(3.0, 0.0, 0.25, "far away"), grasp(0.45, 0.0, 0.25)]
        self.assertEqual(self.arm.pick("block", ways), Codes.SUCCESS)
        self.assertEqual(list(self.scene.get_attached_objects()), ["block"])
        self.assertEqual(self.scene.get_attached_objects()["block"].link_name, "hand")
        self.assertNotIn("block", self.scene.get_known_object_names())
        self.assertAlmostEqual(self.finger(), 0.015, delta=1e-3)
        place = PlaceLocation(
            id="left",
            place_pose=stamped(0.45, 0.2, 0.251),
            pre_place_approach=along_z(-1.0),
            post_place_retreat=along_z(1.0),
            post_place_posture=fingers(0.04),
        )
        self.assertTrue(self.arm.place("block", place))
        self.assertFalse(self.scene.get_attached_objects())
        put = self.scene.get_object_poses(["block"])["block"].position
        self.assertAlmostEqual(put.y, 0.2, delta=2e-3)
        self.assertAlmostEqual(put.z, 0.251, delta=2e-3)
        self.assertAlmostEqual(self.finger(), 0.04, delta=1e-3)

    def test_a_pose_alone_is_reached_from_above_and_left_backwards(self):
        """As far back as there is room, be it none."""
        goals = []
        subscriber = rospy.Subscriber("/place/goal", PlaceActionGoal, goals.append)
        self.assertFalse(self.arm.place("nothing", stamped(0.45, 0.2, 0.251)))  # goals come from a publisher that is made now
        wait_until(lambda: heard([subscriber]), "the goals' publisher")
        self.assertEqual(self.arm.pick("block", grasp(0.45, 0.0, 0.25)), Codes.SUCCESS)
        self.assertTrue(self.arm.place("block", stamped(0.45, 0.2, 0.251)))
        wait_until(lambda: goals and goals[-1].goal.attached_object_name == "block", "the goal")
        subscriber.unregister()
        location = goals[-1].goal.place_locations[0]
        down, back = location.pre_place_approach, location.post_place_retreat
        self.assertEqual((down.direction.header.frame_id, down.direction.vector.z), (self.arm.get_planning_frame(), -1.0))
        self.assertEqual((back.direction.header.frame_id, back.direction.vector.x), (self.arm.get_end_effector_link(), -1.0))
        self.assertEqual((back.direction.vector.z, back.min_distance), (0.0, 0.0))
        self.assertAlmostEqual(back.desired_distance, 0.2, places=6)

    def test_plan_only_moves_nothing(self):
        self.assertEqual(self.arm.pick("block", grasp(0.45, 0.0, 0.25), plan_only=True), Codes.SUCCESS)
        self.assertIn("block", self.scene.get_known_object_names())

    def test_steps_and_tries_can_be_set(self):
        client = Client("/move_group/pick_place", timeout=30)
        before = client.get_configuration(timeout=30)
        self.assertEqual((before["max_attempted_states_per_pose"], before["cartesian_motion_step_size"]), (5, 0.02))
        after = client.update_configuration({"cartesian_motion_step_size": 0.01, "jump_factor": 0.0})
        self.assertEqual(after["cartesian_motion_step_size"], 0.01)
        self.assertEqual(self.arm.pick("block", grasp(0.45, 0.0, 0.25), plan_only=True), Codes.SUCCESS)

    def test_what_cannot_be_done_has_its_code(self):
        self.assertEqual(self.arm.pick("ghost", grasp(0.45, 0.0, 0.25)), Codes.INVALID_OBJECT_NAME)
        self.assertFalse(self.arm.place("block", stamped(0.45, 0.2, 0.25)))
        self.arm.set_planning_time(2.0)
        self.assertEqual(self.arm.pick("block", grasp(3.0, 0.0, 0.25)), Codes.PLANNING_FAILED)
        self.arm.set_planning_time(20.0)
        self.assertFalse(self.scene.get_attached_objects())


if __name__ == "__main__":
    rospy.init_node("pick_place_rostest")
    rostest.rosrun("moveit_ros_manipulation", "pick_place", PickPlace)
