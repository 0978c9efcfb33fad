"""Plugins that come with Gazebo itself and are not here: each says so, and why, in one line. Everything else goes on."""

from __future__ import annotations

import rospy
from gazebo_ros.plugin import ModelPlugin, SensorPlugin, WorldPlugin


class _Absent:
    """``library``: of which file it stands in the place; ``reason``: why it is not here."""

    library = ""
    reason = ""

    def load(self, _server, *_) -> None:
        rospy.logwarn("lib%s.so, which comes with Gazebo, is not here: %s. It is left out", self.library, self.reason)


def _absent(base: type, library: str, reason: str) -> type:
    return type(library, (_Absent, base), {"library": library, "reason": reason, "__doc__": reason})


_KEYS = "it flies or drives one demonstration by keys that only Gazebo's own window sends"
_NAMED = "it moves the joints of one demonstration's model, by their names"
_DEVICE = "it reads a device of its own; ROS has drivers that do, with topics for all"
_PICTURES = "it draws on pictures with Gazebo's own renderer"

CartDemo = _absent(ModelPlugin, "CartDemoPlugin", _NAMED)
JointTrajectory = _absent(ModelPlugin, "JointTrajectoryPlugin", _NAMED)
GimbalSmall2d = _absent(ModelPlugin, "GimbalSmall2dPlugin", _NAMED)
SphereAtlasDemo = _absent(ModelPlugin, "SphereAtlasDemoPlugin", _NAMED)
Cessna = _absent(ModelPlugin, "CessnaPlugin", _KEYS)
PlaneDemo = _absent(ModelPlugin, "PlaneDemoPlugin", _KEYS)
ArduCopter = _absent(ModelPlugin, "ArduCopterPlugin", "it speaks to ArduPilot over a protocol of 2016; ardupilot_gazebo has a newer one")
HydraDemo = _absent(ModelPlugin, "HydraDemoPlugin", _DEVICE)
Hydra = _absent(WorldPlugin, "HydraPlugin", _DEVICE)
Joy = _absent(WorldPlugin, "JoyPlugin", _DEVICE)
LinkPlot3D = _absent(ModelPlugin, "LinkPlot3DPlugin", "it draws lines in Gazebo's own window; RViz shows the path of a link")
LookAtDemo = _absent(ModelPlugin, "LookAtDemoPlugin", "it shows what a function of ignition-math does")
Mud = _absent(ModelPlugin, "MudPlugin", "it holds links in mud by joints that give way, which cannot be made while the simulation runs")
RegionEventBox = _absent(
    ModelPlugin, "RegionEventBoxPlugin", "its events are of SimEventsPlugin; libContainPlugin.so tells who is in a box"
)
SimEvents = _absent(WorldPlugin, "SimEventsPlugin", "its events are of Gazebo's web service; libContainPlugin.so tells who is in a box")
Arrange = _absent(WorldPlugin, "ArrangePlugin", "write the poses into the world file; set_model_state moves models later")
Rubble = _absent(WorldPlugin, "RubblePlugin", "its rubble lies at other places in every run; <population> of a world strews models")
StaticMap = _absent(WorldPlugin, "StaticMapPlugin", "it downloads pictures of maps; the network is never used")
FiducialCamera = _absent(SensorPlugin, "FiducialCameraPlugin", _PICTURES)
LensFlare = _absent(SensorPlugin, "LensFlareSensorPlugin", _PICTURES)
RaySensorNoise = _absent(SensorPlugin, "RaySensorNoisePlugin", "write <noise> into the sensor")
Pressure = _absent(SensorPlugin, "PressurePlugin", "libgazebo_ros_bumper.so has the forces of contacts")
