"""The node ``gazebo``: from the command line to a running world, and to its end."""

from __future__ import annotations

import gc
import logging
import os
import signal
import sys
import threading
import time
import traceback
import xmlrpc.client
from typing import Any

import node_signals
import ode_sim
import rosgraph
import rospkg
import rospy
from node_signals import bounded_calls, master_watch, orphans, verbose
from ode_sim.description import DescriptionError, Problem, ResourceFinder, load_world
from ode_sim.description import model as d
from rospy.names import load_mappings

from gazebo_ros import compiled
from gazebo_ros.api.clock import ClockPublisher, stand_as_subscriber
from gazebo_ros.api.forces import ForceJobs
from gazebo_ros.api.joint_commands import JointCommands
from gazebo_ros.api.joints import JointServices
from gazebo_ros.api.lights import LightServices
from gazebo_ros.api.metrics import MetricsPublisher
from gazebo_ros.api.models import ModelServices
from gazebo_ros.api.on_demand import OnDemand
from gazebo_ros.api.physics import PhysicsServices
from gazebo_ros.api.pictures import PictureServices
from gazebo_ros.api.ready import Ready
from gazebo_ros.api.spawning import SpawnServices
from gazebo_ros.api.states import StatePublishers
from gazebo_ros.api.stepping import SteppingServices
from gazebo_ros.api.surfaces import SurfaceServices
from gazebo_ros.api.timeline import TimelineServices
from gazebo_ros.api.view import ViewServices
from gazebo_ros.commands import command_line
from gazebo_ros.delivery import Delivery
from gazebo_ros.finding import make_finder
from gazebo_ros.first_view import first_view
from gazebo_ros.plugin_host import PluginHost, library_key
from gazebo_ros.server import Server

BUILTIN = ["libgazebo_ros_api_plugin.so", "libgazebo_ros_paths_plugin.so"]
_EMPTY_WORLD = "worlds/empty.world"
_SWITCH_INTERVAL = 2e-4  # s that another thread may keep the physics thread from its next step
_TAKEN = 255  # exit code of Gazebo beside another one
_LAST_RESORT = 1.5  # s from a signal to the end of the process, whatever a plugin does


def main() -> None:
    """Run the server and end the process."""
    try:
        code = _run()
    except DescriptionError as error:  # of the empty world, too
        rospy.logfatal("%s", error)
        code = 1
    except Exception as error:  # rospy's threads would end the process with 0
        sys.excepthook(type(error), error, error.__traceback__)
        code = 1
    logging.shutdown()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # tearing the interpreter down under rospy's threads would take seconds


def _run() -> int:
    ending = _Ending()
    orphans.end_with_launch()
    options = command_line.parse(rospy.myargv()[1:])
    _wait_for_master(ending)
    if _runs_already():
        return _TAKEN
    _use_sim_time(True)
    node_signals.before_init_node()
    # rospy's clock would come back from the /clock that this node publishes: the server sets it without that detour
    rospy.init_node("gazebo", disable_rostime=True, disable_signals=True, log_level=verbose.level(options.verbose))
    rospy.on_shutdown(ending.request)
    for line in command_line.remarks(options):
        rospy.logwarn("%s", line)
    sim_time = bool(rospy.get_param("/use_sim_time", True))
    master_watch.on_return(lambda: _use_sim_time(sim_time))
    server = make_server(options, sim_time)
    if sim_time:
        stand_as_subscriber()
    compiled.offer_transport(server)
    master_watch.watch()
    ending.follow(server)
    gc.collect()
    gc.freeze()  # what is there stays: collections in mid-run need not look at it
    gc.enable()
    sys.setswitchinterval(_SWITCH_INTERVAL)
    physics = _PhysicsThread(server)
    physics.start()
    while physics.is_alive():
        physics.join(1.0)
    _leave_ros()
    return 1 if physics.failed else 0


def _use_sim_time(value: bool) -> None:
    """Tell the nodes that come later, unless somebody has said otherwise."""
    master = rosgraph.Master("/gazebo")
    if not master.hasParam("/use_sim_time"):
        master.setParam("/use_sim_time", value)


def _leave_ros() -> None:
    """Unregister the node, without waiting for rospy's idle threads afterwards."""
    unregistered = threading.Event()
    rospy.core.add_shutdown_hook(lambda reason: unregistered.set())  # the last hook
    threading.Thread(target=rospy.signal_shutdown, args=("the simulator ended",), daemon=True).start()
    unregistered.wait(_LAST_RESORT)


class _Ending:
    """Turns SIGINT, SIGTERM and a ROS shutdown into the orderly end of the step loop, in bounded time."""

    def __init__(self):
        self.requested = False
        self._server: Server | None = None
        signal.signal(signal.SIGINT, lambda number, frame: self.request())
        signal.signal(signal.SIGTERM, lambda number, frame: self.request())

    def follow(self, server: Server) -> None:
        self._server = server
        if self.requested:
            server.stop()

    def request(self) -> None:
        if self.requested:
            return
        self.requested = True
        if self._server is None:
            os._exit(0)  # nothing has been started yet
        timer = threading.Timer(_LAST_RESORT, os._exit, (0,))
        timer.daemon = True
        try:
            timer.start()
        except RuntimeError:  # no thread to be had
            os._exit(0)
        self._server.stop()


