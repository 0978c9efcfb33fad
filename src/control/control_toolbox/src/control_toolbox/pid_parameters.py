"""A Pid with its gains on the parameter server, adjustable while it runs, and its state on a topic."""

from __future__ import annotations

from typing import Any

import rospy
from control_msgs.msg import PidState
from dynamic_parameters import Parameter, Server
from node_signals.parameters import ParameterError, is_number
from realtime_tools import RealtimePublisher

from .pid import Gains, Pid

_TABLE = [
    Parameter("p", float, 10.0, -100000.0, 100000.0, "Proportional gain.", 1),
    Parameter("i", float, 0.1, -100000.0, 100000.0, "Integral gain.", 1),
    Parameter("d", float, 1.0, -1000.0, 1000.0, "Derivative gain.", 1),
    Parameter("i_clamp_min", float, -10.0, -100000.0, 0.0, "Lower bound of the integral term.", 1),
    Parameter("i_clamp_max", float, 10.0, 0.0, 100000.0, "Upper bound of the integral term.", 1),
    Parameter("antiwindup", bool, False, description="Stop integrating where the integral term meets its bound.", level=1),
]


class PidParameterError(ParameterError):
    """The gains in a namespace are missing or wrong."""


class RosPid(Pid):
    """A Pid that belongs to a parameter namespace; made by load_pid.

    Gains set by the program through set_gains are told to dynamic_reconfigure clients.

    :param nh: NodeHandle that owns its topics and services. :param gains: to begin with.
    :param dynamic: offer dynamic_reconfigure. :param publish_state: publish ``<namespace>/state``.
    """

    def __init__(self, namespace: str, gains: Gains, nh: Any, dynamic: bool, publish_state: bool):
        super().__init__(*gains)
        self.namespace = namespace
        self._publisher: RealtimePublisher | None = None
        self._server: Server | None = None
        if publish_state:
            self._publisher = RealtimePublisher(nh, namespace + "/state", PidState, queue_size=1)
        if dynamic:
            self._server = nh.own(Server(namespace, _TABLE, self._reconfigure, initial=_to_config(gains)))

    def set_gains(self, p: float, i: float, d: float, i_max: float, i_min: float, antiwindup: bool = False) -> None:
        super().set_gains(p, i, d, i_max, i_min, antiwindup)
        if self._server is not None:
            self._server.update(_to_config(self.gains))

    def _reconfigure(self, config: dict[str, Any], level: int) -> None:
        if level == -1:
            return  # the server repeats the loaded gains
        self.gains = Gains(config["p"], config["i"], config["d"], config["i_clamp_max"], config["i_clamp_min"], config["antiwindup"])

    def compute_command(self, error: float, dt: float, error_dot: float | None = None) -> float:
        """As ``Pid.compute_command`` with ``error``, ``dt`` (s) and ``error_dot`` (per s; None: the quotient); publishes the state too."""
        command = super().compute_command(error, dt, error_dot)
        if self._publisher is not None and self.counted and self._publisher.has_subscribers:
            self._publish(self._publisher, dt)
        return command

    def _publish(self, publisher: RealtimePublisher, dt: float) -> None:
        gains = self.gains
        message = PidState(
            timestep=rospy.Duration.from_sec(dt),
            error=self.p_error,
            error_dot=self.d_error,
            p_error=self.p_error,
            i_error=self.i_error,
            d_error=self.d_error,
            p_term=gains.p * self.p_error,
            i_term=self.i_term,
            d_term=gains.d * self.d_error,
            i_max=gains.i_max,
            i_min=gains.i_min,
            output=self.command,
        )
        message.header.stamp = rospy.get_rostime()
        publisher.publish(message)


def _to_config(gains: Gains) -> dict[str, Any]:
    return {
        "p": gains.p,
        "i": gains.i,
        "d": gains.d,
        "i_clamp_min": gains.i_min,
        "i_clamp_max": gains.i_max,
        "antiwindup": gains.antiwindup,
    }


def load_pid(nh: Any, dynamic: bool = True) -> RosPid:
    """A Pid with the gains of the namespace of ``nh``.

    Reads p (required), i, d, i_clamp, i_clamp_min, i_clamp_max, antiwindup, publish_state.

    :param nh: controller_interface.NodeHandle of the PID namespace; it owns what is made here.
    :param dynamic: offer the gains through dynamic_reconfigure in that namespace.
    :raises PidParameterError: no p gain, or a gain that is not a number.
    """
    namespace = nh.namespace
    values = rospy.get_param(namespace, {})
    if not isinstance(values, dict) or "p" not in values:
        raise PidParameterError(f"No p gain specified for pid.  Namespace: {namespace}")

    def number(name: str, default: float, finite: bool = True) -> float:
        value = values.get(name, default)
        if not is_number(value, finite=finite):
            raise PidParameterError(f"parameter {namespace}/{name} must be a number, it is {value!r}")
        return float(value)

    def flag(name: str) -> bool:
        value = values.get(name, False)
        if not isinstance(value, bool):  # upstream takes it for not set, so it must not keep a robot from working
            rospy.logwarn("parameter %s/%s must be true or false, it is %r; false is taken", namespace, name, value)
        return value is True

    clamp = abs(number("i_clamp", 0.0, finite=False))
    gains = Gains(
        number("p", 0.0),
        number("i", 0.0),
        number("d", 0.0),
        abs(number("i_clamp_max", clamp, finite=False)),
        -abs(number("i_clamp_min", clamp, finite=False)),
        flag("antiwindup"),
    )
    return RosPid(namespace, gains, nh, dynamic, flag("publish_state"))
