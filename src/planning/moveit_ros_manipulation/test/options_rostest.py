#!/usr/bin/env python3
"""Each option of the goals of pickup and place, sent as the clients send them. Lengths in m."""

import copy
import math
import unittest

import actionlib
import moveit_commander
import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from moveit_msgs.msg import (
    Constraints,
    DisplayTrajectory,
    JointConstraint,
    MoveItErrorCodes,
    PickupAction,
    PickupGoal,
    PlaceAction,
    PlaceGoal,
    PlaceLocation,
    RobotState,
)
from moveit_msgs.srv import GetPositionFK
from pick_place_rostest import HOME, REACH, along_z, fingers, grasp, stamped

Codes = MoveItErrorCodes
PALM = 0.035  # from the hand's frame to the face of its palm
STEP = 0.02  # of straight motions, upstream's default


def in_frame(frame, x, y, z, rpy=(0, 0, 0)):
    pose = stamped(x, y, z, rpy)
    pose.header.frame_id = frame
    return pose


class Options(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = moveit_commander.PlanningSceneInterface()
        cls.arm = moveit_commander.MoveGroupCommander("manipulator", wait_for_servers=60.0)
        cls.arm.set_max_velocity_scaling_factor(1.0)
        cls.picks = actionlib.SimpleActionClient("pickup", PickupAction)
        cls.places = actionlib.SimpleActionClient("place", PlaceAction)
        cls.fk = rospy.ServiceProxy("compute_fk", GetPositionFK)
        for client in (cls.picks, cls.places):
            assert client.wait_for_server(rospy.Duration(20))

    def setUp(self):
        self.scene.clear()
        self.assertTrue(self.arm.go(HOME))
        self.scene.add_box("table", stamped(0.5, 0.0, 0.2), (0.3, 0.8, 0.02))
        self.scene.add_box("block", stamped(0.45, 0.0, 0.25), (0.03, 0.03, 0.08))

    def pick(self, *grasps, only_plan=True, **fields):
        goal = PickupGoal(
            target_name="block",
            group_name="manipulator",
            end_effector="gripper",
            support_surface_name="table",
            allow_gripper_support_collision=True,
            allowed_planning_time=20.0,
            possible_grasps=list(grasps),
        )
        return self._send(self.picks, goal, only_plan, fields)

    def place(self, *locations, only_plan=True, **fields):
        goal = PlaceGoal(
            attached_object_name="block",
            group_name="manipulator",
            support_surface_name="table",
            allow_gripper_support_collision=True,
            allowed_planning_time=20.0,
            place_locations=list(locations),
        )
        return self._send(self.places, goal, only_plan, fields)

    @staticmethod
    def _send(client, goal, only_plan, fields):
        goal.planning_options.plan_only = only_plan
        goal.planning_options.planning_scene_diff.is_diff = True
        goal.planning_options.planning_scene_diff.robot_state.is_diff = True
        for name, value in fields.items():
            assert hasattr(goal, name), name
            setattr(goal, name, value)
        client.send_goal_and_wait(goal, rospy.Duration(60))
        return client.get_result()

    def assert_code(self, result, code):
        names = {value: name for name, value in vars(Codes).items() if isinstance(value, int)}
        text = self.picks.get_goal_status_text() if hasattr(result, "grasp") else self.places.get_goal_status_text()
        self.assertEqual(names[result.error_code.val], names[code], text)

    def hand(self, result, stage, index=-1):
        """Where the hand is at a point of a stage."""
        trajectory = result.trajectory_stages[result.trajectory_descriptions.index(stage)].joint_trajectory
        state = RobotState(is_diff=True)
        state.joint_state.name = trajectory.joint_names
        state.joint_state.position = trajectory.points[index].positions
        answer = self.fk(fk_link_names=["hand"], robot_state=state)
        at = answer.pose_stamped[0].pose.position
        return at.x, at.y, at.z

    def hold(self):
        self.assert_code(self.pick(grasp(0.45, 0.0, 0.25), only_plan=False), Codes.SUCCESS)

    # --- picking ---

    def test_a_grasp_without_a_frame_is_in_that_of_the_object(self):
        way = grasp(0.0, 0.0, 0.0)
        way.grasp_pose.header.frame_id = ""
        result = self.pick(way)
        self.assert_code(result, Codes.SUCCESS)
        x, y, z = self.hand(result, "approach")
        self.assertAlmostEqual(math.dist((x, y, z), (0.45, 0.0, 0.25 + REACH)), 0.0, delta=2e-3)

    def test_one_way_that_cannot_be_meant_leaves_the_others(self):
        bad = [grasp(0.45, 0.0, 0.25, name) for name in ("frame", "turn", "direction", "number", "joint", "count")]
        bad[0].grasp_pose.header.frame_id = "nowhere"
        bad[1].grasp_pose.pose.orientation = PoseStamped().pose.orientation
        bad[2].pre_grasp_approach.direction.header.frame_id = "nowhere"
        bad[3].post_grasp_retreat.desired_distance = math.nan
        bad[4].grasp_posture.joint_names = ["toe"]
        bad[5].pre_grasp_posture.points[0].positions = [0.0, 0.0]
        for each in bad:
            each.grasp_quality = 1.0
        result = self.pick(*bad, grasp(0.45, 0.0, 0.25, "good"))
        self.assert_code(result, Codes.SUCCESS)
        self.assertEqual(result.grasp.id, "good")
        for each, word in zip(bad, ("nowhere", "", "nowhere", "finite", "toe", "joints")):
            self.assertNotEqual(self.pick(each).error_code.val, Codes.SUCCESS, each.id)
            self.assertIn(word, self.picks.get_goal_status_text())

    def test_the_hand_comes_as_close_as_it_can(self):
        """From 5 cm above to where the palm meets the block, less the step before it."""
        high = grasp(0.45, 0.0, 0.30)
        self.assertAlmostEqual(self.hand(self.pick(high), "approach")[2], 0.30 + REACH, delta=2e-3)
        result = self.pick(high, minimize_object_distance=True)
        self.assert_code(result, Codes.SUCCESS)
        z = self.hand(result, "approach")[2]
        touching = 0.29 + PALM
        self.assertGreater(z, touching)
        self.assertLess(z, touching + 2 * STEP + 1e-3)

    def test_without_grasps_the_hand_comes_close_along_x(self):
        self.scene.add_box("block", stamped(0.55, 0.0, 0.62), (0.03, 0.03, 0.08))
        result = self.pick(support_surface_name="")
        self.assert_code(result, Codes.SUCCESS)
        x, y, z = self.hand(result, "approach")
        self.assertGreater(x, 0.35 + 0.02)  # it began 0.2 m before the block's middle
        self.assertAlmostEqual(z, 0.62, delta=2e-3)

    def test_only_the_touch_links_touch(self):
        deep = grasp(0.45, 0.0, 0.245)  # the palm 5 mm in the block
        self.assert_code(self.pick(deep), Codes.SUCCESS)
        self.assert_code(self.pick(deep, attached_object_touch_links=["finger_left", "finger_right"]), Codes.PLANNING_FAILED)
        self.assert_code(self.pick(deep, attached_object_touch_links=["finger_left", "finger_right", "hand"]), Codes.SUCCESS)

    def test_the_hand_touches_the_surface_only_where_that_is_allowed(self):
        low = grasp(0.45, 0.0, 0.225)  # finger tips 5 mm in the table
        self.assert_code(self.pick(low), Codes.SUCCESS)
        self.assert_code(self.pick(low, allow_gripper_support_collision=False), Codes.PLANNING_FAILED)
        self.assert_code(self.pick(low, support_surface_name=""), Codes.PLANNING_FAILED)
        self.assert_code(self.pick(low, support_surface_name="", allowed_touch_objects=["table"]), Codes.SUCCESS)

    def test_what_may_be_touched(self):
        self.scene.add_box("bowl", stamped(0.45, 0.06, 0.25), (0.03, 0.03, 0.03))
        way = grasp(0.45, 0.0, 0.25)
        self.assert_code(self.pick(way), Codes.PLANNING_FAILED)
        self.assert_code(self.pick(way, allowed_touch_objects=["bowl", "nothing"]), Codes.SUCCESS)
        way.allowed_touch_objects = ["bowl"]
        self.assert_code(self.pick(way), Codes.SUCCESS)

    def test_the_time_is_over(self):
        self.assert_code(self.pick(grasp(0.45, 0.0, 0.25), allowed_planning_time=1e-3), Codes.TIMED_OUT)

    def test_path_constraints_hold_on_the_way_to_the_grasp(self):
        self.scene.add_box("block", stamped(0.42, 0.25, 0.25), (0.03, 0.03, 0.08))
        way = grasp(0.42, 0.25, 0.25)
        self.assert_code(self.pick(way, planner_id="RRTConnect"), Codes.SUCCESS)
        ahead = Constraints(joint_constraints=[JointConstraint("joint_1", 0.0, 0.2, 0.2, 1.0)])
        self.assertNotEqual(self.pick(way, path_constraints=ahead, allowed_planning_time=4.0).error_code.val, Codes.SUCCESS)
        wide = Constraints(joint_constraints=[JointConstraint("joint_1", 0.0, 0.9, 0.9, 1.0)])
        result = self.pick(way, path_constraints=wide)
        self.assert_code(result, Codes.SUCCESS)
        plan = result.trajectory_stages[0].joint_trajectory
        column = plan.joint_names.index("joint_1")
        self.assertLess(max(abs(point.positions[column]) for point in plan.points), 0.901)

    def test_directions_in_the_frame_of_an_object_and_of_the_hand(self):
        self.scene.add_box("block", stamped(0.45, 0.0, 0.25, (0, 0, math.pi / 2)), (0.03, 0.03, 0.08))
        way = grasp(0.45, 0.0, 0.25)
        way.pre_grasp_approach.direction.header.frame_id = "hand"  # its z axis points down
        way.pre_grasp_approach.direction.vector.z = 1.0
        way.post_grasp_retreat.direction.header.frame_id = "block"
        way.post_grasp_retreat.direction.vector.x, way.post_grasp_retreat.direction.vector.z = 1.0, 0.0
        result = self.pick(way, only_plan=True)
        self.assert_code(result, Codes.SUCCESS)
        first, last = self.hand(result, "approach", 0), self.hand(result, "retreat")
        self.assertAlmostEqual(first[2], 0.25 + REACH + 0.1, delta=3e-3)
        self.assertAlmostEqual(math.dist(last, (0.45, 0.1, 0.25 + REACH)), 0.0, delta=3e-3)

    def test_the_least_distances_are_kept_or_refused(self):
        way = grasp(0.45, 0.0, 0.25)
        way.post_grasp_retreat = along_z(1.0, 2.0, 0.1)  # further than the arm is long
        result = self.pick(way)
        self.assert_code(result, Codes.SUCCESS)
        self.assertGreater(self.hand(result, "retreat")[2], 0.25 + REACH + 0.1)
        way.post_grasp_retreat.min_distance = 1.9
        self.assert_code(self.pick(way), Codes.PLANNING_FAILED)
        self.assertIn("1.900 m", self.picks.get_goal_status_text())

    def test_without_a_retreat_the_hand_stays(self):
        way = grasp(0.45, 0.0, 0.25)
        way.post_grasp_retreat.desired_distance = way.post_grasp_retreat.min_distance = 0.0
        result = self.pick(way)
        self.assert_code(result, Codes.SUCCESS)
        self.assertEqual(result.trajectory_descriptions, ["plan", "pre_grasp", "approach", "grasp"])

    def test_the_gripper_starts_from_where_it_is(self):
        """Two points: as it was at 0 s, and the posture at the time that it gives."""
        result = self.pick(grasp(0.45, 0.0, 0.25))
        closing = result.trajectory_stages[result.trajectory_descriptions.index("grasp")].joint_trajectory
        column = closing.joint_names.index("finger_joint")
        seen = [(point.time_from_start.to_sec(), point.positions[column]) for point in closing.points]
        for (time, position), (wanted_time, wanted) in zip(seen, [(0.0, 0.04), (0.5, 0.015)]):
            self.assertAlmostEqual(time, wanted_time, places=6)
            self.assertAlmostEqual(position, wanted, places=6)
        self.assertEqual(len(seen), 2)

    def test_force_and_the_retreat_of_a_later_place_change_nothing(self):
        way = grasp(0.45, 0.0, 0.25)
        way.max_contact_force, way.post_place_retreat = 1e-3, along_z(-1.0, math.nan, math.nan)
        self.assert_code(self.pick(way), Codes.SUCCESS)

    def test_groups_and_hands(self):
        way = grasp(0.45, 0.0, 0.25)
        for group, hand in (("manipulator", ""), ("", "gripper"), ("manipulator", "hand")):
            self.assert_code(self.pick(way, group_name=group, end_effector=hand), Codes.SUCCESS)
        for group, hand in (("nobody", "gripper"), ("manipulator", "hook"), ("", ""), ("hand", "")):
            self.assert_code(self.pick(way, group_name=group, end_effector=hand), Codes.INVALID_GROUP_NAME)

    def test_without_a_target_nothing_is_attached(self):
        way = grasp(0.45, 0.0, 0.40)  # in the air
        result = self.pick(way, target_name="", only_plan=False)
        self.assert_code(result, Codes.SUCCESS)
        self.assertEqual(result.trajectory_descriptions[-1], "retreat")
        self.assertFalse(self.scene.get_attached_objects())

    def test_the_plan_is_shown(self):
        seen = []
        subscriber = rospy.Subscriber("/move_group/display_planned_path", DisplayTrajectory, seen.append)
        end = rospy.Time.now() + rospy.Duration(5)
        while not subscriber.get_num_connections() and rospy.Time.now() < end:
            rospy.sleep(0.05)
        result = self.pick(grasp(0.45, 0.0, 0.25))
        end = rospy.Time.now() + rospy.Duration(5)
        wanted = len(result.trajectory_stages)
        while rospy.Time.now() < end and not any(len(one.trajectory) == wanted for one in seen):
            rospy.sleep(0.05)
        subscriber.unregister()
        self.assertIn(wanted, [len(one.trajectory) for one in seen])

    def test_the_scene_of_the_goal_counts(self):
        goal = PickupGoal()
        options = goal.planning_options
        options.planning_scene_diff.is_diff = options.planning_scene_diff.robot_state.is_diff = True
        options.plan_only = True
        lid = self.scene.make_box("lid", stamped(0.45, 0.0, 0.33), (0.2, 0.2, 0.02))
        options.planning_scene_diff.world.collision_objects = [lid]
        self.assert_code(self.pick(grasp(0.45, 0.0, 0.25), planning_options=options), Codes.PLANNING_FAILED)

    # --- placing ---

    def spot(self, name="left", y=0.2):
        return PlaceLocation(
            id=name,
            place_pose=stamped(0.45, y, 0.251),
            pre_place_approach=along_z(-1.0),
            post_place_retreat=along_z(1.0),
            post_place_posture=fingers(0.04),
        )

    def test_places(self):
        self.hold()
        with self.subTest("the pose of the object, or of the hand"):
            result = self.place(self.spot())
            self.assert_code(result, Codes.SUCCESS)
            self.assertEqual(result.trajectory_descriptions, ["plan", "approach", "grasp", "retreat"])
            self.assertAlmostEqual(self.hand(result, "approach")[1], 0.2, delta=3e-3)
            of_hand = self.spot()
            of_hand.place_pose = stamped(0.45, 0.1, 0.251 + REACH, (0, math.pi, 0))
            result = self.place(of_hand, place_eef=True)
            self.assert_code(result, Codes.SUCCESS)
            self.assertAlmostEqual(math.dist(self.hand(result, "approach"), (0.45, 0.1, 0.251 + REACH)), 0.0, delta=3e-3)
        with self.subTest("names left out"):
            for fields in (
                {"attached_object_name": ""},
                {"group_name": ""},
                {"group_name": "gripper"},
                {"group_name": "hand"},
                {"group_name": "hand", "attached_object_name": ""},
            ):
                self.assert_code(self.place(self.spot(), **fields), Codes.SUCCESS)
            self.assert_code(self.place(self.spot(), attached_object_name="table"), Codes.INVALID_OBJECT_NAME)
        with self.subTest("one of several"):
            bad = [self.spot(name) for name in ("frame", "number", "joint", "far")]
            bad[0].place_pose.header.frame_id = "nowhere"
            bad[1].pre_place_approach.direction.vector.z = math.inf
            bad[2].post_place_posture.joint_names = ["toe"]
            bad[3].place_pose.pose.position.x = 3.0
            for each in bad:
                each.quality = 1.0
            result = self.place(*bad, self.spot("good"))
            self.assert_code(result, Codes.SUCCESS)
            self.assertEqual(result.place_location.id, "good")
        with self.subTest("what may be touched"):
            self.scene.add_box("bowl", stamped(0.45, 0.26, 0.25), (0.03, 0.03, 0.03))
            self.assert_code(self.place(self.spot()), Codes.PLANNING_FAILED)
            self.assert_code(self.place(self.spot(), allowed_touch_objects=["bowl"]), Codes.SUCCESS)
            free = self.spot()
            free.allowed_touch_objects = ["bowl"]
            self.assert_code(self.place(free), Codes.SUCCESS)
            self.scene.remove_world_object("bowl")
        with self.subTest("the surface"):
            low = self.spot()
            low.place_pose.pose.position.z -= 0.006  # the block 5 mm in the table
            self.assert_code(self.place(low), Codes.SUCCESS)
            self.assert_code(self.place(low, support_surface_name=""), Codes.PLANNING_FAILED)
        with self.subTest("time, and a constraint"):
            self.assert_code(self.place(self.spot(), allowed_planning_time=1e-3), Codes.TIMED_OUT)
            ahead = Constraints(joint_constraints=[JointConstraint("joint_1", 0.0, 0.1, 0.1, 1.0)])
            result = self.place(self.spot(), path_constraints=ahead, allowed_planning_time=4.0)
            self.assertNotEqual(result.error_code.val, Codes.SUCCESS)

    def test_without_a_posture_the_hand_opens_as_it_was_before_the_grasp(self):
        self.hold()
        place = self.spot()
        place.post_place_posture = copy.deepcopy(PlaceLocation().post_place_posture)
        result = self.place(place)
        self.assert_code(result, Codes.SUCCESS)
        opening = result.trajectory_stages[result.trajectory_descriptions.index("grasp")].joint_trajectory
        self.assertAlmostEqual(opening.points[-1].positions[opening.joint_names.index("finger_joint")], 0.04, places=6)


if __name__ == "__main__":
    rospy.init_node("options_rostest")
    rostest.rosrun("moveit_ros_manipulation", "options", Options)
