"""The node's parameters: defaults with a line, what is left out, what is refused."""

import copy
import math
import os
from dataclasses import fields, is_dataclass

import pytest
import yaml
from rm_hw.coefficients import ConfigError
from rm_hw.config import parse

with open(os.path.join(os.path.dirname(__file__), "..", "config", "actuator_coefficient.yaml")) as _file:
    TABLE = yaml.safe_load(_file)["actuator_coefficient"]
# as the tutorial writes it
GOOD = {
    "bus": ["can0"],
    "loop_frequency": 1000,
    "cycle_time_error_threshold": 0.001,
    "actuator_coefficient": TABLE,
    "actuators": {"joint1_motor": {"bus": "can0", "id": 0x201, "type": "rm_3508"}},
}


def changed(**changes):
    return {**copy.deepcopy(GOOD), **changes}


def texts(config, level):
    return [text for kind, text in config.lines if kind == level]


def test_the_tutorials_parameters():
    config = parse(GOOD, {})
    assert texts(config, "error") == []
    assert texts(config, "warn") == ["No imu specified", "No tof_radars specified", "No gpio specified"]
    assert texts(config, "info") == ["parameter 'thread_priority' is not set: using 95"]
    (bus,), (motor,) = config.buses, config.actuators
    assert (bus.name, bus.interface, bus.channel, bus.bitrate) == ("can0", "socketcan", "can0", 1000000)
    assert (motor.id, motor.type, motor.coefficients.max_out, motor.timeout) == (0x201, "rm_3508", 16384.0, 0.1)


def test_nothing_at_all_is_all_defaults():
    config = parse({}, TABLE)
    assert (config.loop_frequency, config.cycle_time_error_threshold, config.thread_priority) == (1000.0, 0.001, 95)
    assert "No bus specified" in texts(config, "warn") and "No actuator specified" in texts(config, "warn")
    assert "No actuator coefficient specified" in texts(config, "warn")


def test_interfaces_for_all_and_for_one():
    second = {"name": "can1", "interface": "virtual", "channel": "x"}
    config = parse(changed(bus=["can0", second], interface="slcan"), {})
    assert [(b.interface, b.channel) for b in config.buses] == [("slcan", "/tmp/rm_bench/can0"), ("virtual", "x")]
    config = parse(changed(interface="slcan", channel="/dev/tty_{bus}", bus=["can0", "can1"]), {})
    assert [b.channel for b in config.buses] == ["/dev/tty_can0", "/dev/tty_can1"]


@pytest.mark.parametrize("key", ["bus", "id", "type"])
def test_incomplete_actuators_are_left_out(key):
    params = changed()
    params["actuators"]["second"] = {"bus": "can0", "id": 0x202, "type": "rm_3508"}
    del params["actuators"]["second"][key]
    config = parse(params, {})
    assert texts(config, "error") == [f"Actuator second has no associated {key}: it is left out"]
    assert [a.name for a in config.actuators] == ["joint1_motor"]


def test_wrong_buses_are_left_out():
    config = parse(changed(bus=["can0", "eth0"]), {})
    assert texts(config, "error") == ["Unknown bus: 'eth0': the name of a CAN bus contains 'can', for example can0"]
    params = changed(bus=["can1"])
    assert "which parameter 'bus' does not list (it has can1)" in texts(parse(params, {}), "error")[0]


