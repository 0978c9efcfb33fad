#!/usr/bin/env python3
"""Industrial motions and lines as clients of move_group ask for them: by messages through its services and actions."""

import copy
import unittest

import numpy as np
import rospy
import rostest
from client import HOME, JOINTS, PATIENCE, Goal, apply, box, call, clear, joint_goal, move, plan, request, wait_until
from geometry_msgs.msg import Pose, Quaternion
from moveit_msgs.msg import (
    AllowedCollisionEntry,
    AllowedCollisionMatrix,
    CollisionObject,
    Constraints,
    DisplayTrajectory,
    GenericTrajectory,
    MotionSequenceItem,
    MoveGroupSequenceAction,
    MoveGroupSequenceGoal,
    MoveItErrorCodes,
    ObjectColor,
    OrientationConstraint,
    PlanningSceneComponents,
    PositionConstraint,
    RobotState,
    TrajectoryConstraints,
)
from moveit_msgs.srv import (
    GetCartesianPath,
    GetCartesianPathRequest,
    GetMotionSequence,
    GetMotionSequenceRequest,
    GetPlanningScene,
    GetPositionFK,
    GetStateValidity,
)
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import Header
from tf.transformations import quaternion_about_axis, quaternion_matrix, quaternion_multiply

Codes = MoveItErrorCodes
PILZ = "pilz_industrial_motion_planner"


def state_of(values):
    return RobotState(joint_state=JointState(name=JOINTS, position=values), is_diff=True)


def place(values, link="hand"):
    return call("compute_fk", GetPositionFK, Header(frame_id="world"), [link], state_of(values)).pose_stamped[0].pose


def vector(pose):
    return np.array([pose.position.x, pose.position.y, pose.position.z])


def moved(x=0.0, y=0.0, z=0.0):
    there = place(HOME)
    there.position.x, there.position.y, there.position.z = vector(there) + (x, y, z)
    return there


def pose_goal(target, region=True):
    """A goal as clients make it, or (``region`` False) with nothing but the pose in its constraint region."""
    position = PositionConstraint(link_name="hand", weight=1.0)
    turn = OrientationConstraint(link_name="hand", orientation=target.orientation, weight=1.0)
    position.header.frame_id = turn.header.frame_id = "world"
    position.constraint_region.primitives = [SolidPrimitive(SolidPrimitive.SPHERE, [1e-4])] if region else []
    position.constraint_region.primitive_poses = [Pose(target.position, Quaternion(0, 0, 0, 1))]
    turn.absolute_x_axis_tolerance = turn.absolute_y_axis_tolerance = turn.absolute_z_axis_tolerance = 1e-3
    return Constraints(position_constraints=[position], orientation_constraints=[turn])


def industrial(planner, *goals, **fields):
    fields = {
        "pipeline_id": PILZ,
        "planner_id": planner,
        "goal_constraints": list(goals),
        "max_velocity_scaling_factor": 0.1,
        "max_acceleration_scaling_factor": 0.1,
        "start_state": state_of(HOME),
        **fields,
    }
    return request(**fields)


def answer(message):
    return plan(**{name: getattr(message, name) for name in message.__slots__})


def path(trajectory, link="hand"):
    return np.array([vector(place(point.positions, link)) for point in trajectory.joint_trajectory.points])


