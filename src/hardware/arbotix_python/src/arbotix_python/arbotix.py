"""Talking to an ArbotiX board over its serial port. The method names are those that ArbotiX programs use."""

import struct
import termios
import threading

from .ax12 import (
    AX_CONTROL_SETUP,
    AX_CONTROL_STAT,
    AX_CONTROL_WRITE,
    AX_READ_DATA,
    AX_SYNC_READ,
    AX_SYNC_WRITE,
    AX_WRITE_DATA,
    P_BAUD_RATE,
    P_CCW_ANGLE_LIMIT_L,
    P_GOAL_POSITION_L,
    P_GOAL_SPEED_L,
    P_LED,
    P_MOVING,
    P_PRESENT_POSITION_L,
    P_PRESENT_SPEED_L,
    P_PRESENT_TEMPERATURE,
    P_PRESENT_VOLTAGE,
    P_RETURN_LEVEL,
    P_TORQUE_ENABLE,
)
from .packets import decode, encode

BOARD = 253  # id of the board itself
EVERYONE = 254  # id that all devices listen to
BASE_CONTROLLER = 10  # number of the differential drive among the board's controllers


class ArbotiXException(Exception):
    """The serial connection is broken."""


def word(value):
    """The two bytes of a register pair that holds `value`, low one first."""
    return [value & 0xFF, value >> 8 & 0xFF]


