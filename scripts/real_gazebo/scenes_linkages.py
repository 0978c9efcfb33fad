"""What joints bear, closed loops, joints of two and three axes."""

import math

from real_gazebo.scene import Deed, Row
from real_gazebo.scenes_joints import CLOSE, FREE, NO_CONTACT, angles, one, rates
from real_gazebo.sdf import axis, box, collision, cylinder_moments, inertial, joint, link, model, surface

# ---------------------------------------------------------------------------------------------------- two and three axes


def poses(name, times, columns="xz", near=FREE, default=CLOSE):
    return tuple(
        Row(f"{c} of {name.split(':', 1)[1]} at {t:g} s", lambda r, t=t, c=c: r.at(name, c, t), gazebo=near, default=default)
        for t in times
        for c in ([columns] if columns.startswith("q") else columns)
    )


def rod_energy(r, name, time):
    """Of the rod of 1 kg (0.02 kg m^2 about its centre, 0.5 m below its origin), J."""
    x, y, z, w = (r.at(name, c, time) for c in ("qx", "qy", "qz", "qw"))
    spin = [r.at(name, c, time) for c in ("wx", "wy", "wz")]
    arm = [-0.5 * v for v in (2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y))]
    speed = [spin[1] * arm[2] - spin[2] * arm[1], spin[2] * arm[0] - spin[0] * arm[2], spin[0] * arm[1] - spin[1] * arm[0]]
    return 0.5 * sum(v * v for v in speed) + 0.01 * sum(v * v for v in spin) + 9.8 * arm[2]


