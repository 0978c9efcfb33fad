"""Angles of servos one on the other: the orientation that these make by definition, a turn after the other, is taken apart again."""

import math

import pytest
from gazebo_plugins.hector_servo import angles
from ode_sim import math3


def turned(axes, values):
    """The quaternion of turns about axes that go along with those before them."""
    q = (0.0, 0.0, 0.0, 1.0)
    for axis, value in zip(axes, values):
        half = [0.0, 0.0, 0.0]
        half["xyz".index(axis)] = math.sin(value / 2)
        q = math3.quat_multiply(q, (*half, math.cos(value / 2)))
    return q


@pytest.mark.parametrize("axes", ["zyx", "zy", "xyz", "xy", "y"])
@pytest.mark.parametrize("values", [(0.0, 0.0, 0.0), (0.7, -0.4, 1.2), (-2.5, 1.4, 0.3)])
def test_they_are_those_that_made_it(axes, values):
    wanted = values[: len(axes)] if axes != "y" else values[1:2]
    assert angles(turned(axes, wanted), axes) == pytest.approx(wanted)


def test_straight_up_is_no_error():
    assert angles((0.0, math.sqrt(0.5) * (1 + 1e-12), 0.0, math.sqrt(0.5)), "y") == pytest.approx([math.pi / 2])
