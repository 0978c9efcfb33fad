#!/usr/bin/env python3
"""The node move_group: its names on the graph, its services and actions, and what it answers to bad requests."""

import math
import re
import unittest
from pathlib import Path

import numpy as np
import rosgraph
import rospkg
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from client import HOME, JOINTS, LEFT, PATIENCE, Goal, apply, box, call, clear, joint_goal, move, plan, pose, wait_until
from geometry_msgs.msg import Pose, PoseStamped, Quaternion, Transform, TransformStamped
from moveit_msgs.msg import (
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    DisplayTrajectory,
    ExecuteTrajectoryAction,
    ExecuteTrajectoryGoal,
    MoveItErrorCodes,
    OrientationConstraint,
    PlanningScene,
    PlanningSceneComponents,
    PlanningSceneWorld,
    PositionConstraint,
    PositionIKRequest,
    RobotState,
)
from moveit_msgs.srv import (
    GetCartesianPath,
    GetCartesianPathRequest,
    GetPlannerParams,
    GetPlanningScene,
    GetPositionFK,
    GetPositionIK,
    GetStateValidity,
    QueryPlannerInterfaces,
    SetPlannerParams,
)
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import Header
from std_srvs.srv import Empty
from test_support.hearing import heard
from tf.transformations import quaternion_matrix
from tf2_ros import StaticTransformBroadcaster

Codes = MoveItErrorCodes


def fk(state=None, links=("hand",), frame="world"):
    return call("compute_fk", GetPositionFK, Header(frame_id=frame), list(links), state or RobotState(is_diff=True))


def state_of(values):
    return RobotState(joint_state=JointState(name=JOINTS, position=values), is_diff=True)


def ik(target, **fields):
    wanted = PositionIKRequest(group_name="manipulator", pose_stamped=target, robot_state=RobotState(is_diff=True))
    for name, value in fields.items():
        setattr(wanted, name, value)
    return call("compute_ik", GetPositionIK, wanted)


def scene(components=0):
    return call("get_planning_scene", GetPlanningScene, PlanningSceneComponents(components)).scene


def pose_goal(target, link="hand", frame="world"):
    region = PositionConstraint(link_name=link, weight=1.0)
    region.header.frame_id = frame
    region.constraint_region.primitives = [SolidPrimitive(SolidPrimitive.SPHERE, [1e-3])]
    region.constraint_region.primitive_poses = [pose(target.position.x, target.position.y, target.position.z)]
    turn = OrientationConstraint(link_name=link, orientation=target.orientation, weight=1.0)
    turn.header.frame_id = frame
    turn.absolute_x_axis_tolerance = turn.absolute_y_axis_tolerance = turn.absolute_z_axis_tolerance = 1e-2
    return Constraints(position_constraints=[region], orientation_constraints=[turn])


