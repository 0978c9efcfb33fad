#!/usr/bin/env python3
"""Draws the meshes of the stock models with simple solids and writes them as small Collada files.

Sizes are metres of the finished object; ``SCALES`` says by which factor a model's SDF (and every world saved with it)
multiplies its mesh. Run after a change: ``python3 make_meshes.py``.
"""

import math
from pathlib import Path

import numpy as np
from ode_sim import math3
from ode_sim.mesh import with_normals

HERE = Path(__file__).resolve().parent
Colour = tuple  # r, g, b, 0..1


class Solid:
    """Triangles of one colour: ``vertices`` (V, 3) m, ``triangles`` (T, 3), counter-clockwise from outside."""

    def __init__(self, vertices, triangles, colour: Colour):
        self.vertices = np.asarray(vertices, dtype=float)
        self.triangles = np.asarray(triangles, dtype=int)
        self.colour = colour

    def at(self, x=0.0, y=0.0, z=0.0, roll=0.0, pitch=0.0, yaw=0.0):
        """Turned about the fixed axes, then moved."""
        pose = math3.from_rpy(x, y, z, roll, pitch, yaw)
        r = np.array(math3.quat_to_matrix(pose.q))
        return Solid(self.vertices @ r.T + pose.p, self.triangles, self.colour)


def box(sx, sy, sz, colour):
    """Centred on the origin."""
    return extruded([(-sx / 2, -sy / 2), (sx / 2, -sy / 2), (sx / 2, sy / 2), (-sx / 2, sy / 2)], sz, colour)


def extruded(outline, height, colour):
    """A prism over an outline (x, y), counter-clockwise, star-shaped about its mean; z from -height/2 to height/2."""
    n = len(outline)
    middle = np.mean(outline, axis=0)
    ring = [(x, y, z) for z in (-height / 2, height / 2) for x, y in outline]
    vertices = ring + [(*middle, -height / 2), (*middle, height / 2)]
    triangles = []
    for i in range(n):
        j = (i + 1) % n
        triangles += [(i, j, n + j), (i, n + j, n + i), (2 * n, j, i), (2 * n + 1, n + i, n + j)]
    return Solid(vertices, triangles, colour)


def turned(profile, colour, sides=24):
    """A body of revolution about z; ``profile``: (radius, z) from the bottom up, closed by flat ends."""
    profile = list(profile)
    if profile[0][0] > 0.0:
        profile.insert(0, (0.0, profile[0][1]))
    if profile[-1][0] > 0.0:
        profile.append((0.0, profile[-1][1]))
    vertices = [(r * math.cos(a), r * math.sin(a), z) for r, z in profile for a in np.arange(sides) * 2.0 * math.pi / sides]
    triangles = []
    for row in range(len(profile) - 1):
        for i in range(sides):
            a, b = row * sides + i, row * sides + (i + 1) % sides
            c, d = a + sides, b + sides
            if profile[row][0] > 0.0:
                triangles.append((a, b, d))
            if profile[row + 1][0] > 0.0:
                triangles.append((a, d, c))
    return Solid(vertices, triangles, colour)


def cylinder(radius, z0, z1, colour, sides=24):
    return turned([(radius, z0), (radius, z1)], colour, sides)


# ---------------------------------------------------------------------------------------------- what there is

RED, WHITE, ORANGE, BLUE = (0.75, 0.06, 0.05), (0.92, 0.92, 0.9), (0.95, 0.36, 0.03), (0.1, 0.3, 0.7)
STEEL, BLACK, GREEN, WOOD = (0.62, 0.64, 0.66), (0.06, 0.06, 0.06), (0.1, 0.35, 0.16), (0.66, 0.46, 0.27)
CONCRETE, CARD = (0.66, 0.65, 0.62), (0.7, 0.52, 0.33)


def jersey_barrier(length, half_base, height, colour, along_x=True):
    """The usual section: a foot, a steep toe, an upright that narrows a little."""
    s, h = half_base / 0.405, height / 1.143
    half = [(0.405, 0.0), (0.405, 0.075), (0.2, 0.33), (0.153, 1.143)]
    right = [(y * s, z * h) for y, z in half]
    outline = right + [(-y, z) for y, z in reversed(right)]
    # the outline lies in x, y of the prism: stand it up so that its height is z and the prism runs along x
    prism = extruded([(y, z) for y, z in outline], length, colour).at(roll=math.pi / 2)
    return prism.at(yaw=math.pi / 2) if along_x else prism


