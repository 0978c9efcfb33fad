"""What the plugins that drive on wheels share: the newest command, odometry messages, ground truth pose."""

from __future__ import annotations

import math
from collections.abc import Sequence

import rospy
from geometry_msgs.msg import Twist, Vector3
from nav_msgs.msg import Odometry
from ode_sim import math3
from ode_sim.description.model import Pose

from gazebo_plugins.ros_side import TfBroadcaster, Topics, diagonal, pose_msg

UNKNOWN = 1e12  # variance of what a wheeled robot on the floor does not measure
POSE_COVARIANCE = (1e-5, 1e-5, UNKNOWN, UNKNOWN, UNKNOWN, 1e-3)  # x y z roll pitch yaw, of most drives


class Command:
    """The last Twist received on ``topic`` of ``topics``; a value that is not finite is dropped with a warning."""

    def __init__(self, topics: Topics, topic: str):
        self.x = self.y = self.yaw_rate = 0.0
        self.received = rospy.Time(0)
        self.topic = topics.resolve(topic)
        topics.subscriber(topic, Twist, self._receive)

    def _receive(self, message: Twist) -> None:
        values = (message.linear.x, message.linear.y, message.angular.z)
        if not all(map(math.isfinite, values)):
            rospy.logwarn_throttle(5.0, f"{self.topic}: a command that is not a finite number is ignored")
            return
        self.x, self.y, self.yaw_rate = values
        self.received = rospy.Time.now()

    def clear(self) -> None:
        self.x = self.y = self.yaw_rate = 0.0


def from_encoders(sdf) -> bool:
    """``<odometrySource>`` of the plugin's element ``sdf``: ``encoder`` (old files: 0), or ``world`` (1), which is the default."""
    return (sdf.text_or("odometrySource", "world")).lower() in ("encoder", "0")


def yaw_of(pose: Pose) -> float:
    """The angle about z of ``pose``, rad."""
    return math3.quat_to_rpy(pose.q)[2]


def ground_truth(model) -> tuple[Pose, tuple[float, float, float]]:
    """X_WM, and the velocity (forward, left, yaw rate) in the model's heading: m/s, m/s, rad/s."""
    pose = model.pose
    linear, angular = model.twist()
    yaw = yaw_of(pose)
    cos, sin = math.cos(yaw), math.sin(yaw)
    return pose, (cos * linear[0] + sin * linear[1], cos * linear[1] - sin * linear[0], angular[2])


class OdometryPublisher:
    """nav_msgs/Odometry and the transform that goes with it, named by ``sdf``, the plugin's element.

    :param topics: of the plugin. :param base_frame: where the element has no ``<robotBaseFrame>``
    :param pose_covariance: six variances, see :data:`POSE_COVARIANCE`
    :param twist_covariance: the same of the twist
    """

    def __init__(
        self,
        topics: Topics,
        sdf,
        base_frame: str,
        pose_covariance: Sequence[float] = POSE_COVARIANCE,
        twist_covariance: Sequence[float] = (0.0,) * 6,
    ):
        self.frame = topics.frame(sdf.text_or("odometryFrame", "odom"))
        self.base = topics.frame(sdf.text_or("robotBaseFrame", base_frame))
        self.publisher = topics.publisher(sdf.text_or("odometryTopic", "odom"), Odometry)
        self._message = Odometry()
        self._message.header.frame_id, self._message.child_frame_id = self.frame, self.base
        self._message.pose.covariance = diagonal(pose_covariance)
        self._message.twist.covariance = diagonal(twist_covariance)

    def publish(self, now: rospy.Time, pose: Pose, velocity: tuple[float, float, float], flat: bool = False) -> None:
        """Publish that the base is at ``pose`` (in :attr:`frame`) at the time ``now``.

        :param velocity: x and y, m/s, and yaw, rad/s, in the base's frame
        :param flat: leave z of the message 0, as some plugins do
        """
        message = self._message
        message.header.stamp = now
        message.pose.pose = pose_msg(Pose((pose.p[0], pose.p[1], 0.0), pose.q) if flat else pose)
        message.twist.twist = Twist(Vector3(velocity[0], velocity[1], 0.0), Vector3(0.0, 0.0, velocity[2]))
        self.publisher.publish(message)

    def set_yaw_variance(self, variance: float) -> None:
        """``variance``, rad^2 and (rad/s)^2, of the yaw in the messages from now on."""
        message = self._message
        message.pose.covariance[35] = message.twist.covariance[35] = variance

    def send_tf(self, now: rospy.Time, pose: Pose) -> None:
        """Send the transform that puts the base at ``pose`` at the time ``now``."""
        TfBroadcaster.send(now, self.frame, self.base, pose)


class EncoderOdometry:
    """Dead reckoning from the rates of a left and a right wheel, from the place where it was started. A wheel that somebody puts at
    another angle has not rolled there.

    :param radius: of both wheels, m
    :param separation: between their contact points, m
    """

    def __init__(self, left, right, radius: float, separation: float):
        self._wheels = (left, right)
        self._radius, self._separation = radius, separation
        self.reset()

    def reset(self) -> None:
        self._x = self._y = self._yaw = 0.0
        self.velocity = (0.0, 0.0, 0.0)

    def integrate(self, dt: float) -> None:
        """One step of ``dt`` seconds, with the heading at the middle of the step."""
        left, right = (wheel.velocity() * self._radius * dt for wheel in self._wheels)
        forward, turn = (left + right) / 2, (right - left) / self._separation
        heading = self._yaw + turn / 2
        self._x += forward * math.cos(heading)
        self._y += forward * math.sin(heading)
        self._yaw += turn
        self.velocity = (forward / dt, 0.0, turn / dt)

    @property
    def pose(self) -> Pose:
        return Pose((self._x, self._y, 0.0), math3.quat_from_rpy(0.0, 0.0, self._yaw))
