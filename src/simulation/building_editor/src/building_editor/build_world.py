"""Builds a world (or a model) from a plan of walls, doors, windows and stairs."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from building_editor import preview, sdf_model
from building_editor.building import PlanError, read_plan


def main(argv: Sequence[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="build_world",
        description=__doc__,
        epilog="A plan is YAML (see python3 -m pydoc building_editor.building) or an image, walls dark on light.",
    )
    parser.add_argument("plan", help="plan.yaml, a map of map_server, or an image with --resolution")
    parser.add_argument(
        "-o", "--output", required=True, help="FILE.world: with sun and floor; FILE.sdf: the model alone; DIR/: a model directory"
    )
    parser.add_argument("--preview", metavar="PNG", help="also draw the plan from above")
    parser.add_argument("--resolution", type=float, help="metres per pixel of an image")
    arguments = parser.parse_args(sys.argv[1:] if argv is None else argv)
    try:
        building = read_plan(arguments.plan, arguments.resolution)
        sdf_model.write(building, arguments.output)
        if arguments.preview:
            preview.save(building, arguments.preview)
    except PlanError as error:
        print(f"build_world: {error}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"build_world: cannot write {error.filename or arguments.output}: {error.strerror or error}", file=sys.stderr)
        return 1
    walls = sum(len(level.walls) for level in building.levels)
    print(
        f"{arguments.output}: {building.name}, {walls} wall{'s' * (walls != 1)} on "
        f"{len(building.levels)} level{'s' * (len(building.levels) != 1)}"
    )
    return 0
