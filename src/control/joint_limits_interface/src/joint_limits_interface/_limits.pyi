from .limits import JointLimits, SoftJointLimits

class CommandLimiter:
    """The law of ``limit_law.h`` for one joint. Units: rad or m, and per s; Nm or N.

    :param command: "position", "velocity" or "effort"; with ``soft`` limits or without
    """

    def __init__(self, command: str, limits: JointLimits, soft: SoftJointLimits | None = ...) -> None: ...
    def reset(self) -> None:
        """Forget the last command."""
    def enforce(self, command: float, position: float, velocity: float, dt: float) -> tuple[float, bool]:
        """The allowed command, and whether the given one was a usable number. ``dt``: s since the last cycle."""
