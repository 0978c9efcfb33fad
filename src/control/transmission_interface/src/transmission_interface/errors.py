"""What can go wrong with a transmission."""

from hardware_interface import ControlError


class TransmissionError(ControlError):
    """A transmission cannot be made; one line saying which and why."""
