"""Points of a scan in another frame, by hand."""

import math

import numpy as np
import pytest
from scan_filters.base import Scan
from scan_filters.clouds import FIELDS, Pose, columns

STILL = Pose(np.zeros(3), np.array((0.0, 0.0, 0.0, 1.0)))
HALF = math.sqrt(0.5)


def scan(ranges, light=(), angle_min=0.0, step=0.0, time_increment=0.1):
    return Scan(np.array(ranges, np.float32), np.array(light, np.float32), angle_min, step, 0.5, 10.0, "laser", 5.0, time_increment)


def test_a_sensor_that_moves_and_turns_while_it_looks_ahead():
    """From the origin, looking along x, to (2, 0, 0), looking along y: half way at the second of three rays."""
    end = Pose(np.array((2.0, 0.0, 0.0)), np.array((0.0, 0.0, HALF, HALF)))
    table = columns(scan([1.0, 1.0, 1.0]), STILL, end, math.inf, {"viewpoint"})
    assert table.dtype.names == ("x", "y", "z", "vp_x", "vp_y", "vp_z")
    assert np.array(table.tolist()) == pytest.approx(
        np.array([(1, 0, 0, 0, 0, 0), (1 + HALF, HALF, 0, 1, 0, 0), (2, 1, 0, 2, 0, 0)]), abs=1e-6
    )


def test_columns_and_rays_that_count():
    """As laser_geometry's channels: from range_min to below range_max, or below the greatest that is asked for."""
    told = scan([0.4, 0.5, 3.0, 10.0, math.inf, math.nan, 2.0], [1, 2, 3, 4, 5, 6, 7], angle_min=math.pi / 2)
    table = columns(told, STILL, STILL, math.inf, set(FIELDS) - {"viewpoint"})
    assert table.dtype.names == ("x", "y", "z", "intensity", "index", "distances", "stamps")
    assert table["index"].tolist() == [1, 2, 6] and table["intensity"].tolist() == [2, 3, 7]
    assert table["y"] == pytest.approx([0.5, 3.0, 2.0]) and table["stamps"] == pytest.approx([0.1, 0.2, 0.6])
    assert columns(told, STILL, STILL, 2.5, {"index"})["index"].tolist() == [1, 6]
    assert columns(told, STILL, STILL, 99.0, {"index"})["index"].tolist() == [1, 2, 6]
    assert columns(scan([1.0]), STILL, STILL, math.inf, {"intensity"}).dtype.names == ("x", "y", "z")
    assert len(columns(scan([]), STILL, STILL, math.inf, set(FIELDS))) == 0
