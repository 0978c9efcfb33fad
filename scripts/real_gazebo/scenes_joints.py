"""Joints: every type, with damping, friction, springs and stops; what they bear; loops."""

import math

from real_gazebo.scene import Deed, Row, Scene, add
from real_gazebo.sdf import axis, ground, inertial, joint, link, model, world

G = 9.8
FREE = (1e-4, 2e-5)
# What is integrated over thousands of steps by two solvers that differ in the last digits of each.
CLOSE = (1e-3, 2e-4)
NO_CONTACT = "one equation of motion, no contact: both solvers integrate it alike"


def bar(name="a", pose="", tilt=1.0):
    """A rod of 1 kg and 0.5 m that hangs from its frame's origin."""
    return link(name, inertial(1, (0.0208333333, 0.0208333333, 0.0002), "0 0 -0.25 0 0 0"), pose=pose or f"0 0 0 0 {tilt} 0")


def pendulum(name, y, *parts, tilt=1.0, kind="revolute", **dynamics):
    limits = {k: dynamics.pop(k) for k in ("lower", "upper", "limit") if k in dynamics}
    return model(name, bar(tilt=tilt), joint("j1", kind, "world", "a", axis("0 1 0", **limits, **dynamics), *parts), pose=f"0 {y} 3 0 0 0")


def angles(name, times=(0.5, 1.0, 2.0, 4.9), near=FREE, default=CLOSE, axis=0):
    return tuple(
        Row(
            f"{name}, axis {axis}, at {t:g} s" if axis else f"{name} at {t:g} s",
            lambda r, t=t: r.angle(name, t, axis),
            gazebo=near,
            default=default,
        )
        for t in times
    )


def rates(name, times, near=FREE, default=CLOSE, axis=0):
    return tuple(Row(f"rate of {name} at {t:g} s", lambda r, t=t: r.rate(name, t, axis), gazebo=near, default=default) for t in times)


def one(name, what, law, body, rows, seconds=5.0, deeds=(), **settings):
    extra = {k: settings.pop(k) for k in ("physics", "gravity", "step") if k in settings}
    return add(Scene(name, "joints", what, law, world(ground(), body, **extra), rows, seconds, deeds=tuple(deeds), **settings))


# ---------------------------------------------------------------------------------------------------- revolute


def swing(t):
    """Of the rod (J = 1/12) on the spring below, its weight left out, rad."""
    fast = math.sqrt(2000 * 12 - 36)
    return 0.5 - 0.5 * math.exp(-6 * t) * (math.cos(fast * t) + 6 / fast * math.sin(fast * t))


