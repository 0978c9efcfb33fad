"""Test signals and filters."""

import math
import statistics

import pytest
from control_toolbox import Dither, SineSweep, Sinusoid, clamp, exponential_smoothing


def test_sinusoid_and_its_derivatives():
    wave = Sinusoid(offset=1.0, amplitude=2.0, frequency=0.5, phase=0.3)
    step = 1e-5
    for time in (0.0, 0.4, 1.7):
        before, now, after = (wave.update(time + shift) for shift in (-step, 0.0, step))
        assert now.value == pytest.approx(1.0 + 2.0 * math.sin(0.3 + math.pi * time))
        assert now.first == pytest.approx((after.value - before.value) / (2 * step), abs=1e-6)
        assert now.second == pytest.approx((after.first - before.first) / (2 * step), abs=1e-6)


def test_sweep_goes_through_both_frequencies():
    sweep = SineSweep(1.0, 10.0, 20.0, 3.0)
    scale = 20.0 / math.log(10.0)
    for time in (0.0, 0.5, 12.0, 20.0):
        assert sweep.update(time) == pytest.approx(3.0 * math.sin(2 * math.pi * scale * (math.exp(time / scale) - 1.0)))
    assert sweep.update(20.001) == 0.0


@pytest.mark.parametrize("arguments", [(2.0, 1.0, 1.0, 1.0), (-1.0, 1.0, 1.0, 1.0), (1.0, 2.0, -1.0, 1.0), (1.0, 2.0, 1.0, -1.0)])
def test_impossible_sweeps_are_refused(arguments):
    with pytest.raises(ValueError, match="sine sweep"):
        SineSweep(*arguments)


def test_dither_is_gaussian_and_repeatable():
    values = [value.update() for value in [Dither(2.0, seed=4)] for _ in range(5000)]
    assert statistics.stdev(values) == pytest.approx(2.0, rel=0.05) and abs(statistics.mean(values)) < 0.1
    again = Dither(2.0, seed=4)
    assert [again.update() for _ in range(5000)] == values


def test_filters():
    assert [clamp(value, -1.0, 2.0) for value in (-3.0, 0.5, 3.0)] == [-1.0, 0.5, 2.0]
    assert exponential_smoothing(1.0, 0.0, 0.25) == 0.25
