#!/usr/bin/env python3
"""Which messages count: in the order of their stamps, after set_pose, not while measurements are toggled off; and what parameters do."""

import contextlib
import queue
import subprocess
import threading
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import AccelWithCovarianceStamped, PoseWithCovarianceStamped, TwistWithCovarianceStamped
from nav_msgs.msg import Odometry
from robot_localization.srv import GetState, SetPose, ToggleFilterProcessing
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu
from std_srvs.srv import Empty
from tf2_msgs.msg import TFMessage

FILTERS = [f"{kind}_{sensor}" for kind in ("ekf", "ukf") for sensor in ("odom", "pose", "twist", "imu")]
TYPES = {"odom": Odometry, "pose": PoseWithCovarianceStamped, "twist": TwistWithCovarianceStamped, "imu": Imu}
ENTRY = {"odom": 0, "pose": 0, "twist": 6, "imu": 11}  # of the state: x, x, vx, vyaw
PATIENCE = 30.0  # s of wall time


def covariance(size):
    return [1e-4 if index % (size + 1) == 0 else 0.0 for index in range(size * size)]


def sensor_of(name):
    return name.partition("_")[2]


@contextlib.contextmanager
def about(name):
    """Failures say whose they are; rostest shows none of unittest's own subtests."""
    try:
        yield
    except AssertionError as error:
        raise AssertionError(f"{name}: {error}") from None


def measured(name, stamp, value):
    """A message of the sensor of a filter that says so of its entry of the state."""
    sensor = sensor_of(name)
    message = TYPES[sensor]()
    message.header.stamp, message.header.frame_id = stamp, "base_link"
    if sensor == "imu":
        message.angular_velocity.z, message.orientation.w = value, 1.0
        message.orientation_covariance = message.angular_velocity_covariance = message.linear_acceleration_covariance = covariance(3)
        return message
    if sensor in ("odom", "pose"):
        message.header.frame_id = "map" if name == "ekf_pose" else f"{name}/odom" if sensor == "odom" else "odom"
        message.pose.pose.position.x, message.pose.pose.orientation.w = value, 1.0
        message.pose.covariance = covariance(6)
    if sensor == "twist":
        message.twist.twist.linear.x = value
    if sensor in ("odom", "twist"):
        message.twist.covariance = covariance(6)
    return message