def bands(radii, stripes, sides=28):
    """A slim body in stripes: ``stripes`` = (z from, z to, colour); ``radii``: radius as a function of z."""
    return [turned([(radii(a), a), (radii(b), b)], colour, sides) for a, b, colour in stripes]


def dumpster():
    side = [(-0.70, 0.14), (0.70, 0.14), (0.7676, 1.2), (0.7676, 1.25), (-0.7676, 1.74), (-0.7676, 1.2)]
    body = extruded(side, 2.3, GREEN).at(roll=math.pi / 2).at(yaw=math.pi / 2)
    lid = box(2.36, 1.62, 0.05, BLACK).at(z=1.5225, roll=-math.atan2(0.49, 1.535))
    pockets = [box(0.1, 0.9, 0.16, STEEL).at(x=sign * 1.2026, z=0.85) for sign in (-1, 1)]
    wheels = [cylinder(0.08, -0.03, 0.03, BLACK, 16).at(x * 0.95, y * 0.5, 0.0786, roll=math.pi / 2) for x in (-1, 1) for y in (-1, 1)]
    legs = [box(0.12, 0.12, 0.1, STEEL).at(x * 0.95, y * 0.5, 0.16) for x in (-1, 1) for y in (-1, 1)]
    return [body, lid] + pockets + wheels + legs


def construction_cone():
    def radius(z):
        return 0.19 - 0.15 * z / 1.05

    stripes = [(0.04, 0.42, ORANGE), (0.42, 0.6, WHITE), (0.6, 0.78, ORANGE), (0.78, 0.9, WHITE), (0.9, 1.0889, ORANGE)]
    return [box(0.503, 0.503, 0.04, BLACK).at(z=0.02)] + bands(radius, stripes)


def construction_barrel():
    def radius(z):
        return 0.44 - 0.07 * z / 1.45

    stripes = [(0.12, 0.45, ORANGE), (0.45, 0.7, WHITE), (0.7, 0.95, ORANGE), (0.95, 1.2, WHITE), (1.2, 1.45, ORANGE)]
    foot = turned([(0.5099, 0.0), (0.5099, 0.08), (0.45, 0.12)], BLACK, 28)
    return [foot] + bands(radius, stripes) + [box(0.3, 0.06, 0.1, ORANGE).at(z=1.5)]


def blue_barrel():
    profile = [
        (0.27, 0.0),
        (0.2794, 0.03),
        (0.27, 0.06),
        (0.27, 0.28),
        (0.2794, 0.3),
        (0.27, 0.32),
        (0.27, 0.55),
        (0.2794, 0.57),
        (0.27, 0.59),
        (0.27, 0.82),
        (0.2794, 0.84),
        (0.27, 0.8634),
    ]
    return [turned(profile, BLUE, 32)]


def fire_hydrant():
    body = turned(
        [
            (0.17, 0.0),
            (0.17, 0.04),
            (0.1, 0.06),
            (0.1, 0.6),
            (0.14, 0.62),
            (0.14, 0.66),
            (0.12, 0.7),
            (0.1, 0.78),
            (0.05, 0.85),
            (0.03, 0.86),
            (0.03, 0.9292),
        ],
        RED,
    )
    nozzles = [cylinder(0.06, 0.0, 0.2118, STEEL, 16).at(z=0.5, pitch=math.pi / 2, yaw=yaw) for yaw in (0.0, math.pi / 2, -math.pi / 2)]
    return [body] + nozzles


def coke_can():
    side = [(0.026, 0.003), (0.0335, 0.012), (0.0335, 0.108), (0.027, 0.1205)]
    can = [
        turned([(0.024, 0.0), (0.026, 0.003)], STEEL, 32),
        turned(side, RED, 32),
        turned([(0.027, 0.1205), (0.026, 0.1239), (0.024, 0.1215)], STEEL, 32),
        turned([(0.0338, 0.05), (0.0338, 0.07)], WHITE, 32),
    ]
    return [solid.at(-0.0045, -0.0054, 0.1825) for solid in can]  # the SDF moves it back


def cafe_table():
    return [
        box(0.9144, 0.9144, 0.04, WOOD).at(z=0.7547),
        cylinder(0.03, 0.03, 0.7347, STEEL),
        turned([(0.28, 0.0), (0.28, 0.015), (0.04, 0.04)], STEEL, 32),
    ]


