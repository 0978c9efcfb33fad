"""Single contacts: every parameter of friction and of the surface, one body on one board or ball on one plate."""

import math

from real_gazebo.scene import Deed, Row, Scene, add
from real_gazebo.sdf import (
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
    link,
    model,
    on_slope,
    solid,
    surface,
    world,
)

G = 9.8
SAME = (5e-4, 2e-5)
COULOMB = "Coulomb: a = g (sin - mu cos)"
# What a body does that must stand: Gazebo's 50 iterations let it creep.
CREEP = "quickStep's iterations end before friction holds: real Gazebo creeps"


def radians(degrees):
    return degrees / 180 * math.pi


def slide(angle, mu):
    return G * (math.sin(radians(angle)) - mu * math.cos(radians(angle)))


def contact(name, what, law, bodies, rows, seconds=1.4, deeds=(), **settings):
    extra = {k: settings.pop(k) for k in ("physics", "gravity", "step") if k in settings}
    bodies = bodies if isinstance(bodies, tuple) else (bodies,)
    return add(Scene(name, "contacts", what, law, world(ground(), *bodies, **extra), tuple(rows), seconds, deeds=tuple(deeds), **settings))


# ---------------------------------------------------------------------------------------------------- friction


def slope(name, what, angle, body, plate=None, law=COULOMB, value=None, yaw=0.0, rows=(), seconds=1.4, turned=0.0):
    """A cube of 0.2 m on a board, both tilted by `angle` (deg)."""
    a = radians(angle)
    bodies = (
        board("board", a, plate or surface(1.0), "8 3 0.2", x=20, yaw=yaw),
        cube("cube", 0.2, 1, on_slope(a, -2.5, 0.2, x=20, yaw=yaw), body),
    )
    rows = rows or (
        Row(
            "acceleration from 0.3 to 1.2 s, m/s^2",
            lambda r: r.acceleration("model:cube", 0.3, 1.2),
            law=value,
            gazebo=SAME,
            default=(1e-3, 1e-3),
        ),
    )
    return contact(name, what, law, bodies, rows, seconds)


def stands(name, what, angle, body, plate=None, yaw=0.0):
    return slope(
        name,
        what,
        angle,
        body,
        plate,
        "Coulomb: friction holds",
        yaw=yaw,
        rows=(Row("way from 0.3 to 1.2 s, m", lambda r: r.way("model:cube", 0.3, 1.2), law=0.0, gazebo=(0, 2e-3), default=(0, 1e-5)),),
    )


