"""Controllers for joints that take position commands."""

from .controllers import JointGroupPositionController, JointPositionController

__all__ = ["JointGroupPositionController", "JointPositionController"]
