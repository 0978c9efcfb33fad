"""Many contacts at once: stacks, piles, walls, mass ratios. What a user sees is compared: what falls, and when."""

import math

from real_gazebo.scene import Deed, Row, Scene, add
from real_gazebo.sdf import ball, box, box_moments, cube, ground, solid, surface, world

SEEN = (0.1, 0.02)  # of a time, 10 %
ROUGH = surface(1.0)
ORDER = "chaotic: which way it leans follows from the order in which quickStep takes the rows"


def pile(name, what, law, bodies, rows, seconds=5.0, deeds=(), every=0.04, **settings):
    return add(Scene(name, "piles", what, law, world(ground(), *bodies, **settings), tuple(rows), seconds, every, tuple(deeds)))


def stands(body, height, time=4.9, near=(0, 0.01), default=(0, 1e-3)):
    return Row(f"height of {body} at {time:g} s, m", lambda r: r.at(f"model:{body}", "z", time), law=height, gazebo=near, default=default)


def wanders(body, time=4.9, near=(0, 0.03)):
    return Row(
        f"{body} aside at {time:g} s, m",
        lambda r: math.hypot(
            r.at(f"model:{body}", "x", time) - r.at(f"model:{body}", "x", 0),
            r.at(f"model:{body}", "y", time) - r.at(f"model:{body}", "y", 0),
        ),
        law=0.0,
        gazebo=near,
        default=(0, 1e-3),
    )


def falls(body, below, law=math.inf):
    return Row(f"{body} falls below {below:g} m after, s", lambda r: r.falls_at(f"model:{body}", below), law=law, gazebo=SEEN, default=SEEN)


def stack(n, mass=1.0, side=0.2):
    return [cube(f"s{i}", side, mass, f"0 0 {side * (i + 0.5):.9g} 0 0 0", ROUGH) for i in range(n)]


pile("stack_3", "three cubes on each other", "stands", stack(3), (stands("s2", 0.5), wanders("s2", near=(0, 0.05))))
pile("stack_5", "five cubes on each other", "stands", stack(5), (stands("s4", 0.9), wanders("s4", near=(0, 0.05))))
pile("stack_7", "seven cubes on each other", "stands", stack(7), (falls("s6", 1.2), stands("s6", 1.3, near=(0, 0.05))))
pile("stack_10", "ten cubes on each other", "stands", stack(10), (falls("s9", 1.7), falls("s9", 1.0), stands("s9", 1.9, near=(0, 0.1))))
pile(
    "stack_10_loose",
    "ten cubes 5 mm apart, which drop on each other",
    "stands: each falls straight down",
    [cube(f"s{i}", 0.2, 1, f"0 0 {0.1 + 0.205 * i:.9g} 0 0 0", ROUGH) for i in range(10)],
    (falls("s9", 1.7), falls("s9", 1.0), stands("s9", 1.9, near=(0, 0.1))),
)
pile(
    "stack_10_many_iterations",
    "ten cubes, 500 iterations",
    "stands",
    stack(10),
    (falls("s9", 1.7), stands("s9", 1.9, near=(0, 0.05))),
    3.0,
    physics="<ode><solver><type>quick</type><iters>500</iters><sor>1.3</sor></solver></ode>",
)
pile(
    "heavy_on_light",
    "100 kg on 1 kg",
    "stands",
    [cube("light", 0.2, 1, "0 0 0.1 0 0 0", ROUGH), cube("heavy", 0.2, 100, "0 0 0.3 0 0 0", ROUGH)],
    (falls("heavy", 0.2), stands("heavy", 0.3, near=(0, 0.02))),
)
pile(
    "heavy_10_on_light",
    "10 kg on 1 kg",
    "stands",
    [cube("light", 0.2, 1, "0 0 0.1 0 0 0", ROUGH), cube("heavy", 0.2, 10, "0 0 0.3 0 0 0", ROUGH)],
    (stands("heavy", 0.3, near=(0, 0.02)), wanders("heavy", near=(0, 0.05))),
)
pile(
    "light_on_heavy",
    "1 kg on 100 kg",
    "stands",
    [cube("heavy", 0.2, 100, "0 0 0.1 0 0 0", ROUGH), cube("light", 0.2, 1, "0 0 0.3 0 0 0", ROUGH)],
    (stands("light", 0.3), wanders("light", near=(0, 0.02))),
)
BRICK = (0.2, 0.1, 0.1)


def bricks(rows, columns):
    for row in range(rows):
        for i in range(columns - row % 2):
            x = (i + (row % 2) * 0.5) * 0.202 - columns * 0.101
            yield solid(f"b{row}_{i}", box(*BRICK), 1, box_moments(1, *BRICK), f"{x:.9g} 0 {0.05 + 0.1 * row:.9g} 0 0 0", ROUGH)


