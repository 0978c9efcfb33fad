"""Widths and angles, on paper: opening = pad_width + 2 finger_length sin(angle)."""

import math

import pytest
from arbotix_controllers.grippers import Jaw, Linkage, OutOfReach, Swinging, Table

TWO = Swinging((Jaw("l", 0.1), Jaw("r", -0.2, invert=True)), pad_width=0.01, finger_length=0.04, max_opening=0.08)


@pytest.mark.parametrize("opening, angle", [(0.01, 0.0), (0.05, math.pi / 6), (0.0, math.asin(-0.125))])
def test_two_fingers_swing_against_each_other(opening, angle):
    told = TWO.command(opening)
    assert told == pytest.approx({"l": 0.1 + angle, "r": -0.2 - angle})
    assert TWO.opening(told) == pytest.approx(opening)


@pytest.mark.parametrize(
    "gripper, opening, said",
    [
        (TWO, 0.081, "0.081 m is not within 0 to 0.08 m"),
        (TWO, -0.001, "is not within"),
        (Swinging((Jaw("l"),), finger_length=0.02), 0.06, "fingers of 0.02 m open by -0.03 to 0.05 m, not by 0.06 m"),
        (Table("g"), 0.05, "is not within 0 to 0.042 m"),
    ],
)
def test_what_cannot_be_is_said(gripper, opening, said):
    with pytest.raises(OutOfReach, match=said):
        gripper.command(opening)


def test_a_linkage_is_a_straight_line():
    gripper = Linkage("g", center=0.5, scale=-20.0)
    assert gripper.command(0.03) == pytest.approx({"g": -0.1}) and gripper.opening({"g": -0.1}) == pytest.approx(0.03)


def test_a_table_is_met_at_its_points_and_halfway_between():
    gripper = Table("g")
    for opening, position in gripper.points:
        assert gripper.command(opening)["g"] == pytest.approx(position)
    middle = gripper.command((0.0159 + 0.0254) / 2)["g"]
    assert middle == pytest.approx((1.2167 + 0.8997) / 2) and gripper.opening({"g": middle}) == pytest.approx((0.0159 + 0.0254) / 2)
