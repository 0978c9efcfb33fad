"""The node ``move_group``: from parameters to a running planner."""

from __future__ import annotations

import sys

import motion
import node_signals
import rospy
import tf2_ros
from moveit_core.errors import one_line
from moveit_msgs.srv import LoadMap, SaveMap
from moveit_ros_occupancy_map_monitor.monitor import OccupancyMapMonitor
from moveit_ros_planning import robot_model
from moveit_ros_planning.pipelines import Pipelines
from moveit_ros_planning.plan_execution import PlanExecution
from moveit_ros_planning.planning_pipeline import PipelineError
from moveit_ros_planning.scene_monitor import SceneMonitor
from moveit_ros_planning.trajectory_execution import TrajectoryExecution
from plugin_loader import PluginClass, PluginError, find_plugins

from .capability import Capability
from .compiled import CompiledCapabilities
from .context import Context, Display

_DEFAULT = (
    "move_group/MoveGroupCartesianPathService",
    "move_group/MoveGroupKinematicsService",
    "move_group/MoveGroupExecuteTrajectoryAction",
    "move_group/MoveGroupMoveAction",
    "move_group/MoveGroupPickPlaceAction",
    "move_group/MoveGroupPlanService",
    "move_group/MoveGroupQueryPlannersService",
    "move_group/MoveGroupStateValidationService",
    "move_group/MoveGroupGetPlanningSceneService",
    "move_group/ApplyPlanningSceneService",
    "move_group/ClearOctomapService",
)
# Clients wait for these two alone, and call everything else at once then.
_LAST = ("move_group/MoveGroupExecuteTrajectoryAction", "move_group/MoveGroupMoveAction")
_GREEN, _CYAN, _BLUE, _PLAIN = "\033[32m", "\033[36m", "\033[34m", "\033[0m"


def main(arguments: list[str] | None = None) -> int:
    """Run the node until it is shut down; the exit code."""
    arguments = rospy.myargv() if arguments is None else arguments
    debug = any(argument.startswith("--debug") for argument in arguments[1:])
    node_signals.init_node("move_group")
    try:
        node = MoveGroup(debug)
    except (robot_model.DescriptionError, PipelineError) as error:
        rospy.logfatal("%s", error)
        return 1
    node.greet()
    node_signals.spin()
    node.shutdown()
    return 0