def marble_table():
    """Below z = 0 the legs reach the floor, 0.648 m further down."""
    marble, top = (0.85, 0.83, 0.8), 0.1
    legs = [cylinder(0.05, -0.6464, top - 0.04, STEEL, 16).at(x * 1.1, y * 0.75 - 0.12) for x in (-1, 1) for y in (-1, 1)]
    return [box(2.6124, 1.903, 0.05, marble).at(y=-0.1226, z=top - 0.025)] + legs


def hokuyo():
    return [
        box(0.05, 0.05, 0.041, BLACK).at(z=-0.0145),
        cylinder(0.021, 0.006, 0.018, BLACK),
        cylinder(0.0195, 0.018, 0.029, (0.25, 0.02, 0.02)),
        cylinder(0.021, 0.029, 0.035, BLACK),
    ]


def kinect():
    bar = box(0.055, 0.276, 0.036, BLACK).at(x=-0.027, z=0.001)
    lenses = [cylinder(0.012, 0.0, 0.005, (0.2, 0.2, 0.25), 16).at(0.0005, y, 0.001, pitch=math.pi / 2) for y in (-0.1, -0.02, 0.02)]
    return [bar, box(0.06, 0.06, 0.02, BLACK).at(x=-0.0375, z=-0.043), cylinder(0.012, -0.035, -0.015, BLACK, 12).at(x=-0.03)] + lenses


def stop_sign():
    turn = math.pi / 8
    octagon = [(0.32 * math.cos(a + turn), 0.32 * math.sin(a + turn)) for a in np.arange(8) * math.pi / 4]
    plate = extruded(octagon, 0.006, RED).at(roll=math.pi / 2).at(y=-0.0085, z=1.52)
    rim = extruded(octagon, 0.004, WHITE).at(roll=math.pi / 2).at(y=-0.0035, z=1.52)
    bars = [box(0.36, 0.002, 0.05, WHITE).at(y=-0.0118, z=1.52)]
    return [plate, rim, box(0.05, 0.0225, 1.8, STEEL).at(y=0.0, z=0.9)] + bars


def trash_can():
    body = turned([(0.2, 0.0), (0.26, 0.6), (0.28, 0.6), (0.28, 0.64)], GREEN, 32)
    lid = turned([(0.28, 0.64), (0.26, 0.7), (0.12, 0.7366)], GREEN, 32)
    handles = [box(0.1, 0.04, 0.04, GREEN).at(y=sign * 0.299, z=0.55) for sign in (-1, 1)]
    return [body, lid] + handles


def mailbox():
    arch = (
        [(-0.0647, 0.86)]
        + [(0.002 + 0.0667 * math.sin(a), 1.0 + 0.0667 * math.cos(a)) for a in np.linspace(-math.pi / 2, math.pi / 2, 9)]
        + [(0.0687, 0.86)]
    )
    tunnel = extruded(list(reversed(arch)), 0.3551, STEEL).at(roll=math.pi / 2).at(y=0.01695)
    return [tunnel, box(0.06, 0.06, 0.86, WOOD).at(z=0.43), box(0.006, 0.03, 0.1, RED).at(x=0.0658, y=0.12, z=0.97)]


def postbox():
    blue = (0.05, 0.15, 0.45)
    arch = [(0.3424 * math.cos(a), 1.18 + 0.344 * math.sin(a)) for a in np.linspace(0.0, math.pi, 13)[1:-1]]
    box_side = [(-0.3424, 0.15), (0.3424, 0.15), (0.3424, 1.18)] + arch + [(-0.3424, 1.18)]
    body = extruded(box_side, 0.6818, blue).at(roll=math.pi / 2).at(yaw=math.pi / 2)
    legs = [box(0.06, 0.06, 0.15, blue).at(x * 0.3, y * 0.3, 0.075) for x in (-1, 1) for y in (-1, 1)]
    return [body, box(0.44, 0.02, 0.06, STEEL).at(y=-0.335, z=1.2)] + legs


def car_wheel():
    tyre = turned([(0.19, 0.0), (0.2168, 0.02), (0.2168, 0.1412), (0.19, 0.1612)], BLACK, 40)
    return [tyre] + [turned([(0.13, z), (0.13, z + 0.002)], STEEL, 32) for z in (-0.001, 0.1602)]


