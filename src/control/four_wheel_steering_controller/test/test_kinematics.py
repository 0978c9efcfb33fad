import math

import pytest
from four_wheel_steering_controller.kinematics import Axle, Base, axle_angle
from hypothesis import assume, given
from hypothesis import strategies as st

BASE = Base(steering_track=1.0, wheel_base=1.4, wheel_radius=0.2, y_offset=0.1)


def test_straight_on():
    front, rear = BASE.from_twist(2.0, 0.0)
    assert front == Axle(0.0, 0.0, 10.0, 10.0) and rear == front
    assert BASE.motion(front, rear) == pytest.approx((2.0, 0.0, 0.0))


def test_standing_wheels_do_not_turn():
    assert BASE.from_twist(0.0, 1.0) == (Axle(0.0, 0.0, 0.0, 0.0),) * 2
    assert BASE.from_steering(0.0, 0.3, -0.3)[0][2:] == (0.0, 0.0)


def test_a_turn_too_tight_steers_as_far_as_it_can():
    front, rear = BASE.from_twist(0.1, -1.0)
    assert front[:2] == (-math.pi / 2, -math.pi / 2) and rear[:2] == (math.pi / 2, math.pi / 2)


@given(st.floats(0.1, 3.0), st.sampled_from([1.0, -1.0]), st.floats(-1.0, 1.0))
def test_motion_undoes_a_twist(speed, direction, angular):
    assume(abs(angular) < 1.5 * speed)
    linear = direction * speed
    assert BASE.motion(*BASE.from_twist(linear, angular)) == pytest.approx((linear, 0.0, angular), abs=2e-3 * speed)


@given(st.floats(0.1, 3.0), st.floats(-0.6, 0.6), st.floats(-0.6, 0.6))
def test_wheel_axes_meet_in_one_point(speed, front_angle, rear_angle):
    """The turning centre that the angles of two wheels give is that of the other two."""
    assume(abs(math.tan(front_angle) - math.tan(rear_angle)) > 0.2)
    front, rear = BASE.from_steering(speed, front_angle, rear_angle)

    def centre(side, left_or_right):
        tangents = [math.tan(axle[left_or_right]) for axle in (front, rear)]
        distance = BASE.wheel_base / (tangents[0] - tangents[1])  # to the left of the wheels, m
        return side * 0.5 * BASE.steering_track + distance

    assert centre(1.0, 0) == pytest.approx(centre(-1.0, 1), rel=1e-6)


def test_crab_goes_sideways():
    front, rear = BASE.from_steering(1.0, 0.5, 0.5)
    assert front == rear == pytest.approx(Axle(0.5, 0.5, 5.0, 5.0))
    assert BASE.motion(front, rear) == pytest.approx((math.cos(0.5), math.sin(0.5), 0.0))


@pytest.mark.parametrize("front, rear", [(0.3, -0.3), (0.3, 0.0), (0.0, 0.3), (-0.4, 0.1)])
def test_motion_of_a_steering_command(front, rear):
    linear, lateral, angular = BASE.motion(*BASE.from_steering(1.0, front, rear))
    assert angular == pytest.approx((math.tan(front) - math.tan(rear)) / BASE.wheel_base, rel=0.02)
    assert linear == pytest.approx(1.0, rel=0.02)
    assert lateral == pytest.approx(0.5 * (math.tan(front) + math.tan(rear)), abs=0.02)


@given(st.floats(-1.2, 1.2))
def test_axle_angle_lies_between_those_of_its_wheels(angle):
    front, _ = BASE.from_steering(1.0, angle, 0.0)
    assume(abs(angle) > 0.01 and abs(abs(math.tan(angle)) * 0.5 - BASE.wheel_base) > 0.1)
    assert math.tan(axle_angle(front)) == pytest.approx(math.tan(angle), rel=1e-6)