class Names(unittest.TestCase):
    def test_everything_that_clients_look_for_is_there(self):
        master = rosgraph.Master("/test")
        wait_until(lambda: "/move_group/cancel" in dict(master.getSystemState()[1]), "move_group")  # it comes up last
        published, subscribed, services = (dict(part) for part in master.getSystemState())
        for action in ("move_group", "execute_trajectory", "pickup", "place", "sequence_move_group"):
            self.assertIn("/move_group", published[f"/{action}/status"], action)
        for topic in ("monitored_planning_scene", "display_planned_path", "display_contacts", "fake_controller_joint_states"):
            self.assertIn(f"/move_group/{topic}", published)
        for topic in (
            "planning_scene",
            "planning_scene_world",
            "collision_object",
            "attached_collision_object",
            "trajectory_execution_event",
            "joint_states",
        ):
            self.assertIn("/move_group", subscribed[f"/{topic}"], topic)
        for service in (
            "plan_kinematic_path",
            "compute_ik",
            "compute_fk",
            "compute_cartesian_path",
            "check_state_validity",
            "get_planning_scene",
            "apply_planning_scene",
            "query_planner_interface",
            "get_planner_params",
            "set_planner_params",
            "clear_octomap",
            "plan_sequence_path",
            "move_group/load_map",
            "move_group/save_map",
        ):
            self.assertIn(f"/{service}", services)
        for server in (
            "planning_scene_monitor",
            "trajectory_execution",
            "plan_execution",
            "sense_for_plan",
            "pick_place",
            "planning_pipelines/ompl/ompl",
        ):
            self.assertIn(f"/move_group/{server}/set_parameters", services)

    def test_planners_are_listed_by_group_and_pipeline(self):
        found = {entry.pipeline_id: entry for entry in call("query_planner_interface", QueryPlannerInterfaces).planner_interfaces}
        self.assertEqual(sorted(found), ["ompl", "pilz_industrial_motion_planner"])  # CHOMP was refused, the node lives on
        self.assertEqual(found["ompl"].name, "OMPL")
        self.assertEqual(
            list(found["ompl"].planner_ids), ["hand", "manipulator", "manipulator[RRTConnect]", "manipulator[RRT]", "manipulator[RRTstar]"]
        )
        self.assertEqual(list(found["pilz_industrial_motion_planner"].planner_ids), ["CIRC", "LIN", "PTP"])

    def test_a_pipeline_beside_the_default_that_is_not_supplied_is_a_warning(self):
        """Every configuration of Noetic's assistant names CHOMP's, and most never ask for it."""
        file = next(Path(rospkg.get_log_dir(), rospy.get_param("/run_id")).glob("move_group-*.log"))
        told = re.findall(r"^\[rosout\]\[(\w+)\] \S+ \S+ Exception while loading planner 'chomp_interface", file.read_text(), re.M)
        self.assertEqual(told, ["WARNING"])

    def test_planner_parameters_are_read_and_changed(self):
        before = call("get_planner_params", GetPlannerParams, "ompl", "RRT", "manipulator").params
        settings = dict(zip(before.keys, before.values))
        self.assertEqual((settings["type"], settings["goal_bias"]), ("geometric::RRT", "0.05"))
        before.keys, before.values = ["goal_bias"], ["0.25"]
        call("set_planner_params", SetPlannerParams, "ompl", "RRT", "manipulator", before, False)
        after = call("get_planner_params", GetPlannerParams, "ompl", "RRT", "manipulator").params
        self.assertEqual(dict(zip(after.keys, after.values)), {**settings, "goal_bias": "0.25"})


