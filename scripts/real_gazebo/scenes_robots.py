"""Wheels of every kind, casters, grippers: what a robot's wheels and fingers are made of, driven as Gazebo's plugins drive them."""

import math
import struct

from real_gazebo.scene import Deed, Row, Scene, add
from real_gazebo.sdf import (
    axis,
    ball,
    board,
    box,
    box_moments,
    collision,
    cube,
    cylinder,
    cylinder_moments,
    ground,
    inertial,
    joint,
    link,
    mesh,
    model,
    solid,
    sphere,
    surface,
    world,
)

TURN = (0.05, 2e-3)  # of an angle, 5 %
WAY = (0.01, 2e-3)
RADIUS, APART, TREAD = 0.05, 0.38, 0.05
SMOOTH, GRIP = surface(0.0), surface(1.0)
OUTER = "Gazebo pivots on the outer edges of its treads"


def stl(points_of_facets) -> bytes:
    """A binary STL file of these triangles ((x, y, z), ...)."""
    facets = list(points_of_facets)
    return (
        b"\0" * 80
        + struct.pack("<I", len(facets))
        + b"".join(struct.pack("<12fH", 0, 0, 0, *(c for point in facet for c in point), 0) for facet in facets)
    )


def drum(radius, width, sides=32):
    """A cylinder along y as triangles."""
    ring = [(radius * math.cos(2 * math.pi * i / sides), radius * math.sin(2 * math.pi * i / sides)) for i in range(sides)]
    for (x0, z0), (x1, z1) in zip(ring, ring[1:] + ring[:1]):
        a, b, c, d = (x0, -width / 2, z0), (x1, -width / 2, z1), (x1, width / 2, z1), (x0, width / 2, z0)
        yield from ((a, d, b), (b, d, c), ((0, -width / 2, 0), a, b), ((0, width / 2, 0), c, d))


WHEEL_FILES = {"wheel.stl": stl(drum(RADIUS, TREAD))}
TYRES = {
    "cylinder": collision(cylinder(RADIUS, TREAD), GRIP, "0 0 0 1.5707963268 0 0"),
    "sphere": collision(sphere(RADIUS), GRIP),
    "mesh": collision(mesh("wheel.stl"), GRIP),
}


def wheel(name, x, y, tyre, mass=0.5, radius=RADIUS, z=None):
    across, _, along = cylinder_moments(mass, radius, TREAD)
    return link(name, inertial(mass, (across, along, across)), tyre, pose=f"{x} {y} {radius if z is None else z} 0 0 0") + joint(
        f"{name}_joint", "revolute", "base", name, axis("0 1 0")
    )


def base(mass=5.0, balls=(), z=0.08, more=""):
    """A chassis above the wheels, with balls (x, y, surface) under it that touch the floor."""
    feet = "".join(collision(sphere(0.03), s, f"{x} {y} {0.03 - z:.9g} 0 0 0", f"ball{i}") for i, (x, y, s) in enumerate(balls))
    return link("base", inertial(mass, box_moments(mass, 0.4, 0.3, 0.08)), feet, more, pose=f"0 0 {z} 0 0 0")


def differential(tyre):
    return model(
        "r",
        base(balls=((0.15, 0, SMOOTH), (-0.15, 0, SMOOTH))),
        wheel("left", 0, APART / 2, TYRES[tyre]),
        wheel("right", 0, -APART / 2, TYRES[tyre]),
    )


def motors(torque=5.0, **speeds):
    return tuple(Deed("motor", f"r::{name}_joint", f"{speed:.9g} {torque}") for name, speed in speeds.items())


def drive(name, what, law, robot, rows, deeds, seconds=4.2, files=None, others=(), every=0.04):
    return add(Scene(name, "robots", what, law, world(ground(), robot, *others), tuple(rows), seconds, every, tuple(deeds), files or {}))


def turned(body="r", law=None, time=4.0, start=1.0, near=TURN, default=(0.01, 1e-3)):
    return Row(
        f"turned from {start:g} to {time:g} s, rad",
        lambda r: r.yaw_at(f"model:{body}", time) - r.yaw_at(f"model:{body}", start),
        law=law,
        gazebo=near,
        default=default,
    )


def moved(column="x", law=None, time=4.0, start=1.0, near=WAY, default=(0.01, 1e-3), body="r"):
    return Row(
        f"{column} moved from {start:g} to {time:g} s, m",
        lambda r: r.at(f"model:{body}", column, time) - r.at(f"model:{body}", column, start),
        law=law,
        gazebo=near,
        default=default,
    )