class Circles(unittest.TestCase):
    """CIRC in every form that upstream takes, and the codes of what it refuses."""

    def ask(self, kind="interim", at=None, link="hand", frame="world", poses=1, region=False, goal=None):
        at = moved(y=0.1, z=-0.1) if at is None else at
        point = PositionConstraint(link_name=link)
        point.header.frame_id = frame
        point.constraint_region.primitive_poses = [at] * poses
        point.constraint_region.primitives = [SolidPrimitive(SolidPrimitive.SPHERE, [0.01])] if region else []
        way = Constraints(name=kind, position_constraints=[point])
        return answer(industrial("CIRC", goal or pose_goal(moved(y=0.2)), path_constraints=way))

    def test_the_point_is_the_primitive_pose_with_or_without_a_region(self):
        start, middle = vector(moved()), vector(moved(y=0.1))
        for kind, at, radius in (("interim", moved(y=0.1, z=-0.1), 0.1), ("center", moved(y=0.1, z=0.02), None)):
            for region in (False, True):
                found = self.ask(kind, at, region=region)
                self.assertEqual(found.error_code.val, Codes.SUCCESS, (kind, region))
                points = path(found.trajectory)
                centre = middle if kind == "interim" else vector(at)
                away = np.linalg.norm(points - centre, axis=1)
                np.testing.assert_allclose(away, radius or np.linalg.norm(start - centre), atol=1e-3)
                np.testing.assert_allclose(points[-1], vector(moved(y=0.2)), atol=1e-3)

    def test_link_and_frame_may_be_left_out(self):
        self.assertEqual(self.ask(link="").error_code.val, Codes.SUCCESS)
        self.assertEqual(self.ask(frame="").error_code.val, Codes.SUCCESS)
        self.assertEqual(self.ask(frame="nowhere").error_code.val, Codes.FRAME_TRANSFORM_FAILURE)

    def test_a_goal_of_joint_values_moves_the_link_of_the_point(self):
        turned = [0.25] + HOME[1:]
        found = self.ask(goal=joint_goal(turned))
        self.assertEqual(found.error_code.val, Codes.SUCCESS)
        np.testing.assert_allclose(found.trajectory.joint_trajectory.points[-1].positions, turned, atol=1e-3)
        self.assertEqual(self.ask(goal=joint_goal(turned), link="claw").error_code.val, Codes.INVALID_LINK_NAME)

    def test_the_centre_may_be_given_in_the_frame_of_a_thing_or_of_the_hand(self):
        """A circle of 0.1 m from HOME, about a point 0.1 m below; the frames are turned, and stand elsewhere."""
        centre, hand = vector(moved(z=-0.1)), place(HOME)
        mark = box("mark", 1.0, 0.2, 0.5)
        mark.pose.orientation = Quaternion(*quaternion_about_axis(1.0, (0, 0, 1)))
        self.assertTrue(apply(mark))
        # frames of the robot are those of its present state
        self.assertEqual(move(HOME).result()[1].error_code.val, Codes.SUCCESS)
        for frame, origin in (("mark", mark.pose), ("hand", hand)):
            turn = quaternion_matrix([getattr(origin.orientation, axis) for axis in "xyzw"])[:3, :3]
            there = Pose(orientation=Quaternion(0, 0, 0, 1))
            there.position.x, there.position.y, there.position.z = turn.T @ (centre - vector(origin))
            found = self.ask("center", there, frame=frame, goal=pose_goal(moved(y=0.1, z=-0.1)))
            self.assertEqual(found.error_code.val, Codes.SUCCESS, frame)
            np.testing.assert_allclose(np.linalg.norm(path(found.trajectory) - centre, axis=1), 0.1, atol=1e-3)
        clear()

    def test_what_is_no_circle(self):
        for name, asked in (
            ("its name", dict(kind="")),
            ("no pose", dict(poses=0, region=True)),
            ("two poses", dict(poses=2)),
            ("on the line", dict(at=moved(y=0.1))),
            ("not in the middle", dict(kind="center", at=moved(y=0.15, z=0.02))),
        ):
            self.assertEqual(self.ask(**asked).error_code.val, Codes.INVALID_MOTION_PLAN, name)


