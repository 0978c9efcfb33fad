#!/usr/bin/env python3
"""Plugins that move joints and robots against what the physics must give, after plugins_rostest.py in the same world. Time passes only
through the step service.

With ~after_reset all of it is tested on plugins that have run for a while and were then reset with the simulation."""

import math

import numpy as np
import rospy
import rostest
from dynamic_reconfigure.client import Client
from gazebo_msgs.srv import SetModelConfiguration
from geometry_msgs.msg import Twist, Vector3, WrenchStamped
from listening import Ear, Mouth, until
from models import box, elements, joint, link, plugin, ray, sdf, wheel
from nav_msgs.msg import Odometry
from plugin_world import PluginWorld, xyz, yaw_of
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Header, String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

#: 2 kg aside; the frames of both links are turned.
WEIGHT = """<link name="base"><pose>0 0 1 0.2 0 0</pose><inertial><mass>5</mass></inertial></link>
<link name="w"><pose>0.3 0.2 1.2 0.4 0 0.3</pose><inertial><pose>0.1 0 0.05 0 0 0</pose><mass>2</mass>
<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial></link>"""


class Moving(PluginWorld):
    # ---------------------------------------------------------------------------------------------------- joints

    def test_joints(self):
        arm = [link("base", (0, 0, 1), mass=5), joint("bolt", "fixed", "world", "base")]
        for name, z in (("leader", 1.0), ("follower", 1.5)):
            arm += [link(name + "_link", (0, 0, z)), joint(name, "revolute", "base", name + "_link", (1, 0, 0), -2, 2)]
        self.spawn(
            "linked",
            sdf(
                *arm,
                plugin("roboticsgroup_gazebo_mimic_joint_plugin", joint="leader", mimicJoint="follower", multiplier=-0.5, offset=0.1),
                plugin("gazebo_ros_joint_pose_trajectory", topicName="points"),
                plugin("gazebo_ros_joint_state_publisher", jointName=" follower, leader ", updateRate=50),
            ),
            60,
            0,
        )

        def trajectory(*points):
            return [JointTrajectoryPoint(positions=[q], time_from_start=rospy.Duration(seconds)) for q, seconds in points]

        mouth = Mouth("/points", JointTrajectory)
        mouth.say(joint_names=["leader"], points=trajectory((0.2, 0.1), (0.4, 0.2), (0.6, 0.3)))
        self.until_stepped(lambda: self.joint("leader") > 0.1, "effect of the trajectory")
        seen = []
        for _ in range(60):
            seen.append(self.joint("leader"))
            self.step(0.01)
        np.testing.assert_allclose(seen[:8], 0.2, atol=1e-3)
        np.testing.assert_allclose(seen[12:28], 0.4, atol=1e-3)  # a point lasts as long as it says, and does not sag
        np.testing.assert_allclose(seen[32:55], 0.6, atol=1e-3)
        state = self.measure("/linked/joint_states", JointState, 0.1, 0)
        self.assertEqual((state.name, len(state.velocity), list(state.effort)), (["follower", "leader"], 2, []))
        self.assertAlmostEqual(state.position[0], 0.1 - 0.5 * state.position[1], places=3)

        floating = [link(name, (0, 0, z), gravity=False) for name, z in (("trunk", 0), ("arm", 1))]
        self.spawn("floating", sdf(*floating, joint("wave", "revolute", "trunk", "arm", (1, 0, 0), -2, 2)), 62, 0, 2)
        header = Header(frame_id="floating::arm")  # that link stays, the rest of its model moves
        mouth.say(header=header, joint_names=["wave"], points=trajectory((1.0, 0.5)))
        self.until_stepped(lambda: self.joint("wave") > 0.5, "motion about the arm")
        np.testing.assert_allclose(xyz(self.link("floating::arm").pose.position), (62, 0, 3), atol=1e-6)
        roll = self.link("floating::trunk").pose.orientation
        self.assertAlmostEqual(2 * math.atan2(roll.x, roll.w), -1.0, places=6)
        with Ear("/rosout", Log) as log:
            mouth.say(header=Header(frame_id="nowhere"), joint_names=["wave"], points=trajectory((0.0, 0.5)))
            until(lambda: any("'nowhere' names no link" in m.msg for m in log.messages), "line about the frame")

    def test_elevator(self):
        self.spawn(
            "lift",
            sdf(
                link("cabin", (0, 0, 0.1), mass=50),
                joint("shaft", "prismatic", "world", "cabin", lower=0, upper=10),
                link("door", (0.5, 0, 0.1), mass=5),
                joint("slide", "prismatic", "cabin", "door", (0, 1, 0), 0, 1),
                plugin("gazebo_ros_elevator", lift_joint="shaft", door_joint="slide", floor_height=1.5, door_wait_time=2),
            ),
            70,
            0,
        )
        floors = Mouth("/elevator", String)
        floors.say("2")
        self.until_stepped(lambda: self.joint("lift::shaft") > 0.01, "start of the cabin")
        floors.say("0")  # not heard before the door has closed again
        self.step(3.5)
        self.assertAlmostEqual(self.joint("lift::shaft"), 3.0, places=3)
        self.assertGreater(self.joint("lift::slide"), 0.3)
        self.step(4.0)
        self.assertAlmostEqual(self.joint("lift::slide"), 0.0, places=3)

    # ---------------------------------------------------------------------------------------------------- drives

    def base(self, **wheels):
        """A flat box on wheels of 0.1 m, each given by its place."""
        parts = [link("base_link", (0, 0, 0.15), mass=10, inertia=0.3, shape=box(0.5, 0.3, 0.05))]
        for name, at in wheels.items():
            parts += [wheel(name, (*at, 0.1)), joint(name + "_joint", "revolute", "base_link", name, (0, 1, 0))]
        return "".join(parts)

    def drive(self, namespace, forwards, turn, odometry, arrived, sideways=0.0):
        """Command, wait until ``arrived(odometry)``; odometry and the model's state 1 s apart."""
        ear = Ear(odometry, Odometry)
        Mouth(namespace + "/cmd_vel", Twist).say(Vector3(forwards, sideways, 0), Vector3(0, 0, turn))
        self.until_stepped(lambda: ear.messages and arrived(ear.messages[-1].twist.twist), "motion of " + namespace)
        first = self._get_model_state(namespace[1:], "")
        self.step(1.0)
        last = self._get_model_state(namespace[1:], "")
        until(lambda: ear.messages[-1].header.stamp >= last.header.stamp - rospy.Duration(0.06), "last odometry")
        ear.close()
        return ear.messages[-1], first.pose, last.pose

    def test_skid_steer(self):
        corners = dict(left_front=(0.15, 0.2), right_front=(0.15, -0.2), left_rear=(-0.15, 0.2), right_rear=(-0.15, -0.2))
        self.spawn(
            "skid",
            sdf(
                self.base(**corners),
                plugin("gazebo_ros_skid_steer_drive", robotNamespace="/skid", wheelSeparation=0.4, wheelDiameter=0.2, torque=20),
            ),
            0,
            80,
        )
        odometry, first, last = self.drive("/skid", 0.5, 0, "/skid/odom", lambda t: abs(t.linear.x - 0.5) < 1e-3)
        self.assertAlmostEqual(last.position.x - first.position.x, 0.5, delta=0.005)
        self.assertAlmostEqual(last.position.y, 80, delta=0.005)
        self.assertAlmostEqual(odometry.pose.pose.position.x, last.position.x, delta=0.01)
        odometry, first, last = self.drive("/skid", 0, 1.0, "/skid/odom", lambda t: t.angular.z > 0.1)
        self.assertTrue(0.2 < yaw_of(last) - yaw_of(first) <= 1.0)  # wheels scrub
        self.assertAlmostEqual(odometry.twist.covariance[0], 1e-4)

    def test_diff_drive_stops_out_of_an_arc(self):
        """Driven ahead, on the spot and on an arc, as the recorded robot of Gazebo 11.1: when the command ends, both wheels first
        jump to where the ramp left them, which is the same speed. It turned by 0.0042 rad (wheels that ramp down from the speeds
        they have: 0.024), and then went straight on."""
        self.spawn(
            "arc",
            sdf(
                self.base(left=(0, 0.19), right=(0, -0.19)).replace(
                    "</link>",
                    f"""<collision name="s"><pose>0 0 -0.1 0 0 0</pose><geometry>{box(0.45, 0.01, 0.1)}</geometry><surface><friction>
            <ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision></link>""",
                    1,
                ),
                plugin(
                    "gazebo_ros_diff_drive",
                    robotNamespace="/arc",
                    leftJoint="left_joint",
                    rightJoint="right_joint",
                    wheelSeparation=0.38,
                    wheelDiameter=0.2,
                    wheelTorque=30,
                    wheelAcceleration=1.8,
                    updateRate=100,
                ),
            ),
            0,
            150,
        )
        self.addCleanup(self._delete_model, "arc")
        self.drive("/arc", 0.3, 0.0, "/arc/odom", lambda t: abs(t.linear.x - 0.3) < 1e-3)
        self.drive("/arc", 0.0, 0.5, "/arc/odom", lambda t: abs(t.angular.z - 0.5) < 1e-2)
        self.drive("/arc", 0.2, 0.3, "/arc/odom", lambda t: abs(t.linear.x - 0.2) < 1e-3 and abs(t.angular.z - 0.3) < 1e-2)
        state = lambda: self._get_model_state("arc", "")  # noqa: E731
        Mouth("/arc/cmd_vel", Twist).say(Twist())
        before = state()
        while True:
            self.step(0.001)
            now = state()
            if abs(now.twist.linear.x**2 + now.twist.linear.y**2 - 0.04) > 1e-3:
                break
            before = now
        self.step(0.045)  # the jump itself makes these wheels slip, for some 0.03 s
        braking = state().twist
        self.assertGreater(math.hypot(braking.linear.x, braking.linear.y), 0.02)
        self.assertAlmostEqual(braking.angular.z, 0.0, delta=0.03)
        self.step(1.0)
        self.assertAlmostEqual(math.remainder(yaw_of(state().pose) - yaw_of(before.pose), 2 * math.pi), 0.0, delta=0.009)

    def test_planar_move(self):
        self.spawn("planar", sdf(self.base(wheel=(0, 0)), plugin("gazebo_ros_planar_move", robotNamespace="/planar")), 0, 90)
        self.step(0.2)
        odometry, first, last = self.drive("/planar", 0.3, 0.0, "/planar/odom", lambda t: abs(t.linear.y + 0.4) < 1e-3, -0.4)
        np.testing.assert_allclose(xyz(last.position) - xyz(first.position), (0.3, -0.4, 0), atol=1e-3)
        self.assertEqual(odometry.pose.pose.position.z, 0.0)
        _, first, last = self.drive("/planar", 0.0, 0.5, "/planar/odom", lambda t: abs(t.angular.z - 0.5) < 1e-3)
        self.assertAlmostEqual(yaw_of(last) - yaw_of(first), 0.5, delta=1e-3)
        np.testing.assert_allclose(xyz(last.position), xyz(first.position), atol=2e-3)
        self.spawn("mute", sdf(self.base(wheel=(0, 0)), plugin("gazebo_ros_planar_move", robotNamespace="/mute", odometryRate=0)), 0, 95)
        self.addCleanup(self._delete_model, "mute")
        with Ear("/mute/odom", Odometry) as ear:
            Mouth("/mute/cmd_vel", Twist).say(Vector3(0.3, 0, 0), Vector3(0, 0, 0))
            self.until_stepped(lambda: self._get_model_state("mute", "").pose.position.x > 0.1, "motion of the one that is mute")
            self.assertEqual(ear.messages, [])

    def test_force_based_move(self):
        """Hector's plugin pushes on with the last command, against friction; Nexus's copy is limited and stops after 0.25 s."""
        body = link("base_footprint", (0, 0, 0.05), mass=10, inertia=0.3, shape=box(0.5, 0.3, 0.1), mu=0.1)
        self.spawn("hauled", sdf(body, plugin("hector_gazebo_ros_force_based_move", robotNamespace="/hauled")), 0, 140)
        odometry, first, last = self.drive("/hauled", 0.3, 0.0, "/hauled/odom", lambda t: t.linear.y < -0.39, -0.4)
        np.testing.assert_allclose(xyz(last.position) - xyz(first.position), (0.3, -0.4, 0), atol=5e-3)
        np.testing.assert_allclose(xyz(odometry.pose.pose.position) + (0, 140, 0), xyz(last.position), atol=0.03)
        self.assertEqual((odometry.pose.covariance[35], odometry.twist.covariance[35]), (0.01, 0.01))  # it does not turn
        odometry, first, last = self.drive("/hauled", 0.0, 0.5, "/hauled/odom", lambda t: t.angular.z > 0.4)
        self.assertEqual((odometry.pose.covariance[35], odometry.twist.covariance[35]), (100.0, 100.0))
        self.assertAlmostEqual(yaw_of(last) - yaw_of(first), 0.5, delta=0.03)

        body = link("base_footprint", (0, 0, 0.05), mass=10, inertia=0.3, shape=box(0.5, 0.3, 0.1), mu=0)
        self.spawn(
            "nexus",
            sdf(body, plugin("nexus_ros_force_based_move", robotNamespace="/nexus", x_velocity_p_gain=1e9, cmdVelTimeOut=0.25)),
            0,
            115,
        )
        odometry, first, last = self.drive("/nexus", 2.0, 0.0, "/nexus/odom", lambda t: t.linear.x > 0.59)
        self.assertEqual((odometry.pose.covariance[35], odometry.twist.covariance[35]), (0.01, 0.01))
        self.assertLess(last.position.x - first.position.x, 0.26 * 0.6)
        self.step(0.5)
        self.assertAlmostEqual(self.pose("nexus").position.x, last.position.x, delta=1e-6)

    def test_tricycle(self):
        parts = sdf(
            self.base(left=(-0.2, 0.25), right=(-0.2, -0.25)),
            link("fork", (0.3, 0, 0.2)),
            joint("front_steering_joint", "revolute", "base_link", "fork"),
            wheel("front", (0.3, 0, 0.1)),
            joint("front_wheel_joint", "revolute", "fork", "front", (0, 1, 0)),
            plugin(
                "gazebo_ros_tricycle_drive",
                robotNamespace="/tricycle",
                encoderWheelLeftJoint="left_joint",
                encoderWheelRightJoint="right_joint",
                actuatedWheelDiameter=0.2,
                encoderWheelDiameter=0.2,
                encoderWheelSeparation=0.5,
                odometrySource="encoder",
                wheelTorque=20,
                publishWheelJointState="true",
            ),
        )
        self.spawn("tricycle", parts, 0, 100)
        steering = 0.4
        odometry, first, last = self.drive("/tricycle", 0.5, steering, "/tricycle/odom", lambda t: t.linear.x > 0.44)
        turned = 0.5 * math.sin(steering) / 0.5  # rim speed across the wheel base
        self.assertAlmostEqual(yaw_of(last) - yaw_of(first), turned, delta=0.03 * turned)
        self.assertAlmostEqual(odometry.twist.twist.angular.z, turned, delta=0.03 * turned)
        state = self.measure("/tricycle/joint_states", JointState, 0.1, 0)
        self.assertAlmostEqual(state.position[state.name.index("front_steering_joint")], steering, delta=0.01)

    def test_tricycle_gathers_speed(self):
        """Its limits are those of the wheel's rate, rad/s^2, as upstream compares them: 4 rad/s after 2 s at 2 rad/s^2."""
        self.spawn(
            "slowly",
            sdf(
                self.base(left=(-0.2, 0.25), right=(-0.2, -0.25)),
                link("fork", (0.3, 0, 0.2)),
                joint("front_steering_joint", "revolute", "base_link", "fork"),
                wheel("front", (0.3, 0, 0.1)),
                joint("front_wheel_joint", "revolute", "fork", "front", (0, 1, 0)),
                plugin(
                    "gazebo_ros_tricycle_drive",
                    robotNamespace="/slowly",
                    encoderWheelLeftJoint="left_joint",
                    encoderWheelRightJoint="right_joint",
                    actuatedWheelDiameter=0.2,
                    encoderWheelDiameter=0.2,
                    encoderWheelSeparation=0.5,
                    wheelTorque=20,
                    wheelAcceleration=2,
                ),
            ),
            0,
            160,
        )
        self.addCleanup(self._delete_model, "slowly")
        Mouth("/slowly/cmd_vel", Twist).say(Vector3(0.4, 0, 0), Vector3(0, 0, 0))
        speed = lambda: self._get_model_state("slowly", "").twist.linear.x  # noqa: E731
        self.until_stepped(lambda: speed() > 0.02, "motion of the tricycle")
        before = speed()
        self.step(1.0)
        self.assertAlmostEqual(speed() - before, 0.2, delta=0.02)

    def test_wheels_without_a_size(self):
        """What a drive divides by is not 0: one line names the element, and the model stands there without the plugin."""
        corners = dict(left_front=(0.15, 0.2), right_front=(0.15, -0.2), left_rear=(-0.15, 0.2), right_rear=(-0.15, -0.2))
        two = self.base(left=(0, 0.25), right=(0, -0.25))
        pair = dict(leftJoint="left_joint", rightJoint="right_joint", odometrySource="encoder")
        three = dict(steeringJoint="left_joint", actuatedWheelJoint="right_joint", encoderWheelLeftJoint="left_joint")
        three.update(encoderWheelRightJoint="right_joint", odometrySource="encoder")
        many = dict(leftJoints="left_joint", rightJoints="right_joint")
        cases = [
            ("gazebo_ros_diff_drive", two, pair, "wheelDiameter"),
            ("gazebo_ros_diff_drive", two, pair, "wheelSeparation"),
            ("gazebo_ros_skid_steer_drive", self.base(**corners), {}, "wheelDiameter"),
            ("gazebo_ros_tricycle_drive", two, three, "actuatedWheelDiameter"),
            ("gazebo_ros_tricycle_drive", two, three, "encoderWheelDiameter"),
            ("gazebo_ros_tricycle_drive", two, three, "encoderWheelSeparation"),
            ("diffdrive_plugin_multi_wheel", two, many, "wheelDiameter"),
        ]
        for i, (library, base, tags, tag) in enumerate(cases):
            with self.subTest(library=library, tag=tag), Ear("/rosout", Log) as log:
                name = f"sizeless_{i}"
                self.spawn(name, sdf(base, plugin(library, robotNamespace=f"/{name}", **{**tags, tag: 0})), 0, 300 + 2 * i)
                self.addCleanup(self._delete_model, name)
                line = f"<{tag}> is 0 m"
                until(lambda log=log, line=line: any(line in m.msg for m in log.messages), line)
                self.assertTrue(self._get_model_state(name, "").success)

    def test_values_that_mean_nothing(self):
        """One line each says whose they are; what else the model has works."""
        eye = ray("eye", plugin("gazebo_ros_laser", topicName="odd_scan", frameName="eye"), samples="many")
        imu = f"""<sensor name="gyro" type="imu"><imu><angular_velocity><x><noise type="gaussian"><mean>some</mean></noise></x>
            </angular_velocity></imu>{plugin("gazebo_ros_imu_sensor", topicName="odd_imu", frameName="l")}</sensor>"""
        parts = link("l", extra=eye + imu) + plugin("gazebo_ros_hand_of_god", linkName="l", kl=-1)
        lines = (
            "sensor odd::l::eye: <samples>",
            "sensor odd::l::gyro: <mean>",
            "<kl> (N/m) and <ka> (N m/rad) have to be 0 or more",
            "'/p q' is no name in ROS",
        )
        with Ear("/rosout", Log) as log:
            self.spawn("odd", sdf(parts, plugin("gazebo_ros_p3d", bodyName="l", topicName="p q")), 0, 330)
            self.addCleanup(self._delete_model, "odd")
            for line in lines:
                until(lambda line=line: any(line in m.msg for m in log.messages), line)
        self.assertEqual(len(self.measure("/odd_scan", LaserScan, 0.3, 0).ranges), 640)

    def test_encoders_count_what_rolls(self):
        """Wheels that are put at another angle have not rolled there; 0.3 m/s for 1 s is 0.3 m."""
        tags = dict(wheelTorque=20, odometrySource="encoder", updateRate=100)
        wheels = dict(leftJoint="left_joint", rightJoint="right_joint", wheelSeparation=0.5, wheelDiameter=0.2)
        encoders = dict(
            actuatedWheelDiameter=0.2,
            encoderWheelDiameter=0.2,
            encoderWheelSeparation=0.5,
            encoderWheelLeftJoint="left_joint",
            encoderWheelRightJoint="right_joint",
        )
        fork = link("fork", (0.3, 0, 0.2)) + joint("front_steering_joint", "revolute", "base_link", "fork")
        fork += wheel("front", (0.3, 0, 0.1)) + joint("front_wheel_joint", "revolute", "fork", "front", (0, 1, 0))
        turn = rospy.ServiceProxy("/gazebo/set_model_configuration", SetModelConfiguration)
        slide = elements(geometry=box(0.45, 0.01, 0.1), surface="<friction><ode><mu>0</mu><mu2>0</mu2></ode></friction>")
        slide = f'<collision name="s"><pose>0 0 -0.1 0 0 0</pose>{slide}</collision></link>'
        two = self.base(left=(0, 0.25), right=(0, -0.25)).replace("</link>", slide, 1)
        three = self.base(left=(-0.2, 0.25), right=(-0.2, -0.25)) + fork
        for y, kind, base, named in ((170, "diff_drive", two, wheels), (175, "tricycle_drive", three, encoders)):
            name = f"counts_{kind}"
            self.spawn(name, sdf(base, plugin(f"gazebo_ros_{kind}", robotNamespace=f"/{name}", **tags, **named)), 0, y)
            self.addCleanup(self._delete_model, name)
            self.step(0.5)
            before = self.measure(f"/{name}/odom", Odometry, 0.1, 0)
            self.assertTrue(turn(name, "", ["left_joint", "right_joint"], [2.0, 3.0]).success)
            after = self.measure(f"/{name}/odom", Odometry, 0.1, 0)
            place, speed = after.pose.pose.position, after.twist.twist
            self.assertAlmostEqual(place.x, before.pose.pose.position.x, delta=5e-3)
            self.assertAlmostEqual(yaw_of(after.pose.pose), yaw_of(before.pose.pose), delta=5e-3)
            self.assertAlmostEqual(abs(speed.linear.x) + abs(speed.angular.z), 0, delta=0.05)
            odometry, first, last = self.drive(f"/{name}", 0.3, 0, f"/{name}/odom", lambda t: abs(t.linear.x - 0.3) < 1e-3)
            went = last.position.x - first.position.x
            self.assertAlmostEqual(went, 0.3, delta=5e-3)
            self.assertAlmostEqual(odometry.pose.pose.position.x - place.x, last.position.x, delta=0.02)

    def test_wheel_slip(self):
        """On a slope a rolling robot that slips sideways drifts; told not to, it keeps its line. A radius that is left out is that of the
        wheel's cylinder, and a wheel that is not there costs no other."""
        wheels = "".join(
            f'<wheel link_name="{name}">'
            + elements(slip_compliance_lateral=0, slip_compliance_longitudinal=0.5, wheel_normal_force=60, **radius)
            + "</wheel>"
            for name, radius in (("lost", {}), ("left", {}), ("right", dict(wheel_radius=0.1)))
        )
        slip = plugin("gazebo_ros_wheel_slip", robotNamespace="/").replace("</plugin>", wheels + "</plugin>")  # as spawn_model writes it
        drive = plugin(
            "gazebo_ros_diff_drive",
            robotNamespace="/slippy",
            leftJoint="left_joint",
            rightJoint="right_joint",
            wheelSeparation=0.5,
            wheelDiameter=0.2,
            wheelTorque=20,
        )
        self.spawn(
            "slippy",
            sdf(
                self.base(left=(0, 0.25), right=(0, -0.25)).replace(
                    "</link>",
                    f'<collision name="s"><pose>0 0 -0.1 0 0 0</pose><geometry>{box(0.45, 0.01, 0.1)}</geometry><surface><friction><ode>'
                    "<mu>0.3</mu><mu2>0.3</mu2></ode></friction></surface></collision></link>",
                    1,
                ),
                drive,
                slip,
            ),
            0,
            110,
        )
        _, first, last = self.drive("/slippy", 0.5, 0, "/slippy/odom", lambda t: t.linear.x > 0.3)
        slow = last.position.x - first.position.x
        settings = Client("/slippy/wheel_slip", timeout=60)
        settings.update_configuration({"slip_compliance_unitless_longitudinal": 0.0})
        settings.update_configuration({"slip_compliance_unitless_longitudinal": -1.0})  # leaves it as it is
        first = self.pose("slippy")
        self.step(1.0)
        fast = self.pose("slippy").position.x - first.position.x
        self.assertGreater(fast, slow * 1.02)
        self.assertAlmostEqual(fast, 0.5, delta=0.01)

    # ---------------------------------------------------------------------------------------------------- what joints bear

    def scales(self, name, place, sensor, held="fixed", plugins=None):
        """2 kg aside on a joint whose frames are all turned: the bench of the records of Gazebo 11.1.

        :param sensor: what its <force_torque> says
        """
        plugins = plugins or plugin("gazebo_ros_ft_sensor", topicName=f"{name}_ft")
        scale = f"""<pose>0.02 0 0 0 0 0.7</pose><sensor name="s" type="force_torque"><pose>0 0 0 0 0.5 0</pose>
            <update_rate>50</update_rate><force_torque>{sensor}</force_torque>{plugins}</sensor>"""
        self.spawn(
            name, sdf(WEIGHT, joint("hold", "fixed", "world", "base"), joint("j", held, "base", "w", lower=0, upper=0, extra=scale)), *place
        )
        self.addCleanup(self._delete_model, name)
        self.step(0.2)

    def test_force_torque_sensor_in_a_joint(self):
        """What Gazebo 11.1 measured of this bench, in the axes of the child, the parent and the sensor."""
        measured = {
            "child": ((0.0, -7.6326, -18.0528), (0.38163, 1.44422, -0.61061)),
            "parent": ((0.0, -3.8939, -19.2093), (-0.09879, 1.57865, -0.32001)),
            "sensor": ((4.3398, -5.8377, -18.2002), (1.36539, 0.85875, 0.05013)),
        }
        names = {"child": "w", "parent": "base", "sensor": "s"}
        for k, (frame, (force, torque)) in enumerate(measured.items()):
            for sign, direction in ((1, "child_to_parent"), (-1, "parent_to_child")):
                name = f"{frame}_{direction}"
                self.scales(name, (46 + 2 * k, 2 * sign), elements(frame=frame, measure_direction=direction))
                wrench = self.measure(f"/{name}_ft", WrenchStamped, 0.1, 5)
                self.assertEqual(wrench.header.frame_id, names[frame])
                np.testing.assert_allclose(xyz(wrench.wrench.force), sign * np.array(force), atol=2e-3, err_msg=name)
                np.testing.assert_allclose(xyz(wrench.wrench.torque), sign * np.array(torque), atol=2e-3, err_msg=name)

    def test_force_torque_sensor_in_a_revolute_joint(self):
        """Held by its stops, the same weight; in the robot's namespace."""
        self.scales("hinge", (54, 0), "", "revolute", plugin("gazebo_ros_ft_sensor", topicName="ft", robotNamespace="/left"))
        wrench = self.measure("/left/ft", WrenchStamped, 0.1, 5).wrench
        np.testing.assert_allclose(xyz(wrench.force), (0.0, -7.633, -18.053), atol=0.03)

    def test_noise_of_a_force_torque_sensor_in_a_joint(self):
        """Of one axis; 100 values: four sigmas of their mean and of their deviation."""
        noise = '<noise type="gaussian"><mean>5</mean><stddev>0.5</stddev></noise>'
        self.scales("noisy", (56, 0), f"<force><z>{noise}</z></force><torque><x>{noise}</x></torque>")
        ear = Ear("/noisy_ft", WrenchStamped)
        for count in range(1, 101):
            self.step(0.02)
            until(lambda: len(ear.messages) >= count, "a measurement")
        ear.close()
        wrenches = [message.wrench for message in ear.messages]
        z, x = np.array([w.force.z for w in wrenches]), np.array([w.torque.x for w in wrenches])
        for values, mean in ((z, -18.0528 + 5), (x, 0.38163 + 5)):
            self.assertAlmostEqual(values.mean(), mean, delta=4 * 0.5 / 10)
            self.assertAlmostEqual(values.std(), 0.5, delta=4 * 0.5 / math.sqrt(200))
        self.assertLess(np.std([w.force.y for w in wrenches]), 1e-3)


if __name__ == "__main__":
    rospy.init_node("moving_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "moving", Moving)
