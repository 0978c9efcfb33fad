"""hector_gazebo_plugins' libhector_servo_plugin.so, a head or camera on up to three servos that looks where it is told, and
libhector_gazebo_reset_plugin.so, which tells Hector's mapping of a reset."""

from __future__ import annotations

import math

import rospy
import tf2_ros
from gazebo_ros.plugin import ModelPlugin, PluginError
from geometry_msgs.msg import Quaternion, QuaternionStamped
from node_signals.rates import Spaced
from ode_sim import math3
from sensor_msgs.msg import JointState
from std_msgs.msg import Header, String

from gazebo_plugins.ros_side import Topics, joint_named

_BASE = "base_link"
_LEVEL = QuaternionStamped(Header(frame_id="base_stabilized"), Quaternion(0.0, 0.0, 0.0, 1.0))  # until somebody says something
_ORDERS = ("zyx", "zy", "xyz", "xy", "y")  # axes of the servos that the original knows


def angles(q, axes: str) -> list[float]:
    """The angles, rad, of servos one on the other about ``axes`` (``zyx``, ``zy``, ``xyz``, ``xy`` or ``y``), whose head is turned by the
    unit quaternion ``q``."""
    x, y, z, w = q
    if axes[0] == "z":  # R = Rz Ry Rx
        found = {"z": math.atan2(2 * (x * y + w * z), 1 - 2 * (y * y + z * z)), "y": math.asin(_unit(2 * (w * y - x * z)))}
        found["x"] = math.atan2(2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
    else:  # R = Rx Ry Rz
        found = {"x": math.atan2(2 * (w * x - y * z), 1 - 2 * (x * x + y * y)), "y": math.asin(_unit(2 * (x * z + w * y)))}
        found["z"] = math.atan2(2 * (w * z - x * y), 1 - 2 * (y * y + z * z))
    return [found[axis] for axis in axes]


def _unit(value: float) -> float:
    return max(-1.0, min(1.0, value))


class Servo(ModelPlugin):
    """Turns to the orientation on ``drive`` (geometry_msgs/QuaternionStamped), by tf from its frame to base_link; publishes
    ``joint_states``."""

    def load(self, server, model, sdf) -> None:
        self.server = server
        self.topics = Topics(sdf, model.name, "C")
        self.axes, self.joints = self._servos(model, sdf)
        self.gain, self.damping = sdf.get("proportionalControllerGain", 8.0), sdf.get("derivativeControllerGain", 0.0)
        self.fastest = sdf.get("maxVelocity", 0.0)
        self.torque = sdf.get("torque", 0.0) or math.inf
        self.gate = Spaced(sdf.get("controlRate", 0.0), strict=True)
        self.wanted = _LEVEL
        self.publisher = self.topics.publisher(sdf.text_or("jointStateName", "joint_states"), JointState, 10)
        self.message = JointState(header=Header(frame_id=self.topics.frame(next(iter(model.links)))), name=[j.name for j in self.joints])
        self.topics.subscriber(sdf.text_or("topicName", "drive"), QuaternionStamped, self._hear)
        self.buffer = tf2_ros.Buffer()
        self.listener = tf2_ros.TransformListener(self.buffer)
        server.drives(*self.joints)
        server.before_step(self.step)

    @staticmethod
    def _servos(model, sdf) -> tuple[str, list]:
        """:raises PluginError: not as the plugin knows them"""
        axes, joints = "", []
        for tag in ("first", "second", "third"):
            name = sdf.get(f"{tag}ServoName", "")
            if not name:
                break
            joints.append(joint_named(model, name, f"{tag}ServoName"))
            axis = sdf.get(f"{tag}ServoAxis", (0.0, 0.0, 0.0))
            axes += next((letter for letter, unit in zip("xyz", ((1, 0, 0), (0, 1, 0), (0, 0, 1))) if axis == unit), "?")
        if not joints:
            raise PluginError("<firstServoName> is missing")
        if axes not in _ORDERS:
            raise PluginError(
                f"the axes of its servos are {axes} by <firstServoAxis>, <secondServoAxis>, <thirdServoAxis>; known are z y x, z y, x y z, "
                "x y and y, each written as 0 0 1, 0 1 0 or 1 0 0"
            )
        return axes, joints

    def _hear(self, message: QuaternionStamped) -> None:
        q = message.quaternion
        if not all(map(math.isfinite, (q.x, q.y, q.z, q.w))):
            rospy.logwarn_throttle(5.0, f"{self.topics.resolve('drive')}: an orientation that is not of finite numbers is ignored")
            return
        self.wanted = message

    def step(self) -> None:
        now = self.server.now()
        if not self.gate.due(now.to_nsec()):
            return
        for joint, speed in zip(self.joints, self._speeds()):
            joint.set_motor(speed, self.torque)
        message = self.message
        message.header.stamp = now
        message.position = [joint.position() for joint in self.joints]
        message.velocity = [joint.velocity() for joint in self.joints]
        message.effort = [joint.effort() for joint in self.joints]
        self.publisher.publish(message)

    def _speeds(self) -> list[float]:
        """rad/s of each servo; 0 while tf does not know how the frame of the command lies."""
        wanted = self.wanted
        try:
            turn = self.buffer.lookup_transform(_BASE, wanted.header.frame_id, rospy.Time(0)).transform.rotation
        except tf2_ros.TransformException:
            return [0.0] * len(self.joints)
        q, t = wanted.quaternion, turn
        head = math3.quat_normalize(math3.quat_multiply((t.x, t.y, t.z, t.w), math3.quat_normalize((q.x, q.y, q.z, q.w))))
        speeds = []
        for joint, angle in zip(self.joints, angles(head, self.axes)):
            speed = self.gain * (angle - joint.position()) - self.damping * joint.velocity()
            speeds.append(max(-self.fastest, min(self.fastest, speed)) if self.fastest > 0.0 else speed)
        return speeds

    def reset(self) -> None:
        self.wanted = _LEVEL
        self.gate.reset()
        for joint in self.joints:
            joint.set_motor(0.0, self.torque)

    def shutdown(self) -> None:
        self.listener.unregister()
        self.topics.close()


class ResetTold(ModelPlugin):
    """Says ``reset`` on /syscommand (std_msgs/String) whenever the simulation is reset."""

    def load(self, server, model, sdf) -> None:
        self.topics = Topics(sdf, model.name, "C")
        self.publisher = self.topics.publisher("/syscommand", String)

    def reset(self) -> None:
        self.publisher.publish("reset")

    def shutdown(self) -> None:
        self.topics.close()
