#!/usr/bin/env python3
"""Writes the worlds that repeat one thing many times, and those built from a plan in ``plans/``.

Run after a change: ``python3 make_worlds.py``.
"""

import math
import random
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "models"))

from building_editor import building, sdf_model  # noqa: E402
from pieces import box, box_inertia, numbers, pose, script, tag  # noqa: E402

SUN, FLOOR = (tag("include", tag("uri", uri)) for uri in ("model://sun", "model://ground_plane"))


def world(comment, *content):
    body = tag("world", *content, name="default")
    return f'<?xml version="1.0"?>\n<!-- {comment} -->\n' + tag("sdf", body, version="1.5") + "\n"


def block(name, size, at, mass, material, surface=""):
    """A box that moves, or stands for ever when ``mass`` is None."""
    inertial = ""
    if mass is not None:
        ixx, iyy, izz = box_inertia(mass, *size)
        inertial = tag(
            "inertial",
            tag("mass", f"{mass:g}"),
            tag("inertia", *(tag(key, f"{value:.6g}") for key, value in (("ixx", ixx), ("iyy", iyy), ("izz", izz)))),
        )
    link = tag(
        "link",
        inertial,
        tag("collision", tag("geometry", box(*size)), surface, name="collision"),
        tag("visual", tag("geometry", box(*size)), script(material), name="visual"),
        name="link",
    )
    return tag("model", tag("static", "true") if mass is None else "", pose(at), link, name=name)


def friction(mu):
    return tag("surface", tag("friction", tag("ode", tag("mu", mu), tag("mu2", mu))))


def stacks():
    """Towers of 3 to 8 cubes, and a pyramid."""
    colours = ["Gazebo/Red", "Gazebo/Green", "Gazebo/Blue", "Gazebo/Yellow", "Gazebo/Orange", "Gazebo/Purple"]
    blocks = [
        block(f"tower_{n}_{i}", (0.2, 0.2, 0.2), (0.5 * (n - 5), 0.0, 0.1 + 0.2 * i), 1.0, colours[n - 3])
        for n in range(3, 9)
        for i in range(n)
    ]
    blocks += [
        block(f"pyramid_{row}_{i}", (0.3, 0.3, 0.3), (0.31 * (i - 0.5 * (4 - row)), 2.0, 0.15 + 0.3 * row), 2.0, "Gazebo/Wood")
        for row in range(5)
        for i in range(5 - row)
    ]
    return world("Towers of three to eight cubes and a pyramid of fifteen.", SUN, FLOOR, *blocks)


def friction_demo():
    """Equal boxes on one slope of 0.3 rad (tan 0.309): those with mu below it slide."""
    slope, half = 0.3, 0.1
    blocks = [block("slope", (4.0, 3.0, 0.1), (0.0, 0.0, 0.8, 0.0, slope, 0.0), None, "Gazebo/Grey")]
    for i, mu in enumerate((0.05, 0.15, 0.25, 0.35, 0.6, 1.0)):
        x, up = -1.4, 0.05 + half
        at = (
            x * math.cos(slope) + up * math.sin(slope),
            -1.1 + 0.44 * i,
            0.8 - x * math.sin(slope) + up * math.cos(slope),
            0.0,
            slope,
            0.0,
        )
        blocks.append(
            block(f"box_mu_{mu:g}", (0.2, 0.2, 0.2), at, 1.0, "Gazebo/Red" if mu < math.tan(slope) else "Gazebo/Green", friction(mu))
        )
    return world("Six boxes on a slope: the red ones have too little friction to stay.", SUN, FLOOR, *blocks)


def rubble():
    """Boards and blocks dropped into a heap, the same in every run."""
    rng = random.Random(1)
    blocks = []
    for i in range(60):
        size = tuple(round(rng.uniform(*limits), 3) for limits in ((0.1, 0.7), (0.08, 0.35), (0.04, 0.15)))
        turn = [round(rng.uniform(-math.pi, math.pi), 4) for _ in range(3)]
        at = (round(rng.uniform(-1.5, 1.5), 4), round(rng.uniform(-1.5, 1.5), 4), round(0.2 + 0.09 * i, 4), *turn)
        mass, colour = round(600 * size[0] * size[1] * size[2], 3), rng.choice(["Grey", "DarkGrey", "Wood", "Bricks"])
        blocks.append(block(f"piece_{i}", size, at, mass, "Gazebo/" + colour))
    return world("Sixty pieces of rubble fall into a heap.", SUN, FLOOR, *blocks)


