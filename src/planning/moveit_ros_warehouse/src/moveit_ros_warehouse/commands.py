"""The programs that fill a warehouse and empty it: from the running system, from and into text files, onto topics."""

from __future__ import annotations

import argparse
import math
import os
import re
import threading
import time
from collections.abc import Callable

import motion
import node_signals
import rosgraph
import rospy
import tf2_ros
from moveit_core import states
from moveit_core.scene_messages import UNNAMED, scene_message
from moveit_msgs.msg import Constraints, MotionPlanRequest, OrientationConstraint, PlanningScene, RobotState, RobotTrajectory
from moveit_ros_planning import robot_model, scene_text
from moveit_ros_planning.scene_monitor import SceneMonitor

from . import queries
from .location import connect
from .storage import StorageError, Warehouse

_SEND = 1.0  # s that subscribers have to connect, and messages to leave
_CONNECT = 10.0  # s that those have who already listen; a busy subscriber comes back after some seconds


def program(name: str, description: str, run: Callable, options: Callable = lambda parser: None) -> Callable[[], int]:
    """The main function of the node ``name``: ``run(arguments, warehouse)``; what goes wrong is one line and the exit code 1.

    :param description: for ``--help``. :param options: adds those of the node to its argparse parser.
    """

    def main() -> int:
        parser = argparse.ArgumentParser(prog=name, description=description)
        parser.add_argument("--host", default="", help="database file; any other name is that of upstream's server, and not needed")
        parser.add_argument("--port", type=int, help="accepted, and not needed")
        options(parser)
        arguments = parser.parse_args(rospy.myargv()[1:])
        node_signals.init_node(name, anonymous=True)
        try:
            warehouse = connect(arguments.host)
            rospy.loginfo("The warehouse is in %s", warehouse.path)
            code = run(arguments, warehouse)
            warehouse.close()
        except (StorageError, robot_model.DescriptionError, ValueError, OSError) as error:
            rospy.logfatal("%s", " ".join(str(error).split()))
            return 1
        return code or 0

    return main


def _tell_known(warehouse: Warehouse) -> None:
    for title, collection in (("scenes", warehouse.scenes), ("constraints", warehouse.constraints), ("robot states", warehouse.states)):
        names = collection.names()
        rospy.loginfo(
            "Previously stored %s:%s" if names else "There are no previously stored %s%s", title, "".join(f"\n * {name}" for name in names)
        )


# --- moveit_save_to_warehouse ---


class Listener:
    """Saves scenes, requests, constraints and states that are sent on topics."""

    def __init__(self, warehouse: Warehouse):
        self._warehouse = warehouse
        self._lock = threading.Lock()
        buffer = tf2_ros.Buffer()
        self._listener = tf2_ros.TransformListener(buffer)
        self._monitor = SceneMonitor(robot_model.load(), buffer)
        self._monitor.on_change(lambda kinds: self._guarded(self._scene))
        if self._name():  # it came while the monitor was being made
            self._guarded(self._scene)
        self._subscribers = [
            rospy.Subscriber(topic, kind, lambda message, handler=handler: self._guarded(handler, message), queue_size=100)
            for topic, kind, handler in (
                ("motion_plan_request", MotionPlanRequest, self._request),
                ("constraints", Constraints, self._constraints),
                ("robot_state", RobotState, self._state),
            )
        ]
        names = ("planning requests", "named constraints", "states")
        rospy.loginfo("Listening for scene updates on topics %s", ", ".join(self._monitor.topics()))
        for name, subscriber in zip(names, self._subscribers):
            rospy.loginfo("Listening for %s on topic %s", name, subscriber.resolved_name)

    def _guarded(self, handler: Callable, *message) -> None:
        with self._lock:
            try:
                handler(*message)
            except StorageError as error:
                rospy.logerr("%s", error)

    def _name(self) -> str:
        name = self._monitor.scene_name
        return "" if name == UNNAMED else name

    def _scene(self) -> None:
        name = self._name()
        if not name:
            rospy.loginfo_once("The scene has no name yet: scenes are saved when a planning scene with a name comes")
        elif not self._warehouse.scenes.has(name):
            self._warehouse.scenes.save(name, self._monitor.message())
            rospy.loginfo("Saved scene '%s'", name)

    def _request(self, message: MotionPlanRequest) -> None:
        name = self._name()
        if not name:
            rospy.loginfo("Scene name is empty. Not saving planning request.")
            return
        rospy.loginfo("Saved planning query '%s' for scene '%s'", self._warehouse.add_request(name, message), name)

    def _constraints(self, message: Constraints) -> None:
        if not message.name:
            rospy.loginfo("No name specified for constraints. Not saving.")
            return
        rospy.loginfo("%s constraints '%s'", "Replacing" if self._warehouse.constraints.has(message.name) else "Adding", message.name)
        self._warehouse.constraints.save(message.name, message)

    def _state(self, message: RobotState) -> None:
        names = set(self._warehouse.states.names())
        number = len(names)
        while f"S{number}" in names:
            number += 1
        rospy.loginfo("Adding robot state 'S%d'", number)
        self._warehouse.states.save(f"S{number}", message)

    def shutdown(self) -> None:
        """Stop listening."""
        for subscriber in self._subscribers:
            subscriber.unregister()
        self._monitor.shutdown()


