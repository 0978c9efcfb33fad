#!/usr/bin/env python3
"""MotionPlanning and its panel in RViz on a private display, used by real clicks; the arm's controllers pretend to move."""

import io
import json
import math
import os
import shutil
import sqlite3
import tempfile
import time
import unittest

import motion
import numpy as np
import rospkg
import rospy
import rostest
import yaml
from geometry_msgs.msg import PoseStamped
from moveit_core import scene_messages
from moveit_msgs.msg import Constraints, JointConstraint, MoveGroupActionGoal, PlanningScene
from moveit_msgs.srv import GetPlanningScene, GetPlanningSceneRequest, GetPositionFK, GetPositionFKRequest
from rqt_testing.desktop import Desktop
from rviz_desktop import run_rviz
from sensor_msgs.msg import JointState, Joy
from test_support.hearing import received
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit

MARKERS = "rviz_moveit_motion_planning_display/robot_interaction_interactive_marker_topic/"
HERE = os.path.dirname(os.path.abspath(__file__))
JOINTS = [f"joint_{number}" for number in range(1, 7)]
LEFT = dict(zip(JOINTS, (1.2, -0.6, 1.6, 0.0, 1.0, 0.0)))
HOME = dict(zip(JOINTS, (0.0, -0.6, 1.6, 0.0, 1.0, 0.0)))


def positions():
    """Where the arm's joints are, by name."""
    message = rospy.wait_for_message("joint_states", JointState, 10)
    return dict(zip(message.name, message.position))


def off(wanted):
    """The largest distance of a joint from where it is wanted, rad."""
    now = positions()
    return max(abs(now[name] - value) for name, value in wanted.items())