def mud():
    """A field of mud sunk between firm ground: slippery, and it gives way."""
    soft = tag(
        "surface",
        tag("friction", tag("ode", tag("mu", 0.15), tag("mu2", 0.15))),
        tag("contact", tag("ode", tag("kp", 20000), tag("kd", 500), tag("max_vel", 0.01), tag("min_depth", 0.02))),
    )
    colour = tag("material", tag("ambient", "0.3 0.2 0.12 1"), tag("diffuse", "0.3 0.2 0.12 1"))
    field = tag(
        "model",
        tag("static", "true"),
        pose((6, 0, 0.01)),
        tag(
            "link",
            tag("collision", tag("geometry", box(8, 10, 0.02)), soft, name="collision"),
            tag("visual", tag("geometry", box(8, 10, 0.02)), colour, name="visual"),
            name="link",
        ),
        name="mud",
    )
    places = ((4, 5.5), (8.2, 5.5), (4, -5.5), (8.2, -5.5))
    barriers = [
        tag("include", tag("uri", "model://jersey_barrier"), tag("name", f"barrier_{i}"), pose(place)) for i, place in enumerate(places)
    ]
    return world("A field of mud ahead: soft and slippery, barriers on both sides.", SUN, FLOOR, field, *barriers)


def camera():
    """A camera on a post that looks at a table with things on it."""
    sensor = tag(
        "sensor",
        tag("always_on", 1),
        tag("update_rate", 30),
        tag(
            "camera",
            tag("horizontal_fov", 1.047),
            tag("image", tag("width", 640), tag("height", 480), tag("format", "R8G8B8")),
            tag("clip", tag("near", 0.1), tag("far", 100)),
        ),
        name="camera",
        type="camera",
    )
    eye = tag(
        "model",
        tag("static", "true"),
        pose((-2, 0, 1.7, 0, 0.3, 0)),
        tag(
            "link",
            tag("collision", tag("geometry", box(0.1, 0.1, 0.1)), name="collision"),
            tag("visual", tag("geometry", box(0.1, 0.1, 0.1)), script("Gazebo/Black"), name="visual"),
            sensor,
            name="link",
        ),
        name="camera",
    )
    things = [
        tag("include", tag("uri", "model://" + model), pose(at))
        for model, at in (
            ("table", (0.5, 0, 0)),
            ("coke_can", (0.3, 0.2, 1.02)),
            ("beer", (0.4, -0.3, 1.02)),
            ("wood_cube_10cm", (0.7, 0, 1.02)),
            ("bookshelf", (2.5, 1, 0)),
        )
    ]
    return world("A camera looks at a table.", SUN, FLOOR, eye, *things)


def part(name, size, at, look):
    """A collision and a visual of one box."""
    return "\n".join(
        tag(kind, pose(at), tag("geometry", box(*size)), material, name=f"{name}_{kind}")
        for kind, material in (("collision", ""), ("visual", script(look)))
    )


def link(name, mass, size, *content, at=()):
    """A link whose mass is spread over a box of ``size``."""
    inertia = zip(("ixx", "iyy", "izz"), box_inertia(mass, *size))
    return tag(
        "link",
        pose(at) if at else "",
        tag("inertial", tag("mass", mass), tag("inertia", *(tag(key, f"{value:.6g}") for key, value in inertia))),
        *content,
        name=name,
    )


def slide(name, parent, child, axis, upper):
    limit = tag("limit", tag("lower", 0), tag("upper", upper))
    return tag(
        "joint", tag("parent", parent), tag("child", child), tag("axis", tag("xyz", numbers(axis)), limit), name=name, type="prismatic"
    )


