"""Curves that forget their beginning, and what is left of them on a screen."""

import numpy as np
import pytest
from rqt_plot.series import Series, decimate, limits, visible


def test_samples_are_kept_in_order():
    series = Series()
    series.extend([1, 3], [10, 30])
    series.extend([2], [20])
    series.extend([4, 3.5], [40, 35])
    assert series.x.tolist() == [1, 2, 3, 3.5, 4] and series.y.tolist() == [10, 20, 30, 35, 40]


def test_memory_is_bounded():
    series = Series(capacity=1000)
    for start in range(0, 50_000, 70):
        series.extend(np.arange(start, start + 70), np.arange(start, start + 70))
    assert len(series) == 1000 and series.x[-1] == series.y[-1] == 50_049 and series.x[0] == 49_050
    assert series.dropped == 49_050
    assert series._data.size <= 2 * (1250 + 70)
    series.extend(np.arange(5000.0) + 60_000, np.zeros(5000))
    assert len(series) == 1000 and series.x[-1] == 64_999


def test_all_is_kept_when_asked():
    series = Series(capacity=None)
    for i in range(300):
        series.extend(np.full(1000, float(i)), np.full(1000, float(i)))
    assert len(series) == 300_000 and series.x[0] == 0 and series.x[-1] == 299


def test_what_is_seen():
    series = Series()
    series.extend(np.arange(10.0), np.zeros(10))
    assert visible(series, 3, 5) == slice(2, 7)
    assert visible(series, -5, -1) == slice(0, 1) and visible(series, 20, 30) == slice(9, 10)
    assert visible(Series(), 0, 1) == slice(0, 0)


def test_peaks_survive_the_reduction():
    x = np.arange(100_000.0)
    y = np.sin(x / 5000)
    y[54_321], y[77_777] = 9.0, -9.0
    small_x, small_y = decimate(x, y, 500)
    assert len(small_x) == len(small_y) <= 2100
    assert small_y.max() == 9.0 and small_y.min() == -9.0
    assert small_x[0] == 0 and small_x[-1] == 99_999 and (np.diff(small_x) >= 0).all()
    assert abs(small_x[small_y.argmax()] - 54_321) <= 256


def test_groups_stay_where_they_are_while_the_curve_scrolls():
    x = np.arange(40_000.0)
    y = np.random.default_rng(1).normal(size=40_000)
    first = dict(zip(*decimate(x[:30_000], y[:30_000], 300, 0)))
    second = dict(zip(*decimate(x[1000:31_000], y[1000:31_000], 300, 1000)))
    inner = [key for key in first if 1100 < key < 29_900]
    assert len(inner) > 800 and all(second[key] == first[key] for key in inner)


def test_few_samples_stay_as_they_are():
    x, y = np.arange(1000.0), np.arange(1000.0)
    assert decimate(x, y, 800)[1] is y


def test_nan_and_infinity_do_not_decide_the_limits():
    assert limits(np.array([np.nan, 1.0, np.inf, -3.0, -np.inf])) == (-3.0, 1.0)
    assert limits(np.array([np.nan])) is None and limits(np.array([])) is None
    _, y = decimate(np.arange(4000.0), np.where(np.arange(4000) % 2, np.nan, 5.0), 100)
    assert np.nanmax(y) == 5.0


@pytest.mark.parametrize("capacity", [0, -1])
def test_a_series_keeps_something(capacity):
    with pytest.raises(ValueError):
        Series(capacity)
