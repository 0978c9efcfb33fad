#!/usr/bin/env python3
"""libSimpleTrackedVehiclePlugin.so and libWheelTrackedVehiclePlugin.so, as Gazebo's worlds have them."""

import importlib.util
import math
import os
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist, Vector3
from rosgraph_msgs.msg import Log
from test_support.hearing import heard

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from simulator import Case  # noqa: E402

TRACK = """<link name="{side}_track"><pose>0 {y} 0.05 0 0 0</pose><inertial><mass>5</mass><inertia><ixx>0.01</ixx><iyy>0.1</iyy>
<izz>0.1</izz></inertia></inertial><collision name="c"><geometry><box><size>0.5 0.02 0.1</size></box></geometry></collision></link>
<joint name="{side}" type="fixed"><parent>body</parent><child>{side}_track</child></joint>"""
VEHICLE = (
    """<sdf version="1.6"><model name="tank"><link name="body"><pose>0 0 0.15 0 0 0</pose><inertial><mass>20</mass><inertia>
<ixx>0.2</ixx><iyy>0.4</iyy><izz>0.5</izz></inertia></inertial></link>"""
    + TRACK.format(side="left", y=0.2)
    + TRACK.format(side="right", y=-0.2)
    + """<plugin name="tracks"
filename="/usr/lib/x86_64-linux-gnu/gazebo-11/plugins/libSimpleTrackedVehiclePlugin.so"><body>body</body><left_track>{left}</left_track><right_track>right_track</right_track><tracks_separation>0.4</tracks_separation>
<max_angular_speed>2</max_angular_speed>{more}</plugin>
<plugin name="rider" filename="libgazebo_ros_test_rider.so"/></model></sdf>"""
)
WHEEL = """<link name="{name}"><pose>{x} {y} 0.1 -1.5707963 0 0</pose><inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy>
<izz>0.01</izz></inertia></inertial><collision name="c"><geometry><cylinder><radius>0.1</radius><length>0.05</length></cylinder></geometry>
</collision></link>
<joint name="{name}_joint" type="revolute"><parent>body</parent><child>{name}</child><axis><xyz>0 1 0</xyz><use_parent_model_frame>1
</use_parent_model_frame></axis></joint>"""
WHEELED = (
    VEHICLE[: VEHICLE.index('<link name="left_track"')]
    + "".join(WHEEL.format(name=f"{side}{i}", x=0.25 * i - 0.25, y=y) for side, y in (("left", 0.2), ("right", -0.2)) for i in range(3))
    + """<plugin name="tracks" filename="libWheelTrackedVehiclePlugin.so">{wheels}<tracks_separation>0.4</tracks_separation>
<max_angular_speed>2</max_angular_speed>{more}</plugin><plugin name="rider" filename="libgazebo_ros_test_rider.so"/></model></sdf>"""
)
WHEELS = "".join(f"<{side}_joint>{side}{i}_joint</{side}_joint>" for side in ("left", "right") for i in range(3))


