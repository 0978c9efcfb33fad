#!/usr/bin/env python3
"""What is held: attached, changed and let go through topics, the service and clients. Lengths in m."""

import copy
import unittest

import numpy as np
import rospy
import rostest
import tf2_ros
from client import HOME, LEFT, apply, box, call, clear, plan, pose, wait_until
from moveit_msgs.msg import (
    AttachedCollisionObject,
    CollisionObject,
    Constraints,
    MoveItErrorCodes,
    ObjectColor,
    OrientationConstraint,
    PlanningSceneComponents,
    PlanningSceneWorld,
    PositionConstraint,
    RobotState,
)
from moveit_msgs.srv import ApplyPlanningScene, GetPositionFK, GetPositionIK, GetPositionIKRequest
from object_recognition_msgs.msg import ObjectType
from services_rostest import scene, state_of
from shape_msgs.msg import SolidPrimitive
from std_msgs.msg import ColorRGBA, Header
from tf.transformations import quaternion_matrix
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

Parts = PlanningSceneComponents
ALL = 0
ADD, REMOVE, APPEND, MOVE = CollisionObject.ADD, CollisionObject.REMOVE, CollisionObject.APPEND, CollisionObject.MOVE


def hold(thing, link="hand", touch=("finger_left", "finger_right"), operation=ADD):
    """An AttachedCollisionObject of a CollisionObject, or of a name."""
    item = CollisionObject(id=thing) if isinstance(thing, str) else copy.deepcopy(thing)
    item.operation = operation
    return AttachedCollisionObject(link_name=link, object=item, touch_links=list(touch))


def change(*bodies, is_diff=True):
    """Whether move_group took the attached objects of a diff."""
    return apply(robot_state=RobotState(is_diff=is_diff, attached_collision_objects=list(bodies)))


def held():
    return {body.object.id: body for body in scene(Parts.ROBOT_STATE_ATTACHED_OBJECTS).robot_state.attached_collision_objects}


def standing():
    return {item.id: item for item in scene(Parts.WORLD_OBJECT_GEOMETRY).world.collision_objects}


def stick(name="stick"):
    """0.1 long, its middle 0.15 before the hand, with a tip."""
    item = box(name, 0, 0, 0.15, (0.02, 0.02, 0.1))
    item.header.frame_id = "hand"
    item.subframe_names, item.subframe_poses = ["tip"], [pose(0, 0, 0.05)]
    return item


def at(stamped):
    where = stamped.pose.position
    return np.array([where.x, where.y, where.z])


