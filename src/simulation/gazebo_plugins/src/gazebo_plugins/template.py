"""libgazebo_ros_template.so: does nothing, as its original."""

from gazebo_ros.plugin import ModelPlugin


class Template(ModelPlugin):
    def load(self, server, model, sdf) -> None:
        """Nothing to start."""
