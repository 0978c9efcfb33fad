"""All planning pipelines of a node."""

from __future__ import annotations

import rospy
from moveit_core.errors import PlanningError
from moveit_msgs.msg import MoveItErrorCodes

from .planning_pipeline import Pipeline, PipelineError
from .robot_model import RobotDescription


class Pipelines:
    """All pipelines of a node, from ``~planning_pipelines`` (Noetic) or directly below ``~`` (Melodic)."""

    def __init__(self, description: RobotDescription, namespace: str = "~"):
        self.default = ""
        self.pipelines: dict[str, Pipeline] = {}
        self.refused: dict[str, str] = {}
        names = self._configured(namespace)
        wanted = rospy.get_param(namespace + "default_planning_pipeline", None)
        self.default = self._default(wanted, names)
        for name in names or [""]:
            where = f"{namespace}planning_pipelines/{name}/" if names else namespace
            try:
                self.pipelines[name] = Pipeline(name, where, description)
            except PipelineError as error:
                self.refused[name] = str(error)
                # the assistant's configurations name CHOMP beside OMPL, and most never ask for it
                (rospy.logerr if name == self.default else rospy.logwarn)("%s", error)
        if not self.pipelines:
            raise PipelineError("Failed to load any planning pipelines: " + "; ".join(self.refused.values()))
        if self.default not in self.pipelines:
            self.default = next(iter(self.pipelines))
            rospy.logwarn("Using default pipeline '%s'", self.default)
        if wanted != self.default:
            rospy.set_param(namespace + "default_planning_pipeline", self.default)

    @staticmethod
    def _configured(namespace: str) -> list[str]:
        entries = rospy.get_param(namespace + "planning_pipelines", {})
        if not isinstance(entries, dict):
            rospy.logerr(
                "Parameter '%splanning_pipelines' is expected to be a dictionary of pipeline configurations.", rospy.resolve_name(namespace)
            )
            return []
        names = []
        for name, entry in sorted(entries.items()):
            if isinstance(entry, dict) and "planning_plugin" in entry:
                names.append(name)
            else:
                rospy.logerr("Planning pipeline parameter '~planning_pipelines/%s/planning_plugin' doesn't exist", name)
        return names

    @staticmethod
    def _default(wanted: str | None, names: list[str]) -> str:
        if wanted in names:
            return wanted
        if wanted:
            rospy.logwarn("MoveGroup launched with ~default_planning_pipeline '%s' not configured in ~planning_pipelines", wanted)
        elif len(names) > 1:
            rospy.logwarn(
                "MoveGroup launched without ~default_planning_pipeline specifying the namespace for the "
                "default planning "
                "pipeline configuration"
            )
        if not names:
            rospy.logwarn("Falling back to using the move_group node's namespace (deprecated Melodic behavior).")
            return ""
        return names[0]

    def find(self, name: str) -> Pipeline:
        """The pipeline ``name`` of a request; "" is the default one.

        :raises PlanningError: there is no such pipeline.
        """
        if not name:
            return self.pipelines[self.default]
        if name in self.pipelines:
            return self.pipelines[name]
        known = ", ".join(f"'{known}'" for known in self.pipelines)
        why = self.refused.get(name, "")
        raise PlanningError(MoveItErrorCodes.FAILURE, why or f"Couldn't find requested planning pipeline '{name}'; there are: {known}")
