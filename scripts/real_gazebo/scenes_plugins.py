"""Plugins that come with Gazebo itself: lift and drag, buoyancy, wind, first velocities, batteries, motors, drives."""

from __future__ import annotations

import math

from real_gazebo.scene import Deed, Row, Scene, add
from real_gazebo.scenes_robots import differential, skid, turned
from real_gazebo.sdf import axis, box, collision, ground, inertial, joint, link, model, sphere, world

NEAR = (1e-4, 1e-5)


def plugin(kind: str, elements: str = "") -> str:
    return f"<plugin name='{kind}' filename='lib{kind}Plugin.so'>{elements}</plugin>"


def thrown(linear: str = "0 0 0", angular: str = "") -> str:
    return plugin("InitialVelocity", f"<linear>{linear}</linear>" + (f"<angular>{angular}</angular>" if angular else ""))


def rows(body: str, *wanted, default=NEAR):
    return tuple(
        Row(f"{c} of {body} at {t:g} s", lambda r, c=c, t=t: r.at(f"model:{body}", c, t), gazebo=NEAR, default=default) for c, t in wanted
    )


def scene(name: str, what: str, law: str, text: str, measured, seconds: float = 1.0, deeds=()) -> Scene:
    return add(Scene(name, "plugins", what, law, text, measured, seconds, 0.05, deeds, server=True))


def wing(name: str, elements: str, first: str, pose: str, more: str = "", centre: str = "0.05 0 0.02 0 0 0") -> str:
    """A light body with a wing that is thrown; its centre of mass is not its origin."""
    lift = plugin("LiftDrag", f"<link_name>l</link_name><air_density>1.2</air_density><area>0.2</area>{elements}")
    return model(name, link("l", inertial(1.5, (0.05, 0.06, 0.07), centre)), more, lift, first, pose=pose)


PROFILE = "<a0>0.05</a0><cla>4.75</cla><cda>0.64</cda><cma>-1.8</cma><alpha_stall>0.34</alpha_stall>"
STALLED = "<cla_stall>-3.85</cla_stall><cda_stall>-0.92</cda_stall><cma_stall>0</cma_stall>"
ALONG = (("x", 0.5), ("z", 0.5), ("x", 1.0), ("z", 1.0))

