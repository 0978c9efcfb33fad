"""Differential drive: velocity commands in, odometry out."""

import math

import rospy
import tf2_ros
from geometry_msgs.msg import Quaternion, TransformStamped, Twist
from nav_msgs.msg import Odometry

from .controllers import Controller, status
from .parameters import every, number, usable

FRAMES = 30.0  # 1/s, rate of the board's own speed loop


def approach(value, target, step):
    """`value` moved towards `target` by at most `step`."""
    return min(target, value + step) if value < target else max(target, value - step)


def ticks_moved(now, before):
    """Difference `now` - `before` of a 32-bit counter that may have wrapped round in between."""
    return (now - before + 2**31) % 2**32 - 2**31


class DiffController(Controller):
    pause = True

    def __init__(self, device, name):
        super().__init__(device, name)
        prefix = "~controllers/%s/" % name
        rate = number(prefix + "rate", 10.0, above=0)
        self._every = every(rate)
        self._timeout = rospy.Duration(number(prefix + "timeout", 1.0))
        self._ticks_meter = float(number(prefix + "ticks_meter", above=0))
        self._base_width = float(number(prefix + "base_width", above=0))
        self._base_frame = rospy.get_param(prefix + "base_frame_id", "base_link")
        self._odom_frame = rospy.get_param(prefix + "odom_frame_id", "odom")
        self._gains = [number(prefix + key, default) for key, default in (("Kp", 5), ("Kd", 1), ("Ki", 0), ("Ko", 50))]
        self._ramp = max(1, int(number(prefix + "accel_limit", 0.1) * self._ticks_meter / rate))

        self.joint_names = ["base_l_wheel_joint", "base_r_wheel_joint"]
        self.joint_positions = [0.0, 0.0]
        self.joint_velocities = [0.0, 0.0]

        self._x = self._y = self._heading = 0.0  # of the base in the odometry frame, m and rad
        self._forwards = self._turn = 0.0  # m/s, rad/s
        self._encoders = None
        self._speeds = [0, 0]  # set points of the wheels, ticks per frame
        self._wanted = [0, 0]
        self._last_command = self._last_update = rospy.Time.now()

        self._odometry = rospy.Publisher("odom", Odometry, queue_size=5)
        self._transforms = tf2_ros.TransformBroadcaster()
        rospy.Subscriber("cmd_vel", Twist, self._command)
        rospy.loginfo("Started DiffController (%s). Geometry: %sm wide, %s ticks/m.", name, self._base_width, self._ticks_meter)

    def startup(self):
        if not self.device.fake:
            self.device.board.setupBase(*self._gains)

    def _command(self, twist):
        if not usable(twist.linear.x, twist.angular.z):
            rospy.logwarn_throttle(1.0, "%s: %s m/s and %s rad/s are no command; ignored." % (self.name, twist.linear.x, twist.angular.z))
            return
        self._last_command = rospy.Time.now()
        if self.device.fake:
            self._forwards, self._turn = twist.linear.x, twist.angular.z
        else:
            half = twist.angular.z * self._base_width / 2.0
            self._wanted = [int(speed * self._ticks_meter / FRAMES) for speed in (twist.linear.x - half, twist.linear.x + half)]

    def update(self, now):
        if not self._every.due(now.to_nsec()):
            return
        elapsed = (now - self._last_update).to_sec()
        self._last_update = now
        if self.device.fake:
            self._x += math.cos(self._heading) * self._forwards * elapsed
            self._y += math.sin(self._heading) * self._forwards * elapsed
            self._heading += self._turn * elapsed
        else:
            encoders = self.device.board.getBaseEncoders()
            if encoders is None:
                rospy.logerr("Could not update encoders: the board did not answer.")
                return
            self._integrate(encoders, elapsed)
        self._publish(now)
        if not self.device.fake:
            self._drive(now)

    def _integrate(self, encoders, elapsed):
        left, right = (ticks_moved(count, before) / self._ticks_meter for count, before in zip(encoders, self._encoders or encoders))
        self._encoders = encoders
        way, turned = (left + right) / 2, (right - left) / self._base_width
        self._x += way * math.cos(self._heading + turned / 2)
        self._y += way * math.sin(self._heading + turned / 2)
        self._heading += turned
        self._forwards, self._turn = way / elapsed, turned / elapsed

    def _drive(self, now):
        if now > self._last_command + self._timeout:
            self._wanted = [0, 0]
        self._speeds = [approach(speed, wanted, self._ramp) for speed, wanted in zip(self._speeds, self._wanted)]
        self.device.board.setBaseSpeed(*self._speeds)

    def _publish(self, now):
        rotation = Quaternion(z=math.sin(self._heading / 2), w=math.cos(self._heading / 2))
        transform = TransformStamped(child_frame_id=self._base_frame)
        transform.header.stamp = rospy.Time.now()
        transform.header.frame_id = self._odom_frame
        transform.transform.translation.x, transform.transform.translation.y = self._x, self._y
        transform.transform.rotation = rotation
        self._transforms.sendTransform(transform)

        odometry = Odometry(child_frame_id=self._base_frame)
        odometry.header.stamp = now
        odometry.header.frame_id = self._odom_frame
        odometry.pose.pose.position.x, odometry.pose.pose.position.y = self._x, self._y
        odometry.pose.pose.orientation = rotation
        odometry.twist.twist.linear.x, odometry.twist.twist.angular.z = self._forwards, self._turn
        self._odometry.publish(odometry)

    def shutdown(self):
        if not self.device.fake:
            self.device.board.setBaseSpeed(0, 0)

    def diagnostics(self):
        wheels = {} if self.device.fake else dict(zip(("Left", "Right"), self._encoders or (None, None)))
        return status(self.name, **wheels, dX=self._forwards, dR=self._turn)
