"""ControllerManager: the services, and the update of the controllers in the control loop.

Three locks, taken in this order. ``_switching`` lets one switch at a time in, until the loop has done it. ``_services``
is held while a request looks at the list of controllers and changes it. ``_loop`` is held by the loop during an update and
by a service only for the instant in which it exchanges the list. So loading, unloading and listing work even while the
loop stands still (a paused simulation) and a switch waits for it.
"""

from __future__ import annotations

import math
import sys
import threading
import traceback
from collections.abc import Callable, Sequence

import rosgraph.names
import rospy
from controller_interface import ControllerState, NodeHandle, one_line
from controller_manager_msgs.msg import ControllerState as ControllerStateMsg
from controller_manager_msgs.msg import HardwareInterfaceResources
from controller_manager_msgs.srv import (
    ListControllers,
    ListControllersResponse,
    ListControllerTypes,
    ListControllerTypesResponse,
    LoadController,
    LoadControllerResponse,
    ReloadControllerLibraries,
    ReloadControllerLibrariesResponse,
    SwitchController,
    SwitchControllerRequest,
    SwitchControllerResponse,
    UnloadController,
    UnloadControllerResponse,
)
from hardware_interface import ControllerInfo, RobotHW, SwitchState
from plugin_loader import PluginError

from .controller_types import ControllerTypes
from .loaded import LoadedController
from .switching import Patience, Switch, SwitchRefused, plan

STRICT = SwitchControllerRequest.STRICT
BEST_EFFORT = SwitchControllerRequest.BEST_EFFORT

#: s that a service waits for a cycle that does not end before it gives up
LONGEST_CYCLE = 10.0
#: s that shutdown waits for each kind of request under way
_SHUTDOWN_PATIENCE = 1.0
_STUCK = f"a cycle of the control loop has not ended for {LONGEST_CYCLE:g} s; the update() of a controller, or the hardware, blocks"


def _reason(error: BaseException) -> str:
    """One line for the log: the text of an error that a package defines for its users, else the type and the place."""
    if type(error).__module__ != "builtins":
        return one_line(error)
    frames = traceback.extract_tb(error.__traceback__)
    place = f" ({frames[-1].filename}:{frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}: {one_line(error)}{place}"