scene(
    "lift_glides",
    "LiftDragPlugin: a wing thrown ahead, a little nose up",
    "lift and drag of the angle of attack",
    world(wing("b", PROFILE + "<cp>0.02 0 0</cp>", thrown("12 0 0"), "0 0 50 0 -0.1 0")),
    rows("b", *ALONG),
)
scene(
    "lift_stalls",
    "LiftDragPlugin: the same far beyond its stall, falling flat",
    "coefficients beyond the stall",
    world(wing("b", PROFILE + STALLED, thrown("4 0 -3", "0 0.3 0"), "0 0 50 0 0 0")),
    rows("b", *ALONG),
)
scene(
    "lift_backwards",
    "LiftDragPlugin: the same thrown backwards",
    "what the wind from behind does",
    world(wing("b", PROFILE, thrown("-8 0 0"), "0 0 50 0 0.1 0")),
    rows("b", *ALONG),
)
scene(
    "lift_sideslip",
    "LiftDragPlugin: a swept wing that slips to the side, forward and upward not unit vectors, centre of pressure aside",
    "the velocity in the plane of lift and drag",
    world(
        wing(
            "b",
            PROFILE + "<cp>-0.1 0.3 0.05</cp><forward>2 0.4 0</forward><upward>0 0 3</upward>",
            thrown("9 4 -1"),
            "0 0 50 0.1 -0.05 0.3",
        )
    ),
    rows("b", ("x", 0.5), ("y", 0.5), ("z", 0.5), ("x", 1.0), ("y", 1.0), ("z", 1.0)),
)
scene(
    "lift_radial",
    "LiftDragPlugin: radial_symmetry, a missile's fins",
    "upward is across the flow",
    world(wing("b", PROFILE + "<radial_symmetry>true</radial_symmetry>", thrown("10 2 -2"), "0 0 50 0 0 0")),
    rows("b", ("x", 0.5), ("y", 0.5), ("z", 0.5), ("y", 1.0), ("z", 1.0)),
)
FLAP = joint("flap", "revolute", "l", "f", "<axis><xyz>0 1 0</xyz><limit><lower>0.2</lower><upper>0.2</upper></limit></axis>")
scene(
    "lift_control_joint",
    "LiftDragPlugin: a flap at 0.2 rad",
    "the flap's angle adds to the coefficient of lift",
    world(
        wing(
            "b",
            PROFILE + "<control_joint_name>flap</control_joint_name><control_joint_rad_to_cl>-1.5</control_joint_rad_to_cl>",
            thrown("12 0 0"),
            "0 0 50 0 0 0",
            link("f", inertial(0.01, 0.001), pose="-0.2 0 0 0 0 0") + FLAP,
        )
    ),
    rows("b", *ALONG, default=(1e-3, 1e-4)),  # the flap comes to its stops at another speed
)
scene(
    "buoyancy_of_shapes",
    "BuoyancyPlugin: the volumes of a ball and a box of one link, in water",
    "Archimedes, at the middle of the volumes",
    world(
        model(
            "b",
            link(
                "l",
                inertial(9, 0.2),
                collision(sphere(0.1), pose="0.2 0 0 0 0 0", name="s"),
                collision(box(0.1, 0.2, 0.3), pose="0 0 0.1 0 0 0.4", name="q"),
            ),
            plugin("Buoyancy", "<fluid_density>1000</fluid_density>"),
            pose="0 0 50 0 0 0",
        )
    ),
    rows("b", ("z", 0.4), ("qy", 0.4), ("z", 1.0)),
)
scene(
    "buoyancy_told",
    "BuoyancyPlugin: volume and middle as told, density of sea water by default",
    "Archimedes",
    world(
        model(
            "b",
            link("l", inertial(5, 0.2), collision(sphere(0.1))),
            plugin("Buoyancy", "<link name='l'><center_of_volume>0.01 0 0.05</center_of_volume><volume>0.0055</volume></link>"),
            pose="0 0 50 0.1 0 0",
        )
    ),
    rows("b", ("z", 0.4), ("qx", 0.4), ("qy", 0.4), ("z", 1.0)),
)
WIND = "<wind><linear_velocity>3 1 0</linear_velocity></wind>"
AIRY = model(
    "b",
    "<enable_wind>true</enable_wind>",
    link("l", "<gravity>0</gravity>", inertial(2, 0.1), collision(box(0.2, 0.2, 0.2))),
    pose="0 0 5 0 0 0.7",
)
STILL = model("c", link("l", "<gravity>0</gravity>", inertial(2, 0.1), collision(box(0.2, 0.2, 0.2))), pose="3 0 5 0 0 0")
scene(
    "wind_steady",
    "WindPlugin without settings: the wind rises in a second, and only who has <enable_wind> feels it",
    "mass times the wind past it",
    world(AIRY, STILL, extra=WIND + plugin("Wind", "<force_approximation_scaling_factor>1.0</force_approximation_scaling_factor>")),
    rows("b", ("x", 0.5), ("y", 0.5), ("z", 0.5), ("x", 2.0), ("y", 2.0), ("z", 2.0)) + rows("c", ("x", 2.0)),
    2.0,
)
GUSTS = (
    "<force_approximation_scaling_factor>0.8</force_approximation_scaling_factor><horizontal><magnitude><time_for_rise>0.5</time_for_rise><sin><amplitude_percent>0.3</amplitude_percent><period>1.5</period></sin>"
    "</magnitude><direction><time_for_rise>2</time_for_rise><sin><amplitude>20</amplitude><period>0.8</period></sin></direction></horizontal>"
)
scene(
    "wind_gusts",
    "WindPlugin: magnitude and direction rise and swing, two links feel it",
    "the rise counts at each link's question",
    world(
        AIRY,
        model("d", "<enable_wind>true</enable_wind>", link("l", "<gravity>0</gravity>", inertial(2, 0.1)), pose="6 0 5 0 0 0"),
        extra=WIND + plugin("Wind", GUSTS),
    ),
    rows("b", ("x", 0.5), ("y", 0.5), ("x", 2.0), ("y", 2.0)) + rows("d", ("x", 2.0), ("y", 2.0)),
    2.0,
)
scene(
    "wind_without_plugin",
    "<wind> and <enable_wind> without the plugin",
    "nothing is blown",
    world(AIRY, extra=WIND),
    rows("b", ("x", 1.0), ("y", 1.0)),
)
scene(
    "velocity_initial",
    "InitialVelocityPlugin: two links, linear and angular",
    "every link gets both",
    world(
        model(
            "b",
            link("l", "<gravity>0</gravity>", inertial(1, 0.1, "0.1 0 0 0 0 0")),
            link("m", "<gravity>0</gravity>", inertial(1, 0.1), pose="0.5 0 0 0 0 0"),
            thrown("1 2 3", "0 0 1"),
            pose="0 0 5 0 0 0",
        )
    ),
    rows("b", ("x", 0.5), ("y", 0.5), ("z", 0.5), ("qz", 0.5)),
)


def within(text: str, robot: str) -> str:
    """A model with one more element."""
    return robot.replace("</model>", text + "</model>")


