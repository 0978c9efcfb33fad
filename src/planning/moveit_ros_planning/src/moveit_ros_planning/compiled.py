"""Planners and request adapters of other packages that are compiled: planned with in this process."""

from __future__ import annotations

import io
import threading
from collections.abc import Sequence

import motion
import rosgraph
import rospy
from moveit_core import scene_messages, states
from moveit_core.errors import code_name
from moveit_msgs.msg import MotionPlanRequest, MotionPlanResponse, MoveItErrorCodes
from plugin_loader import PluginClass, find_plugins

_PLANNER = "planning_interface::PlannerManager"
_ADAPTER = "planning_request_adapter::PlanningRequestAdapter"
#: error code -> the library's word for it, the first of each
_STATUS: dict[int, str] = {}
for _word, _code in motion.planning.CODES.items():
    _STATUS.setdefault(_code, _word)
_STATUS[MoveItErrorCodes.PLANNING_FAILED] = "failed"


def exported(kind: str) -> dict[str, PluginClass]:
    """All classes that packages export as ``kind``, planners (``planner``) or request adapters (``adapter``), by name."""
    base = {"planner": _PLANNER, "adapter": _ADAPTER}[kind]
    found, _problems = find_plugins("moveit_core")
    return {name: plugin for name, plugin in found.items() if plugin.base == base}


class CompiledPipeline:
    """A pipeline whose planner, or one of its adapters, is compiled: all of it then runs as C++.

    :param description: a :class:`moveit_ros_planning.robot_model.RobotDescription`.
    :param namespace: of the pipeline's parameters, resolved.
    :raises RuntimeError: it cannot be loaded; one line.
    """

    def __init__(self, description, namespace: str):
        from . import _pipelines  # type: ignore[attr-defined]  # compiled, and heavy: for those who need it only

        self._description = description
        self._pipeline = _pipelines.CompiledPipeline(
            description.model,
            description.urdf,
            description.srdf,
            description=description.name,
            pipeline=namespace.rstrip("/") or "/",
            node=rospy.get_name(),
            master=rosgraph.get_master_uri(),
        )

    @property
    def title(self) -> str:
        return self._pipeline.description or "compiled"

    def planner_ids(self) -> list[str]:
        """What the planner says it can do."""
        return list(self._pipeline.algorithms)

    def generate(
        self, scene: motion.PlanningScene, message: MotionPlanRequest, cancel: motion.CancelToken | None = None
    ) -> motion.PlanResult:
        """Plan ``message`` in ``scene`` with all adapters. Never raises for what a request says: see the result's status.

        :param cancel: ends it from another thread.
        """
        done = threading.Event()
        if cancel is not None:
            threading.Thread(target=self._watch, args=(cancel, done), name="cancelling", daemon=True).start()
        try:
            answer, added = self._pipeline.generate(_bytes(scene_messages.scene_message(scene)), _bytes(message))
        finally:
            done.set()
        response = MotionPlanResponse()
        response.deserialize(answer)
        return self._result(scene, message, response, added, cancel)

    def _watch(self, cancel: motion.CancelToken, done: threading.Event) -> None:
        while not done.wait(0.01):
            if cancel.cancelled:
                self._pipeline.terminate()  # again and again: the planner may not have begun yet

    def _result(
        self, scene, message: MotionPlanRequest, response: MotionPlanResponse, added: Sequence[int], cancel: motion.CancelToken | None
    ) -> motion.PlanResult:
        start, code = scene.state, response.error_code.val
        if cancel is not None and cancel.cancelled:
            return motion.PlanResult("cancelled", "planning was cancelled", start=start)
        if code != MoveItErrorCodes.SUCCESS:
            return motion.PlanResult(
                _STATUS.get(code, "failed"),
                f"planner '{self.title}' answers {code_name(code)}",
                start=start,
                planner=self.title,
                planning_time=response.planning_time,
            )
        try:
            states.apply_robot_state(scene, start, response.trajectory_start, scene_messages.attach_to_state(scene))
            trajectory = states.trajectory_from_message(scene.model, message.group_name, start, response.trajectory)
        except (ValueError, motion.MotionError) as error:
            return motion.PlanResult("failed", f"planner '{self.title}' answers what cannot be used: {error}", start=start)
        return motion.PlanResult(
            "solved",
            trajectory=trajectory,
            start=trajectory.start,
            planner=self.title,
            planning_time=response.planning_time,
            added_prefix=list(added),
        )


def _bytes(message) -> bytes:
    buffer = io.BytesIO()
    message.serialize(buffer)
    return buffer.getvalue()
