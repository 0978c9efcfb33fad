"""A robot model as text, in the layout of upstream's ``RobotModel::printModelInfo``."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator

import motion
import numpy as np

_TYPES = {"continuous": "Revolute"}  # upstream's name where it is not the one of the URDF
Format = Callable[[float], str]


def model_text(model: motion.RobotModel, solved: Collection[str] = ()) -> str:
    """Joints, links and groups of ``model``.

    :param solved: the groups that have a solver of inverse kinematics.
    """
    lines = [f"Model {model.name} in frame {model.frame}, using {len(model.variables)} variables", "Joints: "]
    for index, name in enumerate(model.joints):
        lines += _joint(model.joint(name), index)
    lines += ["", "Links: "]
    for name in model.links:
        lines += _link(model, model.link(name))
    lines.append("Available groups: ")
    for name in model.groups:
        lines += [*_group(model, name, name in solved), ""]
    return "\n".join(lines)


def _type(joint) -> str:
    return _TYPES.get(joint.type, joint.type.capitalize())


def _joint(joint, index: int) -> Iterator[str]:
    count = len(joint.variables)
    yield f" '{joint.name}' ({_type(joint)})"
    yield f"  * Joint Index: {index}"
    yield f"  * {count} variable{'s' if count != 1 else ''}{':' if count else ''}"
    for offset, (variable, limits) in enumerate(zip(joint.variables, joint.limits)):
        mimic = f", mimic '{joint.mimic[0]}'" if joint.mimic else ""
        passive = ", passive" if joint.passive else ""
        yield f"     * '{variable}', index {joint.variable_index + offset} in full state{mimic}{passive}"
        yield f"        {_bounds(limits, '{:.5f}'.format)}"


def _bounds(limits, number: Format) -> str:
    speed = limits.max_velocity if limits.has_velocity else 0.0
    push = limits.max_acceleration if limits.has_acceleration else 0.0
    ranges = (
        ("P", limits.has_position, limits.min_position, limits.max_position),
        ("V", limits.has_velocity, -speed if speed else 0.0, speed),
        ("A", limits.has_acceleration, -push if push else 0.0, push),
    )
    return " ".join(f"{kind}.{'' if held else 'un'}bounded [{number(low)}, {number(high)}];" for kind, held, low, high in ranges)


def _link(model: motion.RobotModel, link) -> Iterator[str]:
    yield f" '{link.name}' with {len(link.shapes)} geoms"
    joint = model.joint(link.parent_joint)
    if joint.type == "fixed":
        yield "   * parent joint is fixed"
    if np.allclose(motion.Pose(*joint.origin).matrix(), np.eye(4), rtol=0.0, atol=1e-12):
        yield "   * joint origin transform is identity"


def _group(model: motion.RobotModel, name: str, solved: bool) -> Iterator[str]:
    group = model.group(name)
    joints = [model.joint(one) for one in group.joints]
    rows = [(joint, i) for joint in joints for i in range(len(joint.variables))]
    yield f"Group '{name}' using {len(rows)} variables"
    yield "  * Joints:"
    yield from (f"    '{joint.name}' ({_type(joint)})" for joint in joints)
    yield "  * Variables:"
    for own, (joint, i) in enumerate(rows):
        mimic = f", mimic '{joint.mimic[0]}'" if joint.mimic else ""
        yield f"    '{joint.variables[i]}', index {joint.variable_index + i} in full state, index {own} in group state{mimic}"
        yield f"        {_bounds(joint.limits[i], '{:g}'.format)}"
    indices = [joint.variable_index + i for joint, i in rows]
    together = all(after == before + 1 for before, after in zip(indices, indices[1:]))
    yield "  * Variables Index List:"
    yield f"    {''.join(f'{index} ' for index in indices)}({'contiguous' if together else 'non-contiguous'})"
    if solved:
        yield "  * Kinematics solver bijection:"
        yield "    " + "".join(f"{own} " for own, (joint, _) in enumerate(rows) if not joint.mimic)
    places = {joint.variables[0]: own for own, (joint, i) in enumerate(rows) if i == 0}
    followers = [joint for joint in joints if joint.mimic and joint.mimic[0] in group.joints]
    if followers:
        yield "  * Local Mimic Updates:"
    for joint in followers:
        leader, factor, offset = joint.mimic
        yield f"    [{places[joint.variables[0]]}] = {factor:g} * [{places[model.joint(leader).variables[0]]}] + {offset:g}"