class Requests(unittest.TestCase):
    def test_goals_of_industrial_motions_need_no_region(self):
        for planner in ("LIN", "PTP"):
            found = answer(industrial(planner, pose_goal(moved(y=0.1), region=False)))
            self.assertEqual(found.error_code.val, Codes.SUCCESS, planner)
            np.testing.assert_allclose(path(found.trajectory)[-1], vector(moved(y=0.1)), atol=1e-3)

    def test_lin_beyond_what_the_joints_can_is_refused_and_within_it_keeps_their_limits(self):
        """joint_limits: 2 rad/s, 4 rad/s^2; Cartesian limits are Pilz's defaults, 1 m/s and 2.25 m/s^2."""
        codes = []
        for scale in (1.0, 0.1):
            found = answer(
                industrial(
                    "LIN", pose_goal(moved(x=-0.15, z=-0.15)), max_velocity_scaling_factor=scale, max_acceleration_scaling_factor=scale
                )
            )
            codes.append(found.error_code.val)
            points = found.trajectory.joint_trajectory.points
            self.assertLessEqual(max([np.abs(point.velocities).max() for point in points] or [0]), 2.002)
            self.assertLessEqual(max([np.abs(point.accelerations).max() for point in points] or [0]), 4.004)
        self.assertEqual(codes, [Codes.PLANNING_FAILED, Codes.SUCCESS])

    def test_a_line_that_only_turns_keeps_the_hand_in_its_place(self):
        goal = moved()
        goal.orientation = Quaternion(
            *quaternion_multiply([getattr(goal.orientation, axis) for axis in "xyzw"], quaternion_about_axis(2.0, (0, 0, 1)))
        )
        found = answer(industrial("LIN", pose_goal(goal)))
        self.assertEqual(found.error_code.val, Codes.SUCCESS)
        np.testing.assert_allclose(
            path(found.trajectory), np.tile(vector(goal), (len(found.trajectory.joint_trajectory.points), 1)), atol=1e-3
        )
        steps = np.abs(np.diff([point.positions for point in found.trajectory.joint_trajectory.points], axis=0))
        self.assertLess(steps.max(), 0.1)

    def test_scalings_that_were_not_filled_in_are_one(self):
        """MotionPlanRequest.msg: what is not in (0, 1], 0 above all, means 1; industrial motions refuse it."""
        times = []
        for scale in (0.0, 1.0, 3.0):
            found = plan(
                [0.5] + HOME[1:], start_state=state_of(HOME), max_velocity_scaling_factor=scale, max_acceleration_scaling_factor=scale
            )
            times.append(found.trajectory.joint_trajectory.points[-1].time_from_start.to_sec())
        np.testing.assert_allclose(times, 2 * np.sqrt(0.5 / 4.0), rtol=0.05)  # the way at 4 rad/s^2, never at 2 rad/s

    def test_the_speed_of_a_link_may_be_limited(self):
        fast = plan([0.8] + HOME[1:], start_state=state_of(HOME))
        slow = plan([0.8] + HOME[1:], start_state=state_of(HOME), cartesian_speed_limited_link="hand", max_cartesian_speed=0.1)
        points = slow.trajectory.joint_trajectory.points
        times = np.array([point.time_from_start.to_sec() for point in points])
        speeds = np.linalg.norm(np.diff(path(slow.trajectory), axis=0), axis=1) / np.diff(times)
        self.assertLess(speeds.max(), 0.1 + 1e-6)
        self.assertGreater(times[-1], 2 * fast.trajectory.joint_trajectory.points[-1].time_from_start.to_sec())

    def test_what_nobody_uses_is_said(self):
        """OMPL and Pilz look at neither; a link's speed is kept by an adapter, which Pilz's pipeline has not got."""
        heard = []
        subscriber = rospy.Subscriber("/rosout", Log, lambda message: heard.append(message.msg))
        wait_until(subscriber.get_num_connections, "the connection")
        constrained = TrajectoryConstraints(constraints=[Constraints(name="all the way")])
        for words, fields in (
            ("trajectory_constraints", dict(trajectory_constraints=constrained)),
            ("reference_trajectories", dict(reference_trajectories=[GenericTrajectory()])),
            ("LimitMaxCartesianLinkSpeed", dict(max_cartesian_speed=0.1, pipeline_id=PILZ, planner_id="PTP")),
        ):
            found = plan([0.2] + HOME[1:], start_state=state_of(HOME), **fields)
            self.assertEqual(found.error_code.val, Codes.SUCCESS, words)
            wait_until(lambda words=words: any(words in line and "ignored" in line for line in heard), words)
        subscriber.unregister()


