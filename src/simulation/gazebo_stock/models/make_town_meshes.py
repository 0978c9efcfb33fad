#!/usr/bin/env python3
"""Writes the models of :mod:`make_town` as meshes, too: worlds that were saved with one of them hold its SDF and name its mesh.

Run after a change: ``python3 make_town_meshes.py``.
"""

import math
from pathlib import Path
from typing import NamedTuple
from xml.etree import ElementTree

import numpy as np
from make_meshes import Solid, box, collada, cylinder, turned
from make_town import TOWN

HERE = Path(__file__).resolve().parent


class File(NamedTuple):
    """:param scale: by which worlds multiply the mesh. :param yaw, at: where they put it in the link"""

    name: str
    scale: tuple[float, float, float] = (1.0, 1.0, 1.0)
    yaw: float = 0.0
    at: tuple[float, float, float] = (0.0, 0.0, 0.0)


QUARTER = math.pi / 2
FILES: dict[str, File] = {
    "ambulance": File("ambulance.obj", (0.0254,) * 3),
    "bus": File("bus.obj", (0.01,) * 3),
    "drc_practice_truss": File("truss.dae"),
    "drc_practice_yellow_parking_block": File("block.dae"),
    "euro_pallet": File("pallet.dae", (0.1,) * 3, at=(0, 0, 0.05)),
    "fast_food": File("fast_food.dae", (3.0, 3.0, 2.0)),
    "fire_truck": File("fire_truck.obj", (0.1,) * 3),
    "grey_tote": File("tote.dae"),
    "grocery_store": File("grocery_store.dae", at=(0, -1.961551703, 0)),
    **{name: File("hatchback.obj", (0.0254,) * 3, QUARTER) for name in ("hatchback", "hatchback_blue", "hatchback_red")},
    **{f"house_{i}": File(f"house_{i}.dae", (1.5,) * 3) for i in (1, 2, 3)},
    "lamp_post": File("lamp_post.dae", (3.0,) * 3),
    **{f"number{digit}": File("number.dae") for digit in range(1, 10)},
    "pickup": File("pickup.dae", yaw=-QUARTER),
    "salon": File("salon.dae", at=(0, -0.90360491, 0)),
    "speed_limit_sign": File("speed_limit_sign.dae", (10.0,) * 3),
    "stop_light_post": File("stop_light_post.obj", (0.01,) * 3),
    "stop_light": File("stop_light.obj", (0.01,) * 3),
    "suv": File("suv.obj", (0.06,) * 3, -QUARTER),
    "thrift_shop": File("thrift_shop.dae", at=(0, -0.912490988, 0)),
}
#: parts of meshes that worlds name
PARTS = {"pine_tree": ("Bark", "Branch"), "oak_tree": ("Bark", "Branch")}


def solids(name: str) -> list[Solid]:
    """The shapes that are seen, in the frame of the mesh but for its scale."""
    file = FILES.get(name, File(""))
    found = []
    for shape in TOWN[name].shapes:
        found.append(solid(shape).at(*shape.pose).at(*(-value for value in file.at)).at(yaw=-file.yaw))
    return found


def solid(shape) -> Solid:
    """What a shape of the table looks like, in its own frame."""
    geometry = ElementTree.fromstring(shape.geometry)
    red, green, blue, _ = map(float, ElementTree.fromstring(shape.material).findtext("diffuse").split())
    colour = (red, green, blue)
    if geometry.tag == "box":
        return box(*map(float, geometry.findtext("size").split()), colour)
    radius = float(geometry.findtext("radius"))
    if geometry.tag == "cylinder":
        length = float(geometry.findtext("length"))
        return cylinder(radius, -length / 2, length / 2, colour, 16)
    return turned([(radius * math.cos(a), radius * math.sin(a)) for a in np.linspace(-QUARTER, QUARTER, 9)[1:-1]], colour, 16)


def obj(pieces: list[Solid], scale, materials: str) -> tuple[str, str]:
    """An OBJ file and its materials, which it names ``materials``."""
    lines, colours, offset = [f"mtllib {materials}"], {}, 1
    for piece in pieces:
        name = colours.setdefault(piece.colour, f"m{len(colours)}")
        lines += [f"usemtl {name}"] + ["v " + " ".join(f"{value:.6g}" for value in vertex) for vertex in piece.vertices / scale]
        lines += ["f " + " ".join(str(corner + offset) for corner in triangle) for triangle in piece.triangles]
        offset += len(piece.vertices)
    described = []
    for colour, name in colours.items():
        rgb = " ".join(f"{value:g}" for value in colour)
        described += [f"newmtl {name}", f"Ka {rgb}", f"Kd {rgb}", "Ks 0.1 0.1 0.1"]
    return "\n".join([*lines, ""]), "\n".join([*described, ""])


def files() -> dict[str, str]:
    """Name of each file below this directory -> its text."""
    texts = {}
    for name in TOWN:
        file = FILES.get(name, File(f"{name}.dae"))
        folder = f"{name}/meshes/"
        if file.name.endswith(".obj"):
            materials = file.name.replace(".obj", ".mtl")
            texts[folder + file.name], texts[folder + materials] = obj(solids(name), file.scale, materials)
        else:
            texts[folder + file.name] = collada(solids(name), file.scale, PARTS.get(name, ()))
    return texts


if __name__ == "__main__":
    for path, text in files().items():
        target = HERE / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
