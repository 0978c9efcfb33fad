"""The command ``collisions_updater``."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

import rospkg
import rospy

from moveit_setup_assistant import collisions
from moveit_setup_assistant.configuration import Configuration
from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.headless import set_collisions
from moveit_setup_assistant.robot_source import RobotSource
from moveit_setup_assistant.semantics import Semantics


def main(words: list[str]) -> int:
    """Run the command; the exit code is 0, or 1 with one line on what is wrong."""
    options = _parser().parse_args(rospy.myargv(["collisions_updater", *words])[1:])
    try:
        config, output = _load(options)
        reasons = _compute(config, options)
        set_collisions(config, reasons)
        _write(Path(output), config.semantics.to_text())
    except AssistantError as error:
        print(f"collisions_updater: {error}", file=sys.stderr)
        return 1
    if options.verbose:
        for (one, other), reason in sorted(reasons.items()):
            print(f"{one} - {other}: {reason}")
    print(f"{len(reasons)} pairs of links need no check; wrote {output}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="collisions_updater",
        allow_abbrev=False,
        description="Compute which links of a robot need no collision check, and write its SRDF.",
    )
    parser.add_argument("--config-pkg", help="configuration package: its robot, its SRDF")
    parser.add_argument("--urdf", help="the robot's URDF or xacro file (instead of --config-pkg)")
    parser.add_argument("--srdf", help="its SRDF (instead of --config-pkg)")
    parser.add_argument("--output", help="file to write; default: the SRDF that was read")
    parser.add_argument("--default", action="store_true", help="disable pairs that collide in the default state")
    parser.add_argument("--always", action="store_true", help="disable pairs that always collide")
    parser.add_argument("--keep", action="store_true", help="keep the disabled pairs of the SRDF")
    parser.add_argument("--verbose", action="store_true", help="list the pairs")
    parser.add_argument("--trials", type=int, default=0, help="random states to find pairs that never collide; 0: none are sought")
    parser.add_argument("--min-collision-fraction", type=float, default=1.0, help="of states that must collide for 'always'")
    parser.add_argument("xacro_args", nargs="*", help="arguments for xacro, name:=value")
    return parser


def _load(options) -> tuple:
    """(configuration, file to write)."""
    xacro_args = " ".join(options.xacro_args)
    if options.config_pkg:
        try:
            package = Path(rospkg.RosPack().get_path(options.config_pkg))
        except rospkg.ResourceNotFound as error:
            raise AssistantError(f"package '{options.config_pkg}' is not found; source the workspace that holds it") from error
        config = Configuration.load(package)
        return config, options.output or package / config.srdf_file
    if not options.urdf or not options.srdf:
        raise AssistantError("name a package with --config-pkg, or a robot with --urdf and --srdf")
    config = Configuration.new(RobotSource.from_file(options.urdf, xacro_args))
    config.semantics = Semantics.load(Path(options.srdf))
    return config, options.output or options.srdf


def _compute(config: Configuration, options) -> dict[collisions.Pair, str]:
    kept = {}
    if options.keep:
        kept = {collisions.pair(p.link1, p.link2): p.reason or collisions.USER for p in config.semantics.disable_collisionss}
    found = collisions.compute_disabled(config.robot.model, options.trials, options.min_collision_fraction, find_never=options.trials > 0)
    wanted = {collisions.ADJACENT, collisions.NEVER}
    wanted |= {collisions.DEFAULT} if options.default else set()
    wanted |= {collisions.ALWAYS} if options.always else set()
    return {**{p: reason for p, reason in found.items() if reason in wanted}, **kept}


def _write(path: Path, text: str) -> None:
    """Replace the file at once, so that it is never half written."""
    try:
        with tempfile.NamedTemporaryFile("w", dir=path.absolute().parent, delete=False, encoding="utf-8") as file:
            file.write(text)
        os.chmod(file.name, 0o644)
        os.replace(file.name, path)
    except OSError as error:
        raise AssistantError(f"'{path}' cannot be written: {error.strerror}") from error
