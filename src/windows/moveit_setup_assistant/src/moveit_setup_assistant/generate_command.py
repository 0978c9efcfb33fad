"""The command ``generate``."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import rospy

from moveit_setup_assistant import headless, package_writer
from moveit_setup_assistant.configuration import written_at
from moveit_setup_assistant.errors import AssistantError
from moveit_setup_assistant.robot_source import RobotSource


def main(words: list[str]) -> int:
    """Run the command; the exit code is 0, or 1 with one line on what is wrong."""
    parser = argparse.ArgumentParser(
        prog="generate",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        description="Make a MoveIt configuration package without a window.",
        epilog="The file given by --from:" + headless.__doc__.partition("\n")[2],
    )
    parser.add_argument("--urdf", required=True, help="the robot's URDF or xacro file")
    parser.add_argument("--xacro-args", default="", help='arguments for xacro, as "name:=value name:=value"')
    parser.add_argument("--from", dest="config", required=True, help="the YAML file described below")
    parser.add_argument("-o", "--output", required=True, help="folder of the package; its name is the package's")
    parser.add_argument("--overwrite", action="store_true", help="also overwrite files that somebody changed by hand")
    options = parser.parse_args(rospy.myargv([parser.prog, *words])[1:])
    try:
        package = Path(options.output).expanduser().absolute()
        package_writer.refuse_foreign(package)  # before the minute that collisions may take
        config = headless.configuration(RobotSource.from_file(options.urdf, options.xacro_args), options.config)
        config.generated_timestamp = written_at(package)
        files = package_writer.plan(config, package)
        for file in files:
            file.write = file.write or (options.overwrite and file.state is package_writer.State.HAND_MADE)
        written = package_writer.write(config, package, files)
    except AssistantError as error:
        print(f"generate: {error}", file=sys.stderr)
        return 1
    for line in (*config.robot.warnings, *config.incomplete()):
        print(f"note: {line}")
    for file in files:
        if file.state is package_writer.State.HAND_MADE and not file.write:
            print(f"kept: {file.path} was changed by hand (--overwrite replaces it)")
    print(f"wrote {len(written)} files to {package}. Build your workspace, then: roslaunch {package.name} demo.launch")
    return 0
