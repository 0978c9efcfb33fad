#!/usr/bin/env python3
"""The errors of hector_gazebo_plugins' sensors, and what changes them. Expected values are of the laws on paper: what is measured is the
true value times the scale, plus offset, drift and noise; a level and a compass make the orientation. Time passes only through the step
service."""

import math

import numpy as np
import rospy
import rostest
from dynamic_reconfigure.client import Client
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import GetPhysicsProperties, SetPhysicsProperties
from geographic_msgs.msg import GeoPoint, GeoPose
from geometry_msgs.msg import Point, Pose, Quaternion, Twist, Vector3, Vector3Stamped
from hector_gazebo_plugins.srv import SetBias, SetReferenceGeoPose
from listening import Ear, until
from models import link, plugin, ray, sdf
from plugin_world import G, PluginWorld, xyz
from sensor_msgs.msg import Imu, MagneticField, NavSatFix, Range
from std_srvs.srv import Empty

NORTH = 110852.44, 110607.77  # m in a degree of latitude, at 30 and at 10 degrees of it
EAST_AT_10 = 109639.36  # m in a degree of longitude


def rpy(q):
    """Roll, pitch, yaw of a message's quaternion."""
    roll = math.atan2(2 * (q.w * q.x + q.y * q.z), 1 - 2 * (q.x * q.x + q.y * q.y))
    yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
    return roll, math.asin(2 * (q.w * q.y - q.z * q.x)), yaw