class Kinematics(unittest.TestCase):
    def test_fk_and_ik_are_inverse(self):
        there = fk(state_of(LEFT)).pose_stamped[0]
        self.assertEqual(there.header.frame_id, "world")
        answer = ik(there)
        self.assertEqual(answer.error_code.val, Codes.SUCCESS)
        back = fk(answer.solution).pose_stamped[0].pose.position
        np.testing.assert_allclose([back.x, back.y, back.z], [getattr(there.pose.position, axis) for axis in "xyz"], atol=1e-4)
        self.assertEqual(answer.solution.joint_state.name, JOINTS + ["finger_joint", "finger_mirror"])

    def test_fk_in_another_frame_and_of_links_that_are_not_there(self):
        answer = fk(state_of(HOME), ("hand", "claw"), "hand")
        self.assertEqual(answer.error_code.val, Codes.INVALID_LINK_NAME)
        self.assertEqual(list(answer.fk_link_names), ["hand"])
        self.assertAlmostEqual(answer.pose_stamped[0].pose.position.x, 0.0, places=9)
        self.assertEqual(fk(frame="nowhere").error_code.val, Codes.FRAME_TRANSFORM_FAILURE)
        self.assertEqual(fk(links=()).error_code.val, Codes.INVALID_LINK_NAME)

    def test_what_ik_cannot_do_has_its_code(self):
        far = PoseStamped(pose=pose(5.0, 0, 0))
        self.assertEqual(ik(far).error_code.val, Codes.NO_IK_SOLUTION)
        self.assertEqual(ik(far, group_name="legs").error_code.val, Codes.INVALID_GROUP_NAME)
        self.assertEqual(ik(far, ik_link_name="claw").error_code.val, Codes.INVALID_LINK_NAME)
        self.assertEqual(ik(PoseStamped(Header(frame_id="nowhere"), pose())).error_code.val, Codes.FRAME_TRANSFORM_FAILURE)
        self.assertEqual(ik(far, pose_stamped_vector=[far, far], ik_link_names=["hand"]).error_code.val, Codes.INVALID_LINK_NAME)
        self.assertEqual(ik(far, group_name="hand").error_code.val, Codes.NO_IK_SOLUTION)  # no kinematics in the YAML
        bad = PoseStamped(pose=Pose(pose().position, Quaternion(0, 0, 0, math.nan)))
        self.assertEqual(ik(bad).error_code.val, Codes.FAILURE)

    def test_solutions_may_have_to_be_free(self):
        there = fk(state_of(LEFT)).pose_stamped[0]
        at = there.pose.position
        apply(box("block", at.x, at.y, at.z))
        try:
            self.assertEqual(ik(there, avoid_collisions=True).error_code.val, Codes.NO_IK_SOLUTION)
            self.assertEqual(ik(there).error_code.val, Codes.SUCCESS)
        finally:
            clear()

    def test_a_held_things_tip_is_moved_like_a_link(self):
        start = state_of(HOME)
        held = AttachedCollisionObject(link_name="hand", object=box("stick", 0, 0, 0, (0.02, 0.02, 0.1)), touch_links=["hand"])
        held.object.header.frame_id = "hand"
        held.object.subframe_names, held.object.subframe_poses = ["tip"], [pose(0.0, 0.05, 0.1)]
        start.attached_collision_objects = [held]
        hand = fk(start).pose_stamped[0].pose
        turn = quaternion_matrix([getattr(hand.orientation, axis) for axis in "xyzw"])[:3, :3]
        tip = np.array([hand.position.x, hand.position.y, hand.position.z]) + turn @ [0.0, 0.05, 0.1]
        end = Pose(pose(tip[0], tip[1] + 0.05, tip[2]).position, hand.orientation)
        wanted = GetCartesianPathRequest(
            group_name="manipulator", start_state=start, waypoints=[end], max_step=0.01, avoid_collisions=False, link_name="stick/tip"
        )
        answer = call("compute_cartesian_path", GetCartesianPath, wanted)
        self.assertEqual((answer.error_code.val, answer.fraction), (Codes.SUCCESS, 1.0))
        there = fk(state_of(answer.solution.joint_trajectory.points[-1].positions)).pose_stamped[0].pose.position
        np.testing.assert_allclose([there.x, there.y, there.z], [hand.position.x, hand.position.y + 0.05, hand.position.z], atol=1e-3)
        target = PoseStamped(header=Header(frame_id="world"), pose=end)
        found = ik(target, robot_state=start, ik_link_name="stick/tip")
        self.assertEqual(found.error_code.val, Codes.SUCCESS)
        there = fk(found.solution).pose_stamped[0].pose.position
        np.testing.assert_allclose([there.x, there.y, there.z], [hand.position.x, hand.position.y + 0.05, hand.position.z], atol=1e-3)
        wanted.link_name = "stick/top"
        answer = call("compute_cartesian_path", GetCartesianPath, wanted)
        self.assertEqual((answer.error_code.val, answer.fraction), (Codes.FAILURE, 0.0))

    def test_cartesian_path(self):
        start = fk(state_of(HOME)).pose_stamped[0].pose
        end = Pose(pose(start.position.x, start.position.y + 0.1, start.position.z).position, start.orientation)
        wanted = GetCartesianPathRequest(
            group_name="manipulator", start_state=state_of(HOME), waypoints=[end], max_step=0.01, avoid_collisions=True, link_name="hand"
        )
        answer = call("compute_cartesian_path", GetCartesianPath, wanted)
        self.assertEqual((answer.error_code.val, answer.fraction), (Codes.SUCCESS, 1.0))
        points = answer.solution.joint_trajectory.points
        self.assertGreaterEqual(len(points), 11)
        for point in points:
            at = fk(state_of(point.positions)).pose_stamped[0].pose.position
            np.testing.assert_allclose([at.x, at.z], [start.position.x, start.position.z], atol=1e-3)
        wanted.max_step = 0.0
        self.assertEqual(call("compute_cartesian_path", GetCartesianPath, wanted).error_code.val, Codes.FAILURE)
        wanted.max_step, wanted.group_name = 0.01, "legs"
        self.assertEqual(call("compute_cartesian_path", GetCartesianPath, wanted).error_code.val, Codes.INVALID_GROUP_NAME)
        wanted.group_name, wanted.waypoints[0].position.x = "manipulator", 5.0
        answer = call("compute_cartesian_path", GetCartesianPath, wanted)
        self.assertEqual(answer.error_code.val, Codes.SUCCESS)
        self.assertLess(answer.fraction, 0.9)


