"""Base classes of controllers.

A controller in full::

    from controller_interface import Controller
    from hardware_interface import PositionJointInterface

    class Hold(Controller):
        interface = PositionJointInterface

        def init(self, hw, root_nh, controller_nh):
            self.joint = hw.get_handle(controller_nh.get_param("joint", str))

        def starting(self, time):
            self.target = self.joint.position

        def update(self, time, period):
            self.joint.command = self.target
"""

from realtime_tools import RateGate, RealtimePublisher

from .controller import Controller, ControllerBase, ControllerState, InitError, MultiInterfaceController
from .node_handle import NodeHandle, ParameterError, one_line, to_stamp

__all__ = [
    "Controller",
    "ControllerBase",
    "ControllerState",
    "InitError",
    "MultiInterfaceController",
    "NodeHandle",
    "ParameterError",
    "RateGate",
    "RealtimePublisher",
    "one_line",
    "to_stamp",
]
