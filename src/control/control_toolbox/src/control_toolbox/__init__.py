"""PID controller, test signals and small filters for controllers."""

from .pid import Gains, Pid
from .pid_gains_setter import PidGainsSetter
from .pid_parameters import PidParameterError, RosPid, load_pid
from .signals import Dither, SineSweep, Sinusoid, clamp, exponential_smoothing

__all__ = [
    "Dither",
    "Gains",
    "Pid",
    "PidGainsSetter",
    "PidParameterError",
    "RosPid",
    "SineSweep",
    "Sinusoid",
    "clamp",
    "exponential_smoothing",
    "load_pid",
]
