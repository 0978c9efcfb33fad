"""An IMU board on a CAN bus: counts to SI units, and its orientation by a complementary filter."""

from __future__ import annotations

import math

from hardware_interface import ImuSensorHandle

from rm_hw.config import ImuConfig
from rm_hw.frames import ImuAccel, ImuGyro

_GAIN = 0.01  # share of the accelerometer's idea of "down" that is believed per sample
_GRAVITY = 9.81
_TOLERANCE = 0.3  # relative; beyond it the accelerometer measures motion rather than gravity

Quaternion = tuple[float, float, float, float]


def _multiply(a: Quaternion, b: Quaternion) -> Quaternion:
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def _rotation(x: float, y: float, z: float) -> Quaternion:
    """Unit quaternion (x, y, z, w) of a rotation vector in rad."""
    angle = math.sqrt(x * x + y * y + z * z)
    scale = 0.5 if angle < 1e-9 else math.sin(angle / 2.0) / angle
    return x * scale, y * scale, z * scale, math.cos(angle / 2.0)


def _normalized(q: Quaternion) -> Quaternion:
    norm = math.sqrt(sum(v * v for v in q))
    return q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm


class Imu:
    """One IMU; ``handle`` is what controllers read. Orientation is R_WS, the sensor frame in the world."""

    def __init__(self, config: ImuConfig) -> None:
        self.config = config
        self.temperature = 0.0
        self.camera_trigger = self.trigger_enabled = False
        self._orientation: Quaternion = (0.0, 0.0, 0.0, 1.0)
        self.handle = ImuSensorHandle(
            config.name,
            config.frame_id,
            self._orientation,
            _diagonal(config.orientation_covariance),
            (0.0, 0.0, 0.0),
            _diagonal(config.angular_velocity_covariance),
            (0.0, 0.0, 0.0),
            _diagonal(config.linear_acceleration_covariance),
        )
        self._stamp: float | None = None

    @property
    def stamp(self) -> float:
        """s since the epoch at which the last angular velocity was received; 0 before the first."""
        return self._stamp or 0.0

    def on_gyro(self, gyro: ImuGyro, stamp: float) -> None:
        """Take ``gyro``, an angular velocity received at ``stamp`` (s): turn the orientation by it."""
        k, offset = self.config.angular_vel_coeff, self.config.angular_vel_offset
        rate = (gyro.x * k + offset[0], gyro.y * k + offset[1], gyro.z * k + offset[2])
        self.handle.angular_velocity = rate
        self.temperature = gyro.temperature * self.config.temp_coeff + self.config.temp_offset
        interval = stamp - self._stamp if self._stamp is not None else 0.0
        self._stamp = stamp
        if 0.0 < interval < 0.1:
            turn = _rotation(*(w * interval for w in rate))
            self._orientation = self.handle.orientation = _normalized(_multiply(self._orientation, turn))

    def on_accel(self, accel: ImuAccel) -> None:
        """Take ``accel``, an acceleration: pull roll and pitch towards the direction of gravity."""
        k = self.config.accel_coeff
        a = (accel.x * k, accel.y * k, accel.z * k)
        self.handle.linear_acceleration = a
        self.camera_trigger, self.trigger_enabled = accel.camera_trigger, accel.trigger_enabled
        norm = math.sqrt(a[0] ** 2 + a[1] ** 2 + a[2] ** 2)
        if abs(norm - _GRAVITY) > _TOLERANCE * _GRAVITY:
            return
        x, y, z, w = self._orientation
        up = (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))  # the world's z in the sensor frame
        measured = tuple(v / norm for v in a)
        error = (
            measured[1] * up[2] - measured[2] * up[1],
            measured[2] * up[0] - measured[0] * up[2],
            measured[0] * up[1] - measured[1] * up[0],
        )
        correction = _rotation(*(_GAIN * e for e in error))
        self._orientation = self.handle.orientation = _normalized(_multiply(self._orientation, correction))


def _diagonal(values: tuple[float, float, float]) -> tuple[float, ...]:
    a, b, c = values
    return a, 0.0, 0.0, 0.0, b, 0.0, 0.0, 0.0, c
