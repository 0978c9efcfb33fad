"""Reads and writes all servos at their rates."""

import rospy
from arbotix_msgs.srv import Enable, EnableResponse, Relax, RelaxResponse

from .arbotix import word
from .ax12 import P_GOAL_POSITION_L, P_PRESENT_POSITION_L, P_PRESENT_VOLTAGE
from .controllers import Controller
from .parameters import every, number
from .servos import DynamixelServo, HobbyServo

HEALTH_EVERY = 5  # diagnostics between two readings of voltage and temperature


class ServoController(Controller):
    def __init__(self, device, name):
        super().__init__(device, name)
        self._dynamixels = [joint for joint in device.joints.values() if isinstance(joint, DynamixelServo)]
        self._hobby = [joint for joint in device.joints.values() if isinstance(joint, HobbyServo)]
        self._sync_read = rospy.get_param("~sync_read", True)
        self._sync_write = rospy.get_param("~sync_write", True)
        write_rate = number("~write_rate", 10.0, above=0)
        self._write_period = 1.0 / write_rate
        self._write = every(write_rate)
        self._read = every(number("~read_rate", 10.0, above=0))
        self._reports = 0
        rospy.Service(name + "/relax_all", Relax, self._relax_all)
        rospy.Service(name + "/enable_all", Enable, self._enable_all)

    def update(self, now):
        if not self.device.fake and self._read.due(now.to_nsec()):
            for servo, (low, high) in self._registers(P_PRESENT_POSITION_L):
                servo.measured(low + (high << 8))
        if self._write.due(now.to_nsec()):
            self._send([(servo, servo.next_ticks(self._write_period)) for servo in self._dynamixels])
            for servo in self._hobby:
                ticks = servo.next_ticks(self._write_period)
                if ticks is not None:
                    self.device.board.setServo(servo.id, ticks)

    def _registers(self, start):
        """Two bytes from register `start` on of each servo that answers: a list of (servo, [byte, byte])."""
        servos = [servo for servo in self._dynamixels if servo.readable]
        if not servos:
            return []
        if not self._sync_read:
            answers = [(servo, self.device.board.read(servo.id, start, 2)) for servo in servos]
            return [(servo, values) for servo, values in answers if values != -1]
        values = self.device.board.syncRead([servo.id for servo in servos], start, 2)
        return [(servo, values[2 * place : 2 * place + 2]) for place, servo in enumerate(servos)] if values else []

    def _send(self, goals):
        goals = [(servo.id, ticks) for servo, ticks in goals if ticks is not None]
        if goals and self._sync_write:
            self.device.board.syncWrite(P_GOAL_POSITION_L, [[index] + word(ticks) for index, ticks in goals])
        else:
            for index, ticks in goals:
                self.device.board.setPosition(index, ticks)

    def diagnostics(self):
        """No entry of its own: refreshes what the servos report."""
        if not self.device.fake and self._reports % HEALTH_EVERY == 0:
            for servo, (voltage, temperature) in self._registers(P_PRESENT_VOLTAGE):
                if voltage < 250 and temperature < 100:  # beyond that the answer is garbled
                    servo.voltage, servo.temperature = voltage / 10.0, temperature
        self._reports += 1

    def _relax_all(self, request):
        for servo in self._dynamixels:
            servo.relax(request)
        return RelaxResponse()

    def _enable_all(self, request):
        for servo in self._dynamixels:
            servo.enable(request)
        return EnableResponse(request.enable)
