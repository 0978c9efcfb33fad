import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from joint_trajectory_controller._sampler import position_error, turns_to_add
from joint_trajectory_controller.segment import Segment, State, active_index, stop_segment

numbers = st.floats(-10.0, 10.0)


def test_positions_alone_give_a_line():
    segment = Segment(1.0, State(2.0), 3.0, State(6.0))
    assert segment.sample(1.0) == (2.0, 2.0, 0.0)
    assert segment.sample(2.0) == (4.0, 2.0, 0.0)
    assert segment.sample(3.0) == (6.0, 2.0, 0.0)


def test_positions_and_accelerations_without_velocities_give_a_line():
    segment = Segment(0.0, State(0.0, None, 5.0), 2.0, State(4.0, None, 5.0))
    assert segment.sample(1.0) == (2.0, 2.0, 0.0)


@given(numbers, numbers, numbers, numbers, st.floats(0.1, 10.0))
def test_velocities_give_a_cubic_through_both_ends(p0, v0, p1, v1, duration):
    segment = Segment(3.0, State(p0, v0), 3.0 + duration, State(p1, v1))
    assert segment.sample(3.0)[:2] == pytest.approx((p0, v0), abs=1e-6)
    assert segment.sample(segment.end)[:2] == pytest.approx((p1, v1), abs=1e-6)
    assert segment.coefficients[4:] == (0.0, 0.0)


@given(numbers, numbers, numbers, numbers, numbers, numbers, st.floats(0.1, 10.0))
def test_accelerations_give_a_quintic_through_both_ends(p0, v0, a0, p1, v1, a1, duration):
    segment = Segment(0.0, State(p0, v0, a0), duration, State(p1, v1, a1))
    assert segment.sample(0.0) == pytest.approx((p0, v0, a0), abs=1e-6)
    assert segment.sample(duration) == pytest.approx((p1, v1, a1), abs=1e-5)


def test_an_end_without_acceleration_lowers_the_order():
    assert Segment(0.0, State(0.0, 0.0, 1.0), 1.0, State(1.0, 0.0)).sample(0.0)[2] == 6.0  # the cubic, not 1.0


def test_derivatives_agree_with_difference_quotients():
    segment = Segment(0.0, State(1.0, -2.0, 3.0), 2.0, State(-1.0, 0.5, 4.0))
    h = 1e-6
    for time in (0.3, 1.0, 1.7):
        before, here, after = (segment.sample(time + d) for d in (-h, 0.0, h))
        assert here[1] == pytest.approx((after[0] - before[0]) / (2 * h), abs=1e-6)
        assert here[2] == pytest.approx((after[1] - before[1]) / (2 * h), abs=1e-6)


def test_rests_outside_its_time():
    segment = Segment(1.0, State(2.0, 5.0), 2.0, State(3.0, 7.0))
    assert segment.sample(0.9) == (2.0, 0.0, 0.0)
    assert segment.sample(2.1) == (3.0, 0.0, 0.0)


def test_segment_that_ends_before_it_starts_is_refused():
    with pytest.raises(ValueError):
        Segment(1.0, State(0.0), 0.9, State(0.0))


@given(st.floats(-20.0, 20.0), st.floats(-20.0, 20.0))
def test_errors_of_angles_end_at_the_same_angle(start, end):
    distance = position_error(start, end, True)
    assert -math.pi - 1e-9 < distance <= math.pi + 1e-9
    assert math.remainder(start + distance - end, 2 * math.pi) == pytest.approx(0.0, abs=1e-9)


def test_active_segment_is_the_last_that_has_started():
    segments = [Segment(t, State(0.0), t + 1.0, State(0.0)) for t in (0.0, 1.0, 2.0)]
    assert [active_index(segments, t) for t in (-0.1, 0.0, 0.9, 1.0, 5.0)] == [-1, 0, 0, 1, 2]


def test_stop_without_duration_rests_where_it_is():
    assert stop_segment(2.0, 0.5, 3.0, 0.0, None, ()).sample(2.0) == (0.5, 0.0, 0.0)


@pytest.mark.parametrize("velocity", [1.5, -0.3, 0.0])
def test_stop_ramp_comes_to_rest_without_turning_back(velocity):
    duration = 0.8
    segment = stop_segment(1.0, 2.0, velocity, duration, None, ())
    assert segment.sample(1.0) == pytest.approx((2.0, velocity, 0.0))
    end = segment.sample(1.0 + duration)
    assert end[0] == pytest.approx(2.0 + 0.625 * velocity * duration)
    assert end[1] == pytest.approx(0.0, abs=1e-12)
    assert end[2] == pytest.approx(-1.5 * velocity / duration)
    assert segment.sample(1.0 + duration + 1e-3) == pytest.approx((end[0], 0.0, 0.0))
    for step in range(101):
        assert segment.sample(1.0 + duration * step / 100)[1] * velocity >= -1e-12
