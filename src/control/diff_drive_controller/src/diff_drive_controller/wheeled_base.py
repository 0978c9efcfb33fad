"""What all wheeled bases do alike."""

from __future__ import annotations

import math
from collections.abc import Callable

from controller_interface import ControllerBase, NodeHandle, ParameterError
from node_signals.parameters import is_number, or_default

from .command_topic import VelocityCommand
from .laws import PlanarOdometry, WheelTravel
from .odometry_publisher import OdometryPublisher
from .speed_limiter import load_limiter


class WheeledBase(ControllerBase):
    """A base that obeys ``cmd_vel`` within its speed limits and publishes its odometry.

    Derive from it first, from Controller or MultiInterfaceController second, and call ``init_base`` in ``init``.
    """

    def init_base(
        self,
        root_nh: NodeHandle,
        controller_nh: NodeHandle,
        travel: tuple[WheelTravel, ...] = (),
        jerk: bool = True,
        odom_frame: str | None = None,
    ) -> None:
        """Parameters and topics common to all bases.

        :param root_nh, controller_nh: as for ``init``
        :param travel: counters to be restarted when a simulation was reset
        :param jerk: whether there are limits of jerk
        :param odom_frame: fixed name of the odometry frame; None reads the parameter ``odom_frame_id``
        """
        self._travel = travel
        self._open_loop = controller_nh.param("open_loop", False)
        self._limit_linear = load_limiter(controller_nh, "linear/x", jerk)
        self._limit_angular = load_limiter(controller_nh, "angular/z", jerk)
        self._odometry = PlanarOdometry(controller_nh.param("velocity_rolling_window_size", 10))
        self._publisher = OdometryPublisher(root_nh, controller_nh, odom_frame)
        self._command = VelocityCommand(controller_nh, self.brake)

    # -- what a kind of base adds --------------------------------------------------------------------------------------

    def brake(self) -> None:
        """Command the base to stand still. Realtime safe."""
        raise NotImplementedError

    def measured_way(self) -> tuple[float, float] | None:
        """(m forward, rad turned) since the last call, from the wheels; None if they are not known. Realtime safe."""
        raise NotImplementedError

    # -- life-cycle ----------------------------------------------------------------------------------------------------

    def starting(self, time: float) -> None:
        self.brake()
        self._limit_linear.reset()
        self._limit_angular.reset()
        self._odometry.restart(time)
        self._publisher.restart(time)
        self._command.start(time)

    def stopping(self, time: float) -> None:
        self._command.stop()
        self.brake()

    def aborting(self, time: float) -> None:
        self.stopping(time)

    # -- for update ----------------------------------------------------------------------------------------------------

    def notice_reset(self, time: float) -> None:
        """When a simulation was reset, ``time`` (s) having gone back, the wheels went back with it: that is no way travelled."""
        if self._odometry.interval(time) < 0.0:
            self._odometry.restart(time)
            for travel in self._travel:
                travel.restart()

    def update_odometry(self, time: float) -> bool:
        """Bring the odometry up to ``time`` and publish it. :return: False if the wheels are not known."""
        self.notice_reset(time)
        if self._open_loop:
            self._odometry.commanded(self._limit_linear.last, self._limit_angular.last, time)
        else:
            way = self.measured_way()
            if way is None:
                return False
            self._odometry.travelled(*way, time)
        self._publisher.publish(self._odometry, time)
        return True

    def limited_command(self, time: float, period: float) -> tuple[float, float]:
        """(linear x m/s, angular z rad/s) to be done at ``time`` (s), with no more change than is allowed in ``period`` (s)."""
        linear, angular = self._command.at(time)
        return self._limit_linear.limit(linear, period), self._limit_angular.limit(angular, period)


def length(nh: NodeHandle, name: str, find: Callable[[], float]) -> float:
    """A length (m) from parameter ``name`` below ``nh``, else from ``find``. A negative one turns the wheels' sense round, as upstream.

    :raises ParameterError: it is 0 or infinite
    """
    given = nh.param(name, None)
    value = float(given) if is_number(given, finite=False) else find() if given is None else or_default(nh.resolve(name), given, find())
    if value == 0.0 or math.isinf(value):
        raise ParameterError(f"{nh.namespace}: {name} must be another length than 0 m, it is {value:g}; set it by parameter")
    return value


def multiplier(nh: NodeHandle, name: str) -> float:
    """A factor from parameter ``name`` below ``nh``; 1 without it.

    :raises ParameterError: it is 0 or infinite
    """
    value = nh.param(name, 1.0)
    if value == 0.0 or math.isinf(value):
        raise ParameterError(f"parameter {nh.resolve(name)} must be a finite factor other than 0, it is {value:g}")
    return value
