"""Single pins of the board as topics."""

import rospy
from arbotix_msgs.msg import Analog, Digital

from .parameters import every


class DigitalOutput:
    """Subscribes ~<name> and drives the pin."""

    def __init__(self, board, name, pin, value, rate, length=1):
        self._board = board
        self._pin = pin
        self._value, self._direction = value, 0
        self._every = every(rate)
        rospy.Subscriber("~" + name, Digital, self._command)

    def _command(self, message):
        self._value, self._direction = message.value, message.direction

    def update(self, now):
        if self._every.due(now.to_nsec()):
            self._board.setDigital(self._pin, self._value, self._direction)


class DigitalInput:
    """Publishes ~<name>."""

    TYPE = Digital

    def __init__(self, board, name, pin, value, rate, length=1):
        self._board = board
        self._pin = pin
        self._length = length
        self._every = every(rate)
        self._publisher = rospy.Publisher("~" + name, self.TYPE, queue_size=5)
        board.setDigital(pin, value, 0)

    def read(self):
        return self._board.getDigital(self._pin)

    def update(self, now):
        if not self._every.due(now.to_nsec()):
            return
        value = self.read()
        if value >= 0:
            message = self.TYPE(value=value)
            message.header.stamp = now
            self._publisher.publish(message)


class AnalogInput(DigitalInput):
    TYPE = Analog

    def read(self):
        return self._board.getAnalog(self._pin, self._length)


PARAMETERS = {"digital_servos": DigitalOutput, "digital_sensors": DigitalInput, "analog_sensors": AnalogInput}
SERVICES = {"~SetupDigitalOut": DigitalOutput, "~SetupDigitalIn": DigitalInput, "~SetupAnalogIn": AnalogInput}
