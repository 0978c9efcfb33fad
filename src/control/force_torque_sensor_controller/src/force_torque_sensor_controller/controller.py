"""The force-torque publisher."""
from __future__ import annotations

from controller_interface import Controller, RateGate, RealtimePublisher, to_stamp
from geometry_msgs.msg import WrenchStamped
from hardware_interface import ForceTorqueSensorHandle, ForceTorqueSensorInterface


class ForceTorqueSensorController(Controller):
    """One topic per sensor, named after it in the robot's namespace, at parameter ``publish_rate``."""

    interface = ForceTorqueSensorInterface

    def init(self, hw, root_nh, controller_nh) -> None:
        rate = controller_nh.get_param("publish_rate", float)
        self._sensors = [(hw.get_handle(name), RealtimePublisher(root_nh, name, WrenchStamped, queue_size=4),
                          RateGate(rate)) for name in hw.names()]

    def starting(self, time: float) -> None:
        for _, _, gate in self._sensors:
            gate.restart(time)

    def update(self, time: float, period: float) -> None:
        for sensor, publisher, gate in self._sensors:
            if gate.due(time):
                publisher.publish(wrench_message(sensor, time))


def wrench_message(sensor: ForceTorqueSensorHandle, time: float) -> WrenchStamped:
    """What a sensor measures now; zeros for what it cannot measure."""
    message = WrenchStamped()
    message.header.stamp = to_stamp(time)
    message.header.frame_id = sensor.frame_id
    for part, values in ((message.wrench.force, sensor.force), (message.wrench.torque, sensor.torque)):
        if values is not None:
            part.x, part.y, part.z = values
    return message
