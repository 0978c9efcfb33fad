"""spawn_model: puts a robot or an object into the running simulator."""

from __future__ import annotations

import argparse
import math
import re
import sys
import threading
import xml.etree.ElementTree as ET
from collections.abc import Callable

import node_signals
import rosgraph
import rospy
from gazebo_msgs.srv import DeleteModel, GetPhysicsProperties, GetWorldProperties
from geometry_msgs.msg import Point, Pose, Quaternion
from node_signals import orphans
from node_signals.services import wait_for_service
from std_srvs.srv import Empty

from gazebo_ros import gazebo_interface
from gazebo_ros.commands.command_line import Failure

_DATABASE = '<sdf version="1.4"><world name="default"><include><uri>model://{}</uri></include></world></sdf>'
_PACKAGE = re.compile(r"""(<mesh\b[^>]*?\bfilename\s*=\s*["'])package://""")
_ANSWER = 20.0  # s, in which the simulator answers between two steps


def parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="spawn_model", description="Spawn a model in the simulator.")
    form = parser.add_mutually_exclusive_group(required=True)
    form.add_argument("-urdf", action="store_true", help="the text is URDF")
    form.add_argument("-sdf", action="store_true", help="the text is SDF")
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument("-file", metavar="FILE", help="read the text from a file")
    source.add_argument("-param", metavar="NAME", help="read the text from a ROS parameter")
    source.add_argument("-database", metavar="MODEL", help="a model of the model path, by its directory's name")
    source.add_argument("-stdin", action="store_true", help="read the text from standard input")
    parser.add_argument("-model", required=True, metavar="NAME", help="name of the new model")
    parser.add_argument("-reference_frame", default="", metavar="ENTITY", help="pose is relative to this model or link")
    parser.add_argument("-gazebo_namespace", default="/gazebo", metavar="NS", help="of the simulator's services")
    parser.add_argument("-robot_namespace", default=rospy.get_namespace(), metavar="NS", help="given to its plugins")
    parser.add_argument("-unpause", action="store_true", help="unpause the simulation afterwards")
    parser.add_argument(
        "-paused_until_controllers",
        action="store_true",
        help="pause the simulation before, and let it run when the "
        "first controllers that move something start: joints do not fall meanwhile",
    )
    parser.add_argument("-wait", metavar="MODEL", help="wait until this model exists")
    for name in "xyz":
        parser.add_argument(f"-{name}", type=float, default=0.0, help="m")
    for name, angle in (("R", "roll"), ("P", "pitch"), ("Y", "yaw")):
        parser.add_argument(f"-{name}", type=float, default=0.0, help=f"{angle}, rad")
    parser.add_argument(
        "-J",
        dest="joints",
        nargs=2,
        action="append",
        default=[],
        metavar=("JOINT", "POSITION"),
        help="initial position of a joint, rad or m; may be repeated",
    )
    parser.add_argument("-package_to_model", action="store_true", help="turn package:// of meshes into model://")
    parser.add_argument("-b", action="store_true", dest="bond", help="stay, and delete the model when ended")
    for name in ("roll", "pitch", "yaw"):
        if f"-{name}" in arguments or f"--{name}" in arguments:  # Python's own words are of a -y whose number is 'aw'
            parser.error(f"argument -{name}: the angle is called -{name[0].upper()}")
    options = parser.parse_args(arguments)
    for joint in options.joints:
        try:
            joint[1] = float(joint[1])
        except ValueError:
            parser.error(f"argument -J: position of joint {joint[0]} is '{joint[1]}', a number is needed")
    return options


