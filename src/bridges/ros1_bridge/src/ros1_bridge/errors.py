"""What this package says when it cannot go on."""


class BridgeError(Exception):
    """Root: one line each."""


class MappingError(BridgeError):
    """Two types that are no pair, or bytes that are no message of theirs."""


class Ros2Missing(BridgeError):
    """ROS 2 is not installed, or does not start."""
