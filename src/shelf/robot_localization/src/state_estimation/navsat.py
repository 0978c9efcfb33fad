"""The node navsat_transform_node: fixes of a satellite receiver as positions in the robot's world, and the way back."""

from __future__ import annotations

import sys
import threading

import node_signals
import numpy as np
import rospy
import tf2_ros
from geographic_msgs.msg import GeoPoint
from geometry_msgs.msg import Point, TransformStamped
from nav_msgs.msg import Odometry
from node_signals.parameters import number
from robot_localization.srv import FromLL, FromLLResponse, SetDatum, SetDatumResponse, SetUTMZone, SetUTMZoneResponse, ToLL, ToLLResponse
from sensor_msgs.msg import Imu, NavSatFix, NavSatStatus

from .anchoring import Anchor, Datum
from .earth import Zone, zone_named
from .messages import Lookup, every, fill, quaternion, transform
from .motion import rotation, wrap
from .sensors import IDENTITY, FrameMissing, Transform, angles, quaternion_matrix

_WARN_PERIOD = 5.0  # s
_RENAMED = {
    "broadcast_utm_transform": "broadcast_cartesian_transform",
    "broadcast_utm_transform_as_parent_frame": "broadcast_cartesian_transform_as_parent_frame",
}


class Settings:
    """The node's parameters. :raises ValueError: one is wrong; says which"""

    def __init__(self):
        given = rospy.get_param("~", {})
        for old, new in _RENAMED.items():
            if old in given:
                rospy.logwarn("Parameter %s has been deprecated; its name is %s now.", rospy.resolve_name("~" + old), new)
                given[new] = given[old]

        def on(name: str) -> bool:
            return bool(given.get(name, False))

        # rad, added to the measured one
        self.yaw = number("~magnetic_declination_radians", 0.0) + number("~yaw_offset", 0.0)
        self.frequency = number("~frequency", 10.0)
        if self.frequency <= 0:
            raise ValueError(f"parameter {rospy.resolve_name('~frequency')} must be above zero")
        self.delay, self.timeout = number("~delay", 0.0, 0.0), number("~transform_timeout", 0.0, 0.0)
        self.broadcast = on("broadcast_cartesian_transform")
        self.as_parent = on("broadcast_cartesian_transform_as_parent_frame")
        self.flat, self.publish_fix = on("zero_altitude"), on("publish_filtered_gps")
        self.odometry_yaw, self.local = on("use_odometry_yaw"), on("use_local_cartesian")
        self.wait_for_datum = on("wait_for_datum")
        self.cartesian_frame = str(given.get("cartesian_frame_id", "local_enu" if self.local else "utm"))
        self.datum = self._datum(given["datum"]) if self.wait_for_datum and "datum" in given else None

    @staticmethod
    def _datum(value) -> tuple:
        """(latitude, longitude, yaw), degrees, rad. More entries are of an old form and do not count."""
        try:
            numbers = [float(entry) for entry in value[:3]]
        except (TypeError, ValueError):
            numbers = []
        if not isinstance(value, list) or len(numbers) < 3 or not np.isfinite(numbers).all() or abs(numbers[0]) > 90:
            raise ValueError(
                f"parameter {rospy.resolve_name('~datum')} must be a list [latitude, longitude, yaw] in "
                f"degrees, degrees and rad, but is {value!r:.60}"
            )
        return tuple(numbers)