class Hector(PluginWorld):
    def carry(self, name, library, at=(0, 0, 1), **tags):
        """A body without weight that carries one plugin, in the namespace of its name."""
        text = sdf(link("l", gravity=False), plugin(f"hector_gazebo_ros_{library}", robotNamespace=f"/{name}", **tags))
        self.spawn(name, text, *at)
        self.addCleanup(self._delete_model, name)

    def place(self, name, x=0.0, y=0.0, z=1.0, yaw=0.0, linear=(0, 0, 0), turning=0.0):
        pose = Pose(Point(x, y, z), Quaternion(0, 0, math.sin(yaw / 2), math.cos(yaw / 2)))
        self.assertTrue(self._set_model_state(ModelState(name, pose, Twist(Vector3(*linear), Vector3(0, 0, turning)), "")).success)

    def imu(self, name, count=1, topic="imu"):
        """The last ``count`` messages, 10 ms apart: of plugins with an updateRate of 100."""
        ear = Ear(f"/{name}/{topic}", Imu)
        for wanted in range(1, count + 2):  # the first begins to count; the acceleration is known from the second on
            self.step(0.011)
            until(lambda: len(ear.messages) >= wanted, f"message {wanted} of {name}")  # noqa: B023
        ear.close()
        return ear.messages[-count:]

    def reconfigured(self, namespace, **values):
        client = Client(namespace, timeout=60)
        self.addCleanup(client.close)
        return client.update_configuration(values)

    # ---------------------------------------------------------------------------------------------------- errors

    def test_one_noise_for_accelerometer_and_gyroscope(self):
        self.carry("noisy", "imu", gaussianNoise=0.1)
        messages = self.imu("noisy", 200)
        for name, mean in (("linear_acceleration", (0, 0, G)), ("angular_velocity", (0, 0, 0))):
            values = np.array([xyz(getattr(m, name)) for m in messages])
            np.testing.assert_allclose(values.mean(axis=0), mean, atol=5 * 0.1 / math.sqrt(200))
            np.testing.assert_allclose(values.std(axis=0), 0.1, atol=5 * 0.1 / math.sqrt(400))
            np.testing.assert_allclose(np.reshape(getattr(messages[-1], f"{name}_covariance"), (3, 3)), np.diag((0.01,) * 3))
        variance = 0.01 / G**2
        np.testing.assert_allclose(np.reshape(messages[-1].orientation_covariance, (3, 3)), np.diag((variance, variance, 0)))

    def test_bias_of_the_accelerometer_tilts(self):
        """1 m/s^2 forward and 2 to the left: the nose seems up and the left side, by 1/g and 2/g rad; wherever the robot looks."""
        self.carry("tilted", "imu", accelOffset="1 2 0")
        ahead, left = 1 / G, 2 / G
        for yaw in (0.0, 1.2):
            self.place("tilted", yaw=yaw)
            message = self.imu("tilted")[-1]
            np.testing.assert_allclose(xyz(message.linear_acceleration), (1, 2, G), atol=1e-3)
            np.testing.assert_allclose(rpy(message.orientation), (left, -ahead, yaw), atol=0.02)
            bias = self.imu("tilted", topic="imu/bias")[-1]
            np.testing.assert_allclose(xyz(bias.linear_acceleration), (1, 2, 0), atol=1e-9)
            self.assertAlmostEqual(2 * math.acos(bias.orientation.w), math.hypot(ahead, left), delta=2e-3)

    def test_without_gravity_there_is_no_level(self):
        self.carry("floating", "imu", accelOffset="1 0 0", gaussianNoise=0.1)
        physics = rospy.ServiceProxy("/gazebo/get_physics_properties", GetPhysicsProperties)()
        change = rospy.ServiceProxy("/gazebo/set_physics_properties", SetPhysicsProperties)
        gravity = physics.gravity
        self.addCleanup(lambda: change(physics.time_step, physics.max_update_rate, gravity, physics.ode_config))
        change(physics.time_step, physics.max_update_rate, Vector3(), physics.ode_config)
        message = self.imu("floating")[-1]
        self.assertEqual((message.orientation_covariance[0], message.orientation_covariance[4]), (-1.0, -1.0))
        np.testing.assert_allclose(rpy(message.orientation), 0, atol=1e-9)

    def test_heading_has_an_offset_and_no_noise(self):
        self.carry("turned", "imu", yawOffset=0.2, yawGaussianNoise=0.3)
        messages = self.imu("turned", 10)
        np.testing.assert_allclose([rpy(m.orientation) for m in messages], [(0, 0, 0.2)] * 10, atol=1e-9)
        self.assertAlmostEqual(messages[-1].orientation_covariance[8], 0.09)

    def test_heading_drifts(self):
        """By 0.3 rad, within half a second: values over 10 s are as far apart as 20 drawn anew."""
        self.carry("wanders", "imu", yawDrift=0.3, yawDriftFrequency=2)
        yaws = np.array([rpy(m.orientation)[2] for m in self.imu("wanders", 1000)])
        self.assertTrue(0.15 < yaws.std() < 0.6, yaws.std())
        self.assertLess(np.abs(np.diff(yaws)).max(), 0.4)  # 0.3 * sqrt(1 - exp(-0.044)) is 0.06

    def test_scales(self):
        self.carry("scaled", "imu", rateScaleError=2, accelScaleError="1 1 0.5")
        self.place("scaled", turning=1.5)
        message = self.imu("scaled")[-1]
        np.testing.assert_allclose(xyz(message.angular_velocity), (0, 0, 3), atol=1e-6)
        np.testing.assert_allclose(xyz(message.linear_acceleration), (0, 0, G / 2), atol=1e-3)
        self.carry("field", "magnetic", useMagneticFieldMsgs="true", scaleError="2 1 1", offset="0 0 0.1", referenceHeading=0)
        field = self.measure("/field/magnetic", MagneticField, 0.01, 0).magnetic_field
        np.testing.assert_allclose(xyz(field), (1, 0, 0.1 - math.sin(math.pi / 3)), atol=1e-9)
        self.carry("place", "gps", at=(1000, 0, 4), referenceLatitude=30, scaleError="1.1 1 0.5", velocityScaleError="1 3 1")
        self.place("place", 1000, 0, 4, linear=(0.001, 2, 0))
        fix = self.measure("/place/fix", NavSatFix, 0.6, 0)
        self.assertAlmostEqual((fix.latitude - 30) * NORTH[0], 1100, delta=0.2)
        self.assertAlmostEqual(fix.altitude, 2, places=6)
        np.testing.assert_allclose(xyz(self.measure("/place/fix_velocity", Vector3Stamped, 0.6, 0).vector), (0.001, 6, 0), atol=1e-6)

    def test_scale_of_a_sonar(self):
        vertical = "<vertical><samples>1</samples><min_angle>-0.01</min_angle><max_angle>0.01</max_angle></vertical>"
        library = plugin("hector_gazebo_ros_sonar", robotNamespace="/ping", scaleError=0.5, offset=0.25)
        sonar = ray("s", library, samples=1, low=-0.01, high=0.01, far=8, vertical=vertical, at="0 0 0 0 0 0")
        self.spawn("ping", sdf(link("l", gravity=False, extra=sonar)), 0, 0, 1)
        self.addCleanup(self._delete_model, "ping")
        self.assertAlmostEqual(self.measure("/ping/sonar", Range, 0.3, 0).range, 0.5 * 4.0 + 0.25, delta=1e-3)
        self.reconfigured("/ping/sonar", scale_error=1.0)
        self.assertAlmostEqual(self.measure("/ping/sonar", Range, 0.3, 0).range, 4.25, delta=1e-3)

    def test_rate_of_a_sonar(self):
        """Of a sensor at 30 Hz ten a second, or as many as the plugin says."""
        for rate, wanted in ((None, 10), (30, 30), (15, 15)):
            name = f"beats{rate}"
            library = plugin("hector_gazebo_ros_sonar", robotNamespace=f"/{name}", **({"updateRate": rate} if rate else {}))
            self.spawn(name, sdf(link("l", gravity=False, extra=ray("s", library, samples=1, far=8, rate=30))), 0, 0, 1)
            self.addCleanup(self._delete_model, name)
            with Ear(f"/{name}/sonar", Range) as ear:
                self.until_stepped(lambda: len(ear.messages) > 15, "16 messages")  # noqa: B023
                gaps = np.diff([message.header.stamp.to_sec() for message in ear.messages])
            self.assertAlmostEqual(np.median(gaps), 1 / wanted, delta=2e-3)  # a message that was lost is one long gap

    def test_drift_of_the_velocity_adds_up(self):
        """Of 1 m/s along each axis it stays 1 m/s for the first seconds: the place goes on by what a receiver adds up."""
        self.carry("adds", "gps", updateRate=10, velocityDrift=1, velocityDriftFrequency=1e-6, referenceLatitude=10, referenceHeading=0)
        with Ear("/adds/fix", NavSatFix) as ear, Ear("/adds/fix_velocity", Vector3Stamped) as speed:
            for wanted in range(1, 22):
                self.step(0.1)
                until(lambda: len(ear.messages) >= wanted - 1 and len(speed.messages) >= wanted - 1, "a fix")  # noqa: B023
            first, last = ear.messages[1], ear.messages[-1]  # what is added up counts from the next fix on
            drift = xyz(speed.messages[-1].vector)
        self.assertGreater(np.abs(drift).max(), 1e-3)
        seconds = (last.header.stamp - first.header.stamp).to_sec()
        self.assertAlmostEqual((last.latitude - first.latitude) * NORTH[1], drift[0] * seconds, delta=0.02)
        self.assertAlmostEqual(last.altitude - first.altitude, drift[2] * seconds, delta=0.02)

    # ---------------------------------------------------------------------------------------------------- what changes them

    def test_calibration_is_of_the_gyroscope_alone(self):
        self.carry("calibrated", "imu", rateDrift=0.5, accelDrift=0.5, rateOffset="0.3 0 0")
        before = self.imu("calibrated", topic="imu/bias")[-1]
        self.assertGreater(np.abs(xyz(before.angular_velocity)).max(), 0.05)
        rospy.ServiceProxy("/calibrated/imu/calibrate", Empty)()
        after = self.imu("calibrated", topic="imu/bias")[-1]
        wander = 5 * 0.5 * math.sqrt(2 * 0.05 / 3600)
        np.testing.assert_allclose(xyz(after.angular_velocity), (0.3, 0, 0), atol=wander)  # the offset stays
        np.testing.assert_allclose(xyz(after.linear_acceleration), xyz(before.linear_acceleration), atol=wander)

    def test_biases_are_set(self):
        self.carry("biased", "imu")
        accel, rate = (rospy.ServiceProxy(f"/biased/imu/set_{name}_bias", SetBias) for name in ("accel", "rate"))
        accel(Vector3(0, 0.5, 0))
        rate(Vector3(0.1, 0.2, 0.3))
        message = self.imu("biased")[-1]
        np.testing.assert_allclose(xyz(message.linear_acceleration), (0, 0.5, G), atol=1e-3)
        np.testing.assert_allclose(xyz(message.angular_velocity), (0.1, 0.2, 0.3), atol=1e-4)
        self.assertAlmostEqual(rpy(message.orientation)[0], 0.5 / G, delta=1e-3)
        with self.assertRaisesRegex(rospy.ServiceException, "three finite numbers"):
            accel(Vector3(float("nan"), 0, 0))
        self.assertAlmostEqual(self.imu("biased")[-1].linear_acceleration.y, 0.5, delta=1e-3)

    def test_parameters(self):
        self.carry("dynamic", "imu", accelOffset="1 2 3", rateGaussianNoise=0.2)
        shown = self.reconfigured("/dynamic/imu/accel")
        self.assertEqual((shown["offset"], shown["scale_error"], shown["gaussian_noise"]), (2.0, 1.0, 0.0))
        shown = self.reconfigured("/dynamic/imu/accel", scale_error=0.5)
        self.assertEqual((shown["offset"], shown["scale_error"]), (2.0, 0.5))
        np.testing.assert_allclose(xyz(self.imu("dynamic")[-1].linear_acceleration), (1, 2, 3 + G / 2), atol=1e-3)
        self.reconfigured("/dynamic/imu/accel", offset=-1.0)
        np.testing.assert_allclose(xyz(self.imu("dynamic")[-1].linear_acceleration), (-1, -1, -1 + G / 2), atol=1e-3)
        self.assertEqual(self.reconfigured("/dynamic/imu/rate", gaussian_noise=0.0)["gaussian_noise"], 0.0)
        message = self.imu("dynamic")[-1]
        np.testing.assert_allclose(xyz(message.angular_velocity), 0, atol=1e-9)
        self.assertEqual(message.angular_velocity_covariance[0], 0.0)
        self.reconfigured("/dynamic/imu/yaw", offset=0.5)
        self.assertAlmostEqual(rpy(self.imu("dynamic")[-1].orientation)[2], 0.5, delta=0.05)

    def test_parameters_of_a_magnetometer(self):
        self.carry("compass", "magnetic", referenceHeading=0)
        self.reconfigured("/compass/magnetic", offset=1.0)
        vector = self.measure("/compass/magnetic", Vector3Stamped, 0.01, 0).vector
        np.testing.assert_allclose(xyz(vector), (1.5, 1, 1 - math.sin(math.pi / 3)), atol=1e-9)

    def test_parameters_and_reference_of_a_receiver(self):
        self.carry("receiver", "gps", at=(100, 0, 1), referenceLatitude=30, referenceLongitude=5)
        fix = self.measure("/receiver/fix", NavSatFix, 0.6, 0)
        self.assertEqual((fix.status.status, fix.status.service), (0, 0))
        shown = self.reconfigured("/receiver/fix/status")
        self.assertEqual((shown["STATUS_FIX"], shown["STATUS_SBAS_FIX"], shown["SERVICE_GPS"]), (True, False, False))
        self.reconfigured("/receiver/fix/status", SERVICE_GPS=True, SERVICE_GALILEO=True, STATUS_GBAS_FIX=True)
        self.reconfigured("/receiver/fix/position", offset=2.0)
        self.reconfigured("/receiver/fix/velocity", offset=-1.0)
        fix = self.measure("/receiver/fix", NavSatFix, 0.6, 0)
        self.assertEqual((fix.status.status, fix.status.service, fix.altitude), (2, 9, 3.0))
        np.testing.assert_allclose(xyz(self.measure("/receiver/fix_velocity", Vector3Stamped, 0.6, 0).vector), -1, atol=1e-9)
        self.reconfigured("/receiver/fix/status", STATUS_FIX=False)
        self.reconfigured("/receiver/fix/position", offset=0.0)
        refer = rospy.ServiceProxy("/receiver/fix/set_reference_geopose", SetReferenceGeoPose)
        refer(GeoPose(GeoPoint(10, 20, 30), Quaternion(0, 0, 0, 0)))  # no orientation: x is east
        fix = self.measure("/receiver/fix", NavSatFix, 0.6, 0)
        self.assertEqual(fix.status.status, -1)
        self.assertAlmostEqual((fix.longitude - 20) * EAST_AT_10, 100, delta=0.1)
        self.assertAlmostEqual(fix.latitude, 10, places=9)
        self.assertAlmostEqual(fix.altitude, 31, places=6)
        refer(GeoPose(GeoPoint(10, 20, 30), Quaternion(0, 0, math.sqrt(0.5), math.sqrt(0.5))))  # x is north
        self.assertAlmostEqual((self.measure("/receiver/fix", NavSatFix, 0.6, 0).latitude - 10) * NORTH[1], 100, delta=0.1)
        with self.assertRaisesRegex(rospy.ServiceException, "-90 to 90"):
            refer(GeoPose(GeoPoint(100, 20, 30), Quaternion(0, 0, 0, 1)))

    # ---------------------------------------------------------------------------------------------------- the earth

    def test_the_world_refers_and_the_plugin_has_the_last_word(self):
        """The world: 10 degrees north, 20 east, 30 m, its x axis 40 degrees north of east, which is 50 degrees from north."""
        of_world = {"useWorldSphericalCoordinates": "true"}
        self.carry("world", "gps", at=(100, 0, 1), **of_world)
        fix = self.measure("/world/fix", NavSatFix, 0.6, 0)
        self.assertAlmostEqual((fix.latitude - 10) * NORTH[1], 100 * math.cos(math.radians(50)), delta=0.1)
        self.assertAlmostEqual((fix.longitude - 20) * EAST_AT_10, 100 * math.sin(math.radians(50)), delta=0.1)
        self.assertAlmostEqual(fix.altitude, 31, places=6)
        self.carry("half", "gps", at=(100, 0, 1), referenceLatitude=30, referenceHeading=0, **of_world)
        fix = self.measure("/half/fix", NavSatFix, 0.6, 0)
        self.assertAlmostEqual((fix.latitude - 30) * NORTH[0], 100, delta=0.1)
        self.assertAlmostEqual(fix.longitude, 20, places=9)
        self.carry("high", "gps", referenceLongitude=5, referenceAltitude=7, **of_world)
        fix = self.measure("/high/fix", NavSatFix, 0.6, 0)
        self.assertAlmostEqual(fix.latitude, 10, places=9)
        self.assertAlmostEqual(fix.longitude, 5, places=9)
        self.assertAlmostEqual(fix.altitude, 8, places=6)
        for name, tags, heading in (("tells", {}, 50.0), ("told", {"referenceHeading": 90}, 90.0)):
            self.carry(name, "magnetic", inclination=0, **of_world, **tags)
            vector = self.measure(f"/{name}/magnetic", Vector3Stamped, 0.01, 0).vector
            np.testing.assert_allclose(xyz(vector), (math.cos(math.radians(heading)), math.sin(math.radians(heading)), 0), atol=1e-9)


if __name__ == "__main__":
    rospy.init_node("hector_test", disable_rostime=True)
    rostest.rosrun("gazebo_plugins", "hector", Hector)