W = 0.5 * APART / 2 / RADIUS  # rad/s of a wheel for 0.5 rad/s
for kind in TYRES:
    files = WHEEL_FILES if kind == "mesh" else {}
    drive(
        f"drive_straight_{kind}",
        f"differential drive, wheels of {kind}, 6 rad/s",
        "v = w r = 0.3 m/s",
        differential(kind),
        (moved("x", 0.9), moved("y", 0.0, near=(0.05, 5e-3), default=(0, 2e-3))),
        motors(left=6, right=6),
        files=files,
    )
    drive(
        f"drive_turn_{kind}",
        f"differential drive, wheels of {kind}, told 0.5 rad/s; tread 0.05 m, wheels 0.38 m apart",
        "turns as the middles of its treads say: 0.5 rad/s; on the outer edges it would be 0.442",
        differential(kind),
        (turned(law=1.5),),
        motors(left=-W, right=W),
        files=files,
    )
drive(
    "drive_arc",
    "differential drive, told 0.2 m/s and 0.3 rad/s",
    "v = w r, turn = difference over the distance",
    differential("cylinder"),
    (turned(law=0.9),),
    motors(left=(0.2 - 0.3 * APART / 2) / RADIUS, right=(0.2 + 0.3 * APART / 2) / RADIUS),
)


def skid(tyre="cylinder", mu=1.0, length=0.3):
    tyres = TYRES[tyre].replace(GRIP, surface(mu))
    return model(
        "r",
        base(10.0),
        *(
            wheel(f"{side}{end}", x, y, tyres)
            for side, y in (("left", APART / 2), ("right", -APART / 2))
            for end, x in (("front", length / 2), ("rear", -length / 2))
        ),
    )


ALL = ("leftfront", "leftrear", "rightfront", "rightrear")
drive("skid_straight", "four wheels, 6 rad/s", "0.3 m/s", skid(), (moved("x", 0.9),), motors(10, **dict.fromkeys(ALL, 6)))
drive(
    "skid_turn",
    "four wheels 0.3 m apart along, told 0.5 rad/s by its wheels' distance",
    "Coulomb under four treads decides; no closed law",
    skid(),
    (turned(default=(9, 9)),),
    motors(10, leftfront=-W, leftrear=-W, rightfront=W, rightrear=W),
)
drive(
    "skid_turn_low_mu",
    "the same, mu 0.3",
    "Coulomb's turn does not depend on mu while the motors hold",
    skid(mu=0.3),
    (turned(default=(9, 9)),),
    motors(10, leftfront=-W, leftrear=-W, rightfront=W, rightrear=W),
)
drive(
    "skid_turn_sphere",
    "the same, wheels of spheres",
    "no tread: four points",
    skid("sphere"),
    (turned(default=(9, 9)),),
    motors(10, leftfront=-W, leftrear=-W, rightfront=W, rightrear=W),
)
drive(
    "skid_turn_mesh",
    "the same, wheels of meshes",
    "as with cylinders",
    skid("mesh"),
    (turned(default=(9, 9)),),
    motors(10, leftfront=-W, leftrear=-W, rightfront=W, rightrear=W),
    files=WHEEL_FILES,
)
drive(
    "casters_rigid",
    "two driven wheels ahead, two balls of mu 0.2 behind that do not turn, 6 rad/s",
    "the wheels (0.6 of the load, mu 1) pull them along: 0.3 m/s",
    model(
        "r",
        base(balls=((-0.25, 0.1, surface(0.2)), (-0.25, -0.1, surface(0.2)))),
        wheel("left", 0.15, APART / 2, TYRES["cylinder"]),
        wheel("right", 0.15, -APART / 2, TYRES["cylinder"]),
    ),
    (moved("x", 0.9),),
    motors(left=6, right=6),
)


def swivel():
    """Two driven wheels and a caster that swivels behind."""
    fork = link("fork", inertial(0.1, 1e-4), pose="-0.2 0 0.06 0 0 0") + joint(
        "swivel", "revolute", "base", "fork", axis("0 0 1", damping=1e-3)
    )
    across, _, along = cylinder_moments(0.1, 0.03, 0.02)
    roll = link(
        "roll",
        inertial(0.1, (across, along, across)),
        collision(cylinder(0.03, 0.02), surface(1.0), "0 0 0 1.5707963268 0 0"),
        pose="-0.23 0 0.03 0 0 0",
    )
    return model(
        "r",
        base(),
        wheel("left", 0.1, APART / 2, TYRES["cylinder"]),
        wheel("right", 0.1, -APART / 2, TYRES["cylinder"]),
        fork,
        roll,
        joint("rolling", "revolute", "fork", "roll", axis("0 1 0")),
    )