class Panel(unittest.TestCase):
    broken = ""  # the name of the test that failed

    @classmethod
    def setUpClass(cls):
        rospy.init_node("panel_test")
        rospy.wait_for_service("get_planning_scene", 60)
        cls.folder = tempfile.mkdtemp()
        os.environ["ROS_HOME"] = os.path.join(cls.folder, "ros")  # of RViz: stored scenes are its own
        cls.config = os.path.join(cls.folder, "moveit.rviz")
        shutil.copy(os.path.join(HERE, "moveit.rviz"), cls.config)
        cls.desktop = Desktop("1280x940x24")
        cls.desktop.__enter__()
        cls.rviz = run_rviz(cls.desktop, cls.config, "1270x900")
        cls.rviz.wait(lambda: cls.statuses().get("MotionPlanning", ["", ""])[1] == "Status: Ok", "display without a complaint")

    @classmethod
    def tearDownClass(cls):
        if os.environ.get("PANEL_PICTURE"):
            cls.desktop.screenshot(os.environ["PANEL_PICTURE"])
        code = cls.rviz.end()
        cls.desktop.__exit__(None, None, None)
        shutil.rmtree(cls.folder)
        assert code == 0, code

    def run(self, result=None):
        """After a failure the window is in a state that no later test expects: each would wait a minute in vain."""
        before = len(result.failures) + len(result.errors)
        answer = super().run(result)
        if len(result.failures) + len(result.errors) > before:
            Panel.broken = Panel.broken or self._testMethodName
        return answer

    def setUp(self):
        if Panel.broken:
            self.skipTest(f"the window's state is not known after {Panel.broken} failed")

    @classmethod
    def statuses(cls):
        return json.loads(cls.rviz.ask("text", "statuses") or "{}")

    def choose(self, combo, entry):
        self.rviz.click(combo)
        self.rviz.click_text(entry)
        self.rviz.wait(lambda: self.rviz.text(combo) == entry, f"{entry} in {combo}")

    def result(self, begin, timeout=60):
        self.rviz.wait(lambda: self.rviz.text("result_label").startswith(begin), f"result {begin}", timeout)

    def goal(self):
        """Joint values of the goal, from the tab Joints."""
        return [float(self.rviz.text("joint_value_" + name).split()[0]) for name in JOINTS]

    def at_rest(self, value):
        """What ``value()`` gives when it gives the same three times."""
        seen = []

        def resting():
            seen.append(value())
            return len(seen) > 2 and seen[-1] == seen[-2] == seen[-3]

        self.rviz.wait(resting, "a goal at rest")
        return seen[-1]

    def marker(self):
        """The marker at the goal's hand."""
        markers = rospy.wait_for_message(MARKERS + "update_full", InteractiveMarkerInit, 10).markers
        return next(marker for marker in markers if marker.name == "EE:goal_hand")

    def test_1_all_displays_load_without_a_complaint(self):
        self.rviz.wait(
            lambda: all(entry[1] == "Status: Ok" for entry in self.statuses().values()),
            f"four displays without complaint: {self.statuses()}",
        )
        self.assertEqual([entry[0].split("/")[0] for entry in self.statuses().values()], ["moveit_rviz_plugin"] * 4)

    def test_2_saved_properties_stay(self):
        self.rviz.click("save_config")
        self.rviz.wait(lambda: os.path.exists(self.config + ".saved"), "saved file")

        def display(end):
            try:
                return yaml.safe_load(open(self.config + end))["Visualization Manager"]["Displays"][0]
            except (yaml.YAMLError, TypeError, KeyError):  # half of it is written
                return None

        before, after = display(""), self.rviz.wait(lambda: display(".saved"), "a whole file")

        def compare(old, new, path):
            for key, value in old.items():
                where = f"{path}/{key}"
                self.assertIn(key, new, where)
                if isinstance(value, dict):
                    compare(value, new[key], where)
                elif isinstance(value, float):
                    self.assertAlmostEqual(value, float(new[key]), 5, where)
                elif value is not None:
                    self.assertEqual(str(value), str(new[key]), where)

        compare(before, after, "")

    def test_3_plan_and_execute_by_clicks(self):
        self.choose("goal_state_combo_box", "left")
        self.rviz.click("plan_button")
        self.result("Time: ")
        self.assertGreater(off(LEFT), 1.0)
        self.rviz.click("execute_button")
        self.result("Executed")
        self.rviz.wait(lambda: off(LEFT) < 0.01, "arm on the left")

    def test_4_plan_and_execute_in_one_and_stop(self):
        self.choose("goal_state_combo_box", "home")
        self.rviz.click("plan_and_execute_button")
        self.result("Executed")
        self.rviz.wait(lambda: off(HOME) < 0.01, "arm at home")
        self.rviz.click("velocity_scaling_factor", at=(0.3, 0.5))
        self.desktop.keys("ctrl+a")
        self.desktop.type("0.03\n")
        self.choose("goal_state_combo_box", "left")
        self.rviz.click("plan_and_execute_button")
        self.rviz.wait(lambda: off(HOME) > 0.1, "arm on its way")
        self.rviz.click("stop_button")
        self.result("Stopped")
        self.assertGreater(off(LEFT), 0.1)

    def test_5_a_dragged_goal_follows_and_shows_the_last_reachable_pose(self):
        self.choose("goal_state_combo_box", "home")
        self.rviz.click_text("Joints")
        request = GetPositionFKRequest(fk_link_names=["hand"])
        request.robot_state.joint_state = JointState(name=list(HOME), position=list(HOME.values()))
        pose = rospy.ServiceProxy("compute_fk", GetPositionFK)(request).pose_stamped[0]
        publisher = rospy.Publisher("/rviz/moveit/move_marker/goal_hand", PoseStamped, queue_size=1)
        self.rviz.wait(lambda: publisher.get_num_connections(), "subscriber")
        goal = self.goal

        def to(dz):
            message = PoseStamped(pose=pose.pose)
            message.header.frame_id = "world"
            message.pose.position.z += dz
            publisher.publish(message)
            message.pose.position.z -= dz

        start, seen = goal(), []
        for step in range(1, 31):
            to(-0.003 * step)
            time.sleep(1 / 30)
            seen.append(goal())
        self.rviz.wait(lambda: max(abs(a - b) for a, b in zip(goal(), start)) > 0.05, "goal that follows")
        self.assertLess(max(abs(a - b) for one, two in zip(seen, seen[1:]) for a, b in zip(one, two)), 0.3, "no leap of a joint")
        self.rviz.wait(lambda: received(publisher, 30), "the last pose to come")
        reachable = self.at_rest(goal)
        to(5.0)
        self.rviz.wait(lambda: received(publisher, 31), "the pose out of reach to come")
        self.assertTrue(all(math.isfinite(value) for value in goal()))
        to(-0.09)
        self.rviz.wait(lambda: max(abs(a - b) for a, b in zip(goal(), reachable)) < 0.02, "goal that follows again")
        self.rviz.click_text("Planning")

    def test_6_an_object_is_added_published_and_removed(self):
        self.rviz.click_text("Scene Objects")
        ask = rospy.ServiceProxy("get_planning_scene", GetPlanningScene)

        def objects():
            request = GetPlanningSceneRequest()
            request.components.components = request.components.WORLD_OBJECT_NAMES
            return [item.id for item in ask(request).scene.world.collision_objects]

        heard = []
        rospy.Subscriber("planning_scene", PlanningScene, heard.append)
        self.rviz.click("add_object_button")
        self.rviz.wait(lambda: "Box_0" in (self.rviz.text("object_status") or ""), "object that is chosen")
        self.assertEqual(objects(), [])
        self.rviz.click("publish_current_scene_button")
        self.rviz.wait(lambda: objects() == ["Box_0"], "object in move_group")
        self.rviz.click("remove_object_button")
        self.rviz.click("publish_current_scene_button")
        self.rviz.wait(lambda: objects() == [], "scene without it")
        self.rviz.click_text("Planning")

    def scene(self):
        """What move_group has: objects of the world, what is attached as {object: link}, bytes of octomap."""
        request = GetPlanningSceneRequest()
        request.components.components = 2 | 4 | 8 | 16 | 32
        scene = rospy.ServiceProxy("get_planning_scene", GetPlanningScene)(request).scene
        return (
            {item.id: item for item in scene.world.collision_objects},
            {item.object.id: item.link_name for item in scene.robot_state.attached_collision_objects},
            len(scene.world.octomap.octomap.data),
        )

    def type_number(self, name, value):
        self.rviz.click(name, at=(0.3, 0.5))
        self.desktop.keys("ctrl+a")
        self.desktop.type(f"{value}\n")

    def publish(self, condition, what):
        self.rviz.click("publish_current_scene_button")
        self.rviz.wait(condition, what)

    def tick(self, entry):
        """The box before an object's name."""
        x, y, _, height = self.rviz.wait(lambda: self.rviz.ask("entry", entry), entry)
        self.desktop.click_at(x + 10, y + height // 2)

    def test_6_1_an_object_is_attached_moves_along_and_is_let_go(self):
        self.rviz.click_text("Scene Objects")
        self.rviz.click("add_object_button")
        self.rviz.wait(lambda: "Box_0" in (self.rviz.text("object_status") or ""), "object that is chosen")
        for name, value in (("object_x", 0.5), ("object_y", -0.4), ("object_z", 1.0)):
            self.type_number(name, value)
        self.tick("Box_0")
        self.rviz.window("Select Link Name")
        self.rviz.click_text("OK")
        self.rviz.wait(lambda: "attached to hand" in self.rviz.text("object_status"), "object in the hand")
        self.rviz.wait(lambda: not self.rviz.ask("enabled", "object_x"), "no pose for what is attached")
        self.publish(lambda: self.scene()[1] == {"Box_0": "hand"}, "object in the hand, for move_group")
        self.rviz.click_text("Planning")
        self.type_number("velocity_scaling_factor", 1.0)
        self.choose("goal_state_combo_box", "left" if off(HOME) < off(LEFT) else "home")  # the farther one
        self.rviz.click("plan_and_execute_button")
        self.result("Executed")
        self.rviz.click_text("Scene Objects")
        self.tick("Box_0")
        self.rviz.wait(lambda: self.rviz.ask("enabled", "object_x"), "pose of the object")
        self.assertGreater(abs(float(self.rviz.text("object_x")) - 0.5) + abs(float(self.rviz.text("object_y")) + 0.4), 0.1)
        self.publish(lambda: self.scene()[1] == {} and "Box_0" in self.scene()[0], "object in the world again")
        self.rviz.click_text("Planning")

    def name_file(self, title, path):
        """Into a file dialog, which may take no keys yet when it is seen first."""
        self.rviz.window(title)

        def typed():
            self.desktop.keys("ctrl+a")
            self.desktop.type(path)
            return self.rviz.text("fileNameEdit") == path

        self.rviz.wait(typed, f"the name in {title}")
        self.desktop.type("\n")

    def test_6_2_objects_go_to_a_file_and_come_back_with_a_mesh(self):
        mesh = os.path.join(self.folder, "wedge.stl")
        with open(mesh, "w") as file:
            file.write(
                "solid w\n"
                + "".join(
                    "facet normal 0 0 0\nouter loop\n" + "".join(f"vertex {x} {y} {z}\n" for x, y, z in corners) + "endloop\nendfacet\n"
                    for corners in (
                        ((0, 0, 0), (1, 0, 0), (0, 1, 0)),
                        ((0, 0, 0), (0, 1, 0), (0, 0, 1)),
                        ((0, 0, 0), (0, 0, 1), (1, 0, 0)),
                        ((1, 0, 0), (0, 0, 1), (0, 1, 0)),
                    )
                )
                + "endsolid w\n"
            )
        self.rviz.click_text("Scene Objects")
        self.choose("shapes_combo_box", "Mesh from file")
        self.type_number("shape_size_x_spin_box", 0.1)
        self.rviz.click("add_object_button")
        self.name_file("Mesh", mesh)
        self.rviz.wait(lambda: "wedge_0" in self.rviz.text("object_status"), "mesh")
        self.type_number("object_z", 1.5)
        self.publish(lambda: "wedge_0" in self.scene()[0], "mesh in move_group")
        before = self.scene()[0]
        self.assertEqual(max(v.x for v in before["wedge_0"].meshes[0].vertices), 0.1)
        self.rviz.click("export_scene_geometry_text_button")
        self.name_file("Export", os.path.join(self.folder, "all"))
        self.rviz.wait(lambda: os.path.exists(os.path.join(self.folder, "all.scene")), "file")
        self.rviz.click("clear_scene_button")
        self.publish(lambda: not self.scene()[0], "empty scene")
        self.rviz.click("import_scene_geometry_text_button")
        self.name_file("Import", os.path.join(self.folder, "all.scene"))
        self.rviz.wait(lambda: self.rviz.ask("entry", "wedge_0"), "objects of the file")
        self.publish(lambda: set(self.scene()[0]) == set(before), "objects in move_group again")
        for name, item in self.scene()[0].items():
            self.assertLess(
                math.dist(
                    (item.pose.position.x, item.pose.position.y, item.pose.position.z),
                    (before[name].pose.position.x, before[name].pose.position.y, before[name].pose.position.z),
                ),
                1e-6,
            )
        self.rviz.click("clear_scene_button")
        self.publish(lambda: not self.scene()[0], "empty scene")
        self.choose("shapes_combo_box", "Box")
        self.rviz.click_text("Planning")

    def test_6_3_constraints_that_another_node_keeps_are_offered_and_sent(self):
        base = os.path.join(os.environ["ROS_HOME"], "warehouse.sqlite")
        constraints = Constraints(
            name="anywhere", joint_constraints=[JointConstraint(joint_name="joint_1", tolerance_above=3.0, tolerance_below=3.0, weight=1.0)]
        )
        data = io.BytesIO()
        constraints.serialize(data)
        with sqlite3.connect(base) as connection:
            connection.execute(
                "INSERT OR REPLACE INTO constraints (name, robot, planning_group, data) VALUES (?, '', '', ?)",
                ("anywhere", data.getvalue()),
            )
        goals = []
        subscriber = rospy.Subscriber("move_group/goal", MoveGroupActionGoal, goals.append)
        self.rviz.wait(subscriber.get_num_connections, "action client")

        def offered():
            self.rviz.click("path_constraints_combo_box")
            if self.rviz.ask("entry", "anywhere"):
                return True
            self.desktop.keys("Escape")
            return False

        self.rviz.wait(offered, "the constraints to be offered")  # the panel looks at the file once a second
        self.rviz.click_text("anywhere")
        self.rviz.wait(lambda: self.rviz.text("path_constraints_combo_box") == "anywhere", "the constraints to be chosen")
        self.choose("goal_state_combo_box", "left" if off(HOME) < 0.1 else "home")
        self.rviz.click("plan_button")
        self.result("Time: ")
        self.rviz.wait(lambda: goals, "goal")
        self.assertEqual(goals[-1].goal.request.path_constraints, constraints)
        self.choose("path_constraints_combo_box", "None")
        self.rviz.click("plan_button")
        self.rviz.wait(lambda: len(goals) > 1, "second goal")
        self.assertEqual(goals[-1].goal.request.path_constraints, Constraints())
        self.result("Time: ")
        subscriber.unregister()

    def test_6_4_an_octomap_is_shown_and_cleared(self):
        scene = motion.PlanningScene(motion.load_model('<robot name="r"><link name="world"/></robot>'))
        scene.set_octomap(motion.OcTree.from_points(np.array([[1.0, 1.0, 1.0]]), 0.1), motion.Pose.identity())
        message = PlanningScene(is_diff=True)
        message.robot_state.is_diff = True
        message.world.octomap = scene_messages.octomap_message(scene)
        publisher = rospy.Publisher("planning_scene", PlanningScene, queue_size=1, latch=True)
        publisher.publish(message)
        self.rviz.wait(lambda: self.rviz.ask("enabled", "clear_octomap_button"), "octomap in RViz")
        self.assertGreater(self.scene()[2], 0)
        publisher.unregister()
        self.rviz.click("clear_octomap_button")
        self.rviz.wait(lambda: not self.rviz.ask("enabled", "clear_octomap_button"), "no octomap in RViz")
        self.assertEqual(self.scene()[2], 0)

    def test_7_the_marker_has_a_menu_that_plans_and_moves(self):
        publisher = rospy.Publisher(MARKERS + "feedback", InteractiveMarkerFeedback, queue_size=5)
        self.rviz.wait(lambda: publisher.get_num_connections(), "subscriber")
        marker = self.marker()

        def choose(title):
            (entry,) = [entry for entry in marker.menu_entries if entry.title == title]
            publisher.publish(
                InteractiveMarkerFeedback(
                    client_id="test",
                    marker_name=marker.name,
                    menu_entry_id=entry.id,
                    event_type=InteractiveMarkerFeedback.MENU_SELECT,
                    pose=marker.pose,
                )
            )

        self.rviz.click("velocity_scaling_factor", at=(0.3, 0.5))
        self.desktop.keys("ctrl+a")
        self.desktop.type("1.0\n")
        choose("home")
        self.rviz.wait(lambda: self.rviz.text("goal_state_combo_box") == "home", "goal that the menu set")
        choose("Plan and Execute")
        self.rviz.wait(lambda: off(HOME) < 0.01, "arm at home")

    def test_8_a_gamepad_moves_the_goal(self):
        joy = rospy.Publisher("joy", Joy, queue_size=1)
        self.rviz.wait(lambda: joy.get_num_connections(), "subscriber")
        start = self.marker().pose.position

        def off_start():
            now = self.marker().pose.position
            return math.dist((now.x, now.y, now.z), (start.x, start.y, start.z))

        end = time.monotonic() + 60
        while off_start() < 0.03:
            self.assertLess(time.monotonic(), end, "the stick does not move the goal")
            joy.publish(Joy(axes=[0.0, -1.0] + [0.0] * 6, buttons=[0] * 11))
            time.sleep(0.05)
        self.assertLess(off_start(), 0.2)
        self.choose("goal_state_combo_box", "left")
        self.result("Executed")  # of the plan before
        for button, result in ((2, "Time: "), (1, "Executed")):
            joy.publish(Joy(axes=[0.0] * 8, buttons=[int(i == button) for i in range(11)]))
            self.result(result)
            joy.publish(Joy(axes=[0.0] * 8, buttons=[0] * 11))
        self.rviz.wait(lambda: off(LEFT) < 0.01, "arm on the left")

    def test_9_configurations_of_generated_packages_open_as_they_are(self):
        paths = rospkg.RosPack()
        with open(os.path.join(paths.get_path("moveit_setup_assistant"), "templates", "launch", "moveit.rviz.in")) as file:
            template = file.read().replace("@{planning_frame}", "world")
        with open(os.path.join(paths.get_path("myur5_moveit_config"), "launch", "moveit.rviz")) as file:
            lab = file.read()
        for name, text, display in (("generated", template, "MotionPlanning"), ("lab", lab, "MotionPlanning")):
            config = os.path.join(self.folder, name + ".rviz")
            with open(config, "w") as file:
                file.write(text)
            with Desktop() as desktop:
                rviz = run_rviz(desktop, config, "900x700")

                def status():
                    return json.loads(rviz.ask("text", "statuses") or "{}").get(display, ["", "", {}])

                rviz.wait(lambda: status()[1] == "Status: Ok", f"{name}: no complaint of {display}")
                self.assertNotIn("could not be loaded", rviz.output())
                self.assertEqual(rviz.end(), 0)


if __name__ == "__main__":
    rostest.rosrun("moveit_ros_visualization", "panel_test", Panel)
