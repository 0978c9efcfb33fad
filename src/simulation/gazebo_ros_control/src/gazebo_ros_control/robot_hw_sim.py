"""Base class of robot hardware that lives in the simulator."""

from __future__ import annotations

from collections.abc import Callable

from controller_interface import NodeHandle
from hardware_interface import RobotHW
from transmission_interface import TransmissionInfo


class RobotHWSim(RobotHW):
    """Derive, and register interfaces in ``init_sim``. Everything but ``init_sim`` runs in the physics thread.

    :ivar on_drive: to be called with the joints (ode_sim.JointHandle) that are moved from now on, so that the user is told where
        another plugin moves one of them, too
    """

    on_drive: Callable[..., None] = staticmethod(lambda *joints: None)

    def init_sim(self, robot_namespace: str, model_nh: NodeHandle, model, urdf: str | None, transmissions: list[TransmissionInfo]) -> bool:
        """Set up. May take its time: the world goes on. Must not touch the world's state.

        :param robot_namespace: absolute.
        :param model_nh: handle of that namespace; what is made through it goes with the model.
        :param model: ode_sim.ModelHandle.
        :param urdf: the robot description.
        :param transmissions: of the description.
        :return: False to refuse.
        """
        raise NotImplementedError

    def read_sim(self, time: float, period: float) -> None:
        """Joint states from the simulation into the handles. ``time``, ``period`` in s of sim time."""

    def write_sim(self, time: float, period: float) -> None:
        """Commands of the handles into the simulation; called every step, also between two control periods.

        ``time`` and ``period`` in s.
        """

    def e_stop_active(self, active: bool) -> None:
        """Told every step whether the emergency stop is pressed (``active``)."""

    def reset_sim(self) -> None:
        """The simulation was reset: joints may have jumped."""

    def read(self, time: float, period: float) -> None:
        self.read_sim(time, period)

    def write(self, time: float, period: float) -> None:
        self.write_sim(time, period)
