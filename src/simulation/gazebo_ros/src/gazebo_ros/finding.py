"""Where models, worlds and media are looked for, in the server and in whatever shows its world."""

from __future__ import annotations

import rospkg
from ode_sim.description import ResourceFinder
from plugin_loader import exported_values


def make_finder(rospack: rospkg.RosPack) -> ResourceFinder:
    """Search paths: the environment's, then what packages that ``rospack`` finds export for gazebo_ros."""

    def package(name: str) -> str | None:
        try:
            return rospack.get_path(name)
        except rospkg.ResourceNotFound:
            return None

    def exported(attribute: str) -> list[str]:
        values = exported_values("gazebo_ros", attribute, rospack)
        return [path for value in values for path in value.split(":") if path]

    return ResourceFinder(exported("gazebo_model_path"), exported("gazebo_media_path"), package)
