"""The IMU publisher."""

from __future__ import annotations

from controller_interface.sensor_controller import SensorController
from hardware_interface import ImuSensorHandle, ImuSensorInterface
from sensor_msgs.msg import Imu

_UNKNOWN = [-1.0] + [0.0] * 8


class ImuSensorController(SensorController):
    """Attitude, rates and accelerations. What a sensor does not measure has a covariance that begins with -1."""

    interface = ImuSensorInterface
    message_type = Imu

    def fill(self, message: Imu, sensor: ImuSensorHandle) -> None:
        for name in ("orientation", "angular_velocity", "linear_acceleration"):
            values, covariance = getattr(sensor, name), getattr(sensor, name + "_covariance")
            if values is None:
                setattr(message, name + "_covariance", _UNKNOWN)
                continue
            for axis, value in zip("xyzw", values):
                setattr(getattr(message, name), axis, value)
            if covariance is not None:
                setattr(message, name + "_covariance", list(covariance))
