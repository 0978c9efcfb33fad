"""The page with the tabs that speak ROS, fed by the node ``/gazebo``."""
from __future__ import annotations

import glob
from typing import Any

import rospy

from gzclient.ros_simulation import RosSimulation


def make_page(website: Any, shadows: bool) -> Any:
    """:class:`ode_sim.viewer.Page` on ``website``, which somebody has knocked at.

    :param shadows: also where the graphics are computed by the processor
    """
    simulation = RosSimulation()
    simulation.look(True)  # the first frame comes while the rest is imported
    from ode_sim.viewer import Page

    from gzclient.panels.building import BuildingPanel
    from gzclient.panels.controllers import ControllersPanel
    from gzclient.panels.frames import FramesPanel
    from gzclient.panels.markers import MarkersPanel
    from gzclient.panels.model import ModelPanel
    from gzclient.panels.sensors import SensorsPanel
    from gzclient.panels.topics import TopicsPanel
    page = Page(simulation, title="Gazebo", website=website, say=lambda line: rospy.logwarn("%s", line),
                panels=(SensorsPanel, FramesPanel, MarkersPanel, TopicsPanel, ControllersPanel, BuildingPanel, ModelPanel))
    page.drawing.shadows = shadows or bool(glob.glob("/dev/dri/renderD*"))
    return page
