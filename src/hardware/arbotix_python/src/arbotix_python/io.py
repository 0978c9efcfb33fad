"""Single pins of the board, for programs that talk to it themselves: `device` is an ArbotiX, and update() is called often."""

import rospy

from . import channels


class DigitalServo(channels.DigitalOutput):
    """Subscribes ~<name> and drives the pin."""

    def __init__(self, name, pin, value, rate, device):
        super().__init__(device, name, pin, value, rate)
        device.setDigital(pin, value, 0)

    def update(self, now=None):
        super().update(now or rospy.Time.now())


class DigitalSensor(channels.DigitalInput):
    """Publishes ~<name>."""

    def __init__(self, name, pin, value, rate, device):
        super().__init__(device, name, pin, value, rate)

    def update(self, now=None):
        super().update(now or rospy.Time.now())


class AnalogSensor(channels.AnalogInput):
    """Publishes ~<name>, of `leng` bytes."""

    def __init__(self, name, pin, value, rate, leng, device):
        super().__init__(device, name, pin, value, rate, leng)

    def update(self, now=None):
        super().update(now or rospy.Time.now())
