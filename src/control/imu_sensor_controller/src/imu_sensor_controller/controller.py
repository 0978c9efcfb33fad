"""The IMU publisher."""
from __future__ import annotations

from controller_interface import Controller, RateGate, RealtimePublisher, to_stamp
from hardware_interface import ImuSensorHandle, ImuSensorInterface
from sensor_msgs.msg import Imu

_UNKNOWN = [-1.0] + [0.0] * 8


class ImuSensorController(Controller):
    """One topic per sensor, named after it in the robot's namespace, at parameter ``publish_rate``."""

    interface = ImuSensorInterface

    def init(self, hw, root_nh, controller_nh) -> None:
        rate = controller_nh.get_param("publish_rate", float)
        self._sensors = [(hw.get_handle(name), RealtimePublisher(root_nh, name, Imu, queue_size=4), RateGate(rate))
                         for name in hw.names()]

    def starting(self, time: float) -> None:
        for _, _, gate in self._sensors:
            gate.restart(time)

    def update(self, time: float, period: float) -> None:
        for sensor, publisher, gate in self._sensors:
            if gate.due(time):
                publisher.publish(imu_message(sensor, time))


def imu_message(sensor: ImuSensorHandle, time: float) -> Imu:
    """What a sensor measures now. What it cannot measure has a covariance that begins with -1."""
    message = Imu()
    message.header.stamp = to_stamp(time)
    message.header.frame_id = sensor.frame_id
    for name in ("orientation", "angular_velocity", "linear_acceleration"):
        values, covariance = getattr(sensor, name), getattr(sensor, name + "_covariance")
        if values is None:
            setattr(message, name + "_covariance", _UNKNOWN)
            continue
        for axis, value in zip("xyzw", values):
            setattr(getattr(message, name), axis, value)
        if covariance is not None:
            setattr(message, name + "_covariance", list(covariance))
    return message