def pose_of(options: argparse.Namespace) -> Pose:
    """From x y z (m) and roll, pitch, yaw (rad)."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(angle / 2), math.sin(angle / 2)) for angle in (options.R, options.P, options.Y))
    return Pose(
        Point(options.x, options.y, options.z),
        Quaternion(sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy),
    )


def model_text(options: argparse.Namespace) -> tuple[str, str]:
    """The XML to send, from wherever the options say, and what that place is called: to the letter, so that the server's line
    numbers are the file's.

    :raises Failure: not there, or not XML
    """
    if options.file:
        rospy.loginfo("Loading model XML from file %s", options.file)
        try:
            with open(options.file, encoding="utf-8") as stream:
                text, where = stream.read(), options.file
        except OSError as error:
            raise Failure(f"cannot read {options.file}: {error.strerror}") from error
        except UnicodeDecodeError as error:
            raise Failure(f"cannot read {options.file}: it is no text in UTF-8 (byte {error.start}); save it as such") from error
    elif options.param:
        rospy.loginfo("Loading model XML from ros parameter %s", options.param)
        where = f"parameter {rospy.resolve_name(options.param)}"
        try:
            text = rospy.get_param(options.param)
        except KeyError:
            raise Failure(
                f'{where} is not set; load the robot first, as in <param name="{options.param}" command="$(find xacro)/xacro ..."/>'
            ) from None
    elif options.database:
        rospy.loginfo("Loading model XML from Gazebo Model Database")
        text, where = _DATABASE.format(options.database), "-database"
    else:
        rospy.loginfo("Loading model XML from stdin")
        text, where = sys.stdin.read(), "standard input"
    try:
        ET.fromstring(text)
    except (ET.ParseError, TypeError, ValueError) as error:
        raise Failure(f"{where} is not well-formed XML: {error}") from error
    return _PACKAGE.sub(r"\1model://", text) if options.package_to_model else text, where


def wait_for_model(name: str, gazebo_namespace: str) -> None:
    """Wait until the simulator in ``gazebo_namespace`` has the model ``name``.

    Asks ten times a wall second: a paused simulation publishes nothing, and its time stands still.

    :raises Failure: the simulator is gone
    """
    rospy.loginfo("Waiting for model %s before proceeding.", name)
    service = gazebo_namespace + "/get_world_properties"
    wait_for_service(service)
    world = rospy.ServiceProxy(service, GetWorldProperties, persistent=True)
    try:
        while not rospy.is_shutdown() and name not in world().model_names:
            rospy.rostime.wallsleep(0.1)
    except rospy.ServiceException as error:
        raise Failure(f"the simulator ended while model {name} was waited for: {error}") from error


class Bond:
    """``-b``: the model goes when this node ends, also when that happens while it is being spawned.

    Shutdown hooks run in a thread of their own beside the main thread, see node_signals.
    """

    def __init__(self, options: argparse.Namespace):
        self._options = options
        self._lock = threading.Lock()
        self._answered = threading.Event()
        self._asked = self._ended = self._spawned = False
        rospy.on_shutdown(self._end)

    def spawn(self, ask: Callable[[], bool]) -> bool:
        """:param ask: asks the simulator for the model. :return: its answer"""
        with self._lock:
            if self._ended:
                raise rospy.ROSInterruptException("ended before the model was spawned")
            self._asked = True
        try:
            self._spawned = ask()
        finally:
            self._answered.set()
        return self._spawned

    def _end(self) -> None:
        with self._lock:
            self._ended = True
        if self._asked:
            self._answered.wait(_ANSWER)
        if self._spawned:
            _delete(self._options)


class Hold:
    """``-paused_until_controllers``: the world stands still from now on; the controller manager of the model lets it run."""

    def __init__(self, options: argparse.Namespace):
        self._options = options
        self._parameter = f"{options.gazebo_namespace}/paused_until_controllers/{options.model}"
        physics = _service(options.gazebo_namespace, "get_physics_properties", GetPhysicsProperties)()
        self._was_paused = physics.pause
        rospy.set_param(self._parameter, True)
        _service(options.gazebo_namespace, "pause_physics", Empty)()

    def spawned(self, done: bool) -> None:
        """:param done: the model is there. Its plugin has taken the parameter by now, or will never do it."""
        if not rospy.has_param(self._parameter):
            rospy.loginfo("The simulation is paused until controllers of model %s start", self._options.model)
            return
        rospy.delete_param(self._parameter)
        if done:
            rospy.logwarn(
                "model %s has no controllers to wait for (its description names no libgazebo_ros_control.so): "
                "-paused_until_controllers has no effect",
                self._options.model,
            )
        if not self._was_paused:
            _unpause(self._options.gazebo_namespace)


def spawn(options: argparse.Namespace) -> None:
    """
    :raises Failure: it did not work; the simulator's own reason has been logged
    """
    bond = Bond(options) if options.bond else None
    text, where = model_text(options)
    if options.wait:
        wait_for_model(options.wait, options.gazebo_namespace)
    client = gazebo_interface.spawn_urdf_model_client if options.urdf else gazebo_interface.spawn_sdf_model_client

    def ask() -> bool:
        return bool(
            client(
                options.model,
                text,
                options.robot_namespace,
                pose_of(options),
                options.reference_frame,
                options.gazebo_namespace,
                origin=where,
            )
        )

    if bond:  # from here on its end waits for the answer, so the simulator must be there
        service = f"{options.gazebo_namespace}/spawn_{'urdf' if options.urdf else 'sdf'}_model"
        wait_for_service(service)
    held = Hold(options) if options.paused_until_controllers else None
    done = bond.spawn(ask) if bond else ask()
    if held:
        held.spawned(done)
    if not done:
        raise Failure(f"model {options.model} was not spawned")
    if options.joints:
        names, positions = zip(*options.joints)
        if not gazebo_interface.set_model_configuration_client(
            options.model, options.param or "", list(names), list(positions), options.gazebo_namespace
        ):
            raise Failure(f"model {options.model} is spawned, but its joints were not set")
    if options.unpause and not held:
        _unpause(options.gazebo_namespace)


def _service(gazebo_namespace: str, name: str, kind: type) -> rospy.ServiceProxy:
    wait_for_service(f"{gazebo_namespace}/{name}")
    return rospy.ServiceProxy(f"{gazebo_namespace}/{name}", kind)


def _unpause(gazebo_namespace: str) -> None:
    rospy.loginfo("Unpausing physics")
    name = gazebo_namespace + "/unpause_physics"
    wait_for_service(name)
    try:
        rospy.ServiceProxy(name, Empty)()
    except rospy.ServiceException as error:
        raise Failure(f"the simulation was not unpaused: {error}") from error


def _delete(options: argparse.Namespace) -> None:
    """At the end of ``-b``; the simulator may be gone already."""
    rospy.loginfo("Deleting model %s", options.model)
    try:
        rospy.ServiceProxy(options.gazebo_namespace + "/delete_model", DeleteModel)(options.model)
    except (rospy.ServiceException, rospy.ROSException) as error:
        rospy.loginfo("model %s was not deleted: %s", options.model, error)


def main() -> int:
    """Exit code: 0 spawned, 1 not, 2 wrong options."""
    options = parse(rospy.myargv()[1:])
    if not rosgraph.is_master_online():
        print(f"spawn_model: no ROS master at {rosgraph.get_master_uri()}; start the simulator first", file=sys.stderr)
        return 1
    orphans.end_with_launch()
    node_signals.init_node("spawn_model", anonymous=True)
    try:
        spawn(options)
    except Failure as error:
        rospy.logerr("Spawn service failed. Exiting. Reason: %s", error)
        return 1
    except rospy.ROSInterruptException:
        return 1
    if options.bond:
        rospy.loginfo("Waiting for shutdown to delete model %s", options.model)
        node_signals.spin()
    return 0
