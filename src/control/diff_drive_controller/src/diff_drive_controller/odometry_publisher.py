"""Topic odom and the transform odom -> base."""

from __future__ import annotations

import math

import rospy
from controller_interface import NodeHandle, ParameterError, RateGate, RealtimePublisher, to_stamp
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from tf2_msgs.msg import TFMessage

from .laws import PlanarOdometry


class OdometryPublisher:
    """Publishes a PlanarOdometry at parameter ``publish_rate``.

    :param root_nh, controller_nh: the namespaces that a controller's ``init`` is given
    :param odom_frame: fixed name of the odometry frame; None reads the parameter ``odom_frame_id``
    """

    def __init__(self, root_nh: NodeHandle, controller_nh: NodeHandle, odom_frame: str | None = None):
        self.rate = controller_nh.param("publish_rate", 50.0)
        self.base_frame = controller_nh.param("base_frame_id", "base_link")
        self.odom_frame = odom_frame or controller_nh.param("odom_frame_id", "odom")
        self.tf_enabled = controller_nh.param("enable_odom_tf", True)
        self._pose_covariance = _diagonal(controller_nh, "pose_covariance_diagonal")
        self._twist_covariance = _diagonal(controller_nh, "twist_covariance_diagonal")
        self._gate = RateGate(self.rate)
        self._now = 0.0
        self._odom = RealtimePublisher(controller_nh, "odom", Odometry, queue_size=100)
        self._tf = RealtimePublisher(root_nh, "/tf", TFMessage, queue_size=100)

    def restart(self, time: float) -> None:
        """Begin anew at ``time`` (s): the clock may have gone back."""
        self._now = time
        self._gate.restart(time)

    def set_rate(self, rate: float) -> None:
        """Publish at ``rate`` Hz from now on; 0 for never."""
        self.rate = rate
        self._gate = RateGate(rate, self._now)

    def publish(self, odometry: PlanarOdometry, time: float) -> bool:
        """Send ``odometry``, which is of ``time`` (s), if it is time to. Realtime safe. :return: whether it was"""
        self._now = time
        if not self._gate.due(time):
            return False
        stamp = to_stamp(time)
        sine, cosine = math.sin(0.5 * odometry.heading), math.cos(0.5 * odometry.heading)
        message = Odometry(child_frame_id=self.base_frame)
        message.header.stamp = stamp
        message.header.frame_id = self.odom_frame
        message.pose.pose.position.x = odometry.x
        message.pose.pose.position.y = odometry.y
        message.pose.pose.orientation.z = sine
        message.pose.pose.orientation.w = cosine
        message.pose.covariance = self._pose_covariance
        message.twist.twist.linear.x = odometry.linear
        message.twist.twist.linear.y = odometry.linear_y
        message.twist.twist.angular.z = odometry.angular
        message.twist.covariance = self._twist_covariance
        self._odom.publish(message)
        if self.tf_enabled:
            transform = TransformStamped(child_frame_id=self.base_frame)
            transform.header.stamp = stamp
            transform.header.frame_id = self.odom_frame
            transform.transform.translation.x = odometry.x
            transform.transform.translation.y = odometry.y
            transform.transform.rotation.z = sine
            transform.transform.rotation.w = cosine
            self._tf.publish(TFMessage([transform]))
        return True


def _diagonal(nh: NodeHandle, name: str) -> list[float]:
    """A 6x6 covariance, row-major, from its diagonal in a parameter; zeros without one."""
    values = nh.param(name, [])
    if not values:
        rospy.logwarn("parameter %s is not set: odometry is published with zero covariance", nh.resolve(name))
        values = [0.0] * 6
    if len(values) != 6 or not all(isinstance(v, (int, float)) and not isinstance(v, bool) and v == v for v in values):
        raise ParameterError(f"parameter {nh.resolve(name)} must be a list of 6 numbers (x y z roll pitch yaw), it is {values!r}")
    matrix = [0.0] * 36
    matrix[::7] = map(float, values)
    return matrix
