#!/usr/bin/env python3
"""Services and frames of move_group, asked as clients in C++, Python and RViz ask them; expected is what upstream's capabilities do."""

import unittest

import motion
import numpy as np
import rospy
import rostest
import tf2_ros
from client import HOME, JOINTS, LEFT, PATIENCE, Goal, apply, box, call, clear, move, pose, wait_until
from geometry_msgs.msg import Transform, Vector3
from moveit_msgs.msg import (
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    ExecuteTrajectoryAction,
    ExecuteTrajectoryGoal,
    LinkPadding,
    MoveItErrorCodes,
    OrientationConstraint,
    PlannerParams,
    PlanningScene,
    PlanningSceneComponents,
    RobotState,
    RobotTrajectory,
)
from moveit_msgs.srv import (
    GetCartesianPath,
    GetCartesianPathRequest,
    GetPlannerParams,
    GetPlanningScene,
    GetPositionFK,
    GetStateValidity,
    SetPlannerParams,
)
from octomap_msgs.msg import Octomap
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from std_msgs.msg import Header
from std_srvs.srv import Empty
from tf.transformations import quaternion_matrix
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint, MultiDOFJointTrajectory, MultiDOFJointTrajectoryPoint

Codes = MoveItErrorCodes
Parts = PlanningSceneComponents


def scene(components=0):
    return call("get_planning_scene", GetPlanningScene, Parts(components)).scene


def state_of(values, **fields):
    return RobotState(joint_state=JointState(name=JOINTS, position=values), is_diff=True, **fields)


def valid(state, group="manipulator", constraints=None):
    return call("check_state_validity", GetStateValidity, state, group, constraints or Constraints())


class PlannerParameters(unittest.TestCase):
    def get(self, planner, group="", pipeline="ompl"):
        params = call("get_planner_params", GetPlannerParams, pipeline, planner, group).params
        return dict(zip(params.keys, params.values))

    def set(self, planner, values, group="", replace=False, pipeline="ompl"):
        call(
            "set_planner_params",
            SetPlannerParams,
            pipeline,
            planner,
            group,
            PlannerParams(list(values), list(values.values()), []),
            replace,
        )

    def test_those_of_a_group_lie_over_those_of_the_planner(self):
        self.set("RRTstar", {"range": "0.5"}, "manipulator")
        self.assertEqual(self.get("RRTstar", "manipulator")["range"], "0.5")
        self.assertNotIn("range", self.get("RRTstar"))
        self.set("RRTstar", {"delay_collision_checking": "0"}, "manipulator", replace=True)
        self.assertNotIn("range", self.get("RRTstar", "manipulator"))

    def test_what_cannot_be_done_fails_the_call(self):
        """Upstream's handlers return false."""
        with self.assertRaises(rospy.ServiceException):
            call("set_planner_params", SetPlannerParams, "ompl", "RRT", "manipulator", PlannerParams(["range"], [], []), False)
        for pipeline in ("none", "ompl2"):
            with self.assertRaises(rospy.ServiceException):
                self.get("RRT", pipeline=pipeline)
            with self.assertRaises(rospy.ServiceException):
                self.set("RRT", {"range": "1"}, pipeline=pipeline)
        self.assertEqual(self.get("RRT", "manipulator")["type"], "geometric::RRT")  # it lives on

    def test_no_pipeline_is_the_default_one(self):
        self.assertEqual(self.get("RRT", "manipulator", pipeline="")["type"], "geometric::RRT")


def let_go():
    """Of all that is held, and of all that there is."""
    apply(
        robot_state=RobotState(
            is_diff=True, attached_collision_objects=[AttachedCollisionObject(object=CollisionObject(operation=CollisionObject.REMOVE))]
        )
    )
    clear()


