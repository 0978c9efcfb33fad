"""ir_ranger.py and max_sonar.py: what an analogue pin of the board reads, as sensor_msgs/Range."""

from __future__ import annotations

import sys

import node_signals
import rospy
from arbotix_msgs.msg import Analog
from arbotix_msgs.srv import SetupChannel, SetupChannelRequest
from node_signals.parameters import REQUIRED, ParameterError, get
from sensor_msgs.msg import Range

from .sensors import BY_TYPE, GP2D12, MaxSonar, SharpIR

_BITS = 2  # the board tells 8 bits of the 10 that the curves are of


def _whole(name: str, low: int, high: int, default=REQUIRED) -> int:
    """Parameter ``name``, a whole number from ``low`` to ``high``. :raises ParameterError: it is none"""
    value = get(name, default)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or value != int(value) or not low <= value <= high:
        raise ParameterError(f"parameter {rospy.resolve_name(name)} must be a whole number from {low} to {high}, it is {value!r}")
    return int(value)


class Ranger:
    """Asks the board to tell ~pin as ~name, ~rate (10) times a second, and publishes ``topic``. Waits for the board."""

    def __init__(self, sensor: SharpIR | MaxSonar, topic: str) -> None:
        request = SetupChannelRequest(topic_name=get("~name", REQUIRED, str), pin=_whole("~pin", 0, 255), rate=_whole("~rate", 1, 255, 10))
        self._sensor = sensor
        self._publisher = rospy.Publisher(topic, Range, queue_size=5)
        rospy.wait_for_service("arbotix/SetupAnalogIn")
        rospy.ServiceProxy("arbotix/SetupAnalogIn", SetupChannel)(request)
        rospy.Subscriber("arbotix/" + request.topic_name, Analog, self._convert)

    def _convert(self, message: Analog) -> None:
        sensor = self._sensor
        out = Range(
            radiation_type=sensor.radiation_type, field_of_view=sensor.field_of_view, min_range=sensor.min_range, max_range=sensor.max_range
        )
        out.header.stamp = rospy.Time.now()
        out.range = sensor.convert(message.value << _BITS)
        self._publisher.publish(out)


def _run(name: str, begin) -> None:
    node_signals.init_node(name)
    try:
        begin()
    except ParameterError as error:
        rospy.logfatal("%s cannot start: %s.", rospy.get_name(), error)
        sys.exit(1)
    except rospy.ROSException:  # it ends before the board is there
        return
    node_signals.spin()


def ir_ranger() -> None:
    """~type: GP2D12 (0.1 to 0.8 m; any other name as well, as upstream), A02YK or long (1.5 m), A710YK or ultralong (5.5 m)."""
    _run("ir_ranger", lambda: Ranger(BY_TYPE.get(get("~type", "GP2D12", str), GP2D12), "ir_range"))


def max_sonar() -> None:
    _run("max_sonar", lambda: Ranger(MaxSonar(), "sonar_range"))