def _listen(_arguments, warehouse: Warehouse) -> None:
    listener = Listener(warehouse)
    _tell_known(warehouse)
    node_signals.spin()
    listener.shutdown()


save_to_warehouse = program("save_to_warehouse", "Save scenes, planning requests, constraints and robot states from topics.", _listen)


# --- moveit_init_demo_warehouse ---


def _initialise(_arguments, warehouse: Warehouse) -> None:
    description = robot_model.load()
    scene = robot_model.prepare_scene(description)
    for collection in (warehouse.scenes, warehouse.requests, warehouse.results, warehouse.constraints, warehouse.states):
        collection.clear()
    message = scene_message(scene)
    message.name = "default"
    warehouse.scenes.save("default", message)
    rospy.loginfo("Added default scene: 'default'")
    warehouse.states.save("default", message.robot_state)
    rospy.loginfo("Added default state")
    model = description.model
    for name in model.groups:
        group = model.group(name)
        if not group.is_chain or not group.links:
            continue
        upright = OrientationConstraint(
            link_name=group.links[-1],
            absolute_x_axis_tolerance=0.1,
            absolute_y_axis_tolerance=0.1,
            absolute_z_axis_tolerance=math.pi,
            weight=1.0,
        )
        upright.header.frame_id, upright.orientation.w = model.frame, 1.0
        constraints = Constraints(name=f"{group.links[-1]}:upright", orientation_constraints=[upright])
        warehouse.constraints.save(constraints.name, constraints, robot=model.name, planning_group=name)
        rospy.loginfo("Added default constraint: '%s'", constraints.name)
    rospy.loginfo("Default MoveIt Warehouse was reset.")


init_demo = program("initialize_demo_db", "Empty the warehouse and put a default scene, state and constraints into it.", _initialise)


# --- texts ---


def _as_text(_arguments, warehouse: Warehouse) -> None:
    model = robot_model.load().model
    for name in warehouse.scenes.names():
        rospy.loginfo("Saving scene '%s'", name)
        _write(f"{name}.scene", scene_text.write(warehouse.scenes.load(name)))
        found = queries.Queries(name)
        related = f".*{re.escape(name)}.*"
        for state in warehouse.states.names(related):
            rospy.loginfo("Saving start state %s for scene %s", state, name)
            known = {
                joint: value for joint, value in queries.start_of(warehouse.states.load(state)).items() if joint in set(model.variables)
            }
            found.starts[state] = known
        for goal in warehouse.constraints.names(related):
            entry = queries.goal_of(warehouse.constraints.load(goal))
            if entry is None:
                rospy.logwarn("constraints '%s' are no pose of a link: they are not saved as a goal", goal)
                continue
            rospy.loginfo("Saving goal %s for scene %s", goal, name)
            found.goals[goal] = entry
        if found.starts or found.goals:
            _write(f"{name}.queries", queries.write(found))
    rospy.loginfo("Done.")


def _write(name: str, text: str) -> None:
    file = name.replace(os.path.sep, "_")
    with open(file, "w", encoding="utf-8") as out:
        out.write(text)
    rospy.loginfo("wrote %s", os.path.abspath(file))


save_as_text = program(
    "save_warehouse_as_text", "Write the scenes, start states and goals of the warehouse into text files of the present folder.", _as_text
)


def _text_options(parser) -> None:
    parser.add_argument("--queries", help="file of start states and goals")
    parser.add_argument("--scene", help="file of a scene")


def _from_text(arguments, warehouse: Warehouse) -> int:
    if not arguments.scene and not arguments.queries:
        rospy.logfatal("name the files: --scene FILE.scene, --queries FILE.queries, or both")
        return 1
    description = robot_model.load()
    scene = robot_model.prepare_scene(description)
    if arguments.scene:
        _import_scene(arguments.scene, scene, warehouse)
    if arguments.queries:
        _import_queries(arguments.queries, scene, warehouse)
    return 0


def _read(file: str, reader: Callable):
    with open(file, encoding="utf-8", errors="replace") as text:
        try:
            return reader(text.read())
        except ValueError as error:
            raise ValueError(f"{file}: {error}") from error


