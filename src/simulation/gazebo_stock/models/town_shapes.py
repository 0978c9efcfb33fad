"""Shapes of the town's models, by kind: trees and posts, cars, buildings, small things."""

from collections.abc import Iterable
from math import atan2, hypot, pi

from pieces import Shape, box, colour, cylinder, sphere

Point = tuple[float, float, float]

BARK, LEAVES, NEEDLES = colour(0.32, 0.22, 0.13), colour(0.2, 0.4, 0.14), colour(0.1, 0.3, 0.14)
WHITE, GREY, DARK, STEEL = colour(0.9, 0.9, 0.88), colour(0.55, 0.55, 0.55), colour(0.12, 0.12, 0.13), colour(0.5, 0.52, 0.55)
BRICK, ROOF, GLASS, DOOR = colour(0.56, 0.3, 0.24), colour(0.35, 0.17, 0.13), colour(0.35, 0.45, 0.55), colour(0.3, 0.2, 0.12)
RED, BLUE, YELLOW, CREAM = colour(0.7, 0.08, 0.06), colour(0.1, 0.2, 0.6), colour(0.9, 0.75, 0.1), colour(0.85, 0.8, 0.68)


def block(name: str, low: Point, high: Point, material: str, collides: bool = True) -> Shape:
    """A box between two corners."""
    size, middle = [b - a for a, b in zip(low, high)], [(a + b) / 2 for a, b in zip(low, high)]
    return Shape(name, box(*(round(s, 4) for s in size)), tuple(round(m, 4) for m in middle), material, collides=collides)


def upright(name: str, radius: float, low: float, high: float, material: str, x: float = 0.0, y: float = 0.0) -> Shape:
    """A cylinder that stands."""
    return Shape(name, cylinder(radius, round(high - low, 4)), (x, y, round((low + high) / 2, 4)), material)


# ---------------------------------------------------------------------------------------------- trees and posts


def pine() -> tuple[Shape, ...]:
    tiers = ((1.59, 1.0, 2.0), (1.3, 2.0, 2.9), (0.95, 2.9, 3.7), (0.6, 3.7, 4.4), (0.28, 4.4, 5.08))
    return (upright("bark", 0.15, 0.0, 1.0, BARK),) + tuple(
        upright(f"branch_{i}", radius, low, high, NEEDLES) for i, (radius, low, high) in enumerate(tiers)
    )


def oak() -> tuple[Shape, ...]:
    crown = ((2.3, 0, 0, 4.2), (1.7, -3.2, -0.4, 3.6), (1.6, 2.6, 0.6, 3.7), (1.6, 0.4, 2.3, 3.9), (1.6, -0.6, -2.4, 3.8))
    return (upright("bark", 0.35, 0.0, 3.0, BARK),) + tuple(
        Shape(f"branch_{i}", sphere(radius), (x, y, z), LEAVES) for i, (radius, x, y, z) in enumerate(crown)
    )


def lamp() -> tuple[Shape, ...]:
    return (
        upright("foot", 0.24, 0.0, 0.3, STEEL),
        upright("pole", 0.09, 0.3, 9.1, STEEL),
        block("arm", (-0.06, -2.4, 9.05), (0.06, 0.05, 9.15), STEEL),
        block("lamp", (-0.2, -3.08, 9.0), (0.2, -2.3, 9.27), WHITE),
    )


def telephone_pole() -> tuple[Shape, ...]:
    return (
        Shape("pole", cylinder(0.0779, 9.144), (0, 0, 4.572), BARK),
        Shape("cross", box(2.116, 0.0418, 0.1778), (0, -0.0988, 8.0484), BARK),
    )


def stop_light_post() -> tuple[Shape, ...]:
    lights = tuple(
        Shape(f"light_{colour_name}", sphere(0.09), (-4.6, -0.13, z), material, collides=False)
        for colour_name, z, material in (("red", 5.75, RED), ("yellow", 5.5, YELLOW), ("green", 5.25, LEAVES))
    )
    return (
        upright("post", 0.07, 0.02, 6.0, STEEL),
        block("arm", (-4.88, -0.05, 5.85), (0.07, 0.05, 5.95), STEEL),
        block("housing", (-4.75, -0.13, 5.1), (-4.45, 0.13, 5.9), DARK),
    ) + lights


