"""Readings and distances; the figures are upstream's curves at readings by hand."""

import pytest
from arbotix_sensors.sensors import A02YK, A710YK, GP2D12, MaxSonar


@pytest.mark.parametrize(
    "sensor, raw, metres",
    [
        (GP2D12, 64, 1.0),  # 52 / (64 - 12)
        (GP2D12, 142, 0.4),
        (GP2D12, 40, 0.9),  # too far: beyond the range
        (A02YK, 127, 1.0),
        (A02YK, 80, 1.6),
        (A710YK, 553, 1.0),
        (A710YK, 100, 5.6),
        (MaxSonar(), 512, 6.35),
        (MaxSonar(), 0, 0.0),
    ],
)
def test_distances(sensor, raw, metres):
    assert sensor.convert(raw) == pytest.approx(metres)
