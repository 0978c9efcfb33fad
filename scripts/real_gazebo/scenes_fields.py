"""Resets, poses and fields of force; settings of the physics; heightmaps."""

import struct
import zlib

from real_gazebo.scene import Deed, Row
from real_gazebo.scenes_worlds import FILES, scene
from real_gazebo.sdf import axis, ball, box, collision, cube, ground, inertial, joint, link, model, surface, world

# ---------------------------------------------------------------------------------------------------- fields of force, deeds between steps


def body_rows(*wanted, near=(1e-4, 2e-5), default=(1e-3, 1e-3), body="b"):
    return tuple(
        Row(f"{c} of {body} at {t:g} s", lambda r, c=c, t=t: r.at(f"model:{body}", c, t), gazebo=near, default=default) for c, t in wanted
    )


scene(
    "gravity_of_world",
    "world gravity 1 0 -3",
    "falls along it: 0.5 and 1.5 m in 1 s",
    world(ball("b", 0.1, 1, "0 0 5 0 0 0"), gravity="1 0 -3"),
    body_rows(("x", 1.0), ("z", 1.0)),
)
scene(
    "gravity_off_link",
    "<gravity>0</gravity> of one of two joined links, and of a free one",
    "the pair falls by half of g; the free one stays",
    world(
        model(
            "b",
            link("l", inertial(1, 0.01), "<gravity>0</gravity>"),
            link("m", inertial(1, 0.01), pose="0.3 0 0 0 0 0"),
            joint("j", "prismatic", "l", "m", axis("1 0 0", 0, 0)),
            pose="0 0 5 0 0 0",
        ),
        model("free", link("l", inertial(1, 0.01), "<gravity>0</gravity>"), pose="2 0 5 0 0 0"),
    ),
    body_rows(("z", 0.3), ("z", 0.5), near=(1e-3, 1e-3)) + body_rows(("z", 1.0), body="free"),
)
scene(
    "gravity_switched",
    "SetGravityMode(false) after 0.3 s, world gravity turned after 0.6 s",
    "speed is kept, then",
    world(ball("b", 0.1, 1, "0 0 5 0 0 0"), ball("c", 0.1, 1, "1 0 5 0 0 0")),
    body_rows(("z", 0.3), ("z", 0.6), ("z", 1.0)) + body_rows(("z", 0.6), ("z", 1.0), ("x", 1.0), body="c"),
    deeds=[Deed("gravity", "b::l", "0", 0.3), Deed("world_gravity", "", "0 0 4", 0.6)],
)
scene(
    "kinematic",
    "<kinematic> link: not moved by gravity, nor by a hit",
    "stays; the ball bounces off it",
    world(
        ground(),
        cube("b", 0.2, 1, "0 0 1 0 0 0").replace("<link name='l'>", "<link name='l'><kinematic>1</kinematic>"),
        ball("ball", 0.05, 1, "0.02 0 1.5 0 0 0"),
    ),
    body_rows(("z", 0.5), ("z", 1.0), near=(1e-4, 1e-4))
    + (Row("z of the ball at 0.4 s", lambda r: r.at("model:ball", "z", 0.4), gazebo=(1e-2, 1e-2), default=(2e-2, 1e-2)),),
)
scene(
    "kinematic_moved",
    "kinematic link with a twist",
    "moves on as it was told",
    world(cube("b", 0.2, 1, "0 0 1 0 0 0").replace("<link name='l'>", "<link name='l'><kinematic>1</kinematic>")),
    body_rows(("x", 0.5), ("x", 1.0), ("z", 1.0)),
    deeds=[Deed("twist", "b", "0.5 0 0 0 0 1")],
)
scene(
    "velocity_decay",
    "<velocity_decay> 0.1 and 0.2: a thrown and spun body",
    "Gazebo: each step takes its part",
    world(
        ball("b", 0.1, 1, "0 0 1 0 0 0").replace(
            "<link name='l'>", "<link name='l'><velocity_decay><linear>0.01</linear><angular>0.02</angular></velocity_decay>"
        ),
        gravity="0 0 0",
    ),
    body_rows(("x", 0.1), ("x", 0.5), ("x", 1.0), ("wz", 0.5)),
    deeds=[Deed("twist", "b", "1 0 0 0 0 5")],
)
scene(
    "push_and_torque",
    "10 N for 0.5 s on 2 kg, 0.1 N m for 0.5 s on 0.02 kg m^2",
    "v = 2.5 m/s, w = 2.5 rad/s",
    world(cube("b", 0.2, 2, "0 0 1 0 0 0"), gravity="0 0 0"),
    (
        Row("speed at 1 s, m/s", lambda r: r.at("model:b", "vx", 1.0), law=2.5),
        Row("rate at 1 s, rad/s", lambda r: r.at("model:b", "wz", 1.0), law=0.1 * 0.5 / (2 * 0.04 / 6)),
    ),
    deeds=[Deed("push", "b::l", "10 0 0", 0, 0.5), Deed("torque", "b::l", "0 0 0.1", 0, 0.5)],
)
scene(
    "push_offset_com",
    "AddForce on a link whose centre of mass is aside",
    "AddForce acts in the centre of mass: no turn",
    world(model("b", link("l", inertial(2, 0.02, "0.1 0 0 0 0 0")), pose="0 0 1 0 0 0"), gravity="0 0 0"),
    body_rows(("x", 1.0), ("y", 1.0), ("wz", 1.0)),
    deeds=[Deed("push", "b::l", "0 4 0", 0, 0.5)],
)
scene(
    "tumbling_free",
    "a body of three moments, spun about the middle one",
    "Euler's equations: it turns over",
    world(model("b", link("l", inertial(1, (0.01, 0.02, 0.03))), pose="0 0 1 0 0 0"), gravity="0 0 0"),
    tuple(
        Row(f"{c} at {t:g} s, rad/s", lambda r, c=c, t=t: r.at("model:b", c, t), gazebo=(1e-3, 1e-3), default=(1e-2, 2e-2))
        for t in (0.5, 1.0, 2.0)
        for c in ("wx", "wy", "wz")
    ),
    2.2,
    [Deed("twist", "b", "0 0 0 0.05 6 0.05")],
)
scene(
    "reset_world",
    "a pendulum and a box; world reset after 0.5 s",
    "poses, angles and speeds as at the start",
    world(
        ground(),
        model(
            "p",
            link("a", inertial(1, 0.02, "0 0 -0.25 0 0 0"), pose="0 0 0 0 1 0"),
            joint("j1", "revolute", "world", "a", axis("0 1 0")),
            pose="0 0 2 0 0 0",
        ),
        cube("b", 0.2, 1, "1 0 1 0 0 0"),
    ),
    tuple(Row(f"p::j1 at {t:g} s", lambda r, t=t: r.angle("p::j1", t), gazebo=(1e-4, 2e-5)) for t in (0.48, 0.52, 0.8))
    + body_rows(("z", 0.48), ("z", 0.52), ("z", 0.8), ("vz", 0.52), default=(0, 5e-3)),
    deeds=[Deed("reset", "", "", 0.5)],
)
scene(
    "reset_poses",
    "the same, only the models' poses",
    "poses back, speeds are reset too",
    world(
        ground(),
        model(
            "p",
            link("a", inertial(1, 0.02, "0 0 -0.25 0 0 0"), pose="0 0 0 0 1 0"),
            joint("j1", "revolute", "world", "a", axis("0 1 0")),
            pose="0 0 2 0 0 0",
        ),
        cube("b", 0.2, 1, "1 0 1 0 0 0"),
    ),
    tuple(Row(f"p::j1 at {t:g} s", lambda r, t=t: r.angle("p::j1", t), gazebo=(1e-4, 2e-5)) for t in (0.48, 0.52, 0.8))
    + body_rows(("z", 0.48), ("z", 0.52), ("z", 0.8), ("vz", 0.52), default=(0, 5e-3)),
    deeds=[Deed("reset_poses", "", "", 0.5)],
)
ARM = (  # its base is bolted to the world, or stands free
    link("base", inertial(5, 0.1), collision(box(0.3, 0.3, 0.2)), pose="0 0 0.1 0 0 0"),
    link("upper", inertial(1, 0.02, "0 0 0.25 0 0 0"), pose="0 0 0.3 0 0 0"),
    link("lower", inertial(0.5, 0.01, "0 0 0.2 0 0 0"), pose="0 0 0.8 0 0 0"),
    joint("j1", "revolute", "base", "upper", axis("0 1 0", damping=0.2)),
    joint("j2", "revolute", "upper", "lower", axis("1 0 0", damping=0.2)),
)
for named, bolt in (("bolted", (joint("bolt", "fixed", "world", "base"),)), ("standing", ())):
    for kind, deed in (("poses", "reset_poses"), ("world", "reset")):
        scene(
            f"reset_{kind}_{named}_arm",
            f"an arm of two joints, {named}, moved by efforts; {'the models are reset' if kind == 'poses' else 'world reset'} after 0.5 s",
            "the base is back; and the joints?",
            world(ground(), model("m", *ARM, *bolt, pose="0.2 0.1 0 0 0 0.3")),
            tuple(
                Row(f"m::{j} at {t:g} s", lambda r, j=j, t=t: r.angle(f"m::{j}", t), gazebo=(2e-3, 2e-4), default=(5e-3, 1e-3))
                for t in (0.48, 0.52)
                for j in ("j1", "j2")
            ),
            0.6,
            [Deed("effort", "m::j1", "0.3", 0.0, 0.5), Deed("effort", "m::j2", "0.2", 0.0, 0.5), Deed(deed, "", "", 0.5)],
        )