def _import_scene(file: str, scene: motion.PlanningScene, warehouse: Warehouse) -> None:
    read: PlanningScene = _read(file, lambda text: scene_text.read(text, scene.frame))
    message = scene_message(scene)
    message.name, message.world, message.object_colors = read.name, read.world, read.object_colors
    warehouse.scenes.save(message.name, message)
    rospy.loginfo("Imported scene '%s' with %d objects", message.name, len(message.world.collision_objects))


def _import_queries(file: str, scene: motion.PlanningScene, warehouse: Warehouse) -> None:
    found = _read(file, queries.read)
    for name, values in found.starts.items():
        state = scene.state
        unknown = sorted(set(values) - set(scene.model.variables))
        if unknown:
            rospy.logwarn(
                "%s: start state '%s' names %s, which the robot '%s' does not have",
                file,
                name,
                ", ".join(f"'{joint}'" for joint in unknown),
                scene.model.name,
            )
        state.set({joint: value for joint, value in values.items() if joint not in unknown})
        warehouse.states.save(name, states.robot_state_message(state))
        rospy.loginfo("Parsed start state '%s'", name)
    for name, (link, xyz, rpy) in found.goals.items():
        warehouse.constraints.save(name, queries.goal_constraints(name, link, xyz, rpy, scene.model.frame))
        rospy.loginfo("Parsed link constraint '%s'", name)


import_from_text = program(
    "import_from_text_to_warehouse", "Put scenes, start states and goals of text files into the warehouse.", _from_text, _text_options
)


# --- moveit_warehouse_broadcast ---


def _broadcast_options(parser) -> None:
    for name in ("scene", "constraint", "state"):
        parser.add_argument(f"--{name}", help=f"regular expression for the names of {name}s to publish")
    parser.add_argument("--planning_requests", action="store_true", help="also publish the requests of the scenes")
    parser.add_argument("--planning_results", action="store_true", help="also publish the results of these requests")
    parser.add_argument("--delay", type=float, default=0.001, help="s between messages")


def _publisher(topic: str, kind: type) -> rospy.Publisher:
    """A publisher that all who listen now, as the master knows, have found; or some of them, where one does not come."""
    publisher = rospy.Publisher(topic, kind, queue_size=100)
    listeners = next(
        (len(nodes) for name, nodes in rosgraph.Master(rospy.get_name()).getSystemState()[1] if name == publisher.resolved_name), 0
    )
    end = time.monotonic() + (_CONNECT if listeners else _SEND)
    while publisher.get_num_connections() < max(listeners, 1) and time.monotonic() < end and not rospy.is_shutdown():
        time.sleep(0.02)
    return publisher


def _broadcast(arguments, warehouse: Warehouse) -> int | None:
    if not (arguments.scene or arguments.constraint or arguments.state):
        rospy.logfatal("say what to publish: --scene NAME, --constraint NAME or --state NAME (regular expressions; --help)")
        return 1
    if arguments.scene:
        _broadcast_scenes(arguments, warehouse)
    for pattern, collection, topic, kind, title in (
        (arguments.constraint, warehouse.constraints, "constraints", Constraints, "constraints"),
        (arguments.state, warehouse.states, "robot_states", RobotState, "state"),
    ):
        if not pattern:
            continue
        publisher = _publisher(topic, kind)
        for name in _matching(collection, pattern, title):
            rospy.loginfo("Publishing %s '%s'", title, name)
            publisher.publish(collection.load(name))
            time.sleep(arguments.delay)
    time.sleep(_SEND)
    rospy.loginfo("Done.")
    return 0


def _matching(collection, pattern: str, title: str) -> list[str]:
    names = collection.names(pattern)
    if not names:
        rospy.logwarn("no %s fits '%s'; there are: %s", title, pattern, ", ".join(collection.names()) or "none")
    return names


def _broadcast_scenes(arguments, warehouse: Warehouse) -> None:
    publisher = _publisher("planning_scene", PlanningScene)
    requests = _publisher("motion_plan_request", MotionPlanRequest) if arguments.planning_requests else None
    results = _publisher("motion_plan_results", RobotTrajectory) if arguments.planning_results else None
    for name in _matching(warehouse.scenes, arguments.scene, "scene"):
        rospy.loginfo("Publishing scene '%s'", name)
        publisher.publish(warehouse.scenes.load(name))
        for query in warehouse.requests.names(scene=name) if requests or results else ():
            if requests:
                rospy.loginfo("Publishing query '%s'", query)
                requests.publish(warehouse.requests.load(query, scene=name))
            if results:
                for result in warehouse.results_of(name, query):
                    results.publish(result)
        time.sleep(arguments.delay)


broadcast = program("publish_warehouse_data", "Publish scenes, constraints and states of the warehouse.", _broadcast, _broadcast_options)
