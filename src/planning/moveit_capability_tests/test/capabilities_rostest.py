#!/usr/bin/env python3
"""Compiled capabilities of another package, in a move_group that is launched with their names."""

import math
import os
import queue
import signal
import subprocess
import threading
import unittest

import roslib.packages
import rospy
import rostest
from dynamic_reconfigure.client import Client
from dynamic_reconfigure.msg import Config
from geometry_msgs.msg import Pose, Quaternion
from moveit_msgs.msg import AttachedCollisionObject, CollisionObject, PlanningScene, PlanningSceneComponents
from moveit_msgs.srv import ApplyPlanningScene, GetPlanningScene
from sensor_msgs.msg import JointState
from shape_msgs.msg import SolidPrimitive
from std_srvs.srv import Trigger

PATIENCE = 60.0  # s, for a busy machine


def call(name, kind=Trigger, *arguments):
    rospy.wait_for_service(name, timeout=PATIENCE)
    return rospy.ServiceProxy(name, kind)(*arguments)


class Heard:
    """The newest message of a topic, and a wait for one that fits."""

    def __init__(self, topic, kind):
        self._messages = queue.Queue()
        self._subscriber = rospy.Subscriber(topic, kind, self._messages.put)

    def wait(self, fits):
        while True:
            message = self._messages.get(timeout=PATIENCE)
            if fits(message):
                return message


def scene_of_move_group():
    parts = PlanningSceneComponents()
    components = parts.WORLD_OBJECT_NAMES | parts.ROBOT_STATE_ATTACHED_OBJECTS
    scene = call("get_planning_scene", GetPlanningScene, PlanningSceneComponents(components)).scene
    objects = {item.id for item in scene.world.collision_objects}
    return objects, {body.object.id for body in scene.robot_state.attached_collision_objects}


def brick(name):
    """A small box far from the robot."""
    made = CollisionObject(id=name, primitives=[SolidPrimitive(SolidPrimitive.BOX, [0.1, 0.1, 0.1])])
    made.pose.position.x, made.pose.orientation.w = 3.0, 1.0
    made.primitive_poses = [Pose(orientation=Quaternion(0, 0, 0, 1))]
    made.header.frame_id = "base_link"
    return made


def joint_1_of(state):
    return dict(zip(state.name, state.position)).get("joint_1", 0.0)


