"""Prints a robot as YAML; writes it as URDF with -o."""

from __future__ import annotations

import argparse
import sys

from urdf_parser_py.urdf import URDF
from urdf_parser_py.xml_reflection import ParseError


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", type=argparse.FileType("r"), nargs="?", help="URDF; - is standard input; without: /robot_description")
    parser.add_argument("-o", "--output", type=argparse.FileType("w"), help="write it as URDF")
    arguments = parser.parse_args()
    try:
        robot = URDF.from_xml_string(arguments.file.read()) if arguments.file else URDF.from_parameter_server()
    except (ParseError, KeyError, OSError) as error:
        sys.exit(f"display_urdf: {error}")
    print(robot)
    if arguments.output:
        arguments.output.write(robot.to_xml_string())