one(
    "revolute_free",
    "rod released at 1 rad",
    "energy is kept: J/2 w^2 - m g l/2 cos(angle)",
    pendulum("p", 0),
    angles("p::j1")
    + (
        Row(
            "energy gained in 4.9 s, J",
            lambda r: 0.5 * (1 / 12) * r.rate("p::j1", 4.9) ** 2 - 2.45 * math.cos(1 + r.angle("p::j1", 4.9)) + 2.45 * math.cos(1),
            law=0.0,
            gazebo=(0, 1e-4),
            default=(0, 2e-3),
        ),
    ),
)
one("revolute_damped", "the same, damping 0.05 N m s/rad", NO_CONTACT, pendulum("p", 0, damping=0.05), angles("p::j1"))
one(
    "revolute_damped_hard", "damping 5, far more than the step bears explicitly", NO_CONTACT, pendulum("p", 0, damping=5.0), angles("p::j1")
)
one(
    "revolute_friction",
    "joint friction 0.2 N m",
    "rests where m g l/2 sin(angle) is below 0.2",
    pendulum("p", 0, friction=0.2),
    angles("p::j1", default=(2e-3, 2e-3)),
)
one(
    "revolute_spring",
    "spring 20 N m/rad towards 0.5, damping 0.1",
    NO_CONTACT,
    pendulum("p", 0, tilt=0.0, damping=0.1, spring_reference=0.5, spring_stiffness=20),
    angles("p::j1"),
)
one(
    "revolute_spring_hard",
    "spring 2000 N m/rad towards 0.5, damping 1",
    "a damped swing of 155 rad/s: 0.5 - 0.5 exp(-6 t) (cos(wd t) + 6/wd sin(wd t))",
    pendulum("p", 0, tilt=0.0, damping=1.0, spring_reference=0.5, spring_stiffness=2000),
    tuple(
        Row(f"p::j1 at {t:g} s", lambda r, t=t: r.angle("p::j1", t), law=swing(t), gazebo=(1e-4, 2e-5), default=(5e-2, 0))
        for t in (0.02, 0.05, 0.1, 0.5, 2.0)
    ),
    2.2,
)
one(
    "revolute_stop",
    "falls against its stop at -0.5",
    "no bounce: stops give way by Gazebo's erp and cfm",
    pendulum("p", 0, tilt=1.2, lower=-0.5, upper=0.3),
    angles("p::j1", (0.2, 0.5, 1.0, 2.0, 4.9))
    + (
        Row(
            "furthest beyond the stop, rad", lambda r: float(r.angles("p::j1").min()) + 0.5, law=0.0, gazebo=(0.02, 2e-5), default=(0, 1e-3)
        ),
    ),
)
one(
    "revolute_stop_soft",
    "stop with stiffness 50 and dissipation 2 in <limit>",
    "Gazebo 11 keeps these numbers for `implicit_spring_damper`",
    pendulum("p", 0, tilt=1.2, lower=-0.5, upper=0.3, limit="<stiffness>50</stiffness><dissipation>2</dissipation>"),
    angles("p::j1", (0.2, 0.5, 1.0, 2.0)),
    2.5,
)
one(
    "revolute_stop_erp",
    "stop with erp 0.1 and cfm 0.1 in <physics><ode><limit>",
    "a stop as a damped spring: k = erp / (h cfm)",
    pendulum("p", 0, "<physics><ode><limit><erp>0.1</erp><cfm>0.1</cfm></limit></ode></physics>", tilt=1.2, lower=-0.5, upper=0.3),
    angles("p::j1", (0.2, 0.5, 1.0, 2.0)),
    2.5,
)
one(
    "revolute_effort_limit",
    "pushed with 5 N m, effort limit 1",
    "the limit cuts SetForce: angle and rate of 1 N m",
    pendulum("p", 0, tilt=0.0, limit="<effort>1</effort>"),
    angles("p::j1", (0.5, 1.0, 2.0)),
    2.5,
    (Deed("effort", "p::j1", "5"),),
)
one(
    "revolute_velocity_limit",
    "pushed with 5 N m, velocity limit 1 rad/s",
    "above the limit SetForce pushes no further",
    pendulum("p", 0, tilt=0.0, limit="<velocity>1</velocity>"),
    angles("p::j1", (0.3, 0.6, 1.0, 2.0)) + rates("p::j1", (0.6, 1.0)),
    2.5,
    (Deed("effort", "p::j1", "5"),),
)
one(
    "revolute_motor",
    "motor: 1 rad/s, 10 N m",
    "the angle grows by 1 rad/s",
    pendulum("p", 0, tilt=0.0),
    angles("p::j1", (0.5, 1.0, 2.0)) + (Row("rate at 1.5 s", lambda r: r.rate("p::j1", 1.5), law=1.0),),
    2.2,
    (Deed("motor", "p::j1", "1 10"),),
)
one(
    "revolute_motor_weak",
    "motor: 1 rad/s, 1 N m, against 2.45 N m of weight",
    "held where m g l/2 sin(angle) = 1 N m: 0.4204 rad",
    pendulum("p", 0, tilt=0.0, damping=0.05),
    angles("p::j1", (0.5, 1.0, 4.9)),
    5,
    (Deed("motor", "p::j1", "1 1"),),
)
one(
    "revolute_pd",
    "PD by effort: to 0.8, P 200, D 10",
    NO_CONTACT,
    pendulum("p", 0, tilt=0.0),
    angles("p::j1", (0.05, 0.1, 0.3, 1.0)),
    1.5,
    (Deed("pd", "p::j1", "0.8 200 10"),),
)
one(
    "revolute_set_velocity",
    "SetVelocity 0.5 in each step",
    "the angle grows by 0.5 rad/s",
    pendulum("p", 0, tilt=0.0),
    angles("p::j1", (0.5, 1.0)),
    1.2,
    (Deed("velocity", "p::j1", "0.5"),),
)
one(
    "revolute_set_position",
    "SetPosition 0.6 after 0.5 s, then free",
    "moved at once, speed kept by Gazebo",
    pendulum("p", 0, tilt=0.0),
    angles("p::j1", (0.49, 0.52, 1.0, 1.5)),
    1.7,
    (Deed("position", "p::j1", "0.6", 0.5),),
)
one(
    "revolute_big_step",
    "rod released at 1 rad, step of 10 ms",
    "as at 1 ms; a step of 10 ms is 0.03 rad off",
    pendulum("p", 0),
    tuple(
        Row(f"p::j1 at {t:g} s", lambda r, t=t: r.angle("p::j1", t), law=fine, gazebo=FREE, default=(0, 0.03))
        for t, fine in ((0.5, -1.8330), (1.0, -0.6267), (2.0, -1.7409), (4.9, -0.0220))
    ),
    step=0.01,
)
one(
    "double_pendulum",
    "two rods",
    "regular for the first seconds, then chaotic",
    model(
        "p",
        bar(),
        bar("b", f"{-0.5 * math.sin(1):.12g} 0 {-0.5 * math.cos(1):.12g} 0 1.5 0"),
        joint("j1", "revolute", "world", "a", axis("0 1 0")),
        joint("j2", "revolute", "a", "b", axis("0 1 0")),
        pose="0 0 3 0 0 0",
    ),
    angles("p::j1", default=(5e-3, 1e-2)) + angles("p::j2", default=(5e-3, 6e-2)),
)
one(
    "revolute_axis_of_child",
    "axis in the child's frame, which is yawed by 1 rad, at an offset",
    "the axis turns with the child unless use_parent_model_frame is set",
    model(
        "p",
        link("a", inertial(1, 0.02, "0 0 -0.25 0 0 0"), pose="0.2 0.1 0 0.4 0 1"),
        joint("j1", "revolute", "world", "a", axis("0.6 0.8 0", of_model=False), pose="0.1 0 0.2 0 0 0.3"),
        pose="0 0 3 0 0 0.5",
    ),
    angles("p::j1", (0.5, 1.0, 2.0)),
    2.2,
)

