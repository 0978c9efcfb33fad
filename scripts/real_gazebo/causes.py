"""Why a solver is not within its tolerance: the rows that are off today, each with the cause in words.

The tests expect exactly these to fail (strictly), so that whoever mends one has to take it out here.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Tuple


@dataclass(frozen=True)
class Cause:
    """:param quantities: of the rows of that scene; none: all of them."""

    solver: str
    scene: str
    why: str
    quantities: Tuple[str, ...] = ()


def of(solver: str, why: str, *rows) -> Tuple[Cause, ...]:
    """:param rows: names of scenes, or (scene, quantity, ...)."""
    return tuple(Cause(solver, row, why) if isinstance(row, str) else Cause(solver, row[0], why, tuple(row[1:])) for row in rows)


SCREW = "screw and gearbox joints are left out here, in a line of World.problems: their links are free"
FINITE = "ODE turns a body by 2 atan(w h/2) in a step, here it turns by w h: real Gazebo lags by (w h)^3/12 in each"
TORSION = "torsional friction is not simulated here: a ball spins on"
WORLD_AXIS = (
    "of a joint on the world, real Gazebo takes an axis `in the model's frame` in the frame of the world; here it is turned with the model"
)
AXIS_ROWS = tuple(f"{c} of the axis of joint p::j1" for c in "xyz") + tuple(f"p::{j} at {t} s" for j in ("j1", "j2") for t in (0.3, 0.6))
STATE = "real Gazebo 11.1 leaves models where their own <pose> says; here the <state> counts, as the format says"
HINGE2 = "ODE's hinge-2 needs two bodies: bolted to the world, real Gazebo's wheel neither steers nor turns; here it does"
STATE_ROWS = ("x of link c::l", "z of link c::l", "qz of link c::l", "qw of link c::l", "c moved along x in 1 s, m", "c turned in 1 s, rad")
TORSION_ROWS = tuple(f"spin at {t} s, rad/s" for t in (0.1, 0.3, 0.8))
ORDER = "chaotic: which way it slides follows from the order in which quickStep takes its rows; the order here is not the same in all"
FALLS = "worse since contacts are taken in Gazebo's order: the pile falls after 1.4 s here, and stands in real Gazebo; not traced"
HEAVY = "worse since contacts are taken in Gazebo's order: it does not rest as in real Gazebo; not traced"
BALL = "a body that swings about two axes on a ball joint gains energy here, 0.2 of 2.8 J in 1.8 s; not traced"
BALL_ROWS = (
    *(f"{c} of the rod's frame at 0.5 s" for c in ("qx", "wx", "wy")),
    *(f"{c} of the rod's frame at 1 s" for c in ("qy", "wx", "wy")),
    *(f"{c} of the rod's frame at 2 s" for c in ("qx", "qy", "wx", "wy")),
    "energy gained from 0.2 to 2 s, J of 2.8",
)
RESET = "resetting the models' poses (reset_world) brings real Gazebo's joints back to their first angles; here they stay where they are"
BOTH = (
    (RESET, ("reset_poses", "p::j1 at 0.52 s", "p::j1 at 0.8 s")),
    (
        "real Gazebo tells the second axis of a revolute2 with the other sign, and wraps it at pi",
        ("revolute2_on_base", *(f"w::j1, axis 1, at {t} s" for t in ("0.5", "1", "2"))),
    ),
    (SCREW, "screw_falls", "screw_driven", "gearbox"),
    (TORSION, ("torsional_patch", *TORSION_ROWS)),
    (HINGE2, "revolute2_wheel"),
    (WORLD_AXIS, *((scene, *AXIS_ROWS) for scene in ("sdf_13", "sdf_14", "sdf_16_parent_model_frame"))),
    (STATE, ("state", *STATE_ROWS)),
)
CAUSES: Tuple[Cause, ...] = (
    *(cause for solver in ("gazebo", "default") for why, *rows in BOTH for cause in of(solver, why, *rows)),
    *of(
        "gazebo",
        FINITE,
        ("revolute_big_step", "p::j1 at 1 s", "p::j1 at 2 s", "p::j1 at 4.9 s"),
        ("revolute_spring_hard", "p::j1 at 0.05 s", "p::j1 at 0.1 s"),
        ("continuous_many_turns", "w::j1 at 4.9 s"),
    ),
    *of(
        "default",
        "a spring is taken at the speed that the step arrives at: a swing as fast as the step is damped",
        ("revolute_spring_hard", "p::j1 at 0.02 s", "p::j1 at 0.1 s"),
    ),
    *of("default", BALL, ("ball_pendulum", *BALL_ROWS)),
    *of("gazebo", ORDER, "skid_turn"),
    *of("gazebo", FALLS, "stack_10"),
    *of("gazebo", HEAVY, "heavy_10_on_light"),
)

# Recorded, and not yet run beside real Gazebo: neither the tests nor a cause say anything of them.
NOT_COMPARED: Tuple[str, ...] = (
    "heightmap_ramp",
    "heightmap_bowl",
    "stack_10_loose",
    "stack_10_many_iterations",
    "wall_5x5",
    "wall_8x4",
    "wall_hit",
    "pyramid_4",
    "heap_of_balls",
    "table_loaded",
    "hundred_boxes",
    "skid_turn_sphere",
    "skid_turn_mesh",
    "casters_rigid",
    "caster_swivels",
    "caster_turn",
    "mecanum_ahead",
    "mecanum_aside",
    "mecanum_turn",
    "car_turns",
    "holonomic_fdir1",
    "parked_on_slope",
    "wheel_over_step",
    "motor_stalls",
    "grip_holds",
    "grip_holds_heavy",
    "grip_slips",
    "grip_holds_ball",
    "grip_holds_can",
    "grip_hard",
    "ray_room",
    "ray_vertical",
    "ray_shapes",
    "imu_rest",
    "imu_pendulum",
    "imu_pendulum_custom",
    "imu_falling",
    "force_torque_child_parent_to_child",
    "force_torque_parent_parent_to_child",
    "force_torque_sensor_parent_to_child",
    "force_torque_child_child_to_parent",
    "force_torque_parent_child_to_parent",
    "force_torque_sensor_child_to_parent",
    "force_torque_default",
    "force_torque_revolute",
    "gps_heading_0",
    "gps_heading_90",
    "altimeter",
    "magnetometer",
    "sonar_06",
    "sonar_5",
    "logical_camera",
    "contact_box",
    "contact_two",
    "world_contacts",
    "world_contacts2",
    "world_pendula",
)


def cause_of(solver: str, scene: str, quantity: str) -> str:
    """Empty where the row is expected to hold."""
    return next((c.why for c in CAUSES if c.solver == solver and c.scene == scene and (not c.quantities or quantity in c.quantities)), "")