scene(
    "pose_set",
    "SetWorldPose of a falling box after 0.5 s",
    "moved; does it keep its speed?",
    world(ground(), cube("b", 0.2, 1, "0 0 5 0 0 0")),
    body_rows(("z", 0.5), ("z", 0.52), ("vz", 0.52), ("x", 0.6), ("z", 0.8)),
    deeds=[Deed("pose", "b", "2 0 4 0 0 0.5", 0.5)],
)
scene(
    "support_removed",
    "a box on a box that is removed after 0.5 s",
    "falls from then on",
    world(ground(), cube("low", 0.2, 1, "0 0 0.1 0 0 0"), cube("b", 0.2, 1, "0 0 0.3 0 0 0")),
    body_rows(("z", 0.4), ("z", 0.6), ("z", 1.0), near=(1e-3, 2e-3), default=(1e-3, 2e-3)),
    deeds=[Deed("remove", "low", "", 0.5)],
)
scene(
    "spawned_sdf",
    "a model of SDF spawned after 0.3 s",
    "falls from its pose",
    world(ground()),
    body_rows(("z", 0.4), ("z", 0.6), body="thing"),
    0.7,
    [Deed("spawn", "{folder}/thing/model.sdf", "", 0.3)],
    FILES,
)
for label, physics, step, words in (
    ("step_5ms", "", 0.005, "a step of 5 ms"),
    ("iterations_10", "<ode><solver><type>quick</type><iters>10</iters><sor>1.3</sor></solver></ode>", 0.001, "10 iterations"),
    ("sor_1", "<ode><solver><type>quick</type><iters>50</iters><sor>1.0</sor></solver></ode>", 0.001, "sor 1"),
    ("cfm_001", "<ode><constraints><cfm>0.001</cfm><erp>0.2</erp></constraints></ode>", 0.001, "world cfm 0.001"),
    ("erp_08", "<ode><constraints><cfm>0</cfm><erp>0.8</erp></constraints></ode>", 0.001, "world erp 0.8"),
    (
        "surface_layer",
        "<ode><constraints><contact_surface_layer>0.01</contact_surface_layer></constraints></ode>",
        0.001,
        "contact_surface_layer 1 cm",
    ),
    (
        "correcting_vel",
        "<ode><constraints><contact_max_correcting_vel>0</contact_max_correcting_vel></constraints></ode>",
        0.001,
        "contact_max_correcting_vel 0",
    ),
    ("world_solver", "<ode><solver><type>world</type></solver></ode>", 0.001, "solver type world: ODE's direct one"),
):
    scene(
        f"physics_{label}",
        f"{words}: a box lands flat from 0.1 m, a pendulum of 1 m swings",
        "the box stands at 0.1 m",
        world(
            ground(),
            cube("b", 0.2, 1, "0 0 0.2 0 0 0", surface(1.0)),
            model(
                "p",
                link("a", inertial(1, 0.01, "0 0 -1 0 0 0"), pose="0 0 0 0 1 0"),
                joint("j1", "revolute", "world", "a", axis("0 1 0")),
                pose="2 0 3 0 0 0",
            ),
            physics=physics,
            step=step,
        ),
        (
            Row("z of the box at 1 s", lambda r: r.at("model:b", "z", 1.0), gazebo=(1e-3, 2e-4), default=(0, 2e-3)),
            Row("p::j1 at 1 s", lambda r: r.angle("p::j1", 1.0), gazebo=(1e-4, 2e-5), default=(2e-3, 1e-3)),
        ),
    )