class Planning(unittest.TestCase):
    def tearDown(self):
        clear()

    def test_joint_goal(self):
        answer = plan(LEFT, start_state=state_of(HOME))
        self.assertEqual(answer.error_code.val, Codes.SUCCESS)
        joints = answer.trajectory.joint_trajectory
        self.assertEqual((joints.joint_names, joints.header.frame_id), (JOINTS, "world"))
        np.testing.assert_allclose(joints.points[0].positions, HOME, atol=1e-6)
        np.testing.assert_allclose(joints.points[-1].positions, LEFT, atol=1e-3)
        times = [point.time_from_start.to_sec() for point in joints.points]
        self.assertTrue(times[0] == 0.0 and all(a < b for a, b in zip(times, times[1:])))
        fastest = np.abs([point.velocities for point in joints.points]).max()
        self.assertLess(fastest, 2.0 + 1e-6)
        self.assertEqual(answer.trajectory_start.joint_state.name, JOINTS + ["finger_joint", "finger_mirror"])
        self.assertFalse(answer.trajectory_start.is_diff)

    def test_pose_goal_around_a_box_in_the_way(self):
        target = fk(state_of(LEFT)).pose_stamped[0].pose
        middle = fk(state_of([0.6] + HOME[1:])).pose_stamped[0].pose.position
        apply(box("post", middle.x, middle.y, middle.z, (0.08, 0.08, 0.4)))
        shown = []
        subscriber = rospy.Subscriber("move_group/display_planned_path", DisplayTrajectory, shown.append)
        answer = plan(start_state=state_of(HOME), goal_constraints=[pose_goal(target)], num_planning_attempts=4)
        self.assertEqual(answer.error_code.val, Codes.SUCCESS)
        points = answer.trajectory.joint_trajectory.points
        for point in points:
            self.assertTrue(call("check_state_validity", GetStateValidity, state_of(point.positions), "manipulator", Constraints()).valid)
        end = fk(state_of(points[-1].positions)).pose_stamped[0].pose.position
        np.testing.assert_allclose([end.x, end.y, end.z], [getattr(target.position, axis) for axis in "xyz"], atol=2e-3)
        wait_until(lambda: any(len(m.trajectory[0].joint_trajectory.points) == len(points) for m in shown), "the path to be shown")
        subscriber.unregister()

    def test_every_bad_request_has_its_code_and_harms_nothing(self):
        target = fk(state_of(LEFT)).pose_stamped[0].pose
        nan, zero, nowhere = pose_goal(target), pose_goal(target), pose_goal(target, frame="nowhere")
        nan.position_constraints[0].constraint_region.primitive_poses[0].position.x = math.nan
        zero.orientation_constraints[0].orientation = Quaternion()
        cases = [
            ("no group", dict(group_name="", goal_constraints=[joint_goal(LEFT)]), Codes.INVALID_GROUP_NAME),
            ("unknown group", dict(group_name="legs", goal_constraints=[joint_goal(LEFT)]), Codes.FAILURE),
            ("no goal", {}, Codes.INVALID_GOAL_CONSTRAINTS),
            ("empty goal", dict(goal_constraints=[Constraints()]), Codes.INVALID_GOAL_CONSTRAINTS),
            ("unknown joint", dict(goal_constraints=[joint_goal([1.0], ["knee"])]), Codes.INVALID_GOAL_CONSTRAINTS),
            ("NaN", dict(goal_constraints=[joint_goal([math.nan] * 6)]), Codes.INVALID_GOAL_CONSTRAINTS),
            ("NaN pose", dict(goal_constraints=[nan]), Codes.INVALID_GOAL_CONSTRAINTS),
            ("no rotation", dict(goal_constraints=[zero]), Codes.INVALID_GOAL_CONSTRAINTS),
            ("unknown frame", dict(goal_constraints=[nowhere]), Codes.INVALID_GOAL_CONSTRAINTS),
            ("unknown link", dict(goal_constraints=[pose_goal(target, "claw")]), Codes.INVALID_GOAL_CONSTRAINTS),
            ("no kinematics", dict(group_name="hand", goal_constraints=[pose_goal(target, "finger_left")]), Codes.FAILURE),
            ("unknown pipeline", dict(pipeline_id="magic", goal_constraints=[joint_goal(LEFT)]), Codes.FAILURE),
            ("refused pipeline", dict(pipeline_id="chomp", goal_constraints=[joint_goal(LEFT)]), Codes.FAILURE),
            (
                "start of another robot",
                dict(start_state=RobotState(joint_state=JointState(name=["knee"], position=[1.0])), goal_constraints=[joint_goal(LEFT)]),
                Codes.INVALID_ROBOT_STATE,
            ),
            (
                "half a start",
                dict(start_state=RobotState(joint_state=JointState(name=JOINTS, position=[1.0])), goal_constraints=[joint_goal(LEFT)]),
                Codes.INVALID_ROBOT_STATE,
            ),
            (
                "start beyond its limits",
                dict(start_state=state_of([9.0] + HOME[1:]), goal_constraints=[joint_goal(LEFT)]),
                Codes.START_STATE_INVALID,
            ),
        ]
        for name, fields, code in cases:
            answer = plan(**fields)
            self.assertEqual(answer.error_code.val, code, name)
            self.assertFalse(answer.trajectory.joint_trajectory.points, name)
        self.assertEqual(plan(LEFT, planner_id="Unheard", start_state=state_of(HOME)).error_code.val, Codes.SUCCESS)  # default

    def test_a_goal_or_start_inside_something(self):
        at = fk(state_of(LEFT)).pose_stamped[0].pose.position
        apply(box("block", at.x, at.y, at.z))
        answer = plan(LEFT, start_state=state_of(HOME), allowed_planning_time=1.0)
        self.assertIn(answer.error_code.val, (Codes.GOAL_STATE_INVALID, Codes.GOAL_IN_COLLISION))
        answer = plan(HOME, start_state=state_of(LEFT), allowed_planning_time=1.0)
        self.assertEqual(answer.error_code.val, Codes.START_STATE_IN_COLLISION)

    def test_state_validity_names_what_touches(self):
        at = fk(state_of(HOME)).pose_stamped[0].pose.position
        apply(box("block", at.x, at.y, at.z))
        answer = call("check_state_validity", GetStateValidity, state_of(HOME), "manipulator", Constraints())
        self.assertFalse(answer.valid)
        self.assertIn("block", {body for contact in answer.contacts for body in (contact.contact_body_1, contact.contact_body_2)})
        answer = call("check_state_validity", GetStateValidity, state_of(LEFT), "manipulator", joint_goal(HOME))
        self.assertEqual((answer.valid, answer.constraint_result[0].result, len(answer.constraint_result)), (False, False, 6))