class Order(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.now = rospy.Time(100)
        cls.clock = rospy.Publisher("/clock", Clock, queue_size=1)
        cls.inputs = {name: rospy.Publisher(f"/{name}/in", TYPES[sensor_of(name)], queue_size=100) for name in FILTERS}
        cls.estimates = {name: queue.Queue() for name in FILTERS}
        cls.diagnosed: dict = {}
        listeners = [rospy.Subscriber(f"/{name}/odometry/filtered", Odometry, cls.estimates[name].put) for name in FILTERS]
        listeners.append(rospy.Subscriber("/diagnostics", DiagnosticArray, cls.keep))
        ends = [cls.clock, *cls.inputs.values(), *listeners]
        cls.wait(lambda: all(end.get_num_connections() for end in ends) and cls.clock.get_num_connections() >= len(FILTERS))
        cls.states = {name: rospy.ServiceProxy(f"/{name}/filter/get_state", GetState) for name in FILTERS}

    @classmethod
    def keep(cls, message):
        for status in message.status:
            for entry in status.values:
                cls.diagnosed.setdefault(status.name, {})[entry.key] = entry.value

    @classmethod
    def wait(cls, done, what="", ticking=None):
        end = time.monotonic() + PATIENCE
        while not done():
            if time.monotonic() > end:
                raise AssertionError(f"it took too long: {what}")
            if ticking:
                cls.tick(ticking)
            else:
                rospy.rostime.wallsleep(0.01)

    @classmethod
    def tick(cls, seconds):
        cls.now = cls.now + rospy.Duration.from_sec(seconds)
        cls.clock.publish(cls.now)
        rospy.rostime.wallsleep(0.005)

    def state(self, name):
        return self.states[name](rospy.Time(0), "").state

    def send(self, name, value, ago=0.0, count=1):
        for _ in range(count):
            self.inputs[name].publish(measured(name, self.now - rospy.Duration.from_sec(ago), value))

    def estimated(self, name):
        """The first estimate of now, or later; time goes on meanwhile."""
        stamp, found = self.now, []

        def come():
            while not self.estimates[name].empty():
                found.append(self.estimates[name].get())
            return found and found[-1].header.stamp >= stamp

        self.wait(come, f"an estimate of {name} for {stamp.to_sec()} s", ticking=0.01)
        return found[-1]

    def settle(self, name, value):
        """Measurements of now, until the state says so, and that a robot whose pose is measured stands there."""

        def there():
            self.send(name, value)
            state = self.state(name)
            return abs(state[ENTRY[sensor_of(name)]] - value) < 0.02 and (sensor_of(name) != "pose" or abs(state[6]) < 0.02)

        self.wait(there, f"{name} at {value}", ticking=0.02)

    def entry(self, name):
        return self.state(name)[ENTRY[sensor_of(name)]]

    def said(self, name, words):
        key = {"imu": "imu0", "odom": "odom0", "pose": "pose0", "twist": "twist0"}[sensor_of(name)] + "_timestamp"
        told = self.diagnosed.setdefault(f"{name}/filter: Filter diagnostic updater", {})
        self.wait(lambda: words in told.get(key, ""), f"diagnostics of {name} do not say: {words}", ticking=0.05)

    def test_1_silent_until_it_is_enabled(self):
        """The one that is disabled at its start tells nothing; what the others tell shows that time has passed."""
        for name in FILTERS:
            self.send(name, 0.5)
        for name in FILTERS:
            if name != "ekf_imu":
                self.settle(name, 0.5)
                self.estimated(name)
        self.assertTrue(self.estimates["ekf_imu"].empty())
        rospy.ServiceProxy("/ekf_imu/filter/enable", Empty)()
        self.settle("ekf_imu", 0.5)
        self.estimated("ekf_imu")

    def test_2_what_is_older_than_the_message_before_it_is_ignored(self):
        for name in FILTERS:
            if name == "ukf_imu":  # which starts again
                continue
            with about(name):
                self.settle(name, 0.5)
                self.send(name, -5.0, ago=10.0, count=5)
                self.send(name, 0.5)  # of the same publisher: when that has come, the others have come, too
                self.said(name, "is older than that of the message before it")
                self.estimated(name)
                self.assertAlmostEqual(self.entry(name), 0.5, delta=0.05)

    def test_3_what_was_measured_before_set_pose_is_ignored(self):
        """Until its stamp, that included; what comes later counts."""
        for name in FILTERS:
            with about(name):
                self.settle(name, 0.5)
                put = PoseWithCovarianceStamped()
                put.header.stamp, put.header.frame_id = self.now, "map" if name == "ekf_pose" else ""
                put.pose.pose.position.x, put.pose.pose.orientation.w = 2.0, 1.0
                put.pose.covariance = covariance(6)
                rospy.ServiceProxy(f"/{name}/set_pose", SetPose)(put)
                self.send(name, 5.0, ago=0.5, count=5)
                self.send(name, 5.0, ago=0.0, count=5)
                self.said(name, "is that of the last set_pose, or older")
                state = self.state(name)
                self.assertAlmostEqual(state[0], 2.0, delta=0.01)
                self.assertAlmostEqual(self.entry(name), 2.0 if sensor_of(name) in ("odom", "pose") else 0.0, delta=0.01)
                self.settle(name, 0.5)

    def test_4_toggled_off_it_stands_still_and_goes_on_telling(self):
        toggles = {name: rospy.ServiceProxy(f"/{name}/filter/toggle", ToggleFilterProcessing) for name in FILTERS}
        before = {}
        for name in FILTERS:
            self.settle(name, 0.5)
            self.assertEqual((toggles[name](False).status, toggles[name](False).status), (True, False))
            self.tick(0.02)
            before[name] = self.estimated(name)
        self.tick(1.0)
        for name in FILTERS:
            with about(name):
                self.send(name, 3.0, count=3)
                later = self.estimated(name)
                self.assertGreaterEqual((later.header.stamp - before[name].header.stamp).to_sec(), 1.0)
                self.assertEqual(later.pose.pose, before[name].pose.pose)
                self.assertEqual(later.twist.twist, before[name].twist.twist)
        for _ in range(4):  # in all longer than what counts as a jump of the clock
            self.tick(40.0)
            for name in FILTERS:
                self.estimated(name)
        for name in FILTERS:
            with about(name):
                told = self.estimated(name)
                self.assertEqual(told.pose.pose, before[name].pose.pose)
                self.assertTrue(toggles[name](True).status)
                # At 0.5 m/s and 0.5 rad/s at most: no time has passed for the filter while measurements did not count.
                self.assertAlmostEqual(self.state(name)[0], before[name].pose.pose.position.x, delta=0.5)
                self.settle(name, 0.5)

    def test_5_what_is_of_a_time_to_come_waits_for_it(self):
        self.settle("ekf_odom", 0.5)
        self.send("ekf_odom", 3.0, ago=-2.0)
        self.estimated("ekf_odom")
        self.assertAlmostEqual(self.entry("ekf_odom"), 0.5, delta=0.05)
        self.tick(2.0)
        self.wait(lambda: self.entry("ekf_odom") > 1.0, "the measurement of a time to come", ticking=0.01)

    def test_6_frames_and_their_order(self):
        """base_link_frame_output is the child of all that goes out; invert_tf turns parent and child round, with no third frame."""
        told = []
        listener = rospy.Subscriber("/tf", TFMessage, lambda message: told.extend(message.transforms))
        accelerations = []
        other = rospy.Subscriber("/ekf_odom/accel/filtered", AccelWithCovarianceStamped, accelerations.append)
        self.wait(lambda: listener.get_num_connections() >= 2 and other.get_num_connections(), "connections")

        def pair(*frames):
            return next((found for found in reversed(told) if (found.header.frame_id, found.child_frame_id) == frames), None)

        self.settle("ekf_odom", 0.5)
        self.settle("ekf_pose", 0.5)
        self.wait(lambda: pair("ekf_odom/odom", "stamped_base") and pair("inverted_base", "map") and accelerations, "tf", ticking=0.01)
        self.assertEqual(self.estimated("ekf_odom").child_frame_id, "stamped_base")
        self.assertEqual(accelerations[-1].header.frame_id, "stamped_base")
        # The robot stands at x = 0.5 m in the map, unturned: from there the map's origin is at -0.5 m.
        self.assertAlmostEqual(pair("inverted_base", "map").transform.translation.x, -0.5, delta=0.05)
        self.assertIsNone(pair("map", "odom"))
        self.assertIsNone(pair("ekf_odom/odom", "base_link"))
        listener.unregister()
        other.unregister()

    def test_7_corrected_estimates_go_out_where_that_is_permitted(self):
        """One stamp often: the filter steps a hundred times a second, and predicts only after 0.2 s without a sensor."""
        for name, often in (("ekf_twist", True), ("ukf_twist", False)):
            self.settle(name, 0.5)
            stamps = []
            for _ in range(100):
                self.tick(0.01)
                if len(stamps) % 10 == 0:
                    self.send(name, 0.5)
                while not self.estimates[name].empty():
                    stamps.append(self.estimates[name].get().header.stamp)
            self.assertEqual(len(set(stamps)) < len(stamps), often, name)

    def test_8_the_clock_goes_back(self):
        """reset_on_time_jump: true starts again at an old message; false keeps the state, and what is old is ignored; where it is not
        given, a clock that goes back starts the filter again."""
        for name in ("ukf_imu", "ekf_pose", "ukf_pose"):
            self.settle(name, 0.5)
        self.send("ukf_imu", 0.3, ago=5.0)
        self.wait(lambda: self.entry("ukf_imu") == 0.0, "ukf_imu starts again", ticking=0.001)

        def goes_on():  # by messages that are older than those before the start
            self.send("ukf_imu", 0.3, ago=4.0)
            return abs(self.entry("ukf_imu") - 0.3) < 0.02

        self.wait(goes_on, "ukf_imu goes on", ticking=0.02)
        type(self).now = self.now - rospy.Duration(50)
        self.wait(lambda: self.entry("ukf_pose") == 0.0, "ukf_pose starts again", ticking=0.01)
        self.settle("ukf_pose", 0.2)
        self.send("ekf_pose", 5.0, count=3)
        self.said("ekf_pose", "is older than that of the message before it")
        self.assertAlmostEqual(self.entry("ekf_pose"), 0.5, delta=0.05)

    def test_9_parameters_without_effect_are_told(self):
        words = (
            ("_history_length:=2.0", "/ekf_told/history_length has no effect"),
            ("_smooth_lagged_data:=true", "/ekf_told/smooth_lagged_data has no effect"),
            ("_use_control:=true", "/ekf_told/use_control has no effect"),
            ("_debug:=true", "/ekf_told/debug has no effect"),
            ("_base_link_output_frame:=b", "base_link_output_frame has no effect: no parameter is called so; did you mean base_link_frame"),
            ("_odom0_pose_rejection_treshold:=2", "did you mean odom0_pose_rejection_threshold?"),
            ("_pose_use_child_frame:=true", "/ekf_told/pose_use_child_frame has no effect: no parameter is called so"),
        )
        silent = [
            "_odom0_pose_use_child_frame:=true",
            "_invert_tf:=false",
            "_stamped_control:=false",
            "_debug_out_file:=x",
            "_reset_on_time_jump:=true",
        ]
        told = subprocess.Popen(
            [
                "rosrun",
                "robot_localization",
                "ekf_localization_node",
                "__name:=ekf_told",
                "_odom0:=in",
                *silent,
                *(word for word, _ in words),
            ],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        lines: list = []
        over = threading.Timer(PATIENCE, told.terminate)
        over.start()
        try:
            for line in told.stdout:
                lines.append(line)
                if all(any(text in line for line in lines) for _, text in words):
                    break
        finally:
            over.cancel()
            told.terminate()
            told.wait(20)
            rospy.delete_param("/ekf_told")
        said = "".join(lines)
        for _, text in words:
            self.assertIn(text, said)
        for word in silent:
            self.assertNotIn(f"/ekf_told/{word[1:].partition(':')[0]} has", said)


if __name__ == "__main__":
    rospy.init_node("order_rostest")
    rostest.rosrun("robot_localization", "order_rostest", Order)