one(
    "ball_pendulum",
    "rod on a ball joint, thrown aside: a conical pendulum",
    "energy is kept after the push",
    model("p", link("a", inertial(1, 0.02, "0 0 -0.5 0 0 0"), pose="0 0 0 0 0.5 0"), joint("j1", "ball", "world", "a"), pose="0 0 3 0 0 0"),
    tuple(
        Row(f"{c} of the rod's frame at {t:g} s", lambda r, t=t, c=c: r.at("link:p::a", c, t), gazebo=(1e-4, 1e-4), default=CLOSE)
        for t in (0.5, 1.0, 2.0)
        for c in ("qx", "qy", "wx", "wy")
    )
    + (
        Row(
            "energy gained from 0.2 to 2 s, J of 2.8",
            lambda r: rod_energy(r, "link:p::a", 2.0) - rod_energy(r, "link:p::a", 0.2),
            law=0.0,
            gazebo=(0, 1e-3),
            default=(0, 5e-3),
        ),
    ),
    2.2,
    (Deed("torque", "p::a", "3 0 0", 0, 0.2),),
    links=True,
)
one(
    "ball_pull_out",
    "the same: the ball stays in its socket",
    "the origin does not move",
    model("p", link("a", inertial(5, 0.05, "0 0 -1 0 0 0"), pose="0 0 0 0 1.2 0"), joint("j1", "ball", "world", "a"), pose="0 0 3 0 0 0"),
    (
        Row(
            "origin away from the socket after 1 s, m",
            lambda r: math.dist([r.at("link:p::a", c, 1.0) for c in "xyz"], (0, 0, 3)),
            law=0.0,
            gazebo=(0.05, 2e-5),
            default=(0, 1e-4),
        ),
    ),
    1.5,
    links=True,
)
CROSS = axis("1 0 0", damping=0.02) + axis("0 1 0", name="axis2", damping=0.05)
one(
    "universal_pendulum",
    "rod on a universal joint, damping 0.02 and 0.05, thrown about both axes",
    NO_CONTACT,
    model("p", link("a", inertial(1, 0.02, "0 0 -0.5 0 0 0")), joint("j1", "universal", "world", "a", CROSS), pose="0 0 3 0 0 0"),
    angles("p::j1", (0.3, 0.6, 1.0, 2.0)) + angles("p::j1", (0.3, 0.6, 1.0, 2.0), axis=1),
    2.2,
    (Deed("torque", "p::a", "2 1 0", 0, 0.3),),
)
STOPPED = axis("1 0 0", -0.2, 0.2) + axis("0 1 0", -0.1, 0.1, name="axis2")
one(
    "universal_stops",
    "the same, stops at 0.2 and 0.1 rad",
    "turns no further than its stops",
    model("p", link("a", inertial(1, 0.02, "0 0 -0.5 0 0 0")), joint("j1", "universal", "world", "a", STOPPED), pose="0 0 3 0 0 0"),
    angles("p::j1", (0.2, 0.5, 1.0), default=(1e-2, 5e-3)) + angles("p::j1", (0.2, 0.5, 1.0), axis=1, default=(1e-2, 5e-3)),
    1.2,
    (Deed("torque", "p::a", "4 2 0", 0, 1.0),),
)
FEEDBACK = "<physics><provide_feedback>1</provide_feedback></physics>"
WHEEL = axis("0 0 1", -0.5, 0.5, damping=0.1) + axis("0 1 0", name="axis2", damping=0.001)
one(
    "revolute2_wheel",
    "steered wheel: 0.2 N m about the king pin, 0.05 N m about the axle",
    "a spinning wheel resists steering: gyroscope",
    model("w", link("a", inertial(2, (0.006, 0.01, 0.006))), joint("j1", "revolute2", "world", "a", WHEEL), pose="0 0 2 0 0 0"),
    angles("w::j1", (0.5, 1.0, 2.0)) + angles("w::j1", (0.5, 1.0, 2.0), axis=1, default=(5e-3, 1e-3)),
    2.2,
    (Deed("effort", "w::j1", "0.2 0", 0, 0.5), Deed("effort", "w::j1", "0.05 1")),
)
one(
    "revolute2_on_base",
    "the same wheel on a base that is bolted to the world",
    "a spinning wheel resists steering: gyroscope",
    model(
        "w",
        link("base", inertial(50, 5)),
        joint("bolt", "fixed", "world", "base"),
        link("a", inertial(2, (0.006, 0.01, 0.006))),
        joint("j1", "revolute2", "base", "a", WHEEL),
        pose="0 0 2 0 0 0",
    ),
    angles("w::j1", (0.5, 1.0, 2.0)) + angles("w::j1", (0.5, 1.0, 2.0), axis=1, default=(5e-3, 1e-3)),
    2.2,
    (Deed("effort", "w::j1", "0.2 0", 0, 0.5), Deed("effort", "w::j1", "0.05 1")),
)
one(
    "screw_falls",
    "nut of 1 kg (J 0.01) on a screw, thread_pitch 20 rad/m",
    "a = m g/(m + J p^2) = 9.8/5 m/s^2",
    model(
        "n",
        link("a", inertial(1, 0.01)),
        joint("j1", "screw", "world", "a", axis("0 0 1"), "<thread_pitch>20</thread_pitch>"),
        pose="0 0 3 0 0 0",
    ),
    (
        Row("way down in 0.5 s, m", lambda r: 3 - r.at("link:n::a", "z", 0.5), law=0.5 * 9.8 / 5 * 0.25, default=(5e-3, 0)),
        Row("rate of turning at 0.5 s, rad/s", lambda r: r.at("link:n::a", "wz", 0.5), gazebo=(1e-3, 1e-4), default=(5e-3, 1e-3)),
    )
    + angles("n::j1", (0.3, 0.5), near=(1e-3, 1e-4), default=(5e-3, 1e-3)),
    0.7,
    links=True,
)
one(
    "screw_driven",
    "the same, turned with 0.5 N m upwards and damped",
    "the thread turns torque into lift",
    model(
        "n",
        link("a", inertial(1, 0.01)),
        joint("j1", "screw", "world", "a", axis("0 0 1", damping=0.05), "<thread_pitch>20</thread_pitch>"),
        pose="0 0 3 0 0 0",
    ),
    angles("n::j1", (0.3, 0.6), near=(1e-3, 1e-4), default=(5e-3, 1e-3))
    + poses("link:n::a", (0.3, 0.6), "z", near=(1e-3, 1e-4), default=(5e-3, 1e-3)),
    0.8,
    (Deed("effort", "n::j1", "0.5"),),
    links=True,
)
GEARS = model(
    "g",
    link("frame", inertial(10, 1)),
    joint("hold", "fixed", "world", "frame"),
    link("a", inertial(1, 0.01), pose="0.2 0 0 0 0 0"),
    link("b", inertial(1, 0.01), pose="-0.2 0 0 0 0 0"),
    joint("ja", "revolute", "frame", "a", axis("0 1 0")),
    joint("jb", "revolute", "frame", "b", axis("0 1 0")),
    joint(
        "mesh",
        "gearbox",
        "a",
        "b",
        axis("0 1 0") + axis("0 1 0", name="axis2"),
        "<gearbox_ratio>3</gearbox_ratio><gearbox_reference_body>frame</gearbox_reference_body>",
    ),
    pose="0 0 2 0 0 0",
)
one(
    "gearbox",
    "two wheels (J 0.01), gearbox_ratio 3; 0.1 N m on the first",
    "theirs: wb = -3 wa, so a = 0.1/(J + 9 J) = 1 rad/s^2",
    GEARS,
    (Row("ratio of the two rates at 1 s", lambda r: r.rate("g::jb", 1.0) / r.rate("g::ja", 1.0), gazebo=(1e-3, 0)),)
    + rates("g::ja", (0.5, 1.0))
    + angles("g::jb", (1.0,)),
    1.2,
    (Deed("effort", "g::ja", "0.1"),),
)
one(
    "fixed_cantilever",
    "3 kg held 0.5 m aside by a fixed joint to the world",
    "bears 29.4 N and 14.7 N m",
    model(
        "p",
        link("a", inertial(3, 0.02), pose="0.5 0 0 0 0 0"),
        joint("j1", "fixed", "world", "a", FEEDBACK, pose="-0.5 0 0 0 0 0"),
        pose="0 0 2 0 0 0",
    ),
    (
        Row("sinks in 1 s, m", lambda r: 2 - r.at("link:p::a", "z", 1.0), law=0.0, gazebo=(0.05, 2e-5), default=(0, 1e-5)),
        Row("|force z| at 1 s, N", lambda r: abs(r.wrench("p::j1", 2, 1.0)), law=29.4, gazebo=(1e-3, 0)),
        Row("|torque y| at 1 s, N m", lambda r: abs(r.wrench("p::j1", 4, 1.0)), law=14.7, gazebo=(1e-3, 0)),
    ),
    1.2,
    wrenches=True,
    links=True,
)
one(
    "fixed_chain_falls",
    "two boxes joined by a fixed joint fall and land",
    "they land as one",
    model(
        "p",
        link("a", inertial(1, 0.00667), collision(box(0.2, 0.2, 0.2), surface(1.0))),
        link("b", inertial(1, 0.00667), collision(box(0.2, 0.2, 0.2), surface(1.0)), pose="0.3 0 0 0 0 0"),
        joint("j1", "fixed", "a", "b"),
        pose="0 0 1 0 0.3 0",
    ),
    (
        Row("z of a at 2 s, m", lambda r: r.at("link:p::a", "z", 2.0), law=0.1, gazebo=(1e-3, 5e-4)),
        Row(
            "b over a at 2 s, m",
            lambda r: r.at("link:p::b", "z", 2.0) - r.at("link:p::a", "z", 2.0),
            law=0.0,
            gazebo=(0, 5e-4),
            default=(0, 5e-4),
        ),
        Row(
            "distance of a and b at 2 s, m",
            lambda r: math.dist([r.at("link:p::a", c, 2.0) for c in "xyz"], [r.at("link:p::b", c, 2.0) for c in "xyz"]),
            law=0.3,
        ),
    ),
    2.2,
    links=True,
)