class ControllerManager:
    """See the package docstring.

    :param robot_hw: the robot, with its interfaces registered.
    :param namespace: of the services, the controllers' parameters and topics; "" is the namespace of the process.
    """

    def __init__(self, robot_hw: RobotHW, namespace: str = ""):
        self._robot_hw = robot_hw
        self._root = NodeHandle(namespace)
        self._types = ControllerTypes()
        self._switching = threading.Lock()
        self._services = threading.Lock()
        self._loop = threading.Lock()
        self._begun = False
        self._controllers: tuple[LoadedController, ...] = ()
        self._switch: Switch | None = None
        self._closing = False
        nh = self._root.sub("controller_manager")
        nh.service("list_controllers", ListControllers, self._list_controllers)
        nh.service("list_controller_types", ListControllerTypes, self._list_types)
        nh.service("load_controller", LoadController, lambda request: LoadControllerResponse(self.load_controller(request.name)))
        nh.service("unload_controller", UnloadController, lambda request: UnloadControllerResponse(self.unload_controller(request.name)))
        nh.service(
            "switch_controller",
            SwitchController,
            lambda request: SwitchControllerResponse(
                self.switch_controller(
                    request.start_controllers, request.stop_controllers, request.strictness, request.start_asap, request.timeout
                )
            ),
        )
        nh.service(
            "reload_controller_libraries",
            ReloadControllerLibraries,
            lambda request: ReloadControllerLibrariesResponse(self.reload_libraries(request.force_kill)),
        )

    @property
    def asked_to_start(self) -> tuple[ControllerInfo, ...]:
        """What a switch is to start that waits for the control loop; empty while none does. Any thread."""
        switch = self._switch
        return tuple(switch.start_info) if switch is not None else ()

    # -- in the control loop ----------------------------------------------------------------------------------------

    def update(self, time: float, period: float, reset: bool = False) -> None:
        """One cycle: update the running controllers in load order, then go on with a pending switch.

        :param time: s, the loop's clock.
        :param period: s since the last cycle.
        :param reset: stop and start every running controller first (after an emergency stop).
        """
        with self._loop:
            self._begun = True
            set_time = self._types.set_time
            if set_time is not None:
                set_time(time)
            controllers = self._controllers
            if reset:
                for loaded in controllers:
                    if loaded.running:
                        self._guard(loaded, "stopping", loaded.controller.stop_request, time)
                        if loaded.controller.state is ControllerState.STOPPED:
                            self._guard(loaded, "starting", loaded.controller.start_request, time)
            for loaded in controllers:
                if loaded.controller.state is ControllerState.RUNNING:
                    try:
                        loaded.update(time, period)
                    except Exception as error:  # a controller is third-party code: the others go on
                        self._failed(loaded, "update", error, time)
            switch = self._switch
            if switch is not None:
                self._go_on(switch, time)

    def _go_on(self, switch: Switch, time: float) -> None:
        switch.cycles += 1
        if not switch.begun:
            switch.begin(time)
            try:
                self._robot_hw.do_switch(switch.start_info, switch.stop_info)
            except Exception as error:  # the robot's own code: its failure is a failed switch
                rospy.logerr("Switching controllers: the hardware raised %s", _reason(error))
                switch.hardware_failed = True
            for loaded in switch.stop:
                if loaded.running:
                    self._guard(loaded, "stopping", loaded.controller.stop_request, time)
        if switch.start_asap:
            for loaded in switch.start:
                if not loaded.running and loaded not in switch.failed:
                    self._start_if_ready(switch, [loaded], loaded.info, time)
            done = all(loaded.controller.state in (ControllerState.RUNNING, ControllerState.ABORTED) for loaded in switch.start)
        else:
            done = self._start_if_ready(switch, switch.start, None, time)
        if done:
            if self._switch is switch:
                self._switch = None
            switch.finished.set()

    def _start_if_ready(self, switch: Switch, starting: Sequence[LoadedController], info: ControllerInfo | None, time: float) -> bool:
        """Start, abort or keep waiting. :return: False while waiting."""
        result = self._hardware_result(switch, info)
        if result is SwitchState.DONE:
            for loaded in starting:
                if not self._guard(loaded, "starting", loaded.controller.start_request, time):
                    switch.failed.append(loaded)
        elif result is SwitchState.ERROR or switch.timed_out(time):
            names = ", ".join(f"'{loaded.name}'" for loaded in starting)
            if names not in switch.reported:  # those that wait for others come here in every cycle
                switch.reported.append(names)
                rospy.logerr(
                    "%s aborted: the hardware %s",
                    f"Starting {names}" if names else "Switching controllers",
                    "reported an error while switching"
                    if result is SwitchState.ERROR
                    else f"was not ready within the timeout of {switch.timeout:g} s",
                )
            for loaded in starting:
                self._guard(loaded, "aborting", loaded.controller.abort_request, time)
        else:
            for loaded in starting:
                self._guard(loaded, "waiting", loaded.controller.wait_request, time)
            return False
        return True

    def _hardware_result(self, switch: Switch, info: ControllerInfo | None) -> SwitchState:
        if switch.hardware_failed:
            return SwitchState.ERROR
        try:
            return self._robot_hw.switch_result(info)
        except Exception as error:  # the robot's own code: its failure is a failed switch
            rospy.logerr("Switching controllers: the hardware raised %s", _reason(error))
            return SwitchState.ERROR

    def _guard(self, loaded: LoadedController, phase: str, call: Callable[[float], bool], time: float) -> bool:
        """Call into a controller; an exception aborts it. :return: True if it went well."""
        try:
            return call(time)
        except Exception as error:  # a controller is third-party code: the others go on
            self._failed(loaded, phase, error, time)
            return False

    def _failed(self, loaded: LoadedController, phase: str, error: Exception, time: float) -> None:
        controller = loaded.controller
        if controller.stopped_itself(error):
            return
        rospy.logerr("Controller '%s' (%s) aborted: its %s() raised %s", loaded.name, loaded.info.type, phase, _reason(error))
        if phase == "update":
            try:
                controller.stopping(time)  # lets it brake; it must not leave its last command standing
            except Exception as second:  # already reported as failed; the first error is the one to look at
                rospy.logdebug("and its stopping() raised %s", _reason(second))
        controller.fail()

    # -- services -----------------------------------------------------------------------------------------------------

    def load_controller(self, name: str) -> bool:
        """Create the controller described by the parameters in ``<namespace>/<name>``. :return: success."""
        with self._services:
            if self._find(name) is not None:
                rospy.logerr("A controller named '%s' was already loaded inside the controller manager", name)
                return False
            if not rosgraph.names.is_legal_name(name):
                rospy.logerr("Could not load controller '%s': this is no valid name for a namespace", one_line(name))
                return False
            nh = NodeHandle(self._root.namespace)
            try:
                loaded = self._create(name, nh)
            except Exception as error:  # constructor and init are third-party code
                nh.shutdown()
                why = (
                    error if isinstance(error, _TypeProblem) else (f". Initializing controller '{one_line(name)}' failed: {_reason(error)}")
                )
                rospy.logerr("%s", one_line(f"Could not load controller '{one_line(name)}'{why}", 1200))
                return False
            if self._closing or not self._exchange(self._controllers + (loaded,)):
                loaded.nh.shutdown()
                if not self._closing:
                    rospy.logerr("Could not load controller '%s': %s", name, _STUCK)
                return False
            rospy.logdebug("Successfully loaded controller '%s'", name)
            return True

    def _create(self, name: str, root: NodeHandle) -> LoadedController:
        controller_nh = root.sub(name)
        type_name = self._type_of(name, controller_nh)
        plugin = self._types.find(type_name)
        if plugin is None:
            raise _TypeProblem(
                f" because controller type '{one_line(type_name)}' does not exist{self._types.suggestion(type_name)}. Use "
                f"'rosservice call {self._root.resolve('controller_manager/list_controller_types')}' to get the "
                f"available types."
            )
        try:
            controller = self._types.create_compiled(plugin, name) if plugin.compiled else self._types.create(plugin)
        except PluginError as error:
            raise _TypeProblem(f": {error}") from error
        claimed = controller.init_request(self._robot_hw, root, controller_nh)
        return LoadedController(controller, ControllerInfo(name, type_name, claimed), root)

    def _type_of(self, name: str, nh: NodeHandle) -> str:
        type_name = rospy.get_param(nh.resolve("type"), None)
        if isinstance(type_name, str):
            return type_name
        if type_name is not None:
            raise _TypeProblem(f": parameter {nh.resolve('type')} must be a text, it is {one_line(repr(type_name))}")
        ending = f"/{name.strip('/').split('/')[-1]}/type"
        elsewhere = [parameter for parameter in rospy.get_param_names() if parameter.endswith(ending)]
        raise _TypeProblem(
            f" because the type was not specified. Did you load the controller configuration on the parameter server "
            f"(namespace: '{nh.namespace}')? Parameter {nh.resolve('type')} is not set; {nh.describe()}"
            + (f"; but there is {', '.join(elsewhere)} (another namespace)" if elsewhere else "")
        )

    def unload_controller(self, name: str) -> bool:
        """Remove the controller ``name``, which must not run. :return: success."""
        with self._services:
            return self._unload(name)

    def _unload(self, name: str) -> bool:
        loaded = self._find(name)
        if loaded is None:
            rospy.logerr(
                "Could not unload controller with name '%s' because no controller with this name exists; loaded: %s",
                one_line(name),
                self._names(),
            )
            return False
        if loaded.running:
            rospy.logerr("Could not unload controller with name '%s' because it is still running", name)
            return False
        switch = self._switch
        if switch is not None and loaded in switch.start:
            rospy.logerr(
                "Could not unload controller with name '%s' because it is about to be started; the control loop "
                "has not got round to it (is the simulation paused?)",
                name,
            )
            return False
        if not self._exchange(tuple(other for other in self._controllers if other is not loaded)):
            rospy.logerr("Could not unload controller with name '%s': %s", name, _STUCK)
            return False
        loaded.nh.shutdown()
        return True

    def switch_controller(
        self, start: Sequence[str], stop: Sequence[str], strictness: int = STRICT, start_asap: bool = False, timeout: float = 0.0
    ) -> bool:
        """Stop the controllers ``stop`` and start the controllers ``start`` within one cycle; all or nothing.

        Waits for the control loop: as long as it takes while the clock stands still (a paused simulation) or the loop has
        never run, else up to ``switching.PATIENCE`` s without a cycle.

        :param strictness: BEST_EFFORT leaves out what cannot be done, STRICT then refuses.
        :param start_asap: start each controller as soon as its hardware is ready.
        :param timeout: s to wait for the hardware to switch; 0 for ever.
        :return: False if refused, or if the loop did not run in time.
        """
        with self._switching:
            if self._closing:
                return False
            return self._switch_controllers(start, stop, strictness, start_asap, timeout)

    def _switch_controllers(self, start: Sequence[str], stop: Sequence[str], strictness: int, start_asap: bool, timeout: float) -> bool:
        if not math.isfinite(timeout):
            rospy.logerr("Could not switch controllers: the timeout must be a number of s, it is %s", timeout)
            return False
        with self._services:
            switch = self._ask_for(start, stop, strictness, start_asap, timeout)
        return switch is not None and self._carried_out(switch)

    def _ask_for(self, start: Sequence[str], stop: Sequence[str], strictness: int, start_asap: bool, timeout: float) -> Switch | None:
        """Check a switch and hand it to the loop; None if it is refused."""
        if strictness == 0:
            rospy.logwarn(
                "Controller Manager: To switch controllers you need to specify a strictness level of "
                "controller_manager_msgs::SwitchController::STRICT (%d) or ::BEST_EFFORT (%d). "
                "Defaulting to ::BEST_EFFORT.",
                STRICT,
                BEST_EFFORT,
            )
        try:
            starting, stopping = plan(self._controllers, start, stop, strictness == STRICT)
        except SwitchRefused as refusal:
            rospy.logerr("%s", one_line(refusal))
            return None
        running = [loaded.info for loaded in self._controllers if (loaded.running and loaded not in stopping) or loaded in starting]
        switch = Switch(starting, stopping, start_asap, timeout)
        try:
            if self._robot_hw.check_for_conflict(running):
                rospy.logerr("Could not switch controllers, due to resource conflict")
                return None
            if not self._robot_hw.prepare_switch(switch.start_info, switch.stop_info):
                rospy.logerr(
                    "Could not switch controllers. The hardware interface combination for the requested controllers is unfeasible."
                )
                return None
        except Exception as error:  # the robot's own code: refuse this switch, keep running
            rospy.logerr("Could not switch controllers: the hardware raised %s", _reason(error))
            return None
        self._switch = switch
        return switch

    def _carried_out(self, switch: Switch) -> bool:
        """Wait until the loop has done a switch. :return: success; without it, the request is withdrawn."""
        problem = self._wait(switch)
        if problem is not None:
            if not self._withdraw(switch):
                problem = _STUCK
            if not switch.finished.is_set():
                if not (self._closing or rospy.core.is_shutdown_requested()):  # then it is no fault
                    rospy.logerr("Could not switch controllers: %s", problem)
                return False
        return not switch.failed

    def _wait(self, switch: Switch) -> str | None:
        """Until the loop has done the switch: None; else why not, in words."""
        patience = Patience(switch)
        while not switch.finished.wait(Patience.INTERVAL):
            if self._closing or rospy.core.is_shutdown_requested():
                return "the controller manager ends"
            problem = patience.exhausted(rospy.get_time(), self._begun)
            if problem is not None:
                return problem
        return None

    def _withdraw(self, switch: Switch) -> bool:
        """The loop is not to do this switch any more. :return: False if a cycle does not end."""
        if not self._loop.acquire(timeout=LONGEST_CYCLE):
            self._switch = None  # read once in a cycle, so this is safe without the lock
            return False
        if self._switch is switch:
            self._switch = None
        self._loop.release()
        return True

    def reload_libraries(self, force_kill: bool) -> bool:
        """Look for controller types again and import changed modules anew. :return: success.

        :param force_kill: stop and unload what is loaded; False refuses if anything is.
        """
        with self._switching:
            if self._controllers and not force_kill:
                rospy.logerr(
                    "Controller manager: Cannot reload controller libraries because there are still %d controllers running",
                    len(self._controllers),
                )
                return False
            names = [loaded.name for loaded in self._controllers]
            if names and not self._switch_controllers([], names, BEST_EFFORT, False, 0.0):
                rospy.logerr("Controller manager: Cannot reload controller libraries because failed to stop running controllers")
                return False
            with self._services:
                if not all([self._unload(name) for name in names]):
                    rospy.logerr("Controller manager: Cannot reload controller libraries because not all controllers could be unloaded")
                    return False
                self._types.reload()
            rospy.loginfo("Controller manager: reloaded controller libraries")
            return True

    def _list_controllers(self, _request: object) -> ListControllersResponse:
        return ListControllersResponse(
            [
                ControllerStateMsg(
                    name=loaded.name,
                    state=loaded.controller.state.value,
                    type=loaded.info.type,
                    claimed_resources=[
                        HardwareInterfaceResources(claimed.hardware_interface, list(claimed.resources))
                        for claimed in loaded.info.claimed_resources
                    ],
                )
                for loaded in self._controllers
            ]
        )

    def _list_types(self, _request: object) -> ListControllerTypesResponse:
        """Without the doubles of a package of tests, unless this process works with that package."""
        plugins = [plugin for plugin in self._types.all() if not plugin.package.endswith("_tests") or plugin.package in sys.modules]
        return ListControllerTypesResponse([plugin.name for plugin in plugins], [plugin.base for plugin in plugins])

    # -- bookkeeping ---------------------------------------------------------------------------------------------------

    def shutdown(self) -> None:
        """Withdraw the services, stop and free all controllers. The loop must not call update any more.

        A request that blocks (the init of a controller that waits for something) is not waited for longer than
        ``_SHUTDOWN_PATIENCE`` s.
        """
        self._closing = True
        self._root.shutdown()
        held = [lock for lock in (self._switching, self._services, self._loop) if lock.acquire(timeout=_SHUTDOWN_PATIENCE)]
        try:
            now = rospy.get_time() if rospy.core.is_initialized() else 0.0
            for loaded in self._controllers:
                if loaded.running:
                    self._guard(loaded, "stopping", loaded.controller.stop_request, now)
                loaded.nh.shutdown()
            self._controllers = ()
        finally:
            for lock in held:
                lock.release()

    def add_loader(self, base: str, names: Callable[[], list[str]], create: Callable[[str], int]) -> None:
        """Take types from a loader in C++ too, for those that no package exports.

        ``base``, ``names`` and ``create`` are as in ControllerTypes.add_loader.
        """
        self._types.add_loader(base, names, create)

    @property
    def controllers(self) -> list[LoadedController]:
        """What is loaded, in load order."""
        return list(self._controllers)

    def _find(self, name: str) -> LoadedController | None:
        return next((loaded for loaded in self._controllers if loaded.name == name), None)

    def _names(self) -> str:
        return ", ".join(loaded.name for loaded in self._controllers) or "none"

    def _exchange(self, controllers: tuple[LoadedController, ...]) -> bool:
        """Between two cycles. :return: False if a cycle does not end."""
        if not self._loop.acquire(timeout=LONGEST_CYCLE):
            return False
        self._controllers = controllers
        self._loop.release()
        return True


class _TypeProblem(Exception):
    """Continues the sentence 'Could not load controller ...'."""
