#!/usr/bin/env python3
"""MotionPlanning and its panel in RViz on a private display, used by real clicks; the arm's controllers pretend to move."""
import json
import math
import os
import shutil
import tempfile
import time
import unittest

import rospkg
import rospy
import rostest
import yaml
from geometry_msgs.msg import PoseStamped
from moveit_msgs.msg import PlanningScene
from moveit_msgs.srv import GetPlanningScene, GetPlanningSceneRequest, GetPositionFK, GetPositionFKRequest
from rqt_testing.desktop import Desktop
from sensor_msgs.msg import JointState, Joy
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
    @classmethod
    def setUpClass(cls):
        rospy.init_node("panel_test")
        rospy.wait_for_service("get_planning_scene", 60)
        cls.folder = tempfile.mkdtemp()
        cls.config = os.path.join(cls.folder, "moveit.rviz")
        shutil.copy(os.path.join(HERE, "moveit.rviz"), cls.config)
        cls.desktop = Desktop("1280x940x24")
        cls.desktop.__enter__()
        cls.rviz = cls.desktop.run([os.path.join(HERE, "rviz_window.py"), cls.config, "1270x900"])
        cls.rviz.wait(lambda: cls.statuses().get("MotionPlanning", ["", ""])[1] == "Status: Ok", "display without a complaint")

    @classmethod
    def tearDownClass(cls):
        if os.environ.get("PANEL_PICTURE"):
            cls.desktop.screenshot(os.environ["PANEL_PICTURE"])
        code = cls.rviz.end()
        cls.desktop.__exit__(None, None, None)
        shutil.rmtree(cls.folder)
        assert code == 0, code

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

    def marker(self):
        """The marker at the goal's hand."""
        markers = rospy.wait_for_message(MARKERS + "update_full", InteractiveMarkerInit, 10).markers
        return next(marker for marker in markers if marker.name == "EE:goal_hand")

    def test_1_all_displays_load_without_a_complaint(self):
        self.rviz.wait(lambda: all(entry[1] == "Status: Ok" for entry in self.statuses().values()),
                       f"four displays without complaint: {self.statuses()}")
        self.assertEqual([entry[0].split("/")[0] for entry in self.statuses().values()], ["moveit_rviz_plugin"] * 4)

    def test_2_saved_properties_stay(self):
        self.rviz.click("save_config")
        self.rviz.wait(lambda: os.path.exists(self.config + ".saved"), "saved file")
        time.sleep(0.5)
        before, after = (yaml.safe_load(open(self.config + end))["Visualization Manager"]["Displays"][0] for end in ("", ".saved"))

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
        time.sleep(0.5)
        reachable = goal()
        to(5.0)
        time.sleep(0.5)
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

    def test_7_the_marker_has_a_menu_that_plans_and_moves(self):
        publisher = rospy.Publisher(MARKERS + "feedback", InteractiveMarkerFeedback, queue_size=5)
        self.rviz.wait(lambda: publisher.get_num_connections(), "subscriber")
        marker = self.marker()

        def choose(title):
            entry, = [entry for entry in marker.menu_entries if entry.title == title]
            publisher.publish(InteractiveMarkerFeedback(client_id="test", marker_name=marker.name, menu_entry_id=entry.id,
                                                        event_type=InteractiveMarkerFeedback.MENU_SELECT, pose=marker.pose))

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
                rviz = desktop.run([os.path.join(HERE, "rviz_window.py"), config, "900x700"])

                def status():
                    return json.loads(rviz.ask("text", "statuses") or "{}").get(display, ["", "", {}])

                rviz.wait(lambda: status()[1] == "Status: Ok", f"{name}: no complaint of {display}")
                self.assertNotIn("could not be loaded", rviz.output())
                self.assertEqual(rviz.end(), 0)


if __name__ == "__main__":
    rostest.rosrun("moveit_ros_visualization", "panel_test", Panel)
