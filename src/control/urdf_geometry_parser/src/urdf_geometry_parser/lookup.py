"""The robot description on the parameter server."""

from __future__ import annotations

import rospy

from .geometry import GeometryError, RobotGeometry


def robot_geometry(root_nh, search: bool = True) -> RobotGeometry:
    """The robot in the parameter ``robot_description``.

    :param root_nh: controller_interface.NodeHandle of the robot's namespace
    :param search: also look in the namespaces above
    :raises GeometryError: no such parameter, or no URDF in it
    """
    name = root_nh.resolve("robot_description")
    if search and not rospy.has_param(name):
        name = root_nh.search_param("robot_description") or name
    text = rospy.get_param(name, None)
    if not isinstance(text, str):
        found = "not set" if text is None else f"a {type(text).__name__}"
        raise GeometryError(f"parameter {name} must hold the robot's URDF, it is {found}; load it first")
    return RobotGeometry(text, name)
