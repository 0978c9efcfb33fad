"""URDF and SDF to the records of :mod:`ode_sim.description.model`, by Gazebo Classic's rules.

======================  =================================================================
``load``                the functions below
``urdf``                URDF to SDF, as sdformat 9 converts it
``sdf``                 worlds of SDF; built on ``sdf_model``, ``sdf_shapes``, ``sdf_values``, ``sdf_frames``,
                        ``sdf_document``, ``sdf_oldest``, ``population``
``materials``           Gazebo's colours, OGRE material scripts
``finder``              ``model://``, ``package://``, Gazebo's search paths
``xmlsource``           XML elements that know their line
======================  =================================================================
"""

from ode_sim.description.finder import ResourceFinder
from ode_sim.description.load import Entity, load_world, read_light, read_model, read_sdf_model, read_urdf, root_kind
from ode_sim.description.model import DescriptionError, Problem

__all__ = [
    "DescriptionError",
    "Entity",
    "Problem",
    "ResourceFinder",
    "load_world",
    "read_light",
    "read_model",
    "read_sdf_model",
    "read_urdf",
    "root_kind",
]
