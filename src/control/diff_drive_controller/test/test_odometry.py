import math

import pytest

from diff_drive_controller.odometry import PlanarOdometry, RollingMean, WheelTravel, differential


def pose(odometry):
    return odometry.x, odometry.y, odometry.heading


def test_straight_on():
    odometry = PlanarOdometry(1)
    for step in range(1, 11):
        odometry.travelled(0.1, 0.0, 0.1 * step)
    assert pose(odometry) == pytest.approx((1.0, 0.0, 0.0))
    assert (odometry.linear, odometry.angular) == pytest.approx((1.0, 0.0))


@pytest.mark.parametrize("steps", [1, 7, 1000])
def test_arcs_are_exact_whatever_the_step(steps):
    odometry = PlanarOdometry(1)
    for step in range(1, steps + 1):
        odometry.travelled(math.pi / steps, math.pi / 2 / steps, step / steps)
    assert pose(odometry) == pytest.approx((2.0, 2.0, math.pi / 2))


def test_arc_and_straight_agree_where_they_meet():
    arc, straight = PlanarOdometry(1), PlanarOdometry(1)
    arc.travelled(1.0, 1.0001e-6, 1.0)
    straight.travelled(1.0, 0.9999e-6, 1.0)
    assert pose(arc) == pytest.approx(pose(straight), abs=1e-9)


def test_velocity_is_a_rolling_mean_that_a_restart_forgets():
    odometry = PlanarOdometry(3)
    for step, distance in enumerate((0.3, 0.6, 0.9, 1.2), 1):
        odometry.travelled(distance, 0.0, float(step))
    assert odometry.linear == pytest.approx(0.9)
    odometry.restart(4.0)
    assert odometry.linear == 0.0 and odometry.x == pytest.approx(3.0)
    odometry.travelled(0.5, 0.0, 5.0)
    assert odometry.linear == pytest.approx(0.5)


def test_tiny_intervals_move_the_base_but_not_its_velocity():
    odometry = PlanarOdometry(1)
    odometry.travelled(1.0, 0.0, 1.0)
    odometry.travelled(1.0, 0.0, 1.00005)
    assert odometry.x == pytest.approx(2.0) and odometry.linear == pytest.approx(1.0)


def test_open_loop_integrates_commands():
    odometry = PlanarOdometry(10)
    odometry.commanded(1.0, math.pi / 2, 1.0)
    assert pose(odometry) == pytest.approx((2 / math.pi, 2 / math.pi, math.pi / 2))
    assert (odometry.linear, odometry.angular) == (1.0, math.pi / 2)


def test_sideways():
    odometry = PlanarOdometry(1)
    odometry.commanded(0.0, math.pi / 2, 1.0)
    odometry.moved(1.0, 2.0, 0.0, 2.0)
    assert pose(odometry) == pytest.approx((-2.0, 1.0, math.pi / 2))
    assert (odometry.linear, odometry.linear_y) == (1.0, 2.0)


def test_differential():
    assert differential(1.0, 3.0, 0.5) == (2.0, 4.0)


def test_wheels_need_not_start_at_zero():
    travel = WheelTravel()
    assert [travel(position) for position in (5.0, 5.5, 5.25)] == [0.0, 0.5, -0.25]


def test_a_restarted_wheel_has_not_travelled():
    travel = WheelTravel()
    travel(100.0)
    travel.restart()
    assert [travel(0.0), travel(1.0)] == [0.0, 1.0]


def test_rolling_mean():
    mean = RollingMean(2)
    assert [mean(value) for value in (1.0, 3.0, 5.0)] == [1.0, 2.0, 4.0]


@pytest.mark.parametrize("distance, angle", [(math.inf, 0.0), (0.0, -math.inf), (math.nan, 0.0), (1e308, 1e308)])
def test_a_jump_out_of_all_bounds_is_no_way_travelled(distance, angle):
    odometry = PlanarOdometry(10)
    odometry.travelled(1.0, 0.0, 0.1)
    odometry.travelled(distance, angle, 0.2)
    odometry.moved(distance, 0.0, angle, 0.3)
    assert pose(odometry) == pytest.approx((1.0, 0.0, 0.0))
    odometry.travelled(1.0, 0.0, 0.4)
    assert pose(odometry) == pytest.approx((2.0, 0.0, 0.0))


def test_rounds_without_number_keep_the_heading_finite():
    odometry = PlanarOdometry(10)
    for step in range(1, 10):
        odometry.commanded(0.0, 1e308, float(step))
    odometry.commanded(1.0, 0.0, 10.0)
    assert all(map(math.isfinite, pose(odometry)))