def stop_light() -> tuple[Shape, ...]:
    lights = tuple(
        Shape(name, sphere(0.1012), (-0.001, -0.0823, z), material, collides=False)
        for name, z, material in (("red", -0.1475, RED), ("yellow", -0.402, YELLOW), ("green", -0.655, LEAVES))
    )
    hoods = tuple(block(f"hood_{i}", (-0.11, -0.29, z), (0.11, -0.1, z + 0.02), DARK) for i, z in enumerate((-0.06, -0.31, -0.56)))
    return (block("frame", (-0.13, -0.1, -0.78), (0.13, 0.04, -0.02), DARK), *hoods, *lights)


def speed_limit() -> tuple[Shape, ...]:
    return (
        upright("pole", 0.03, 0.0, 2.3, STEEL, y=-0.02),
        block("sign", (-0.39, -0.05, 1.4), (0.39, -0.035, 2.36), WHITE),
        block("number", (-0.2, -0.054, 1.6), (0.2, -0.05, 1.95), DARK, collides=False),
    )


# ---------------------------------------------------------------------------------------------- cars


def wheels(places: Iterable[tuple[float, float]], radius: float, width: float, along_x: bool = True) -> tuple[Shape, ...]:
    turned = (pi / 2, 0, 0) if along_x else (0, pi / 2, 0)
    return tuple(
        Shape(f"wheel_{i}", cylinder(radius, width), (x, y, radius, *(round(angle, 6) for angle in turned)), DARK)
        for i, (x, y) in enumerate(places)
    )


def car(low: Point, high: Point, hood: float, cabin: tuple[float, float], material: str) -> tuple[Shape, ...]:
    """:param hood: z of the body's upper side. :param cabin: x of its back and front"""
    (x0, y0, _), (x1, y1, top) = low, high
    radius, half = 0.2 * top, (y1 - y0) / 2
    glass = top - 0.12
    places = [(x, side * (half - 0.15) + (y0 + y1) / 2) for x in (x0 + 0.2 * (x1 - x0), x1 - 0.2 * (x1 - x0)) for side in (-1, 1)]
    return (
        block("body", (x0, y0 + 0.08, 0.6 * radius), (x1, y1 - 0.08, hood), material),
        block("windows", (cabin[0], y0 + 0.2, hood), (cabin[1], y1 - 0.2, glass), GLASS),
        block("roof", (cabin[0] + 0.15, y0 + 0.18, glass), (cabin[1] - 0.35, y1 - 0.18, top), material),
    ) + wheels(places, radius, 0.3)


def hatchback(material: str) -> tuple[Shape, ...]:
    return car((-1.66, -1.07, 0), (2.34, 1.07, 1.56), 0.95, (-1.55, 1.1), material)


def pickup() -> tuple[Shape, ...]:
    cab = car((-2.95, -1.24, 0), (2.71, 1.24, 1.86), 1.1, (-1.3, 1.0), BLUE)
    rails = tuple(block(f"rail_{side}", (-2.95, y, 1.1), (-1.3, y + 0.1, 1.35), BLUE) for side, y in (("right", -1.14), ("left", 1.04)))
    return cab + rails + (block("tailgate", (-2.95, -1.14, 1.1), (-2.85, 1.14, 1.35), BLUE),)


