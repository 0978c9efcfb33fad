"""Bodies of one simple shape, as Gazebo's window inserts them."""

from __future__ import annotations

from ode_sim.description import model as d
from ode_sim.math3 import Pose

Simple = d.Box | d.Sphere | d.Cylinder  # what the window inserts and gives other sizes
_GREY = d.Material("Gazebo/Grey")


def shape_model(name: str, shape: Simple, mass: float = 1.0) -> d.Model:
    """A grey body ``name`` of one link named ``link``, as Gazebo's window inserts it: ``mass`` kg, inertia of the full ``shape``."""
    if isinstance(shape, d.Sphere):
        moment = 0.4 * mass * shape.radius**2
        moments = (moment, moment, moment)
    elif isinstance(shape, d.Cylinder):
        side = mass * (3 * shape.radius**2 + shape.length**2) / 12
        moments = (side, side, 0.5 * mass * shape.radius**2)
    else:
        x, y, z = (v * v * mass / 12 for v in shape.size)
        moments = (y + z, x + z, x + y)
    inertial = d.Inertial(mass, ixx=moments[0], iyy=moments[1], izz=moments[2])
    link = d.Link(
        "link",
        inertial=inertial,
        collisions=(d.Collision("collision", Pose(), shape),),
        visuals=(d.Visual("visual", Pose(), shape, _GREY),),
    )
    return d.Model(name, links=(link,))
