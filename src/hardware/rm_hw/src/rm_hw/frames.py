"""CAN frames of RoboMaster speed controllers, MIT mini cheetah drivers and the IMU board, packed and unpacked.

All identifiers are standard 11-bit ones, all frames have 8 data bytes unless stated otherwise.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from typing import NamedTuple

RM_COMMAND_IDS = (0x200, 0x1FF, 0x2FF)
CHEETAH_REPLY_ID = 0x000
COUNTS_PER_TURN = 8192

_INT16_MAX = 0x7FFF
_COMMAND = struct.Struct(">4h")
_FEEDBACK = struct.Struct(">HhhBB")
_IMU = struct.Struct("<3h")


class Feedback(NamedTuple):
    """What a C620, C610 or GM6020 reports.

    :ivar angle: rotor angle, 0..8191 counts a turn
    :ivar rpm: rotor speed
    :ivar current: torque current, counts (C620 16384 = 20 A, C610 10000 = 10 A)
    :ivar temperature: degrees Celsius, 0 on a C610
    """

    angle: int
    rpm: int
    current: int
    temperature: int


class CheetahReply(NamedTuple):
    """What an MIT driver reports, in counts."""

    motor_id: int
    position: int
    velocity: int
    effort: int


class ImuGyro(NamedTuple):
    """Angular velocity about x, y, z and temperature, in counts."""

    x: int
    y: int
    z: int
    temperature: int


class ImuAccel(NamedTuple):
    """Linear acceleration along x, y, z in counts; the camera trigger output and whether it is enabled."""

    x: int
    y: int
    z: int
    camera_trigger: bool
    trigger_enabled: bool


def command_slot(feedback_id: int) -> tuple[int, int]:
    """(command frame id, slot 0..3) that drives the motor reporting on ``feedback_id``.

    :raises ValueError: no RoboMaster motor reports on that id.
    """
    if 0x201 <= feedback_id <= 0x204:
        return 0x200, feedback_id - 0x201
    if 0x205 <= feedback_id <= 0x208:
        return 0x1FF, feedback_id - 0x205
    if 0x209 <= feedback_id <= 0x20B:
        return 0x2FF, feedback_id - 0x209
    raise ValueError(f"0x{feedback_id:03X} is no feedback id of a RoboMaster motor: 0x201..0x20B are")


def pack_command(counts: Sequence[int]) -> bytes:
    """Four int16 commands, ``counts``, big-endian. Values outside int16 are limited."""
    return _COMMAND.pack(*(max(-_INT16_MAX - 1, min(_INT16_MAX, int(c))) for c in counts))


def unpack_command(data: bytes) -> tuple[int, int, int, int]:
    """The four commands in ``data`` of a frame 0x200, 0x1FF or 0x2FF."""
    return _COMMAND.unpack(data)


def pack_feedback(feedback: Feedback) -> bytes:
    """The 8 bytes of ``feedback``."""
    return _FEEDBACK.pack(feedback.angle, feedback.rpm, feedback.current, feedback.temperature, 0)


def unpack_feedback(data: bytes) -> Feedback:
    """The feedback in ``data``. :raises ValueError: not 8 bytes, or an angle no encoder can report."""
    if len(data) != 8:
        raise ValueError(f"feedback frame has {len(data)} bytes instead of 8")
    angle, rpm, current, temperature, _ = _FEEDBACK.unpack(data)
    if angle >= COUNTS_PER_TURN:
        raise ValueError(f"feedback frame has angle {angle}: 0..{COUNTS_PER_TURN - 1} are possible")
    return Feedback(angle, rpm, current, temperature)


def _bits(value: float, width: int) -> int:
    return max(0, min((1 << width) - 1, int(value)))


def pack_cheetah_command(position: float, velocity: float, kp: float, kd: float, effort: float) -> bytes:
    """MIT command from values already in counts, most significant bit first.

    :param position: 16 bit.
    :param velocity, kp, kd, effort: 12 bit each.
    """
    word = _bits(position, 16)
    for value in (velocity, kp, kd, effort):
        word = word << 12 | _bits(value, 12)
    return word.to_bytes(8, "big")


def unpack_cheetah_command(data: bytes) -> tuple[int, int, int, int, int]:
    """(position, velocity, kp, kd, effort) in counts, of the 8 bytes ``data``."""
    word = int.from_bytes(data, "big")
    return word >> 48, word >> 36 & 0xFFF, word >> 24 & 0xFFF, word >> 12 & 0xFFF, word & 0xFFF


def pack_cheetah_reply(reply: CheetahReply) -> bytes:
    """The six bytes of ``reply``."""
    word = (reply.motor_id & 0xFF) << 40 | (reply.position & 0xFFFF) << 24
    return (word | (reply.velocity & 0xFFF) << 12 | reply.effort & 0xFFF).to_bytes(6, "big")


def unpack_cheetah_reply(data: bytes) -> CheetahReply:
    """The reply in ``data``. :raises ValueError: fewer than 6 bytes."""
    if len(data) < 6:
        raise ValueError(f"MIT driver reply has {len(data)} bytes instead of 6")
    word = int.from_bytes(data[:6], "big")
    return CheetahReply(word >> 40, word >> 24 & 0xFFFF, word >> 12 & 0xFFF, word & 0xFFF)


def pack_imu_gyro(gyro: ImuGyro) -> bytes:
    """The 8 bytes of ``gyro``."""
    temperature = gyro.temperature & 0x7FF
    return _IMU.pack(gyro.x, gyro.y, gyro.z) + bytes((temperature >> 3, (temperature & 7) << 5))


def unpack_imu_gyro(data: bytes) -> ImuGyro:
    """``data`` of frame ``id`` of an IMU: three int16 little-endian, then an 11-bit signed temperature.

    :raises ValueError: not 8 bytes.
    """
    if len(data) != 8:
        raise ValueError(f"IMU frame has {len(data)} bytes instead of 8")
    temperature = data[6] << 3 | data[7] >> 5
    x, y, z = _IMU.unpack(data[:6])
    return ImuGyro(x, y, z, temperature - 2048 if temperature > 1023 else temperature)


def pack_imu_accel(accel: ImuAccel) -> bytes:
    """The 8 bytes of ``accel``."""
    return _IMU.pack(accel.x, accel.y, accel.z) + bytes((accel.camera_trigger | accel.trigger_enabled << 1, 0))


def unpack_imu_accel(data: bytes) -> ImuAccel:
    """``data`` of frame ``id + 1`` of an IMU. :raises ValueError: not 8 bytes."""
    if len(data) != 8:
        raise ValueError(f"IMU frame has {len(data)} bytes instead of 8")
    x, y, z = _IMU.unpack(data[:6])
    return ImuAccel(x, y, z, bool(data[6] & 1), bool(data[6] & 2))