# ---------------------------------------------------------------------------------------------------- prismatic, continuous


def slider(direction, *parts, kind="prismatic", **dynamics):
    limits = {k: dynamics.pop(k) for k in ("lower", "upper", "limit") if k in dynamics}
    return model(
        "s",
        link("a", inertial(2, 0.02)),
        joint("j1", kind, "world", "a", axis(direction, **limits, **dynamics), *parts),
        pose="0 0 3 0 0 0",
    )


one(
    "prismatic_damped",
    "2 kg on a vertical rail, damping 4 N s/m",
    "v = m g/c (1 - exp(-c t/m)) = 4.237 m/s after 1 s",
    slider("0 0 1", damping=4.0),
    angles("s::j1", (0.5, 1.0))
    + (Row("speed at 1 s, m/s", lambda r: -r.rate("s::j1", 1.0), law=4.9 * (1 - math.exp(-2.0)), default=(2e-3, 0)),),
    1.2,
)
one(
    "prismatic_friction",
    "2 kg on a rail at 30 deg, friction 4 N",
    "a = g/2 - 2 = 2.9 m/s^2",
    slider("0.866025404 0 -0.5", friction=4.0),
    angles("s::j1", (0.5, 1.0)) + (Row("acceleration", lambda r: r.rate("s::j1", 1.0), law=2.9),),
    1.2,
)
one(
    "prismatic_spring",
    "2 kg on a spring of 200 N/m",
    "swings round m g/k = 0.098 m with 10 rad/s",
    slider("0 0 1", spring_reference=0, spring_stiffness=200),
    angles("s::j1", (0.1, 0.314159, 1.0, 2.0)),
    2.2,
)
one(
    "prismatic_stop",
    "2 kg falls 0.5 m to the stop of its rail",
    "stands on the stop",
    slider("0 0 1", lower=-0.5, upper=0.5),
    angles("s::j1", (0.2, 0.31, 0.33, 0.5, 2.0), default=(1e-3, 2e-3)),
    2.2,
)
one(
    "prismatic_motor",
    "motor: 0.2 m/s, 100 N, upwards",
    "0.2 m/s",
    slider("0 0 1"),
    angles("s::j1", (0.5, 1.0, 2.0)),
    2.2,
    (Deed("motor", "s::j1", "0.2 100"),),
)
one(
    "prismatic_push",
    "10 N along a level rail for 1 s",
    "5 m/s, 2.5 m",
    slider("1 0 0"),
    angles("s::j1", (0.5, 1.0, 1.5)) + (Row("speed at 1.2 s, m/s", lambda r: r.rate("s::j1", 1.2), law=5.0),),
    1.7,
    (Deed("effort", "s::j1", "10", 0, 1.0),),
)
one(
    "continuous_many_turns",
    "wheel on a fixed axle, 0.1 N m for 3 s, damping 0.001",
    "angle past many turns, not wrapped",
    model(
        "w",
        link("a", inertial(1, (0.003, 0.005, 0.003))),
        joint("j1", "revolute", "world", "a", axis("0 1 0", damping=0.001)),
        pose="0 0 2 0 0 0",
    ),
    angles("w::j1", (1.0, 3.0, 4.9)) + rates("w::j1", (1.0, 3.0, 4.9)),
    deeds=(Deed("effort", "w::j1", "0.1", 0, 3.0),),
)