# ---------------------------------------------------------------------------------------------------- heightmap


def grey_png(rows, bits=8, colours=1) -> bytes:
    """A picture of these rows of values: grey ones of ``bits`` bits, or with ``colours=3`` red, green, blue in turn."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    raw = b"".join(b"\0" + b"".join(value.to_bytes(bits // 8, "big") for value in row) for row in rows)
    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", len(rows[0]) // colours, len(rows), bits, 2 if colours == 3 else 0, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(raw, 9))
        + chunk(b"IEND", b"")
    )


RAMP = grey_png([[round(255 * x / 64) for x in range(65)] for _ in range(65)])
BOWL = grey_png([[round(255 * min(1, ((x - 32) ** 2 + (y - 32) ** 2) / 1024)) for x in range(65)] for y in range(65)])


def terrain(z):
    return (
        f"<model name='terrain'><static>1</static><link name='l'><collision name='c'><geometry><heightmap>"
        f"<uri>file://{{folder}}/map.png</uri>"
        f"<size>8 8 {z}</size><pos>0 0 0</pos></heightmap></geometry>{'<surface>' + surface(1.0) + '</surface>'}</collision></link></model>"
    )


scene(
    "heightmap_ramp",
    "ball on a heightmap that rises by 2 m over 8 m along x",
    "rolls down: a = 5/7 g sin",
    world(terrain(2), ball("b", 0.1, 1, "1 0 1.36 0 0 0", surface(1.0))),
    (
        Row("z of the ball at 0.3 s", lambda r: r.at("model:b", "z", 0.3), gazebo=(2e-3, 1e-3), default=(5e-3, 3e-3)),
        Row(
            "x moved from 0.3 to 1 s",
            lambda r: r.at("model:b", "x", 1.0) - r.at("model:b", "x", 0.3),
            gazebo=(1e-2, 1e-3),
            default=(2e-2, 2e-3),
        ),
    ),
    files={"map.png": RAMP},
)
scene(
    "heightmap_bowl",
    "a ball in a bowl",
    "rolls through its middle and back",
    world(terrain(2), ball("b", 0.1, 1, "1.5 0.5 0.6 0 0 0", surface(1.0))),
    (
        Row("x at 1 s", lambda r: r.at("model:b", "x", 1.0), gazebo=(1e-2, 1e-2), default=(5e-2, 3e-2)),
        Row("y at 1 s", lambda r: r.at("model:b", "y", 1.0), gazebo=(1e-2, 1e-2), default=(5e-2, 3e-2)),
        Row("lowest, m", lambda r: r.lowest("model:b", 0, 2), gazebo=(1e-2, 3e-3), default=(2e-2, 5e-3)),
    ),
    2.2,
    files={"map.png": BOWL},
)


def shelves(*values, colours=1, bits=8):
    """Flat ground of four parts along x, 2 m each, of these values or colours."""
    row = [v for x in range(65) for v in (values[min(3, x // 16)] if colours == 3 else (values[min(3, x // 16)],))]
    return grey_png([row] * 65, bits, colours)


def balls_on_shelves(z):
    return world(terrain(z), *(ball(f"b{i}", 0.1, 1, f"{x} 0 4 0 0 0", surface(1.0)) for i, x in enumerate((-3, -1, 1, 3))))


for name, what, law, z, picture in (
    (
        "dim",
        "a picture whose brightest pixel is 128 of 255",
        "Gazebo: the brightest pixel is <size> high, whatever it is",
        2,
        shelves(0, 32, 64, 128),
    ),
    ("lifted", "a picture whose darkest pixel is 100 of 255", "Gazebo: black is 0, so that no part is", 2, shelves(100, 150, 200, 250)),
    ("even", "a picture of one grey", "Gazebo: the brightest pixel is <size> high", 2, shelves(77, 77, 77, 77)),
    ("black", "a black picture", "flat, at 0", 2, shelves(0, 0, 0, 0)),
    ("sunk", "<size> with a negative z", "Gazebo: turned over, black is the highest", -2, shelves(0, 32, 64, 128)),
    (
        "coloured",
        "a picture in colours",
        "Gazebo: blue counts",
        2,
        shelves((200, 0, 0), (0, 200, 0), (0, 0, 200), (200, 200, 200), colours=3),
    ),
    (
        "tinted",
        "a picture whose brightest red is none of its brightest blue",
        "Gazebo: blue counts, and its brightest is <size> high",
        2,
        shelves((250, 0, 0), (0, 0, 100), (0, 220, 200), (50, 50, 50), colours=3),
    ),
    (
        "deep",
        "a picture of 16 bits",
        "the brightest pixel is <size> high; Gazebo reads the lower 8 bits",
        2,
        shelves(0, 8000, 30000, 60000, bits=16),
    ),
):
    scene(
        f"heightmap_{name}",
        f"balls on four flat parts of a heightmap: {what}",
        law,
        balls_on_shelves(z),
        tuple(
            Row(f"z of ball {i} at 3 s", lambda r, i=i: r.at(f"model:b{i}", "z", 3.0), gazebo=(1e-3, 1e-3), default=(2e-3, 2e-3))
            for i in range(4)
        ),
        3.0,
        files={"map.png": picture},
    )
