import xml.etree.ElementTree as ET
from types import SimpleNamespace

import pytest
from node_signals.rates import LatenessKept
from ode_sim.description.model import Pose, Sensor as Description

from gazebo_ros.sensors import Sensor

STEP = 1_000_000


def updates(rate, steps, step=STEP, start=0):
    clock = LatenessKept(rate)
    taken = []
    for i in range(1, steps + 1):
        now = start + i * step
        if clock.ready(now):
            clock.take(now)
            taken.append(now)
    return taken


@pytest.mark.parametrize("rate", [1, 10, 30, 50, 60, 100, 333, 1000])
def test_mean_rate_is_exact_on_a_millisecond_step(rate):
    assert abs(len(updates(rate, 3000)) - 3 * rate) <= 1


def test_thirty_hertz_alternates_so_that_the_delay_is_carried():
    gaps = {b - a for a, b in zip(updates(30, 1000), updates(30, 1000)[1:])}
    assert gaps == {33 * STEP, 34 * STEP}


def test_zero_is_every_step_and_too_fast_too():
    assert len(updates(0, 50)) == 50
    assert len(updates(5000, 50)) == 50


def test_a_delay_of_a_period_is_forgotten():
    clock = LatenessKept(10)
    clock.take(100 * STEP)
    assert clock.ready(1000 * STEP)
    clock.take(1000 * STEP)
    assert not clock.ready(1099 * STEP) and clock.ready(1100 * STEP)


def test_time_going_back_starts_anew():
    clock = LatenessKept(10)
    clock.take(5000 * STEP)
    assert not clock.ready(1 * STEP)
    assert clock.ready(100 * STEP)


def sensor(rate=10.0, report=None):
    link = SimpleNamespace(model=None, scoped_name="arm::hand")
    description = Description("eye", "ray", Pose(), ET.Element("sensor"), update_rate=rate)
    return Sensor(description, link, report or (lambda owner, error: pytest.fail(str(error))))


def test_measures_only_while_wanted():
    wanted, seen = [False], []
    eye = sensor()
    eye.connect(lambda s: seen.append(s.measurement_ns), wanted=lambda: wanted[0])
    for i in range(1, 1001):
        wanted[0] = i > 500
        eye.update(i * STEP)
    assert seen == [k * 100 * STEP for k in range(6, 11)]  # on the grid, whenever the wish began
    assert eye.measurement_time.to_nsec() == seen[-1] and eye.update_count == 5
    assert eye.scoped_name == "arm::hand::eye"


def test_a_failing_plugin_is_cut_off_and_reported_and_the_other_goes_on():
    reports, seen = [], []
    eye = sensor(rate=0.0, report=lambda owner, error: reports.append((owner, str(error))))
    eye.owner = "bad"

    def fail(_):
        raise ValueError("lens cap")

    eye.connect(fail)
    eye.owner = "good"
    eye.connect(lambda s: seen.append(s.measurement_ns))
    for i in range(1, 4):
        eye.update(i * STEP)
    assert reports == [("bad", "lens cap")]
    assert len(seen) == 3
