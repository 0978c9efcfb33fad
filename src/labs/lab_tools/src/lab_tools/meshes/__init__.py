"""Solids from which the lab robots' meshes are drawn, and writers for STL and COLLADA.

Every solid is a `trimesh.Trimesh` in the unit of the drawing; axes are named "x", "y" or "z".
"""

from .files import save_dae, save_stl
from .solids import box, hull, mirrored, ring, rod, turned

__all__ = ["box", "hull", "mirrored", "ring", "rod", "save_dae", "save_stl", "turned"]
