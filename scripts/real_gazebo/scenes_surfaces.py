"""Bounce, stiffness and overlap of single contacts: a ball or a cube over a plate."""

import math

from real_gazebo.scene import Deed, Row
from real_gazebo.scenes_contacts import G, contact
from real_gazebo.sdf import ball, collision, cube, link, model, surface

# ---------------------------------------------------------------------------------------------------- bounce, stiffness, overlap

PLATE = "2 2 0.2"


def drop(name, what, law, body, plate, rows, height=1.0, kind="ball", seconds=2.5, every=0.005, **settings):
    """A ball of 0.05 m and 0.2 kg, or a cube of 0.2 m and 1 kg, over a plate whose top is at 1.1 m."""
    below = model(
        "plate",
        link("l", collision(f"<box><size>{PLATE}</size></box>", surface(**plate) if plate else "")),
        pose="0 0 1 0 0 0",
        static=True,
    )
    above = (
        ball("b", 0.05, 0.2, f"0 0 {1.15 + height} 0 0 0", surface(**body) if body else "")
        if kind == "ball"
        else cube("b", 0.2, 1, f"0 0 {1.2 + height} 0 0 0", surface(**body) if body else "")
    )
    return contact(name, what, law, (below, above), rows, seconds, every=every, **settings)


def peak(height=1.0):
    """Of the first bounce over the plate, m: highest place after the fall."""
    fall = math.sqrt(2 * height / G)
    return lambda r: r.highest("model:b", fall + 0.02, 3 * fall) - 1.15


def bounce(
    name, what, body, plate, law=None, words="a ball springs back to e^2 of its height, where max_vel lets it", default=(2e-2, 2e-3)
):
    return drop(
        name,
        what,
        words,
        body,
        plate,
        (
            Row("first peak after a fall of 1 m, m", peak(), law=law, gazebo=(1e-3, 2e-4), default=default),
            Row("height at the end, m", lambda r: r.at("model:b", "z", 2.45) - 1.15, gazebo=(5e-3, 5e-4), default=(9, 9)),
        ),
    )


E8 = {"e": 0.8, "threshold": 0.01}
bounce("bounce_e08_max_vel", "restitution 0.8 and max_vel 1000 on both", {**E8, "max_vel": 1000}, {**E8, "max_vel": 1000}, 0.64)
bounce("bounce_e08", "restitution 0.8 on both, max_vel left at 0.01", E8, E8, 0.64)
bounce(
    "bounce_e05",
    "restitution 0.5 on both, max_vel 1000",
    {"e": 0.5, "threshold": 0.01, "max_vel": 1000},
    {"e": 0.5, "threshold": 0.01, "max_vel": 1000},
    0.25,
)
bounce(
    "bounce_e03",
    "restitution 0.3 on both, max_vel 1000",
    {"e": 0.3, "threshold": 0.01, "max_vel": 1000},
    {"e": 0.3, "threshold": 0.01, "max_vel": 1000},
    0.09,
)
bounce(
    "bounce_e1",
    "restitution 1 on both, max_vel 1000",
    {"e": 1.0, "threshold": 0.01, "max_vel": 1000},
    {"e": 1.0, "threshold": 0.01, "max_vel": 1000},
    1.0,
)
bounce(
    "bounce_e08_on_e05",
    "restitution 0.8 on 0.5, max_vel 1000: the smaller counts",
    {**E8, "max_vel": 1000},
    {"e": 0.5, "threshold": 0.01, "max_vel": 1000},
    0.25,
)
bounce("bounce_e08_on_e0", "restitution 0.8 on a plate without", {**E8, "max_vel": 1000}, {}, 0.0)
bounce("bounce_e0_on_e08", "a ball without restitution on 0.8", {}, {**E8, "max_vel": 1000}, 0.0)
bounce(
    "bounce_threshold",
    "restitution 0.8, threshold of the plate left at its default of 100 000 m/s",
    {**E8, "max_vel": 1000},
    {"e": 0.8, "max_vel": 1000},
    words="the smaller threshold counts",
    law=0.64,
)
for value, side in ((0.01, "plate"), (1000, "ball"), (1000, "both"), (1.0, "ball"), (0.1, "ball")):
    on_ball, on_plate = (
        ({"max_vel": value} if side in ("ball", "both") else {}),
        ({"max_vel": 1000 if side == "plate" else value} if side in ("plate", "both") else {}),
    )
    bounce(
        f"max_vel_{f'{value:g}'.replace('.', '')}_{side}",
        f"no restitution; max_vel {on_ball.get('max_vel', 'default')} of the ball, {on_plate.get('max_vel', 'default')} of the plate",
        on_ball,
        on_plate,
        0.0,
        "a ball without restitution stays; Gazebo throws it out of its overlap by up to the ball's max_vel",
    )