class Sequences(unittest.TestCase):
    def setUp(self):
        clear()
        self.assertEqual(move(HOME).result()[1].error_code.val, Codes.SUCCESS)

    def tearDown(self):
        clear()

    def item(self, radius, x=0.0, y=0.0, z=0.0, **fields):
        asked = industrial("LIN", pose_goal(moved(x, y, z)), **{"start_state": RobotState(), **fields})
        return MotionSequenceItem(req=asked, blend_radius=radius)

    def ask(self, *items):
        wanted = GetMotionSequenceRequest()
        wanted.request.items = list(items)
        return call("plan_sequence_path", GetMotionSequence, wanted).response

    def test_two_motions_are_one_trajectory(self):
        """Start states as documentation wants them (none), as clients fill them in (an empty difference), and of the first."""
        for start in (RobotState(), RobotState(is_diff=True)):
            for first in (start, state_of(HOME)):
                found = self.ask(self.item(0.0, y=0.1, start_state=first), self.item(0.0, y=0.1, z=-0.1, start_state=start))
                self.assertEqual((found.error_code.val, len(found.planned_trajectories)), (Codes.SUCCESS, 1))
        points = path(found.planned_trajectories[0])
        self.assertLess(np.linalg.norm(points - vector(moved(y=0.1)), axis=1).min(), 1e-3)
        np.testing.assert_allclose(points[-1], vector(moved(y=0.1, z=-0.1)), atol=1e-3)
        times = [point.time_from_start.to_sec() for point in found.planned_trajectories[0].joint_trajectory.points]
        self.assertTrue(all(a < b for a, b in zip(times, times[1:])))

    def test_motions_of_all_kinds_follow_each_other_from_a_start_of_their_own(self):
        turned = [0.1] + HOME[1:]
        way = Constraints(name="center", position_constraints=[PositionConstraint(link_name="hand")])
        way.position_constraints[0].header.frame_id = "world"
        way.position_constraints[0].constraint_region.primitive_poses = [moved(z=-0.1)]
        found = self.ask(
            self.item(0.0, planner_id="PTP", start_state=state_of(turned)),
            self.item(0.0, y=0.1, z=-0.1, planner_id="CIRC", path_constraints=way),
            self.item(0.0, y=0.1),
        )
        self.assertEqual((found.error_code.val, len(found.planned_trajectories)), (Codes.SUCCESS, 1))
        points = path(found.planned_trajectories[0])
        np.testing.assert_allclose(points[0], vector(place(turned)), atol=1e-3)
        np.testing.assert_allclose(points[-1], vector(moved(y=0.1)), atol=1e-3)
        for corner in (moved(), moved(y=0.1, z=-0.1)):
            self.assertLess(np.linalg.norm(points - vector(corner), axis=1).min(), 1e-3)

    def test_a_blend_leaves_the_corner_out(self):
        found = self.ask(self.item(0.04, y=0.1), self.item(0.0, y=0.1, z=-0.1))
        self.assertEqual(found.error_code.val, Codes.SUCCESS)
        away = np.linalg.norm(path(found.planned_trajectories[0]) - vector(moved(y=0.1)), axis=1).min()
        self.assertTrue(0.002 < away < 0.04, away)

    def test_what_is_refused(self):
        cases = [
            ("a start of the second", [self.item(0.0, y=0.1), self.item(0.0, start_state=state_of(HOME))], Codes.INVALID_ROBOT_STATE),
            ("a last radius", [self.item(0.0, y=0.1), self.item(0.02)], Codes.INVALID_MOTION_PLAN),
            ("a negative radius", [self.item(-0.1, y=0.1), self.item(0.0)], Codes.INVALID_MOTION_PLAN),
            (
                "radii that overlap",
                [self.item(0.06, y=0.1), self.item(0.06, y=0.1, z=-0.1), self.item(0.0, z=-0.1)],
                Codes.INVALID_MOTION_PLAN,
            ),
            ("out of reach", [self.item(0.0, y=0.1), self.item(0.0, x=5.0)], Codes.NO_IK_SOLUTION),
            ("no pipeline", [self.item(0.0, y=0.1, pipeline_id="magic"), self.item(0.0)], Codes.FAILURE),
        ]
        for name, items, code in cases:
            found = self.ask(*items)
            self.assertEqual((found.error_code.val, len(found.planned_trajectories)), (code, 0), name)
        self.assertEqual(self.ask().error_code.val, Codes.SUCCESS)  # as upstream: empty, and nothing is planned

    def test_each_motion_is_looked_at_for_collisions(self):
        at = vector(moved(y=0.1, z=-0.05))
        apply(box("post", *at, size=(0.02, 0.02, 0.02)))
        self.assertEqual(self.ask(self.item(0.0, y=0.1), self.item(0.0, y=0.1, z=-0.1)).error_code.val, Codes.INVALID_MOTION_PLAN)

    def test_the_pipeline_may_be_another(self):
        items = [MotionSequenceItem(req=request([angle] + HOME[1:], start_state=RobotState(), pipeline_id="ompl")) for angle in (0.3, -0.3)]
        found = self.ask(*items)
        self.assertEqual((found.error_code.val, len(found.planned_trajectories)), (Codes.SUCCESS, 1))
        joints = [point.positions[0] for point in found.planned_trajectories[0].joint_trajectory.points]
        self.assertAlmostEqual(max(joints), 0.3, delta=1e-3)
        self.assertAlmostEqual(joints[-1], -0.3, delta=1e-3)

    def test_the_action_executes_and_shows_it(self):
        shown = []
        subscriber = rospy.Subscriber("move_group/display_planned_path", DisplayTrajectory, shown.append)
        goal = MoveGroupSequenceGoal()
        goal.request.items = [self.item(0.02, y=0.1, start_state=state_of(HOME)), self.item(0.0, y=0.1, z=-0.1)]
        goal.planning_options.planning_scene_diff.is_diff = goal.planning_options.planning_scene_diff.robot_state.is_diff = True
        _status, result, text = Goal("sequence_move_group", MoveGroupSequenceAction, goal).result()
        self.assertEqual((result.response.error_code.val, len(result.response.planned_trajectories)), (Codes.SUCCESS, 1), text)
        there = call("compute_fk", GetPositionFK, Header(frame_id="world"), ["hand"], RobotState(is_diff=True)).pose_stamped[0].pose
        np.testing.assert_allclose(vector(there), vector(moved(y=0.1, z=-0.1)), atol=5e-3)
        count = len(result.response.planned_trajectories[0].joint_trajectory.points)
        wait_until(lambda: any(len(m.trajectory[0].joint_trajectory.points) == count for m in shown), "the path to be shown")
        subscriber.unregister()

    def test_groups_that_take_turns_are_trajectories_of_their_own(self):
        hand = MotionSequenceItem(
            req=request(
                start_state=RobotState(),
                group_name="hand",
                pipeline_id=PILZ,
                planner_id="PTP",
                goal_constraints=[joint_goal([0.03], ["finger_joint"])],
            ),
            blend_radius=0.05,
        )
        found = self.ask(self.item(0.0, y=0.1), hand, self.item(0.0, y=0.1, z=-0.1))
        self.assertEqual(found.error_code.val, Codes.SUCCESS)
        self.assertEqual([t.joint_trajectory.joint_names[0] for t in found.planned_trajectories], ["joint_1", "finger_joint", "joint_1"])