@pytest.mark.parametrize(
    "changes, remedy",
    [
        ({"loop_frequency": 0}, "above zero"),
        ({"loop_frequency": "fast"}, "above zero"),
        ({"thread_priority": 100}, "1 to 99"),
        ({"bus": "can0"}, r"write a list"),
        ({"actuators": [1]}, "mapping"),
        ({"bus": ["can0", "can0"]}, "twice"),
        ({"bus": ["can0", "can1"], "interface": "slcan", "channel": "/dev/ttyACM0"}, "tty_{bus}"),
        ({"actuators": {"a": {"bus": "can0", "id": 0x201, "type": "rm_9999"}}}, "known types: cheetah, rm_2006, rm_3508, rm_6020"),
        ({"actuators": {"a": {"bus": "can0", "id": 0x300, "type": "rm_3508"}}}, "actuator a: 0x300 .* 0x201..0x20B"),
        ({"actuators": {n: {"bus": "can0", "id": 0x201, "type": "rm_3508"} for n in "ab"}}, "a and b both have id 0x201"),
    ],
)
def test_nonsense_is_refused_in_one_line(changes, remedy):
    with pytest.raises(ConfigError, match=remedy) as error:
        parse(changed(**changes), {})
    assert "\n" not in str(error.value)


FULL = changed(
    interface="slcan",
    channel="/dev/tty_{bus}",
    bitrate=1000000,
    thread_priority=95,
    bus=[{"name": "can0", "interface": "virtual", "channel": "x", "bitrate": 500000}],
    actuators={
        "motor": {"bus": "can0", "id": 0x201, "type": "rm_3508", "need_calibration": False, "lp_cutoff_frequency": 60.0, "timeout": 0.1}
    },
    imus={
        "base": {
            "bus": "can0",
            "id": 0x300,
            "frame_id": "base_imu",
            "accel_coeff": 0.002,
            "angular_vel_coeff": 0.001,
            "temp_coeff": 0.125,
            "temp_offset": 23.0,
            "angular_vel_offset": [0.0, 0.0, 0.0],
            "orientation_covariance_diagonal": [0.1, 0.1, 0.1],
        }
    },
)
STRANGE = [
    None,
    "",
    "text",
    "/",
    True,
    False,
    0,
    -1,
    3,
    2**40,
    1e308,
    -1e308,
    math.nan,
    math.inf,
    -math.inf,
    [],
    [1, 2],
    ["a"],
    [[]],
    [None],
    [math.nan] * 3,
    ["x"] * 3,
    {},
    {"a": 1},
    {"name": ["can0"]},
]


def places(tree, path=()):
    """Paths to every value of a tree of parameters."""
    for key, value in tree.items() if isinstance(tree, dict) else enumerate(tree):
        yield path + (key,)
        if isinstance(value, (dict, list)):
            yield from places(value, path + (key,))


def numbers(thing):
    """All floats in a parsed configuration."""
    if isinstance(thing, float):
        yield thing
    elif isinstance(thing, (list, tuple)):
        for entry in thing:
            yield from numbers(entry)
    elif is_dataclass(thing):
        yield from numbers([getattr(thing, field.name) for field in fields(thing)])


@pytest.mark.parametrize("place", places(FULL), ids=lambda place: "/".join(map(str, place)))
def test_whatever_stands_where_is_taken_or_refused_in_one_line(place):
    for value in STRANGE:
        params = copy.deepcopy(FULL)
        node = params
        for key in place[:-1]:
            node = node[key]
        node[place[-1]] = value
        try:
            config = parse(params, TABLE)
        except ConfigError as error:
            assert "\n" not in str(error) and len(str(error)) < 400
        else:
            assert all(
                map(
                    math.isfinite,
                    numbers([config.buses, config.actuators, config.imus, config.loop_frequency, config.cycle_time_error_threshold]),
                )
            ), (place, value)


def test_imu_defaults_are_said():
    imu = {"bus": "can0", "id": 0x300, "frame_id": "base_imu", "accel_coeff": 0.002, "angular_velocity_covariance": [1, 2, 3]}
    config = parse(changed(imus={"base": imu}), {})
    assert config.imus[0].accel_coeff == 0.002 and config.imus[0].angular_velocity_covariance == (1.0, 2.0, 3.0)
    assert any("imus/base/temp_coeff" in text for text in texts(config, "info"))
    with pytest.raises(ConfigError, match="three numbers"):
        parse(changed(imus={"base": {**imu, "angular_vel_offset": 3}}), {})
