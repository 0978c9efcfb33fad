"""The page with the tabs that speak ROS, fed by the node ``/gazebo``."""

from __future__ import annotations

import glob
from collections.abc import Sequence
from typing import Any

import rospy

from gzclient.ros_simulation import RosSimulation


def make_page(website: Any, shadows: bool) -> Any:
    """:class:`ode_sim_viewer.Page` on ``website``, which somebody has knocked at.

    :param shadows: also where the graphics are computed by the processor
    """
    simulation = RosSimulation()
    simulation.look(True)  # the first frame comes while the rest is imported
    from ode_sim_viewer import Page

    return Page(
        simulation,
        title="Gazebo",
        website=website,
        say=lambda line: rospy.logwarn("%s", line),
        later=_panels,
        shadows=shadows or bool(glob.glob("/dev/dri/renderD*")),
    )


def _panels() -> Sequence[type]:
    """What speaks to more of ROS than the simulator; a third of all that is imported."""
    from gzclient.panels.building import BuildingPanel
    from gzclient.panels.controllers import ControllersPanel
    from gzclient.panels.frames import FramesPanel
    from gzclient.panels.markers import MarkersPanel
    from gzclient.panels.model import ModelPanel
    from gzclient.panels.sensors import SensorsPanel
    from gzclient.panels.topics import TopicsPanel

    return SensorsPanel, FramesPanel, MarkersPanel, TopicsPanel, ControllersPanel, BuildingPanel, ModelPanel