class Lines(unittest.TestCase):
    def ask(self, *waypoints, **fields):
        return call(
            "compute_cartesian_path",
            GetCartesianPath,
            GetCartesianPathRequest(
                group_name="manipulator",
                start_state=state_of(HOME),
                waypoints=list(waypoints),
                max_step=0.01,
                **{"link_name": "hand", **fields},
            ),
        )

    def turned(self, angle, axis=(0, 0, 1)):
        there = place(HOME)
        q = there.orientation
        there.orientation = Quaternion(*quaternion_multiply([q.x, q.y, q.z, q.w], quaternion_about_axis(angle, axis)))
        return there

    def test_a_turn_in_place_is_made_in_steps(self):
        """3.5 rad for each metre of max_step, as upstream."""
        found = self.ask(self.turned(1.0))
        points = [np.array(point.positions) for point in found.solution.joint_trajectory.points]
        self.assertEqual((found.fraction, len(points)), (1.0, int(1.0 / 0.035) + 2))
        for a, b in zip(points, points[1:]):
            self.assertLess(np.linalg.norm(vector(place((a + b) / 2)) - vector(place(HOME))), 1e-3)

    def test_jumps_may_be_limited_by_their_size(self):
        found = self.ask(moved(z=-0.1), revolute_jump_threshold=1e-3)  # a centimetre takes more than that
        self.assertEqual((found.error_code.val, found.fraction, len(found.solution.joint_trajectory.points)), (Codes.SUCCESS, 0.0, 1))
        self.assertEqual(self.ask(moved(z=-0.1), revolute_jump_threshold=0.5, prismatic_jump_threshold=0.01).fraction, 1.0)

    def test_a_speed_without_a_link_is_that_of_the_link_that_is_moved(self):
        for link in ("hand", ""):
            found = self.ask(moved(z=-0.1), link_name=link, max_cartesian_speed=0.05)
            self.assertEqual((found.error_code.val, found.fraction), (Codes.SUCCESS, 1.0), link)
            self.assertGreaterEqual(found.solution.joint_trajectory.points[-1].time_from_start.to_sec(), 0.1 / 0.05 - 1e-3)

    def test_a_path_that_begins_where_the_hand_is_can_be_executed(self):
        """Way points of tutorials begin with the present pose: no two points may come at one time."""
        found = self.ask(place(HOME), place(HOME), moved(z=-0.05))
        times = [point.time_from_start.to_nsec() for point in found.solution.joint_trajectory.points]
        self.assertEqual(found.fraction, 1.0)
        self.assertTrue(len(times) > 4 and all(a < b for a, b in zip(times, times[1:])))


