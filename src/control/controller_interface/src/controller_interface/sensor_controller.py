"""Base of the controllers that publish what sensors measure."""

from __future__ import annotations

from typing import Any, ClassVar

from realtime_tools import RateGate, RealtimePublisher

from .controller import Controller
from .node_handle import NodeHandle, to_stamp


class SensorController(Controller):
    """One topic per sensor of the interface, named after it in the robot's namespace, at parameter ``publish_rate``.

    The rate is in Hz and required; 0 or less never publishes.
    """

    message_type: ClassVar[type]  # with a header

    def fill(self, message: Any, sensor: Any) -> None:
        """Put what ``sensor`` measures now into ``message``. Realtime safe."""
        raise NotImplementedError

    def init(self, hw, root_nh: NodeHandle, controller_nh: NodeHandle) -> None:
        rate = controller_nh.get_param("publish_rate", float)
        self._sensors = [
            (hw.get_handle(name), RealtimePublisher(root_nh, name, self.message_type, queue_size=4), RateGate(rate)) for name in hw.names()
        ]

    def starting(self, time: float) -> None:
        for _, _, gate in self._sensors:
            gate.restart(time)

    def update(self, time: float, period: float) -> None:
        for sensor, publisher, gate in self._sensors:
            if gate.due(time) and publisher.has_subscribers:
                message = self.message_type()
                message.header.stamp = to_stamp(time)
                message.header.frame_id = sensor.frame_id
                self.fill(message, sensor)
                publisher.publish(message)