drive(
    "caster_swivels",
    "two driven wheels and a swivelling caster, backwards at 0.2 m/s: the caster turns round",
    "the trail turns it: swivel ends at pi",
    swivel(),
    (
        Row("|swivel| at 5.5 s, rad", lambda r: abs(r.angle("r::swivel", 5.5)), law=math.pi, gazebo=(0.05, 0), default=(0.05, 0)),
        moved("x", -0.8, 5.0, 1.0, near=(0.05, 0), default=(0.05, 0)),
    ),
    motors(left=-4, right=-4),
    6.0,
)
drive(
    "caster_turn",
    "the same, turning on the spot, told 0.5 rad/s",
    "the caster goes round",
    swivel(),
    (turned(law=1.5, default=(0.02, 0)),),
    motors(left=-W, right=W),
)
ROLLERS = 12


def mecanum(rollers=ROLLERS, big=0.08, small=0.018):
    parts = [link("base", inertial(10, box_moments(10, 0.5, 0.3, 0.1)), pose=f"0 0 {big} 0 0 0")]
    for name, x, y, sign in (("fl", 0.2, 0.2, 1), ("fr", 0.2, -0.2, -1), ("rl", -0.2, 0.2, -1), ("rr", -0.2, -0.2, 1)):
        parts.append(
            link(name, inertial(0.5, 0.001), pose=f"{x} {y} {big} 0 0 0") + joint(f"{name}_joint", "revolute", "base", name, axis("0 1 0"))
        )
        for i in range(rollers):
            a = 2 * math.pi * (i + 0.5) / rollers
            px, pz = (big - small) * math.cos(a), (big - small) * math.sin(a)
            # along the tangent turned by 45 degrees; the axes of the four lowest ones meet in the middle: it turns by sliding alone
            parts.append(
                link(
                    f"{name}{i}",
                    inertial(0.02, 4e-6),
                    collision(sphere(small), surface(1.0)),
                    pose=f"{x + px:.9g} {y} {big + pz:.9g} 0 0 0",
                )
                + joint(f"{name}{i}_joint", "revolute", name, f"{name}{i}", axis(f"{-math.sin(a):.9g} {sign:.9g} {math.cos(a):.9g}"))
            )
    return model("r", *parts)


M = 0.2 / 0.08
drive(
    "mecanum_ahead",
    "four mecanum wheels of 12 ball rollers, all at 2.5 rad/s",
    "0.2 m/s ahead (rollers are an approximation of a circle)",
    mecanum(),
    (moved("x", 0.6, near=(0.05, 0), default=(0.05, 0)), moved("y", 0.0, near=(0.05, 0.02), default=(0, 0.02))),
    motors(10, fl=M, fr=M, rl=M, rr=M),
    every=0.2,
)
drive(
    "mecanum_aside",
    "the same, wheels crosswise: sideways",
    "0.2 m/s aside",
    mecanum(),
    (
        Row(
            "|y| moved from 1 to 4 s, m",
            lambda r: abs(r.at("model:r", "y", 4) - r.at("model:r", "y", 1)),
            law=0.6,
            gazebo=(0.05, 0),
            default=(0.05, 0),
        ),
        moved("x", 0.0, near=(0.05, 0.02), default=(0, 0.02)),
    ),
    motors(10, fl=-M, fr=M, rl=M, rr=-M),
    every=0.2,
)
drive(
    "mecanum_turn",
    "the same, turning: left against right",
    "these rollers cannot roll round the middle: friction decides",
    mecanum(),
    (turned(default=(9, 9)),),
    motors(10, fl=-M, fr=M, rl=-M, rr=M),
    every=0.2,
)