def sunk(name, what, law, body, plate, value=None, height=0.0, times=(0.01, 0.1, 0.5, 2.4), default=(5e-2, 2e-4), gazebo=(2e-3, 2e-5)):
    return drop(
        name,
        what,
        law,
        body,
        plate,
        tuple(
            Row(
                f"height over the plate at {t:g} s, m",
                lambda r, t=t: r.at("model:b", "z", t) - 1.2,
                law=value if t > 1 else None,
                gazebo=gazebo,
                default=default if t > 1 else (9, 9),
            )
            for t in times
        ),
        height,
        "box",
        every=0.01,
    )


sunk("kp_1e4", "cube, kp 1e4, kd 1", "sinks m g/(4 kp) = 0.245 mm on four points", {"kp": 1e4, "kd": 1}, {}, -G / 4e4)
sunk("kp_1e4_both", "cube and plate, kp 1e4, kd 1: softnesses add", "sinks 0.49 mm", {"kp": 1e4, "kd": 1}, {"kp": 1e4, "kd": 1}, -G / 2e4)
sunk("kp_1e5_kd100", "cube, kp 1e5, kd 100", "sinks 0.0245 mm", {"kp": 1e5, "kd": 100}, {}, -G / 4e5)
sunk("kp_1e6_kd100_drop", "the same with kp 1e6, dropped by 0.2 m", "lands and stays", {"kp": 1e6, "kd": 100}, {}, 0.0, 0.2)
sunk("kp_1e3_kd10", "cube, kp 1e3, kd 10: a soft foot", "sinks 2.45 mm", {"kp": 1e3, "kd": 10}, {}, -G / 4e3)
sunk("soft_cfm", "cube, soft_cfm 0.001", "gives way by cfm F h for each point", {"soft_cfm": 0.001}, {})
sunk("soft_erp", "cube, soft_erp 0.5, dropped by 0.1 m", "overlap goes by half in each step", {"soft_erp": 0.5}, {}, None, 0.1)
sunk(
    "min_depth_cube",
    "cube 2 mm deep, its min_depth 5 mm",
    "min_depth is the overlap that is left alone",
    {"min_depth": 0.005},
    {},
    None,
    -0.002,
)
sunk(
    "min_depth_plate",
    "cube 2 mm deep, the plate's min_depth 5 mm",
    "min_depth is the overlap that is left alone",
    {},
    {"min_depth": 0.005},
    None,
    -0.002,
)
sunk(
    "min_depth_both",
    "cube 2 mm deep, min_depth 5 mm of both",
    "stays 2 mm deep",
    {"min_depth": 0.005},
    {"min_depth": 0.005},
    -0.002,
    -0.002,
)
sunk("inside_5cm", "cube 5 cm deep in the plate", "comes out", {}, {}, 0.0, -0.05, default=(0, 1e-3))
sunk(
    "inside_5cm_max_vel",
    "the same with max_vel 1000: Gazebo throws it up by 94 m",
    "comes out",
    {"max_vel": 1000},
    {},
    0.0,
    -0.05,
    default=(0, 1e-3),
)
sunk("inside_5mm_max_vel_01", "cube 5 mm deep, max_vel 0.1", "comes out at 0.1 m/s", {"max_vel": 0.1}, {}, 0.0, -0.005)


# ---------------------------------------------------------------------------------------------------- torsional friction

