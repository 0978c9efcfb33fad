"""libgazebo_ros_projector.so and libgazebo_ros_video.so: they paint on what is drawn. Accepted with one line, without
effect."""
from __future__ import annotations

import rospy
from gazebo_ros.plugin import ModelPlugin, SensorPlugin


class Projector(ModelPlugin):
    def load(self, server, model, sdf) -> None:
        rospy.loginfo("projector of model %s: patterns of light are not drawn here; everything else of the model works",
                      model.name)


class Video(SensorPlugin):
    def load(self, server, sensor, sdf) -> None:
        rospy.loginfo("video plugin of %s: pictures are not drawn on visuals here", sensor.scoped_name)
