"""What the capabilities of one move_group share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import motion
import rospy
from moveit_core import convert, states
from moveit_core.errors import PlanningError
from moveit_msgs.msg import DisplayTrajectory, MotionPlanRequest, MoveItErrorCodes
from moveit_ros_occupancy_map_monitor.monitor import OccupancyMapMonitor
from moveit_ros_planning.pipelines import Pipelines
from moveit_ros_planning.plan_execution import PlanExecution
from moveit_ros_planning.robot_model import RobotDescription
from moveit_ros_planning.scene_monitor import SceneMonitor
from moveit_ros_planning.trajectory_execution import TrajectoryExecution
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker, MarkerArray


@dataclass
class Context:
    """The robot, its scene, planners and controllers. ``execution`` is None where execution is not allowed."""

    description: RobotDescription
    monitor: SceneMonitor
    pipelines: Pipelines
    execution: TrajectoryExecution | None
    plan_execution: PlanExecution | None
    display: Display
    octomap: OccupancyMapMonitor
    debug: bool = False

    @property
    def model(self) -> motion.RobotModel:
        return self.description.model

    def plan(self, scene: motion.PlanningScene, request: MotionPlanRequest, cancel: motion.CancelToken | None = None) -> motion.PlanResult:
        """Plan ``request`` in ``scene`` with the pipeline that it names, and show the result; ``cancel`` ends it from another thread.

        :raises PlanningError: the request cannot be served.
        """
        self.display.request(request)
        pipeline = self.pipelines.find(request.pipeline_id)
        result = pipeline.generate(scene, request, cancel)
        self.display.trajectories([result.trajectory] if result.trajectory is not None else [])
        if not result and getattr(result, "contacts", None):
            self.display.contacts(result.contacts)
        return result

    def group(self, name: str) -> motion.Group:
        """The group ``name`` of the robot.

        :raises PlanningError: INVALID_GROUP_NAME.
        """
        if not self.model.has_group(name):
            raise PlanningError(
                MoveItErrorCodes.INVALID_GROUP_NAME,
                f"the robot '{self.model.name}' has no group '{name}'; it has: " + (", ".join(self.model.groups) or "none"),
            )
        return self.model.group(name)


class Display:
    """What move_group shows: planned paths, contacts, and (``--debug``) the requests it got."""

    def __init__(self, model: motion.RobotModel, debug: bool):
        self._model = model
        self._path = rospy.Publisher("~display_planned_path", DisplayTrajectory, queue_size=10, latch=True)
        self._contacts = rospy.Publisher("~display_contacts", MarkerArray, queue_size=100, latch=True)
        self._costs = rospy.Publisher("~display_cost_sources", MarkerArray, queue_size=100, latch=True)
        self._requests = rospy.Publisher("~motion_plan_request", MotionPlanRequest, queue_size=100, latch=True) if debug else None

    def request(self, message: MotionPlanRequest) -> None:
        """Publish ``message``, a request that came, with ``--debug``."""
        if self._requests is not None:
            self._requests.publish(message)

    def trajectories(self, parts: Sequence[motion.Trajectory]) -> None:
        """Publish a planned path, of one or more parts that follow each other; nothing if there is none."""
        parts = [part for part in parts if len(part)]
        if not parts:
            return
        message = DisplayTrajectory(model_id=self._model.name)
        message.trajectory_start = states.robot_state_message(parts[0].start)
        message.trajectory = [states.trajectory_message(part) for part in parts]
        self._path.publish(message)

    def contacts(self, contacts) -> None:
        """Publish ``contacts`` as red spheres."""
        markers = [Marker(action=Marker.DELETEALL)]
        for number, contact in enumerate(contacts):
            marker = Marker(
                ns=f"{contact.body_1}={contact.body_2}",
                id=number,
                type=Marker.SPHERE,
                action=Marker.ADD,
                color=ColorRGBA(1.0, 0.0, 0.0, 0.8),
            )
            marker.header.frame_id = self._model.frame
            marker.header.stamp = rospy.Time.now()
            marker.pose = convert.pose_message((contact.position, convert.IDENTITY[1]))
            marker.scale.x = marker.scale.y = marker.scale.z = 0.035
            markers.append(marker)
        markers[0].header.frame_id = self._model.frame
        self._contacts.publish(MarkerArray(markers))