class Scene(unittest.TestCase):
    def tearDown(self):
        let_go()

    def test_each_component_alone(self):
        hold = AttachedCollisionObject(link_name="hand", object=box("held", 0, 0, 0.1, (0.01, 0.01, 0.01)), touch_links=["hand"])
        hold.object.header.frame_id = "hand"
        diff = PlanningScene(is_diff=True)
        diff.robot_state = RobotState(is_diff=True, attached_collision_objects=[hold])
        self.assertTrue(apply(box("b", 1, 1, 1), robot_state=diff.robot_state))
        has = {
            Parts.SCENE_SETTINGS: lambda s: s.robot_model_name != "",
            Parts.ROBOT_STATE: lambda s: len(s.robot_state.joint_state.name) > 5,
            Parts.ROBOT_STATE_ATTACHED_OBJECTS: lambda s: [b.object.id for b in s.robot_state.attached_collision_objects] == ["held"],
            Parts.WORLD_OBJECT_NAMES: lambda s: [o.id for o in s.world.collision_objects] == ["b"],
            Parts.WORLD_OBJECT_GEOMETRY: lambda s: [len(o.primitives) for o in s.world.collision_objects] == [1],
            Parts.ALLOWED_COLLISION_MATRIX: lambda s: len(s.allowed_collision_matrix.entry_names) > 0,
            Parts.LINK_PADDING_AND_SCALING: lambda s: len(s.link_padding) > 0,
        }
        for component, found in has.items():
            self.assertTrue(found(scene(component)), component)
        everything = scene(0)
        self.assertTrue(all(found(everything) for found in has.values()))
        self.assertFalse(scene(Parts.ALLOWED_COLLISION_MATRIX).world.collision_objects)
        self.assertFalse(scene(Parts.WORLD_OBJECT_NAMES).world.collision_objects[0].primitives)

    def test_an_octomap_that_a_client_put_is_cleared(self):
        tree = motion.OcTree.from_points(np.array([[1.0, 1.0, 1.0], [1.2, 1.0, 1.0]]), 0.1)
        data = tree.message_data(binary=True)
        message = Octomap(binary=True, id="OcTree", resolution=0.1, data=np.frombuffer(data, np.int8).tolist())
        message.header.frame_id = "world"
        diff = PlanningScene(is_diff=True)
        diff.world.octomap.octomap, diff.world.octomap.header.frame_id = message, "world"
        diff.world.octomap.origin.orientation.w = 1.0
        self.assertTrue(apply(world=diff.world))
        self.assertTrue(scene(Parts.OCTOMAP).world.octomap.octomap.data)
        call("clear_octomap", Empty)
        self.assertFalse(scene(Parts.OCTOMAP).world.octomap.octomap.data)

    def test_frames_of_things_are_published_under_the_nodes_name(self):
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        thing = box("thing", 1.0, 2.0, 0.5)
        thing.subframe_names, thing.subframe_poses = ["tip"], [pose(0, 0, 0.3)]
        self.assertTrue(apply(thing))
        for frame, z in (("move_group/thing", 0.5), ("move_group/thing/tip", 0.8)):
            wait_until(lambda: buffer.can_transform("world", frame, rospy.Time()), frame)
            at = buffer.lookup_transform("world", frame, rospy.Time()).transform.translation
            np.testing.assert_allclose([at.x, at.y, at.z], [1.0, 2.0, z], atol=1e-6)
        listener.unregister()


class Validity(unittest.TestCase):
    def tearDown(self):
        clear()

    def test_a_thing_that_only_the_asked_state_holds_collides(self):
        hold = AttachedCollisionObject(link_name="hand", object=box("beam", 0, 0, 0.5, (0.02, 0.02, 0.8)), touch_links=["hand"])
        hold.object.header.frame_id = "hand"
        self.assertTrue(valid(state_of(HOME)).valid)
        self.assertTrue(apply(box("wall", *self.in_front(0.5), (0.3, 0.3, 0.3))))
        answer = valid(state_of(HOME, attached_collision_objects=[hold]))
        self.assertFalse(answer.valid)
        self.assertIn({"beam", "wall"}, [{c.contact_body_1, c.contact_body_2} for c in answer.contacts])
        self.assertEqual({c.header.frame_id for c in answer.contacts}, {"world"})
        self.assertTrue(valid(state_of(HOME)).valid, "the scene holds nothing")

    def test_what_a_collision_costs_is_the_box_that_shapes_share(self):
        """The base is a cylinder 0.08 m about the origin, up to 0.1 m; the boxes' corners are those of their intersections."""
        bare = [LinkPadding("base_link", 0.0)]
        self.assertTrue(
            apply(
                box("small", -0.10, 0, 0.05, (0.06, 0.06, 0.06)),
                box("large", 0.1, 0, 0.05, (0.1, 0.1, 0.1)),
                box("far", 2, 2, 2),
                link_padding=bare,
            )
        )
        answer = valid(state_of(HOME), "")
        self.assertFalse(answer.valid)
        seen = [
            (c.cost_density, c.aabb_min.x, c.aabb_max.x, c.aabb_min.y, c.aabb_max.y, c.aabb_min.z, c.aabb_max.z)
            for c in answer.cost_sources
        ]
        np.testing.assert_allclose(seen, [(1, 0.05, 0.08, -0.05, 0.05, 0.0, 0.1), (1, -0.08, -0.07, -0.03, 0.03, 0.02, 0.08)], atol=1e-6)
        self.assertFalse(valid(state_of(HOME), "hand").cost_sources)  # what does not move is not looked at
        clear()
        self.assertFalse(valid(state_of(HOME), "").cost_sources)

    def test_what_is_held_costs_as_well(self):
        """A beam of 2 cm along the hand's axis in a wall: no less than the part of it that is inside."""
        hold = AttachedCollisionObject(link_name="hand", object=box("beam", 0, 0, 0.5, (0.02, 0.02, 0.8)), touch_links=["hand"])
        hold.object.header.frame_id = "hand"
        self.assertTrue(apply(box("wall", *self.in_front(0.75), (0.1, 0.1, 0.1))))
        costs = valid(state_of(HOME, attached_collision_objects=[hold])).cost_sources
        self.assertEqual(len(costs), 1)
        sides = [getattr(costs[0].aabb_max, axis) - getattr(costs[0].aabb_min, axis) for axis in "xyz"]
        self.assertLessEqual(max(sides), 0.1 + 1e-6)
        self.assertGreaterEqual(np.prod(sides), 0.02 * 0.02 * 0.1 - 1e-9)

    def in_front(self, distance):
        at = call("compute_fk", GetPositionFK, Header(frame_id="world"), ["hand"], state_of(HOME)).pose_stamped[0].pose
        turn = quaternion_matrix([getattr(at.orientation, axis) for axis in "xyzw"])[:3, 2]
        return np.array([at.position.x, at.position.y, at.position.z]) + distance * turn

    def test_no_group_is_the_whole_robot_and_some_joints_are_enough(self):
        part = RobotState(joint_state=JointState(name=["joint_1"], position=[0.3]))
        self.assertTrue(valid(part, "").valid)
        level = OrientationConstraint(
            link_name="hand", absolute_x_axis_tolerance=0.1, absolute_y_axis_tolerance=0.1, absolute_z_axis_tolerance=0.1, weight=1.0
        )
        level.header.frame_id, level.orientation.w = "world", 1.0
        answer = valid(state_of(LEFT), constraints=Constraints(orientation_constraints=[level]))
        self.assertEqual((answer.valid, [r.result for r in answer.constraint_result]), (False, [False]))
        self.assertGreater(answer.constraint_result[0].distance, 0.1)


