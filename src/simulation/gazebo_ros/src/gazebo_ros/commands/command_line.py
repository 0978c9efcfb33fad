"""The options of gzserver, and how commands end that cannot go on."""

from __future__ import annotations

import argparse
import os

from ode_sim.errors import SimulationError

VERSION = "Gazebo multi-robot simulator, version 11.0.0 (noetic_labs on ODE)"
LOCKSTEP_VARIABLE = "ODE_SIM_LOCKSTEP"  # for launch files that do not pass options on
ENGINES = ("ode", "bullet", "dart", "simbody")


class Failure(SimulationError):
    """A command cannot go on: this line for its user, and exit code 1."""


def parse(arguments: list[str]) -> argparse.Namespace:
    """Options as gzserver of Gazebo 11 takes them; unknown ones are kept in ``unknown``.

    :param arguments: without the program name and without ROS remappings
    :returns: world, pause, lockstep, seed (None = not given), iters, server_plugin (list), physics, verbose ...
    """
    parser = argparse.ArgumentParser(
        prog="gzserver",
        usage="gzserver [options] [world_file]",
        allow_abbrev=False,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Run the simulator without a window.",
    )
    parser.add_argument("-v", "--version", action="version", version=VERSION)
    parser.add_argument("--verbose", action="store_true", help="say more on the terminal")
    parser.add_argument("-u", "--pause", action="store_true", help="start paused")
    parser.add_argument(
        "--lockstep",
        action="store_true",
        default=os.environ.get(LOCKSTEP_VARIABLE, "0") not in ("", "0"),
        help=f"physics waits for the sensors, as with {LOCKSTEP_VARIABLE}=1 in the environment",
    )
    parser.add_argument("-e", "--physics", default="ode", metavar="ENGINE", help="only ode is there")
    parser.add_argument("--seed", type=int, help="of the random numbers")
    parser.add_argument("--iters", type=int, default=0, metavar="N", help="end after N steps")
    parser.add_argument(
        "-s", "--server-plugin", action="append", default=[], metavar="LIBRARY", help="system plugin; those of gazebo_ros are always there"
    )
    parser.add_argument("--minimal_comms", action="store_true", help="accepted")
    parser.add_argument("-p", "--play", metavar="FILE", help="not supported")
    parser.add_argument("-r", "--record", action="store_true", help="not supported; use rosbag")
    for option in ("--record_encoding", "--record_path", "--record_period", "--record_filter"):
        parser.add_argument(option, help=argparse.SUPPRESS)
    parser.add_argument("--record_resources", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("-o", "--profile", help="preset of the physics parameters; not supported")
    parser.add_argument("-g", "--gui-plugin", action="append", default=[], help=argparse.SUPPRESS)
    parser.add_argument("worlds", nargs="*", help=argparse.SUPPRESS)
    options, unknown = parser.parse_known_args(arguments)
    options.unknown = unknown
    options.world = options.worlds[0] if options.worlds else "worlds/empty.world"
    return options


def remarks(options: argparse.Namespace) -> list[str]:
    """What of the options has no effect, one line each."""
    lines = []
    if options.physics not in ENGINES:
        lines.append(f"physics engine '{options.physics}' is unknown ({', '.join(ENGINES)}); using ode")
    elif options.physics != "ode":
        lines.append(f"physics engine '{options.physics}' is not there; using ode")
    if options.record:
        lines.append("-r: world logs are not recorded here; record the topics with rosbag")
    if options.play:
        lines.append(f"-p {options.play}: world logs cannot be played here; starting the world instead")
    if options.profile:
        lines.append(f"-o {options.profile}: physics presets are not supported; the world's first <physics> is used")
    for option in options.unknown:
        lines.append(f"option '{option}' is unknown and left out")
    return lines
