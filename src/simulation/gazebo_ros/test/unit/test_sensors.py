import xml.etree.ElementTree as ET
from types import SimpleNamespace

import pytest
from gazebo_ros.api import metrics
from gazebo_ros.sensors import Sensor
from node_signals.rates import LatenessKept
from ode_sim.description.model import Pose
from ode_sim.description.model import Sensor as Description

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
    assert eye.measurement_time.to_nsec() == seen[-1] and eye.updates.number == 5
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


def rates(eye, deliver, steps=3000, every=211):
    """The rates that are told every so many steps, in Hz of sim time; :param deliver: told of each update, by its number."""
    told, rate, taken = [], metrics._Rate(), [0]

    def measure(s):
        deliver(s, taken[0])
        taken[0] += 1

    eye.connect(measure)
    for i in range(1, steps + 1):
        eye.update(i * STEP)
        if i % every == 0:
            told.append(rate.read(eye.counted, i * STEP)[0])
    return told


def test_the_rate_of_a_camera_is_that_of_its_pictures():
    """Of 30 updates a second two in three are left out, since the machine does not draw them: 10 Hz, wherever a message cuts."""

    def deliver(s, number):
        if number % 3 == 0:
            s.pictured(s.measurement_ns)
            s.pictured(s.measurement_ns)  # the other eye of a pair

    told = rates(sensor(rate=30.0), deliver)
    assert told[0] == 0.0 and len(told) > 10
    assert told[3:] == pytest.approx([10.0] * len(told[3:]), rel=0.02)


def test_the_rate_of_a_sensor_is_that_of_its_measurements():
    told = rates(sensor(rate=4.0), lambda s, number: None)  # seldom: most messages bring nothing new
    assert told[5:] == pytest.approx([4.0] * len(told[5:]), rel=1e-6)


def test_a_camera_that_has_stopped_has_no_rate():
    told = rates(sensor(rate=30.0), lambda s, number: s.pictured(s.measurement_ns) if number < 30 else None)
    assert told[3] == pytest.approx(30.0, rel=0.02)
    assert told[-5:] == [0.0] * 5
