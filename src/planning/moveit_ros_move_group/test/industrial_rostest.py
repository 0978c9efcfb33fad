#!/usr/bin/env python3
"""What Pilz's planner refuses, with which code, and what it takes: asked by the action and the services of move_group.

Expected codes are those of its source: trajectory_generator.cpp, its kin for each motion, and path_circle_generator.cpp.
"""

import copy
import unittest

import numpy as np
import rospy
import rostest
from client import HOME, JOINTS, PATIENCE, Goal, call, clear, joint_goal, move, request
from geometry_msgs.msg import Pose, Quaternion
from motions_rostest import PILZ, moved, path, place, pose_goal, state_of, vector
from moveit_msgs.msg import (
    Constraints,
    MotionSequenceItem,
    MoveGroupSequenceAction,
    MoveGroupSequenceGoal,
    MoveItErrorCodes,
    PositionConstraint,
    RobotState,
)
from moveit_msgs.srv import GetMotionPlan, GetMotionSequence, GetMotionSequenceRequest
from shape_msgs.msg import Mesh, SolidPrimitive

Codes = MoveItErrorCodes
TURNED = [0.25] + HOME[1:]


def point(at, kind="interim", link="hand", frame="world", count=1):
    """Path constraints with the auxiliary point of a circle."""
    where = PositionConstraint(link_name=link)
    where.header.frame_id = frame
    where.constraint_region.primitive_poses = [at]
    return Constraints(name=kind, position_constraints=[where] * count)


def asked(planner, goal=None, **fields):
    """A MotionPlanRequest that can be planned, but for the fields."""
    if planner == "CIRC":
        fields = {"path_constraints": point(moved(y=0.1, z=-0.1)), **fields}
    goals = {"goal_constraints": [goal or pose_goal(moved(y=0.2 if planner == "CIRC" else 0.1))]}
    scaling = {"max_velocity_scaling_factor": 0.1, "max_acceleration_scaling_factor": 0.1, "start_state": state_of(HOME)}
    return request(**{"pipeline_id": PILZ, "planner_id": planner, **goals, **scaling, **fields})


def start_state(values=HOME, names=JOINTS, velocity=()):
    state = state_of(list(values))
    state.joint_state.name, state.joint_state.velocity = list(names), list(velocity)
    return state


def changed(goal, **fields):
    """A goal of a pose with fields of its position constraint changed."""
    goal = copy.deepcopy(goal)
    for name, value in fields.items():
        setattr(goal.position_constraints[0], name, value)
    return goal


def of_link(goal, link, turn=None):
    goal = changed(goal, link_name=link)
    goal.orientation_constraints[0].link_name = link if turn is None else turn
    return goal


class Asking(unittest.TestCase):
    def answer(self, message):
        """(code, trajectory) of the service, which the action must give as well."""
        found = call("plan_kinematic_path", GetMotionPlan, message).motion_plan_response
        _status, result, text = move(None, plan_only=True, **{name: getattr(message, name) for name in message.__slots__}).result()
        self.assertEqual(result.error_code.val, found.error_code.val, text)
        return found.error_code.val, found.trajectory

    def expect(self, code, name, message):
        got, trajectory = self.answer(message)
        self.assertEqual(got, code, name)
        self.assertEqual(bool(trajectory.joint_trajectory.points), code == Codes.SUCCESS, name)
        return trajectory