def elevator():
    """A cabin between three floors, three metres apart. Its doorway is at +x, the door slides to the left (+y)."""
    cabin = link(
        "cabin",
        400,
        (2, 2, 2.2),
        *(
            part(name, size, at, look)
            for name, size, at, look in (
                ("floor", (2, 2, 0.1), (0, 0, 0.05), "Gazebo/Grey"),
                ("lid", (2, 2, 0.05), (0, 0, 2.225), "Gazebo/Grey"),
                ("left", (1.9, 0.05, 2.1), (0, 0.975, 1.15), "Gazebo/Orange"),
                ("right", (1.9, 0.05, 2.1), (0, -0.975, 1.15), "Gazebo/Orange"),
                ("back", (0.05, 2, 2.1), (-0.975, 0, 1.15), "Gazebo/Orange"),
                ("front", (0.05, 1, 2.1), (0.975, 0.5, 1.15), "Gazebo/Orange"),
            )
        ),
    )
    size = (0.04, 1, 2.1)
    door = link("door", 20, size, part("panel", size, (0, 0, 0), "Gazebo/Blue"), at=(1.03, -0.5, 1.15))
    plugin = tag(
        "plugin",
        tag("lift_joint", "elevator::lift"),
        tag("door_joint", "elevator::door"),
        tag("floor_height", 3),
        tag("door_wait_time", 10),
        tag("topic", "elevator"),
        name="elevator_plugin",
        filename="libgazebo_ros_elevator.so",
    )
    lift = tag(
        "model",
        cabin,
        door,
        slide("lift", "world", "cabin", (0, 0, 1), 6),
        slide("door", "cabin", "door", (0, 1, 0), 1),
        plugin,
        name="elevator",
    )
    storeys = [block(f"storey_{n}", (4, 4, 0.1), (3.08, 0, 3 * n + 0.05), None, "Gazebo/Wood") for n in range(3)]
    ramp = block("ramp", (1.5, 4, 0.02), (5.82, 0, 0.04, 0, 0.0667, 0), None, "Gazebo/Wood")
    return world(
        "An elevator between three storeys: rostopic pub -1 /elevator std_msgs/String 2 sends it up.",
        SUN,
        FLOOR,
        lift,
        _shaft(),
        *storeys,
        ramp,
    )


def _shaft():
    walls = (("back", (0.1, 2.4, 9), (-1.15, 0, 4.5)), ("left", (2.2, 0.1, 9), (0, 1.15, 4.5)), ("right", (2.2, 0.1, 9), (0, -1.15, 4.5)))
    link = tag("link", *(part(name, size, at, "Gazebo/White") for name, size, at in walls), name="walls")
    return tag("model", tag("static", "true"), link, name="shaft")


def actor():
    """A person that walks round a circle of 2 m at 1 m/s: the way between two points is a smooth curve."""
    radius, corners = 2.0, 16
    points = [(2.0 * math.pi * radius * i / corners, 2.0 * math.pi * i / corners) for i in range(corners + 1)]
    waypoints = [
        tag("waypoint", tag("time", f"{time:.3f}"), pose((radius * math.sin(angle), radius - radius * math.cos(angle), 0, 0, 0, angle)))
        for time, angle in points
    ]
    walk = tag("filename", "file://media/models/walk.dae")
    return world(
        "A person that walks round and round.",
        SUN,
        FLOOR,
        tag(
            "actor",
            tag("skin", walk),
            tag("animation", walk, tag("interpolate_x", "true"), name="walking"),
            tag("script", tag("loop", "true"), tag("trajectory", *waypoints, id="0", type="walking")),
            name="actor",
        ),
    )


def plan(name):
    return building.read_plan(str(HERE / "plans" / f"{name}.yaml"))


def willowgarage():
    things = [
        tag("include", tag("uri", "model://" + thing.model), tag("name", thing.name), pose((*thing.at, 0, 0, thing.yaw)))
        for thing in plan("willowgarage").models
    ]
    office = tag("include", tag("uri", "model://willowgarage"))
    return world("An office floor with its furniture.", SUN, FLOOR, office, *things)


def files():
    """Name of each file, seen from this directory -> its text."""
    return {
        "stacks.world": stacks(),
        "friction_demo.world": friction_demo(),
        "rubble.world": rubble(),
        "mud.world": mud(),
        "camera.world": camera(),
        "elevator_ros.world": elevator(),
        "actor.world": actor(),
        "cafe.world": sdf_model.world_text(plan("cafe")),
        "willowgarage.world": willowgarage(),
        "../models/willowgarage/model.sdf": sdf_model.model_text(plan("willowgarage")),
        "../models/willowgarage/model.config": sdf_model.config_text(plan("willowgarage")),
    }


if __name__ == "__main__":
    for file, text in files().items():
        path = HERE / file
        path.parent.mkdir(exist_ok=True)
        path.write_text(text)
