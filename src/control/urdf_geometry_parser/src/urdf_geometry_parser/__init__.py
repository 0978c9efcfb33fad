"""What controllers want to know from a URDF: joint types, distances between joints, radii of wheels."""

from .geometry import GeometryError, RobotGeometry, UrdfJoint
from .lookup import robot_geometry

__all__ = ["GeometryError", "RobotGeometry", "UrdfJoint", "robot_geometry"]
