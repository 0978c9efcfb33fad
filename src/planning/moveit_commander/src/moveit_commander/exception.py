"""What the clients raise."""

from moveit_core.errors import MoveItError


class MoveItCommanderException(MoveItError):
    """A target or setting that cannot be used; one line saying why."""