class RemovedObjects(unittest.TestCase):
    def test_permissions_and_colours_do_not_outlive_their_object(self):
        at = vector(place(HOME))
        for name in ("thing", ""):
            self.assertTrue(apply(box("thing", *at)))
            self.assertFalse(self.valid())
            matrix = self.scene(PlanningSceneComponents.ALLOWED_COLLISION_MATRIX).allowed_collision_matrix
            apply(allowed_collision_matrix=self.with_thing(matrix), object_colors=[ObjectColor(id="thing")])
            self.assertTrue(self.valid())
            apply(CollisionObject(id=name, operation=CollisionObject.REMOVE), box("thing", *at))
            self.assertFalse(self.valid())
            self.assertEqual(self.scene(PlanningSceneComponents.OBJECT_COLORS).object_colors, [])
            clear()

    @staticmethod
    def scene(components):
        return call("get_planning_scene", GetPlanningScene, PlanningSceneComponents(components)).scene

    @staticmethod
    def with_thing(given):
        matrix = AllowedCollisionMatrix(entry_names=[*given.entry_names, "thing"], entry_values=copy.deepcopy(given.entry_values))
        for row in matrix.entry_values:
            row.enabled = [*row.enabled, True]
        matrix.entry_values.append(AllowedCollisionEntry([True] * len(matrix.entry_names)))
        return matrix

    @staticmethod
    def valid():
        return call("check_state_validity", GetStateValidity, state_of(HOME), "manipulator", Constraints()).valid


class AllTests(unittest.TestSuite):
    """All of the above, in order."""

    def __init__(self):
        load = unittest.defaultTestLoader.loadTestsFromTestCase
        super().__init__([load(case) for case in (Circles, Requests, Sequences, Lines, RemovedObjects)])


if __name__ == "__main__":
    rospy.init_node("motions_rostest")
    rospy.wait_for_service("get_planning_scene", timeout=PATIENCE)
    rostest.rosrun("moveit_ros_move_group", "motions", "motions_rostest.AllTests")
