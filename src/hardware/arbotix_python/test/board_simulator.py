"""An ArbotiX board on a pseudo-terminal: bus servos that jump to their goal, wheels with encoders, pins."""

import os
import select
import struct
import threading
import tty

from arbotix_python.ax12 import (
    AX_CONTROL_SETUP,
    AX_CONTROL_STAT,
    AX_CONTROL_WRITE,
    AX_PING,
    AX_READ_DATA,
    AX_SYNC_READ,
    AX_SYNC_WRITE,
    AX_WRITE_DATA,
    P_GOAL_POSITION_L,
    P_PRESENT_POSITION_L,
    P_PRESENT_TEMPERATURE,
    P_PRESENT_VOLTAGE,
)
from arbotix_python.packets import decode, encode

BOARD, EVERYONE = 253, 254
FRAMES_PER_POLL = 3  # speed-loop frames of 1/30 s between two readings of the encoders


class BoardSimulator(threading.Thread):
    """Runs until `close`. `port` is the device to open; the rest is what the driver has done to the board."""

    def __init__(self, servo_ids=(), encoders=(0, 0)):
        super().__init__(daemon=True)
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        self.port = os.ttyname(self._slave)
        self.registers = {index: bytearray(128) for index in (*servo_ids, BOARD)}
        for index in servo_ids:
            self.registers[index][P_PRESENT_POSITION_L : P_PRESENT_POSITION_L + 2] = struct.pack("<H", 512)
            self.registers[index][P_PRESENT_VOLTAGE] = 118
            self.registers[index][P_PRESENT_TEMPERATURE] = 31
        self.gains = None
        self.wheel_speeds = [(0, 0)]  # every set point, in order
        self.instructions = []
        self.mute = False  # a board that does not answer
        self._encoders = list(encoders)
        self._running = True
        self.start()

    def close(self):
        self._running = False
        self.join()
        os.close(self._master)
        os.close(self._slave)

    def run(self):
        while self._running:
            if select.select([self._master], [], [], 0.05)[0]:
                packet = decode(self._read)
                if packet:
                    self.instructions.append(packet)
                    self._obey(packet.id, packet.kind, packet.parameters)

    def _read(self, count):
        data = b""
        while len(data) < count and select.select([self._master], [], [], 0.05)[0]:
            data += os.read(self._master, count - len(data))
        return data

    def _answer(self, index, parameters=()):
        if not self.mute:
            os.write(self._master, encode(index, 0, list(parameters)))

    def _write(self, index, start, values):
        registers = self.registers[index]
        registers[start : start + len(values)] = bytes(values)
        if index != BOARD:
            registers[P_PRESENT_POSITION_L : P_PRESENT_POSITION_L + 2] = registers[P_GOAL_POSITION_L : P_GOAL_POSITION_L + 2]

    def _obey(self, index, instruction, parameters):
        if index == EVERYONE and instruction == AX_SYNC_WRITE:
            start, length = parameters[:2]
            for place in range(2, len(parameters), length + 1):
                self._write(parameters[place], start, parameters[place + 1 : place + 1 + length])
        elif index == EVERYONE and instruction == AX_SYNC_READ:
            start, length = parameters[:2]
            if all(servo in self.registers for servo in parameters[2:]):
                self._answer(BOARD, [byte for servo in parameters[2:] for byte in self.registers[servo][start : start + length]])
        elif index not in self.registers:
            return  # nobody there
        elif instruction == AX_READ_DATA:
            start, length = parameters
            self._answer(index, self.registers[index][start : start + length])
        elif instruction == AX_WRITE_DATA:
            self._write(index, parameters[0], parameters[1:])
            self._answer(index)
        elif instruction == AX_PING:
            self._answer(index)
        elif instruction == AX_CONTROL_SETUP:
            self.gains = parameters[1:]
            self._answer(index)
        elif instruction == AX_CONTROL_WRITE:
            self.wheel_speeds.append(struct.unpack("<hh", bytes(parameters[1:])))
            self._answer(index)
        elif instruction == AX_CONTROL_STAT:
            for wheel in (0, 1):
                moved = self._encoders[wheel] + FRAMES_PER_POLL * self.wheel_speeds[-1][wheel]
                self._encoders[wheel] = (moved + 2**31) % 2**32 - 2**31
            self._answer(index, struct.pack("<ll", *self._encoders))
