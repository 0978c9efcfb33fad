"""Each filter on a scan whose answer is known, without ROS."""

import math

import numpy as np
import pytest
from scan_filters.base import FilterError, Scan
from scan_filters.chain import KINDS, chain, run

NAN = math.nan


def scan(ranges, angle_min=-1.0, step=0.5, **more):
    return Scan(np.array(ranges, np.float32), np.array(more.pop("light", []), np.float32), angle_min, step, 0.1, 10.0, "laser", **more)


def filtered(kind, given, values, transform=None, **more):
    result = scan(values, **more)
    assert run(chain([{"name": "f", "type": f"laser_filters/{kind}", "params": given}], transform), result, pytest.fail)
    return result


def ranges(*arguments, **more):
    return pytest.approx(filtered(*arguments, **more).ranges.tolist(), nan_ok=True)


def test_ranges_and_intensities():
    assert [0.5, 1.0, 3.0, 9.0] == ranges(
        "LaserScanRangeFilter",
        {"lower_threshold": 0.8, "upper_threshold": 4, "lower_replacement_value": 0.5, "upper_replacement_value": 9.0},
        [0.2, 1.0, 3.0, 5.0],
    )
    assert [0.0, 1.0, 100000.0] == ranges("LaserScanRangeFilter", {"use_message_range_limits": True}, [0.05, 1.0, math.inf])
    assert [NAN, 2.0, NAN] == ranges("LaserScanIntensityFilter", {"lower_threshold": 10}, [1.0, 2.0, 3.0], light=[5, 20, 10])
    assert filtered(
        "LaserScanIntensityFilter", {"lower_threshold": 10, "filter_override_intensity": True}, [1.0, 2.0], light=[5, 20]
    ).intensities.tolist() == [0, 1]


def test_angles():
    cut = filtered(
        "LaserScanAngularBoundsFilter",
        {"lower_angle": -0.5, "upper_angle": 0.6},
        [1, 2, 3, 4, 5],
        light=[1, 2, 3, 4, 5],
        stamp=10.0,
        time_increment=0.1,
    )
    assert cut.ranges.tolist() == cut.intensities.tolist() == [2, 3, 4]
    assert cut.angle_min == -0.5 and cut.stamp == pytest.approx(10.1)
    assert [1, 11, 11, 11, 5] == ranges("LaserScanAngularBoundsFilterInPlace", {"lower_angle": -0.6, "upper_angle": 0.6}, [1, 2, 3, 4, 5])
    assert [1, 2, 11, 4, 5] == ranges("LaserScanSectorFilter", {"angle_min": -0.1, "angle_max": 0.1, "range_max": 3.5}, [1, 2, 3, 4, 5])
    assert [11, 2, 3, 4, 11] == ranges("LaserScanSectorFilter", {"angle_min": 0.9, "angle_max": -0.9}, [1, 2, 3, 4, 5])
    assert [1, NAN, 3] == ranges("LaserScanMaskFilter", {"masks": {"laser": [1, 99]}}, [1, 2, 3])


def test_places():
    moved = lambda points, to, whence, stamp: points + (1.0, 0.0, 0.0)  # noqa: E731
    box = {"box_frame": "base", "min_x": 2.0, "max_x": 4.0}
    assert [NAN, 5.0, 0.5] == ranges("LaserScanBoxFilter", box, [2.0, 5.0, 0.5], moved, angle_min=0.0, step=1e-3)
    assert [2.0, NAN, NAN] == ranges("LaserScanBoxFilter", {**box, "invert": True}, [2.0, 5.0, 0.5], moved, angle_min=0.0, step=1e-3)
    assert [NAN, 2.0] == ranges("LaserScanFootprintFilter", {"inscribed_radius": 1.6}, [0.5, 2.0], moved, angle_min=0.0, step=1e-3)
    triangle = {"polygon_frame": "base", "polygon": [[1, -1], [3, 0], [1, 1]]}
    for kind in ("LaserScanPolygonFilter", "StaticLaserScanPolygonFilter"):
        there = moved if kind.startswith("Laser") else lambda points, to, whence, stamp: points - (1.0, 0.0, 0.0)
        assert [NAN, 2.5, NAN] == ranges(kind, triangle, [1.0, 2.5, 0.2], there, angle_min=0.0, step=1e-3)
    assert [NAN, NAN] == ranges("LaserScanPolygonFilter", {**triangle, "polygon_padding": 1.0}, [1.0, 2.5], moved, angle_min=0.0, step=1e-3)


