"""Ranges of points, without ROS."""

import math
import struct

import numpy as np
import pytest
from cloud_scans.projection import Fan, turned, xyz

FAN = Fan(min_height=0.0, max_height=1.0, angle_min=-1.0, angle_max=1.0, angle_increment=0.5, range_min=0.5, range_max=4.0)


def test_the_nearest_point_of_each_ray_counts():
    points = np.array(
        [
            (1.0, 0.1, 0.5),
            (2.0, 0.2, 0.5),
            (1.0, -0.9, 0.0),
            (math.nan, 0, 0),
            (1.0, 0.1, 1.5),
            (0.2, 0.0, 0.5),
            (5.0, 0.0, 0.5),
            (-1.0, 0.0, 0.5),
        ]
    )
    assert FAN.ranges(points, math.inf) == pytest.approx([math.hypot(1, 0.9), math.inf, math.hypot(1, 0.1), math.inf])
    assert FAN.ranges(np.empty((0, 3)), 5.0) == pytest.approx([5.0] * 4)


def test_a_point_on_the_last_angle_is_in_the_last_ray():
    at = 1.0 - 1e-12
    assert np.isfinite(FAN.ranges(np.array([(math.cos(at), math.sin(at), 0.5)]), math.inf)[3])


def test_impossible_fans_are_refused():
    with pytest.raises(ValueError, match="angle_increment 0 above 0"):
        Fan(0, 1, -1, 1, 0, 0, 1)


@pytest.mark.parametrize("order", "<>")
def test_clouds_are_read_row_by_row(order):
    data = b"".join(struct.pack(f"{order}4f", i, 10 + i, 20 + i, 99) for i in range(2)) + b"pad!"
    data += b"".join(struct.pack(f"{order}4f", i, 10 + i, 20 + i, 99) for i in range(2, 4)) + b"pad!"
    points = xyz(data, 2, 2, 16, 36, (0, 4, 8), order == ">")
    assert points.tolist() == [[i, 10 + i, 20 + i] for i in range(4)]
    with pytest.raises(ValueError, match="bytes do not hold 2 x 3 points"):
        xyz(data, 2, 3, 16, 36, (0, 4, 8), False)


def test_points_of_a_turned_camera():
    half = math.sqrt(0.5)
    assert turned(np.array([(1.0, 0.0, 0.0)]), (0, 0, 0.3), (0, 0, half, half))[0] == pytest.approx([0, 1, 0.3])
