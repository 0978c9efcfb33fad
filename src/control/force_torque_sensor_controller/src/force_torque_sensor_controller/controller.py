"""The force-torque publisher."""

from __future__ import annotations

from controller_interface.sensor_controller import SensorController
from geometry_msgs.msg import WrenchStamped
from hardware_interface import ForceTorqueSensorHandle, ForceTorqueSensorInterface


class ForceTorqueSensorController(SensorController):
    """Forces in N and torques in Nm, in the sensor's frame; zeros for what a sensor does not measure."""

    interface = ForceTorqueSensorInterface
    message_type = WrenchStamped

    def fill(self, message: WrenchStamped, sensor: ForceTorqueSensorHandle) -> None:
        for part, values in ((message.wrench.force, sensor.force), (message.wrench.torque, sensor.torque)):
            if values is not None:
                part.x, part.y, part.z = values