def test_neighbours():
    values = [1.0, 1.05, 1.1, 1.5, 1.9, 1.95, 5.0, 1.2]
    assert [1.0, 1.05, 1.1, NAN, 1.9, 1.95, 5.0, NAN] == ranges(
        "LaserScanSpeckleFilter", {"max_range_difference": 0.2, "filter_window": 2}, values
    )
    assert [1.0, 1.0, 1.0, 5.0, NAN, 5.0, 5.0] == ranges(
        "LaserScanSpeckleFilter",
        {"filter_type": 1, "max_range_difference": 0.1, "filter_window": 2},
        [1.0, 1.0, 1.0, 5.0, 1.8, 5.0, 5.0],
        step=0.02,
    )
    assert [1.0, 2.0, 2.0, 3.0, (3.0 + 3.0) / 2] == ranges("InterpolationFilter", {}, [1.0, math.inf, 20.0, 3.0, 0.0])


def test_blobs():
    """A foot 12 cm wide between two gaps is its middle; a wall that runs away and a run that is too short are none."""
    foot, wall, short = [1.0, 0.95, 0.9, 0.95, 1.0], [2.0, 3.0, 4.0, 5.0, 6.0], [1.0] * 4
    values = [*foot, NAN, *wall, NAN, *short, -1.0, *foot]
    wanted = [-abs(value) for value in values]
    wanted[2], wanted[-3] = 0.9, 0.9
    assert wanted == ranges("ScanBlobFilter", {"max_radius": 0.1, "min_points": 4}, values, step=0.02)
    assert [-1.0, -1.0, 1.0, -1.0] == ranges("ScanBlobFilter", {"max_radius": 0.1, "min_points": 3}, [1.0] * 4)


def test_shadows_of_an_edge():
    """A wall 2 m away behind a post at 1 m; one ray saw half of either."""
    values = [2.0] * 5 + [1.5] + [1.0] * 5
    given = {"min_angle": 10, "max_angle": 170, "window": 1, "neighbors": 1}
    left = filtered("ScanShadowsFilter", given, values, angle_min=-0.05, step=0.01).ranges
    assert np.isnan(left[4:6]).all() and not np.isnan(left[:4]).any() and not np.isnan(left[6:]).any()
    flat = 1.0 / np.cos(np.linspace(-0.4, 0.4, 41))
    assert not np.isnan(filtered("ScanShadowsFilter", given, flat, angle_min=-0.4, step=0.02).ranges).any()


def test_windows_over_time():
    filters = chain(
        [
            {
                "name": "a",
                "type": "LaserArrayFilter",
                "params": {
                    "range_filter_chain": [
                        {"name": "m", "type": "filters/MultiChannelMedianFilterFloat", "params": {"number_of_observations": 3}}
                    ]
                },
            }
        ]
    )
    for value, median in ((1.0, 1.0), (9.0, 9.0), (2.0, 2.0), (3.0, 3.0)):
        told = scan([value, 5.0])
        assert run(filters, told, pytest.fail) and told.ranges.tolist() == [median, 5.0]


@pytest.mark.parametrize(
    "entries, said",
    [
        ("x", "is a list"),
        ([{"name": "a"}], "needs a name and a type"),
        ([{"name": "a", "type": "laser_filters/Nothing"}], "no type 'laser_filters/Nothing'; there are laser_filters/Interpolation"),
        (
            [{"name": "a", "type": "LaserScanAngularBoundsFilter", "params": {"lower_angle": 1}}],
            "filter 'a' needs the parameter upper_angle",
        ),
        ([{"name": "a", "type": "LaserScanRangeFilter", "params": {"lower_threshold": "far"}}], "lower_threshold of filter 'a' is 'far'"),
        ([{"name": "a", "type": "LaserScanPolygonFilter", "params": {"polygon_frame": "b", "polygon": [[1, 2]]}}], "at least three"),
        ([{"name": "a", "type": "InterpolationFilter"}] * 2, "two filters"),
    ],
)
def test_what_is_wrong_is_said(entries, said):
    with pytest.raises(FilterError, match=said.replace("[", "\\[")):
        chain(entries)


def test_a_scan_that_is_too_small_is_refused():
    said = []
    assert not run(chain([{"name": "s", "type": "LaserScanSpeckleFilter"}]), scan([1.0, 1.0]), said.append)
    assert "too small" in said[0] and len(KINDS) == 16