class NavsatTransform:
    def __init__(self):
        """:raises ValueError: a parameter is wrong"""
        self._settings = settings = Settings()
        self.rate = settings.frequency
        self._mutex = threading.RLock()
        self._world, self._base, self._receiver = "odom", "base_link", ""
        self._manual, self._zone = settings.wait_for_datum, None
        self._datum: Datum | None = None
        self._pose: Transform | None = None  # of the robot in its world: of the datum, else the newest
        self._rpy: np.ndarray | None = None
        self._anchor: Anchor | None = None
        self._fix: NavSatFix | None = None  # not published yet
        self._odometry: Odometry | None = None
        self._look_up = Lookup(rospy.Duration(settings.timeout))
        self._broadcaster = tf2_ros.StaticTransformBroadcaster()
        self._gps_odometry = rospy.Publisher("odometry/gps", Odometry, queue_size=10)
        self._filtered = rospy.Publisher("gps/filtered", NavSatFix, queue_size=10) if settings.publish_fix else None
        if settings.datum:
            latitude, longitude, yaw = settings.datum
            self._set_datum(latitude, longitude, 0.0, rotation(np.array([0.0, 0.0, yaw])))
        rospy.Service("datum", SetDatum, self._on_datum)
        rospy.Service("toLL", ToLL, self._to_ll)
        rospy.Service("fromLL", FromLL, self._from_ll)
        rospy.Service("setUTMZone", SetUTMZone, self._set_zone)
        rospy.Subscriber("odometry/filtered", Odometry, self._take_odometry, queue_size=1)
        rospy.Subscriber("gps/fix", NavSatFix, self._take_fix, queue_size=1)
        self._imu = None
        self._listen_to_imu()
        self._begin = rospy.get_time() + settings.delay

    def _listen_to_imu(self) -> None:
        if self._imu is None and not self._settings.odometry_yaw and not self._manual:
            self._imu = rospy.Subscriber("imu/data", Imu, self._take_imu, queue_size=1)

    def _set_datum(self, latitude: float, longitude: float, altitude: float, attitude: np.ndarray) -> None:
        """The origin of the world is there. :raises ValueError: there is no such point"""
        datum = Datum(latitude, longitude, altitude, self._settings.local, self._zone)
        with self._mutex:
            self._manual, self._anchor = True, None
            self._datum, self._pose, self._rpy = datum, IDENTITY, angles(attitude)

    def _on_datum(self, request) -> SetDatumResponse:
        at, turn = request.geo_pose.position, request.geo_pose.orientation
        try:
            self._set_datum(at.latitude, at.longitude, at.altitude, quaternion_matrix(turn.x, turn.y, turn.z, turn.w))
        except ValueError as error:
            raise rospy.ServiceException(f"datum: {error}") from None
        return SetDatumResponse()

    def _set_zone(self, request) -> SetUTMZoneResponse:
        try:
            zone: Zone = zone_named(request.utm_zone)
        except ValueError as error:
            raise rospy.ServiceException(f"setUTMZone: {error}") from None
        with self._mutex:
            self._zone, self._manual, self._anchor, self._datum = zone, False, None, None
            self._rpy = None
            self._listen_to_imu()
        rospy.loginfo("UTM zone set to %d %s", zone.number, "north" if zone.north else "south")
        return SetUTMZoneResponse()

    def _to_ll(self, request) -> ToLLResponse:
        at = request.map_point
        return ToLLResponse(GeoPoint(*self._anchored().to_earth(np.array([at.x, at.y, at.z]))))

    def _from_ll(self, request) -> FromLLResponse:
        at = request.ll_point
        try:
            position = self._anchored().to_map(at.latitude, at.longitude, at.altitude)
        except ValueError as error:
            raise rospy.ServiceException(f"fromLL: {error}") from None
        return FromLLResponse(self._point(position))

    def _anchored(self) -> Anchor:
        anchor = self._anchor
        if anchor is None:
            rospy.logerr("No transform available (yet)")
            raise rospy.ServiceException(
                "No transform available (yet): it takes a fix on gps/fix, odometry on "
                "odometry/filtered and a heading on imu/data, or a call of the service datum"
            )
        return anchor

    def _point(self, position: np.ndarray) -> Point:
        return Point(position[0], position[1], 0.0 if self._settings.flat else position[2])

    def _take_odometry(self, message: Odometry) -> None:
        try:
            pose = transform(message.pose.pose)
        except ValueError as error:
            rospy.logwarn_throttle(_WARN_PERIOD, f"odometry/filtered: {error}")
            return
        with self._mutex:
            self._world, self._base = message.header.frame_id.lstrip("/"), message.child_frame_id.lstrip("/")
            self._odometry = message
            if self._anchor is None and not self._manual:
                self._pose = pose
                if self._settings.odometry_yaw:
                    self._rpy = angles(pose.rotation)

    def _take_imu(self, message: Imu) -> None:
        with self._mutex:
            if self._pose is None or self._manual:  # the robot's frame is not known yet
                return
            base = self._base
        turn = message.orientation
        try:
            rpy = angles(quaternion_matrix(turn.x, turn.y, turn.z, turn.w))
            mount = angles(self._look_up(base, message.header.frame_id or base, message.header.stamp).rotation)
        except (FrameMissing, ValueError) as error:
            rospy.logwarn_throttle(_WARN_PERIOD, f"imu/data: {error}")
            return
        with self._mutex:
            if self._anchor is None:
                # A unit that sits sideways tells roll and pitch of its own axes.
                self._rpy = rotation(np.array([0.0, 0.0, mount[2]])) @ wrap(rpy - mount)

    def _take_fix(self, message: NavSatFix) -> None:
        place = message.latitude, message.longitude, message.altitude
        if message.status.status == NavSatStatus.STATUS_NO_FIX or np.isnan(place).any():
            return
        if not message.header.frame_id:
            rospy.logwarn_once("NavSatFix message has empty frame_id. Will assume navsat device is mounted at robot's origin.")
        with self._mutex:
            self._receiver = message.header.frame_id.lstrip("/")
            try:
                if self._anchor is None and not self._manual:
                    self._datum = Datum(*place, self._settings.local, self._zone)
            except ValueError as error:
                rospy.logerr_throttle(1.0, f"gps/fix: {error}")
                return
            self._fix = message

    def step(self, now: float) -> None:
        """Finds where the world lies, then publishes what is new; ``now`` in s."""
        with self._mutex:
            if now < self._begin:
                return
            if self._anchor is None:
                self._align()
                return
            if self._fix and self._odometry:
                fix, self._fix = self._fix, None
                self._publish_odometry(self._anchor, fix)
            if self._filtered and self._odometry:
                odometry, self._odometry = self._odometry, None
                self._publish_fix(self._anchor, odometry, self._filtered)

    def _align(self) -> None:
        if self._datum is None or self._pose is None or self._rpy is None:
            return
        rpy = self._rpy + [0.0, 0.0, self._settings.yaw]
        offset = np.zeros(3)
        if not self._manual and self._receiver:
            try:
                offset = self._look_up(self._base, self._receiver, rospy.Time(0)).translation
            except (FrameMissing, ValueError):
                rospy.logwarn_once(
                    f"Unable to obtain {self._base}->{self._receiver} transform. Will assume navsat device is mounted at robot's origin"
                )
        self._anchor = Anchor(self._datum, self._pose, rpy, offset)
        if self._imu is not None:
            self._imu.unregister()
            self._imu = None
        rospy.loginfo(
            "The origin of %s is at latitude %.7f, longitude %.7f; its x axis points %.4f rad to the left of the grid's east.",
            self._world,
            *self._anchor.to_earth(np.zeros(3))[:2],
            -angles(self._anchor.world_plane.rotation)[2],
        )
        if self._settings.broadcast:
            self._broadcast(self._anchor.world_plane)

    def _broadcast(self, pose: Transform) -> None:
        parent, child = self._world, self._settings.cartesian_frame
        if self._settings.as_parent:
            parent, child, pose = child, parent, pose.inverse()
        sent = TransformStamped(child_frame_id=child)
        sent.header.stamp, sent.header.frame_id = rospy.Time.now(), parent
        fill(sent.transform.translation, pose.translation)
        fill(sent.transform.rotation, quaternion(pose.rotation), "xyzw")
        if self._settings.flat:
            sent.transform.translation.z = 0.0
        self._broadcaster.sendTransform(sent)

    def _publish_odometry(self, anchor: Anchor, fix: NavSatFix) -> None:
        try:
            position = anchor.to_map(fix.latitude, fix.longitude, fix.altitude)
        except ValueError as error:
            rospy.logerr_throttle(1.0, f"gps/fix: {error}")
            return
        message = Odometry()
        message.header.stamp, message.header.frame_id = fix.header.stamp, self._world
        message.pose.pose.position = self._point(position - self._receiver_offset(fix.header.stamp))
        message.pose.pose.orientation.w = 1.0
        covariance = np.zeros((6, 6))
        covariance[:3, :3] = anchor.covariance_in_map(np.reshape(fix.position_covariance, (3, 3)))
        message.pose.covariance = covariance.ravel().tolist()
        self._gps_odometry.publish(message)

    def _receiver_offset(self, stamp) -> np.ndarray:
        """(3,), m: from the robot's origin to the receiver, in the world's axes; zero without the frames."""
        if not self._receiver:
            return np.zeros(3)
        try:
            offset = self._look_up(self._base, self._receiver, stamp).translation
            return self._look_up(self._world, self._base, stamp).rotation @ offset
        except (FrameMissing, ValueError) as error:
            rospy.logwarn_throttle(_WARN_PERIOD, f"The navsat device's offset from the robot's origin is not removed: {error}")
            return np.zeros(3)

    def _publish_fix(self, anchor: Anchor, odometry: Odometry, publisher: rospy.Publisher) -> None:
        at = odometry.pose.pose.position
        message = NavSatFix(position_covariance_type=NavSatFix.COVARIANCE_TYPE_KNOWN)
        try:
            place = anchor.to_earth(np.array([at.x, at.y, at.z]))
        except ValueError as error:
            rospy.logerr_throttle(1.0, f"odometry/filtered: {error}")
            return
        message.latitude, message.longitude, message.altitude = place
        covariance = np.reshape(odometry.pose.covariance, (6, 6))[:3, :3]
        message.position_covariance = anchor.covariance_on_earth(covariance).ravel().tolist()
        message.status.status = NavSatStatus.STATUS_GBAS_FIX
        message.header.stamp, message.header.frame_id = odometry.header.stamp, self._base
        publisher.publish(message)


def main() -> int:
    node_signals.init_node("navsat_transform_node")
    try:
        navsat = NavsatTransform()
    except (TypeError, ValueError) as error:
        print(f"{rospy.get_name()}: {error}", file=sys.stderr)
        return 1
    timer = every(1 / navsat.rate, lambda: navsat.step(rospy.get_time()))
    node_signals.spin()
    timer.shutdown()
    return 0
