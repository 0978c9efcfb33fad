"""The ROS face of the simulator: the server node ``gazebo``, its plugins' base classes, and spawn_model."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gazebo_ros.plugin import ModelPlugin, PluginError, SensorPlugin, WorldPlugin
    from gazebo_ros.sdf_element import SdfElement

__all__ = ["ModelPlugin", "PluginError", "SdfElement", "SensorPlugin", "WorldPlugin"]


def __getattr__(name: str) -> Any:  # gzclient wants its command line from here, and no more
    if name in __all__:
        return getattr(import_module(f"{__name__}.{'sdf_element' if name == 'SdfElement' else 'plugin'}"), name)
    if name in ("plugin", "sdf_element"):
        return import_module(f"{__name__}.{name}")
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
