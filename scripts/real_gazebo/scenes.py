"""All scenes, family by family."""

from real_gazebo import (
    scenes_contacts,
    scenes_fields,
    scenes_joints,
    scenes_linkages,
    scenes_piles,
    scenes_plugins,
    scenes_robots,
    scenes_sensors,
    scenes_surfaces,
    scenes_whole,
    scenes_worlds,
)
from real_gazebo.scene import SCENES

FAMILIES = (
    scenes_joints,
    scenes_linkages,
    scenes_contacts,
    scenes_surfaces,
    scenes_piles,
    scenes_robots,
    scenes_worlds,
    scenes_fields,
    scenes_whole,
    scenes_sensors,
    scenes_plugins,
)
__all__ = ["FAMILIES", "SCENES"]
