"""What the clients raise."""


class MoveItCommanderException(Exception):
    """A target or setting that cannot be used; one line saying why."""
