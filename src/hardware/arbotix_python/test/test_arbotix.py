"""The serial protocol, and ArbotiX against a board on a pseudo-terminal."""

import io
import os
import pathlib
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from arbotix_python.arbotix import ArbotiX, ArbotiXException  # noqa: E402
from arbotix_python.ax12 import P_GOAL_POSITION_L, P_PRESENT_POSITION_L, P_PRESENT_VOLTAGE  # noqa: E402
from arbotix_python.diff_controller import ticks_moved  # noqa: E402
from arbotix_python.packets import Packet, decode, encode  # noqa: E402
from arbotix_python.terminal import Terminal  # noqa: E402
from board_simulator import BOARD, BoardSimulator  # noqa: E402

BYTES = st.integers(0, 255)


def test_known_packet():
    """The example of every Dynamixel manual: set the goal position of servo 1 to 512."""
    assert encode(1, 3, [30, 0, 2]) == bytes([0xFF, 0xFF, 1, 5, 3, 30, 0, 2, 0xD6])


@given(st.integers(0, 254), BYTES, st.lists(BYTES, max_size=30), st.lists(st.integers(0, 254), max_size=5))
def test_decode_finds_the_packet(index, kind, parameters, noise):
    stream = io.BytesIO(bytes(noise) + encode(index, kind, parameters))
    assert decode(stream.read) == Packet(index, kind, parameters)


@given(st.lists(BYTES, min_size=1, max_size=10), st.data())
def test_decode_refuses_damage(parameters, data):
    packet = bytearray(encode(7, 0, parameters))
    place = data.draw(st.integers(4, len(packet) - 1))
    packet[place] ^= data.draw(st.integers(1, 255))
    assert decode(io.BytesIO(bytes(packet)).read) is None


@given(st.lists(BYTES, max_size=10), st.data())
def test_decode_refuses_the_incomplete(parameters, data):
    packet = encode(7, 0, parameters)
    assert decode(io.BytesIO(packet[: data.draw(st.integers(0, len(packet) - 1))]).read) is None


def test_counter_wraps():
    assert ticks_moved(-(2**31) + 4, 2**31 - 6) == 10
    assert ticks_moved(2**31 - 6, -(2**31) + 4) == -10


@pytest.fixture
def simulator():
    board = BoardSimulator(servo_ids=(1, 2, 9))
    yield board
    board.close()


@pytest.fixture
def arbotix(simulator):
    device = ArbotiX(simulator.port, timeout=10.0)
    yield device
    device.closePort()


def test_servo_registers(arbotix):
    assert arbotix.getPosition(1) == 512
    assert arbotix.setPosition(1, 700) == 0
    assert arbotix.getPosition(1) == 700
    assert arbotix.setSpeed(2, 300) == 0 and arbotix.getGoalSpeed(2) == 300
    assert (arbotix.getVoltage(9), arbotix.getTemperature(9)) == (11.8, 31)


def test_nobody_there(arbotix):
    arbotix._ser.timeout = 0.05
    assert arbotix.getPosition(5) == -1
    assert arbotix.setPosition(5, 1) == -1
    assert arbotix.syncRead([1, 5], P_PRESENT_VOLTAGE, 2) is None


def test_sync(arbotix):
    arbotix.syncWrite(P_GOAL_POSITION_L, [[1, 0x10, 1], [9, 0x20, 2]])
    assert arbotix.syncRead([9, 1, 2], P_PRESENT_POSITION_L, 2) == [0x20, 2, 0x10, 1, 0, 2]


def test_pins(arbotix, simulator):
    simulator.registers[BOARD][ArbotiX.REG_DIGITAL_IN0 + 1] = 0b100
    assert (arbotix.getDigital(10), arbotix.getDigital(9), arbotix.getDigital(32)) == (255, 0, -1)
    simulator.registers[BOARD][ArbotiX.ANA_BASE + 3] = 77
    assert arbotix.getAnalog(3) == 77
    for value, direction, written in ((0, 255, 1), (255, 255, 3), (255, 0, 2), (0, 0, 0)):
        arbotix.setDigital(4, value, direction)
        assert simulator.registers[BOARD][ArbotiX.REG_DIGITAL_OUT0 + 4] == written
    assert arbotix.setServo(2, 1500) == 0 and arbotix.setServo(2, 400) == -1
    assert simulator.registers[BOARD][ArbotiX.SERVO_BASE + 4] == 1500 % 256


def test_base(arbotix, simulator):
    arbotix.setupBase(12, 12, 0, 50)
    assert simulator.gains == [12, 12, 0, 50]
    arbotix.setBaseSpeed(-5, 7)
    assert arbotix.getBaseEncoders() == (-15, 21)


def test_missing_port_is_one_clear_error():
    with pytest.raises(ArbotiXException, match="/dev/nowhere"):
        ArbotiX("/dev/nowhere")


def test_unplugged(simulator):
    device = ArbotiX(simulator.port, timeout=0.1)
    os.close(device._ser.fd)
    with pytest.raises(ArbotiXException):
        device.getPosition(1)


def test_terminal(arbotix):
    arbotix._ser.timeout = 1.0  # who answers must have the time to
    terminal = Terminal(arbotix)
    assert terminal.run(["ls", "3"]) == "1 2"
    assert terminal.run(["set", "pos", "2", "600"]) == "OK"
    assert terminal.run(["get", "pos", "2"]) == "600"
    assert terminal.run(["get", "temp", "5"]) == "no answer"
    with pytest.raises(ValueError):
        terminal.run(["get", "pos"])
    with pytest.raises(ValueError, match="12345"):
        terminal.run(["baud", "12345"])
