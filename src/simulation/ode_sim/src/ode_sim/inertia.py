"""Masses and inertia tensors that a rigid-body engine can take, as near as possible to those written."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from ode_sim.description.model import Inertial
from ode_sim.math3 import quat_to_matrix

if TYPE_CHECKING:
    from ode_sim._core import _Inertia

SMALLEST_MASS = 1e-6  # kg
SMALLEST_GYRATION = 1e-4  # m, radius of gyration below which a body spins up without bound
LARGEST_MASS = 1e15  # kg; the sums and products of larger ones would overflow
LARGEST_MOMENT = 1e40  # kg m^2
UNTOLD_MOMENT = 1.0  # kg m^2, where a tensor tells none (dBodySetMass: the inverse is the identity)
_SINGULAR = 1e-12  # of the largest moment: what rounding leaves of 0


def usable_mass(mass: float, where: str) -> tuple[float, str | None]:
    """``mass`` in kg, as it can be simulated, and what was wrong with it, a line that begins with ``where``, or None."""
    if SMALLEST_MASS <= mass <= LARGEST_MASS:
        return float(mass), None
    if math.isfinite(mass) and mass > LARGEST_MASS:
        return LARGEST_MASS, f"{where}: mass {mass:g} kg is too large to simulate; {LARGEST_MASS:g} is used"
    if math.isfinite(mass) and mass > 0.0:
        return SMALLEST_MASS, f"{where}: mass {mass} kg is too small to simulate; {SMALLEST_MASS} is used"
    return 1.0, f'{where}: mass {mass} is no positive number; 1 kg is used. Write <mass value="..."/> in kg'


def usable_inertia(inertial: Inertial, mass: float, where: str) -> tuple[_Inertia, str | None]:
    """ixx, iyy, izz, ixy, ixz, iyz in link axes about the centre of mass (kg m^2), positive definite, and a problem if any.

    A tensor up to :data:`LARGEST_MOMENT` is taken as it is, its moments raised to the smallest that a body of this mass may have.
    One that is not positive definite becomes :data:`UNTOLD_MOMENT` about every axis: so does ODE in Gazebo, and arms whose tensors
    were miscalculated stand there.

    :param inertial: as written. :param mass: of the body, kg, usable. :param where: begins the line of a problem.
    """
    tensor = np.array(
        [
            [inertial.ixx, inertial.ixy, inertial.ixz],
            [inertial.ixy, inertial.iyy, inertial.iyz],
            [inertial.ixz, inertial.iyz, inertial.izz],
        ],
        dtype=float,
    )
    problem = None
    if not (np.abs(tensor) <= LARGEST_MOMENT).all():
        what = f"a moment beyond {LARGEST_MOMENT:g} kg m^2" if np.isfinite(tensor).all() else "a NaN or an infinity"
        tensor = np.eye(3) * mass * 0.01
        problem = f"{where}: inertia holds {what}; {mass * 0.01:g} kg m^2 is used"
    moments, axes = np.linalg.eigh(tensor)
    least = max(mass * SMALLEST_GYRATION**2, moments[-1] * 1e-9)
    if moments[0] <= _SINGULAR * moments[-1]:
        tensor = np.eye(3) * UNTOLD_MOMENT
        problem = (
            f"{where}: inertia is not positive definite, its moments are {moments.round(9).tolist()}; {UNTOLD_MOMENT:g} kg m^2 "
            "about every axis is used, as Gazebo does"
        )
    elif moments[0] < least:
        tensor = axes @ np.diag(np.maximum(moments, least)) @ axes.T
    rotation = np.array(quat_to_matrix(inertial.pose.q))
    if inertial.pose.q != (0.0, 0.0, 0.0, 1.0):
        tensor = rotation @ tensor @ rotation.T
    return (tensor[0, 0], tensor[1, 1], tensor[2, 2], tensor[0, 1], tensor[0, 2], tensor[1, 2]), problem
