"""``gz``: what students type to ask or change a running simulator. It talks to the node ``/gazebo`` by its
services; ``gz topic`` is about Gazebo's own transport."""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

import node_signals
import rosgraph
import rospy
from gazebo_msgs.msg import ModelState, PerformanceMetrics
from gazebo_msgs.srv import (
    ApplyJointEffort,
    DeleteModel,
    GetModelProperties,
    GetModelState,
    GetPhysicsProperties,
    GetWorldProperties,
    JointRequest,
    SetModelState,
    SetPhysicsProperties,
    SpawnModel,
)
from geometry_msgs.msg import Point, Pose, Quaternion
from ode_sim import math3
from ode_sim.description import DescriptionError, load_world, read_model
from ode_sim.description.model import World
from ode_sim.description.sdf_writer import model_text, world_text
from std_srvs.srv import Empty

from gazebo_ros.commands.command_line import VERSION, Failure
from gazebo_ros.commands.gz_topic import topic
from gazebo_ros.srv import StepWorld


def call(name: str, service: type, *arguments: Any) -> Any:
    """The answer of ``/gazebo/<name>``, a ``service`` of that class, to ``arguments``.

    :raises Failure: no simulator, or it refuses
    """
    try:
        rospy.wait_for_service(f"/gazebo/{name}", 2.0)
        response = rospy.ServiceProxy(f"/gazebo/{name}", service)(*arguments)
    except rospy.ROSInterruptException:
        raise
    except (rospy.ROSException, rospy.ServiceException) as error:
        raise Failure(f"no simulator answers at {rosgraph.get_master_uri()} (/gazebo/{name}): {error}") from error
    if not getattr(response, "success", True):
        raise Failure(response.status_message)
    return response


def _pose(options: argparse.Namespace) -> Pose:
    return Pose(Point(options.x, options.y, options.z), Quaternion(*math3.quat_from_rpy(options.roll, options.pitch, options.yaw)))


def model(options: argparse.Namespace) -> None:
    """List, show, move, spawn or delete."""
    if options.spawn_file:
        try:
            with open(options.spawn_file, encoding="utf-8") as stream:
                text = stream.read()
        except OSError as error:
            raise Failure(f"cannot read {options.spawn_file}: {error.strerror}") from error
        call("spawn_sdf_model", SpawnModel, options.model_name, text, "", _pose(options), "")
    elif not options.model_name:
        print("\n".join(call("get_world_properties", GetWorldProperties).model_names))
    elif options.delete:
        call("delete_model", DeleteModel, options.model_name)
    elif options.info or options.pose:
        state = call("get_model_state", GetModelState, options.model_name, "")
        p, q = state.pose.position, state.pose.orientation
        print(" ".join(f"{v:.6g}" for v in (p.x, p.y, p.z, *math3.quat_to_rpy((q.x, q.y, q.z, q.w)))))
        if options.info:
            print(call("get_model_properties", GetModelProperties, options.model_name))
    else:
        call("set_model_state", SetModelState, ModelState(options.model_name, _pose(options), ModelState().twist, ""))


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


def stats(options: argparse.Namespace) -> None:
    """Real-time factor and sim time, a line per message."""
    end = None if options.duration is None else time.monotonic() + options.duration
    while not rospy.is_shutdown() and (end is None or time.monotonic() < end):
        try:
            message = rospy.wait_for_message("/gazebo/performance_metrics", PerformanceMetrics, 2.0)
            print(f"Factor[{message.real_time_factor:.2f}] SimTime[{message.header.stamp.to_sec():.2f}] Paused[F]")
        except rospy.ROSException:
            print(f"Factor[0.00] SimTime[{call('get_world_properties', GetWorldProperties).sim_time:.2f}] Paused[T]")


def sdf(options: argparse.Namespace) -> None:
    """Check a URDF, SDF or world file, or print it as SDF."""
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
    if not options.joint_name or options.force is None:
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


def helps(options: argparse.Namespace) -> None:
    """What there is, or the options of one command."""
    try:
        parser().parse_args([options.about, "--help"] if options.about else ["--help"])
    except SystemExit as end:
        if end.code:
            raise Failure(f"no command {options.about}") from None


def parser() -> argparse.ArgumentParser:
    top = argparse.ArgumentParser(
        prog="gz", description="Ask or change a running simulator (the node /gazebo).", formatter_class=argparse.RawDescriptionHelpFormatter
    )
    top.add_argument("-v", "--version", action="version", version=VERSION)
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(f: Any, name: str = "") -> argparse.ArgumentParser:
        added = commands.add_parser(name or f.__name__, help=f.__doc__, description=f.__doc__)
        added.set_defaults(run=f)
        return added

    add = command(model).add_argument
    add("-m", "--model-name", default="", help="without it: list the models")
    add("-d", "--delete", action="store_true")
    add("-i", "--info", action="store_true")
    add("-p", "--pose", action="store_true", help="print x y z roll pitch yaw")
    add("-f", "--spawn-file", metavar="FILE", help="URDF or SDF")
    for name in ("x", "y", "z"):
        add(f"-{name}", type=float, default=0.0, help="m")
    for short, name in (("R", "roll"), ("P", "pitch"), ("Y", "yaw")):
        add(f"-{short}", f"--{name}", type=float, default=0.0, help="rad")
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
    add("-p", "--plot", action="store_true", help="accepted")
    add = command(joint).add_argument
    add("-m", "--model-name", default="")
    add("-j", "--joint-name", default="")
    add("-f", "--force", type=float, help="N or Nm")
    add = command(topic).add_argument
    add("-l", "--list", action="store_true")
    for short, name in (("e", "echo"), ("i", "info"), ("z", "hz"), ("b", "bw")):
        add(f"-{short}", f"--{name}", metavar="TOPIC")
    add("-v", "--view", nargs="?", const=True, metavar="TOPIC", help="no window for them here")
    add("-u", "--unformatted", action="store_true", help="each message in one line")
    add("-w", "--world-name", default="", help="what ~ stands for, behind /gazebo/; without it: the world that runs")
    add("-d", "--duration", type=float, help="s of showing or measuring; without it: until Ctrl-C")
    add = command(log).add_argument
    add("-d", "--record", metavar="0|1", help="accepted, to say what to do instead")
    command(helps, "help").add_argument("about", nargs="?", default="", metavar="COMMAND")
    add = command(sdf).add_mutually_exclusive_group(required=True).add_argument
    add("-k", "--check", metavar="FILE")
    add("-p", "--print", metavar="FILE", help="a URDF becomes a model in SDF")
    return top


def main(arguments: list[str]) -> int:
    """Exit code: 0 done, 1 refused, 2 wrong options."""
    options = parser().parse_args(arguments)
    try:
        if options.run not in (sdf, log, helps, topic):
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