def coach(low: Point, high: Point, material: str, stripe: str, cab: float = 0.0) -> tuple[Shape, ...]:
    """Along y. :param cab: m of a lower part at the front, with the windscreen"""
    (x0, y0, _), (x1, y1, top) = low, high
    front, axle = y0 + cab, 0.18 * (y1 - y0)
    parts = [
        block("body", (x0, front, 0.4), (x1, y1, top), material),
        block("stripe", (x0 - 0.01, front, 0.35 * top), (x1 + 0.01, y1, 0.42 * top), stripe, collides=False),
        block("windows", (x0 - 0.01, front + 0.3, 0.55 * top), (x1 + 0.01, y1 - 0.5, 0.8 * top), GLASS, collides=False),
    ]
    if cab:
        parts += [
            block("hood", (x0 + 0.1, y0, 0.4), (x1 - 0.1, front, 0.6 * top), material),
            block("windscreen", (x0 + 0.15, front - 0.5, 0.6 * top), (x1 - 0.15, front, 0.85 * top), GLASS),
        ]
    else:
        parts += [block("windscreen", (x0 + 0.1, y0 - 0.01, 0.45 * top), (x1 - 0.1, y0 + 0.1, 0.85 * top), GLASS, collides=False)]
    return (*parts, *wheels([(x, y) for x in (x0 + 0.2, x1 - 0.2) for y in (y0 + axle, y1 - axle)], 0.5, 0.3, along_x=False))


# ---------------------------------------------------------------------------------------------- buildings


