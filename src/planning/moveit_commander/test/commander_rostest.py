#!/usr/bin/env python3
"""The Python clients, against a running move_group."""

import copy
import io
import math
import os
import subprocess
import tempfile
import unittest

import genpy
import moveit_commander
import numpy as np
import rospy
import rostest
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from moveit_commander import MoveGroupCommander, MoveItCommanderException, PlanningSceneInterface, RobotCommander
from moveit_msgs.msg import (
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    DisplayTrajectory,
    MoveItErrorCodes,
    OrientationConstraint,
    PlanningScene,
    PlanningSceneComponents,
    RobotState,
)
from moveit_ros_warehouse.storage import Warehouse
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive

JOINTS = [f"joint_{number}" for number in range(1, 7)]
HOME = [0.0, -0.6, 1.6, 0.0, 1.0, 0.0]


def stamped(x=0.0, y=0.0, z=0.0, frame="world"):
    pose = PoseStamped(pose=Pose(Point(x, y, z), Quaternion(0, 0, 0, 1)))
    pose.header.frame_id = frame
    return pose


class Commander(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = MoveGroupCommander("manipulator", wait_for_servers=60.0)
        cls.robot = RobotCommander()
        cls.scene = PlanningSceneInterface()

    def setUp(self):
        self.scene.clear()
        self.arm.set_start_state_to_current_state()
        self.arm.clear_pose_targets()
        self.arm.clear_path_constraints()
        self.arm.set_max_velocity_scaling_factor(1.0)
        self.arm.set_max_acceleration_scaling_factor(1.0)
        self.arm.set_planning_time(5.0)
        self.assertTrue(self.arm.go(HOME))

    def at(self, values, tolerance=0.01):
        np.testing.assert_allclose(self.arm.get_current_joint_values(), values, atol=tolerance)


class Targets(Commander):
    def test_what_a_group_is(self):
        self.assertEqual(self.arm.get_name(), "manipulator")
        self.assertEqual(self.arm.get_active_joints(), JOINTS)
        self.assertEqual(self.arm.get_joints(), JOINTS + ["hand_joint"])
        self.assertEqual((self.arm.get_variable_count(), self.arm.get_planning_frame()), (6, "world"))
        self.assertEqual((self.arm.get_end_effector_link(), self.arm.has_end_effector_link()), ("hand", True))
        self.assertEqual(self.arm.get_named_targets(), ["zeros", "home", "left"])
        self.assertEqual(self.arm.get_named_target_values("left")["joint_1"], 1.2)
        self.assertEqual(self.arm.get_goal_tolerance(), (1e-4, 1e-4, 1e-3))
        self.assertEqual(self.arm.get_interface_description().name, "OMPL")

    def test_joint_targets_in_every_form(self):
        set_target, target = self.arm.set_joint_value_target, self.arm.get_joint_value_target
        for values in ([0.1] * 6, (0.2,) * 6, np.full(6, 0.3)):
            set_target(values)
            np.testing.assert_array_equal(target(), values)
        set_target({"joint_2": -0.5})
        set_target("joint_1", 0.7)
        set_target("joint_3", [0.8])
        set_target(JointState(name=["joint_6"], position=[0.9]))
        np.testing.assert_allclose(target(), [0.7, -0.5, 0.8, 0.3, 0.3, 0.9])

    def test_bad_targets_say_what_is_wrong(self):
        cases = [
            (([0.0] * 5,), "length 5"),
            (([9.0] * 6,), "within bounds"),
            (("joint_1",), "value expected"),
            (("knee", 1.0), "'knee'"),
            (({"knee": 1.0},), "'knee'"),
            (([math.nan] * 6,), "Not a number"),
            (([0.0] * 6, 1), "Too many"),
            ((5,), "Unsupported"),
            ((stamped(9.0).pose,), "IK"),
            ((JointState(name=["joint_1"]),), "1 names and 0 positions"),
        ]
        for arguments, words in cases:
            with self.assertRaises(MoveItCommanderException, msg=str(arguments)) as caught:
                self.arm.set_joint_value_target(*arguments)
            self.assertIn(words, str(caught.exception))
            self.assertNotIn("\n", str(caught.exception))
        np.testing.assert_array_equal(self.arm.get_joint_value_target(), [9.0] * 6)  # out of bounds, and yet taken
        for call in (
            lambda: self.arm.set_named_target("nowhere"),
            lambda: self.arm.go("nowhere"),
            lambda: self.arm.set_max_velocity_scaling_factor(0.0),
            lambda: self.arm.set_workspace([1, 2]),
            lambda: self.arm.set_pose_target([1, 2, 3]),
            lambda: self.arm.set_pose_target(Pose(), "claw"),
            lambda: self.arm.execute((True, None, 0, 0)),
            lambda: self.arm.set_end_effector_link("claw"),
        ):
            with self.assertRaises(MoveItCommanderException):
                call()
        with self.assertRaises(RuntimeError) as caught:
            MoveGroupCommander("legs")
        self.assertIn("'legs'", str(caught.exception))
        with self.assertRaises(RuntimeError):
            MoveGroupCommander("manipulator", "nothing_here")

    def test_scripts_for_older_versions_run(self):
        """plan() was the trajectory itself once; scripts end with moveit_commander.os._exit(0)."""
        self.assertTrue(callable(moveit_commander.os._exit) and moveit_commander.rospy is rospy)
        self.assertIs(moveit_commander.PoseStamped, PoseStamped)
        with self.assertRaises(AttributeError):
            moveit_commander.nothing  # noqa: B018
        self.arm.set_named_target("left")
        plan = self.arm.plan()
        self.assertGreater(len(plan.joint_trajectory.points), 1)
        shown = DisplayTrajectory()
        shown.trajectory.append(plan)
        shown.serialize(io.BytesIO())
        self.assertTrue(self.arm.execute(plan))
        self.at([1.2] + HOME[1:])

    def test_remembered_values(self):
        self.arm.remember_joint_values("here")
        self.arm.remember_joint_values("there", [0.1] * 6)
        self.assertEqual(sorted(self.arm.get_remembered_joint_values()), ["here", "there"])
        self.assertTrue(self.arm.go("there"))
        self.at([0.1] * 6)
        self.arm.forget_joint_values("there")
        self.assertEqual(list(self.arm.get_remembered_joint_values()), ["here"])
        self.arm.forget_joint_values("here")

    def test_requests_carry_the_settings(self):
        self.arm.set_planner_id("RRT")
        self.arm.set_num_planning_attempts(3)
        self.arm.set_max_velocity_scaling_factor(0.3)
        self.arm.set_workspace([-1, -2, 1, 2])
        self.arm.limit_max_cartesian_link_speed(0.2)
        self.arm.set_pose_targets([stamped(0.3, 0, 0.5), stamped(0.3, 0.1, 0.5)])
        request = self.arm.construct_motion_plan_request()
        self.assertEqual((request.planner_id, request.num_planning_attempts, request.max_velocity_scaling_factor), ("RRT", 3, 0.3))
        self.assertEqual((request.workspace_parameters.max_corner.y, request.max_cartesian_speed), (2, 0.2))
        self.assertEqual((request.cartesian_speed_limited_link, request.start_state.is_diff), ("hand", True))
        self.assertEqual(len(request.goal_constraints), 2)
        (position,) = request.goal_constraints[1].position_constraints
        self.assertEqual((position.link_name, position.constraint_region.primitive_poses[0].position.y), ("hand", 0.1))
        self.assertEqual(position.constraint_region.primitives[0].dimensions, [1e-4])
        self.arm.set_position_target([0.3, 0, 0.5])
        (goal,) = self.arm.construct_motion_plan_request().goal_constraints
        self.assertEqual((len(goal.position_constraints), len(goal.orientation_constraints)), (1, 0))
        self.arm.set_rpy_target([0, 0, 1])
        (goal,) = self.arm.construct_motion_plan_request().goal_constraints
        self.assertEqual((len(goal.position_constraints), len(goal.orientation_constraints)), (0, 1))
        self.arm.set_planning_pipeline_id("pilz_industrial_motion_planner")
        self.assertEqual(self.arm.get_planner_id(), "")
        self.arm.set_planning_pipeline_id("")
        self.arm.clear_max_cartesian_link_speed()
        self.arm.set_num_planning_attempts(1)


class Motions(Commander):
    def test_plan_is_four_things_and_execute_takes_the_second(self):
        self.arm.set_named_target("left")
        good, trajectory, seconds, code = self.arm.plan()
        self.assertTrue(good and seconds > 0 and code.val == MoveItErrorCodes.SUCCESS)
        self.at(HOME)
        self.assertTrue(self.arm.execute(trajectory.joint_trajectory, wait=True))
        self.at([1.2] + HOME[1:])
        self.assertFalse(self.arm.execute(trajectory))  # it starts where the arm no longer is

    def test_a_stop_ends_the_motion_before_it_and_no_later_one(self):
        for _ in range(5):
            self.arm.go([1.0] + HOME[1:], wait=False)
            self.arm.stop()
        self.arm.stop()
        self.assertTrue(self.arm.go([0.2] + HOME[1:]))
        self.at([0.2] + HOME[1:])
        for value in (0.1, 0.2, 0.1, 0.2):
            self.arm.stop()
            self.assertTrue(self.arm.go([value] + HOME[1:]))

    def test_poses_shifts_and_lines(self):
        pose = self.arm.get_current_pose()
        pose.pose.position.y += 0.1
        self.assertTrue(self.arm.go(pose.pose))
        self.assertAlmostEqual(self.arm.get_current_pose().pose.position.y, pose.pose.position.y, delta=2e-3)
        before = self.arm.get_current_pose().pose
        self.arm.shift_pose_target(2, -0.05)
        self.assertTrue(self.arm.go())
        self.assertAlmostEqual(self.arm.get_current_pose().pose.position.z, before.position.z - 0.05, delta=2e-3)
        up = copy.deepcopy(self.arm.get_current_pose().pose)
        up.position.z += 0.05
        for arguments in ((0.01, 0.0), (0.01, 0.0, True), (0.01, True), (0.01,)):
            line, fraction = self.arm.compute_cartesian_path([up], *arguments)
            self.assertEqual(fraction, 1.0, arguments)
        self.assertTrue(self.arm.execute(line))
        slower = self.arm.retime_trajectory(self.arm.get_current_state(), line, 0.1)
        self.assertGreater(slower.joint_trajectory.points[-1].time_from_start, line.joint_trajectory.points[-1].time_from_start)
        self.assertFalse(self.arm.retime_trajectory(self.arm.get_current_state(), line, algorithm="magic").joint_trajectory.points)

    def test_inverse_kinematics_on_the_client(self):
        target = self.arm.get_current_pose()
        target.pose.position.y += 0.1
        self.arm.set_joint_value_target(target)
        self.assertTrue(self.arm.go())
        self.assertAlmostEqual(self.arm.get_current_pose().pose.position.y, target.pose.position.y, delta=2e-3)

    def test_start_states_stick_until_reset(self):
        self.arm.set_start_state(RobotState(joint_state=JointState(name=["joint_1"], position=[0.5])))
        plan = self.arm.plan([1.0] + HOME[1:])[1]
        self.assertAlmostEqual(plan.joint_trajectory.points[0].positions[0], 0.5, places=6)
        self.arm.set_start_state_to_current_state()
        plan = self.arm.plan([1.0] + HOME[1:])[1]
        self.assertAlmostEqual(plan.joint_trajectory.points[0].positions[0], 0.0, places=3)

    def test_constraints_of_the_warehouse(self):
        with self.assertRaisesRegex(MoveItCommanderException, "set_constraints_database"):
            self.arm.set_path_constraints("upright")
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "w.sqlite")
            stored = Warehouse(file).constraints
            stored.save(
                "upright",
                Constraints(orientation_constraints=[OrientationConstraint(link_name="hand")]),
                robot="arm",
                planning_group="manipulator",
            )
            stored.save("of another", Constraints(), robot="other", planning_group="manipulator")
            self.arm.set_constraints_database(file, 33829)
            self.assertEqual(self.arm.get_known_constraints(), ["upright"])
            self.arm.set_path_constraints("upright")
            self.assertEqual(self.arm.construct_motion_plan_request().path_constraints.orientation_constraints[0].link_name, "hand")
            with self.assertRaisesRegex(MoveItCommanderException, "there are: .*upright"):
                self.arm.set_path_constraints("tilted")
        self.arm.set_path_constraints(None)
        self.assertFalse(self.arm.get_path_constraints().orientation_constraints)

    def test_path_constraints_are_sent(self):
        keep = OrientationConstraint(link_name="hand", weight=1.0, orientation=self.arm.get_current_pose().pose.orientation)
        keep.header.frame_id = "world"
        keep.absolute_x_axis_tolerance = keep.absolute_y_axis_tolerance = keep.absolute_z_axis_tolerance = 3.2
        self.arm.set_path_constraints(Constraints(name="c", orientation_constraints=[keep]))
        self.assertEqual(self.arm.construct_motion_plan_request().path_constraints.name, "c")
        self.arm.clear_path_constraints()
        self.assertFalse(self.arm.get_path_constraints().orientation_constraints)

    def test_states_and_bounds(self):
        state = self.arm.get_current_state()
        self.assertEqual(state.joint_state.name, JOINTS + ["finger_joint", "finger_mirror"])
        state.joint_state.position = [9.0] + list(state.joint_state.position[1:])
        self.assertLess(self.arm.enforce_bounds(state).joint_state.position[0], 3.2)
        with self.assertRaises(genpy.DeserializationError):
            self.arm.enforce_bounds(RobotState())
        self.assertEqual(self.arm.get_current_state_bounded().joint_state.name[0], "joint_1")
        self.assertEqual(np.shape(self.arm.get_jacobian_matrix(HOME)), (6, 6))
        self.assertEqual(len(self.arm.get_random_joint_values()), 6)
        self.assertEqual(self.arm.get_random_pose().header.frame_id, "world")
        self.assertEqual(len(self.arm.get_current_rpy()), 3)


