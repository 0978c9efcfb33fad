"""Bases of the controllers that pass a command on to the hardware as it is.

No limits and no time-out here: limits belong to the hardware, and a command stays in force until the next one.
"""

from .controllers import ForwardCommandController, ForwardJointGroupCommandController

__all__ = ["ForwardCommandController", "ForwardJointGroupCommandController"]
