#!/usr/bin/env python3
"""Every plugin but the cameras against what the physics must give. Time passes only through the step service.

With ~after_reset all of it is tested on plugins that have run for a while and were then reset with the simulation."""

import math

import numpy as np
import rospy
import rostest
import tf2_ros
from gazebo_msgs.msg import ContactsState, ModelState, ODEJointProperties
from gazebo_msgs.srv import SetJointProperties
from gazebo_ros_link_attacher.srv import Attach
from geometry_msgs.msg import Point, Pose, Quaternion, TransformStamped, Twist, Vector3, Vector3Stamped, Wrench, WrenchStamped
from listening import Ear, Mouth, until
from models import box, elements, joint, link, plugin, sdf
from nav_msgs.msg import Odometry
from plugin_world import G, PluginWorld, xyz, yaw_of
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Imu, MagneticField, NavSatFix
from std_msgs.msg import Bool, Float32
from std_srvs.srv import Empty


class Plugins(PluginWorld):
    # ---------------------------------------------------------------------------------------------------- motion

    def turning_and_standing(self):
        """A link without weight that turns with 2 rad/s about z, its sensor 0.5 m off; and one that stands on the floor."""
        body = {"bodyName": "l"}
        sensor = f"""<sensor name="imu" type="imu"><pose>0.5 0 0 0 0 0</pose><update_rate>100</update_rate>
            {plugin("gazebo_ros_imu_sensor", topicName="imu", frameName="imu_link", robotNamespace="/{0}", updateRateHZ=100)}
            </sensor><sensor name="slow" type="imu"><update_rate>50</update_rate>{
            plugin("gazebo_ros_imu_sensor", topicName="slow_imu", frameName="l", robotNamespace="/{0}", rpyOffset="0 0 0.5")
        }</sensor>"""
        plugins = (
            plugin("gazebo_ros_p3d", topicName="truth", frameName="map", robotNamespace="/{0}", updateRate=50, **body)
            + plugin("gazebo_ros_imu", topicName="bare_imu", serviceName="{0}/calibrate", robotNamespace="/{0}", **body)
            + plugin("hector_gazebo_ros_imu", topicName="hector_imu", robotNamespace="/{0}", **body)
            + plugin(
                "hector_gazebo_ros_gps",
                robotNamespace="/{0}",
                updateRate=10,
                referenceLatitude=30,
                referenceLongitude=120,
                referenceAltitude=5,
                **body,
            )
            + plugin("hector_gazebo_ros_magnetic", robotNamespace="/{0}", useMagneticFieldMsgs="true", inclination=60, **body)
        )
        for name, gravity, x in (("turning", False, 10.0), ("standing", True, 12.0)):
            text = sdf(link("l", mass=2, gravity=gravity, shape=box(0.2, 0.2, 0.2), extra=sensor), plugins)
            self.spawn(name, text.replace("{0}", name), x, 0.0, 0.1 if gravity else 1.0)
            self.addCleanup(self._delete_model, name)
        spin = ModelState("turning", Pose(Point(10, 0, 1), Quaternion(0, 0, 0, 1)), Twist(Vector3(1, 0, 0), Vector3(0, 0, 2)), "")
        self.step(0.5)
        self._set_model_state(spin)

    def test_imu_sensor(self):
        self.turning_and_standing()
        self.measure("/turning/imu", Imu, 0.1, 10)
        imu = self.measure("/turning/imu", Imu, 0.1, 10)
        np.testing.assert_allclose(xyz(imu.angular_velocity), (0, 0, 2), atol=1e-3)
        np.testing.assert_allclose(xyz(imu.linear_acceleration), (-2, 0, G), atol=0.02)  # towards the middle: w^2 r
        self.assertAlmostEqual(yaw_of(imu), yaw_of(self.pose("turning")), delta=0.021)
        rest = self.measure("/standing/imu", Imu, 0.1, 10)
        np.testing.assert_allclose(xyz(rest.linear_acceleration), (0, 0, G), atol=0.02)
        self.assertEqual(rest.header.frame_id, "imu_link")

    def test_imu_sensor_at_a_rate_and_an_angle_of_its_own(self):
        self.turning_and_standing()
        slow = self.measure("/standing/slow_imu", Imu, 2.0, 2)  # 1 Hz unless <updateRateHZ> says otherwise
        self.assertAlmostEqual(yaw_of(slow), 0.5, places=3)

    def test_an_imu_sensor_whose_rates_do_not_fit_is_told(self):
        imu = f"""<sensor name="imu" type="imu"><update_rate>30</update_rate>
            {plugin("gazebo_ros_imu_sensor", topicName="odd_imu", frameName="l", robotNamespace="/", updateRateHZ=30)}</sensor>"""
        with Ear("/rosout", Log) as log:
            self.spawn("odd_rates", sdf(link("l", extra=imu)), 16, 0, 1)
            until(
                lambda: any("gives 20 messages a second of simulated time, not the 30" in m.msg for m in log.messages), "line about rates"
            )
        self.addCleanup(self._delete_model, "odd_rates")
        with Ear("/odd_imu", Imu) as ear:
            for wanted in range(1, 21):
                self.step(0.05)
                until(lambda: len(ear.messages) >= wanted, "a message")  # noqa: B023
            self.assertEqual(len(ear.messages), 20)

    def test_imu_of_a_model(self):
        self.turning_and_standing()
        bare = self.measure("/turning/bare_imu", Imu, 0.01, 0)
        np.testing.assert_allclose(xyz(bare.angular_velocity), (0, 0, 2), atol=1e-6)
        np.testing.assert_allclose(xyz(self.measure("/standing/bare_imu", Imu, 0.01, 0).linear_acceleration), 0, atol=0.02)

    def test_p3d(self):
        self.turning_and_standing()
        truth = self.measure("/turning/truth", Odometry, 0.2, 10)
        self.assertEqual((truth.header.frame_id, truth.child_frame_id), ("map", "l"))
        np.testing.assert_allclose(xyz(truth.twist.twist.linear), (1, 0, 0), atol=1e-6)  # world axes
        np.testing.assert_allclose(xyz(truth.twist.twist.angular), (0, 0, 2), atol=1e-6)

    def test_hectors_imu_and_magnetometer(self):
        self.turning_and_standing()
        hector = self.measure("/standing/hector_imu", Imu, 0.01, 0)
        np.testing.assert_allclose(xyz(hector.linear_acceleration), (0, 0, G), atol=0.02)
        field = self.measure("/standing/magnetic", MagneticField, 0.01, 0)
        np.testing.assert_allclose(xyz(field.magnetic_field), (0.5, 0, -math.sin(math.pi / 3)), atol=1e-4)

    def test_hectors_gps(self):
        self.turning_and_standing()
        fix = self.measure("/standing/fix", NavSatFix, 0.2, 0)
        # reference heading 0: x is north, y west. A degree of latitude there is 110.85 km
        self.assertAlmostEqual((fix.latitude - 30) * 110852, 12.0, delta=0.02)
        self.assertAlmostEqual(fix.longitude, 120.0, places=7)
        self.assertAlmostEqual(fix.altitude, 5.1, places=3)
        velocity = self.measure("/turning/fix_velocity", Vector3Stamped, 0.3, 0)
        np.testing.assert_allclose(xyz(velocity.vector), (1, 0, 0), atol=1e-6)

    def merged(self, name, plugins, x):
        """A base that turns with 2 rad/s about z, yawed by 90 degrees, and on it, behind a fixed joint, a pod 1 m ahead and 0.5 m up
        that is yawed by 90 degrees more."""
        inertial = '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
        self.spawn(
            name,
            f"""<robot name="r"><link name="base">{inertial}</link><link name="pod"/>
            <joint name="j" type="fixed"><parent link="base"/><child link="pod"/><origin xyz="1 0 0.5" rpy="0 0 1.5707963"/></joint>
            <gazebo reference="base"><turnGravityOff>true</turnGravityOff></gazebo><gazebo>{plugins}</gazebo></robot>""",
            x,
            10,
            1,
        )
        self.addCleanup(self._delete_model, name)
        turned = Quaternion(0, 0, math.sqrt(0.5), math.sqrt(0.5))
        self._set_model_state(ModelState(name, Pose(Point(x, 10, 1), turned), Twist(Vector3(), Vector3(0, 0, 2)), ""))

    def test_truth_of_a_link_behind_a_fixed_joint(self):
        """Where that link is: the offset of the merge turns with the robot, that of the file does not."""
        told = {"": "xyzOffset", "rel": "frameName"}
        plugins = "".join(
            plugin(
                "gazebo_ros_p3d",
                robotNamespace="/podded",
                topicName=f"truth{end}",
                bodyName="base" if end else "pod",
                **{tag: "pod" if end else "100 0 0"},
            )
            for end, tag in told.items()
        )
        self.merged("podded", plugins, 30)
        truth = self.measure("/podded/truth", Odometry, 0.001, 0)
        np.testing.assert_allclose(xyz(truth.pose.pose.position), (130, 11, 1.5), atol=0.01)
        self.assertAlmostEqual(abs(yaw_of(truth.pose.pose)), math.pi, delta=0.01)
        np.testing.assert_allclose(xyz(truth.twist.twist.linear), (-2, 0, 0), atol=0.02)
        relative = self.measure("/podded/truthrel", Odometry, 0.001, 0).pose.pose
        np.testing.assert_allclose(xyz(relative.position), (0, 1, -0.5), atol=1e-6)  # behind it is to the left of what looks to the left
        self.assertAlmostEqual(yaw_of(relative), -math.pi / 2, delta=1e-6)

    def test_imus_behind_a_fixed_joint(self):
        """The pod is drawn towards the middle by w^2 r, which is to its left."""
        plugins = plugin("gazebo_ros_imu", robotNamespace="/swung", topicName="imu", bodyName="pod")
        plugins += plugin("hector_gazebo_ros_imu", robotNamespace="/swung", topicName="hector", bodyName="pod")
        plugins += plugin("hector_gazebo_ros_magnetic", robotNamespace="/swung", bodyName="pod", inclination=0)
        plugins += plugin("hector_gazebo_ros_gps", robotNamespace="/swung", bodyName="pod", updateRate=500, referenceAltitude=5)
        self.merged("swung", plugins, 40)
        for topic, weight in (("imu", 0.0), ("hector", G)):
            imu = self.measure(f"/swung/{topic}", Imu, 0.01, 0)
            np.testing.assert_allclose(xyz(imu.linear_acceleration), (0, 4, weight), atol=0.05, err_msg=topic)
            np.testing.assert_allclose(xyz(imu.angular_velocity), (0, 0, 2), atol=1e-3)
        self.assertAlmostEqual(abs(yaw_of(imu)), math.pi, delta=0.06)
        np.testing.assert_allclose(xyz(self.measure("/swung/magnetic", Vector3Stamped, 0.001, 0).vector), (-1, 0, 0), atol=0.07)
        self.assertAlmostEqual(self.measure("/swung/fix", NavSatFix, 0.01, 0).altitude, 6.5, delta=1e-6)
        velocity = self.measure("/swung/fix_velocity", Vector3Stamped, 0.01, 0)
        self.assertAlmostEqual(velocity.vector.x, -2, delta=0.02)

    # ---------------------------------------------------------------------------------------------------- forces

    def contact(self, library):
        sensor = f"""<sensor name="feeler" type="contact"><update_rate>50</update_rate><contact><collision>c</collision></contact>
            {plugin(library, bumperTopicName="touch", frameName="world")}</sensor>"""
        self.spawn("load", sdf(link("l", mass=2, shape=box(0.2, 0.2, 0.2), extra=sensor)), 20, 0, 0.1)
        self.addCleanup(self._delete_model, "load")
        self.step(1.0)
        message = self.measure("/touch", ContactsState, 0.1, 5)
        self.assertEqual(len(message.states), 20)  # one pair in each step since the last message
        # As Gazebo 11.1 gives it of such a box: the box first, on each corner a quarter of its weight, about its middle.
        for index, state in enumerate(message.states):
            self.assertEqual((state.collision1_name, state.collision2_name), ("load::l::c", "floor::link::c"))
            self.assertRegex(
                state.info,
                rf"^Debug:  i:\({index}/20\)     my geom:load::l::c   other geom:floor::link::c         "
                r"time:\d+\.\d{9}\n$",
            )
        times = [float(state.info.rpartition(":")[2]) for state in message.states]
        self.assertAlmostEqual(times[-1], message.header.stamp.to_sec() - 0.001, places=6)  # as in the record: those before it
        np.testing.assert_allclose(np.diff(times), 0.001, atol=1e-9)
        np.testing.assert_allclose(xyz(state.total_wrench.force), (0, 0, 2 * G), atol=0.05)
        np.testing.assert_allclose(xyz(state.total_wrench.torque), 0, atol=0.02)
        for wrench, point, normal in zip(state.wrenches, state.contact_positions, state.contact_normals):
            np.testing.assert_allclose(xyz(wrench.force), (0, 0, 2 * G / 4), atol=0.1)
            np.testing.assert_allclose(xyz(wrench.torque), np.cross(xyz(point) - (20, 0, 0.1), xyz(wrench.force)), atol=1e-3)
            np.testing.assert_allclose(xyz(normal), (0, 0, 1), atol=1e-6)
        self.assertTrue(all(abs(p.z) < 1e-3 for p in state.contact_positions))

    def feeling(self, at, size, mass=1.0, static=False, name="feels"):
        """Feels with all of itself on the topic of its name; spawned with its lower side at the height ``at[1]``."""
        sensor = f"""<sensor name="s" type="contact"><update_rate>50</update_rate><contact><collision>c</collision></contact>
            {plugin("gazebo_ros_bumper", bumperTopicName=name, frameName="world")}</sensor>"""
        self.spawn(
            name, sdf(link("l", mass=mass, inertia=0.1, shape=box(*size), extra=sensor), static=static), at[0], 0, at[1] + size[2] / 2
        )
        self.addCleanup(self._delete_model, name)

    def first_of(self, topic, *pair):
        """The two names in the order in which they are told, and the vertical force that is told with them."""
        self.step(1.0)
        states = self.measure("/" + topic, ContactsState, 0.1, 5).states
        found = {
            ((s.collision1_name, s.collision2_name), round(s.total_wrench.force.z, 1))
            for s in states
            if {s.collision1_name, s.collision2_name} == {f"{name}::l::c" for name in pair}
        }
        self.assertEqual(len(found), 1, found)
        return found.pop()

    def test_the_smaller_of_two_is_told_first_whoever_feels(self):
        self.feeling((30, 0.0), (1.5, 1.5, 0.4), mass=20, name="table")
        self.feeling((30, 0.4), (0.2, 0.2, 0.2), name="cup")
        for topic in ("table", "cup"):
            self.assertEqual(self.first_of(topic, "table", "cup"), (("cup::l::c", "table::l::c"), 9.8))

    def test_of_equals_what_stands_still_is_told_first(self):
        self.feeling((34, 0.5), (0.3, 0.3, 0.2), static=True, name="shelf")
        self.feeling((34, 0.7), (0.3, 0.3, 0.3), name="book")
        self.assertEqual(self.first_of("book", "shelf", "book"), (("shelf::l::c", "book::l::c"), -9.8))

    def test_of_equals_that_move_the_newest_is_told_first(self):
        self.feeling((38, 0.0), (0.4, 0.4, 0.3), mass=4, name="old")
        self.feeling((38, 0.3), (0.3, 0.3, 0.3), name="new")
        self.assertEqual(self.first_of("old", "old", "new"), (("new::l::c", "old::l::c"), 9.8))

    def test_bumper(self):
        self.contact("gazebo_ros_bumper")
        self._set_model_state(ModelState("load", Pose(Point(20, 0, 5), Quaternion(0, 0, 0, 1)), Twist(), ""))
        self.step(0.05)
        self.assertEqual(self.measure("/touch", ContactsState, 0.1, 5).states, [])

    def test_contact_sensor(self):
        self.contact("gazebo_ros_contact")

    def test_force_torque_sensor(self):
        """Of a weight that hangs on a fixed joint Gazebo 11.1 tells -29.4 N: what the child bears on its parent."""
        hang = joint("bolt", "fixed", "world", "post") + joint(
            "scale", "fixed", "post", "weight", extra="<physics><provide_feedback>true</provide_feedback></physics>"
        )
        self.spawn(
            "scales",
            sdf(
                link("post", (0, 0, 1)),
                link("weight", (0.3, 0, 0.8), mass=3),
                hang,
                plugin("gazebo_ros_ft_sensor", jointName="scale", topicName="ft", updateRate=100),
            ),
            22,
            0,
        )
        self.step(1.0)
        wrench = self.measure("/ft", WrenchStamped, 0.1, 10)
        self.assertEqual(wrench.header.frame_id, "weight")
        np.testing.assert_allclose(xyz(wrench.wrench.force), (0, 0, -3 * G), atol=0.05)
        np.testing.assert_allclose(xyz(wrench.wrench.torque), 0, atol=0.05)  # about the joint, which is the weight's origin

    def test_force_torque_sensor_of_a_revolute_joint(self):
        """2 kg on a wrist that is rolled by 0.4 rad; the same bench in Gazebo 11.1, mean over 6 s of a ripple of 0.06 N."""
        self.spawn(
            "bench",
            f"""<robot name="bench"><link name="world"/><link name="base"><inertial><mass value="5"/>
            <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <joint name="fix" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 0.5"/></joint>
            <joint name="wrist" type="revolute"><parent link="base"/><child link="weight"/><origin xyz="0 -0.5 1" rpy="0.4 0 0"/>
            <axis xyz="0 0 1"/><limit lower="0" upper="0" effort="100" velocity="1"/></joint>
            <link name="weight"><inertial><origin xyz="0.1 0 0.05"/><mass value="2"/>
            <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <gazebo reference="wrist"><provideFeedback>true</provideFeedback></gazebo><gazebo>
            {plugin("gazebo_ros_ft_sensor", jointName="wrist", topicName="wrist_ft", updateRate=50)}</gazebo></robot>""",
            42,
            0,
        )
        self.addCleanup(self._delete_model, "bench")
        self.step(1.0)
        wrench = self.measure("/wrist_ft", WrenchStamped, 0.1, 5).wrench
        np.testing.assert_allclose(xyz(wrench.force), (0.0, -7.632, -18.053), atol=0.03)
        np.testing.assert_allclose(xyz(wrench.torque), (0.3816, 1.8053, -0.7632), atol=0.01)

    def test_force_in_and_force_felt(self):
        self.spawn(
            "pushed",
            sdf(
                link("l", gravity=False),
                plugin("gazebo_ros_force", bodyName="l", topicName="push") + plugin("gazebo_ros_f3d", bodyName="l", topicName="felt"),
            ),
            24,
            0,
            1,
        )
        push = Mouth("/push", Wrench)
        push.say(Vector3(0, 2, 0), Vector3(0, 0, 0))
        speed = lambda: self._get_model_state("pushed", "").twist.linear.y  # noqa: E731
        self.until_stepped(lambda: speed() > 0, "effect of /push")
        before = speed()
        felt = self.measure("/felt", WrenchStamped, 0.5, 0)
        self.assertAlmostEqual(speed() - before, 1.0, places=3)
        np.testing.assert_allclose(xyz(felt.wrench.force), (0, 2, 0))

    def test_bumper_of_a_link_behind_a_fixed_joint(self):
        """The links are merged; what the student wrote is felt, and a wrong name is told."""
        shape = '<collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision>'
        inertial = '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
        with Ear("/rosout", Log) as log:
            self.spawn(
                "rover",
                f"""<robot name="r"><link name="base">{inertial}{shape}</link><link name="pad">{shape}</link>
                <joint name="j" type="fixed"><parent link="base"/><child link="pad"/><origin xyz="0 0 -0.1"/></joint>
                <gazebo reference="pad"><sensor name="feel" type="contact"><update_rate>50</update_rate><contact>
                <collision>pad_collision</collision><collision>paw_collision</collision></contact>
                {plugin("gazebo_ros_bumper", bumperTopicName="pad")}</sensor></gazebo></robot>""",
                26,
                0,
                0.15,
            )
            until(lambda: any("'paw_collision', which does not exist" in m.msg for m in log.messages), "line about the paw")
        self.step(0.5)
        state = self.measure("/pad", ContactsState, 0.1, 5).states[-1]
        names = {state.collision1_name, state.collision2_name}
        self.assertEqual(names, {"rover::base::base_fixed_joint_lump__pad_collision_1", "floor::link::c"})

    # ---------------------------------------------------------------------------------------------------- holding

    def test_holding(self):
        self.spawn(
            "sucker",
            sdf(
                link("cup", mass=5, gravity=False),
                plugin("gazebo_ros_vacuum_gripper", bodyName="cup", topicName="grasping", robotNamespace="/sucker"),
            ),
            30,
            0,
            1,
        )
        self.spawn("sucked", sdf(link("l", mass=0.1, inertia=0.001)), 30, 0, 0.98)
        self.spawn(
            "hanging",
            sdf(
                link("l", mass=20),
                plugin("gazebo_ros_harness", robotNamespace="/").replace(
                    "</plugin>",
                    f"""{joint("rope", "prismatic", "world", "l", lower=-0.3, upper=1)}
            <winch><joint>rope</joint></winch><detach>rope</detach></plugin>""",
                ),
            ),
            32,
            0,
            2,
        )
        for name, x in (("one", 34.0), ("two", 34.5)):
            self.spawn(name, sdf(link("l", gravity=name == "two", mass=10 if name == "one" else 0.1)), x, 0, 1)
        on, off = (rospy.ServiceProxy("/sucker/" + name, Empty) for name in ("on", "off"))
        on()
        attach, detach = (rospy.ServiceProxy("/link_attacher_node/" + name, Attach) for name in ("attach", "detach"))
        self.assertFalse(attach("one", "nothing", "two", "l").ok)
        self.assertTrue(attach("one", "l", "two", "l").ok)
        self.assertTrue(self.measure("/sucker/grasping", Bool, 0.5, 0).data)
        self.assertAlmostEqual(self.pose("sucked").position.z, self.pose("sucker").position.z, delta=0.011)
        one, two = self.pose("one"), self.pose("two")
        self.assertAlmostEqual(math.dist(xyz(one.position), xyz(two.position)), 0.5, places=3)
        for _ in range(2):  # as often as asked; the other way round they were never attached
            self.assertTrue(detach("one", "l", "two", "l").ok)
        self.assertFalse(detach("two", "l", "one", "l").ok)
        off()
        self.assertAlmostEqual(self.pose("hanging").position.z, 2.0, places=4)
        velocity, release = Mouth("/hanging/harness/velocity", Float32), Mouth("/hanging/harness/detach", Bool)
        velocity.say(-0.5)
        self.until_stepped(lambda: self.pose("hanging").position.z < 1.99, "effect of the winch")
        self.step(1.0)
        self.assertAlmostEqual(self.pose("hanging").position.z, 1.7, places=3)  # the rope's end
        self.assertGreater(two.position.z - self.pose("two").position.z, 0.4)
        self.assertLess(self.pose("sucked").position.z, 0.6)
        release.say(True)
        self.until_stepped(lambda: self.pose("hanging").position.z < 1.6, "fall after detach")
        self.assertTrue(attach("one", "l", "two", "l").ok)
        self._delete_model("two")
        self.assertTrue(detach("one", "l", "two", "l").ok)
        self.assertFalse(attach("one", "l", "two", "l").ok)

    def test_a_harness_without_a_name_of_its_joint(self):
        """The first joint is meant, as Gazebo has it: what hangs is not dropped."""
        rope = joint("rope", "prismatic", "world", "l", lower=-0.3, upper=1)
        cases = ("unsaid", ""), ("misnamed", "<winch><joint>rop</joint></winch>")
        for i, (name, said) in enumerate(cases):
            harness = plugin("gazebo_ros_harness").replace("</plugin>", f"{rope}{said}</plugin>")
            self.spawn(name, sdf(link("l"), harness), 36 + 2 * i, 0, 2)
            self.addCleanup(self._delete_model, name)
        self.step(1.0)
        for name, _ in cases:
            self.assertAlmostEqual(self.pose(name).position.z, 2.0, places=4)

    def test_grasp_fix(self):
        """Two fingers close on a box too slippery to be held by friction; the hand rises with it, opens, and it falls."""
        fingers = "".join(
            link(name, (0, y, 0.1), mass=0.2, shape=box(0.04, 0.02, 0.1), mu=0.01)
            + joint(name, "prismatic", "palm", name, (0, -math.copysign(1, y), 0), 0, 0.08)
            for name, y in (("left", 0.1), ("right", -0.1))
        )
        fix = plugin(
            "gazebo_grasp_fix",
            forces_angle_tolerance=100,
            update_rate=20,
            grip_count_threshold=3,
            max_grip_count=8,
            release_tolerance=0.005,
            arm=elements(arm_name="hand", palm_link="palm", gripper_link="left") + "",
        ).replace("</arm>", "<gripper_link>right</gripper_link></arm>")
        trajectory = plugin("gazebo_ros_joint_trajectory", topicName="hand_motion")
        self.spawn(
            "hand",
            sdf(link("palm", (0, 0, 0.25)), joint("lift", "prismatic", "world", "palm", lower=0, upper=1), fingers, fix, trajectory),
            40,
            0,
        )
        self.spawn("slippery", sdf(link("l", mass=0.3, inertia=0.0002, shape=box(0.04, 0.06, 0.12), mu=0.01)), 40, 0, 0.06)
        motor = rospy.ServiceProxy("/gazebo/set_joint_properties", SetJointProperties)

        def drive(name, speed, force):
            self.assertTrue(motor(f"hand::{name}", ODEJointProperties(vel=[speed], fmax=[force])).success)

        drive("lift", 0.0, 200.0)
        for name in ("left", "right"):
            drive(name, 0.2, 10.0)
        self.step(1.5)
        drive("lift", 0.2, 200.0)
        self.step(1.0)
        self.assertAlmostEqual(self.pose("slippery").position.z, 0.06 + 0.2, delta=0.01)
        drive("lift", 0.0, 200.0)
        for name in ("left", "right"):
            drive(name, -0.2, 10.0)
        self.step(1.0)
        self.assertLess(self.pose("slippery").position.z, 0.1)

    def test_hand_of_god(self):
        self.spawn("guided", sdf(link("l", mass=2), plugin("gazebo_ros_hand_of_god", linkName="l", frameId="hog")), 50, 0, 1)
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = "world", "hog_desired"
        transform.transform.translation, transform.transform.rotation = Vector3(50.2, 0.1, 1.5), Quaternion(0, 0, 1, 0)
        broadcaster = tf2_ros.StaticTransformBroadcaster()
        broadcaster.sendTransform(transform)
        self.until_stepped(lambda: self.pose("guided").position.x > 50.001, "pull")
        self.step(2.0)
        pose = self.pose("guided")
        np.testing.assert_allclose(xyz(pose.position), (50.2, 0.1, 1.5), atol=1e-3)
        self.assertAlmostEqual(abs(pose.orientation.z), 1.0, places=3)

    def test_unknown_and_unseen_ones(self):
        ear = Ear("/rosout", Log)
        self.spawn(
            "odd",
            sdf(
                link("l"),
                plugin("gazebo_ros_projector"),
                plugin("gazebo_ros_power_monitor"),
                plugin("gazebo_ros_p3d", bodyName="nothing", topicName="t"),
            ),
            120,
            0,
        )

        def said(text):
            return [log for log in ear.messages if text in log.msg]

        until(lambda: said("<bodyName> names the link 'nothing'"), "error about a wrong link")
        self.assertEqual([log.level for log in said("power_monitor")], [Log.WARN])
        self.assertEqual([log.level for log in said("projector of model")], [Log.INFO])


if __name__ == "__main__":
    rospy.init_node("plugins_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "plugins", Plugins)
