"""Controller life-cycle: constructed -> initialized -> running <-> stopped / waiting / aborted."""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Any, ClassVar

import rospy
from hardware_interface import ControlError, HardwareInterface, InterfaceResources, RobotHW

from .node_handle import NodeHandle


class InitError(ControlError):
    """A controller cannot be initialised; one line saying why."""


class ControllerState(Enum):
    """``value`` is what list_controllers shows."""

    CONSTRUCTED = "constructed"
    INITIALIZED = "initialized"
    RUNNING = "running"
    STOPPED = "stopped"
    WAITING = "waiting"
    ABORTED = "aborted"


class ControllerBase:
    """The life-cycle. Derive from Controller or MultiInterfaceController instead.

    All times in s. starting, update, stopping, waiting and aborting are called by the control loop: no blocking, no
    ROS calls but RealtimePublisher.
    """

    def __init__(self) -> None:
        self.state = ControllerState.CONSTRUCTED

    # -- for the controller's author -----------------------------------------------------------------------------------

    def init(self, hw: Any, root_nh: NodeHandle, controller_nh: NodeHandle) -> bool | None:
        """Read parameters, take handles, make topics. Return False or raise to refuse.

        :param hw: the interface of a Controller; of a MultiInterfaceController a RobotHW that has its interfaces only.
        :param root_nh: namespace of the controller manager, the robot's.
        :param controller_nh: namespace of this controller, where its parameters are.
        """

    def starting(self, time: float) -> None:
        """Called once before the first update, at ``time`` (s)."""

    def update(self, time: float, period: float) -> None:
        """Called every cycle while running: at ``time`` (s), ``period`` s after the cycle before."""

    def stopping(self, time: float) -> None:
        """Called once after the last update, at ``time`` (s)."""

    def waiting(self, time: float) -> None:
        """Called at ``time`` (s), every cycle while the hardware is still switching for this controller."""

    def aborting(self, time: float) -> None:
        """Called at ``time`` (s) when the hardware failed to switch, or an exception came out of this controller."""

    # -- for the controller manager ---------------------------------------------------------------------------------

    def init_request(self, robot_hw: RobotHW, root_nh: NodeHandle, controller_nh: NodeHandle) -> tuple[InterfaceResources, ...]:
        """Initialise. :return: the claimed resources, one entry per interface.

        :param robot_hw: the robot, of whose interfaces ``init`` is given those that it asks for.
        :param root_nh: namespace of the controller manager.
        :param controller_nh: namespace of the controller.
        :raises InitError: refused; any other exception of ``init`` passes through.
        """
        raise NotImplementedError

    @property
    def is_running(self) -> bool:
        return self.state is ControllerState.RUNNING

    def fail(self) -> None:
        """An exception came out of it: it is aborted."""
        self.state = ControllerState.ABORTED

    def stopped_itself(self, error: Exception) -> bool:
        """Whether ``error``, which update() raised, only says that it does not run any more; ``state`` is then what it has become."""
        return False

    # The following four are refused, with False, before the controller is initialised. Exceptions pass through.

    def start_request(self, time: float) -> bool:
        """Call ``starting`` with ``time`` (s); the controller is running then."""
        return self._enter(ControllerState.RUNNING, self.starting, time)

    def stop_request(self, time: float) -> bool:
        """Call ``stopping`` with ``time`` (s); the controller is stopped then."""
        return self._enter(ControllerState.STOPPED, self.stopping, time)

    def wait_request(self, time: float) -> bool:
        """Call ``waiting`` with ``time`` (s); the controller waits for its hardware then."""
        return self._enter(ControllerState.WAITING, self.waiting, time)

    def abort_request(self, time: float) -> bool:
        """Call ``aborting`` with ``time`` (s); the controller is aborted then."""
        return self._enter(ControllerState.ABORTED, self.aborting, time)

    def _enter(self, state: ControllerState, call: Any, time: float) -> bool:
        if self.state is ControllerState.CONSTRUCTED:
            rospy.logfatal("Failed to change a controller to %s: it is not initialized.", state.value)
            return False
        call(time)
        self.state = state
        return True

    def _init_with(
        self, hw: Any, interfaces: Sequence[HardwareInterface], root_nh: NodeHandle, controller_nh: NodeHandle
    ) -> tuple[InterfaceResources, ...]:
        if self.state is not ControllerState.CONSTRUCTED:
            raise InitError("it has been initialised before")
        for interface in interfaces:
            interface.clear_claims()
        try:
            if self.init(hw, root_nh, controller_nh) is False:
                raise InitError("its init() returned False")
            claimed = tuple(InterfaceResources(interface.type_name, tuple(sorted(interface.claims))) for interface in interfaces)
        finally:
            for interface in interfaces:
                interface.clear_claims()
        self.state = ControllerState.INITIALIZED
        return claimed


def _missing(names: Sequence[str], robot_hw: RobotHW) -> InitError:
    return InitError(
        f"it needs the hardware interface {', '.join(names)}, which this robot does not have; it has: "
        f"{', '.join(robot_hw.interface_names()) or 'none'}. Make sure this is registered in the "
        f"hardware_interface::RobotHW class (in simulation: a <transmission> with that "
        f"<hardwareInterface>)"
    )


class Controller(ControllerBase):
    """A controller on one hardware interface; ``init`` is given that interface."""

    interface: ClassVar[type[HardwareInterface]]

    def init_request(self, robot_hw: RobotHW, root_nh: NodeHandle, controller_nh: NodeHandle) -> tuple[InterfaceResources, ...]:
        hw = robot_hw.get(self.interface)
        if hw is None:
            raise _missing([self.interface.type_name], robot_hw)
        return self._init_with(hw, [hw], root_nh, controller_nh)


class MultiInterfaceController(ControllerBase):
    """A controller on several interfaces; ``init`` is given a RobotHW that has only these.

    With ``optional = True`` those that the robot does not have are left out (``hw.get(...)`` gives None) instead of
    refusing to load.
    """

    interfaces: ClassVar[tuple[type[HardwareInterface], ...]] = ()
    optional: ClassVar[bool] = False

    def init_request(self, robot_hw: RobotHW, root_nh: NodeHandle, controller_nh: NodeHandle) -> tuple[InterfaceResources, ...]:
        there = [robot_hw.get(interface) for interface in self.interfaces]
        if not self.optional and None in there:
            raise _missing([wanted.type_name for wanted, have in zip(self.interfaces, there) if have is None], robot_hw)
        view = RobotHW()
        present = [interface for interface in there if interface is not None]
        for interface in present:
            view.register_interface(interface)
        return self._init_with(view, present, root_nh, controller_nh)