def standpipe():
    return [
        turned(
            [(0.0967, -0.0007), (0.0967, 0.03), (0.06, 0.04), (0.06, 0.2), (0.075, 0.22), (0.075, 0.3), (0.05, 0.32), (0.05, 0.3881)], RED
        )
    ]


def cardboard_box():
    return [box(0.5, 0.4, 0.298, CARD).at(z=0.149), box(0.5, 0.05, 0.002, (0.85, 0.75, 0.55)).at(z=0.299)]


# Concrete blocks with two holes: name of each wall, its size and its middle (m). What is seen collides.
CINDER_BLOCKS = {
    "cinder_block": (
        ("left", (0.43495, 0.0339, 0.2032), (0, -0.08465, 0.1016)),
        ("right", (0.43495, 0.0339, 0.2032), (0, 0.08465, 0.1016)),
        ("front", (0.0339, 0.1354, 0.203), (0.18625, 0, 0.1016)),
        ("middle", (0.0339, 0.1354, 0.203), (0, 0, 0.1016)),
        ("back", (0.0339, 0.1354, 0.203), (-0.18625, 0, 0.1016)),
    ),
    "cinder_block_2": (
        ("top", (0.19368008, 0.396875, 0.0254), (0, 0, 0.130175)),
        ("bottom", (0.19368008, 0.396875, 0.0254), (0, 0, 0.0127)),
        ("left", (0.19368008, 0.0254, 0.092075), (0, -0.1857375, 0.0714375)),
        ("right", (0.19368008, 0.0254, 0.092075), (0, 0.1857375, 0.0714375)),
        ("middle", (0.19368008, 0.0254, 0.092075), (0, 0, 0.0714375)),
    ),
    "cinder_block_wide": (
        ("top", (0.387353556, 0.387353556, 0.0254), (0, 0, 0.130175)),
        ("bottom", (0.387353556, 0.387353556, 0.0254), (0, 0, 0.0127)),
        ("left", (0.387353556, 0.020643342, 0.092075), (0, -0.183355107, 0.0714375)),
        ("right", (0.387353556, 0.020643342, 0.092075), (0, 0.183355107, 0.0714375)),
        ("middle", (0.387353556, 0.0254, 0.092075), (0, 0, 0.0714375)),
    ),
}


def cinder_block(name):
    return lambda: [box(*size, CONCRETE).at(*middle) for _, size, middle in CINDER_BLOCKS[name]]


# model/meshes/file -> solids
MESHES = {
    "jersey_barrier/meshes/jersey_barrier": lambda: [jersey_barrier(4.0656, 0.4064, 1.143, CONCRETE)],
    "drc_practice_orange_jersey_barrier/meshes/jersey_barrier": lambda: [
        jersey_barrier(1.8014, 0.3041, 1.05, ORANGE, along_x=False).at(y=-0.0305)
    ],
    "drc_practice_white_jersey_barrier/meshes/jersey_barrier": lambda: [
        jersey_barrier(1.8014, 0.3041, 1.05, WHITE, along_x=False).at(y=-0.0305)
    ],
    "drc_practice_blue_cylinder/meshes/cylinder": blue_barrel,
    "dumpster/meshes/dumpster": dumpster,
    "construction_cone/meshes/construction_cone": construction_cone,
    "construction_barrel/meshes/construction_barrel": construction_barrel,
    "fire_hydrant/meshes/fire_hydrant": fire_hydrant,
    "coke_can/meshes/coke_can": coke_can,
    "cafe_table/meshes/cafe_table": cafe_table,
    "table_marble/meshes/table_lightmap": marble_table,
    "hokuyo/meshes/hokuyo": hokuyo,
    "kinect/meshes/kinect": kinect,
    "stop_sign/meshes/stop_sign": stop_sign,
    "first_2015_trash_can/meshes/trash_can": trash_can,
    "mailbox/meshes/mailbox": mailbox,
    "postbox/meshes/postbox": postbox,
    "car_wheel/meshes/car_wheel": car_wheel,
    "standpipe/meshes/standpipe": standpipe,
    "cardboard_box/meshes/cardboard_box": cardboard_box,
    "brick_box_3x1x3/meshes/simple_box": lambda: [box(3.0, 1.0, 3.0, (0.56, 0.3, 0.24))],
    **{f"{name}/meshes/cinder_block": cinder_block(name) for name in CINDER_BLOCKS},
}
SCALES = {
    "dumpster": (1.5,) * 3,
    "construction_cone": (10.0,) * 3,
    "table_marble": (0.25,) * 3,
    "cardboard_box": (1.25931896, 1.007455168, 0.755591376),
    "brick_box_3x1x3": (3.0, 1.0, 3.0),
}