class ArbotiX:
    """A board, or a chain of Dynamixel servos without one. Thread-safe.

    `port` is its serial device, `baud` the speed of that, bit/s; `open_port` False leaves it closed.
    Getters return -1 when no valid answer comes within `timeout` (s).
    """

    FORWARD, BACKWARD = 0, 1
    LOW, HIGH = 0, 0xFF
    INPUT, OUTPUT = 0, 0xFF

    # registers of the board
    REG_DIGITAL_IN0 = 5
    REG_RESCAN = 15
    ANA_BASE = 18
    SERVO_BASE = 26
    REG_DIGITAL_OUT0 = 47

    def __init__(self, port="/dev/ttyUSB0", baud=115200, timeout=0.1, open_port=True):
        import serial  # here, so that nobody needs it who only simulates a board

        self._serial_error = serial.SerialException
        self._mutex = threading.Lock()
        self._ser = serial.Serial()
        self._ser.port, self._ser.baudrate, self._ser.timeout = port, baud, timeout
        self.error = 0  # error bits of the last answer
        if open_port:
            self.openPort()

    def openPort(self):
        self._ser.close()
        self._guarded(self._ser.open)

    def closePort(self):
        self._ser.close()

    def _guarded(self, call, *arguments):
        try:
            return call(*arguments)
        except (self._serial_error, OSError, termios.error) as error:
            raise ArbotiXException(error) from None

    def execute(self, index, ins, params, ret=True):
        """Sends instruction `ins` with the bytes `params` to the servo or board `index` (its id on the bus).

        Returns the list of bytes answered, None without a valid answer or with ret=False.
        """
        with self._mutex:
            self._guarded(self._ser.reset_input_buffer)
            self._guarded(self._ser.write, encode(index, ins, params))
            packet = self._guarded(decode, self._ser.read) if ret else None
        if packet is None:
            return None
        self.error = packet.kind
        return packet.parameters

    def read(self, index, start, length):
        """`length` bytes of servo `index` from register `start` on, as a list; -1 without an answer."""
        values = self.execute(index, AX_READ_DATA, [start, length])
        return values if values is not None and len(values) == length else -1

    def write(self, index, start, values):
        """Writes the bytes `values` to servo `index` from register `start` on; returns the error bits of the answer, -1 without one."""
        answer = self.execute(index, AX_WRITE_DATA, [start] + list(values))
        return -1 if answer is None else self.error

    def syncWrite(self, start, values):
        """Writes to many servos at once, from register `start` on: `values` is a list of [id, byte, byte, ...], all of one length."""
        data = [byte for servo in values for byte in servo]
        self.execute(EVERYONE, AX_SYNC_WRITE, [start, len(values[0]) - 1] + data, ret=False)

    def syncRead(self, servos, start, length):
        """Reads `length` registers from `start` on of many `servos` (ids): one list of bytes, servo after servo; None without an answer."""
        values = self.execute(EVERYONE, AX_SYNC_READ, [start, length] + list(servos))
        return values if values is not None and len(values) == length * len(servos) else None

    def _number(self, index, start, size):
        values = self.read(index, start, size)
        return -1 if values == -1 else sum(value << 8 * place for place, value in enumerate(values))

    # servos

    def setBaud(self, index, baud):
        """Sets the bus speed of servo `index` to the divider `baud`: 2000000 / (baud + 1) bits per second."""
        return self.write(index, P_BAUD_RATE, [baud])

    def getReturnLevel(self, index):
        """What servo `index` answers; see setReturnLevel."""
        return self._number(index, P_RETURN_LEVEL, 1)

    def setReturnLevel(self, index, value):
        """What servo `index` answers: `value` 0 nothing, 1 reads alone, 2 everything."""
        return self.write(index, P_RETURN_LEVEL, [value])

    def enableTorque(self, index):
        """Lets servo `index` hold its position."""
        return self.write(index, P_TORQUE_ENABLE, [1])

    def disableTorque(self, index):
        """Lets go of servo `index`."""
        return self.write(index, P_TORQUE_ENABLE, [0])

    def setLed(self, index, value):
        """Switches the light of servo `index` on (`value` 1) or off (0)."""
        return self.write(index, P_LED, [value])

    def setPosition(self, index, value):
        """Sends servo `index` to `value`, in ticks of its encoder."""
        return self.write(index, P_GOAL_POSITION_L, word(value))

    def setSpeed(self, index, value):
        """Bounds the speed of servo `index`: `value` 1..1023 of the servo's own unit, 0 is as fast as it can."""
        return self.write(index, P_GOAL_SPEED_L, word(value))

    def getPosition(self, index):
        """Where servo `index` is, in ticks of its encoder."""
        return self._number(index, P_PRESENT_POSITION_L, 2)

    def getSpeed(self, index):
        """How fast servo `index` turns, in its own unit."""
        return self._number(index, P_PRESENT_SPEED_L, 2)

    def getGoalSpeed(self, index):
        """How fast servo `index` may turn, in its own unit."""
        return self._number(index, P_GOAL_SPEED_L, 2)

    def getVoltage(self, index):
        """The supply of servo `index`, in volts."""
        value = self._number(index, P_PRESENT_VOLTAGE, 1)
        return value if value == -1 else value / 10.0

    def getTemperature(self, index):
        """Of servo `index`, in degrees Celsius."""
        return self._number(index, P_PRESENT_TEMPERATURE, 1)

    def isMoving(self, index):
        """Whether servo `index` moves; True also when it does not answer."""
        return self._number(index, P_MOVING, 1) != 0

    def enableWheelMode(self, index):
        """Lets servo `index` turn round and round."""
        self.write(index, P_CCW_ANGLE_LIMIT_L, [0, 0])

    def disableWheelMode(self, index, resolution=10):
        """Turns servo `index` back to angles; `resolution` is the encoder's number of bits (12 for MX servos)."""
        self.write(index, P_CCW_ANGLE_LIMIT_L, word(2**resolution - 1))

    def setWheelSpeed(self, index, direction, speed):
        """Turns servo `index`, in wheel mode, in `direction` FORWARD or BACKWARD at `speed` 0..1023."""
        speed = min(speed, 1023)
        self.write(index, P_GOAL_SPEED_L, word(speed if direction == self.FORWARD else speed + 1024))

    # the board

    def rescan(self):
        """Makes the board look for servos again."""
        self.write(BOARD, self.REG_RESCAN, [1])

    def getAnalog(self, index, leng=1):
        """Analogue pin `index` (0..7) in `leng` bytes."""
        return self._number(BOARD, self.ANA_BASE + int(index), leng)

    def getDigital(self, index):
        """Digital pin `index` (0..31): 0 or 255."""
        if not 0 <= index < 32:
            return -1
        bits = self._number(BOARD, self.REG_DIGITAL_IN0 + index // 8, 1)
        return bits if bits == -1 else 255 * (bits >> index % 8 & 1)

    def setDigital(self, index, value, direction=0xFF):
        """Sets digital pin `index` (0..31): `value` is the output's level or, with `direction` 0, the pull-up of an input."""
        if not 0 <= index < 32:
            return -1
        self.write(BOARD, self.REG_DIGITAL_OUT0 + int(index), [(1 if direction > 0 else 0) | (2 if value > 0 else 0)])
        return 0

    def setServo(self, index, value):
        """Sets hobby servo `index` (0..7) to pulses of `value` microseconds, 500..2500; 0 switches it off."""
        if not 0 <= index < 8 or not (value == 0 or 500 <= value <= 2500):
            return -1
        self.write(BOARD, self.SERVO_BASE + 2 * index, word(value))
        return 0

    # the board's differential drive

    def setupBase(self, kp, kd, ki, ko):
        """Sets the gains of the wheels' speed loop, one byte each: proportional `kp`, derivative `kd`, integral `ki`, divider `ko`."""
        self.execute(BOARD, AX_CONTROL_SETUP, [BASE_CONTROLLER, kp, kd, ki, ko])

    def setBaseSpeed(self, left, right):
        """Sets the speeds of the wheels, `left` and `right`, in encoder ticks per 1/30 s, signed 16 bit."""
        self.execute(BOARD, AX_CONTROL_WRITE, [BASE_CONTROLLER] + word(left) + word(right))

    def getBaseEncoders(self):
        """(left, right) encoder counts, signed 32 bit; None without an answer."""
        values = self.execute(BOARD, AX_CONTROL_STAT, [BASE_CONTROLLER])
        return struct.unpack("<ll", bytes(values)) if values is not None and len(values) == 8 else None
