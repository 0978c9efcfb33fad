"""The model plugin ``libgazebo_ros_control.so``."""

from __future__ import annotations

import contextlib
import threading
import time
import traceback

import rosgraph
import rospy
from controller_interface import NodeHandle
from controller_manager import ControllerManager
from gazebo_ros import names
from gazebo_ros.plugin import ModelPlugin, PluginError
from plugin_loader import find_plugins
from std_msgs.msg import Bool
from transmission_interface import TransmissionError, parse_transmissions

from .compiled import CompiledSimClass
from .default_robot_hw_sim import DefaultRobotHWSim
from .robot_hw_sim import RobotHWSim

_DEFAULT_SIM = "gazebo_ros_control/DefaultRobotHWSim"

#: s between two looks for the robot description
_POLL = 0.1

#: s between two looks, in a paused world, at what is to be started; and after which it is said what is waited for
_LOOK, _PATIENCE = 0.005, 20.0


class GazeboRosControl(ModelPlugin):
    """A controller manager on the joints of a model.

    Elements: ``robotNamespace`` (default: the model's name), ``robotParam`` (robot_description), ``robotSimType``
    (gazebo_ros_control/DefaultRobotHWSim), ``controlPeriod`` (s, default: the time step), ``eStopTopic``
    (std_msgs/Bool).

    The robot description may come later than the model: the world goes on meanwhile.
    """

    def load(self, server, model, sdf) -> None:
        self._server = server
        self._model = model
        self._world = server.world
        given = sdf.get("robotNamespace", None)
        self._namespace = names.join(rospy.get_namespace(), model.name if given is None else given)
        rospy.loginfo("Loading gazebo_ros_control plugin")
        rospy.loginfo("Starting gazebo_ros_control plugin in namespace: %s", self._namespace)
        self._nh = NodeHandle(self._namespace)
        self._robot_param = sdf.get("robotParam", "robot_description") or "robot_description"
        self._sim_class = find_sim(sdf.get("robotSimType", _DEFAULT_SIM) or _DEFAULT_SIM)
        self._period_ns = self._control_period(sdf.get("controlPeriod", 0.0))
        self._e_stop = self._was_stopped = False
        if sdf.get("eStopTopic", ""):
            self._nh.subscriber(sdf.get("eStopTopic", ""), Bool, self._receive_e_stop)
        self._hw: RobotHWSim | None = None
        self._manager: ControllerManager | None = None
        self._gone = threading.Event()
        self._holds = self._told_to_hold()
        self._forget_times()
        urdf = self._find_description()
        if urdf is not None:
            self._start(urdf)
        else:
            threading.Thread(target=self._wait_for_description, name="gazebo_ros_control", daemon=True).start()

    def _told_to_hold(self) -> bool:
        """``spawn_model -paused_until_controllers``: said once, for this model."""
        parameter = f"{rospy.get_name()}/paused_until_controllers/{self._model.name}"
        held = rospy.get_param(parameter, False) is True
        if held:
            rospy.delete_param(parameter)
        return held

    def _control_period(self, wanted: float) -> int:
        """ns; 0 updates in every step."""
        step = self._world.dt
        if not wanted > 0.0:  # NaN too
            return 0
        if wanted == float("inf"):
            raise PluginError("<controlPeriod> must be a number of seconds, it is infinite: nothing would ever be controlled")
        if wanted < step * (1.0 - 1e-9):
            rospy.logerr(
                "model '%s': <controlPeriod>%g is shorter than the time step of %g s; controllers are updated once per step",
                self._model.name,
                wanted,
                step,
            )
        elif wanted > step * (1.0 + 1e-9):
            rospy.logwarn(
                "model '%s': <controlPeriod>%g is longer than the time step of %g s: controllers are updated less often than the world",
                self._model.name,
                wanted,
                step,
            )
        return round(wanted * 1e9)

    # -- the robot description -----------------------------------------------------------------------------------------

    def _find_description(self) -> str | None:
        """The closest parameter of that name above the namespace, else that name as it stands; None if not there."""
        found = self._nh.search_param(self._robot_param) or self._robot_param
        value = rospy.get_param(found, None)
        return value if isinstance(value, str) and value else None

    def _wait_for_description(self) -> None:
        rospy.logwarn(
            "gazebo_ros_control plugin is waiting for model URDF in parameter [%s] on the ROS param server. "
            "(Looked for in %s and above, for model '%s'; the world goes on, controllers can be loaded once "
            "it is there)",
            self._robot_param,
            self._namespace,
            self._model.name,
        )
        refused = None
        while not self._gone.wait(_POLL) and not rospy.core.is_shutdown_requested():
            try:
                urdf = self._find_description()
            except (OSError, rosgraph.MasterException):  # the master restarts or goes; the next look tells
                continue
            if urdf is None or urdf == refused:
                continue
            try:
                self._start(urdf)
                return
            except PluginError as error:
                refused = urdf
                rospy.logerr("gazebo_ros_control of model '%s': %s. Waiting for another description", self._model.name, error)

    def _start(self, urdf: str) -> None:
        """Begin to control the robot, or leave nothing behind.

        :raises PluginError: one line; whatever the description or a third party's RobotHWSim did
        """
        nh = NodeHandle(self._namespace)
        manager = None
        try:
            hw = self._make_hw(nh, urdf)
            manager = ControllerManager(hw, self._namespace)
            names = ", ".join(hw.interface_names())
        except Exception as error:  # init_sim is third-party code
            if manager is not None:
                manager.shutdown()
            nh.shutdown()
            if isinstance(error, PluginError) and not isinstance(self._sim_class, CompiledSimClass):
                raise
            raise PluginError(f"the robot hardware {self._label()} cannot start: {_reason(error)}") from error
        if self._gone.is_set():
            manager.shutdown()
            nh.shutdown()
            return
        self._nh.own(nh)
        self._hw, self._manager = hw, manager
        self._server.before_step(self._step)
        rospy.logdebug("Command interfaces in %s: %s", self._namespace, names)
        rospy.loginfo("Loaded gazebo_ros_control.")
        if self._holds:
            threading.Thread(target=self._run_with_controllers, args=(manager,), name="paused", daemon=True).start()

    def _run_with_controllers(self, manager: ControllerManager) -> None:
        """Let the paused world run when controllers that move something are about to start."""
        told = time.monotonic() + _PATIENCE
        while self._server.paused and not self._gone.wait(_LOOK):
            asked = manager.asked_to_start
            if any(claimed.resources for info in asked for claimed in info.claimed_resources):
                self._server.unpause()
                return
            if asked:  # they only read; whoever starts them waits, and the next one for that
                with contextlib.suppress(ValueError):  # somebody else steps
                    self._server.step()
            if time.monotonic() > told:
                told = float("inf")
                rospy.logwarn(
                    "the simulation stands still until controllers of model '%s' start, as spawn_model "
                    "-paused_until_controllers asked: start them with the controller manager in %s, or call unpause_physics",
                    self._model.name,
                    self._namespace,
                )

    def _make_hw(self, nh: NodeHandle, urdf: str) -> RobotHWSim:
        try:
            transmissions, problems = parse_transmissions(urdf)
        except TransmissionError as error:
            raise PluginError(f"parameter {self._robot_param}: {error}") from error
        for problem in problems:
            rospy.logerr("model '%s': %s", self._model.name, problem)
        hw = self._sim_class(self._server) if isinstance(self._sim_class, CompiledSimClass) else self._sim_class()
        if isinstance(hw, RobotHWSim):
            hw.on_drive = self._server.drives
        if hw.init_sim(self._namespace, nh, self._model, urdf, transmissions) is False:
            raise PluginError("Could not initialize robot simulation interface")
        return hw

    # -- every step ----------------------------------------------------------------------------------------------------

    def _forget_times(self) -> None:
        self._last_update_ns: int | None = None
        self._last_write_ns: int | None = None

    def _step(self) -> None:
        hw, manager, now_ns = self._hw, self._manager, self._world.time_ns
        if hw is None or manager is None:
            return
        now = now_ns * 1e-9
        e_stop = self._e_stop
        try:
            hw.e_stop_active(e_stop)
            last = self._last_update_ns
            elapsed_ns = max(self._period_ns, round(self._world.dt * 1e9)) if last is None else now_ns - last
            if elapsed_ns >= self._period_ns:
                self._last_update_ns = now_ns
                period = elapsed_ns * 1e-9
                hw.read_sim(now, period)
                restart = self._was_stopped and not e_stop
                self._was_stopped = e_stop
                manager.update(now, period, restart)
            last = self._last_write_ns
            self._last_write_ns = now_ns
            hw.write_sim(now, self._world.dt if last is None else (now_ns - last) * 1e-9)
        except Exception as error:  # a RobotHWSim is third-party code
            raise self._failed(error) from error

    def _failed(self, error: Exception) -> PluginError:
        """End the control of this robot, so that nobody waits for a loop that does not run any more."""
        manager = self._manager
        self._hw = self._manager = None

        def end() -> None:  # waits for requests under way, which the world need not
            if manager is not None:
                manager.shutdown()
            self._nh.shutdown()

        threading.Thread(target=end, name="gazebo_ros_control end", daemon=True).start()
        return PluginError(
            f"the robot hardware {self._label()} failed: {_reason(error)}. Its controllers are "
            "stopped and their controller manager is closed; delete and spawn the robot to begin again"
        )

    def _label(self) -> str:
        sim = self._sim_class
        return sim.label if isinstance(sim, CompiledSimClass) else f"{sim.__module__}.{sim.__qualname__}"

    def _receive_e_stop(self, message: Bool) -> None:
        self._e_stop = message.data

    def reset(self) -> None:
        self._forget_times()
        if self._hw is not None:
            self._hw.reset_sim()

    def shutdown(self) -> None:
        self._gone.set()
        if self._manager is not None:
            self._manager.shutdown()
        self._nh.shutdown()


def find_sim(name: str) -> type | CompiledSimClass:
    """The class of a simulated robot hardware. :raises PluginError: there is none of that name."""
    if name == _DEFAULT_SIM:
        return DefaultRobotHWSim
    types, problems = find_plugins("gazebo_ros_control")
    for problem in problems:
        rospy.logwarn("robot hardware types: %s", problem)
    if name not in types:
        raise PluginError(f"<robotSimType>{name}</robotSimType> does not exist; there are: {', '.join(sorted(types))}")
    return CompiledSimClass(types[name]) if types[name].compiled else types[name].load()


def _reason(error: Exception) -> str:
    """One line: what was raised, and where."""
    if isinstance(error, PluginError):
        return str(error)
    place = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {' '.join(str(error).split())} ({place.filename}:{place.lineno})"
