"""What passes a sensor's gate and its plugin's, counted by hand: a step is 1 ms."""

import pytest
from gazebo_plugins.sensors.two_rates import left_of


@pytest.mark.parametrize(
    "sensor, plugin, left",
    [
        (30.0, 30.0, 20.0),  # openings come 34, 33, 33 ms apart, and 33 is less than 1/30 s
        (30.0, 60.0, 30.0),
        (30.0, 0.0, 30.0),
        (50.0, 50.0, 50.0),  # 20 ms are whole steps
        (100.0, 1.0, 1.0),
        (100.0, 40.0, 100.0 / 3),  # every third of those that are 10 ms apart
        (0.0, 30.0, 1000.0 / 34),
    ],
)
def test_what_is_left(sensor, plugin, left):
    assert left_of(sensor, plugin, 0.001) == pytest.approx(left, abs=0.11)
