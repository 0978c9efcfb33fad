"""A robot without physics, controllers for it, and a double of a controller manager, for tests."""

from .service_doubles import ControllerManagerDummy

__all__ = ["ControllerManagerDummy"]
