"""``gz``: what students type to ask or change a running simulator. It talks to the node ``/gazebo`` by its
services (of ROS_NAMESPACE, where one is); ``gz topic`` is about Gazebo's own transport."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from typing import Any

import node_signals
import rosgraph
import rospy
from gazebo_msgs.srv import ApplyJointEffort, GetModelProperties, GetPhysicsProperties, JointRequest, SetPhysicsProperties
from ode_sim.description import DescriptionError, load_world, read_model
from ode_sim.description.model import World
from ode_sim.description.sdf_writer import model_text, world_text
from std_srvs.srv import Empty

from gazebo_ros.commands.asking import call
from gazebo_ros.commands.command_line import VERSION, Failure
from gazebo_ros.commands.gz_model import camera, model
from gazebo_ros.commands.gz_stats import stats
from gazebo_ros.commands.gz_topic import topic
from gazebo_ros.srv import StepWorld

_TARGETS = tuple(f"--{of}-{what}" for of in ("pos", "vel") for what in "tpid")


def world(options: argparse.Namespace) -> None:
    """Pause, step and reset."""
    if options.pause is not None:
        call("pause_physics" if options.pause else "unpause_physics", Empty)
    if options.step or options.multi_step:
        call("step", StepWorld, options.multi_step or 1)
    if options.reset_all:
        call("reset_simulation", Empty)
    if options.reset_time:
        call("reset_time", Empty)
    if options.reset_models:
        call("reset_world", Empty)


def physics(options: argparse.Namespace) -> None:
    """Step size, rate, gravity, iterations."""
    now = call("get_physics_properties", GetPhysicsProperties)
    if options.gravity:
        try:
            now.gravity.x, now.gravity.y, now.gravity.z = map(float, options.gravity.split(","))
        except ValueError:
            raise Failure(f"-g {options.gravity}: three numbers with commas are needed, as in 0,0,-9.8") from None
    if options.iters is not None:
        now.ode_config.sor_pgs_iters = options.iters
    call(
        "set_physics_properties",
        SetPhysicsProperties,
        now.time_step if options.step_size is None else options.step_size,
        now.max_update_rate if options.update_rate is None else options.update_rate,
        now.gravity,
        now.ode_config,
    )


def sdf(options: argparse.Namespace) -> None:
    """Check a URDF, SDF or world file, or print it as SDF."""
    if options.convert:
        raise Failure(f"files are not rewritten in their place; gz sdf -p {options.convert} > NEW_FILE prints it as SDF 1.6")
    if options.describe or options.doc:
        raise Failure("the format is not described here, see http://sdformat.org/spec; gz sdf -k FILE says what is wrong in a file")
    path = options.check or options.print
    try:
        with open(path, encoding="utf-8") as stream:
            text = stream.read()
        read, problems = load_world(path) if "<world" in text else read_model(text, file=path)
    except (DescriptionError, OSError, UnicodeDecodeError) as error:
        raise Failure(f"{path}: {error}" if isinstance(error, UnicodeDecodeError) else str(error)) from error
    for problem in problems:
        print(problem, file=sys.stdout if options.check else sys.stderr)
    if options.check:
        print("Check complete")
    else:
        written = world_text(read) if isinstance(read, World) else model_text(read)
        print(written.replace("<uri>package://", "<uri>model://"), end="")  # as Gazebo does: SDF knows no packages


def joint(options: argparse.Namespace) -> None:
    """Put a force or torque on a joint, from now on; 0 ends it."""
    if (
        any(getattr(options, name[2:].replace("-", "_")) is not None for name in _TARGETS)
        or not options.joint_name
        or options.force is None
    ):
        raise Failure(
            "a joint (-j) and its force (-f, N or Nm) are needed; targets of position and velocity are "
            "the work of a controller: see ros_control"
        )
    if options.model_name:
        names = call("get_model_properties", GetModelProperties, options.model_name).joint_names
        if options.joint_name not in names:
            raise Failure(f"model {options.model_name} has no joint {options.joint_name}; it has {', '.join(names)}")
    call("clear_joint_forces", JointRequest, options.joint_name)
    if options.force:
        call("apply_joint_effort", ApplyJointEffort, options.joint_name, options.force, rospy.Time(), rospy.Duration(-1))


def log(_options: argparse.Namespace) -> None:
    """Not here: rosbag records and plays."""
    raise Failure(
        "logs of world states are not written here; rosbag record /gazebo/model_states records, and the same "
        "world, seed and commands give the same run again"
    )


def marker(_options: argparse.Namespace) -> None:
    """Not here: RViz shows markers."""
    raise Failure("markers in the simulator's window are not drawn here; RViz shows those of visualization_msgs/Marker, on a topic of ROS")


def debug(_options: argparse.Namespace) -> None:
    """Not here: gzserver --verbose tells."""
    raise Failure("there is nothing of it here; gzserver --verbose says more, gz stats how fast it runs, and ~/.ros/log has the logs")


def helps(options: argparse.Namespace) -> None:
    """What there is, or the options of one command."""
    try:
        parser().parse_args([options.about, "--help"] if options.about else ["--help"])
    except SystemExit as end:
        if end.code:
            raise Failure(f"no command {options.about}") from None


def _options_of_things(command: Callable[[Any], argparse.ArgumentParser]) -> None:
    add = command(model).add_argument
    add("-m", "--model-name", default="", help="without it: list the models")
    add("-d", "--delete", action="store_true")
    add("-i", "--info", action="store_true")
    add("-p", "--pose", action="store_true", help="print x y z roll pitch yaw")
    add("-f", "--spawn-file", metavar="FILE", help="URDF or SDF")
    add("-s", "--spawn-string", action="store_true", help="URDF or SDF from standard input")
    for name in ("x", "y", "z"):
        add(f"-{name}", f"--pose-{name}", dest=name, type=float, default=0.0, help="m; of a file the place of its own <pose> is taken")
    for short, name in (("R", "roll"), ("P", "pitch"), ("Y", "yaw")):
        add(f"-{short}", f"--{name}", f"--pose-{short}", dest=name, type=float, default=0.0, help="rad")
    add = command(camera).add_argument
    add("-l", "--list", action="store_true", help="as model::link::sensor")
    add("-c", "--camera-name", default="", help="accepted, to say what to do instead")
    add("-f", "--follow", metavar="MODEL", help="accepted, to say what to do instead")


def _options_of_topics(command: Callable[..., argparse.ArgumentParser]) -> None:
    add = command(topic, of_a_world=False).add_argument
    add("-l", "--list", action="store_true")
    for short, name in (("e", "echo"), ("i", "info"), ("z", "hz"), ("b", "bw"), ("p", "publish")):
        add(f"-{short}", f"--{name}", metavar="TOPIC")
    add("-r", "--request", metavar="WHAT", help="entity_list, entity_info, entity_delete, or what a plugin answers; of -m")
    add("-m", "--msg", metavar="TEXT", help="the message of -p in protobuf's text format, as 'pause: true'; of -r what it is about")
    add("-f", "--file", help="which holds that text")
    add("-v", "--view", nargs="?", const=True, metavar="TOPIC", help="no window for them here")
    add("-u", "--unformatted", action="store_true", help="each message in one line")
    add("-w", "--world-name", default="", help="what ~ stands for, behind /gazebo/; without it: the world that runs")
    add("-d", "--duration", type=float, help="s of showing or measuring; without it: until Ctrl-C")


def _options_of_sdf(command: Callable[..., argparse.ArgumentParser]) -> None:
    checker = command(sdf, of_a_world=False)
    add = checker.add_mutually_exclusive_group(required=True).add_argument
    add("-k", "--check", metavar="FILE")
    add("-p", "--print", metavar="FILE", help="a URDF becomes a model in SDF")
    add("-c", "--convert", metavar="FILE", help="accepted, to say what to do instead")
    add("-d", "--describe", action="store_true", help="accepted, to say what to do instead")
    add("-o", "--doc", action="store_true", help="accepted, to say what to do instead")
    checker.add_argument("-v", "--version", help="accepted: 1.6 is printed")


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser(
        prog="gz",
        description="Ask or change a running simulator (the node gazebo of ROS_NAMESPACE, or /gazebo).",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    top.add_argument("-v", "--version", action="version", version=VERSION)
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(f: Any, name: str = "", of_a_world: bool = True) -> argparse.ArgumentParser:
        added = commands.add_parser(name or f.__name__, help=f.__doc__, description=f.__doc__)
        added.set_defaults(run=f)
        if of_a_world:
            added.add_argument("-w", "--world-name", default="", help="accepted: a simulator has one world")
        return added

    _options_of_things(command)
    add = command(world).add_argument
    add("-p", "--pause", type=int, choices=(0, 1))
    add("-s", "--step", action="store_true")
    add("-m", "--multi-step", type=int, metavar="N")
    add("-r", "--reset-all", action="store_true", help="time and models")
    add("-t", "--reset-time", action="store_true")
    add("-o", "--reset-models", action="store_true")
    add = command(physics).add_argument
    add("-s", "--step-size", type=float, help="s")
    add("-u", "--update-rate", type=float, help="steps per second, 0 = as fast as possible")
    add("-g", "--gravity", metavar="X,Y,Z", help="m/s^2")
    add("-i", "--iters", type=int)
    add = command(stats).add_argument
    add("-d", "--duration", type=float, help="s; without it: until Ctrl-C")
    add("-p", "--plot", action="store_true", help="columns with commas, for programs")
    add = command(joint).add_argument
    add("-m", "--model-name", default="")
    add("-j", "--joint-name", default="")
    add("-f", "--force", type=float, help="N or Nm")
    for name in _TARGETS:
        add(name, type=float, help=argparse.SUPPRESS)
    _options_of_topics(command)
    for absent in (log, marker, debug):
        command(absent, of_a_world=False)
    command(helps, "help", of_a_world=False).add_argument("about", nargs="?", default="", metavar="COMMAND")
    _options_of_sdf(command)
    return top


def main(arguments: list[str]) -> int:
    """Exit code: 0 done, 1 refused, 2 wrong options."""
    options, left = parser().parse_known_args(rospy.myargv(["gz", *arguments])[1:])
    try:
        if options.run in (log, marker, debug):
            options.run(options)
        # Words that belong to no option are passed over, as Gazebo does: many write the message's type behind -p TOPIC.
        unknown = [word for word in left if options.run is not topic or word.startswith("-")]
        if unknown:
            print(f"gz {options.command}: what is {unknown[0]}? gz help {options.command} lists the options", file=sys.stderr)
            return 2
        if options.run not in (sdf, helps, topic):
            if not rosgraph.is_master_online():
                raise Failure(f"no ROS master at {rosgraph.get_master_uri()}; start the simulator first")
            node_signals.init_node("gz", anonymous=True, disable_rostime=True)
        options.run(options)
    except rospy.ROSInterruptException:  # Ctrl-C
        return 1
    except Failure as error:
        print(f"gz {options.command}: {error}", file=sys.stderr)
        return 1
    return 0
