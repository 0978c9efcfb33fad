"""Small things that all parts of the driver use."""

import reprlib

import rospy
from node_signals.parameters import ParameterError, get, is_number, texts
from node_signals.rates import Spaced


def number(name, default=None, above=None):
    """A finite number from parameter `name`; without a default it is required.

    :param above: it must be greater
    :raises ParameterError: it is not there, or something else
    """
    value = get(name) if default is None else get(name, default)
    if not is_number(value, above=above):
        raise ParameterError(
            "parameter %s must be a number%s, it is %s"
            % (rospy.resolve_name(name), "" if above is None else " above %g" % above, reprlib.repr(value))
        )
    return value


def names(name):
    """A required list of names, parameter `name`. :raises ParameterError: it is not there, or something else"""
    return texts("parameter " + rospy.resolve_name(name), get(name), empty=True, shown=reprlib.repr)


#: m/s, rad/s or rad; what is beyond is no command
_LARGEST = 1e12


def usable(*values):
    """Whether these numbers can be a command; NaN and infinities cannot."""
    return all(abs(value) <= _LARGEST for value in values)


def every(rate):
    """A gate that opens `rate` times a s when asked often; the next time counts from the question that found it open."""
    return Spaced(rate, strict=True, last_ns=rospy.Time.now().to_nsec())