class Motion(unittest.TestCase):
    def test_a_line_in_the_frame_of_its_own_link_is_relative(self):
        self.assertEqual(move(HOME).result()[1].error_code.val, Codes.SUCCESS)
        asked = GetCartesianPathRequest(
            group_name="manipulator", link_name="hand", waypoints=[pose(0, 0, 0.05)], max_step=0.01, start_state=RobotState(is_diff=True)
        )
        asked.header.frame_id = "hand"
        answer = call("compute_cartesian_path", GetCartesianPath, asked)
        self.assertEqual((answer.error_code.val, answer.fraction), (Codes.SUCCESS, 1.0))
        asked.header.frame_id, asked.waypoints = "nowhere", [pose(0.4, 0, 0.5)]
        self.assertEqual(call("compute_cartesian_path", GetCartesianPath, asked).error_code.val, Codes.FRAME_TRANSFORM_FAILURE)

    def test_nothing_to_execute_is_executed(self):
        """As by upstream's manager, to which an empty trajectory is one that has ended."""
        code = Goal("execute_trajectory", ExecuteTrajectoryAction, ExecuteTrajectoryGoal()).result()[1].error_code.val
        self.assertEqual(code, Codes.SUCCESS)

    def test_points_that_do_not_fit_their_joints_are_refused(self):
        """A message may hold any number of values; whoever takes it for another has to be told, and the next goal is taken."""
        second = rospy.Duration(1.0)
        wrong = {
            "too few positions": [JointTrajectoryPoint(positions=HOME[1:], time_from_start=second)],
            "too few velocities": [JointTrajectoryPoint(positions=HOME, velocities=[0.0], time_from_start=second)],
            "too many accelerations": [JointTrajectoryPoint(positions=HOME, accelerations=[0.0] * 7, time_from_start=second)],
            "no number": [JointTrajectoryPoint(positions=HOME, effort=[float("nan")] * len(HOME), time_from_start=second)],
            "the same time": [JointTrajectoryPoint(positions=HOME, time_from_start=second)] * 2,
        }
        multi = {
            "no transforms": [MultiDOFJointTrajectoryPoint(time_from_start=second)],
            "no number": [
                MultiDOFJointTrajectoryPoint(transforms=[Transform(translation=Vector3(float("inf"), 0.0, 0.0))], time_from_start=second)
            ],
            "the same time": [MultiDOFJointTrajectoryPoint(transforms=[Transform()], time_from_start=second)] * 2,
        }
        cases = {what: RobotTrajectory(joint_trajectory=JointTrajectory(Header(), JOINTS, points)) for what, points in wrong.items()}
        for what, points in multi.items():
            path = MultiDOFJointTrajectory(Header(), JOINTS[:1], points)
            cases[f"{what}, transforms"] = RobotTrajectory(multi_dof_joint_trajectory=path)
        lines = []
        heard = rospy.Subscriber("/rosout", Log, lambda line: lines.append(line.msg))
        self.addCleanup(heard.unregister)
        for what, trajectory in cases.items():
            lines.clear()
            code = Goal("execute_trajectory", ExecuteTrajectoryAction, ExecuteTrajectoryGoal(trajectory)).result()[1].error_code.val
            self.assertLess(code, 0, what)
            wait_until(lambda: any("Wrong trajectory: point" in line for line in lines), f"a line that says why: {what}")
        self.test_nothing_to_execute_is_executed()


class AllTests(unittest.TestSuite):
    """All of the above, in order."""

    def __init__(self):
        load = unittest.defaultTestLoader.loadTestsFromTestCase
        super().__init__([load(case) for case in (PlannerParameters, Scene, Validity, Motion)])


if __name__ == "__main__":
    rospy.init_node("services_rostest")
    rospy.wait_for_service("get_planning_scene", timeout=PATIENCE)
    rostest.rosrun("moveit_ros_move_group", "services", "services_rostest.AllTests")