def gable(name: str, low: Point, high: Point, overhang: float = 0.3) -> tuple[Shape, ...]:
    """Two slopes over a rectangle, the ridge along x, from the eaves at ``low`` to the ridge's height at ``high``."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    half, rise, thick = (y1 - y0) / 2 + overhang, z1 - z0, 0.15
    slope, length = atan2(rise, half), hypot(half, rise)
    middle = ((x0 + x1) / 2, (y0 + y1) / 2)
    return tuple(
        Shape(
            f"{name}_{side}",
            box(round(x1 - x0 + 2 * overhang, 4), round(length, 4), thick),
            (
                round(middle[0], 4),
                round(middle[1] + sign * half / 2, 4),
                round((z0 + z1) / 2 - thick / 2, 4),
                round(-sign * slope, 6),
                0,
                0,
            ),
            ROOF,
        )
        for side, sign in (("back", 1), ("front", -1))
    )


def openings(x0: float, x1: float, y: float, storeys: int, height: float, side: str = "front") -> tuple[Shape, ...]:
    """Windows, in front a door too, that are seen on a wall along x at ``y``; none of them collides."""
    count = max(2, int((x1 - x0) / 2.5))
    step = (x1 - x0) / count
    found = []
    for storey in range(storeys):
        for i in range(count):
            x, z = x0 + (i + 0.5) * step, storey * height
            if side == "front" and storey == 0 and i == count // 2:
                found.append(block(f"door_{i}", (x - 0.5, y - 0.03, 0), (x + 0.5, y + 0.03, 2.1), DOOR, collides=False))
            else:
                found.append(
                    block(
                        f"{side}_window_{storey}_{i}", (x - 0.55, y - 0.03, z + 0.9), (x + 0.55, y + 0.03, z + 2.1), GLASS, collides=False
                    )
                )
    return tuple(found)


def house(low: Point, high: Point, walls: float, material: str, porch: float = 0.0) -> tuple[Shape, ...]:
    """:param walls: height of the eaves. :param porch: depth of a lower part along the front, at -y"""
    (x0, y0, _), (x1, y1, top) = low, high
    front, storeys = y0 + porch, max(1, round(walls / 2.8))
    inner = (x0 + 0.3, front + 0.3, x1 - 0.3, y1 - 0.3)
    parts = (
        block("walls", (inner[0], inner[1], 0), (inner[2], inner[3], walls), material),
        block(
            "attic",
            (inner[0], inner[1] + 0.3 * (inner[3] - inner[1]), walls),
            (inner[2], inner[3] - 0.3 * (inner[3] - inner[1]), walls + 0.4 * (top - walls)),
            material,
        ),
    )
    parts += gable("roof", (inner[0], inner[1], walls), (inner[2], inner[3], top))
    for side, y in (("front", inner[1]), ("back", inner[3])):
        parts += openings(inner[0], inner[2], y, storeys, walls / storeys, side)
    if porch:
        parts += (block("porch_roof", (x0, y0, 2.5), (x1, front + 0.3, 2.65), ROOF),) + tuple(
            upright(f"porch_post_{i}", 0.08, 0, 2.5, WHITE, x, y0 + 0.15) for i, x in enumerate((x0 + 0.2, (x0 + x1) / 2 - 1.5, x1 - 0.2))
        )
    return parts


def flat(low: Point, high: Point, material: str, storeys: int, sign: str = "") -> tuple[Shape, ...]:
    """A building with a flat roof; its front is at -y. :param sign: material of a board over the door"""
    (x0, y0, _), (x1, y1, top) = low, high
    parts = (block("walls", (x0, y0, 0), (x1, y1, top - 0.2), material), block("roof", (x0, y0, top - 0.2), (x1, y1, top), GREY))
    for side, y in (("front", y0), ("back", y1)):
        parts += openings(x0, x1, y, storeys, (top - 0.6) / storeys, side)
    if sign:
        parts += (block("sign", (x0 + 0.2 * (x1 - x0), y0 - 0.1, 2.3), (x1 - 0.2 * (x1 - x0), y0, 2.9), sign, collides=False),)
    return parts


def gas_station() -> tuple[Shape, ...]:
    pumps = tuple(
        block(f"pump_{i}_{j}", (x - 0.4, y - 0.3, 0), (x + 0.4, y + 0.3, 1.9), RED)
        for i, x in enumerate((-3.5, 3.5))
        for j, y in enumerate((-19.0, -15.0, -11.0))
    )
    posts = tuple(
        upright(f"post_{i}_{j}", 0.25, 0, 3.5, WHITE, x, y) for i, x in enumerate((-3.5, 3.5)) for j, y in enumerate((-20.8, -9.0))
    )
    return (
        block("shop", (-10.29, -5.4, 0), (10.29, 5.81, 3.1), CREAM),
        block("canopy", (-7.0, -22.0, 3.5), (5.0, -6.5, 4.0), RED),
        upright("sign_post", 0.15, 0, 7.0, STEEL, 9.0, -23.0),
        block("sign", (7.7, -23.2, 7.0), (10.29, -22.8, 8.98), RED),
        *openings(-10.29, 10.29, -5.4, 1, 3.0),
        *pumps,
        *posts,
    )


def fast_food() -> tuple[Shape, ...]:
    """Its link is 3.16 m above its origin, as in the database."""
    return (
        block("walls", (-14.13, -8.29, -3.1), (6.5, 8.29, 1.6), RED),
        block("roof", (-10.0, -6.0, 1.6), (4.0, 6.0, 3.0), ROOF),
        upright("sign_post", 0.3, -3.1, 5.0, STEEL, 9.7, -4.5),
        block("sign", (8.4, -7.5, 5.0), (11.03, -1.5, 7.86), YELLOW),
    )


def cafe() -> tuple[Shape, ...]:
    """A room that is open above, so that what is in it can be seen; walls and floor where the database's collide."""
    walls = (
        ("wall_1", (-5.03, 0.53), (0.12, 23.16), 2.83),
        ("wall_2", (4.24, -0.31), (0.12, 21.48), 2.83),
        ("wall_3", (-1.48, 7.43), (7.2, 0.12), 2.83),
        ("wall_4", (2.09, 8.9), (0.12, 3.05), 2.87),
        ("wall_5", (3.155, 10.4), (2.13, 0.12), 2.87),
        ("wall_6", (0.615, -10.98), (7.36, 0.15), 2.83),
        ("wall_7", (-4.62, -10.98), (0.93, 0.15), 2.83),
    )
    return (
        Shape("main_floor", box(9.38, 22.63, 0.19), (-0.4, -0.75, 0.0948), colour(0.5, 0.33, 0.2)),
        *(Shape(name, box(*size, height), (*at, height / 2), CREAM) for name, at, size, height in walls),
        Shape("wall_8", box(1.09, 0.15, 0.28), (-3.61, -10.98, 2.69), CREAM),
        Shape("coke", box(1.03, 1.03, 1.52), (-4.385, 0.26, 0.95), RED),
    )