# ---------------------------------------------------------------------------------------------- files


def collada(solids, scale=(1.0, 1.0, 1.0), names=()) -> str:
    """A Collada 1.4.1 document, one geometry for each colour.

    :param names: of the geometries, in the order of their first solids
    """
    by_colour = {}
    for solid in solids:
        by_colour.setdefault(solid.colour, []).append(solid)
    effects, materials, geometries, nodes = [], [], [], []
    for i, (colour, group) in enumerate(by_colour.items()):
        offsets = np.cumsum([0] + [len(solid.vertices) for solid in group])
        vertices = np.concatenate([solid.vertices for solid in group]) / scale
        triangles = np.concatenate([solid.triangles + offset for solid, offset in zip(group, offsets)])
        vertices, triangles, normals, _ = with_normals(vertices, triangles, None)
        rgba = " ".join(f"{c:g}" for c in colour) + " 1"
        name, node = (names[i], names[i]) if i < len(names) else (f"g{i}", f"o{i}")
        effects.append(
            f'<effect id="e{i}"><profile_COMMON><technique sid="c"><phong>'
            f"<ambient><color>{rgba}</color></ambient><diffuse><color>{rgba}</color></diffuse>"
            "<specular><color>0.1 0.1 0.1 1</color></specular></phong></technique></profile_COMMON>"
            "</effect>"
        )
        materials.append(f'<material id="m{i}" name="m{i}"><instance_effect url="#e{i}"/></material>')
        geometries.append(
            f'<geometry id="g{i}" name="{name}"><mesh>{_source(f"p{i}", vertices)}{_source(f"n{i}", normals)}'
            f'<vertices id="v{i}"><input semantic="POSITION" source="#p{i}"/>'
            f'<input semantic="NORMAL" source="#n{i}"/></vertices>'
            f'<triangles count="{len(triangles)}" material="s"><input semantic="VERTEX" source="#v{i}" offset="0"/>'
            f"<p>{' '.join(map(str, triangles.ravel()))}</p></triangles></mesh></geometry>"
        )
        nodes.append(
            f'<node id="o{i}" name="{node}"><instance_geometry url="#g{i}"><bind_material><technique_common>'
            f'<instance_material symbol="s" target="#m{i}"/></technique_common></bind_material>'
            "</instance_geometry></node>"
        )
    return "\n".join(
        [
            '<?xml version="1.0"?>',
            '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">',
            "<asset><created>2024-01-01T00:00:00</created><modified>2024-01-01T00:00:00</modified>"
            '<unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>',
            "<library_effects>",
            *effects,
            "</library_effects>",
            "<library_materials>",
            *materials,
            "</library_materials>",
            "<library_geometries>",
            *geometries,
            "</library_geometries>",
            '<library_visual_scenes><visual_scene id="scene" name="scene">',
            *nodes,
            "</visual_scene></library_visual_scenes>",
            '<scene><instance_visual_scene url="#scene"/></scene>',
            "</COLLADA>",
            "",
        ]
    )


def _source(name, rows) -> str:
    numbers = " ".join(f"{round(float(value), 5) + 0.0:g}" for value in np.asarray(rows).ravel())
    return (
        f'<source id="{name}"><float_array id="{name}a" count="{np.size(rows)}">{numbers}</float_array>'
        f'<technique_common><accessor source="#{name}a" count="{len(rows)}" stride="3">'
        '<param name="X" type="float"/>'
        '<param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>'
    )


def ascii_stl(solid) -> str:
    lines = ["solid cube"]
    for triangle in solid.triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(f"{value:g}" for value in solid.vertices[k]) for k in triangle]
        lines += ["endloop", "endfacet"]
    return "\n".join(lines + ["endsolid cube", ""])


def files():
    """Name of each mesh file below this directory -> its text."""
    texts = {name + ".dae": collada(solids(), SCALES.get(name.split("/")[0], (1.0, 1.0, 1.0))) for name, solids in MESHES.items()}
    texts["cube_20k/meshes/cube_20k.stl"] = ascii_stl(box(2.0, 2.0, 2.0, STEEL))  # its SDF halves it
    return texts


if __name__ == "__main__":
    for name, text in files().items():
        file = HERE / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
