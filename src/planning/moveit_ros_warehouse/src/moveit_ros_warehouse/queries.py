"""Text files of start states and goals (``.queries``) beside those of scenes.

A scene's name; ``start``, the number of states and for each its name, lines ``joint = value`` and ``.``; ``goal``, the number
of goals and for each ``link_constraint``, its name, the link (or an empty line), ``xyz x y z``, ``rpy r p y`` and ``.``.
Metres and radians, in the model frame; r, p, y are turns about the moving axes x, y, z.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from geometry_msgs.msg import Pose
from moveit_msgs.msg import BoundingVolume, Constraints, OrientationConstraint, PositionConstraint, RobotState
from shape_msgs.msg import SolidPrimitive
from tf.transformations import euler_from_quaternion, quaternion_from_euler


@dataclass
class Queries:
    """What a file holds: joint values of start states, and goals: (link, xyz, rpy), by name."""

    scene: str
    starts: dict[str, dict[str, float]] = field(default_factory=dict)
    goals: dict[str, tuple[str, Sequence[float], Sequence[float]]] = field(default_factory=dict)


def write(queries: Queries) -> str:
    """``queries`` as the text of a file."""
    lines = [queries.scene]
    if queries.starts:
        lines += ["start", str(len(queries.starts))]
        for name, values in queries.starts.items():
            lines += [name, *(f"{joint} = {value:.9g}" for joint, value in values.items()), "."]
    if queries.goals:
        lines += ["goal", str(len(queries.goals))]
        for name, (link, xyz, rpy) in queries.goals.items():
            lines += ["link_constraint", name, link]
            lines += [f"{word} {' '.join(f'{value:.9g}' for value in numbers)}" for word, numbers in (("xyz", xyz), ("rpy", rpy))]
            lines.append(".")
    return "\n".join(lines) + "\n"


def read(text: str) -> Queries:
    """What ``text``, of a file, says.

    :raises ValueError: it is no file of queries; the line is named.
    """
    lines = [line.strip() for line in text.splitlines()]
    queries = Queries(lines[0] if lines else "")
    at = 1
    while at < len(lines):
        kind, at = lines[at], at + 1
        if not kind:
            continue
        if kind not in ("start", "goal"):
            raise ValueError(f"line {at}: '{kind[:40]}' stands where 'start' or 'goal' is expected")
        if at >= len(lines) or not lines[at].isdigit():
            raise ValueError(f"line {at + 1}: the number of {kind}s is expected")
        count, at = int(lines[at]), at + 1
        for _ in range(count):
            end = lines.index(".", at) if "." in lines[at:] else None
            if end is None:
                raise ValueError(f"line {at + 1}: a {kind} has no final '.'")
            (_start if kind == "start" else _goal)(queries, lines[at:end], at + 1)
            at = end + 1
    return queries


def _start(queries: Queries, lines: list[str], first: int) -> None:
    values = queries.starts.setdefault(lines[0] if lines else "", {})
    for number, line in enumerate(lines[1:], first + 1):
        joint, _, value = (part.strip() for part in line.partition("="))
        values[joint] = _floats([value], 1, number, line)[0]


def _goal(queries: Queries, lines: list[str], first: int) -> None:
    if len(lines) < 3 or lines[0] != "link_constraint":
        raise ValueError(f"line {first}: a goal begins with 'link_constraint', its name and its link, not '{' '.join(lines)[:40]}'")
    found = {}
    for number, line in enumerate(lines[3:], first + 3):
        word, *numbers = line.split()
        if word not in ("xyz", "rpy"):
            raise ValueError(f"line {number}: '{word[:20]}' stands where 'xyz' or 'rpy' is expected")
        found[word] = _floats(numbers, 3, number, line)
    if len(found) < 2:
        raise ValueError(f"line {first}: goal '{lines[1][:40]}' needs a line 'xyz x y z' and one 'rpy r p y'")
    queries.goals[lines[1]] = (lines[2], found["xyz"], found["rpy"])


def _floats(words: Iterable[str], count: int, number: int, line: str) -> list[float]:
    try:
        values = [float(word) for word in words]
    except ValueError:
        values = []
    if len(values) != count or not all(math.isfinite(value) for value in values):
        raise ValueError(f"line {number}: '{line[:40]}' should hold {count} numbers")
    return values


def goal_constraints(
    name: str, link: str, xyz: Sequence[float], rpy: Sequence[float], frame: str, tolerance: float = 1e-3, angle: float = 1e-2
) -> Constraints:
    """A goal ``name`` as constraints: ``link`` at ``xyz`` (m) turned by ``rpy`` (rad, about its own axes), in ``frame``.

    :param tolerance: radius about the place, m. :param angle: about each axis, rad. The defaults are upstream's.
    """
    region = BoundingVolume(primitives=[SolidPrimitive(SolidPrimitive.SPHERE, [tolerance])], primitive_poses=[Pose()])
    place = region.primitive_poses[0]
    place.position.x, place.position.y, place.position.z = xyz
    place.orientation.w = 1.0
    position = PositionConstraint(link_name=link, constraint_region=region, weight=1.0)
    turn = OrientationConstraint(
        link_name=link, absolute_x_axis_tolerance=angle, absolute_y_axis_tolerance=angle, absolute_z_axis_tolerance=angle, weight=1.0
    )
    turn.orientation.x, turn.orientation.y, turn.orientation.z, turn.orientation.w = quaternion_from_euler(*rpy, axes="rxyz")
    position.header.frame_id = turn.header.frame_id = frame
    return Constraints(name=name, position_constraints=[position], orientation_constraints=[turn])


def goal_of(constraints: Constraints):
    """(link, xyz, rpy) of ``constraints``, a goal, or None where it is none that a file can hold."""
    for position in constraints.position_constraints:
        turns = [entry for entry in constraints.orientation_constraints if entry.link_name == position.link_name]
        if turns and position.constraint_region.primitive_poses:
            at, turn = position.constraint_region.primitive_poses[0].position, turns[0].orientation
            rpy = euler_from_quaternion((turn.x, turn.y, turn.z, turn.w), axes="rxyz")
            return position.link_name, (at.x, at.y, at.z), rpy
    return None


def start_of(state: RobotState) -> dict[str, float]:
    """Joint values of a state."""
    return dict(zip(state.joint_state.name, state.joint_state.position))