slope("slope_20_mu03", "cube on 20 deg, mu 0.3", 20, surface(0.3), value=slide(20, 0.3))
slope("slope_30_mu03", "cube on 30 deg, mu 0.3", 30, surface(0.3), value=slide(30, 0.3))
slope("slope_15_mu02", "cube on 15 deg, mu 0.2 (the board's 1.0)", 15, surface(0.2), value=slide(15, 0.2))
slope("slope_mu0", "cube on 10 deg, mu 0", 10, surface(0.0), value=slide(10, 0))
slope(
    "slope_mu_of_board",
    "cube of mu 1 on a board of mu 0.1, 20 deg: the smaller counts",
    20,
    surface(1.0),
    surface(0.1),
    value=slide(20, 0.1),
)
stands("slope_20_mu05_stands", "cube on 20 deg, mu 0.5: must stand", 20, surface(0.5))
stands("slope_30_mu1_stands", "cube on 30 deg, mu 1: must stand", 30, surface(1.0))
slope(
    "slope_diagonal",
    "cube on 25 deg, mu 0.3, the slope across the world's axes",
    25,
    surface(0.3),
    yaw=math.pi / 4,
    value=slide(25, 0.3),
    rows=(
        Row(
            "acceleration from 0.3 to 1.2 s, m/s^2",
            lambda r: r.acceleration("model:cube", 0.3, 1.2),
            law=slide(25, 0.3),
            gazebo=(2e-3, 1e-4),
            default=(5e-3, 0),
        ),
    ),
)
slope("slope_fdir1_along", "fdir1 along the slope: mu 0.1 there, mu2 1 across", 20, surface(0.1, 1.0, "1 0 0"), value=slide(20, 0.1))
stands("slope_fdir1_across", "fdir1 across: mu 0.1 there, mu2 1 along: must stand", 20, surface(0.1, 1.0, "0 1 0"))
slope(
    "slope_mu2_only",
    "mu 1, mu2 0.1 without fdir1: which way is the second?",
    20,
    surface(1.0, 0.1),
    law="Gazebo: the first direction comes from the normal",
)
slope(
    "slope_slip1",
    "slip1 0.1, 10 deg: glides at slip m g sin",
    10,
    surface(1.0, slip1=0.1, slip2=0.1),
    rows=(
        Row("speed at 1 s, m/s", lambda r: r.speed("model:cube", 1.0), law=0.1 * G * math.sin(radians(10)), gazebo=SAME, default=(2e-2, 0)),
    ),
    law="v = slip F for each contact point's share; ODE adds the slip of each point",
)
slope(
    "slope_slip2_across",
    "slip2 0.1 alone, fdir1 along",
    10,
    surface(1.0, 1.0, "1 0 0", slip2=0.1),
    rows=(Row("speed at 1 s, m/s", lambda r: r.speed("model:cube", 1.0), law=0.0, gazebo=(0.05, 1e-3), default=(0, 1e-3)),),
    law="slip2 acts across only: stands",
)
slope(
    "slope_slip_both",
    "slip1 0.1 of the cube and of the board add",
    10,
    surface(1.0, slip1=0.1, slip2=0.1),
    surface(1.0, slip1=0.1, slip2=0.1),
    rows=(Row("speed at 1 s, m/s", lambda r: r.speed("model:cube", 1.0), gazebo=SAME, default=(2e-2, 0)),),
    law="slips add",
)

contact(
    "slide_to_rest",
    "cube thrown along the plane at 2 m/s, mu 0.4",
    "stops after v^2/(2 mu g) = 0.5102 m",
    cube("cube", 0.2, 1, "0 0 0.1 0 0 0", surface(0.4)),
    (
        Row("way at 1.2 s, m", lambda r: r.at("model:cube", "x", 1.2), law=4 / (2 * 0.4 * G), gazebo=(1e-3, 0), default=(5e-3, 0)),
        Row("speed at 0.25 s, m/s", lambda r: r.at("model:cube", "vx", 0.25), law=2 - 0.4 * G * 0.25, gazebo=(1e-3, 0), default=(3e-3, 0)),
    ),
    deeds=[Deed("twist", "cube", "2 0 0 0 0 0")],
)
contact(
    "slide_diagonal",
    "the same, thrown at 45 degrees",
    "Coulomb: 0.5102 m along a straight line",
    cube("cube", 0.2, 1, "0 0 0.1 0 0 0", surface(0.4)),
    (Row("way at 1.2 s, m", lambda r: r.way("model:cube", 0, 1.2), law=4 / (2 * 0.4 * G), gazebo=(1e-3, 0), default=(5e-3, 0)),),
    deeds=[Deed("twist", "cube", "1.4142136 1.4142136 0 0 0 0")],
)
contact(
    "spin_to_rest",
    "cube spun at 5 rad/s on its face, mu 0.4",
    "friction's moment of four corners: mu m g r, r = 0.1414: slows by 83.2 rad/s^2",
    cube("cube", 0.2, 1, "0 0 0.1 0 0 0", surface(0.4)),
    (
        Row(
            "turned at 0.5 s, rad",
            lambda r: r.yaw_at("model:cube", 0.5),
            law=25 / (2 * 0.4 * G * 0.1 * math.sqrt(2) * 6 / 0.04),
            gazebo=(5e-3, 0),
            default=(2e-2, 0),
        ),
    ),
    0.6,
    [Deed("twist", "cube", "0 0 0 0 0 5")],
    every=0.005,
)
contact(
    "roll_down",
    "ball rolls down 20 deg, mu 1",
    "a = 5/7 g sin",
    (
        board("board", radians(20), surface(1.0), "8 3 0.2", x=20),
        ball("ball", 0.1, 1, on_slope(radians(20), -2.5, 0.2, x=20), surface(1.0)),
    ),
    (
        Row(
            "acceleration, m/s^2",
            lambda r: r.acceleration("model:ball", 0.3, 1.0),
            law=5 / 7 * G * math.sin(radians(20)),
            gazebo=SAME,
            default=(5e-4, 0),
        ),
        Row(
            "v/(w r) at 1 s",
            lambda r: r.speed("model:ball", 1.0) / (0.1 * r.spin("model:ball", 1.0)),
            law=1.0,
            gazebo=SAME,
            default=(5e-4, 0),
        ),
    ),
)
contact(
    "roll_slips",
    "ball on 40 deg, mu 0.1: slips",
    "a = g (sin - mu cos), spins by 5/2 mu g cos/r",
    (
        board("board", radians(40), surface(1.0), "8 3 0.2", x=20),
        ball("ball", 0.1, 1, on_slope(radians(40), -2.5, 0.2, x=20), surface(0.1)),
    ),
    (
        Row("acceleration, m/s^2", lambda r: r.acceleration("model:ball", 0.2, 0.8), law=slide(40, 0.1), gazebo=SAME, default=(1e-3, 0)),
        Row(
            "spin at 0.8 s, rad/s",
            lambda r: r.spin("model:ball", 0.8),
            law=2.5 * 0.1 * G * math.cos(radians(40)) / 0.1 * 0.8,
            gazebo=(1e-3, 0),
            default=(5e-3, 0),
        ),
    ),
    1.0,
)
contact(
    "slip_then_roll",
    "ball thrown at 3 m/s without spin, mu 0.2",
    "rolls at 5/7 of its speed from 2 v/(7 mu g) = 0.437 s on",
    ball("ball", 0.1, 1, "0 0 0.1 0 0 0", surface(0.2)),
    (
        Row("speed at 1 s, m/s", lambda r: r.at("model:ball", "vx", 1.0), law=15 / 7, gazebo=(1e-3, 0), default=(3e-3, 0)),
        Row("speed at 0.2 s, m/s", lambda r: r.at("model:ball", "vx", 0.2), law=3 - 0.2 * G * 0.2, gazebo=(1e-3, 0), default=(3e-3, 0)),
    ),
    deeds=[Deed("twist", "ball", "3 0 0 0 0 0")],
)

