"""Small things that all parts of the driver use."""
import rospy


class ConfigurationError(Exception):
    """A parameter is missing or makes no sense; the text says which."""


def require(name):
    """A parameter that has no default."""
    if not rospy.has_param(name):
        raise ConfigurationError("parameter %s is not set" % rospy.resolve_name(name))
    return rospy.get_param(name)


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
