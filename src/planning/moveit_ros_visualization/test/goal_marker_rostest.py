#!/usr/bin/env python3
"""The marker is dragged and its menu chosen as RViz would do it."""
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from moveit_commander import MoveGroupCommander, PlanningSceneInterface
from moveit_msgs.msg import DisplayTrajectory
from sensor_msgs.msg import Joy
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit, MarkerArray

PATIENCE = 60.0


def wait_for(topic, kind, condition=lambda message: True):
    end = rospy.get_time() + PATIENCE
    while rospy.get_time() < end:
        message = rospy.wait_for_message(topic, kind, PATIENCE)
        if condition(message):
            return message
    raise AssertionError(f"waited in vain on {topic}")


class Marker(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.arm = MoveGroupCommander("manipulator", wait_for_servers=PATIENCE)
        cls.scene = PlanningSceneInterface()
        cls.publisher = rospy.Publisher("goal_marker/feedback", InteractiveMarkerFeedback, queue_size=10)
        cls.marker = wait_for("goal_marker/update_full", InteractiveMarkerInit, lambda message: message.markers).markers[0]
        while not cls.publisher.get_num_connections():
            rospy.sleep(0.01)
        rospy.sleep(1.5)  # a marker's server takes no feedback from a client in the marker's first second

    def send(self, event, pose=None, entry=0):
        self.publisher.publish(InteractiveMarkerFeedback(
            client_id="test", marker_name=self.marker.name, menu_entry_id=entry, event_type=event,
            pose=pose or self.marker.pose))

    def choose(self, title):
        entry, = [entry for entry in self.marker.menu_entries if entry.title == title]
        self.send(InteractiveMarkerFeedback.MENU_SELECT, entry=entry.id)

    def test_the_menu_has_what_planning_needs(self):
        titles = [entry.title for entry in self.marker.menu_entries]
        for title in ("Plan", "Execute", "Plan && Execute", "Stop", "current", "random", "zeros", "home", "left"):
            self.assertIn(title, titles)

    def test_a_dragged_goal_is_reached(self):
        goal = self.arm.get_current_pose()
        goal.pose.position.y += 0.1
        self.send(InteractiveMarkerFeedback.POSE_UPDATE, goal.pose)
        self.choose("Plan && Execute")
        end = rospy.get_time() + PATIENCE
        while abs(self.arm.get_current_pose().pose.position.y - goal.pose.position.y) > 2e-3:
            self.assertLess(rospy.get_time(), end, "the goal is not reached")
            rospy.sleep(0.05)

    def test_a_goal_that_cannot_be_reached_is_red(self):
        far = self.arm.get_current_pose().pose
        far.position.x = 3.0
        self.send(InteractiveMarkerFeedback.POSE_UPDATE, far)
        wait_for("goal_marker/goal", MarkerArray, lambda m: m.markers[0].color.r == 1.0 and m.markers[0].color.g == 0.0)
        self.choose("home")
        wait_for("goal_marker/goal", MarkerArray, lambda m: m.markers[0].color.g > 0.0)

    def test_a_joystick_moves_the_goal_and_the_robot(self):
        joy = rospy.Publisher("joy", Joy, queue_size=1)
        self.choose("current")
        start = self.arm.get_current_pose().pose.position
        wait_for("goal_marker/pose", PoseStamped, lambda m: abs(m.pose.position.x - start.x) < 1e-3)
        end = rospy.get_time() + PATIENCE
        while wait_for("goal_marker/pose", PoseStamped).pose.position.z > start.z - 0.05:
            self.assertLess(rospy.get_time(), end, "the stick does not move the goal")
            joy.publish(Joy(axes=[0.0, 0.0, 0.0, 0.0, -1.0, 0.0], buttons=[0] * 8))
            rospy.sleep(0.05)
        down = wait_for("goal_marker/pose", PoseStamped).pose.position.z
        for button in (2, 1):  # plan, execute
            joy.publish(Joy(axes=[0.0] * 6, buttons=[int(i == button) for i in range(8)]))
            rospy.sleep(0.1)
            joy.publish(Joy(axes=[0.0] * 6, buttons=[0] * 8))
            if button == 2:
                wait_for("move_group/display_planned_path", DisplayTrajectory, lambda m: abs(
                    m.trajectory[0].joint_trajectory.points[0].positions[1]
                    - m.trajectory[0].joint_trajectory.points[-1].positions[1]) > 0.01)
                rospy.sleep(1.0)  # until the marker has the answer
        while abs(self.arm.get_current_pose().pose.position.z - down) > 5e-3:
            self.assertLess(rospy.get_time(), end, "the robot does not go where the joystick put the goal")
            rospy.sleep(0.05)

    def test_objects_are_shown(self):
        pose = PoseStamped()
        pose.header.frame_id, pose.pose.position.x, pose.pose.orientation.w = "world", 2.0, 1.0
        self.scene.add_box("box", pose, (0.1, 0.2, 0.3))
        shown = wait_for("goal_marker/scene", MarkerArray, lambda m: any(marker.ns == "box" for marker in m.markers))
        box, = [marker for marker in shown.markers if marker.ns == "box"]
        self.assertEqual((box.scale.y, box.pose.position.x), (0.2, 2.0))


if __name__ == "__main__":
    rospy.init_node("goal_marker_rostest")
    rostest.rosrun("moveit_ros_visualization", "goal_marker_test", Marker)