# ---------------------------------------------------------------------------------------------------- who touches whom


def falls_or_not(name, what, law, bodies, rows, **settings):
    return contact(name, what, law, bodies, rows, settings.pop("seconds", 1.2), **settings)


def over(name, body="", plate="", more=()):
    below = model("plate", link("l", collision("<box><size>2 2 0.2</size></box>", plate)), pose="0 0 1 0 0 0", static=True)
    return (below, cube("b", 0.2, 1, "0 0 1.3 0 0 0", body), *more)


HEIGHT = Row("height at 1 s, m", lambda r: r.at("model:b", "z", 1.0), gazebo=(1e-3, 5e-4), default=(1e-3, 1e-3))
falls_or_not(
    "bitmask_apart",
    "collide_bitmask 1 on 2: they pass through one another",
    "1 & 2 = 0: no contact",
    over("b", "<contact><collide_bitmask>1</collide_bitmask></contact>", "<contact><collide_bitmask>2</collide_bitmask></contact>"),
    (HEIGHT,),
)
falls_or_not(
    "bitmask_shared",
    "collide_bitmask 3 on 2: they touch",
    "3 & 2 = 2: contact",
    over("b", "<contact><collide_bitmask>3</collide_bitmask></contact>", "<contact><collide_bitmask>2</collide_bitmask></contact>"),
    (HEIGHT,),
)
falls_or_not(
    "bitmask_zero", "collide_bitmask 0", "touches nothing", over("b", "<contact><collide_bitmask>0</collide_bitmask></contact>"), (HEIGHT,)
)
falls_or_not(
    "without_contact",
    "collide_without_contact: found, not held",
    "falls through",
    over("b", "<contact><collide_without_contact>1</collide_without_contact></contact>"),
    (HEIGHT,),
)
falls_or_not(
    "max_contacts_1",
    "a cube with max_contacts 1",
    "one point cannot carry a face: what it does is Gazebo's rule",
    cube("b", 0.2, 1, "0 0 0.1 0 0 0", surface(1.0)).replace("</collision>", "<max_contacts>1</max_contacts></collision>"),
    (HEIGHT, Row("tilt at 1 s, rad", lambda r: r.tilt("model:b", 1.0), gazebo=(1e-2, 5e-3), default=(9, 9))),
)
for on in (0, 1):
    arms = model(
        "m",
        link("base", inertial(5, 0.1), collision(box(0.4, 0.4, 0.1)), pose="0 0 0.05 0 0 0"),
        link("post", inertial(1, 0.01), collision(box(0.1, 0.1, 0.1)), pose="0 0 0.5 0 0 0"),
        "<joint name='rail' type='prismatic'><parent>base</parent><child>post</child><axis><xyz>0 0 1</xyz></axis></joint>",
        link("free", inertial(1, 0.01), collision(box(0.1, 0.1, 0.1)), pose="0 0 0.9 0 0 0"),
        "<joint name='rail2' type='prismatic'><parent>base</parent><child>free</child><axis><xyz>0 0 1</xyz></axis></joint>",
        f"<self_collide>{on}</self_collide>",
    )
    contact(
        f"self_collide_{on}",
        f"two sliders on one base, self_collide {on}",
        "links of one model touch only with self_collide, and never across a joint",
        arms,
        (
            Row(
                "upper over lower at 2 s, m",
                lambda r: r.at("link:m::free", "z", 2.0) - r.at("link:m::post", "z", 2.0),
                gazebo=(1e-3, 1e-3),
                default=(1e-3, 2e-3),
            ),
        ),
        2.2,
        links=True,
    )