def car(steer):
    """Rear wheels driven, front wheels on king pins held at these angles (left, right)."""
    front = "".join(
        link(f"pin{i}", inertial(0.2, 5e-4), pose=f"0.4 {y} {RADIUS} 0 0 0")
        + joint(f"king{i}", "revolute", "base", f"pin{i}", axis("0 0 1", -0.8, 0.8, damping=0.1))
        + wheel(f"front{i}", 0.4, y, TYRES["cylinder"]).replace("<parent>base", f"<parent>pin{i}")
        for i, y in ((0, 0.15), (1, -0.15))
    )
    body = link("base", inertial(8, box_moments(8, 0.6, 0.3, 0.1), "0.2 0 0 0 0 0"), pose="0 0 0.08 0 0 0")
    return model("r", body, front, wheel("left", 0, 0.15, TYRES["cylinder"]), wheel("right", 0, -0.15, TYRES["cylinder"]))


PINS = math.atan(0.4 / (1.0 - 0.15)), math.atan(0.4 / (1.0 + 0.15))
drive(
    "car_turns",
    "Ackermann car, wheelbase 0.4 m, radius 1 m, rear wheels told 0.3 m/s",
    "turns by v/R = 0.3 rad/s",
    car(PINS),
    (turned(law=0.9, default=(0.02, 0)),),
    motors(left=0.3 * 0.85 / RADIUS, right=0.3 * 1.15 / RADIUS) + tuple(Deed("pd", f"r::king{i}", f"{PINS[i]:.9g} 20 0.2") for i in (0, 1)),
)
drive(
    "holonomic_fdir1",
    "cube on four balls with mu 0 along fdir1 1 0 0 and mu2 1, pushed both ways",
    "glides along fdir1 and not across",
    model(
        "r",
        link(
            "base",
            inertial(2, 0.02),
            *(
                collision(sphere(0.03), surface(0.0, 1.0, "1 0 0"), f"{x} {y} -0.05 0 0 0", f"c{x}{y}")
                for x in (0.1, -0.1)
                for y in (0.1, -0.1)
            ),
            pose="0 0 0.08 0 0 0",
        ),
    ),
    (
        moved("x", 0.5 * 1.0 * (1.0 - 0.0), 1.0, 0.0, near=(1e-3, 0), default=(5e-3, 0)),
        moved("y", 0.0, 1.0, 0.0, near=(0.05, 2e-4), default=(0, 1e-4)),
    ),
    [Deed("push", "r::base", "2 2 0")],
    1.2,
)
drive(
    "parked_on_slope",
    "differential drive on 10 deg, wheels held at 0 rad/s",
    "stands",
    differential("cylinder").replace(
        "<model name='r'>", f"<model name='r'><pose>20 0 {3 + 0.1 / math.cos(math.radians(10)):.9g} 0 {math.radians(10):.9g} 0</pose>"
    ),
    (Row("way from 1 to 4 s, m", lambda r: r.way("model:r", 1, 4), law=0.0, gazebo=(0.1, 1e-4), default=(0, 1e-4)),),
    motors(left=0, right=0),
    others=(board("board", math.radians(10), surface(1.0), "8 3 0.2", x=20),),
)
drive(
    "wheel_over_step",
    "differential drive against a step of 1 cm, 6 rad/s, 5 N m",
    "climbs it",
    differential("cylinder"),
    (
        Row("x at 4 s, m", lambda r: r.at("model:r", "x", 4), gazebo=(0.05, 0), default=(0.1, 0)),
        Row("highest, m", lambda r: r.highest("model:r", 0, 4), gazebo=(0.2, 2e-3), default=(0.3, 3e-3)),
    ),
    motors(left=6, right=6),
    others=(solid("step", box(0.3, 1, 0.01), 1, 1, "0.5 0 0.005 0 0 0", surface(1.0), static=True),),
)
drive(
    "motor_stalls",
    "wheels of 0.05 N m each push 5 kg against 4 N",
    "2 x 0.05/0.05 = 2 N is less than 4 N: is pushed back",
    differential("cylinder"),
    (
        Row(
            "speed at 1.5 s is",
            lambda r: r.at("model:r", "vx", 1.5),
            law=-(4 - 2) / (6 + 2 * 0.000625 / 0.0025) * 1.5,
            gazebo=(0.01, 0),
            default=(0.01, 0),
        ),
    ),
    motors(0.05, left=6, right=6) + (Deed("push", "r::base", "-4 0 0"),),
    1.7,
)

# ---------------------------------------------------------------------------------------------------- grippers