class Held(unittest.TestCase):
    def tearDown(self):
        change(hold("", "", (), REMOVE))
        clear()

    def test_what_an_attached_object_carries(self):
        """Through the topic: from the world, with touch links, weight, posture and subframes."""
        self.assertTrue(apply(stick()))
        publisher = rospy.Publisher("attached_collision_object", AttachedCollisionObject, queue_size=1)
        wait_until(publisher.get_num_connections, "a listener")
        body = hold("stick")
        body.weight = 0.5
        body.detach_posture = JointTrajectory(joint_names=["finger_joint"], points=[JointTrajectoryPoint(positions=[0.03])])
        publisher.publish(body)
        wait_until(lambda: "stick" in held(), "the stick held")
        seen = held()["stick"]
        self.assertFalse(standing())
        self.assertEqual((seen.link_name, seen.weight), ("hand", 0.5))
        self.assertLessEqual({"finger_left", "finger_right"}, set(seen.touch_links))
        self.assertEqual(seen.detach_posture.points[0].positions, (0.03,))
        self.assertEqual(seen.object.subframe_names, ["tip"])
        self.assertEqual(seen.object.header.frame_id, "hand")
        self.assertAlmostEqual(seen.object.pose.position.z, 0.15, places=6)

    def test_what_cannot_be_attached_changes_nothing(self):
        self.assertTrue(change(hold(stick())))
        flat, lame = stick("flat"), stick("lame")
        flat.primitives[0].dimensions, lame.subframe_names = [0.1], ["tip", "toe"]
        lost = stick("lost")
        lost.header.frame_id = "nowhere"
        for bad in (
            hold("ghost"),
            hold("stick", "link_5"),
            hold(stick("a"), ""),
            hold(stick("b"), "claw"),
            hold(flat),
            hold(lame),
            hold(lost),
            hold(stick("")),
            hold("stick", operation=MOVE),
            hold(stick("<octomap>")),
        ):
            self.assertFalse(change(bad), f"{bad.object.id} on {bad.link_name}")
            self.assertEqual({name: body.link_name for name, body in held().items()}, {"stick": "hand"})

    def test_what_is_held_elsewhere_goes_over(self):
        self.assertTrue(change(hold(stick())))
        self.assertTrue(change(hold(stick(), "link_6", ["link_6"])))
        self.assertEqual([(body.link_name, body.touch_links) for body in held().values()], [("link_6", ["link_6"])])
        self.assertAlmostEqual(held()["stick"].object.pose.position.z, 0.15 + 0.04, places=6)  # the hand is 4 cm further out

    def test_letting_go_of_one_of_a_links_and_of_all(self):
        one, two, three = stick("one"), stick("two"), stick("three")
        for thing, link in ((one, "hand"), (two, "hand"), (three, "link_6")):
            self.assertTrue(change(hold(thing, link)))
        self.assertFalse(change(hold("one", "link_6", (), REMOVE)))  # it hangs elsewhere
        self.assertFalse(change(hold("four", "", (), REMOVE)))
        self.assertFalse(change(hold("", "claw", (), REMOVE)))
        self.assertEqual(sorted(held()), ["one", "three", "two"])
        self.assertTrue(change(hold("one", "", (), REMOVE)))
        self.assertEqual((sorted(held()), sorted(standing())), (["three", "two"], ["one"]))
        self.assertTrue(change(hold("", "link_6", (), REMOVE)))
        self.assertEqual(sorted(held()), ["two"])
        self.assertTrue(change(hold("", "", (), REMOVE)))
        self.assertEqual((held(), sorted(standing())), ({}, ["one", "three", "two"]))
        self.assertTrue(change(hold("", "", (), REMOVE)))  # nothing is held: nothing to do
        self.assertTrue(change(hold("", "hand", (), REMOVE)))

    def test_more_shapes_for_what_is_held(self):
        self.assertTrue(change(hold(stick())))
        more = box("stick", 0, 0, 0.3, (0.01, 0.01, 0.01))
        more.header.frame_id = "hand"
        self.assertTrue(change(hold(more, touch=["link_6"], operation=APPEND)))
        body = held()["stick"]
        self.assertEqual(len(body.object.primitives), 2)
        self.assertLessEqual({"finger_left", "finger_right", "link_6"}, set(body.touch_links))
        self.assertEqual(body.object.subframe_names, ["tip"])

    def test_a_whole_state_replaces_what_is_held(self):
        self.assertTrue(change(hold(stick())))
        self.assertTrue(change(hold(stick("other")), is_diff=False))
        self.assertEqual((list(held()), standing()), (["other"], {}))

    def test_type_colour_and_permissions_go_along(self):
        thing = stick()
        thing.type = ObjectType(key="pen", db="{}")
        matrix = scene(Parts.ALLOWED_COLLISION_MATRIX).allowed_collision_matrix
        self.assertTrue(
            apply(
                thing,
                allowed_collision_matrix=self.allowing(matrix, "stick", "link_3"),
                object_colors=[ObjectColor("stick", ColorRGBA(1, 0, 0, 1))],
            )
        )
        for step, there in ((hold("stick"), held), (hold("stick", operation=REMOVE), standing)):
            self.assertTrue(change(step))
            item = there()["stick"]
            self.assertEqual(getattr(item, "object", item).type.key, "pen", there.__name__)
            self.assertEqual(self.known("stick"), (True, ["stick"]))
        clear()
        self.assertEqual(self.known("stick"), (False, []))

    def test_what_vanishes_leaves_nothing_behind(self):
        """Held, and gone with a whole state; standing, and gone with a whole world: colours and permissions go too."""
        worlds = rospy.Publisher("planning_scene_world", PlanningSceneWorld, queue_size=1)
        wait_until(worlds.get_num_connections, "a listener")

        def by_state():
            self.assertTrue(change(hold("stick")))
            self.assertTrue(change(hold(stick("other")), is_diff=False))

        def by_world():
            worlds.publish(PlanningSceneWorld(collision_objects=[box("other", 1, 1, 1)]))
            wait_until(lambda: list(standing()) == ["other"], "the other world")

        for vanish in (by_state, by_world):
            matrix = scene(Parts.ALLOWED_COLLISION_MATRIX).allowed_collision_matrix
            self.assertTrue(
                apply(
                    stick(),
                    allowed_collision_matrix=self.allowing(matrix, "stick", "link_3"),
                    object_colors=[ObjectColor("stick", ColorRGBA(1, 0, 0, 1))],
                )
            )
            vanish()
            self.assertEqual(self.known("stick"), (False, []), vanish.__name__)
            self.tearDown()

    @staticmethod
    def allowing(matrix, name, link):
        matrix = copy.deepcopy(matrix)
        index = matrix.entry_names.index(link)
        matrix.entry_names.append(name)
        for number, row in enumerate(matrix.entry_values):
            row.enabled = [*row.enabled, number == index]
        row = copy.deepcopy(matrix.entry_values[0])
        row.enabled = [number == index for number in range(len(matrix.entry_names))]
        matrix.entry_values.append(row)
        return matrix

    @staticmethod
    def known(name):
        """(whether a permission names it, the objects that have colours)."""
        seen = scene(ALL)
        return name in seen.allowed_collision_matrix.entry_names, [entry.id for entry in seen.object_colors]

    def test_its_frames_are_published_on_the_link(self):
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        self.assertTrue(change(hold(stick())))

        def seen(parent, frame):
            wait_until(lambda: buffer.can_transform(parent, frame, rospy.Time()), frame)
            where = buffer.lookup_transform(parent, frame, rospy.Time()).transform.translation
            return [where.x, where.y, where.z]

        np.testing.assert_allclose(seen("hand", "move_group/stick"), [0, 0, 0.15], atol=1e-6)
        np.testing.assert_allclose(seen("hand", "move_group/stick/tip"), [0, 0, 0.20], atol=1e-6)
        self.assertTrue(change(hold("stick", operation=REMOVE)))
        in_world = at(call("compute_fk", GetPositionFK, Header(frame_id="world"), ["hand"], RobotState(is_diff=True)).pose_stamped[0])
        wait_until(lambda: np.linalg.norm(np.subtract(seen("world", "move_group/stick"), in_world)) < 0.1501, "the stick in the world")
        listener.unregister()

    def test_its_frames_in_requests(self):
        self.assertTrue(change(hold(stick())))
        hand, fk = state_of(HOME), lambda frame, state: call("compute_fk", GetPositionFK, Header(frame_id=frame), ["hand"], state)
        for frame, z in (("stick", -0.15), ("stick/tip", -0.20)):
            with self.subTest(frame):
                answer = fk(frame, hand)
                self.assertEqual(answer.error_code.val, MoveItErrorCodes.SUCCESS)
                np.testing.assert_allclose(at(answer.pose_stamped[0]), [0, 0, z], atol=1e-5)
        with self.subTest("inverse kinematics in and of its frames"):
            query = GetPositionIKRequest()
            query.ik_request.group_name, query.ik_request.robot_state = "manipulator", hand
            query.ik_request.ik_link_name = "stick/tip"
            query.ik_request.timeout = rospy.Duration(1.0)
            target = query.ik_request.pose_stamped
            target.header.frame_id, target.pose = "stick/tip", pose(0, 0, 0.02)
            answer = rospy.ServiceProxy("compute_ik", GetPositionIK)(query)
            self.assertEqual(answer.error_code.val, MoveItErrorCodes.SUCCESS)
            before = at(fk("world", hand).pose_stamped[0])
            after = at(fk("world", answer.solution).pose_stamped[0])
            self.assertAlmostEqual(np.linalg.norm(after - before), 0.02, delta=1e-4)
        with self.subTest("a thing put at its tip"):
            ball = CollisionObject(id="ball", primitives=[SolidPrimitive(SolidPrimitive.SPHERE, [0.005])], pose=pose(0, 0, 0.1))
            ball.header.frame_id = "stick/tip"
            self.assertTrue(apply(ball))
        with self.subTest("constraints of its tip"):
            here = fk("world", hand).pose_stamped[0].pose
            turned = quaternion_matrix([getattr(here.orientation, axis) for axis in "xyzw"])[:3, 2]
            near = PositionConstraint(link_name="stick/tip", weight=1.0)
            near.header.frame_id = "world"
            near.constraint_region.primitives = [SolidPrimitive(SolidPrimitive.SPHERE, [1e-3])]
            where = np.array([here.position.x, here.position.y, here.position.z]) + 0.15 * turned
            near.constraint_region.primitive_poses = [pose(*where)]
            turn = OrientationConstraint(
                link_name="stick/tip",
                absolute_x_axis_tolerance=0.01,
                absolute_y_axis_tolerance=0.01,
                absolute_z_axis_tolerance=0.01,
                weight=1.0,
                orientation=here.orientation,
            )
            turn.header.frame_id = "world"
            goal = Constraints(position_constraints=[near], orientation_constraints=[turn])
            answer = plan(goal_constraints=[goal], start_state=hand)
            self.assertEqual(answer.error_code.val, MoveItErrorCodes.SUCCESS)
            ends = answer.trajectory.joint_trajectory
            there = RobotState(is_diff=True)
            there.joint_state.name, there.joint_state.position = ends.joint_names, ends.points[-1].positions
            moved = at(fk("world", there).pose_stamped[0]) - at(fk("world", hand).pose_stamped[0])
            np.testing.assert_allclose(moved, -0.05 * turned, atol=4e-3)

    def test_the_start_state_of_a_request_holds_and_lets_go(self):
        self.assertTrue(change(hold(stick())))
        away = RobotState(is_diff=True, attached_collision_objects=[hold("stick", operation=REMOVE)])
        for state, names in ((RobotState(is_diff=True), ["stick"]), (away, [])):
            answer = plan(LEFT, start_state=state)
            self.assertEqual(answer.error_code.val, MoveItErrorCodes.SUCCESS)
            self.assertEqual([body.object.id for body in answer.trajectory_start.attached_collision_objects], names)

    def test_a_scene_that_was_published_can_be_sent_back(self):
        self.assertTrue(change(hold(stick())))
        self.assertTrue(apply(box("crate", 1, 1, 1)))
        saved = scene(ALL)
        self.tearDown()
        self.assertTrue(call("apply_planning_scene", ApplyPlanningScene, saved).success)
        self.assertEqual((list(held()), list(standing())), (["stick"], ["crate"]))
        self.assertEqual(held()["stick"], saved.robot_state.attached_collision_objects[0])


if __name__ == "__main__":
    rospy.init_node("held_rostest")
    rostest.rosrun("moveit_ros_move_group", "held", Held)
