"""A linear actuator: a motor on three pins, with an analogue sensor or an incremental encoder."""

import bisect
import math
import struct

import rospy
from std_msgs.msg import Float64
from std_srvs.srv import Empty, EmptyResponse

from .arbotix import BOARD, word
from .controllers import Controller, status
from .joints import Joint
from .parameters import ParameterError, every, get, number

NEAR = 0.01  # m, close enough to stop the motor


class LinearJoint(Joint):
    """A joint in metres whose readings are calibrated by a table."""

    def __init__(self, device, name):
        super().__init__(device, name)
        prefix = "~joints/%s/" % name
        self._low = number(prefix + "min_position", 0.0)
        self._high = number(prefix + "max_position", 0.5)
        table = rospy.get_param(prefix + "calibration_data", {-1: -1, 1: 1})
        try:
            self._table = sorted((int(reading), float(position)) for reading, position in table.items())
        except (AttributeError, TypeError, ValueError):
            raise ParameterError(
                "%scalibration_data must map readings, whole numbers, to positions in m" % rospy.resolve_name(prefix)
            ) from None
        if len(self._table) < 2:
            raise ParameterError("%scalibration_data needs two readings at least" % rospy.resolve_name(prefix))
        self._desired = 0.0
        self.moving = False
        rospy.Subscriber(name + "/command", Float64, lambda message: self.go_to(message.data))

    def go_to(self, position):
        """Go to `position`, m; one out of the joint's range is told and ignored."""
        if not self._low <= position <= self._high:  # also false for NaN
            rospy.logerr("%s: requested position %s is out of range %s to %s; ignored.", self.name, position, self._low, self._high)
        elif self.device.fake:
            self.position = position
        else:
            self._desired, self.moving = position, True

    def direction(self):
        """Which way the motor must run: 1, -1 or 0."""
        error = self._desired - self.position
        if not self.moving or abs(error) <= NEAR:
            self.moving = False
            return 0
        return int(math.copysign(1, error))

    def measured(self, reading):
        """Takes a `reading` of the sensor, in the unit of calibration_data."""
        readings = [entry[0] for entry in self._table]
        if not readings[0] <= reading <= readings[-1]:
            rospy.logerr("%s: reading %s is outside calibration_data.", self.name, reading)
            return
        place = min(max(bisect.bisect_right(readings, reading), 1), len(readings) - 1)
        (low, start), (high, end) = self._table[place - 1 : place + 1]
        now, before = rospy.Time.now(), self.position
        self.position = start + (end - start) * (reading - low) / (high - low)
        elapsed = (now - self.last).to_sec()
        if elapsed > 0:
            self.velocity = (self.position - before) / elapsed
        self.last = now

    def diagnostics(self):
        return status(self.name, "Moving" if self.moving else "OK", Position=self.position)

    # What programs of others call these.

    def interpolate(self, frame):
        return self.direction()

    def setCurrentFeedback(self, raw_data):
        self.measured(raw_data)

    def setControlOutput(self, position):
        self.go_to(position)

    def getDiagnostics(self):
        return self.diagnostics()


class LinearControllerAbsolute(Controller):
    """With an analogue sensor of the position."""

    def __init__(self, device, name):
        super().__init__(device, name)
        prefix = "~controllers/%s/" % name
        self._motor = [int(number(prefix + key, default)) for key, default in (("motor_a", 29), ("motor_b", 30), ("motor_pwm", 31))]
        self._analog = int(number(prefix + "feedback", 0))
        self._every = every(number(prefix + "rate", 10.0, above=0))
        joint = get(prefix + "joint")
        if joint not in device.joints or not isinstance(device.joints[joint], LinearJoint):
            raise ParameterError("joint %s is not among the joints of type calibrated_linear" % joint)
        self._joint = device.joints[joint]
        self._running: int | None = 0
        self._reading = 0
        rospy.loginfo("Started %s (%s).", type(self).__name__, name)

    def startup(self):
        if not self.device.fake:
            self._joint.measured(self.read_position())

    def update(self, now):
        if self.device.fake or not self._every.due(now.to_nsec()) or not self._joint.moving:
            return
        self._reading = self.read_position()
        self._joint.measured(self._reading)
        self.run(self._joint.direction())

    def run(self, direction):
        """Runs the motor up (`direction` 1), down (-1) or not at all (0)."""
        if direction == self._running:
            return
        self._running = direction
        a, b, pwm = self._motor
        if direction:
            self.device.board.setDigital(a, int(direction < 0))
            self.device.board.setDigital(b, int(direction > 0))
        self.device.board.setDigital(pwm, int(direction != 0))

    def read_position(self):
        return self.device.board.getAnalog(self._analog)

    def shutdown(self):
        if not self.device.fake:
            self._running = None
            self.run(0)

    def diagnostics(self):
        return status(self.name, **({} if self.device.fake else {"Encoder_Reading": self._reading}))


class LinearControllerIncremental(LinearControllerAbsolute):
    """With an encoder that the board counts, zeroed at the upper stop."""

    pause = True
    POSITION_L, DIRECTION = 100, 102  # registers of the board
    ZEROING = 15  # s at most

    def __init__(self, device, name):
        super().__init__(device, name)
        rospy.Service(name + "/zero", Empty, self._zero_service)

    def startup(self):
        if not self.device.fake:
            self._zero()

    def run(self, direction):
        if direction and direction != self._running:
            self.device.board.write(BOARD, self.DIRECTION, [int(direction > 0)])
        super().run(direction)

    def read_position(self):
        values = self.device.board.read(BOARD, self.POSITION_L, 2)
        return self._reading if values == -1 else struct.unpack("<h", bytes(values))[0]

    def _zero(self):
        rospy.loginfo("%s: zeroing encoder", self.name)
        self.run(1)
        before = None
        for _ in range(self.ZEROING):
            reading = self.read_position()
            if reading == before or rospy.is_shutdown():
                break
            before = reading
            rospy.sleep(1)
        self.run(0)
        self.device.board.write(BOARD, self.POSITION_L, word(0))
        self._joint.measured(0)

    def _zero_service(self, _request):
        if not self.device.fake:
            self._zero()
        return EmptyResponse()
