"""The services ``get_planning_scene``, ``apply_planning_scene``, ``clear_octomap``, and those of octomap files."""

from __future__ import annotations

import rospy
from moveit_msgs.srv import ApplyPlanningScene as ApplyPlanningSceneSrv
from moveit_msgs.srv import GetPlanningScene as GetPlanningSceneSrv
from std_srvs.srv import Empty

from ..capability import Capability, serve


class GetPlanningScene(Capability):
    """The scene, or the parts of it that are asked for."""

    title = "GetPlanningSceneService"

    def __init__(self, context):
        super().__init__(context)
        self._service = serve("get_planning_scene", GetPlanningSceneSrv, self._get)

    def _get(self, request, response) -> None:
        response.scene = self.context.monitor.message(request.components.components)
        if response.scene.name:
            response.scene.name += "+"  # clients of upstream see the monitored scene as a child of another


class ApplyPlanningScene(Capability):
    """Changes the scene; the answer comes when it is changed."""

    title = "ApplyPlanningSceneService"

    def __init__(self, context):
        super().__init__(context)
        self._service = serve("apply_planning_scene", ApplyPlanningSceneSrv, self._apply)

    def _apply(self, request, response) -> None:
        response.success = self.context.monitor.apply(request.scene)


class ClearOctomap(Capability):
    """Empties the octomap."""

    title = "ClearOctomapService"

    def __init__(self, context):
        super().__init__(context)
        self._service = serve("clear_octomap", Empty, self._clear)

    def _clear(self, _request, _response) -> None:
        rospy.loginfo("Clearing octomap...")
        self.context.octomap.clear()
        rospy.loginfo("Octomap cleared.")