# ---------------------------------------------------------------------------------------------------- what joints bear, loops


def bears(name, kind, parts, *, tilt="0 0 0", law=""):
    """2 kg, 0.1 m aside and 0.05 m up in a joint's frame that is tilted by 0.4 rad: what the joint reports."""
    body = model(
        "p",
        link("base", inertial(5, 0.1)),
        joint("hold", "fixed", "world", "base"),
        link("a", inertial(2, 0.01, "0.1 0 0.05 0 0 0"), pose="0.3 -0.5 1 0.4 0 0.2"),
        joint("j1", kind, "base", "a", FEEDBACK, *parts),
        pose="0 0 1 0 0 0",
    )
    rows = tuple(
        Row(
            f"{what} {c} on body {b + 1} at 1 s",
            lambda r, i=6 * b + 3 * k + n: r.wrench("p::j1", i, 1.0),
            gazebo=(1e-2, 0.1),
            default=(1e-2, 0.1),
        )
        for b in (0, 1)
        for k, what in enumerate(("force", "torque"))
        for n, c in enumerate("xyz")
    )
    return one(
        name,
        f"{kind} joint holding 2 kg aside: Joint::GetForceTorque",
        law or "19.6 N of weight, in the frames of the two links",
        body,
        rows,
        1.2,
        wrenches=True,
    )