def fire_station() -> tuple[Shape, ...]:
    columns = tuple(
        Shape(f"column_{i}", box(width, 0.515, 4), (x, 4.957, 2), BRICK)
        for i, (x, width) in enumerate(((9.333, 1.315), (3.33, 2.63), (-3.33, 2.63), (-9.333, 1.315)))
    )
    gates = tuple(Shape(f"gate_{i}", box(4.0, 0.02, 4), (x, 4.72, 2), RED, collides=False) for i, x in enumerate((-6.66, 0, 6.66)))
    return (
        Shape("main", box(19.98, 9.68, 10), (0, -0.135, 5), BRICK),
        Shape("front_top", box(20, 0.515, 6), (0, 4.957, 7), BRICK),
        *columns,
        *gates,
        *gable("roof", (-10.44, -5.3, 9.7), (10.44, 5.7, 11.36)),
    )


def tower(half: float, top: float) -> tuple[Shape, ...]:
    """A lattice on four legs that lean together."""
    lean, length = atan2(half - 0.4, top), hypot(half - 0.4, top)
    legs = tuple(
        Shape(
            f"leg_{i}",
            box(0.25, 0.25, round(length, 3)),
            (x * (half + 0.4) / 2, y * (half + 0.4) / 2, top / 2, round(y * lean, 6), round(-x * lean, 6), 0),
            RED,
        )
        for i, (x, y) in enumerate(((1, 1), (1, -1), (-1, -1), (-1, 1)))
    )
    rungs = []
    for i in range(1, 8):
        z = i * top / 8
        reach = half - (half - 0.4) * z / top
        rungs += [
            block(f"rung_{i}_{side}", *corners, WHITE)
            for side, corners in (
                ("front", ((-reach, -reach - 0.1, z), (reach, -reach + 0.1, z + 0.2))),
                ("back", ((-reach, reach - 0.1, z), (reach, reach + 0.1, z + 0.2))),
                ("left", ((-reach - 0.1, -reach, z), (-reach + 0.1, reach, z + 0.2))),
                ("right", ((reach - 0.1, -reach, z), (reach + 0.1, reach, z + 0.2))),
            )
        ]
    return (*legs, *rungs)


def water_tower() -> tuple[Shape, ...]:
    legs = tuple(upright(f"leg_{i}", 0.2, 0, 16.0, STEEL, x, y) for i, (x, y) in enumerate(((2, 2), (2, -2), (-2, -2), (-2, 2))))
    return (*legs, upright("tank", 3.12, 16.0, 21.5, STEEL), upright("lid", 1.6, 21.5, 23.22, STEEL))


def fountain() -> tuple[Shape, ...]:
    return (
        upright("basin", 0.9, 0, 0.4, GREY),
        upright("water", 0.8, 0.4, 0.42, GLASS),
        upright("column", 0.18, 0.42, 2.2, GREY),
        upright("bowl", 0.5, 1.4, 1.55, GREY),
        Shape("top", sphere(0.22), (0, 0, 2.43), GREY),
    )


def tote() -> tuple[Shape, ...]:
    sides = (
        ("side_wall_1", (0.58404, 0.02602, 0.2831), (0, -0.18, 0.14155, 0.06115, 0, 0)),
        ("side_wall_2", (0.58404, 0.02602, 0.2831), (0, 0.18, 0.14155, -0.06115, 0, 0)),
        ("side_wall_3", (0.02602, 0.33046, 0.2831), (0.305, 0, 0.14155, 0, 0.06115, 0)),
        ("side_wall_4", (0.02602, 0.33046, 0.2831), (-0.305, 0, 0.14155, 0, -0.06115, 0)),
    )
    return (
        Shape("bottom", box(0.58404, 0.33046, 0.02), (0, 0, 0.01), GREY),
        Shape("lid", box(0.67768, 0.41298, 0.01588), (0, 0, 0.28958), GREY),
        *(Shape(name, box(*size), at, GREY) for name, size, at in sides),
    )


