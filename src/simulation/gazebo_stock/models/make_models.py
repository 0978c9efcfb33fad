#!/usr/bin/env python3
"""Writes model.sdf and model.config of the stock models from the table below, and from that of :mod:`make_town`. ground_plane and sun
are written by hand.

Names, sizes, masses and frames are those that worlds of the Gazebo model database count on; the shapes are our own
(:mod:`make_meshes`). What collides is made of boxes, cylinders and spheres where a mesh upstream is: faster, steadier.
Run after a change: ``python3 make_models.py``.
"""

from pathlib import Path

from make_meshes import CINDER_BLOCKS
from make_town import TOWN
from pieces import (
    Model,
    Shape,
    box,
    box_inertia,
    colour,
    contact,
    cylinder,
    friction,
    model_config,
    model_sdf,
    ogre_script,
    pose,
    script,
    sphere,
    tag,
)

HERE = Path(__file__).resolve().parent

WOOD, GREY = script("Gazebo/Wood"), script("Gazebo/Grey")
STIFF = dict(kp=1e7, kd=1, max_vel=0.1, min_depth=0.001)
HARD = dict(kp=1e5, kd=100, max_vel=100, min_depth=0.001)


def cinder_block(name, description, mass, inertia, height, surface=""):
    walls = tuple(Shape(wall, box(*size), middle, surface=surface) for wall, size, middle in CINDER_BLOCKS[name])
    return Model(
        name.replace("_", " ").capitalize(), description, walls, mass=mass, inertia=inertia, com=(0, 0, height), mesh="cinder_block.dae"
    )


def jersey_boxes(length):
    """The section of the barrier as six boxes along x."""
    return tuple(
        Shape(name, box(length, width, height), at)
        for name, width, height, at in (
            ("upright", 0.3063, 1.143, (0, 0, 0.5715)),
            ("base", 0.8107, 0.064516, (0, 0, 0.032258)),
            ("base2", 0.65, 0.1, (0, 0, 0.1)),
            ("base3", 0.5, 0.1, (0, 0, 0.2)),
            ("left-angle", 0.5, 0.064516, (0, -0.224, 0.2401, 0.9)),
            ("right-angle", 0.5, 0.064516, (0, 0.224, 0.2401, -0.9)),
        )
    )


def drc_barrier(title, description, name=""):
    return Model(
        title,
        description,
        (
            Shape("foot", box(0.6082, 1.8014, 0.07), (0, -0.0305, 0.035)),
            Shape("toe", box(0.42, 1.8014, 0.16), (0, -0.0305, 0.15)),
            Shape("upright", box(0.27, 1.8014, 0.82), (0, -0.0305, 0.64)),
        ),
        static=True,
        name=name,
        mesh="jersey_barrier.dae",
    )


def plate(name, size, at):
    return Shape("cabinet_bottom_plate_geom" + name, box(*size), at, WOOD)


def board(name, size, at):
    return Shape(name, box(*size), at, WOOD)


def wood_cube(side, mass, **surface):
    values = {**HARD, **surface}
    return Model(
        f"Wood cube {side * 100:g}cm",
        f"A wooden cube of {side * 100:g} cm to pick up.",
        (Shape("collision", box(side, side, side), (), WOOD, contact(True, **values)),),
        mass=mass,
        inertia=box_inertia(mass, side, side, side),
        link_pose=(0, 0, side / 2),
    )


def unit_shape(what, geometry, inertia):
    return Model(
        f"Unit {what}",
        f"A {what} of one metre and one kilogram.",
        (Shape("collision", geometry, (), GREY),),
        mass=1.0,
        inertia=inertia,
        pose=(0, 0, 0.5),
    )