def gripper(mu, weight, shape=None, finger_mu=None):
    """A palm on a vertical rail with two fingers on level rails; between them a cube of 0.06 m at 0.5 m."""
    finger = box(0.04, 0.02, 0.08)
    pads = collision(finger, surface(mu if finger_mu is None else finger_mu))
    body = model(
        "g",
        link("palm", inertial(2, 0.02), pose="0 0 0.62 0 0 0"),
        joint("lift", "prismatic", "world", "palm", axis("0 0 1")),
        link("f1", inertial(0.2, 2e-4), pads, pose="0 0.045 0.5 0 0 0"),
        joint("j1", "prismatic", "palm", "f1", axis("0 -1 0", -0.05, 0.05)),
        link("f2", inertial(0.2, 2e-4), pads, pose="0 -0.045 0.5 0 0 0"),
        joint("j2", "prismatic", "palm", "f2", axis("0 1 0", -0.05, 0.05)),
    )
    held = shape or cube("o", 0.06, weight, "0 0 0.5 0 0 0", surface(mu))
    table = solid("table", box(0.2, 0.03, 0.47), 1, 1, "0 0 0.235 0 0 0", static=True)
    return body, held, table


def grip(name, what, law, bodies, rows, force=10.0, seconds=3.2, lift=0.1):
    deeds = [
        Deed("effort", "g::j1", f"{force}"),
        Deed("effort", "g::j2", f"{force}"),
        Deed("motor", "g::lift", "0 200"),
        Deed("motor", "g::lift", f"{lift} 200", 0.5),
    ]
    return add(Scene(name, "robots", what, law, world(ground(), *bodies), tuple(rows), seconds, 0.02, tuple(deeds)))


HELD = Row(
    "slipped in the hand from 0.6 to 3 s, m",
    lambda r: (r.angle("g::lift", 3.0) - r.angle("g::lift", 0.6)) - (r.at("model:o", "z", 3.0) - r.at("model:o", "z", 0.6)),
    law=0.0,
    gazebo=(0.1, 2e-3),
    default=(0, 1e-3),
)
grip(
    "grip_holds",
    "10 N on each side of 0.5 kg, mu 1",
    "2 mu F = 20 N > 4.9 N: held",
    gripper(1.0, 0.5),
    (HELD, Row("lifted at 3 s, m", lambda r: r.at("model:o", "z", 3.0) - 0.5, law=0.25, gazebo=(0.02, 2e-3), default=(1e-2, 1e-3))),
)
grip("grip_holds_heavy", "40 N on each side of 5 kg, mu 1", "80 N > 49 N: held", gripper(1.0, 5.0), (HELD,), 40.0)
SLIDES = 9.8 - 2 * 0.1 * 10 / 0.5
add(
    Scene(
        "grip_slips",
        "robots",
        "10 N on each side of 0.5 kg, mu 0.1, nothing below it: slides out",
        "a = g - 2 mu F/m = 5.8 m/s^2",
        world(ground(), *gripper(0.1, 0.5)[:2]),
        (
            Row(
                "acceleration from 0.03 to 0.07 s, m/s^2",
                lambda r: -(r.at("model:o", "vz", 0.07) - r.at("model:o", "vz", 0.03)) / 0.04,
                law=SLIDES,
                gazebo=(0.02, 0),
                default=(0.02, 0),
            ),
        ),
        0.1,
        0.005,
        (Deed("effort", "g::j1", "10"), Deed("effort", "g::j2", "10"), Deed("motor", "g::lift", "0 200")),
    )
)
grip(
    "grip_holds_ball",
    "10 N on a ball of 0.3 kg, mu 1: two points",
    "held, may turn about them",
    gripper(1.0, 0.3, ball("o", 0.03, 0.3, "0 0 0.5 0 0 0", surface(1.0))),
    (HELD,),
)
grip(
    "grip_holds_can",
    "10 N on an upright cylinder of 0.3 kg, mu 0.6: two lines",
    "held",
    gripper(0.6, 0.3, solid("o", cylinder(0.03, 0.06), 0.3, cylinder_moments(0.3, 0.03, 0.06), "0 0 0.5 0 0 0", surface(0.6))),
    (HELD,),
)
grip(
    "grip_hard",
    "200 N on 0.1 kg, mu 1: 400 times its weight",
    "held still",
    gripper(1.0, 0.1),
    (HELD, Row("tilt at 3 s, rad", lambda r: r.tilt("model:o", 3.0), law=0.0, gazebo=(0.1, 5e-3), default=(0, 1e-3))),
    200.0,
)
