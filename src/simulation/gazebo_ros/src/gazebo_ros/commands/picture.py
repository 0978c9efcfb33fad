"""``rosrun gazebo_ros picture [MODEL] -o FILE.png``: what does the simulated world, or a model, look like now?"""

from __future__ import annotations

import argparse
import sys

import node_signals
import rosgraph

from gazebo_ros.commands.asking import call
from gazebo_ros.commands.command_line import Failure
from gazebo_ros.srv import TakePicture


def parser() -> argparse.ArgumentParser:
    made = argparse.ArgumentParser(
        prog="picture",
        description="Writes a picture of the simulated world, or of one of "
        "its models, as it is now, also while it is paused. Needs no display.",
    )
    add = made.add_argument
    add("model", nargs="?", default="", help="fills the frame; without it: all that stands on the ground")
    add("-o", "--output", metavar="FILE.png", required=True)
    add("--view", default="", help="iso, front, back, left, right or top (default: where the world's <gui><camera> stands, else iso)")
    add("--size", metavar="WxH", default="1280x800", help="pixels (default 1280x800)")
    return made


def main(arguments: list[str]) -> int:
    """Exit code: 0 done, 1 refused, 2 wrong options."""
    options = parser().parse_args(arguments)
    width, _, height = options.size.partition("x")
    if not (width.isdecimal() and height.isdecimal() and len(options.size) < 12):
        parser().error(f"--size {options.size}: two numbers of pixels are needed, as in 1280x800")
    try:
        if not rosgraph.is_master_online():
            raise Failure(f"no ROS master at {rosgraph.get_master_uri()}; start the simulator first")
        node_signals.init_node("picture", anonymous=True, disable_rostime=True)
        png = call("take_picture", TakePicture, options.model, options.view, int(width), int(height)).png
        with open(options.output, "wb") as file:
            file.write(png)
    except Failure as error:
        print(f"picture: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"picture: cannot write {options.output}: {error.strerror}", file=sys.stderr)
        return 1
    return 0
