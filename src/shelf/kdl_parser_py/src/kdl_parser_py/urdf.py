"""A PyKDL.Tree of a robot. Each function returns (whether all links are in it, the tree)."""

from __future__ import annotations

import sys
from typing import Any

import PyKDL
from urdf_parser_py.urdf import URDF, Joint, Pose

_TURNS, _SLIDES = ("revolute", "continuous"), ("prismatic",)


def treeFromFile(filename: str) -> tuple[bool, PyKDL.Tree]:
    """Of the file ``filename``. :raises urdf_parser_py.xml_reflection.ParseError, OSError: what cannot be read"""
    return treeFromUrdfModel(URDF.from_xml_file(filename))


def treeFromParam(param: str) -> tuple[bool, PyKDL.Tree]:
    """Of the URDF in the parameter ``param``. :raises KeyError: there is no such parameter"""
    return treeFromUrdfModel(URDF.from_parameter_server(param))


def treeFromString(xml: str) -> tuple[bool, PyKDL.Tree]:
    """Of ``xml``, the URDF's text. :raises urdf_parser_py.xml_reflection.ParseError: what cannot be read"""
    return treeFromUrdfModel(URDF.from_xml_string(xml))


def treeFromUrdfModel(robot_model: URDF, quiet: bool = False) -> tuple[bool, PyKDL.Tree]:
    """Of ``robot_model``. :param quiet: not a word about an inertia of the root link, which KDL leaves out"""
    root = robot_model.get_root()
    if robot_model.link_map[root].inertial and not quiet:
        print(f"The root link {root} has an inertia, which KDL leaves out: give it a massless parent link if it matters", file=sys.stderr)
    tree = PyKDL.Tree(root)
    waiting = list(robot_model.child_map.get(root, []))
    for joint, child in waiting:
        described = robot_model.joint_map[joint]
        if child not in robot_model.link_map:
            return False, tree
        segment = PyKDL.Segment(child, _joint(described), _frame(described.origin), _inertia(robot_model.link_map[child].inertial))
        if not tree.addSegment(segment, described.parent):
            return False, tree
        waiting += robot_model.child_map.get(child, [])
    return True, tree


def _frame(pose: Any) -> PyKDL.Frame:
    pose = pose or Pose()
    return PyKDL.Frame(PyKDL.Rotation.RPY(*(pose.rpy or (0, 0, 0))), PyKDL.Vector(*(pose.xyz or (0, 0, 0))))


def _joint(joint: Joint) -> PyKDL.Joint:
    origin, axis = _frame(joint.origin), PyKDL.Vector(*(joint.axis or (1, 0, 0)))
    if joint.type in _TURNS:
        return PyKDL.Joint(joint.name, origin.p, origin.M * axis, PyKDL.Joint.RotAxis)
    if joint.type in _SLIDES:
        return PyKDL.Joint(joint.name, origin.p, origin.M * axis, PyKDL.Joint.TransAxis)
    return PyKDL.Joint(joint.name, PyKDL.Joint.Fixed)


def _inertia(inertial: Any) -> PyKDL.RigidBodyInertia:
    """URDF gives the moments about the centre of mass in the inertial frame, KDL wants them in the link's."""
    if inertial is None:
        return PyKDL.RigidBodyInertia(0)
    frame, inertia = _frame(inertial.origin), inertial.inertia
    moments = (inertia.ixx, inertia.iyy, inertia.izz, inertia.ixy, inertia.ixz, inertia.iyz) if inertia else (0,) * 6
    return frame.M * PyKDL.RigidBodyInertia(inertial.mass, frame.M.Inverse() * frame.p, PyKDL.RotationalInertia(*moments))