CAMERA_SENSOR = tag(
    "sensor",
    tag("update_rate", 20),
    tag(
        "camera",
        tag("horizontal_fov", 1.047198),
        tag("image", tag("width", 640), tag("height", 480), tag("format", "R8G8B8")),
        tag("clip", tag("near", 0.05), tag("far", 3)),
    ),
    name="camera",
    type="depth",
)
LASER_SENSOR = tag(
    "sensor",
    pose((0.01, 0, 0.0175)),
    tag("always_on", 1),
    tag("update_rate", 30),
    tag("visualize", "true"),
    tag(
        "ray",
        tag("scan", tag("horizontal", tag("samples", 640), tag("resolution", 1), tag("min_angle", -2.26889), tag("max_angle", 2.26889))),
        tag("range", tag("min", 0.08), tag("max", 10), tag("resolution", 0.01)),
    ),
    name="laser",
    type="ray",
)

MODELS = {
    "table": Model(
        "Table",
        "A wooden table, 1.5 m by 0.8 m and 1 m high.",
        (Shape("surface", box(1.5, 0.8, 0.03), (0, 0, 1.0), WOOD, friction(0.6)),)
        + tuple(
            Shape(f"{front}_{side}_leg", cylinder(0.02, 1.0), (x * 0.68, y * 0.38, 0.5), GREY, "")
            for front, side, x, y in (
                ("front", "left", 1, 1),
                ("front", "right", 1, -1),
                ("back", "right", -1, -1),
                ("back", "left", -1, 1),
            )
        ),
        static=True,
    ),
    "table_marble": Model(
        "Table marble",
        "A long table with a marble top.",
        (Shape("top", box(2.6124, 1.903, 0.05), (0, -0.1226, 0.075)),)
        + tuple(
            Shape(f"leg_{i}", cylinder(0.05, 0.6964), (x * 1.1, y * 0.75 - 0.12, -0.2982))
            for i, (x, y) in enumerate(((1, 1), (1, -1), (-1, -1), (-1, 1)))
        ),
        static=True,
        pose=(0, 0, 0.648),
        mesh="table_lightmap.dae",
        scripts={"Table/Marble_Lightmap": (0.85, 0.83, 0.8)},
    ),
    "cafe_table": Model(
        "Cafe table",
        "A square table on one column.",
        (
            Shape("surface", box(0.913, 0.913, 0.04), (0, 0, 0.755)),
            Shape("column", box(0.042, 0.042, 0.74), (0, 0, 0.37)),
            Shape("base", box(0.56, 0.56, 0.04), (0, 0, 0.02)),
        ),
        static=True,
        mesh="cafe_table.dae",
    ),
    "bookshelf": Model(
        "Bookshelf",
        "A wooden shelf, 1.2 m high.",
        (
            board("back", (0.9, 0.01, 1.2), (0, 0.005, 0.6)),
            board("left_side", (0.02, 0.4, 1.2), (0.45, -0.195, 0.6)),
            board("right_side", (0.02, 0.4, 1.2), (-0.45, -0.195, 0.6)),
            board("bottom", (0.88, 0.4, 0.06), (0, -0.195, 0.03)),
            board("top", (0.88, 0.4, 0.02), (0, -0.195, 1.19)),
            board("low_shelf", (0.88, 0.4, 0.02), (0, -0.195, 0.43)),
            board("high_shelf", (0.88, 0.4, 0.02), (0, -0.195, 0.8)),
        ),
        static=True,
    ),
    "cabinet": Model(
        "Cabinet",
        "An open cabinet with one shelf, 1 m high.",
        (
            plate("", (0.45, 0.45, 0.02), (0, 0, 0.01)),
            plate("_cabinet_back_plate", (0.02, 0.45, 1.02), (0.235, 0, 0.51)),
            plate("_cabinet_left_plate", (0.45, 0.02, 1.02), (0, 0.235, 0.51)),
            plate("_cabinet_middle_plate", (0.45, 0.45, 0.02), (0, 0, 0.51)),
            plate("_cabinet_right_plate", (0.45, 0.02, 1.02), (0, -0.235, 0.51)),
            plate("_cabinet_top_plate", (0.45, 0.45, 0.02), (0, 0, 1.01)),
        ),
        static=True,
        link="cabinet_bottom_plate",
    ),
    "coke_can": Model(
        "Coke Can",
        "A drinks can, 12 cm high.",
        (Shape("collision", cylinder(0.0335, 0.1239), (-0.0006, -0.0007, 0.06445), "", contact(**STIFF)),),
        mass=0.39,
        inertia=(0.00055575, 0.00055575, 0.0001755),
        com=(0, 0, 0.06),
        mesh="coke_can.dae",
        mesh_pose=(0.0039, 0.0047, -0.18),
    ),
    "beer": Model(
        "Beer",
        "A big can, 23 cm high.",
        (Shape("collision", cylinder(0.055, 0.23), (), colour(0.75, 0.55, 0.12)),),
        mass=0.39,
        inertia=(0.00058, 0.00058, 0.00019),
        link_pose=(0, 0, 0.115),
        scripts={"Beer/Diffuse": (0.75, 0.55, 0.12)},
    ),
    "cricket_ball": Model(
        "Cricket ball",
        "A red ball of 7.5 cm.",
        (Shape("collision", sphere(0.0375), (), script("Gazebo/Red"), contact(True, **HARD)),),
        mass=0.1467,
        inertia=(8.251875e-5,) * 3,
        link_pose=(0, 0, 0.0375),
    ),
    "wood_cube_2_5cm": wood_cube(0.025, 0.0073),
    "wood_cube_5cm": wood_cube(0.05, 0.0565, kd=1, max_vel=1),
    "wood_cube_10cm": wood_cube(0.1, 0.5167),
    "cardboard_box": Model(
        "Cardboard box",
        "A box of 50 cm by 40 cm by 30 cm, 2 kg.",
        (Shape("collision", box(0.5, 0.4, 0.3), (), "", contact(**STIFF)),),
        mass=2.0,
        inertia=box_inertia(2.0, 0.5, 0.4, 0.3),
        pose=(0, 0, 0.15),
        mesh="cardboard_box.dae",
        mesh_pose=(0, 0, -0.15),
    ),
    "cube_20k": Model(
        "Cube 20k",
        "A cube of one metre; its mesh file is scaled by a half.",
        (Shape("collision", box(1, 1, 1), (), GREY),),
        link_pose=(0, 0, 0.5),
    ),
    "car_wheel": Model(
        "Car wheel",
        "A wheel of 43 cm lying on its side.",
        (Shape("collision", cylinder(0.21682, 0.16116), (), "", contact(kp=1e8, kd=1, max_vel=0.01, min_depth=0.005)),),
        mass=12.0,
        inertia=(0.167005283, 0.167005283, 0.282065474),
        link_pose=(0, 0, 0.21682),
        mesh="car_wheel.dae",
        mesh_pose=(0, 0, -0.08058),
    ),
    "grey_wall": Model(
        "Grey wall",
        "A wall, 7.5 m long and 2.8 m high.",
        (Shape("collision", box(7.5, 0.2, 2.8), (), GREY),),
        static=True,
        link_pose=(0, 0, 1.4),
        scripts={"vrc/grey_wall": (0.6, 0.6, 0.6)},
    ),
    "brick_box_3x1x3": Model(
        "Brick box",
        "A block of bricks, 3 m by 1 m and 3 m high.",
        (Shape("collision", box(3, 1, 3), (), script("Gazebo/Bricks")),),
        static=True,
        link="chassis",
        link_pose=(0, 0, 1.5),
        scripts={"BrickBox/Diffuse": (0.56, 0.3, 0.24)},
    ),
    "asphalt_plane": Model(
        "Asphalt plane",
        "A square of asphalt, 20 m by 20 m.",
        (Shape("collision", box(20, 20, 0.1), (), colour(0.2, 0.2, 0.21)),),
        static=True,
        scripts={"vrc/asphalt": (0.2, 0.2, 0.21)},
    ),
    "mud_box": Model(
        "Mud box",
        "A low box that looks like mud, 8 m by 10 m.",
        (Shape("collision", box(8, 10, 0.2), (), colour(0.3, 0.2, 0.12)),),
        static=True,
        scripts={"vrc/mud": (0.3, 0.2, 0.12)},
    ),
    "jersey_barrier": Model(
        "Jersey barrier", "A concrete road barrier, 4 m long.", jersey_boxes(4.06542), static=True, mesh="jersey_barrier.dae"
    ),
    # the model's name is misspelt in the database, and worlds refer to it
    "drc_practice_orange_jersey_barrier": drc_barrier(
        "DRC practice orange jersey barrier", "An orange plastic road barrier, 1.8 m long.", "drc_practice_organge_jersey_barrier"
    ),
    "drc_practice_white_jersey_barrier": drc_barrier("DRC practice white jersey barrier", "A white plastic road barrier, 1.8 m long."),
    "drc_practice_blue_cylinder": Model(
        "DRC practice blue cylinder",
        "A blue drum, 86 cm high.",
        (Shape("collision", cylinder(0.2794, 0.8634), (0, 0, 0.4317)),),
        static=True,
        mesh="cylinder.dae",
    ),
    "construction_barrel": Model(
        "Construction barrel",
        "A heavy striped road barrel, 1.55 m high.",
        (Shape("foot", cylinder(0.5099, 0.12), (0, 0, 0.06)), Shape("body", cylinder(0.4, 1.43), (0, 0, 0.835))),
        mass=500.0,
        inertia=(51.2096, 51.2096, 25.0),
        com=(0, 0, 0.4),
        name="Construction Barrel",
        mesh="construction_barrel.dae",
    ),
    "construction_cone": Model(
        "Construction cone",
        "A striped road cone, 1.1 m high.",
        (
            Shape("foot", box(0.503, 0.503, 0.04), (0, 0, 0.02)),
            Shape("lower", cylinder(0.155, 0.4), (0, 0, 0.24)),
            Shape("middle", cylinder(0.1, 0.35), (0, 0, 0.615)),
            Shape("upper", cylinder(0.055, 0.2989), (0, 0, 0.93945)),
        ),
        name="Construction Cone",
        mesh="construction_cone.dae",
    ),
    "dumpster": Model(
        "Dumpster",
        "A waste container with a sloping lid.",
        (
            Shape("body", box(2.3, 1.5352, 1.1014), (0, 0, 0.7693)),
            Shape("wheels", box(2.06, 1.16, 0.22), (0, 0, 0.1086)),
            Shape("lid", box(2.36, 1.62, 0.35), (0, 0.01, 1.372, -0.309)),
            Shape("pockets", box(2.5052, 0.9, 0.16), (0, 0, 0.85)),
        ),
        name="Dumpster",
        mesh="dumpster.dae",
        scripts={"Dumpster/Diffuse": (0.1, 0.35, 0.16)},
    ),
    "fire_hydrant": Model(
        "Fire hydrant",
        "A red hydrant, 93 cm high.",
        (
            Shape("foot", cylinder(0.17, 0.05), (0, 0, 0.025)),
            Shape("body", cylinder(0.11, 0.75), (0, 0, 0.4)),
            Shape("cap", cylinder(0.08, 0.1542), (0, 0, 0.8521)),
            Shape("side_nozzles", cylinder(0.06, 0.4236), (0, 0, 0.5, 1.5707963, 0, 0)),
            Shape("front_nozzle", cylinder(0.06, 0.2118), (0.1059, 0, 0.5, 0, 1.5707963, 0)),
        ),
        static=True,
        mesh="fire_hydrant.dae",
    ),
    "standpipe": Model(
        "Standpipe",
        "A hose connection to turn by hand.",
        (
            Shape("collision_stopper", cylinder(0.069, 0.1), (0, 0, 0.22), "", friction(0.5)),
            Shape("collision", cylinder(0.075, 0.3888), (0, 0, 0.3437), "", friction(0.5)),
            Shape("flange", cylinder(0.0967, 0.03), (0, 0, 0.165), "", friction(0.5)),
        ),
        static=True,
        link="standpipe",
        link_pose=(0, 0, 0.1),
        mesh="standpipe.dae",
        mesh_pose=(0, 0, 0.15),
    ),
    "stop_sign": Model(
        "Stop sign",
        "A road sign, 1.8 m high.",
        (Shape("pole", box(0.05, 0.0225, 1.8), (0, 0, 0.9)), Shape("sign", box(0.593, 0.0118, 0.593), (0, -0.006, 1.52))),
        static=True,
        name="Stop Sign",
        mesh="stop_sign.dae",
        scripts={"StopSign/Diffuse": (0.75, 0.06, 0.05)},
    ),
    "first_2015_trash_can": Model(
        "FIRST 2015 trash can",
        "A round waste bin, 74 cm high.",
        (Shape("body", cylinder(0.25, 0.6), (0, 0, 0.3)), Shape("rim", cylinder(0.28, 0.1366), (0, 0, 0.6683))),
        mass=4.83076,
        inertia=(0.281534052, 0.281534052, 0.126222831),
        com=(0, 0, 0.3683),
        mesh="trash_can.dae",
    ),
    "mailbox": Model(
        "Mailbox",
        "A letter box on a post.",
        (Shape("box", box(0.1335, 0.3551, 0.2072), (0.002, 0.01695, 0.9636)), Shape("post", box(0.06, 0.06, 0.86), (0, 0, 0.43))),
        name="Mailbox",
        mesh="mailbox.dae",
        scripts={"Mailbox/Diffuse": (0.62, 0.64, 0.66)},
    ),
    "postbox": Model(
        "Post box",
        "A blue letter box, 1.5 m high.",
        (
            Shape("body", box(0.6818, 0.6848, 1.03), (0, 0, 0.665)),
            Shape("top", cylinder(0.3424, 0.6818), (0, 0, 1.18, 0, 1.5707963, 0)),
            Shape("legs", box(0.66, 0.66, 0.15), (0, 0, 0.075)),
        ),
        static=True,
        mesh="postbox.dae",
    ),
    "hokuyo": Model(
        "Hokuyo",
        "A small laser scanner, 640 rays over 260 degrees up to 10 m.",
        (Shape("collision-base", box(0.05, 0.05, 0.041), (0, 0, -0.0145)), Shape("collision-top", cylinder(0.021, 0.029), (0, 0, 0.0205))),
        mass=0.1,
        pose=(0, 0, 0.035),
        mesh="hokuyo.dae",
        extra=LASER_SENSOR,
    ),
    "kinect": Model(
        "Kinect",
        "A depth camera, 640 by 480 at 20 Hz.",
        (Shape("collision", box(0.073, 0.276, 0.072)),),
        mass=0.1,
        pose=(0, 0, 0.036),
        mesh="kinect.dae",
        extra=CAMERA_SENSOR,
    ),
    "cinder_block": cinder_block("cinder_block", "A concrete block with two holes, upright.", 17.0, (0.0976, 0.2508, 0.2348), 0.1016),
    "cinder_block_2": cinder_block(
        "cinder_block_2",
        "A light block with two holes, lying.",
        5.0,
        (0.028705, 0.073708, 0.06908),
        0.1016,
        contact(max_vel=0.1, min_depth=0.001),
    ),
    "cinder_block_wide": cinder_block(
        "cinder_block_wide",
        "A light square block with two holes, lying.",
        5.0,
        (0.06814656667, 0.06814656667, 0.1248075),
        0.0714375,
        contact(max_vel=0.1, min_depth=0.001),
    ),
    "unit_box": unit_shape("box", box(1, 1, 1), (1 / 6,) * 3),
    "unit_sphere": unit_shape("sphere", sphere(0.5), (0.1,) * 3),
    "unit_cylinder": unit_shape("cylinder", cylinder(0.5, 1.0), (0.1458333333, 0.1458333333, 0.125)),
}


def files():
    """Name of each file below this directory -> its text."""
    texts = {}
    for directory, model in {**MODELS, **TOWN}.items():
        texts[f"{directory}/model.sdf"] = model_sdf(directory, model)
        texts[f"{directory}/model.config"] = model_config(model)
        if model.scripts:
            texts[f"{directory}/materials/scripts/{directory}.material"] = ogre_script(model.scripts)
    return texts


if __name__ == "__main__":
    for name, text in files().items():
        file = HERE / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
