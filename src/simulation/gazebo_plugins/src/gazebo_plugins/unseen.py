"""libgazebo_ros_projector.so: it paints on what is drawn. Accepted with one line, without effect."""

from __future__ import annotations

import rospy
from gazebo_ros.plugin import ModelPlugin


class Projector(ModelPlugin):
    def load(self, server, model, sdf) -> None:
        rospy.loginfo("projector of model %s: patterns of light are not drawn here; everything else of the model works", model.name)