class Launched:
    """The arm's launch file, started as by hand, and a wait for a line that it prints."""

    def __init__(self, *arguments):
        file = os.path.join(roslib.packages.get_pkg_dir("moveit_ros_planning"), "test", "robot", "arm.launch")
        self._process = subprocess.Popen(
            ["roslaunch", file, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
        )
        self._lines = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self._process.stdout:
            self._lines.put(line)

    def wait(self, *words):
        while True:
            line = self._lines.get(timeout=PATIENCE)
            if all(word in line for word in words):
                return line

    def end(self):
        self._process.send_signal(signal.SIGINT)
        self._process.wait(PATIENCE)


class CapabilitiesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        package = "moveit_capability_tests"
        cls.launched = Launched(f"capabilities:={package}/Refuses nobody/Exports {package}/Services")

    @classmethod
    def tearDownClass(cls):
        cls.launched.end()

    def test_1_each_is_loaded_or_told_of(self):
        self.launched.wait("Exception while loading move_group capability 'nobody/Exports': nobody exports it")
        self.launched.wait("Exception while loading move_group capability 'moveit_capability_tests/Refuses': its hardware is not there")
        self.launched.wait("MoveGroup using")
        self.launched.wait("- TestServices")
        self.launched.wait("- MoveAction")
        call("/move_group/add_box")  # below move_group's own name

    def test_2_what_a_capability_changes_move_group_has(self):
        self.assertTrue(call("/move_group/add_box").success)
        self.assertEqual(scene_of_move_group(), ({"box"}, set()))
        answer = call("/move_group/juggle")
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(scene_of_move_group(), ({"box"}, set()))
        self.assertTrue(call("/move_group/grasp_box").success)
        self.assertEqual(scene_of_move_group(), (set(), {"box"}))

    def test_2b_what_both_change_at_once_both_have(self):
        """move_group gets objects from others while a capability takes the box and lets it go."""
        topic = rospy.Publisher("collision_object", CollisionObject, queue_size=100)
        while topic.get_num_connections() == 0:
            threading.Event().wait(0.01)
        juggling = threading.Thread(target=lambda: answers.append(call("/move_group/juggle_held")))
        answers = []
        juggling.start()
        names = {f"brick_{number}" for number in range(20)}
        for name in sorted(names):
            topic.publish(brick(name))
            threading.Event().wait(0.02)
        juggling.join()
        self.assertTrue(answers[0].success, answers[0].message)
        self.wait_for_objects(" ".join(sorted(names)) + " / box")
        self.assertEqual(scene_of_move_group(), (names, {"box"}))
        for name in names:
            topic.publish(CollisionObject(id=name, operation=CollisionObject.REMOVE))
        self.wait_for_objects("/ box")

    def test_3_what_others_change_a_capability_sees(self):
        heard = Heard("/move_group_capabilities/planning_scene", PlanningScene)
        self.change_scene(world=[brick("wall")])
        heard.wait(lambda scene: any(item.id == "wall" for item in scene.world.collision_objects))
        self.wait_for_objects("wall / box")

    def test_3b_what_is_grasped_on_the_way_counts_for_the_rest_of_it(self):
        """A long bar is put on the turning arm; at the end of the turn it would meet a post."""
        post = brick("post")
        post.pose.position.x, post.pose.position.y, post.pose.position.z = math.cos(1.1), math.sin(1.1), 0.15
        self.change_scene(world=[post])
        states, answers = Heard("/joint_states", JointState), []
        going = threading.Thread(target=lambda: answers.append(call("/move_group/go_left_slowly")))
        going.start()
        states.wait(lambda state: joint_1_of(state) > 0.05)
        bar = brick("bar")
        bar.header.frame_id, bar.primitives[0].dimensions = "link_1", [1.0, 0.04, 0.04]
        bar.pose.position.x, bar.pose.position.z = 0.8, 0.05
        self.change_scene(attached=[AttachedCollisionObject(link_name="link_1", object=bar, touch_links=["base_link"])])
        going.join()
        self.assertEqual(answers[0].message, "Solution found but the environment changed during execution and the path was aborted")
        self.assertLess(joint_1_of(rospy.wait_for_message("/joint_states", JointState, PATIENCE)), 1.0)
        put_down = AttachedCollisionObject(link_name="link_1", object=CollisionObject(id="bar", operation=CollisionObject.REMOVE))
        self.change_scene(attached=[put_down])
        self.change_scene(world=[CollisionObject(id=name, operation=CollisionObject.REMOVE) for name in ("bar", "post")])
        self.wait_for_objects("wall / box")

    def change_scene(self, world=(), attached=()):
        diff = PlanningScene(is_diff=True)
        diff.robot_state.is_diff = True
        diff.world.collision_objects, diff.robot_state.attached_collision_objects = list(world), list(attached)
        self.assertTrue(call("apply_planning_scene", ApplyPlanningScene, diff).success)

    def wait_for_objects(self, text):
        ended, over = rospy.Time.now() + rospy.Duration(PATIENCE), threading.Event()
        while (seen := call("/objects").message) != text:
            self.assertLess(rospy.Time.now(), ended, f"a capability sees {seen!r}")
            over.wait(0.02)

    def test_4_it_plans_and_executes(self):
        states = Heard("/joint_states", JointState)
        answer = call("/move_group/go_left")
        self.assertEqual((answer.success, answer.message), (True, "Solution was found and executed."))
        states.wait(lambda state: abs(joint_1_of(state) - 1.2) < 1e-3)

    def test_4b_it_obeys_what_is_set_in_move_group(self):
        heard = Heard("/move_group_capabilities/trajectory_execution/parameter_updates", Config)
        for margin in (7.5, 0.5):
            Client("/move_group/trajectory_execution", PATIENCE).update_configuration({"allowed_goal_duration_margin": margin})
            heard.wait(
                lambda config, wanted=margin: ("allowed_goal_duration_margin", wanted) in [(d.name, d.value) for d in config.doubles]
            )

    def test_5_a_crash_leaves_move_group_alive(self):
        with self.assertRaises(rospy.ServiceException):
            call("/move_group/crash")
        self.launched.wait("the process of the compiled capabilities has ended by SIGSEGV: gone are TestServices")
        self.assertEqual(scene_of_move_group(), ({"wall"}, {"box"}))


if __name__ == "__main__":
    rospy.init_node("capabilities_rostest")
    rostest.rosrun("moveit_capability_tests", "capabilities", CapabilitiesTest)