LOCKED = "<effort>100</effort><velocity>1</velocity>"
bears("wrench_revolute", "revolute", (axis("0 0 1", 0, 0, limit=LOCKED),))
bears("wrench_prismatic", "prismatic", (axis("0 0 1", 0, 0, limit=LOCKED),))
bears("wrench_fixed", "fixed", ())
bears("wrench_universal", "universal", (axis("1 0 0", 0, 0) + axis("0 1 0", 0, 0, name="axis2"),))

A, B, C = 0.2, 0.4, 0.4  # crank, coupler and rocker; the ground is 0.5


def four_bar(speed):
    """Crank upright at the start; where the coupler meets the rocker follows from the triangle."""
    ox, oz, px = 0.0, 0.2, 0.5
    d = math.dist((ox, oz), (px, 0))
    along = (d * d + B * B - C * C) / (2 * d)
    high = math.sqrt(B * B - along * along)
    ux, uz = (px - ox) / d, -oz / d
    qx, qz = ox + along * ux - high * uz, oz + along * uz + high * ux
    bars = []
    for name, (x0, z0), (x1, z1) in (("crank", (0, 0), (ox, oz)), ("coupler", (ox, oz), (qx, qz)), ("rocker", (px, 0), (qx, qz))):
        length = math.dist((x0, z0), (x1, z1))
        pitch = math.atan2(x1 - x0, z1 - z0)
        bars.append(
            link(
                name,
                inertial(0.3, cylinder_moments(0.3, 0.01, length), f"0 0 {length / 2:.9g} 0 0 0"),
                pose=f"{x0:.9g} 0 {z0:.9g} 0 {pitch:.9g} 0",
            )
        )
    return model(
        "m",
        *bars,
        joint("drive", "revolute", "world", "crank", axis("0 1 0")),
        joint("elbow", "revolute", "crank", "coupler", axis("0 1 0")),
        joint("pivot", "revolute", "world", "rocker", axis("0 1 0")),
        joint("loop", "revolute", "coupler", "rocker", axis("0 1 0"), pose=f"0 0 {C} 0 0 0"),
        pose="0 0 1 0 0 0",
    )


def rocker_angle(crank):
    """Angle of the rocker when the crank has turned by that, rad (pitch, from upright)."""
    ox, oz, px = A * math.sin(crank), A * math.cos(crank), 0.5
    d = math.dist((ox, oz), (px, 0))
    along = (d * d + B * B - C * C) / (2 * d)
    high = math.sqrt(B * B - along * along)
    ux, uz = (px - ox) / d, -oz / d
    return math.atan2(ox + along * ux - high * uz - px, oz + along * uz + high * ux)


one(
    "four_bar_motor",
    "four-bar linkage, crank by a motor of 2 rad/s",
    "geometry: the rocker follows from the triangle",
    four_bar(2),
    tuple(
        Row(
            f"rocker at {t:g} s, rad",
            lambda r, t=t: r.angle("m::pivot", t),
            law=rocker_angle(2 * t) - rocker_angle(0),
            gazebo=(2e-3, 2e-4),
            default=(5e-3, 4e-3),
        )
        for t in (0.3, 0.8, 1.5, 2.5)
    ),
    2.7,
    (Deed("motor", "m::drive", "2 50"),),
)
one("four_bar_falls", "the same linkage let go", NO_CONTACT, four_bar(0), angles("m::drive", (0.3, 0.6, 1.0), default=(5e-3, 1e-3)), 1.2)
