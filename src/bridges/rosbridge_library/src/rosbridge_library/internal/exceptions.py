"""What rosbridge's packages can say to a client: one line each, by upstream's names."""


class RosbridgeError(Exception):
    """Root of the errors of rosbridge's packages."""


class InvalidArgumentException(RosbridgeError):
    """A field of an operation that is not of its type."""


class MissingArgumentException(RosbridgeError):
    """A field that an operation needs."""
