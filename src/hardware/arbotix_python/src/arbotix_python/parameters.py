"""Small things that all parts of the driver use."""
import math
import reprlib

import rospy


class ConfigurationError(Exception):
    """A parameter is missing or makes no sense; the text says which."""


def require(name):
    """A parameter that has no default."""
    if not rospy.has_param(name):
        raise ConfigurationError("parameter %s is not set" % rospy.resolve_name(name))
    return rospy.get_param(name)


def number(name, default=None, above=-math.inf):
    """A finite number from a parameter; without a default it is required.

    :param above: it must be greater
    :raises ConfigurationError: it is not there, or something else
    """
    value = require(name) if default is None else rospy.get_param(name, default)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not above < value < math.inf:
        raise ConfigurationError("parameter %s must be a number%s, it is %s" % (
            rospy.resolve_name(name), "" if above == -math.inf else " above %g" % above, reprlib.repr(value)))
    return value


def texts(name):
    """A required list of texts. :raises ConfigurationError: it is not there, or something else"""
    value = require(name)
    if not isinstance(value, list) or not all(isinstance(entry, str) for entry in value):
        raise ConfigurationError("parameter %s must be a list of names, it is %s" % (rospy.resolve_name(name),
                                                                                    reprlib.repr(value)))
    return value


#: m/s, rad/s or rad; what is beyond is no command
_LARGEST = 1e12


def usable(*values):
    """Whether these numbers can be a command; NaN and infinities cannot."""
    return all(abs(value) <= _LARGEST for value in values)


class Every:
    """True once per period when asked often. The next time counts from the call that was due."""

    def __init__(self, rate):
        self._period = rospy.Duration(1.0 / rate)
        self._next = rospy.Time.now() + self._period

    def due(self, now):
        if now <= self._next:
            return False
        self._next = now + self._period
        return True
