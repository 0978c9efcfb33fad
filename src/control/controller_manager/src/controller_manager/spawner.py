"""The nodes ``spawner`` (loads and starts controllers, takes them down when it ends) and ``unspawner`` (the reverse)."""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Sequence

import node_signals
import rosparam
import rospy
import yaml
from controller_manager_msgs.srv import ListControllers, LoadController, SwitchController, SwitchControllerRequest, UnloadController
from controller_manager_msgs.utils import describe_controller_managers
from node_signals import orphans, services
from std_msgs.msg import Bool

#: s without an answer after which a waiting node says what it looks for and what there is
_HINT_AFTER = 5.0


def _parse(arguments: Sequence[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="spawner", description="Loads and starts controllers; stops and unloads them when it is ended.")
    parser.add_argument("--stopped", action="store_true", help="load the controllers, do not start them")
    parser.add_argument("--wait-for", metavar="TOPIC", help="do nothing until a std_msgs/Bool that is true arrives")
    parser.add_argument("--namespace", metavar="NS", default="", help="namespace of the controller manager")
    parser.add_argument(
        "--timeout",
        metavar="T",
        type=float,
        default=30.0,
        help="s to wait for each service of the controller manager; 0 or less waits for ever",
    )
    parser.add_argument("--no-timeout", action="store_true", help="wait for ever")
    parser.add_argument("--shutdown-timeout", metavar="T", type=float, help="accepted and ignored")
    parser.add_argument("controllers", metavar="controller", nargs="+", help="name, or a YAML file of controllers")
    parsed = parser.parse_args(arguments)
    if parsed.no_timeout or parsed.timeout <= 0.0:
        parsed.timeout = None
    return parsed


def wait_for_service(name: str, timeout: float | None) -> bool:
    """Wait for service ``name`` of a controller manager; after a few s say what is looked for and what is there.

    :param timeout: s; None waits for ever.
    :return: False if it did not come in time.
    """
    rospy.loginfo("Controller Spawner: Waiting for service %s", name)
    start, hinted = time.monotonic(), False
    while not rospy.is_shutdown():
        passed = time.monotonic() - start
        left = None if timeout is None else timeout - passed
        if left is not None and left <= 0.0:
            if rospy.get_param("/use_sim_time", False) and rospy.get_rostime().is_zero():
                rospy.loginfo("Controller Spawner: the simulated clock is still at zero; waiting on for it")
                start = time.monotonic()
                continue
            return False
        try:
            services.wait_for_service(name, timeout=min(1.0, left) if left is not None else 1.0)
            return True
        except rospy.ROSInterruptException:
            return False
        except rospy.ROSException:  # not yet there
            if not hinted and passed > _HINT_AFTER:
                hinted = True
                rospy.logwarn(
                    "Controller Spawner: still waiting for service %s. %s", rospy.resolve_name(name), describe_controller_managers()
                )
    return False


class Spawner:
    """One run of the spawner node."""

    def __init__(self, arguments: Sequence[str]):
        self._options = _parse(arguments)
        prefix = self._options.namespace
        if prefix and not prefix.endswith("/"):
            prefix += "/"
        self._prefix = f"{prefix}controller_manager/"
        self._loaded: list[str] = []
        self._heard: Bool | None = None

    def run(self) -> int:
        """:return: exit code."""
        orphans.end_with_launch()
        node_signals.init_node("spawner", anonymous=True)
        if self._options.shutdown_timeout is not None:
            rospy.logwarn("Controller Spawner: --shutdown-timeout has no effect")
        for service in ("load_controller", "switch_controller", "unload_controller"):
            if not wait_for_service(self._prefix + service, self._options.timeout):
                rospy.logwarn(
                    "Controller Spawner couldn't find the expected controller_manager ROS interface: there is no service %s. %s",
                    rospy.resolve_name(self._prefix + service),
                    describe_controller_managers(),
                )
                return 0
        if self._options.wait_for and not self._wait_for_topic(self._options.wait_for):
            return 0
        rospy.on_shutdown(self._take_down)
        try:
            self._bring_up()
        except rospy.ServiceException as error:
            if not self._shut_down_soon():
                rospy.logerr("Controller Spawner: the controller manager did not answer: %s", error)
        node_signals.spin()
        return 0

    def _wait_for_topic(self, topic: str) -> bool:
        subscriber = rospy.Subscriber(topic, Bool, lambda message: setattr(self, "_heard", message))
        start, patience = time.monotonic(), self._options.timeout or 30.0
        warned = False
        while not (self._heard and self._heard.data):
            time.sleep(0.01)
            if rospy.is_shutdown():
                return False
            if self._heard is None and not warned and time.monotonic() - start > patience:
                warned = True
                rospy.logwarn('Controller Spawner hasn\'t heard anything from its "wait for" topic (%s)', topic)
        subscriber.unregister()
        return True

    def _names(self) -> list[str]:
        """Names of the controllers; YAML files among the arguments go to the parameter server."""
        names: list[str] = []
        for argument in self._options.controllers:
            content = _read_yaml(argument) if os.path.isfile(argument) else None
            if content is None:
                names.append(argument)
            else:
                rosparam.upload_params(rospy.get_namespace(), content)
                names.extend(content)
        return names

    def _bring_up(self) -> None:
        load = rospy.ServiceProxy(self._prefix + "load_controller", LoadController)
        start: list[str] = []
        for name in self._names():
            rospy.loginfo("Loading controller: %s", name)
            if load(name).ok:
                self._loaded.append(name)
                start.append(name)
                continue
            state = self._state_of(name)
            if state is None:
                time.sleep(1.0)  # lets the manager's own error come first
                rospy.logerr("Failed to load %s", name)
            else:
                rospy.logerr(
                    "Failed to load %s: it is already loaded (%s) and stays when this spawner ends. If nobody "
                    "owns it any more, 'rosrun controller_manager controller_manager kill %s' removes it.",
                    name,
                    state,
                    name,
                )
                if state != "running":
                    start.append(name)
        rospy.loginfo("Controller Spawner: Loaded controllers: %s", ", ".join(self._loaded))
        if not self._options.stopped:
            self._start(start)

    def _state_of(self, name: str) -> str | None:
        listed = rospy.ServiceProxy(self._prefix + "list_controllers", ListControllers)().controller
        return next((controller.state for controller in listed if controller.name == name), None)

    def _start(self, names: list[str]) -> None:
        if self._switch(start=names):
            rospy.loginfo("Started controllers: %s", ", ".join(names))
        elif not self._shut_down_soon():
            rospy.logerr("Failed to start controllers: %s", ", ".join(names))

    @staticmethod
    def _shut_down_soon() -> bool:
        """Ctrl-C ends the manager too, which then answers waiting calls before this node hears of its own end."""
        deadline = time.monotonic() + 1.0
        while not rospy.core.is_shutdown_requested() and time.monotonic() < deadline:
            time.sleep(0.01)
        return rospy.core.is_shutdown_requested()

    def _switch(self, start: Sequence[str] = (), stop: Sequence[str] = (), strict: bool = True) -> bool:
        request = SwitchControllerRequest(
            start_controllers=list(start),
            stop_controllers=list(stop),
            strictness=SwitchControllerRequest.STRICT if strict else SwitchControllerRequest.BEST_EFFORT,
        )
        return rospy.ServiceProxy(self._prefix + "switch_controller", SwitchController)(request).ok

    def _take_down(self) -> None:
        rospy.loginfo("Shutting down spawner. Stopping and unloading controllers...")
        unload = rospy.ServiceProxy(self._prefix + "unload_controller", UnloadController)
        try:
            rospy.loginfo("Stopping all controllers...")
            self._switch(stop=self._loaded, strict=False)
            rospy.loginfo("Unloading all loaded controllers...")
            for name in reversed(self._loaded):
                unload(name)
        except (rospy.ServiceException, rospy.ROSException) as error:
            rospy.loginfo(
                "Controller Spawner couldn't reach controller_manager to take down controllers: %s (it has ended "
                "as well, so there is nothing left to do)",
                error,
            )


def _read_yaml(path: str) -> dict | None:
    """A YAML file of controllers; None if it is something else that happens to have a controller's name."""
    try:
        with open(path, encoding="utf-8") as file:
            content = yaml.safe_load(file)
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        rospy.logwarn(
            "file %s is no YAML file of controllers (%s); taking the argument as a controller's name", path, " ".join(str(error).split())
        )
        return None
    return content if isinstance(content, dict) else None


class Unspawner:
    """Keeps controllers stopped while it runs; starts again at the end what it stopped."""

    _PERIOD = 3.0

    def __init__(self, names: Sequence[str]):
        self._names = names
        self._stopped: list[str] = []

    def run(self) -> int:
        """:return: exit code."""
        orphans.end_with_launch()
        node_signals.init_node("unspawner", anonymous=True)
        if not all(wait_for_service(f"controller_manager/{name}", None) for name in ("list_controllers", "switch_controller")):
            return 0
        self._list = rospy.ServiceProxy("controller_manager/list_controllers", ListControllers)
        self._switch = rospy.ServiceProxy("controller_manager/switch_controller", SwitchController)
        rospy.on_shutdown(self._restart)
        while not rospy.core.is_shutdown_requested():
            try:
                self._stop_running()
            except rospy.ServiceException as error:
                if not rospy.core.is_shutdown_requested():
                    rospy.logwarn("the controller manager did not answer: %s", error)
            end = time.monotonic() + self._PERIOD
            while time.monotonic() < end and not rospy.core.is_shutdown_requested():
                time.sleep(0.05)
        node_signals.spin()
        return 0

    def _stop_running(self) -> None:
        running = [
            controller.name for controller in self._list().controller if controller.name in self._names and controller.state == "running"
        ]
        if running:
            rospy.loginfo("Stopping controllers: %s", ", ".join(running))
            self._stopped += [name for name in running if name not in self._stopped]
            self._switch(SwitchControllerRequest(stop_controllers=running, strictness=SwitchControllerRequest.BEST_EFFORT))

    def _restart(self) -> None:
        try:
            self._switch(SwitchControllerRequest(start_controllers=self._stopped, strictness=SwitchControllerRequest.BEST_EFFORT))
        except (rospy.ServiceException, rospy.ROSException) as error:
            rospy.logwarn("controllers %s could not be started again: %s", ", ".join(self._stopped), error)


UNSPAWNER_USAGE = """unspawner name1 name2 name3

\tStops controllers for as long as it runs, and starts them again when it ends.
\tUseful in launch files that need some joints for themselves for a while."""
