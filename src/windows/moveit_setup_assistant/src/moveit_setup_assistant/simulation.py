"""A URDF made ready for simulation: inertia, transmissions, and the plugin that runs controllers."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable

import lenient_xml

from moveit_setup_assistant.configuration import Controller

_INTERFACES = {
    "effort_controllers": "hardware_interface/EffortJointInterface",
    "position_controllers": "hardware_interface/PositionJointInterface",
    "velocity_controllers": "hardware_interface/VelocityJointInterface",
}


def simulated_urdf(urdf: str, controllers: Iterable[Controller]) -> str:
    """The text ``urdf`` with what a simulator needs and it lacks; "" if it lacks nothing.

    Links with a shape to collide and no inertia get 0.1 kg and 0.03 kg m2 about each axis, which is MoveIt's choice; joints
    without a transmission get one, of the interface that their controller among ``controllers`` commands (effort if none does).
    """
    root = lenient_xml.fromstring(urdf)
    interfaces = _interfaces_of(controllers)
    changed = [_add_inertia(link) for link in root.findall("link") if link.find("collision") is not None]
    moved = {joint.get("name") for t in root.findall("transmission") for joint in t.findall("joint")}
    for joint in root.findall("joint"):
        name = joint.get("name") or ""
        if joint.get("type") in ("revolute", "continuous", "prismatic") and joint.find("mimic") is None and name not in moved:
            root.append(_transmission(name, interfaces.get(name, _INTERFACES["effort_controllers"])))
            changed.append(True)
    if not any("gazebo_ros_control" in (p.get("filename") or "") for p in root.iterfind("gazebo/plugin")):
        plugin = ET.SubElement(
            ET.SubElement(root, "gazebo"), "plugin", {"name": "gazebo_ros_control", "filename": "libgazebo_ros_control.so"}
        )
        ET.SubElement(plugin, "robotNamespace").text = "/"
        changed.append(True)
    if not any(changed):
        return ""
    ET.indent(root, "  ")
    return '<?xml version="1.0"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _interfaces_of(controllers: Iterable[Controller]) -> dict[str, str]:
    return {joint: _INTERFACES[c.type.split("/")[0]] for c in controllers if c.type.split("/")[0] in _INTERFACES for joint in c.joints}


def _add_inertia(link: ET.Element) -> bool:
    if link.find("inertial") is not None:
        return False
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "mass", {"value": "0.1"})
    ET.SubElement(inertial, "origin", {"xyz": "0 0 0", "rpy": "0 0 0"})
    ET.SubElement(inertial, "inertia", {"ixx": "0.03", "iyy": "0.03", "izz": "0.03", "ixy": "0", "ixz": "0", "iyz": "0"})
    return True


def _transmission(joint: str, interface: str) -> ET.Element:
    made = ET.Element("transmission", {"name": f"trans_{joint}"})
    ET.SubElement(made, "type").text = "transmission_interface/SimpleTransmission"
    for tag, name in (("joint", joint), ("actuator", f"{joint}_motor")):
        part = ET.SubElement(made, tag, {"name": name})
        ET.SubElement(part, "hardwareInterface").text = interface
    ET.SubElement(part, "mechanicalReduction").text = "1"
    return made