TORSION = (
    "<coefficient>{c}</coefficient><use_patch_radius>{use}</use_patch_radius><patch_radius>0.05</patch_radius>"
    "<surface_radius>0.1</surface_radius><ode><slip>0</slip></ode>"
)
for radius in (1, 0):
    contact(
        f"torsional_{'patch' if radius else 'surface'}",
        f"ball spinning at 20 rad/s about the vertical, torsional coefficient 0.5, "
        f"{'patch_radius 0.05' if radius else 'surface_radius 0.1'}",
        "moment 3 pi/16 c r N; Gazebo's r is the patch's radius, or sqrt(surface_radius depth)",
        ball("ball", 0.1, 1, "0 0 0.1 0 0 0", surface(1.0, torsional=TORSION.format(c=0.5, use=radius))),
        (
            Row("spin at 0.1 s, rad/s", lambda r: r.at("model:ball", "wz", 0.1), gazebo=(5e-3, 1e-3), default=(2e-2, 1e-2)),
            Row("spin at 0.3 s, rad/s", lambda r: r.at("model:ball", "wz", 0.3), gazebo=(5e-3, 1e-3), default=(2e-2, 1e-2)),
            Row("spin at 0.8 s, rad/s", lambda r: r.at("model:ball", "wz", 0.8), gazebo=(5e-3, 1e-3), default=(2e-2, 1e-2)),
        ),
        1.0,
        [Deed("twist", "ball", "0 0 0 0 0 20")],
    )


def spins(law):
    return tuple(
        Row(f"spin at {t} s, rad/s", lambda r, t=t: r.at("model:b", "wz", t), law=law(t), gazebo=(2e-3, 1e-3), default=(1e-2, 1e-2))
        for t in (0.1, 0.25)
    )


HERTZ = 3 * math.pi / 16


PATCH = "<coefficient>{c}</coefficient><patch_radius>{r}</patch_radius><ode><slip>{slip}</slip></ode>"
contact(
    "torsional_slip",
    "ball spinning at 20 rad/s, coefficient 0.5, patch_radius 0.05, slip 200 rad/s per N m",
    "moment of w / slip, as it is less than the friction",
    ball("b", 0.1, 1, "0 0 0.1 0 0 0", surface(1.0, torsional=PATCH.format(c=0.5, r=0.05, slip=200))),
    spins(lambda t: 20 * math.exp(-t / (200 * 0.004))),
    0.6,
    [Deed("twist", "b", "0 0 0 0 0 20")],
)
contact(
    "torsional_two_surfaces",
    "ball (coefficient 0.5, patch_radius 0.02, slip 100) on a plate (0.3, 0.05, 50)",
    "the smaller coefficient, the larger patch, the sum of the slips",
    (
        model(
            "plate",
            link("l", collision("<box><size>2 2 0.2</size></box>", surface(1.0, torsional=PATCH.format(c=0.3, r=0.05, slip=50)))),
            pose="0 0 1 0 0 0",
            static=True,
        ),
        ball("b", 0.1, 1, "0 0 1.2 0 0 0", surface(1.0, torsional=PATCH.format(c=0.5, r=0.02, slip=100))),
    ),
    spins(lambda t: 20 - HERTZ * 0.3 * 0.05 * 9.8 / 0.004 * t),
    0.6,
    [Deed("twist", "b", "0 0 0 0 0 20")],
)
contact(
    "torsional_box",
    "box on four corners without other friction, coefficient 0.5, patch_radius 0.05",
    "moment 3 pi/16 c r N of the whole weight",
    cube("b", 0.2, 1, "0 0 0.1 0 0 0", surface(0, torsional=PATCH.format(c=0.5, r=0.05, slip=0))),
    spins(lambda t: 8 - HERTZ * 0.5 * 0.05 * 9.8 / (0.2**2 / 6) * t),
    0.6,
    [Deed("twist", "b", "0 0 0 0 0 8")],
)
contact(
    "torsional_without_a_patch",
    "ball with a coefficient of 2 and no radius",
    "touches in a point: spins on",
    ball("b", 0.1, 1, "0 0 0.1 0 0 0", surface(1.0, torsional="<coefficient>2</coefficient>")),
    spins(lambda t: 20.0),
    0.4,
    [Deed("twist", "b", "0 0 0 0 0 20")],
)