class Robot(Commander):
    def test_the_robot_its_joints_and_links(self):
        self.assertEqual(self.robot.get_group_names(), ["manipulator", "hand"])
        self.assertEqual((self.robot.get_planning_frame(), self.robot.get_root_link()), ("world", "world"))
        self.assertEqual(self.robot.get_active_joint_names(), JOINTS + ["finger_joint"])
        self.assertEqual(self.robot.joint_1.bounds(), [-3.1, 3.1])
        self.assertEqual(self.robot.get_joint("joint_2").value(), self.robot.get_current_variable_values()["joint_2"])
        self.assertEqual(self.robot.hand_joint.variable_count(), 0)
        self.assertAlmostEqual(self.robot.get_link("base_link").pose().pose.position.z, 0.0)
        self.assertEqual(self.robot.get_default_owner_group("finger_joint"), "hand")
        self.assertEqual(len(self.robot.get_robot_markers("hand").markers), 2)
        self.assertTrue(self.robot.has_group("hand") and not self.robot.has_group("legs"))
        for call in (
            lambda: self.robot.get_group("legs"),
            lambda: self.robot.get_joint("knee"),
            lambda: self.robot.get_link("claw"),
            lambda: self.robot.get_link_names("legs"),
        ):
            self.assertRaises(MoveItCommanderException, call)
        self.assertRaises(AttributeError, lambda: self.robot.knee)
        self.assertTrue(self.robot.joint_1.move(0.2))
        self.assertAlmostEqual(self.robot.joint_1.value(), 0.2, delta=0.01)


