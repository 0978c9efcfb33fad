"""Whole worlds of many bodies at once: what each of them does does not depend on the others."""

import math
import os

from real_gazebo.scene import Row, Scene, add

HERE = os.path.dirname(os.path.abspath(__file__))
G = 9.8


def text_of(name):
    with open(os.path.join(HERE, "worlds", name), encoding="utf-8") as file:
        return file.read()


def slides(name, law=None, gazebo=(5e-4, 0), default=(1e-3, 0)):
    return Row(
        f"acceleration of {name}, m/s^2", lambda r: r.acceleration(f"model:{name}", 0.5, 1.2), law=law, gazebo=gazebo, default=default
    )


def ways(name, law=0.0):
    return Row(
        f"way of {name} from 0.3 to 1.2 s, m", lambda r: r.way(f"model:{name}", 0.3, 1.2), law=law, gazebo=(0, 2e-3), default=(0, 1e-4)
    )


def high(name, time, law=None, gazebo=(2e-3, 5e-4), default=(5e-3, 1e-3)):
    return Row(f"z of {name} at {time:g} s, m", lambda r: r.at(f"model:{name}", "z", time), law=law, gazebo=gazebo, default=default)


def peak(name, radius, floor=0.0, law=None, drop=1.0):
    fall = math.sqrt(2 * drop / G)
    return Row(
        f"first peak of {name}, m",
        lambda r: r.highest(f"model:{name}", fall + 0.02, 3 * fall) - radius - floor,
        law=law,
        gazebo=(1e-3, 2e-4),
        default=(2e-2, 2e-3),
    )


def coulomb(degrees, mu):
    return G * (math.sin(math.radians(degrees)) - mu * math.cos(math.radians(degrees)))


add(
    Scene(
        "world_contacts",
        "worlds",
        "cubes on slopes, balls, stacks, a tumbling box in one world",
        "Coulomb, restitution, rolling: as in the single scenes",
        text_of("contacts.world"),
        (
            slides("box_20_0.3", coulomb(20, 0.3)),
            slides("box_30_0.3", coulomb(30, 0.3)),
            slides("box_15_0.2", coulomb(15, 0.2)),
            ways("box_20_0.5"),
            slides("box_25_0.3_diagonal", coulomb(25, 0.3), (2e-3, 0), (5e-3, 0)),
            slides("roll_20", 5 / 7 * G * math.sin(math.radians(20)), default=(2e-3, 0)),
            *(peak(f"ball_{e}", 0.05, law=0.0) for e in ("0", "0.3", "0.5", "0.8", "1.0")),
            high("stack3_2", 4.9, 0.5),
            high("stack5_4", 4.9, 0.9),
            high("heavy", 4.9, 0.3),
            high("tumble", 4.9, gazebo=(5e-3, 1e-3), default=(9, 9)),
        ),
        5.0,
        0.02,
    )
)
add(
    Scene(
        "world_contacts2",
        "worlds",
        "25 pairs of body and plate in one world",
        "as in the single scenes",
        text_of("contacts2.world"),
        tuple(
            high(name, t)
            for name in (
                "ball_mv1000_on_default",
                "ball_mv1_on_default",
                "ball_mv01_on_default",
                "ball_e08_both_mv1000",
                "box_kp1e4",
                "box_kp1e4_both",
                "box_kp1e6_kd100_drop",
                "box_inside_5mm_mv01",
                "box_mindepth5mm",
                "box_mindepth5mm_both",
            )
            for t in (0.1, 0.45)
        )
        + tuple(
            Row(
                f"speed of {name} at 1 s, m/s",
                lambda r, name=name: r.speed(f"model:{name}", 1.0),
                gazebo=(5e-4, 2e-3),
                default=(3e-2, 6e-3),
            )
            for name in (
                "slope15_mu02_on_1",
                "slope15_slip01",
                "slope15_slip01_both",
                "slope20_fdir_x_mu01_mu2_1",
                "slope20_fdir_y_mu01_mu2_1",
            )
        ),
        1.2,
    )
)
PENDULA = ("free/j1", "damped/j1", "rubbing/j1", "stiff_damping/j1", "double/j1", "stop/j1", "spring/j1")
add(
    Scene(
        "world_pendula",
        "worlds",
        "seven pendula in one world",
        "as in the single scenes",
        text_of("pendula.world"),
        tuple(
            Row(
                f"{name.replace('/', '::')} at {t:g} s",
                lambda r, name=name, t=t: r.angle(name.replace("/", "::"), t),
                gazebo=(1e-4, 2e-5),
                default=(2e-3, 2e-3),
            )
            for name in PENDULA
            for t in (0.5, 1.0, 2.0)
        ),
        2.2,
        0.02,
    )
)
