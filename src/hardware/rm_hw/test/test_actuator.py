"""Counts to SI units, turns, silence, heat, limits."""

import math
import os

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st
from rm_hw.actuator import Actuator
from rm_hw.coefficients import Coefficients, ConfigError
from rm_hw.frames import CheetahReply, Feedback

with open(os.path.join(os.path.dirname(__file__), "..", "config", "actuator_coefficient.yaml")) as _file:
    TABLE = yaml.safe_load(_file)["actuator_coefficient"]


def make(type_name="rm_3508", identifier=0x201, **options):
    coefficients = Coefficients.from_params(type_name, TABLE[type_name])
    return Actuator("m", type_name, "can0", identifier, coefficients, **options)


def feed(actuator, angles, start=1.0, interval=0.001, **values):
    content = {"rpm": 0, "current": 0, "temperature": 30, **values}
    for i, angle in enumerate(angles):
        stamp = start + i * interval
        actuator.on_feedback(Feedback(int(angle) % 8192, **content), stamp, stamp)
    actuator.check(start + (len(angles) - 1) * interval)


@given(st.lists(st.integers(-4095, 4095), min_size=1, max_size=60), st.integers(0, 8191))
@settings(max_examples=60)
def test_turns_are_counted_over_any_path(steps, first):
    total, angles = first, [first]
    for step in steps:
        total += step
        angles.append(total)
    actuator = make()
    feed(actuator, angles)
    assert actuator.position == pytest.approx(total * 2 * math.pi / 8192, rel=1e-6, abs=1e-9)
    assert actuator.circle == total // 8192


@pytest.mark.parametrize("type_name, per_turn", [("rm_3508", 2 * math.pi), ("rm_6020", 2 * math.pi), ("rm_2006", 2 * math.pi / 36)])
def test_a_thousand_turns_keep_their_length(type_name, per_turn):
    actuator = make(type_name, 0x205)
    feed(actuator, range(0, 1000 * 8192 + 1, 2048), interval=0.001)
    assert actuator.position == pytest.approx(1000 * per_turn, rel=1e-6)


def test_effort_and_velocity_units():
    actuator = make()
    feed(actuator, [0] * 200, rpm=600, current=16384)
    assert actuator.effort == pytest.approx(20 * 0.3 / 19.2032, rel=2e-3)
    assert actuator.velocity == pytest.approx(600 * 2 * math.pi / 60, rel=1e-6)
    assert actuator.frequency == pytest.approx(1000.0)


def test_example_of_five_newton_metres_at_the_joint():
    actuator = make()
    feed(actuator, [0])
    assert actuator.command_counts(5.0 / 19.2032) == 13653


@given(st.floats(allow_nan=True, allow_infinity=True))
def test_commands_stay_inside_the_frame(effort):
    actuator = make()
    feed(actuator, [0])
    counts = actuator.command_counts(effort)
    assert isinstance(counts, int) and abs(counts) <= 16384
    if not math.isfinite(effort):
        assert counts == 0


def test_frames_closer_than_half_a_millisecond_are_dropped():
    actuator = make()
    assert actuator.on_feedback(Feedback(10, 0, 0, 0), 1.0, 1.0)
    assert not actuator.on_feedback(Feedback(20, 0, 0, 0), 1.0004, 1.0004)
    assert actuator.on_feedback(Feedback(30, 0, 0, 0), 1.0006, 1.0006)
    assert actuator.position_raw == 30


def test_turns_of_overtaken_frames_are_counted():
    actuator = make()
    actuator.on_feedback(Feedback(1000, 0, 0, 0), 1.0, 1.0)
    for angle in (4000, 7000, 1800, 4800):
        actuator.follow(angle)
    actuator.on_feedback(Feedback(7800, 0, 0, 0), 1.1, 1.1)
    assert actuator.circle == 1 and actuator.position_raw == 7800


def test_a_clock_set_back_does_not_silence_a_motor():
    actuator = make()
    feed(actuator, [5], start=100.0)
    assert actuator.on_feedback(Feedback(6, 0, 0, 0), 3.0, 100.001)
    assert actuator.position_raw == 6


def test_silence_disables_and_frames_bring_it_back():
    actuator = make()
    assert actuator.halted and actuator.check(0.0) is None
    feed(actuator, [8190], rpm=100, current=50)
    assert not actuator.halted and actuator.command_counts(0.1) > 0
    assert "sent nothing for 0.1 s" in actuator.check(1.2)
    assert actuator.check(1.3) is None, "said once"
    assert (actuator.velocity, actuator.effort, actuator.command_counts(0.1)) == (0.0, 0.0, 0)
    actuator.on_feedback(Feedback(3, 0, 0, 30), 2.0, 2.0)
    assert "is answering" in actuator.check(2.0)
    assert actuator.circle == 1, "it turned the short way while nobody listened"


def test_heat_disables():
    actuator = make()
    feed(actuator, [0], temperature=99)
    assert not actuator.halted
    actuator.on_feedback(Feedback(0, 0, 0, 100), 1.01, 1.01)
    assert "100 C" in actuator.check(1.01)
    assert actuator.command_counts(0.1) == 0


def test_cheetah_range_is_unwrapped():
    actuator = make("cheetah", 1)
    counts = [60000, 65000, (65000 + 2000) % 65536]  # crosses the end of the 25 rad range
    for i, position in enumerate(counts):
        actuator.on_cheetah(CheetahReply(1, position, 2048, 2048), 1.0 + 0.001 * i, 1.0 + 0.001 * i)
    assert actuator.circle == 1
    assert actuator.position == pytest.approx(counts[-1] * 25 / 65535 - 12.5 + 8 * math.pi, abs=1e-3)
    assert actuator.effort == pytest.approx(0.0, abs=0.01)


def test_missing_and_wrong_coefficients_are_named():
    with pytest.raises(ConfigError, match="actuator_coefficient/x has no 'act2vel'"):
        Coefficients.from_params("x", {"act2pos": 1})
    with pytest.raises(ConfigError, match="x/act2pos is 'many'"):
        Coefficients.from_params("x", {"act2pos": "many"})