pile("wall_5x5", "wall of 23 bricks", "stands", bricks(5, 5), (falls("b4_2", 0.4), stands("b4_2", 0.45, near=(0, 0.05))))
pile("wall_8x4", "wall of 28 bricks, eight rows", "stands", bricks(8, 4), (falls("b7_1", 0.7), stands("b7_1", 0.75, near=(0, 0.05))))
pile(
    "wall_hit",
    "wall of 23 bricks, hit by 5 kg at 4 m/s",
    "falls: its upper middle brick comes down",
    list(bricks(5, 5)) + [ball("shot", 0.08, 5, "0 -1 0.35 0 0 0", ROUGH)],
    (
        falls("b4_2", 0.35, law=None),
        Row("way of the ball at 1 s, m", lambda r: r.at("model:shot", "y", 1.0) + 1, gazebo=(0.2, 0), default=(0.3, 0)),
    ),
    2.5,
    [Deed("twist", "shot", "0 4 0 0 0 0")],
)


def pyramid(base):
    for row in range(base):
        for i in range(base - row):
            yield cube(f"p{row}_{i}", 0.2, 1, f"{(i - (base - row - 1) / 2) * 0.205:.9g} 0 {0.1 + 0.2 * row:.9g} 0 0 0", ROUGH)


pile("pyramid_4", "pyramid of ten cubes", "stands", pyramid(4), (falls("p3_0", 0.6), stands("p3_0", 0.7, near=(0, 0.02))))
DOMINO = (0.02, 0.1, 0.2)
pile(
    "dominoes",
    "ten dominoes 0.1 m apart, the first pushed",
    "each topples the next",
    [solid(f"d{i}", box(*DOMINO), 0.2, box_moments(0.2, *DOMINO), f"{0.1 * i:.9g} 0 0.1 0 0 0", surface(0.6)) for i in range(10)],
    (falls("d4", 0.07, law=None), falls("d9", 0.07, law=None)),
    3.0,
    [Deed("push", "d0::l", "3 0 0", 0, 0.1)],
    every=0.01,
)
pile(
    "heap_of_balls",
    "20 balls dropped into a heap",
    "they spread and come to rest on the floor",
    [ball(f"b{i}", 0.05, 0.2, f"{0.06 * (i % 3):.9g} {0.05 * (i % 4):.9g} {0.2 + 0.11 * i:.9g} 0 0 0", surface(0.5)) for i in range(20)],
    (
        Row(
            "mean height at 4.9 s, m",
            lambda r: sum(r.at(f"model:b{i}", "z", 4.9) for i in range(20)) / 20,
            law=0.05,
            gazebo=(0, 5e-3),
            default=(0, 5e-3),
        ),
        Row(
            "mean distance from the middle at 2 s, m",
            lambda r: sum(math.hypot(r.at(f"model:b{i}", "x", 2), r.at(f"model:b{i}", "y", 2)) for i in range(20)) / 20,
            gazebo=(0.3, 0),
            default=(0.5, 0),
        ),
    ),
)
pile(
    "card_house",
    "two cards lean on each other at 20 deg, mu 1",
    "stands: tan(20)/2 < mu",
    [
        solid(
            f"c{s:+d}",
            box(0.01, 0.2, 0.4),
            0.1,
            box_moments(0.1, 0.01, 0.2, 0.4),
            f"{s * (0.2 * math.sin(math.radians(20)) + 0.005 * math.cos(math.radians(20))):.9g} 0 "
            f"{0.2 * math.cos(math.radians(20)) + 0.005 * math.sin(math.radians(20)):.9g} 0 {-s * math.radians(20):.9g} 0",
            ROUGH,
        )
        for s in (-1, 1)
    ],
    (falls("c+1", 0.15), stands("c+1", 0.2 * math.cos(math.radians(20)) + 0.005 * math.sin(math.radians(20)), near=(0, 0.01))),
    3.0 + 2,
)
pile(
    "table_loaded",
    "board on four posts, 20 kg on it",
    "stands",
    [cube(f"post{i}", 0.1, 1, f"{0.4 * (i % 2 * 2 - 1)} {0.3 * (i // 2 * 2 - 1)} 0.05 0 0 0", ROUGH) for i in range(4)]
    + [
        solid("board", box(1, 0.8, 0.04), 5, box_moments(5, 1, 0.8, 0.04), "0 0 0.12 0 0 0", ROUGH),
        cube("load", 0.3, 20, "0 0 0.29 0 0 0", ROUGH),
    ],
    (stands("load", 0.29, near=(0, 0.01)), wanders("load")),
)
pile(
    "hundred_boxes",
    "100 cubes dropped as a loose block of 5 x 5 x 4",
    "each column of four comes straight down, and stands: 0.2 m",
    [
        cube(f"h{i}", 0.1, 1, f"{0.13 * (i % 5):.9g} {0.13 * (i // 5 % 5):.9g} {0.1 + 0.13 * (i // 25):.9g} 0 0 0.1", surface(0.6))
        for i in range(100)
    ],
    (
        Row(
            "mean height at 2.9 s, m",
            lambda r: sum(r.at(f"model:h{i}", "z", 2.9) for i in range(100)) / 100,
            law=0.2,
            gazebo=(0.1, 0),
            default=(0.2, 0),
        ),
        Row(
            "fastest at 2.9 s, m/s",
            lambda r: max(r.speed(f"model:h{i}", 2.9) for i in range(100)),
            law=0.0,
            gazebo=(9, 0.3),
            default=(0, 0.05),
        ),
    ),
    3.0,
    every=0.1,
)
