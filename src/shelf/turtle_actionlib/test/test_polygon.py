"""Polygons are closed and regular; what cannot be drawn is refused."""

import math

import pytest
from turtle_actionlib.msg import ShapeAction, Velocity
from turtle_actionlib.polygon import Polygon, PolygonError

DT = 0.016


def test_md5():
    assert ShapeAction._md5sum == "d73b17d6237a925511f5d7727a1dc903"
    assert Velocity._md5sum == "9d5c2dcd348ac8f76ce2a4307bd63a13"


@pytest.mark.parametrize("edges", [3, 5, 8])
@pytest.mark.parametrize("late", [0, 3])
def test_corners(edges, late):
    """Whatever the delay between pose and command, the corners are those of the polygon."""
    polygon, x, y, theta, corners, commands = Polygon(edges, 1.3), 5.0, 5.0, 0.0, [], [(0.0, 0.0)] * late
    for _ in range(20000):
        if polygon.done:
            break
        before = polygon._edges
        commands.append(polygon.velocity(x, y, theta))
        if polygon._edges != before:
            corners.append((x, y))
        ahead, turn = commands.pop(0)
        theta = math.remainder(theta + turn * DT, 2 * math.pi)
        x, y = x + math.cos(theta) * ahead * DT, y + math.sin(theta) * ahead * DT
    assert len(corners) == edges and corners[-1] == pytest.approx((5, 5), abs=0.02)
    centre = [sum(values) / edges for values in zip(*corners)]
    assert [math.dist(corner, centre) for corner in corners] == pytest.approx([1.3] * edges, abs=0.02)


def test_result_of_a_square():
    polygon = Polygon(4, math.sqrt(2))
    assert (polygon.interior_angle, polygon.apothem) == pytest.approx((math.pi / 2, 1))


@pytest.mark.parametrize(
    "edges, radius, said",
    [(2, 1, "3 edges or more"), (-5, 1, "3 edges or more"), (5, 0, "above 0"), (5, math.nan, "above 0"), (5, math.inf, "above 0")],
)
def test_refused(edges, radius, said):
    with pytest.raises(PolygonError, match=said):
        Polygon(edges, radius)


def test_wall():
    polygon = Polygon(5, 1.3)
    with pytest.raises(PolygonError, match=r"stuck at x=11.09, y=3.00"):
        for _ in range(200):
            polygon.velocity(11.09, 3, 0)