# ---------------------------------------------------------------------------------------------------- shapes

contact(
    "cylinder_rolls",
    "cylinder rolls down 15 deg",
    "a = 2/3 g sin",
    (
        board("board", radians(15), surface(1.0), "8 3 0.2", x=20),
        model(
            "roll",
            link(
                "l", inertial(1, cylinder_moments(1, 0.1, 0.2)), collision(cylinder(0.1, 0.2), surface(1.0)), pose="0 0 0 1.5707963268 0 0"
            ),
            pose=on_slope(radians(15), -2.5, 0.2, x=20),
        ),
    ),
    (
        Row(
            "acceleration, m/s^2",
            lambda r: r.acceleration("link:roll::l", 0.3, 1.0),
            law=2 / 3 * G * math.sin(radians(15)),
            gazebo=(1e-3, 0),
            default=(2e-3, 0),
        ),
    ),
    links=True,
)
contact(
    "cylinder_stands",
    "cylinder of 0.05 m radius and 0.4 m stands",
    "stays upright",
    solid("can", cylinder(0.05, 0.4), 1, cylinder_moments(1, 0.05, 0.4), "0 0 0.2 0 0 0", surface(1.0)),
    (Row("tilt at 2 s, rad", lambda r: r.tilt("model:can", 2.0), law=0.0, gazebo=(0.1, 2e-3), default=(0, 1e-3)),),
    2.2,
)
contact(
    "cylinder_topples",
    "the same, leaning by 0.3 rad beyond its edge",
    "falls: time until it lies",
    solid("can", cylinder(0.05, 0.4), 1, cylinder_moments(1, 0.05, 0.4), "0 0 0.21 0 0.3 0", surface(1.0)),
    (
        Row("first below 0.1 m, s", lambda r: r.falls_at("model:can", 0.1), gazebo=(0.02, 0.01), default=(0.1, 0)),
        Row("z at 2 s, m", lambda r: r.at("model:can", "z", 2.0), law=0.05, gazebo=(1e-2, 2e-3), default=(0, 2e-3)),
    ),
    2.2,
)
contact(
    "box_tumbles",
    "box of 0.3 x 0.2 x 0.1 dropped askew",
    "comes to rest on a face",
    solid("b", box(0.3, 0.2, 0.1), 1, box_moments(1, 0.3, 0.2, 0.1), "0 0 1 0.5 0.3 0.2", surface(0.6)),
    (
        Row("z at 3 s, m", lambda r: r.at("model:b", "z", 3.0), law=0.05, gazebo=(1e-2, 1e-3), default=(0, 1e-3)),
        Row("x at 3 s, m", lambda r: r.at("model:b", "x", 3.0), gazebo=(2e-2, 2e-3), default=(9, 9)),
        Row("speed at 0.4 s, m/s", lambda r: r.speed("model:b", 0.4), law=G * 0.4, gazebo=SAME, default=(1e-3, 0)),
    ),
    3.2,
)
contact(
    "balls_collide",
    "a ball of 2 m/s meets one at rest, restitution 0.9, max_vel 1000",
    "v' = (1 + e)/2 v = 1.9 m/s, (1 - e)/2 v = 0.1",
    (
        ball("a", 0.1, 1, "0 0 1 0 0 0", surface(0.0, e=0.9, threshold=0.01, max_vel=1000)),
        ball("b", 0.1, 1, "0.7 0 1 0 0 0", surface(0.0, e=0.9, threshold=0.01, max_vel=1000)),
    ),
    (
        Row("speed of the struck one at 0.5 s, m/s", lambda r: r.at("model:b", "vx", 0.5), law=1.9, gazebo=(1e-3, 0), default=(5e-3, 0)),
        Row("speed of the other, m/s", lambda r: r.at("model:a", "vx", 0.5), law=0.1, gazebo=(1e-3, 1e-4), default=(5e-2, 0)),
    ),
    0.6,
    [Deed("twist", "a", "2 0 0 0 0 0")],
    gravity="0 0 0",
)
contact(
    "balls_mass_ratio",
    "a ball of 10 kg and 2 m/s meets one of 0.1 kg, restitution 0.9, max_vel 1000",
    "momentum and restitution: 3.7624 and 1.9624 m/s",
    (
        ball("a", 0.1, 10, "0 0 1 0 0 0", surface(0.0, e=0.9, threshold=0.01, max_vel=1000)),
        ball("b", 0.1, 0.1, "0.7 0 1 0 0 0", surface(0.0, e=0.9, threshold=0.01, max_vel=1000)),
    ),
    (
        Row(
            "speed of the light one at 0.5 s, m/s",
            lambda r: r.at("model:b", "vx", 0.5),
            law=2 * 1.9 * 10 / 10.1,
            gazebo=(1e-3, 0),
            default=(5e-3, 0),
        ),
        Row(
            "speed of the other, m/s",
            lambda r: r.at("model:a", "vx", 0.5),
            law=2 * (10 - 0.9 * 0.1) / 10.1,
            gazebo=(1e-3, 1e-4),
            default=(5e-3, 0),
        ),
    ),
    0.6,
    [Deed("twist", "a", "2 0 0 0 0 0")],
    gravity="0 0 0",
)


def force_on(r, body, start, end):
    """Mean of what all contacts press on a body upwards, N."""
    total = 0.0
    for name, rows in r.series.items():
        if name.startswith("contact:"):
            first = name.split(":", 1)[1].split("|")[0].startswith(body + "::")
            total += sum(row[10] for row in rows if start - 1e-9 <= row[0] <= end + 1e-9) * (1 if first else -1)
    return total / (round((end - start) / 0.001) + 1)


contact(
    "contact_forces",
    "cube of 2 kg that lies on the plane: what its contacts bear",
    "19.6 N, in the mean; Gazebo's points flicker",
    cube("b", 0.2, 2, "0 0 0.1 0 0 0", surface(1.0)),
    (
        Row(
            "mean force on the cube from 0.05 to 0.2 s, N",
            lambda r: force_on(r, "b", 0.05, 0.2),
            law=19.6,
            gazebo=(0.05, 0),
            default=(1e-2, 0),
        ),
        Row(
            "greatest depth, m",
            lambda r: max(float(v[:, 7].max()) for n, v in r.series.items() if n.startswith("contact:")),
            gazebo=(0.2, 5e-5),
            default=(9, 9),
        ),
    ),
    0.2,
    contacts=True,
    every=0.001,
)
