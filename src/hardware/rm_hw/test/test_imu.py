"""The IMU's orientation against motions whose outcome is known."""

import math

import pytest
from rm_hw.config import ImuConfig
from rm_hw.frames import ImuAccel, ImuGyro
from rm_hw.imu import Imu


def make():
    return Imu(ImuConfig("imu", "can0", 0x300, "imu_frame", angular_vel_coeff=1e-3, accel_coeff=9.81 / 1000))


def test_turning_by_the_gyroscope():
    imu = make()
    for i in range(1001):
        imu.on_gyro(ImuGyro(0, 0, 1571, 0), i * 0.001)  # pi/2 rad/s about z for a second
    x, y, z, w = imu.handle.orientation
    assert 2 * math.atan2(z, w) == pytest.approx(math.pi / 2, rel=1e-3) and abs(x) + abs(y) < 1e-9
    assert imu.handle.angular_velocity == pytest.approx((0, 0, 1.571))


@pytest.mark.parametrize("roll, pitch", [(0.5, 0.0), (0.0, -0.7), (-0.3, 0.4)])
def test_gravity_gives_roll_and_pitch(roll, pitch):
    imu = make()
    up = (-math.sin(pitch), math.sin(roll) * math.cos(pitch), math.cos(roll) * math.cos(pitch))
    for i in range(2000):
        imu.on_gyro(ImuGyro(0, 0, 0, 0), i * 0.001)
        imu.on_accel(ImuAccel(*(round(1000 * u) for u in up), False, False))
    x, y, z, w = imu.handle.orientation
    assert math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)) == pytest.approx(roll, abs=0.01)
    assert math.asin(2 * (w * y - z * x)) == pytest.approx(pitch, abs=0.01)


def test_a_knock_is_not_taken_for_gravity():
    imu = make()
    for _ in range(100):
        imu.on_accel(ImuAccel(3000, 0, 0, True, True))
    assert imu.handle.orientation == (0.0, 0.0, 0.0, 1.0)
    assert imu.handle.linear_acceleration[0] == pytest.approx(29.43) and imu.trigger_enabled


def test_temperature():
    imu = make()
    imu.on_gyro(ImuGyro(0, 0, 0, 16), 0.0)
    assert imu.temperature == pytest.approx(25.0)