class Circles(Asking):
    def test_path_constraints(self):
        meshes = point(moved())
        region = meshes.position_constraints[0].constraint_region
        region.primitive_poses, region.mesh_poses, region.meshes = [], [moved(y=0.1, z=-0.1)], [Mesh()]
        for name, way in (
            ("none", Constraints()),
            ("another name", point(moved(y=0.1, z=-0.1), "centre")),
            ("two", point(moved(y=0.1, z=-0.1), count=2)),
            ("no position", Constraints(name="interim")),
            ("mesh_poses instead", meshes),
        ):
            self.expect(Codes.INVALID_MOTION_PLAN, name, asked("CIRC", path_constraints=way))

    def test_circles_that_are_none(self):
        for name, way, goal in (
            ("interim on the line", point(moved(y=0.1)), moved(y=0.2)),
            ("interim nearly on the line", point(moved(y=0.1, z=4e-5)), moved(y=0.2)),
            ("interim at the start", point(moved()), moved(y=0.2)),
            ("interim at the goal", point(moved(y=0.2)), moved(y=0.2)),
            ("goal at the start", point(moved(y=0.1, z=0.1)), moved()),
            ("centre at the start", point(moved(), "center"), moved(y=0.005)),
            ("centre, start and goal on a line", point(moved(y=0.1), "center"), moved(y=0.2)),
            ("the goal 12 mm further from the centre", point(moved(z=-0.1), "center"), moved(y=0.112, z=-0.1)),
        ):
            self.expect(Codes.INVALID_MOTION_PLAN, name, asked("CIRC", pose_goal(goal), path_constraints=way))

    def test_centres_within_a_centimetre_and_arcs_beyond_half_a_circle(self):
        """About a centre the shorter arc; through an interim point whichever passes it, here 3/4 of a circle of 0.05 m."""
        off = pose_goal(moved(y=0.108, z=-0.1))
        self.expect(Codes.SUCCESS, "8 mm off", asked("CIRC", off, path_constraints=point(moved(z=-0.1), "center")))
        goal, centre = moved(y=0.05, z=-0.05), vector(moved(z=-0.05))
        for name, way, share in (
            ("the short way", point(moved(z=-0.05), "center"), 0.25),
            ("the long way", point(moved(y=-0.05, z=-0.05)), 0.75),
        ):
            points = path(self.expect(Codes.SUCCESS, name, asked("CIRC", pose_goal(goal), path_constraints=way)))
            np.testing.assert_allclose(np.linalg.norm(points - centre, axis=1), 0.05, atol=1e-3)
            length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
            self.assertAlmostEqual(length, share * 2 * np.pi * 0.05, delta=0.01 * 2 * np.pi * 0.05, msg=name)

    def test_goals_of_joint_values(self):
        self.expect(Codes.SUCCESS, "all joints", asked("CIRC", joint_goal(TURNED)))
        self.expect(
            Codes.INVALID_LINK_NAME, "no link", asked("CIRC", joint_goal(TURNED), path_constraints=point(moved(y=0.1, z=-0.1), link=""))
        )
        self.expect(
            Codes.INVALID_LINK_NAME, "unknown link", asked("CIRC", joint_goal(TURNED), path_constraints=point(moved(y=0.1), link="claw"))
        )

    def test_what_the_goal_breaks_comes_before_what_the_circle_does(self):
        message = asked("CIRC", joint_goal([9.0] + HOME[1:]), path_constraints=Constraints())
        self.expect(Codes.INVALID_GOAL_CONSTRAINTS, "goal first", message)
        message.max_velocity_scaling_factor = 2.0
        self.expect(Codes.INVALID_MOTION_PLAN, "scaling before it", message)


class AllMotions(Asking):
    """What PTP, LIN and CIRC have in common."""

    def of_all(self, code, name, goal=None, **fields):
        for planner in ("PTP", "LIN", "CIRC"):
            self.expect(code, f"{planner}: {name}", asked(planner, goal, **fields))

    def test_scalings(self):
        for value in (0.0, -0.5, 1.5, 0.00005, float("nan")):
            self.of_all(Codes.INVALID_MOTION_PLAN, f"velocity {value}", max_velocity_scaling_factor=value)
        self.of_all(Codes.INVALID_MOTION_PLAN, "acceleration 0", max_acceleration_scaling_factor=0.0)

    def test_start_states(self):
        bad = Codes.INVALID_ROBOT_STATE
        self.of_all(bad, "a joint beyond its limit", start_state=start_state([3.5] + HOME[1:]))
        self.of_all(bad, "it moves", start_state=start_state(velocity=[0.0, 0.1, 0.0, 0.0, 0.0, 0.0]))
        self.of_all(bad, "a position too few", start_state=start_state(HOME[:-1]))
        self.of_all(Codes.SUCCESS, "it stands", start_state=start_state(velocity=[0.0] * 6))
        hand = start_state([*HOME, 0.02], [*JOINTS, "finger_joint"], [0.0] * 6 + [1.0])
        self.of_all(Codes.SUCCESS, "another group's joint moves", start_state=hand)

    def test_groups(self):
        self.of_all(Codes.INVALID_GROUP_NAME, "unknown group", group_name="leg")
        self.of_all(Codes.NO_IK_SOLUTION, "no solver", group_name="hand")

    def test_how_many_goals(self):
        bad, good = Codes.INVALID_GOAL_CONSTRAINTS, pose_goal(moved(y=0.1))
        self.of_all(bad, "none", goal_constraints=[])
        self.of_all(bad, "two", goal_constraints=[good, good])
        self.of_all(bad, "empty", Constraints())
        both = copy.deepcopy(good)
        both.joint_constraints = joint_goal(TURNED).joint_constraints
        self.of_all(bad, "joints and a pose", both)
        self.of_all(bad, "a position alone", Constraints(position_constraints=good.position_constraints))
        joints = joint_goal(TURNED)
        joints.orientation_constraints = good.orientation_constraints
        self.of_all(Codes.SUCCESS, "joints, and an orientation that does not count", joints)

    def test_links_of_goals(self):
        bad, good = Codes.INVALID_GOAL_CONSTRAINTS, pose_goal(moved(y=0.1))
        self.of_all(bad, "no link", of_link(good, ""))
        self.of_all(bad, "two links", of_link(good, "hand", "tcp"))
        self.of_all(Codes.NO_IK_SOLUTION, "a link on the way", of_link(good, "link_3"))
        self.of_all(Codes.NO_IK_SOLUTION, "a finger, which moves", of_link(good, "finger_left"))
        self.of_all(Codes.NO_IK_SOLUTION, "an unknown link", of_link(good, "claw"))
        self.of_all(Codes.NO_IK_SOLUTION, "out of reach", pose_goal(moved(y=5.0)))

    def test_a_link_that_is_fixed_to_the_tip_is_moved(self):
        before, after = place(HOME, "tcp"), place(HOME, "tcp")
        after.position.y += 0.1
        found = self.expect(Codes.SUCCESS, "LIN", asked("LIN", of_link(pose_goal(after), "tcp")))
        points = path(found, "tcp")
        np.testing.assert_allclose(points[-1], vector(after), atol=1e-3)
        np.testing.assert_allclose(points[:, [0, 2]], np.tile(vector(before)[[0, 2]], (len(points), 1)), atol=1e-3)

    def test_regions_of_goals(self):
        good = pose_goal(moved(y=0.1))
        region = copy.deepcopy(good.position_constraints[0].constraint_region)
        region.primitive_poses, region.primitives, region.mesh_poses, region.meshes = [], [], [moved(y=0.1)], [Mesh()]
        self.of_all(Codes.INVALID_GOAL_CONSTRAINTS, "mesh_poses", changed(good, constraint_region=region))
        region = copy.deepcopy(good.position_constraints[0].constraint_region)
        region.primitive_poses.append(Pose(moved(y=3.0).position, Quaternion(0, 0, 0, 1)))
        region.primitives = [SolidPrimitive(SolidPrimitive.BOX, [0.1, 0.1, 0.1])] * 2
        found = self.expect(Codes.SUCCESS, "the first counts", asked("LIN", changed(good, constraint_region=region)))
        np.testing.assert_allclose(path(found)[-1], vector(moved(y=0.1)), atol=1e-3)

    def test_joints_of_goals(self):
        bad = Codes.INVALID_GOAL_CONSTRAINTS
        self.of_all(bad, "beyond a limit", joint_goal([3.5] + HOME[1:]))
        self.of_all(bad, "another group's", joint_goal([*TURNED[:-1], 0.01], [*JOINTS[:-1], "finger_joint"]))
        few = joint_goal(TURNED[:2], JOINTS[:2])
        for planner in ("LIN", "CIRC"):
            self.expect(bad, f"{planner}: too few", asked(planner, few))
        found = self.expect(Codes.SUCCESS, "PTP of some joints", asked("PTP", few))
        np.testing.assert_allclose(found.joint_trajectory.points[-1].positions, TURNED, atol=1e-6)

    def test_a_planner_that_does_not_exist(self):
        self.expect(Codes.PLANNING_FAILED, "SPLINE", asked("SPLINE", goal_constraints=[]))


