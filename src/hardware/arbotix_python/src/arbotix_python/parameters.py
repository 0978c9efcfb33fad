"""Small things that all parts of the driver use."""
import reprlib

import rospy
from node_signals.parameters import ParameterError, get, is_number, texts


def number(name, default=None, above=None):
    """A finite number from a parameter; without a default it is required.

    :param above: it must be greater
    :raises ParameterError: it is not there, or something else
    """
    value = get(name) if default is None else get(name, default)
    if not is_number(value, above=above):
        raise ParameterError("parameter %s must be a number%s, it is %s" % (
            rospy.resolve_name(name), "" if above is None else " above %g" % above, reprlib.repr(value)))
    return value


def names(name):
    """A required list of names. :raises ParameterError: it is not there, or something else"""
    return texts("parameter " + rospy.resolve_name(name), get(name), empty=True, shown=reprlib.repr)


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
