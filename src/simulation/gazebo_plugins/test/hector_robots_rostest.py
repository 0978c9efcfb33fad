#!/usr/bin/env python3
"""What hector_gazebo_plugins moves: many wheels, servos; and its word of a reset. Expected values are physics on paper. Time passes only
through the step service.

With ~after_reset all of it is tested on plugins that have run for a while and were then reset with the simulation."""

import math

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import Quaternion, QuaternionStamped, TransformStamped, Twist, Vector3
from listening import Ear, Mouth, until
from models import box, joint, link, plugin, sdf, wheel
from nav_msgs.msg import Odometry
from plugin_world import PluginWorld, yaw_of
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState
from std_msgs.msg import Header, String


def rover(*places):
    """A flat box on wheels of 0.1 m, slippery so that it turns as the wheels say: (name, x, y)."""
    parts = [link("base_link", (0, 0, 0.15), mass=10, inertia=0.3, shape=box(0.5, 0.3, 0.05))]
    for name, x, y in places:
        parts += [wheel(name, (x, y, 0.1)), joint(name, "revolute", "base_link", name, (0, 1, 0))]
    return "".join(parts)


class HectorRobots(PluginWorld):
    def placed(self, name, text, *at):
        self.spawn(name, text, *at)
        self.addCleanup(self._delete_model, name)

    def driven(self, name, forwards, turn):
        """Where it is before and after a second at the commanded speed."""
        Mouth(f"/{name}/cmd_vel", Twist).say(Vector3(forwards, 0, 0), Vector3(0, 0, turn))
        twist = lambda: self._get_model_state(name, "").twist  # noqa: E731
        self.until_stepped(lambda: math.hypot(twist().linear.x, twist().linear.y) + abs(twist().angular.z) > 0.05, f"motion of {name}")
        self.step(0.5)
        first = self.pose(name)
        self.step(1.0)
        return first, self.pose(name)

    # ---------------------------------------------------------------------------------------------------- drives

    def test_many_wheels(self):
        wheels = rover(("lf", 0.15, 0.2), ("lr", -0.15, 0.2), ("rf", 0.15, -0.2), ("rr", -0.15, -0.2))
        tags = dict(leftJoints="lf lr", rightJoints="rf  rr", wheelSeparation=0.4, wheelDiameter=0.2, torque=20)
        library = "diffdrive_plugin_multi_wheel"
        self.placed("many", sdf(wheels, plugin(library, robotNamespace="/many", **tags)), 0, 230)
        first, last = self.driven("many", 0.4, 0.0)
        self.assertAlmostEqual(last.position.x - first.position.x, 0.4, delta=0.005)
        odometry = self.measure("/many/odom", Odometry, 0.1, 0)
        self.assertEqual((odometry.header.frame_id, odometry.child_frame_id), ("odom", "base_footprint"))
        self.assertAlmostEqual(odometry.pose.pose.position.y, 230, delta=0.01)
        self.assertAlmostEqual(odometry.twist.twist.linear.x, 0.4, delta=0.005)
        self.assertEqual((odometry.pose.pose.position.z, odometry.pose.covariance[0], odometry.pose.covariance[35]), (0, 1e-5, 1e-3))
        first, last = self.driven("many", 0.0, 0.8)
        self.assertTrue(0.2 < yaw_of(last) - yaw_of(first) <= 0.8)  # wheels scrub

        with Ear("/rosout", Log) as log:
            self.placed("wrong", sdf(wheels, plugin(library, robotNamespace="/wrong", **{**tags, "leftJoints": "lf lost"})), 0, 233)
            until(lambda: any("<leftJoints> names the joint 'lost'" in m.msg for m in log.messages), "line about the joint")

    def test_six_wheels(self):
        places = [
            (f"{place}_{side}", x, y)
            for place, x in (("front", 0.2), ("mid", 0.0), ("rear", -0.2))
            for side, y in (("l", 0.2), ("r", -0.2))
        ]
        tags = {f"{name.split('_')[0]}{'Left' if name.endswith('l') else 'Right'}Joint": name for name, _, _ in places}
        drive = plugin("diffdrive_plugin_6w", robotNamespace="/six", wheelSeparation=0.4, wheelDiameter=0.2, **tags)
        self.placed("six", sdf(rover(*places), drive), 0, 236)
        first, last = self.driven("six", 0.4, 0.0)
        self.assertAlmostEqual(last.position.x - first.position.x, 0.4, delta=0.005)
        first, last = self.driven("six", 0.0, -0.8)
        self.assertTrue(-0.8 <= yaw_of(last) - yaw_of(first) < -0.15)
        self.assertIn(["/six/odom", "nav_msgs/Odometry"], rospy.get_published_topics("/six"))

    # ---------------------------------------------------------------------------------------------------- servos

    def head(self, name, x, **tags):
        axes = dict(firstServoName="pan", firstServoAxis="0 0 1", secondServoName="tilt", secondServoAxis="0 1 0", **tags)
        parts = [link("base_link", (0, 0, 1), mass=5), joint("bolt", "fixed", "world", "base_link")]
        parts += [link("neck", (0, 0, 1.2)), joint("pan", "revolute", "base_link", "neck", (0, 0, 1))]
        parts += [link("eyes", (0, 0, 1.2)), joint("tilt", "revolute", "neck", "eyes", (0, 1, 0))]
        self.placed(name, sdf(*parts, plugin("hector_servo_plugin", robotNamespace=f"/{name}", **axes)), x, 240)

    def test_servos_look_where_they_are_told(self):
        """At 8 rad/s for each rad that is missing: what is left after 2 s is e^-16 of it. The frame of the command is pitched by 0.1."""
        level = TransformStamped(header=Header(frame_id="base_link"), child_frame_id="base_stabilized")
        level.transform.rotation = Quaternion(0, math.sin(0.05), 0, math.cos(0.05))
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(level)
        self.head("head", 0)
        self.until_stepped(lambda: self.joint("head::tilt") > 0.01, "the stabilised frame")
        self.step(2.0)
        self.assertAlmostEqual(self.joint("head::tilt"), 0.1, delta=1e-3)
        self.assertAlmostEqual(self.joint("head::pan"), 0.0, delta=1e-3)
        mouth = Mouth("/head/drive", QuaternionStamped)
        mouth.say(Header(frame_id="base_link"), Quaternion(0, 0, math.sin(0.25), math.cos(0.25)))
        self.until_stepped(lambda: self.joint("head::pan") > 0.01, "turn of the head")
        self.step(2.0)
        self.assertAlmostEqual(self.joint("head::pan"), 0.5, delta=1e-3)
        self.assertAlmostEqual(self.joint("head::tilt"), 0.0, delta=1e-3)
        state = self.measure("/head/joint_states", JointState, 0.1, 0)
        self.assertEqual(state.name, ["pan", "tilt"])
        self.assertAlmostEqual(state.position[0], 0.5, delta=1e-3)

    def test_servos_have_a_top_speed(self):
        self.head("slow", 3, maxVelocity=0.4, topicName="look", torque=5)
        mouth = Mouth("/slow/look", QuaternionStamped)
        mouth.say(Header(frame_id="base_link"), Quaternion(0, 0, math.sin(0.5), math.cos(0.5)))
        self.until_stepped(lambda: self.joint("slow::pan") > 0.01, "turn of the head")
        before = self.joint("slow::pan")
        self.step(0.5)
        self.assertAlmostEqual(self.joint("slow::pan") - before, 0.2, delta=0.005)

    def test_axes_that_it_does_not_know(self):
        with Ear("/rosout", Log) as log:
            self.head("odd", 6, thirdServoName="tilt", thirdServoAxis="0 0 -1")
            until(lambda: any("axes of its servos are zy?" in m.msg for m in log.messages), "line about the axes")

    # ---------------------------------------------------------------------------------------------------- reset

    def test_a_reset_is_told(self):
        self.placed("tells", sdf(link("l"), plugin("hector_gazebo_reset_plugin")), 0, 245)
        with Ear("/syscommand", String) as ear:
            self.step(0.01)
            self.assertEqual(ear.messages, [])
            self._reset()
            self.assertEqual(ear.wait(1)[0].data, "reset")


if __name__ == "__main__":
    rospy.init_node("hector_robots_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "hector_robots", HectorRobots)