class Scene(Commander):
    def test_objects_of_every_kind(self):
        self.scene.add_box("box", stamped(2, 0, 0), (0.1, 0.2, 0.3))
        self.scene.add_sphere("sphere", stamped(2, 1, 0), 0.1)
        self.scene.add_cylinder("cylinder", stamped(2, 2, 0), 1.0, 0.1)
        self.scene.add_cone("cone", stamped(2, 3, 0), 1.0, 0.1)
        self.scene.add_plane("plane", stamped(0, 0, -1))
        with tempfile.NamedTemporaryFile("w", suffix=".obj") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
            file.flush()
            self.scene.add_mesh("mesh", stamped(2, 4, 0), file.name, (0.5, 0.5, 0.5))
        self.assertEqual(sorted(self.scene.get_known_object_names()), ["box", "cone", "cylinder", "mesh", "plane", "sphere"])
        self.assertEqual(self.scene.get_known_object_names_in_roi(1.5, -0.5, -1, 2.5, 1.5, 1), ["box", "sphere"])
        self.assertEqual(self.scene.get_object_poses(["sphere"])["sphere"].position.y, 1)
        self.assertEqual(self.scene.get_objects(["box"])["box"].primitives[0].dimensions, (0.1, 0.2, 0.3))
        self.assertEqual(max(vertex.x for vertex in self.scene.get_objects()["mesh"].meshes[0].vertices), 0.5)
        with self.assertRaises(MoveItCommanderException):
            self.scene.add_mesh("mesh", stamped(), "/nowhere.stl")
        self.scene.remove_world_object("box")
        self.assertNotIn("box", self.scene.get_known_object_names())
        self.scene.remove_world_object()
        self.assertEqual(self.scene.get_known_object_names(), [])

    def test_attached_objects(self):
        self.scene.add_box("cube", stamped(0.5, 0, 0.5), (0.05, 0.05, 0.05))
        self.scene.attach_object("cube", "hand", ["hand", "finger_left"])
        self.scene.attach_box("hand", "tool", stamped(0, 0, 0.1, "hand"), (0.02, 0.02, 0.02))
        held = self.scene.get_attached_objects()
        self.assertEqual(sorted(held), ["cube", "tool"])
        self.assertEqual(sorted(held["cube"].touch_links), ["finger_left", "hand"])
        self.scene.remove_attached_object("hand", "cube")
        self.assertEqual(self.scene.get_known_object_names(), ["cube"])
        self.scene.remove_attached_object()
        self.assertEqual(sorted(self.scene.get_known_object_names()), ["cube", "tool"])

    def matrix(self):
        wanted = PlanningSceneComponents.ALLOWED_COLLISION_MATRIX
        return self.scene.get_planning_scene(wanted).allowed_collision_matrix

    def test_a_subframe_of_what_is_held_goes_to_a_subframe_of_what_stands(self):
        stick = CollisionObject(id="stick", primitives=[SolidPrimitive(SolidPrimitive.BOX, [0.02, 0.02, 0.1])])
        stick.header.frame_id, stick.pose = "hand", stamped(z=0.15).pose
        stick.subframe_names, stick.subframe_poses = ["tip"], [stamped(z=0.05).pose]
        held = AttachedCollisionObject(link_name="hand", object=stick, touch_links=["hand", "finger_left", "finger_right"])
        hand = self.arm.get_current_pose()
        crate = CollisionObject(id="crate", primitives=[SolidPrimitive(SolidPrimitive.BOX, [0.1, 0.1, 0.1])])
        crate.header.frame_id, crate.pose = "world", copy.deepcopy(hand.pose)
        crate.pose.position.y += 0.3
        crate.subframe_names, crate.subframe_poses = ["side"], [stamped(y=-0.05).pose]
        self.scene.attach_object(held)
        self.scene.add_object(crate)
        try:
            self.arm.set_end_effector_link("stick/tip")
            tip = self.arm.get_current_pose()
            away = [getattr(tip.pose.position, axis) - getattr(hand.pose.position, axis) for axis in "xyz"]
            self.assertAlmostEqual(np.linalg.norm(away), 0.2, places=3)
            self.arm.set_pose_target(stamped(y=-0.05, frame="crate/side"))
            self.assertTrue(self.arm.go())
            there = self.arm.get_current_pose("stick/tip").pose
            self.assertAlmostEqual(there.position.y, crate.pose.position.y - 0.1, delta=2e-3)
            self.assertAlmostEqual(there.position.z, crate.pose.position.z, delta=2e-3)
            up = copy.deepcopy(there)
            up.position.z += 0.05
            self.assertEqual(self.arm.compute_cartesian_path([up], 0.01)[1], 1.0)
            with self.assertRaises(MoveItCommanderException) as caught:
                self.arm.set_end_effector_link("stick/toe")
            self.assertIn("'stick'", str(caught.exception))
        finally:
            self.arm.set_end_effector_link("hand")
            self.scene.remove_attached_object("hand", "stick")

    def test_the_collision_matrix_can_be_changed(self):
        matrix = self.matrix()
        self.assertNotIn("obj", matrix.default_entry_names)
        matrix.set_allowed("obj")
        matrix.set_allowed("block", "hand")
        scene = PlanningScene(is_diff=True, allowed_collision_matrix=matrix)
        scene.robot_state.is_diff = True
        self.assertTrue(self.scene.apply_planning_scene(scene))
        matrix = self.matrix()
        self.assertIn("obj", matrix.default_entry_names)
        self.scene.add_box("block", stamped(0, 0, 0.02, "hand"), (0.01, 0.01, 0.01))
        self.assertTrue(self.arm.plan([0.3] + HOME[1:])[0])  # touching the hand is allowed

    def test_the_other_way_through_topics(self):
        for name in ("sent", "again"):  # by an interface that was just made, also in place of one that was closed
            other = PlanningSceneInterface(synchronous=False)
            other.add_box(name, stamped(2, 0, 0))
            while name not in self.scene.get_known_object_names():
                rospy.sleep(0.01)
            other._pub_co.unregister()
            other._pub_aco.unregister()


