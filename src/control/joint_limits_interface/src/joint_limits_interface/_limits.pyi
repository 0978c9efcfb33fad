from typing import Any

from .limits import JointLimits, SoftJointLimits

def apply_description(
    bounded: bool, endless: bool, lower: float, upper: float, velocity: float, effort: float, limits: JointLimits
) -> dict[str, Any]:
    """Fields of ``limits`` with what ``<limit>`` says (``limit_sources.h``). Units: rad or m, and per s; Nm or N."""

def apply_parameters(values: dict[str, Any], limits: JointLimits) -> dict[str, Any]:
    """Fields of ``limits`` with what parameters say (``limit_sources.h``)."""

def soft_limits(values: dict[str, Any]) -> tuple[float, float, float, float] | None:
    """Least and greatest position, and both gains; None unless has_soft_limits and all four are there."""

class CommandLimiter:
    """The law of ``limit_law.h`` for one joint. Units: rad or m, and per s; Nm or N.

    :param command: "position", "velocity" or "effort"; with ``soft`` limits or without
    """

    def __init__(self, command: str, limits: JointLimits, soft: SoftJointLimits | None = ...) -> None: ...
    def reset(self) -> None:
        """Forget the last command."""
    def enforce(self, command: float, position: float, velocity: float, dt: float) -> tuple[float, bool]:
        """The allowed command, and whether the given one was a usable number. ``dt``: s since the last cycle."""