class Scene(unittest.TestCase):
    def tearDown(self):
        clear()

    def names(self):
        return sorted(item.id for item in scene(PlanningSceneComponents.WORLD_OBJECT_NAMES).world.collision_objects)

    def test_topics_change_the_scene(self):
        objects = rospy.Publisher("collision_object", CollisionObject, queue_size=10)
        attached = rospy.Publisher("attached_collision_object", AttachedCollisionObject, queue_size=10)
        world = rospy.Publisher("planning_scene_world", PlanningSceneWorld, queue_size=1)
        diffs = rospy.Publisher("planning_scene", PlanningScene, queue_size=10)
        wait_until(lambda: all(p.get_num_connections() for p in (objects, attached, world, diffs)), "listeners")
        objects.publish(box("a", 1, 1, 1))
        wait_until(lambda: self.names() == ["a"], "object a")
        body = AttachedCollisionObject(link_name="hand")
        body.object.id = "a"
        attached.publish(body)
        held = PlanningSceneComponents.ROBOT_STATE_ATTACHED_OBJECTS
        wait_until(lambda: [b.object.id for b in scene(held).robot_state.attached_collision_objects] == ["a"], "a to be held")
        self.assertEqual(self.names(), [])
        body.object.operation = CollisionObject.REMOVE
        attached.publish(body)
        wait_until(lambda: self.names() == ["a"], "a to be back")
        world.publish(PlanningSceneWorld(collision_objects=[box("b", 1, 1, 1), box("c", 2, 1, 1)]))
        wait_until(lambda: self.names() == ["b", "c"], "a world of its own")
        diff = PlanningScene(is_diff=True)
        diff.robot_state.is_diff = True
        diff.world.collision_objects = [CollisionObject(id="b", operation=CollisionObject.REMOVE)]
        diffs.publish(diff)
        wait_until(lambda: self.names() == ["c"], "b to go")

    def test_a_frame_may_be_called_by_a_number(self):
        frame = TransformStamped(Header(frame_id="world", stamp=rospy.Time.now()), "7", Transform())
        frame.transform.translation.x, frame.transform.rotation.w = 3.0, 1.0
        broadcaster = StaticTransformBroadcaster()
        broadcaster.sendTransform(frame)
        there = box("there", 0, 0, 1)
        there.header.frame_id = "7"
        wait_until(lambda: apply(there), "the frame 7")
        (known,) = scene(PlanningSceneComponents.WORLD_OBJECT_GEOMETRY).world.collision_objects
        self.assertAlmostEqual(known.pose.position.x + known.primitive_poses[0].position.x, 3.0)

    def test_apply_tells_what_failed_and_goes_on(self):
        self.assertTrue(apply(box("good", 1, 1, 1)))
        self.assertFalse(apply(CollisionObject(id="empty"), box("next", 2, 2, 2)))
        self.assertEqual(self.names(), ["good", "next"])

    def test_a_listener_sees_the_whole_scene_and_then_changes(self):
        def operations(message):
            return [(entry.id, entry.operation) for entry in message.world.collision_objects]

        seen = []
        subscriber = rospy.Subscriber("move_group/monitored_planning_scene", PlanningScene, seen.append)
        wait_until(lambda: heard([subscriber]), "the connection")
        apply(box("early", 1, 1, 1))
        wait_until(lambda: any(("early", 0) in operations(m) for m in seen), "a scene")  # whole, as all was removed before
        apply(box("late", 2, 2, 2))
        wait_until(lambda: any(m.is_diff and operations(m) == [("late", 0)] for m in seen), "the diff")
        apply(CollisionObject(id="late", operation=CollisionObject.REMOVE))
        wait_until(lambda: any(m.is_diff and operations(m) == [("late", 1)] for m in seen), "the removal")
        subscriber.unregister()

    def test_a_thousand_objects(self):
        self.assertTrue(apply(*(box(f"b{i}", 2 + i % 10, i // 100, 1 + (i // 10) % 10, (0.05,) * 3) for i in range(1000))))
        self.assertEqual(len(self.names()), 1000)
        self.assertEqual(plan(LEFT, start_state=state_of(HOME)).error_code.val, Codes.SUCCESS)

    def test_clear_octomap_is_there_without_one(self):
        call("clear_octomap", Empty)


class Execution(unittest.TestCase):
    def setUp(self):
        clear()
        self.assertEqual(move(HOME).result()[1].error_code.val, Codes.SUCCESS)

    def tearDown(self):
        clear()

    def at(self, wanted):
        names = scene(PlanningSceneComponents.ROBOT_STATE).robot_state.joint_state
        return np.allclose([names.position[names.name.index(name)] for name in JOINTS], wanted, atol=0.02)

    def test_plan_and_execute(self):
        goal = move(LEFT)
        status, result, text = goal.result()
        self.assertEqual((status, result.error_code.val, text), (GoalStatus.SUCCEEDED, Codes.SUCCESS, "Solution was found and executed."))
        self.assertTrue(self.at(LEFT))
        self.assertEqual([state for i, state in enumerate(goal.states) if state not in goal.states[:i]][:2], ["PLANNING", "MONITOR"])

    def test_plan_only_moves_nothing_and_execute_trajectory_does(self):
        status, result, text = move(LEFT, plan_only=True).result()
        self.assertEqual((status, text), (GoalStatus.SUCCEEDED, "Motion plan was computed succesfully."))
        self.assertTrue(self.at(HOME) and result.planning_time > 0)
        goal = Goal("execute_trajectory", ExecuteTrajectoryAction, ExecuteTrajectoryGoal(result.planned_trajectory))
        self.assertEqual(goal.result()[1].error_code.val, Codes.SUCCESS)
        self.assertTrue(self.at(LEFT))
        status, again, text = Goal("execute_trajectory", ExecuteTrajectoryAction, ExecuteTrajectoryGoal(result.planned_trajectory)).result()
        self.assertEqual((status, again.error_code.val), (GoalStatus.ABORTED, Codes.CONTROL_FAILED))
        self.assertIn("joint 'joint_1' is 1.2", text)
        self.assertIn("Plan again", text)

    def test_an_object_that_gets_in_the_way_stops_the_motion(self):
        middle = fk(state_of([0.9] + HOME[1:])).pose_stamped[0].pose.position
        goal = move(LEFT, max_velocity_scaling_factor=0.1)
        wait_until(lambda: not self.at(HOME), "a motion")
        apply(box("post", middle.x, middle.y, middle.z))
        status, result, text = goal.result()
        self.assertEqual((status, result.error_code.val), (GoalStatus.ABORTED, Codes.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE))
        self.assertIn("'post'", text)
        self.assertFalse(self.at(LEFT))

    def test_two_clients_at_once(self):
        first = move(LEFT, max_velocity_scaling_factor=0.05)
        wait_until(lambda: not self.at(HOME), "a motion")
        here = plan(HOME)
        second = Goal("execute_trajectory", ExecuteTrajectoryAction, ExecuteTrajectoryGoal(here.trajectory))
        status, result, text = second.result()
        self.assertEqual((status, result.error_code.val), (GoalStatus.ABORTED, Codes.CONTROL_FAILED))
        self.assertIn("another is being executed", text)
        third = move(HOME)  # a new goal of the same action ends the running one
        status, _result, text = first.result()
        self.assertEqual(status, GoalStatus.PREEMPTED)
        self.assertIn("another goal came for move_group", text)
        self.assertEqual(third.result()[1].error_code.val, Codes.SUCCESS)

    def test_a_plan_that_fails_executes_nothing(self):
        at = fk(state_of(LEFT)).pose_stamped[0].pose.position
        apply(box("block", at.x, at.y, at.z))
        status, result, _ = move(LEFT, allowed_planning_time=1.0).result()
        self.assertEqual(status, GoalStatus.ABORTED)
        self.assertNotEqual(result.error_code.val, Codes.SUCCESS)
        self.assertTrue(self.at(HOME))

    def test_bad_trajectories_move_nothing(self):
        cases = [
            ("another robot", lambda t: t.joint_names.__setitem__(0, "knee"), "'knee'"),
            ("too few positions", lambda t: setattr(t.points[1], "positions", [1.0]), "1 positions for 6 joints"),
            ("not a number", lambda t: setattr(t.points[1], "positions", [math.nan] * 6), "not finite"),
            ("backwards", lambda t: setattr(t.points[1], "time_from_start", rospy.Duration(0)), "not after the one"),
            ("mimic only", lambda t: setattr(t, "joint_names", ["finger_mirror"]), "positions for 1 joints"),
        ]
        for name, spoil, words in cases:
            trajectory = plan(LEFT).trajectory
            spoil(trajectory.joint_trajectory)
            goal = Goal("execute_trajectory", ExecuteTrajectoryAction, ExecuteTrajectoryGoal(trajectory))
            status, result, text = goal.result()
            self.assertEqual((status, result.error_code.val), (GoalStatus.ABORTED, Codes.CONTROL_FAILED), name)
            self.assertIn(words, text, name)
        self.assertTrue(self.at(HOME))


class AllTests(unittest.TestSuite):
    """All of the above, in order."""

    def __init__(self):
        load = unittest.defaultTestLoader.loadTestsFromTestCase
        super().__init__([load(case) for case in (Names, Kinematics, Planning, Scene, Execution)])


if __name__ == "__main__":
    rospy.init_node("move_group_rostest")
    rospy.wait_for_service("get_planning_scene", timeout=PATIENCE)
    rostest.rosrun("moveit_ros_move_group", "move_group_test", "move_group_rostest.AllTests")