class Sequences(Asking):
    def test_items_are_judged_as_single_requests_are(self):
        first = MotionSequenceItem(req=asked("LIN"))
        back, none = pose_goal(moved()), {"start_state": RobotState()}
        for name, code, message in (
            ("nothing", Codes.SUCCESS, asked("LIN", back, **none)),
            ("scaling", Codes.INVALID_MOTION_PLAN, asked("LIN", back, max_velocity_scaling_factor=0.0, **none)),
            ("goal", Codes.INVALID_GOAL_CONSTRAINTS, asked("PTP", joint_goal([3.5] + HOME[1:]), **none)),
            ("circle", Codes.INVALID_MOTION_PLAN, asked("CIRC", back, path_constraints=Constraints(), **none)),
            ("link", Codes.NO_IK_SOLUTION, asked("LIN", of_link(back, "link_3"), **none)),
        ):
            self.assertEqual(self.both([first, MotionSequenceItem(req=message)]), code, name)
        moving = start_state(velocity=[0.1] * 6)
        self.assertEqual(self.both([MotionSequenceItem(req=asked("LIN", start_state=moving)), first]), Codes.INVALID_ROBOT_STATE)

    def both(self, items):
        wanted = GetMotionSequenceRequest()
        wanted.request.items = items
        found = call("plan_sequence_path", GetMotionSequence, wanted).response
        goal = MoveGroupSequenceGoal()
        goal.request.items = items
        goal.planning_options.plan_only = True
        _status, result, text = Goal("sequence_move_group", MoveGroupSequenceAction, goal).result()
        self.assertEqual(result.response.error_code.val, found.error_code.val, text)
        return found.error_code.val


class AllTests(unittest.TestSuite):
    """All of the above, in order."""

    def __init__(self):
        load = unittest.defaultTestLoader.loadTestsFromTestCase
        super().__init__([load(case) for case in (Circles, AllMotions, Sequences)])


if __name__ == "__main__":
    rospy.init_node("industrial_rostest")
    rospy.wait_for_service("get_planning_scene", timeout=PATIENCE)
    clear()
    rostest.rosrun("moveit_ros_move_group", "industrial", "industrial_rostest.AllTests")
