"""``rosrun bag_tools convert IN OUT``"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from bag_tools.convert import convert
from bag_tools.files import BagError

EXAMPLES = """\
  rosrun bag_tools convert drive.bag drive.mcap     for Foxglove, Lichtblick, PlotJuggler
  rosrun bag_tools convert drive.mcap drive.bag     and back: the same messages, bit by bit
  rosrun bag_tools convert drive.bag drive_ros2     for ros2 bag play: a folder
  rosrun bag_tools convert drive_ros2 drive.bag
"""


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(
        prog="rosrun bag_tools convert",
        description="One kind of bag into another.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("source", type=Path, metavar="IN", help=".bag, .mcap, or the folder of a bag of ROS 2")
    parser.add_argument("target", type=Path, metavar="OUT", help=".bag, .mcap, or a name without ending for a bag of ROS 2")
    parser.add_argument("--compression", choices=("none", "bz2", "lz4", "zstd"), help="of OUT; zstd for .mcap, else none")
    parser.add_argument("--storage", choices=("mcap", "sqlite3"), default="mcap", help="of a bag of ROS 2")
    parser.add_argument("-q", "--quiet", action="store_true", help="no progress bar")
    options = parser.parse_args(arguments)
    try:
        count = convert(options.source, options.target, options.compression, options.storage, options.quiet)
    except BagError as error:
        print(f"convert: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("convert: stopped; nothing was written", file=sys.stderr)
        return 130
    if not options.quiet:
        print(f"{options.target}{f': {count} messages' if count else ''}")
    return 0
