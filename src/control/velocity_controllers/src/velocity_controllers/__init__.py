"""Controllers for joints that take velocity commands."""

from .controllers import JointGroupVelocityController, JointPositionController, JointVelocityController

__all__ = ["JointGroupVelocityController", "JointPositionController", "JointVelocityController"]