def _wait_for_master(ending: _Ending) -> None:
    warned = False
    while not bounded_calls.master_answers("/gzserver") and not ending.requested:
        if not warned:
            print(f"gzserver: no ROS master at {rosgraph.get_master_uri()}; waiting for one (start roscore)", file=sys.stderr, flush=True)
            warned = True
        time.sleep(0.5)


def _asked(uri: str) -> Any:
    return xmlrpc.client.ServerProxy(uri, transport=bounded_calls.Transport(2.0))


def _runs_already() -> bool:
    """A node of this name answers: many launch files start a simulator although they only spawn into the one that runs.

    To register would end that one. A registration without a process behind it, left by a kill, does not count.
    """
    names = load_mappings(sys.argv)
    name = rosgraph.names.ns_join(rosgraph.names.get_ros_namespace(argv=sys.argv), names.get("__name", "gazebo"))
    try:
        code, _, uri = _asked(rosgraph.get_master_uri()).lookupNode(name, name)
        if code != 1 or _asked(uri).getName(name)[2] != name:
            return False
        pid = _asked(uri).getPid(name)[2]
    except (OSError, ValueError, TypeError, LookupError, xmlrpc.client.Error):
        return False  # whatever is there is no node
    print(
        f"gzserver: {name} runs already (process {pid}) and goes on, this one ends; models are spawned into that world. "
        f"For another world end it first: rosnode kill {name}",
        file=sys.stderr,
        flush=True,
    )
    return True


def _load_world(name: str, finder: ResourceFinder) -> tuple[str, d.World, list[Problem]]:
    """The name and the description of a world; of the empty one, with one line, when that cannot be had."""
    try:
        return (name, *load_world(name, finder))
    except DescriptionError as error:
        rospy.logerr("%s. Using %s instead.", error, _EMPTY_WORLD)
        return (_EMPTY_WORLD, *load_world(_EMPTY_WORLD, finder))


def make_server(options, sim_time: bool = True) -> Server:
    """The world, its node and everything the node offers; plugins are started by ``Server.run``.

    :param options: of the command line, parsed
    :param sim_time: ROS's time is the simulation's
    """
    rospack = rospkg.RosPack()
    finder = make_finder(rospack)
    name, description, problems = _load_world(options.world, finder)
    world = ode_sim.World(description, seed=options.seed or 0, finder=finder, problems=problems)
    host = PluginHost(rospack, BUILTIN)
    delivery = None
    if options.lockstep:
        delivery = Delivery({"/rosout", *map(rospy.resolve_name, ("~view", "~view_contacts"))})
        delivery.install()
    server = Server(
        world,
        description,
        finder,
        host,
        paused=options.pause,
        lockstep=options.lockstep,
        delivery=delivery,
        iterations=options.iters,
        ros_time=sim_time,
    )
    server.first_view = first_view(name, finder)
    server.report_problems(f"world {description.name}")
    for library in options.server_plugin:
        if library_key(library) not in map(library_key, BUILTIN):
            compiled.load_system(server, library, ["gzserver", *rospy.myargv()[1:]])
    ClockPublisher(server, int(rospy.get_param("~pub_clock_frequency", 0)))
    if rospy.get_param("~enable_ros_network", True):
        _offer_api(server)
    return server


def _offer_api(server: Server) -> None:
    ForceJobs(server)  # first of the step callbacks after /clock: controllers come later and see what they add
    StatePublishers(server)
    MetricsPublisher(server)
    ModelServices(server)
    JointServices(server)
    LightServices(server)
    SpawnServices(server)
    SteppingServices(server)
    PictureServices(server)
    on_demand = OnDemand()
    ViewServices(server, on_demand)
    TimelineServices(server)
    SurfaceServices(server)
    JointCommands(server)
    physics = PhysicsServices(server)
    rospy.loginfo("Finished loading Gazebo ROS API Plugin.")
    physics.start_reconfigure()
    ready = Ready()
    on_demand.offer("~ready", ready.publisher, ready.gone)
    server.started.connect(ready.set)
    on_demand.start()


class _PhysicsThread(threading.Thread):
    def __init__(self, server: Server):
        super().__init__(name="physics", daemon=True)
        self.failed = False
        self._server = server

    def run(self) -> None:
        try:
            self._server.run()
        except Exception as error:  # the end of the simulation, but the user must read why
            self.failed = True
            rospy.logfatal("the simulation broke down: %s: %s", type(error).__name__, error)
            rospy.logdebug("%s", traceback.format_exc())
