"""Inertia tensors as they are written, and those that are none."""

import pytest
from ode_sim.description.model import Inertial
from ode_sim.inertia import usable_inertia


def tensor(**moments):
    names = "ixx", "iyy", "izz", "ixy", "ixz", "iyz"
    return usable_inertia(Inertial(mass=2.0, **{name: moments.get(name, 0.0) for name in names}), 2.0, "link 'l'")


@pytest.mark.parametrize(
    "moments",
    [
        dict(ixx=0.3, iyy=0.3, ixy=0.3, izz=0.6),
        dict(ixx=0.2, iyy=0.2, izz=0.2, ixy=0.2, ixz=0.2, iyz=0.2),
        dict(),
        dict(ixx=-1, iyy=1, izz=1),
    ],
)
def test_a_tensor_that_is_not_positive_definite_is_gazebos_identity(moments):
    found, problem = tensor(**moments)
    assert found == (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    assert problem.startswith("link 'l': inertia is not positive definite")


def test_a_small_tensor_is_raised_without_a_word():
    found, problem = tensor(ixx=1e-12, iyy=1e-12, izz=1e-12)
    assert found == pytest.approx((2e-8, 2e-8, 2e-8, 0, 0, 0)) and problem is None


def test_absurd_tensors_are_taken_as_they_are():
    found, problem = tensor(ixx=1.5e8, iyy=1e8, izz=1e8, ixy=10.0)
    assert found == (1.5e8, 1e8, 1e8, 10.0, 0.0, 0.0) and problem is None
