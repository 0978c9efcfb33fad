"""Where limits come from."""

import math

import pytest
from joint_limits_interface import (
    DescriptionError,
    JointDescription,
    JointLimits,
    SoftJointLimits,
    distance_within_limits,
    limits_from_urdf,
    normalize_angle,
    read_joints,
    shortest_angular_distance,
    soft_limits_from_urdf,
)

URDF = """<robot name="r">
  <joint name="rev" type="revolute"><limit lower="-1" upper="2" velocity="3" effort="4"/>
    <safety_controller soft_lower_limit="-0.5" soft_upper_limit="1.5" k_position="10" k_velocity="20"/></joint>
  <joint name="pri" type="prismatic"><limit upper="0.2" velocity="1" effort="2"/></joint>
  <joint name="con" type="continuous"><limit velocity="5" effort="6"/></joint>
  <joint name="fix" type="fixed"/>
</robot>"""


def test_from_urdf():
    joints = read_joints(URDF)
    rev = limits_from_urdf(joints["rev"])
    assert rev == JointLimits(
        min_position=-1.0,
        max_position=2.0,
        max_velocity=3.0,
        max_effort=4.0,
        has_position_limits=True,
        has_velocity_limits=True,
        has_effort_limits=True,
    )
    pri = limits_from_urdf(joints["pri"])
    assert (pri.min_position, pri.max_position, pri.has_position_limits) == (0.0, 0.2, True)
    con = limits_from_urdf(joints["con"])
    assert (con.has_position_limits, con.angle_wraparound, con.max_velocity) == (False, True, 5.0)
    assert limits_from_urdf(joints["fix"]) is None


def test_urdf_clears_acceleration_and_keeps_jerk():
    before = JointLimits(has_acceleration_limits=True, max_acceleration=1.0, has_jerk_limits=True, max_jerk=2.0)
    after = limits_from_urdf(read_joints(URDF)["rev"], before)
    assert not after.has_acceleration_limits and after.has_jerk_limits and after.max_jerk == 2.0


def test_soft_from_urdf():
    joints = read_joints(URDF)
    assert soft_limits_from_urdf(joints["rev"]) == SoftJointLimits(-0.5, 1.5, 10.0, 20.0)
    assert soft_limits_from_urdf(joints["pri"]) is None


def test_bad_urdf():
    with pytest.raises(DescriptionError, match="no valid XML"):
        read_joints("<robot>")
    with pytest.raises(DescriptionError, match="joint 'j'.*velocity=\"fast\""):
        read_joints('<robot><joint name="j" type="revolute"><limit velocity="fast"/></joint></robot>')
    for bad in ("nan", "inf", "1_0", "1 m", "1,5", "1e400", ""):  # none is a number for urdfdom
        with pytest.raises(DescriptionError, match="is no number"):
            read_joints(f'<robot><joint name="j" type="revolute"><limit velocity="{bad}"/></joint></robot>')
    assert read_joints('<robot><joint name="a & b" type="fixed"/></robot>').keys() == {"a  b"}  # as TinyXML reads it


def test_an_infinite_angle_is_no_number():
    assert math.isnan(normalize_angle(math.inf))
    assert math.isnan(JointDescription("j", "continuous").error(0.0, math.inf))


def test_angles():
    assert normalize_angle(3 * math.pi) == pytest.approx(math.pi)
    assert normalize_angle(-math.pi) == math.pi
    assert shortest_angular_distance(3.0, -3.0) == pytest.approx(2 * math.pi - 6.0)
    # the short way leads through the limit, so the long one is taken
    assert distance_within_limits(3.0, -3.0, -3.1, 3.1) == pytest.approx(-6.0)
    # limits that span several turns: the short way
    assert distance_within_limits(3.0, -3.0, -10.0, 10.0) == pytest.approx(2 * math.pi - 6.0)
    assert distance_within_limits(0.0, 0.0, -1.0, 1.0) == 0.0


def test_position_error_of_each_kind():
    joints = read_joints(URDF)
    assert joints["con"].error(3.0, -3.0) == pytest.approx(2 * math.pi - 6.0)
    assert joints["pri"].error(0.0, 7.0) == 7.0
    assert joints["rev"].clamp(9.0) == 2.0 and joints["con"].clamp(9.0) == 9.0
