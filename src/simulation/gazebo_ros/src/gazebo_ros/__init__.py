"""The ROS face of the simulator: the server node ``gazebo``, its plugins' base classes, and spawn_model."""
from gazebo_ros.plugin import ModelPlugin, PluginError, SensorPlugin, WorldPlugin
from gazebo_ros.sdf_element import SdfElement

__all__ = ["ModelPlugin", "PluginError", "SdfElement", "SensorPlugin", "WorldPlugin"]
