#!/usr/bin/env python3
"""The modules that upstream compiles, by their names: messages go in and out serialised, setters answer."""

import unittest

import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from moveit_commander.conversions import msg_from_string, msg_to_string
from moveit_msgs.msg import (
    CollisionObject,
    Constraints,
    JointConstraint,
    MotionPlanRequest,
    MoveItErrorCodes,
    PlannerInterfaceDescription,
    PlanningScene,
    RobotState,
    RobotTrajectory,
)
from moveit_ros_planning_interface._moveit_move_group_interface import MoveGroupInterface
from moveit_ros_planning_interface._moveit_planning_scene_interface import PlanningSceneInterface
from moveit_ros_planning_interface._moveit_robot_interface import RobotInterface
from moveit_ros_planning_interface._moveit_roscpp_initializer import roscpp_init, roscpp_shutdown
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from test_support import wait_until
from visualization_msgs.msg import MarkerArray

HOME = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]


def read(kind, data):
    message = kind()
    msg_from_string(message, data)
    return message


class Group(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        roscpp_init("client", [])
        cls.group = MoveGroupInterface("manipulator", "robot_description", "", 60.0)

    @classmethod
    def tearDownClass(cls):
        roscpp_shutdown()

    def setUp(self):
        self.group.clear_pose_targets()
        self.group.set_start_state_to_current_state()
        self.assertTrue(self.group.set_joint_value_target(HOME))
        self.assertTrue(self.group.move())

    def test_a_plan_is_executed_once(self):
        self.group.set_named_target("left")
        code, trajectory, seconds = self.group.plan()
        self.assertEqual(read(MoveItErrorCodes, code).val, MoveItErrorCodes.SUCCESS)
        self.assertGreater(seconds, 0.0)
        self.assertTrue(self.group.execute(trajectory))
        self.assertAlmostEqual(self.group.get_current_joint_values()[0], 1.2, delta=0.01)
        self.assertFalse(self.group.execute(trajectory))  # it begins elsewhere

    def test_setters_answer(self):
        self.assertTrue(self.group.set_joint_value_target("joint_1", 0.3))
        self.assertTrue(self.group.set_joint_value_target({"joint_2": -0.5}))
        joints = JointState(name=["joint_3"], position=[1.5])
        self.assertTrue(self.group.set_joint_value_target_from_joint_state_message(msg_to_string(joints)))
        np.testing.assert_allclose(self.group.get_joint_value_target()[:3], [0.3, -0.5, 1.5])
        answers = [
            self.group.set_joint_value_target([9.0] * 6),
            self.group.set_joint_value_target("knee", 1.0),
            self.group.set_named_target("nowhere"),
            self.group.set_end_effector_link("claw"),
            self.group.set_pose_target([1.0, 2.0]),
        ]
        self.assertEqual(answers, [False] * 5)
        with self.assertRaises(AttributeError):
            self.group.set_wings(1)

    def comes_to(self, pose, tolerance):
        """The states of pretended controllers come a little late."""
        wait_until(lambda: np.allclose(self.group.get_current_pose(), pose, atol=tolerance), f"the hand at {pose}")

    def test_poses_are_lists_and_lines_are_followed(self):
        present = self.group.get_current_pose()
        self.assertEqual(len(present), 7)
        goal = [*present[:2], present[2] - 0.02, *present[3:]]
        for options in ((True,), (0.0, True), (True, msg_to_string(Constraints()))):
            line, fraction = self.group.compute_cartesian_path([goal], 0.005, *options)
            self.assertEqual(fraction, 1.0, options)
        self.assertTrue(self.group.execute(line))
        self.comes_to(goal, 1e-3)
        self.assertTrue(self.group.set_pose_target(present))
        self.assertTrue(self.group.move())
        self.comes_to(present, 2e-3)
        pose = Pose(Point(*goal[:3]), Quaternion(*goal[3:]))
        self.assertTrue(self.group.set_joint_value_target_from_pose(msg_to_string(pose), "", False))

    def test_requests_states_and_constraints_are_serialised(self):
        self.group.set_planner_id("RRTConnect")
        self.group.set_workspace(-1, -1, -1, 1, 1, 2)
        request = read(MotionPlanRequest, self.group.construct_motion_plan_request())
        self.assertEqual(
            (request.group_name, request.planner_id, request.workspace_parameters.max_corner.z), ("manipulator", "RRTConnect", 2.0)
        )
        state = read(RobotState, self.group.get_current_state())
        state.joint_state.position = [9.0, *state.joint_state.position[1:]]
        bounded = read(RobotState, self.group.enforce_bounds(msg_to_string(state)))
        self.assertLess(bounded.joint_state.position[0], 9.0)
        self.assertIn("joint_1", self.group.get_current_state_bounded())
        kept = Constraints(joint_constraints=[JointConstraint("joint_4", 0.0, 0.5, 0.5, 1.0)])
        self.group.set_path_constraints_from_msg(msg_to_string(kept))
        self.assertEqual(read(Constraints, self.group.get_path_constraints()), kept)
        self.group.clear_path_constraints()
        self.assertEqual(read(PlannerInterfaceDescription, self.group.get_interface_description()).name, "OMPL")

    def test_a_trajectory_gets_new_times(self):
        self.group.set_named_target("left")
        trajectory = self.group.plan()[1]
        now, algorithm = self.group.get_current_state(), "time_optimal_trajectory_generation"
        fast, slow = (
            read(RobotTrajectory, self.group.retime_trajectory(now, trajectory, share, share, algorithm)) for share in (1.0, 0.25)
        )
        fast, slow = (timed.joint_trajectory.points[-1].time_from_start.to_sec() for timed in (fast, slow))
        self.assertGreater(slow, 1.9 * fast)  # twice where the accelerations limit it, four times where the speeds do
        self.assertLess(slow, 4.1 * fast)


class World(unittest.TestCase):
    def test_the_robot(self):
        robot = RobotInterface("robot_description")
        self.assertEqual((robot.get_robot_name(), robot.get_planning_frame(), robot.has_group("legs")), ("arm", "world", False))
        self.assertEqual(robot.get_group_active_joint_names("manipulator"), [f"joint_{k}" for k in range(1, 7)])
        self.assertEqual((robot.get_group_joint_names("legs"), robot.get_joint_limits("knee"), robot.get_link_pose("knee")), ([], [], []))
        self.assertEqual((robot.get_parent_group("hand"), robot.get_parent_group("manipulator")), (("manipulator", "hand"), ("", "")))
        self.assertEqual(robot.get_group_joint_tips("manipulator"), ["hand"])
        self.assertEqual(robot.get_group_default_states("hand"), ["open", "closed"])
        self.assertEqual(robot.get_joint_values("manipulator", "left")["joint_1"], 1.2)
        self.assertEqual(len(robot.get_link_pose("hand")), 7)
        lowest, highest = robot.get_joint_limits("joint_1")[0]
        self.assertTrue(lowest <= robot.get_current_joint_values("joint_1")[0] <= highest)
        everything = len(read(MarkerArray, robot.get_robot_markers()).markers)
        self.assertEqual(len(read(MarkerArray, robot.get_robot_markers(robot.get_current_state())).markers), everything)
        self.assertLess(len(read(MarkerArray, robot.get_group_markers("hand")).markers), everything)
        self.assertEqual(robot.get_group_markers("legs"), b"")

    def test_the_scene(self):
        scene = PlanningSceneInterface()
        box = CollisionObject(id="box", primitives=[SolidPrimitive(SolidPrimitive.BOX, [0.1] * 3)])
        box.header.frame_id, box.pose, box.primitive_poses = "world", Pose(Point(2, 0, 0), Quaternion(0, 0, 0, 1)), [PoseStamped().pose]
        box.primitive_poses[0].orientation.w = 1.0
        diff = PlanningScene(is_diff=True)
        diff.robot_state.is_diff = True
        diff.world.collision_objects = [box]
        self.assertTrue(scene.apply_planning_scene(msg_to_string(diff)))
        self.assertEqual(scene.get_known_object_names(), ["box"])
        self.assertEqual(read(Pose, scene.get_object_poses(["box"])["box"]).position.x, 2.0)
        self.assertEqual(read(CollisionObject, scene.get_objects()["box"]).id, "box")
        self.assertEqual(read(PlanningScene, scene.get_planning_scene(16)).world.collision_objects[0].id, "box")
        self.assertTrue(scene.clear())
        self.assertEqual((scene.get_known_object_names(), scene.get_attached_objects()), ([], {}))


class AllTests(unittest.TestSuite):
    def __init__(self):
        load = unittest.defaultTestLoader.loadTestsFromTestCase
        super().__init__([load(case) for case in (Group, World)])


if __name__ == "__main__":
    rospy.init_node("python_modules_rostest")
    rostest.rosrun("moveit_ros_planning_interface", "python_modules", "python_modules_rostest.AllTests")
