"""Joints as programs see them: the base class, and what the robot's description and the driver's parameters say about their limits."""

import xml.etree.ElementTree
from math import pi, radians

import rospy

from .parameters import is_number


class Joint:
    """What a controller asks of a joint. `device` is the Driver; positions are in rad or m, raw data in the hardware's unit."""

    def __init__(self, device, name):
        self.device = device
        self.name = name
        self.controller = None  # whose actions keep single commands out
        self.position = 0.0
        self.velocity = 0.0
        self.last = rospy.Time.now()

    def interpolate(self, frame):
        """The next raw set point, or None; `frame` is how many there are in a s."""

    def setCurrentFeedback(self, raw_data):
        """Take a reading of the sensor."""

    def setControlOutput(self, position):
        """Go to a position. :return: it as raw data, or None"""

    def getDiagnostics(self):
        """A DiagnosticStatus, or None."""


def getJointsFromURDF():
    """The joints of robot_description that can move: {name: {"min", "max", "zero", "value"}}, rad or m; empty where there is none."""
    text = _parameter("robot_description")
    if not isinstance(text, str):
        rospy.loginfo("No URDF defined, proceeding with defaults")
        return {}
    try:
        robot = xml.etree.ElementTree.fromstring(text)
    except xml.etree.ElementTree.ParseError as error:
        rospy.logwarn("robot_description is no XML (%s); defaults are taken.", error)
        return {}
    joints = {}
    for joint in robot.findall("joint"):
        limits = _limits(joint)
        if limits:
            low, high = limits
            zero = (low + high) / 2 if low > 0 or high < 0 else 0
            joints[joint.get("name", "")] = {"min": low, "max": high, "zero": zero, "value": zero}
    return joints


def _limits(joint):
    """Of a <joint>, or None where there are none."""
    if joint.get("type") == "continuous":
        return -pi, pi
    limit = joint.find("limit")
    if joint.get("type") == "fixed" or limit is None:
        return None
    try:
        return float(limit.get("lower", 0)), float(limit.get("upper", 0))
    except ValueError:
        rospy.logwarn("robot_description: the limits of joint %s are no numbers; defaults are taken.", joint.get("name"))
        return None


def getJointLimits(name, joint_defaults, default_min=-150, default_max=150):
    """(min, max) of a joint, rad or m: those of its parameters below /arbotix, else of its description, else the defaults.

    :param name: the joint's
    :param joint_defaults: what getJointsFromURDF() has found
    :param default_min: degrees
    :param default_max: degrees
    """
    return _limit(name, joint_defaults, "min", default_min), _limit(name, joint_defaults, "max", default_max)


def _limit(name, joint_defaults, end, default):
    position = _parameter("/arbotix/joints/%s/%s_position" % (name, end))
    if is_number(position):
        return position
    for group in ("joints", "dynamixels"):
        angle = _parameter("/arbotix/%s/%s/%s_angle" % (group, name, end))
        if is_number(angle):
            return radians(angle)
    return joint_defaults.get(name, {}).get(end, radians(default))


def _parameter(name):
    """None where it, or the master, is not there."""
    try:
        return rospy.get_param(name)
    except (KeyError, OSError):
        return None