@unittest.skipUnless(importlib.util.find_spec("gazebo_cpp._core"), "this system lacks what Gazebo's headers need")
class TracksTest(Case):
    def setUp(self):
        self.log, self.speeds = [], []
        self.subscribers = [
            rospy.Subscriber("/rosout", Log, lambda m: self.log.append(m.msg)),
            rospy.Subscriber("/tank/tracks", Vector3, self.speeds.append),
        ]
        self.command = rospy.Publisher("/tank/cmd_vel", Twist, queue_size=1)
        self.sim.empty("reset_simulation")

    def tearDown(self):
        self.clear(self.subscribers[1:])
        self.command.unregister()
        for subscriber in self.subscribers:
            subscriber.unregister()

    def spawn(self, left="left_track", more=""):
        self.done(self.sim.spawn("tank", VEHICLE.format(left=left, more=more)))

    def drive(self, linear, angular):
        """The tracks' speeds, and the yaw rate and forward speed after half a second of it."""
        self.wait(lambda: self.command.get_num_connections() and heard(self.subscribers[1:2]))
        self.speeds.clear()
        twist = Twist()
        twist.linear.x, twist.angular.z = linear, angular
        self.command.publish(twist)
        self.wait(lambda: self.speeds)
        self.sim.step(500)
        state = self.sim.model("tank")
        q = state.pose.orientation
        yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
        v = state.twist.linear
        return (self.speeds[-1].x, self.speeds[-1].y), v.x * math.cos(yaw) + v.y * math.sin(yaw), state.twist.angular.z

    def test_drives_straight_and_no_faster_than_it_may(self):
        self.spawn()
        tracks, ahead, turn = self.drive(0.6, 0.0)
        self.assertEqual(tracks, (0.6, 0.6))
        self.assertAlmostEqual(ahead, 0.6, delta=2e-3)
        self.assertAlmostEqual(turn, 0.0, delta=1e-3)
        tracks, ahead, _ = self.drive(-7.0, 0.0)
        self.assertEqual(tracks, (-1.0, -1.0))
        self.assertAlmostEqual(ahead, -1.0, delta=3e-3)

    def test_turns_to_the_right_where_z_is_positive_as_in_gazebo(self):
        self.spawn(more="<steering_efficiency>0.39</steering_efficiency>")
        tracks, _, turn = self.drive(0.0, 0.5)
        self.assertAlmostEqual(tracks[0], 0.5 * 0.2 / 0.39, delta=1e-6)
        self.assertAlmostEqual(tracks[1], -0.5 * 0.2 / 0.39, delta=1e-6)
        self.assertAlmostEqual(turn, -0.5, delta=0.02)  # statics leave 0.39 of what the tracks' speeds make

    def test_coefficients_of_its_own(self):
        self.spawn(more="<track_mu>0.001</track_mu><track_mu2>0.001</track_mu2>")
        _, ahead, _ = self.drive(1.0, 0.0)
        self.assertLess(abs(ahead), 0.02)  # it hardly grips

    def test_stops_with_the_command_and_with_a_reset(self):
        self.spawn()
        self.drive(0.5, 0.2)
        self.sim.empty("reset_simulation")
        self.sim.step(300)
        state = self.sim.model("tank")
        self.assertAlmostEqual(state.pose.position.x, 0.0, delta=1e-3)
        self.assertAlmostEqual(state.twist.linear.x, 0.0, delta=1e-4)

    def wheeled(self, wheels=WHEELS, more=""):
        self.done(self.sim.spawn("tank", WHEELED.format(wheels=wheels, more=more)))

    def test_wheels_roll_at_the_speed_of_their_track(self):
        self.wheeled()
        tracks, ahead, turn = self.drive(0.6, 0.0)
        self.assertEqual(tracks, (0.6, 0.6))
        self.assertAlmostEqual(ahead, 0.6, delta=5e-3)
        self.assertAlmostEqual(turn, 0.0, delta=2e-3)
        self.assertAlmostEqual(self.sim.joint("left1_joint").rate[0], 6.0, delta=0.05)
        self.drive(0.0, 0.5)  # to the right: the left track ahead, by 0.5 * 0.4 / 2 / 0.5 m/s
        self.assertAlmostEqual(self.sim.joint("left1_joint").rate[0], 2.0, delta=0.05)
        self.assertAlmostEqual(self.sim.joint("right1_joint").rate[0], -2.0, delta=0.05)
        self.sim.empty("reset_simulation")
        self.sim.step(300)
        self.assertAlmostEqual(self.sim.joint("left1_joint").rate[0], 0.0, delta=1e-3)

    def test_wheels_have_only_their_torque(self):
        """6 N m at most would be 60 N on 26 kg and what their turning adds, 6 kg."""
        self.wheeled(more="<max_torque>1</max_torque>")
        _, ahead, _ = self.drive(1.0, 0.0)
        self.assertAlmostEqual(ahead, 60.0 / 32.0 * 0.5, delta=0.02)

    def test_a_track_of_one_wheel_is_one_line(self):
        self.wheeled(wheels="<left_joint>left0_joint</left_joint>" + WHEELS[WHEELS.index("<right") :])
        self.wait(lambda: any("<left_joint>: a track needs two wheels at least" in line for line in self.log))

    def test_a_link_that_is_not_there_is_named_with_those_that_are(self):
        self.spawn(left="left_trakc")
        self.wait(lambda: any("has no link 'left_trakc', but body, left_track, right_track" in line for line in self.log))


if __name__ == "__main__":
    rospy.init_node("tracks_rostest")
    rostest.rosrun("gazebo_ros", "tracks", TracksTest)