class MoveGroup:
    """Everything that the node consists of.

    :raises robot_model.DescriptionError: the robot cannot be loaded.
    :raises PipelineError: no planning pipeline can be.
    """

    def __init__(self, debug: bool = False):
        rospy.loginfo("MoveGroup debug mode is %s", "ON" if debug else "OFF")
        name = rospy.get_param("~planning_scene_monitor_options/robot_description", "robot_description")
        description = robot_model.load(name, compiled_solvers=True)
        rospy.loginfo("Loading robot model '%s'...", description.model.name)
        if rospy.get_param("~collision_detector", "FCL") not in ("", "FCL"):
            rospy.logwarn("collision_detector '%s' does not exist here; FCL is used", rospy.get_param("~collision_detector"))
        buffer = tf2_ros.Buffer(rospy.Duration(10.0), debug=False)
        self._listener = tf2_ros.TransformListener(buffer)
        dynamics = bool(rospy.get_param("~monitor_dynamics", False))
        if dynamics:
            rospy.loginfo("MoveGroup monitors robot dynamics (higher load)")
        monitor = SceneMonitor(description, buffer, dynamics=dynamics)
        pipelines = Pipelines(description)
        execution = plan_execution = None
        if rospy.get_param("~allow_trajectory_execution", True):
            execution = TrajectoryExecution(description.model, monitor.states)
            plan_execution = PlanExecution(monitor, execution)
        octomap = OccupancyMapMonitor(monitor, buffer)
        self.context = Context(
            description, monitor, pipelines, execution, plan_execution, Display(description.model, debug), octomap, debug
        )
        self._map_services = [rospy.Service("~load_map", LoadMap, self._load_map), rospy.Service("~save_map", SaveMap, self._save_map)]
        self.capabilities: list[Capability] = []
        self._compiled: CompiledCapabilities | None = None
        self._load_capabilities()

    def _wanted(self) -> list[str]:
        names = set(_DEFAULT) | set(_words(rospy.get_param("~capabilities", "")))
        for pipeline in self.context.pipelines.pipelines.values():
            names |= set(_words(rospy.get_param(pipeline.namespace + "capabilities", "")))
        return sorted(names - set(_words(rospy.get_param("~disable_capabilities", ""))))

    def _load_capabilities(self) -> None:
        found, problems = find_plugins("moveit_ros_move_group")
        for problem in problems:
            rospy.logwarn("%s", problem)
        wanted = self._wanted()
        compiled = [name for name in wanted if name in found and found[name].compiled]
        for name in [name for name in wanted if name not in _LAST and name not in compiled]:
            self._load(name, found)
        if compiled:
            self._start_compiled(compiled)
        for name in [name for name in wanted if name in _LAST]:
            self._load(name, found)
        bar = "********************************************************"
        rows = "\n".join(f"*     - {capability.title}" for capability in self.capabilities)
        rospy.loginfo("\n\n%s\n* MoveGroup using: \n%s\n%s\n", bar, rows, bar)

    def _load(self, name: str, found: dict[str, PluginClass]) -> None:
        _print(f"{_CYAN}Loading '{name}'...{_PLAIN}")
        if name not in found:
            rospy.logerr(
                "Exception while loading move_group capability '%s': nobody exports it; there are: %s", name, ", ".join(sorted(found))
            )
            return
        try:
            self.capabilities.append(found[name].load()(self.context))
        except PluginError as error:
            rospy.logerr("Exception while loading move_group capability '%s': %s", name, error)
        except Exception as error:  # a third party's capability; the others are still of use
            rospy.logerr("Exception while loading move_group capability '%s': %s: %s", name, type(error).__name__, one_line(error))

    def _start_compiled(self, names: list[str]) -> None:
        for name in names:
            _print(f"{_CYAN}Loading '{name}'...{_PLAIN}")
        try:
            self._compiled = CompiledCapabilities(self.context, names)
        except (OSError, RuntimeError) as error:
            rospy.logerr("Exception while loading the move_group capabilities %s: %s", ", ".join(names), error)
        else:
            self.capabilities += self._compiled.capabilities

    def greet(self) -> None:
        """Say that planning can begin."""
        if not self.capabilities:
            _print(f"{_BLUE}\nmove_group is running but no capabilities are loaded.\n{_PLAIN}")
        else:
            rospy.loginfo("MoveGroup context using planning pipeline '%s'", self.context.pipelines.default or "ompl")
            _print(f"{_GREEN}\nYou can start planning now!\n{_PLAIN}")

    def shutdown(self) -> None:
        """Stop the robot and all capabilities."""
        for capability in self.capabilities:
            capability.shutdown()
        if self._compiled is not None:
            self._compiled.shutdown()
        if self.context.execution is not None:
            self.context.execution.shutdown()
        self.context.octomap.shutdown()
        self.context.monitor.shutdown()

    def _load_map(self, request) -> bool:
        try:
            tree = motion.OcTree.load(request.filename)
        except (motion.MotionError, OSError, ValueError) as error:
            rospy.logerr("Failed to load map from file: %s", one_line(error))
            return False
        self.context.octomap.assign(tree)
        return True

    def _save_map(self, request) -> bool:
        tree = self.context.monitor.octomap
        if tree is None:
            rospy.logerr("There is no octomap to save")
            return False
        try:
            tree.save(request.filename)
        except (motion.MotionError, OSError, ValueError) as error:
            rospy.logerr("Failed to save map to '%s': %s", one_line(request.filename, 80), one_line(error))
            return False
        return True


def _words(value) -> list[str]:
    """Names of a parameter that holds them separated by blanks, or as a list."""
    return [str(entry) for entry in value] if isinstance(value, list) else str(value or "").split()


def _print(text: str) -> None:
    print(text, flush=True, file=sys.stdout)