class CommandLine(Commander):
    def test_lines_do_what_they_say(self):
        interpreter = moveit_commander.MoveGroupCommandInterpreter()
        levels = moveit_commander.MoveGroupInfoLevel
        self.assertIn("'use'", interpreter.execute("current")[1])
        self.assertEqual(interpreter.execute("use legs")[0], levels.FAIL)
        for line, level, words in [
            ("use manipulator", levels.DEBUG, "OK"),
            ("id", levels.INFO, "manipulator"),
            ("record start", levels.SUCCESS, "start"),
            ("x = [0.1 -0.6 1.6 0 1 0]", levels.SUCCESS, "under the name x"),
            ("x[0] = 0.3", levels.SUCCESS, "Updated x[0]"),
            ("y = x", levels.SUCCESS, "same as x"),
            ("go y", levels.SUCCESS, "Moved to y"),
            ("go up 0.02", levels.SUCCESS, "0.02 m"),
            ("plan start", levels.SUCCESS, "Planned to start"),
            ("execute", levels.SUCCESS, "submitted"),
            ("go nowhere", levels.WARN, "Unable to set target nowhere"),
            ("tolerance 0.01", levels.SUCCESS, "OK"),
            ("tolerance", levels.INFO, "Joint = 0.01"),
            ("time 3", levels.SUCCESS, "OK"),
            ("time", levels.INFO, "3.0"),
            ("dance", levels.WARN, "Unknown command"),
            ("joints", levels.INFO, "0 = joint_1"),
            ("help", levels.INFO, "rotate"),
            ("delete y", levels.SUCCESS, "Forgot"),
            ("show y", levels.WARN, "not known"),
            ("go up far", levels.WARN, "Unable to parse"),
        ]:
            answer = interpreter.execute(line)
            self.assertEqual(answer[0], level, (line, answer))
            self.assertIn(words, answer[1], line)
        self.assertIn('joint name="joint_1"', interpreter.execute("group_state")[1])
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "saved.cfg")
            self.assertEqual(interpreter.execute(f"save {name}")[0], levels.DEBUG)
            again = moveit_commander.MoveGroupCommandInterpreter()
            self.assertEqual(again.execute(f"load {name}"), (levels.DEBUG, "OK"))
            self.assertEqual(sorted(again.get_active_group().get_remembered_joint_values()), ["start", "x"])

    def test_the_program_reads_its_input(self):
        ended = subprocess.run(
            ["rosrun", "moveit_commander", "moveit_commander_cmdline.py", "manipulator"],
            input="id\nquit\n",
            capture_output=True,
            text=True,
            timeout=60,
        )
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertIn("Bye bye!", ended.stdout)
        self.assertNotIn("Traceback", ended.stderr)


class AllTests(unittest.TestSuite):
    """All of the above, in order."""

    def __init__(self):
        load = unittest.defaultTestLoader.loadTestsFromTestCase
        super().__init__([load(case) for case in (Targets, Motions, Robot, Scene, CommandLine)])


if __name__ == "__main__":
    moveit_commander.roscpp_initialize([])
    rospy.init_node("commander_rostest")
    rostest.rosrun("moveit_commander", "commander", "commander_rostest.AllTests")
