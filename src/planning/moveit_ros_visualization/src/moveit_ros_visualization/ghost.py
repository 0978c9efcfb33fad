"""A robot that is not there: its shapes in one colour, half transparent."""
from __future__ import annotations

import motion
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import MarkerArray

from moveit_commander.markers import robot_markers

ORANGE = ColorRGBA(0.98, 0.5, 0.45, 0.5)
RED = ColorRGBA(1.0, 0.0, 0.0, 0.6)
BLUE = ColorRGBA(0.35, 0.6, 1.0, 0.4)


def ghost(description, state: motion.RobotState, colour: ColorRGBA, name: str) -> MarkerArray:
    """Markers of the whole robot in ``state``; ``name`` is their namespace."""
    message = robot_markers(description, state)
    for marker in message.markers:
        marker.ns, marker.color, marker.mesh_use_embedded_materials = name, colour, False
    return message
