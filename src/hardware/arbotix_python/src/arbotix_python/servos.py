"""Servo joints: angles in rad outside, ticks on the wire."""

import math

import rospy
from arbotix_msgs.srv import Enable, EnableResponse, Relax, RelaxResponse, SetSpeed, SetSpeedResponse
from diagnostic_msgs.msg import DiagnosticStatus
from std_msgs.msg import Float64

from .controllers import status
from .joints import Joint
from .parameters import number, usable

WARM, HOT = 50, 60  # degrees C


class Servo(Joint):
    """A joint that goes to a commanded angle at no more than its greatest speed."""

    TICKS: int  # defaults, of each kind: ticks over the range
    RANGE: float  # degrees
    MAX_SPEED: float  # degrees per s

    def __init__(self, device, name):
        super().__init__(device, name)
        prefix = "~joints/%s/" % name
        self.id = int(number(prefix + "id"))
        self.ticks = number(prefix + "ticks", self.TICKS, above=0)
        self.neutral = number(prefix + "neutral", self.default_neutral())
        span = math.radians(number(prefix + "range", self.default_range(), above=0))
        self.rad_per_tick = span / self.ticks
        self.max_speed = math.radians(number(prefix + "max_speed", self.MAX_SPEED, above=0))
        self.sign = -1 if rospy.get_param(prefix + "invert", False) else 1
        # Until something is known, position (rad) and velocity (rad/s) are 0.
        self._desired = 0.0
        self._sent = 0.0  # angle of the last set point
        self._moving = False  # the set point is not yet at the desired angle
        rospy.Subscriber(name + "/command", Float64, self._command)

    def default_neutral(self):
        raise NotImplementedError

    def default_range(self):
        return self.RANGE

    def to_ticks(self, angle):
        """The whole tick nearest to an angle, within the servo's range."""
        return min(max(int(round(self.neutral + self.sign * angle / self.rad_per_tick)), 0), self.ticks - 1)

    def to_angle(self, ticks):
        """rad, for a position in `ticks`."""
        return self.sign * (ticks - self.neutral) * self.rad_per_tick

    def _command(self, message):
        if not usable(message.data):
            rospy.logerr("%s/command: %s is no angle; ignored.", self.name, message.data)
        elif not (self.controller and self.controller.active()):
            self.go_to(message.data)

    def go_to(self, angle):
        """Sets the desired angle."""
        self._desired = angle
        self._moving = True

    def next_ticks(self, period):
        """The set point of this write cycle of `period` s, or None when there is nothing to send."""
        if not self._moving:
            if self.device.fake:
                self.velocity, self.last = 0.0, rospy.Time.now()
            return None
        most = self.max_speed * period
        ticks = self.to_ticks(self._sent + min(max(self._desired - self._sent, -most), most))
        goal = self.to_ticks(self._desired)
        if ticks == self.to_ticks(self._sent) and ticks != goal:
            ticks += 1 if goal > ticks else -1  # slower than one tick a cycle would never arrive
        self._sent = self.to_angle(ticks)
        self._moving = ticks != goal
        if self.device.fake:
            self.measured(ticks)
            return None
        return ticks

    def measured(self, ticks):
        """Takes a position reading, `ticks`."""
        now = rospy.Time.now()
        elapsed = (now - self.last).to_sec()
        before, self.position = self.position, self.to_angle(ticks)
        if elapsed > 0:
            self.velocity = (self.position - before) / elapsed
        self.last = now

    def diagnostics(self):
        return status(self.name, Position=self.position)

    # What programs of others call these.

    def angleToTicks(self, angle):
        return self.to_ticks(angle)

    def ticksToAngle(self, ticks):
        return self.to_angle(ticks)

    def interpolate(self, frame):
        return self.next_ticks(1.0 / frame)

    def setCurrentFeedback(self, raw_data):
        self.measured(raw_data)

    def setControlOutput(self, position):
        """Ticks; -1 where no commands are taken."""
        self.go_to(position)
        return self.to_ticks(position) if self.takes_commands() else -1

    def takes_commands(self):
        return True

    def getDiagnostics(self):
        return self.diagnostics()


class DynamixelServo(Servo):
    """A servo on the bus."""

    TICKS, RANGE, MAX_SPEED = 1024, 300.0, 684.0

    def __init__(self, device, name):
        super().__init__(device, name)
        self.readable = rospy.get_param("~joints/%s/readable" % name, True)
        self.voltage = self.temperature = 0.0
        self._enabled = True  # takes commands
        self._holding = False  # torque is on
        self._overheated = False
        self._reads = self._errors = 0
        rospy.Service(name + "/relax", Relax, self.relax)
        rospy.Service(name + "/enable", Enable, self.enable)
        rospy.Service(name + "/set_speed", SetSpeed, self._set_speed)

    def default_neutral(self):
        return self.ticks / 2

    def default_range(self):
        return 360.0 if self.ticks == 4096 else self.RANGE

    def go_to(self, angle):
        if self._enabled:
            self._holding = True
            super().go_to(angle)

    def measured(self, ticks):
        self._reads += 1
        if not 0 <= ticks < self.ticks:
            self._errors += 1
            return
        super().measured(ticks)
        if not self._holding:
            self._sent = self.position  # it was moved by hand: the next motion starts here

    def takes_commands(self):
        return self._enabled

    def _let_go(self):
        if not self.device.fake:
            self.device.board.disableTorque(self.id)
        self._moving = self._holding = False

    def relax(self, _request):
        self._let_go()
        return RelaxResponse()

    def enable(self, request):
        self._enabled = request.enable
        if not request.enable:
            self._let_go()
        return EnableResponse(self._enabled)

    def _set_speed(self, request):
        if not usable(request.speed):
            raise rospy.ServiceException("%s is no speed" % request.speed)
        if not self.device.fake:
            ticks = int(self.ticks * request.speed / self.max_speed)
            self.device.board.setSpeed(self.id, min(max(ticks, 1), self.ticks - 1))  # 0 would mean: no limit
        return SetSpeedResponse()

    def diagnostics(self):
        self._overheated = self._overheated or self.temperature > HOT
        if self._overheated:
            level, message = DiagnosticStatus.ERROR, "OVERHEATED, SHUTDOWN"
        elif self.temperature > WARM:
            level, message = DiagnosticStatus.WARN, "OVERHEATING"
        else:
            level, message = DiagnosticStatus.OK, "OK"
        return status(
            self.name,
            message,
            level,
            Position=self.position,
            Temperature=self.temperature,
            Voltage=self.voltage,
            Reads=self._reads,
            Error_Rate="%.1f%%" % (100.0 * self._errors / max(1, self._reads)),
            Torque="ON" if self._holding else "OFF",
        )


class HobbyServo(Servo):
    """A servo on a pulse-width output of the board; nothing can be read back."""

    TICKS, RANGE, MAX_SPEED = 2000, 180.0, 90.0
    NEUTRAL = 1500  # microseconds

    def default_neutral(self):
        return self.NEUTRAL

    def to_ticks(self, angle):
        # a tick is a microsecond of pulse, and pulses are 500 to 2500 long
        return min(max(int(round(self.neutral + self.sign * angle / self.rad_per_tick)), 500), 2500)

    def next_ticks(self, period):
        ticks = super().next_ticks(period)
        if ticks is not None:
            self.position = self._sent
        return ticks