scene(
    "drive_plugin",
    "DiffDrivePlugin: vel_cmd of 0.2 m/s and a yaw of 0.3",
    "the wheels' distance and the largest side of a wheel decide; a positive yaw turns to the right",
    world(
        ground(),
        within(plugin("DiffDrive", "<left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>"), differential("cylinder")),
    ),
    (
        Row(
            "way from 1 to 4 s, m", lambda r: r.way("model:r", 1, 4), law=4 / 3 * math.sin(0.45), gazebo=(1e-3, 1e-4), default=(0.01, 1e-3)
        ),
        turned(law=-0.9),
    ),
    4.2,
    (Deed("vel_cmd", "r", "0.2 0.3", 0.2),),
)
skid_names = skid("sphere")
for side in ("left", "right"):
    for end in ("front", "rear"):
        skid_names = skid_names.replace(f"'{side}{end}_joint'", f"'{side}_{end}'")
scene(
    "skid_plugin",
    "SkidSteerDrivePlugin: vel_cmd of 0.2 m/s and a yaw of 0.15",
    "the joints get their speeds once: what follows is friction and inertia",
    world(ground(), within(plugin("SkidSteerDrive"), skid_names), gravity="0 0 0"),
    tuple(
        Row(f"rate of {name} at {t:g} s, rad/s", lambda r, name=name, t=t: r.rate(f"r::{name}", t), gazebo=NEAR, default=NEAR)
        for name in ("left_front", "left_rear", "right_front", "right_rear")
        for t in (0.1, 0.5)
    ),
    1.0,
    (Deed("vel_cmd", "r", "0.2 0.15", 0.2),),
)
BATTERY = (
    "<link_name>l</link_name><battery_name>b</battery_name><open_circuit_voltage_constant_coef>12.694</open_circuit_voltage_constant_coef>"
    "<open_circuit_voltage_linear_coef>-3.1424</open_circuit_voltage_linear_coef><initial_charge>0.0110</initial_charge>"
    "<capacity>0.0120</capacity><resistance>0.061523</resistance><smooth_current_tau>1.9499</smooth_current_tau>"
)
CONSUMER = "<link_name>l</link_name><battery_name>b</battery_name><power_load>{}</power_load>"
powered = link("l", inertial(1, 0.1), "<gravity>0</gravity><battery name='b'><voltage>12.592</voltage></battery>")
scene(
    "battery_linear",
    "LinearBatteryPlugin with two consumers of 6.6 and 20 W; a battery that nobody empties",
    "u = e0 + e1 (1 - q / c) - r i",
    world(
        model(
            "m",
            powered,
            plugin("LinearBattery", BATTERY),
            plugin("LinearBatteryConsumer", CONSUMER.format(6.6)),
            plugin("LinearBatteryConsumer", CONSUMER.format(20)),
        ),
        model("n", powered, pose="5 0 0 0 0 0"),
    ),
    tuple(
        Row(f"voltage of {m} at {t:g} s, V", lambda r, m=m, t=t: r.voltage(f"{m}::l::b", t), gazebo=NEAR, default=NEAR)
        for m, t in (("m", 0.1), ("m", 1.0), ("m", 5.0), ("m", 12.0), ("n", 5.0))
    ),
    12.5,
)


def motor(name: str, kind: str, elements: str) -> str:
    told = f"<actuator><name>{name}</name><joint>j</joint><index>0</index><type>{kind}</type>{elements}</actuator>"
    return model(
        name,
        link("a", inertial(1, 0.1)),
        link("w", inertial(1, 0.1)),
        joint("fixed", "fixed", "world", "a"),
        joint("j", "revolute", "a", "w", axis("0 0 1")),
        plugin("Actuator", told),
        pose=f"0 {len(name)} 1 0 0 0",
    )


MOTORS = ("electric", "limiter", "none", "unlike_any")
scene(
    "actuator",
    "ActuatorPlugin: joints pushed with 3 N m, of motors of each kind",
    "the limit of the effort is what the speed leaves of the power",
    world(
        motor("electric", "electric_motor", "<power>2</power><max_velocity>3</max_velocity><max_torque>1</max_torque>"),
        motor("limiter", "velocity_limiter", "<max_velocity>3</max_velocity><max_torque>0.1</max_torque>"),
        motor("none", "null", ""),
        motor("unlike_any", "steam", "<max_torque>1</max_torque>"),
    ),
    tuple(
        Row(
            f"rate of {name} at {t:g} s, rad/s",
            lambda r, name=name, t=t: r.rate(f"{name}::j", t),
            gazebo=(1e-3, 1e-4),
            default=(1e-3, 1e-4),
        )
        for name in MOTORS
        for t in (0.1, 0.3, 0.6, 1.0)
    ),
    deeds=tuple(Deed("effort", f"{name}::j", "3") for name in MOTORS),
)
