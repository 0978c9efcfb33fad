"""What all parts of motion planning share: messages to and from the ``motion`` library, and the base of controller
managers."""

from .errors import PlanningError, code_name

__all__ = ["PlanningError", "code_name"]
