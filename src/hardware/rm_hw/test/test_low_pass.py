"""The velocity filter against scipy's Butterworth design and against uneven sampling."""

import math

import numpy as np
import pytest
from rm_hw.low_pass import LowPass
from scipy import signal


def run(low_pass, values, stamps):
    return np.array([low_pass.update(v, t) for v, t in zip(values, stamps)])


def test_even_samples_match_scipy():
    rate, cutoff, n = 1000.0, 60.0, 300
    values = np.random.default_rng(0).normal(size=n)
    ours = run(LowPass(cutoff), values, np.arange(n) / rate)
    theirs = signal.lfilter(*signal.butter(2, cutoff, fs=rate), values)
    np.testing.assert_allclose(ours[60:], theirs[60:], atol=1e-6)  # at the start ours takes the first sample whole


def test_default_cutoff_is_a_quarter_of_the_sample_rate():
    rate, n = 1000.0, 4000
    stamps = np.arange(n) / rate
    out = run(LowPass(), np.sin(2 * math.pi * rate / 4 * stamps), stamps)
    assert np.ptp(out[n // 2 :]) / 2 == pytest.approx(math.sqrt(0.5), rel=1e-3)


@pytest.mark.parametrize("cutoff", [-1.0, 5.0, 100.0, 1e6])
def test_constant_passes_whatever_the_intervals(cutoff):
    stamps = np.cumsum(np.random.default_rng(1).choice([0.0, 0.0006, 0.001, 0.004, 0.3], size=3000))
    assert run(LowPass(cutoff), np.r_[np.zeros(10), np.full(2990, 7.0)], stamps)[-1] == pytest.approx(7.0, rel=1e-6)


def test_reset_forgets():
    low_pass = LowPass(20.0)
    run(low_pass, np.full(100, 5.0), np.arange(100) * 0.001)
    low_pass.reset()
    assert low_pass.update(1.0, 10.0) == 1.0


def test_uneven_intervals_never_amplify():
    rng = np.random.default_rng(2)
    values, intervals = rng.choice([-1.0, 1.0], size=20000), rng.choice([0.0006, 0.001, 0.05], size=20000)
    out = run(LowPass(20.0), values, np.cumsum(intervals))
    assert np.abs(out).max() < 2.0
