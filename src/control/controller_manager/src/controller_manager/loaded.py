"""What the manager keeps of each controller."""

from __future__ import annotations

from controller_interface import ControllerBase, NodeHandle
from hardware_interface import ControllerInfo


class LoadedController:
    """A controller with its name and what it holds.

    :param info: its name, type and what it claims. :param nh: its namespace, which owns what it made.
    """

    __slots__ = ("controller", "info", "nh", "update")

    def __init__(self, controller: ControllerBase, info: ControllerInfo, nh: NodeHandle):
        self.controller = controller
        self.info = info
        self.nh = nh
        self.update = controller.update

    @property
    def name(self) -> str:
        return self.info.name

    @property
    def running(self) -> bool:
        return self.controller.is_running
