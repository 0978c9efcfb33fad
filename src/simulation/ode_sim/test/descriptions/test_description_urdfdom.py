"""A fault of a URDF costs what it costs in urdfdom: Debian's library is asked about every attribute (read_by_urdfdom.cpp).

Two rules are our own (docs/differences.md): what stands behind a fault in the same link is read, and a mass counts although the place of
its centre is at fault.
"""

import copy
import json
import os
import subprocess
import xml.etree.ElementTree as ET

import pytest
from ode_sim.description import DescriptionError, ResourceFinder, read_urdf

FINDER = ResourceFinder(environment=False, stock="/nowhere", package_path=lambda name: None)
ROBOT = """<robot name="cart" version="1.0">
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="tool">
    <inertial><origin xyz="0 0 0.1" rpy="0 0 0"/><mass value="2"/><inertia ixx="3" ixy="0" ixz="0" iyy="3" iyz="0" izz="3"/></inertial>
    <visual><origin xyz="0 0 0.1" rpy="0 0 0"/><geometry><box size="1 2 3"/></geometry>
      <material name="blue"><color rgba="0 0 1 1"/></material></visual>
    <collision><origin xyz="0 0 0.1" rpy="0 0 0"/><geometry><cylinder radius="1" length="2"/></geometry></collision>
  </link>
  <link name="ball">
    <inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry><mesh filename="package://none/a.stl" scale="1 1 1"/></geometry></visual>
    <collision><geometry><sphere radius="1"/></geometry></collision>
  </link>
  <joint name="turn" type="revolute"><origin xyz="0 0 1" rpy="0 0 0"/><parent link="base"/><child link="tool"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="5" velocity="6"/><dynamics damping="0.5" friction="0.25"/>
    <safety_controller soft_lower_limit="-1" soft_upper_limit="1" k_position="1" k_velocity="1"/>
    <calibration rising="0" falling="1"/></joint>
  <joint name="roll" type="continuous"><parent link="tool"/><child link="ball"/><mimic joint="turn" multiplier="2" offset="0.5"/></joint>
</robot>"""
VALUES = [
    "",
    " ",
    "abc",
    "nan",
    "inf",
    "-inf",
    "0x10",
    "5m",
    "1e",
    "1e400",
    "1e-400",
    "1,5",
    "1,5 0,2 0,1",
    "1 2",
    "1 2 3",
    "1 2 3 4",
    " 1",
    "1 ",
    "+1",
    ".5",
    "1.",
    ".",
    "--1",
    "1e3",
    "-2",
    "1_0",
    "\u0663",
    "1 2 x",
]
NAMES = {"name", "filename", "link", "type", "joint", "version"}
#: leniencies that are meant, beside those above: one number for the scale of a mesh, white space around a word, and names
#: that urdfdom takes and Gazebo's SDF does not.
MEANT = {("mesh", "scale"), ("link", "name"), ("joint", "name"), ("robot", "name")}


def program():
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(":"):
        path = os.path.join(prefix, "lib/ode_sim/read_by_urdfdom")
        if os.path.isfile(path):
            return path
    pytest.fail("read_by_urdfdom is not built: liburdfdom-dev is missing, or the package was built without tests")


def asked(texts):
    given = b"".join(text.encode() + b"\0" for text in texts)
    said = subprocess.run([program()], input=given, capture_output=True, timeout=60, check=True)
    return [json.loads(line) for line in said.stdout.splitlines()]


def variants(tag):
    """(what, text): every attribute of the elements of that tag with every value and without it, every child left out and doubled."""
    root = ET.fromstring(ROBOT)
    for number, element in enumerate(root.iter(tag)):
        for key in element.keys():
            for value in [None, *VALUES]:
                if (element.tag, key) in MEANT:
                    continue
                changed = copy.deepcopy(root)
                target = list(changed.iter(tag))[number]
                target.attrib.pop(key) if value is None else target.set(key, value)
                yield f"{tag}[{number}] {key}={value!r}", ET.tostring(changed, "unicode")
        for i in range(len(element)):
            for times in (0, 2):
                changed = copy.deepcopy(root)
                target = list(changed.iter(tag))[number]
                part = target[i]
                if times:
                    target.append(copy.deepcopy(part))
                else:
                    target.remove(part)
                yield f"{tag}[{number}]/{part.tag}[{i}] {times} times", ET.tostring(changed, "unicode")


def difference(text, theirs):
    """What we read otherwise than urdfdom, '' for nothing."""
    try:
        model, problems = read_urdf(text, finder=FINDER)
    except DescriptionError as error:
        assert "\n" not in str(error) and error.source.line, error
        gazebos = "has no link with a mass" in str(error) or "already; a robot must be a tree" in str(error)
        return "" if theirs is None or gazebos else f"refused: {error}"
    if theirs is None:
        return "not refused"
    lost = [p for p in problems if "none/a.stl" not in p.message]
    assert len({p.source.line for p in lost}) <= 1 and all(p.source.line for p in lost), lost
    links = {link.name: link for link in model.links}
    for name, link in theirs["links"].items():
        inertial, mine = link["inertial"], links.get(name)
        if inertial[0] <= 0.0:
            if mine is None or lost and "origin" in str(lost[0]):
                continue
            return f"{name} has no mass"
        if mine is None:
            if name == "ball" and theirs["links"]["tool"]["inertial"][0] <= 0.0:
                continue
            return f"{name} is not there"
        i = mine.inertial
        if [i.mass, i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz, *i.pose.p] != pytest.approx(inertial):
            return f"{name}: {i} {inertial}"
        for kind in ("visuals", "collisions"):
            read = len(getattr(mine, kind))
            if read != link[kind] and not (lost and (read > link[kind] or "must be positive" in str(lost[0]))):
                return f"{name}: {read} {kind}, {link[kind]}"
    for joint in model.joints:
        says = theirs["joints"][joint.name]
        if "mimic" in says and joint.mimic is not None and [joint.mimic.multiplier, joint.mimic.offset] != says["mimic"]:
            return f"{joint.name}: {joint.mimic} {says}"
        if "limit" in says and joint.urdf_type == "revolute":
            axis = joint.axes[0]
            if [*sorted(says["limit"][:2]), *says["limit"][2:]] != [axis.lower, axis.upper, axis.effort, axis.velocity]:
                return f"{joint.name}: {axis} {says}"
    return ""


@pytest.mark.parametrize(
    "tag",
    [
        "robot",
        "link",
        "joint",
        "inertial",
        "mass",
        "inertia",
        "origin",
        "visual",
        "collision",
        "geometry",
        "box",
        "cylinder",
        "sphere",
        "mesh",
        "material",
        "axis",
        "limit",
        "safety_controller",
        "calibration",
        "dynamics",
        "mimic",
        "parent",
        "child",
    ],
)
def test_a_fault_costs_what_it_costs_in_urdfdom(tag):
    cases = dict(variants(tag))
    wrong = [f"{what}: {said}" for (what, text), theirs in zip(cases.items(), asked(cases.values())) if (said := difference(text, theirs))]
    assert cases and not wrong, "\n".join(wrong[:20])