def maze_wall(height: float) -> tuple[Shape, ...]:
    return (block("wall", (-0.6, 0.595, 0), (0.6, 0.61, height), CREAM),)


def truss() -> tuple[Shape, ...]:
    """Four tubes along y, joined by square frames."""
    tubes = tuple(
        Shape(f"tube_{i}", cylinder(0.025, 1.53), (x, 0, z, round(pi / 2, 6), 0, 0), STEEL)
        for i, (x, z) in enumerate(((0.12, 0.12), (0.12, -0.12), (-0.12, -0.12), (-0.12, 0.12)))
    )
    frames = []
    for i, y in enumerate((-0.6, -0.2, 0.2, 0.6)):
        for side in (-0.12, 0.12):
            frames.append(block(f"upright_{i}_{side:g}", (side - 0.01, y - 0.01, -0.12), (side + 0.01, y + 0.01, 0.12), STEEL))
            frames.append(block(f"cross_{i}_{side:g}", (-0.12, y - 0.01, side - 0.01), (0.12, y + 0.01, side + 0.01), STEEL))
    return (*tubes, *frames)


def pallet() -> tuple[Shape, ...]:
    """Five boards on three rows of blocks, on three boards."""
    wood = colour(0.66, 0.46, 0.27)
    top = tuple(
        block(f"top_{i}", (x - 0.07, -0.6, 0.05), (x + 0.07, 0.6, 0.07), wood) for i, x in enumerate((-0.33, -0.165, 0, 0.165, 0.33))
    )
    rows = tuple(block(f"row_{i}", (-0.4, y - 0.07, 0.03), (0.4, y + 0.07, 0.05), wood) for i, y in enumerate((-0.53, 0, 0.53)))
    blocks = tuple(
        block(f"block_{i}_{j}", (x - 0.07, y - 0.07, -0.05), (x + 0.07, y + 0.07, 0.03), wood)
        for i, x in enumerate((-0.33, 0, 0.33))
        for j, y in enumerate((-0.53, 0, 0.53))
    )
    feet = tuple(block(f"foot_{i}", (x - 0.07, -0.6, -0.07), (x + 0.07, 0.6, -0.05), wood) for i, x in enumerate((-0.33, 0, 0.33)))
    return (*top, *rows, *blocks, *feet)


#: the seven bars of a digit: a on top, b and c on the right from above, d below, e and f on the left, g in the middle
_BARS = {
    "a": (0, 0.3, 0.4, 0.1),
    "b": (0.15, 0.15, 0.1, 0.4),
    "c": (0.15, -0.15, 0.1, 0.4),
    "d": (0, -0.3, 0.4, 0.1),
    "e": (-0.15, -0.15, 0.1, 0.4),
    "f": (-0.15, 0.15, 0.1, 0.4),
    "g": (0, 0, 0.4, 0.1),
}
_DIGITS = ("", "bc", "abged", "abgcd", "fgbc", "afgcd", "afgedc", "abc", "abcdefg", "abcdfg")


def number(digit: int) -> tuple[Shape, ...]:
    """A white cube of 80 cm with the digit on its four sides; nothing of it collides, as in the database."""
    found = [Shape("cube", box(0.8, 0.8, 0.8), (), WHITE, collides=False)]
    for side, turn in enumerate((0.0, pi / 2, pi, -pi / 2)):
        cos, sin = (round(value) for value in ((1, 0), (0, 1), (-1, 0), (0, -1))[side])
        for bar in _DIGITS[digit]:
            across, z, width, height = _BARS[bar]
            x, y = across * cos + 0.4 * sin, across * sin - 0.4 * cos
            found.append(
                Shape(
                    f"bar_{side}_{bar}", box(width, 0.01, height), (round(x, 4), round(y, 4), z, 0, 0, round(turn, 6)), DARK, collides=False
                )
            )
    return tuple(found)
