"""The node's private parameters, checked. Knows no ROS: takes a mapping, returns values and lines to log."""

from __future__ import annotations

import os
import reprlib
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from node_signals.parameters import is_number

from rm_hw.actuator import SILENCE
from rm_hw.can_bus import BITRATE
from rm_hw.coefficients import Coefficients, ConfigError, number
from rm_hw.frames import command_slot

BENCH_DIRECTORY = os.environ.get("RM_BENCH_DIR", "/tmp/rm_bench")
_NUMBERS = {"loop_frequency": 1000.0, "cycle_time_error_threshold": 0.001, "thread_priority": 95.0}
_OPTIONAL_SECTIONS = (("imus", "imu"), ("tof_radars", "tof_radars"), ("gpios", "gpio"))


@dataclass(frozen=True)
class BusConfig:
    """A CAN bus: its name, python-can interface, device of that interface, bit/s."""

    name: str
    interface: str
    channel: str
    bitrate: int = BITRATE


@dataclass(frozen=True)
class ActuatorConfig:
    """One motor. ``cutoff`` in Hz (negative: default), ``timeout`` in s."""

    name: str
    bus: str
    id: int
    type: str
    coefficients: Coefficients
    need_calibration: bool = False
    cutoff: float = -1.0
    timeout: float = SILENCE


@dataclass(frozen=True)
class ImuConfig:
    """One IMU: factors to rad/s, m/s^2 and degrees Celsius per count, diagonals of its covariances."""

    name: str
    bus: str
    id: int
    frame_id: str
    angular_vel_coeff: float = 0.0010652644  # 2000 deg/s over 32768 counts
    accel_coeff: float = 0.0017944335  # 6 g over 32768 counts
    temp_coeff: float = 0.125
    temp_offset: float = 23.0
    angular_vel_offset: tuple[float, float, float] = (0.0, 0.0, 0.0)
    orientation_covariance: tuple[float, float, float] = (0.0012, 0.0012, 0.0012)
    angular_velocity_covariance: tuple[float, float, float] = (0.0004, 0.0004, 0.0004)
    linear_acceleration_covariance: tuple[float, float, float] = (0.01, 0.01, 0.01)


@dataclass
class Config:
    """All of it. ``lines`` are (level, text) for the log, level info, warn or error."""

    buses: list[BusConfig] = field(default_factory=list)
    actuators: list[ActuatorConfig] = field(default_factory=list)
    imus: list[ImuConfig] = field(default_factory=list)
    loop_frequency: float = 1000.0
    cycle_time_error_threshold: float = 0.001
    thread_priority: int = 95
    lines: list[tuple[str, str]] = field(default_factory=list)


def parse(params: Mapping[str, Any], own_coefficients: Mapping[str, Any]) -> Config:
    """Check ``params``, the parameters of rm_hw.

    What is incomplete is left out with an error line; what has a default gets it with a line saying so.

    :param own_coefficients: the table that is used for lack of ``actuator_coefficient``.
    :raises ConfigError: nothing sensible can be made of it (unknown actuator type, two motors with one id ...).
    """
    config = Config()
    for name, default in _NUMBERS.items():
        if name not in params:
            config.lines.append(("info", f"parameter '{name}' is not set: using {default:g}"))
        setattr(config, name, _positive(params.get(name, default), name))
    config.thread_priority = int(config.thread_priority)
    if not 1 <= config.thread_priority <= 99:
        raise ConfigError(f"thread_priority is {config.thread_priority}: SCHED_FIFO has priorities 1 to 99")
    config.buses = _buses(params, config.lines)
    coefficients = _section(params, "actuator_coefficient", "actuator coefficient", config.lines)
    if not coefficients:
        config.lines.append(("info", "using the actuator coefficients of the package rm_hw"))
        coefficients = own_coefficients
    for name, entry in _section(params, "actuators", "actuator", config.lines).items():
        _add_actuator(config, name, entry, coefficients)
    for key, label in _OPTIONAL_SECTIONS:
        section = _section(params, key, label, config.lines)
        if key == "imus":
            for name, entry in section.items():
                _add_imu(config, name, entry)
        elif section:
            config.lines.append(("warn", f"'{key}' is not supported and ignored"))
    return config


def _positive(value: Any, name: str) -> float:
    if not is_number(value, above=0):
        raise ConfigError(f"parameter '{name}' is {reprlib.repr(value)}: write a number above zero")
    return float(value)


def _section(params: Mapping[str, Any], key: str, label: str, lines: list[tuple[str, str]]) -> Mapping[str, Any]:
    section = params.get(key)
    if not section:
        lines.append(("warn", f"No {label} specified"))
        return {}
    if not isinstance(section, dict):
        raise ConfigError(f"parameter '{key}' is {reprlib.repr(section)}: write a mapping of names")
    return section


def _buses(params: Mapping[str, Any], lines: list[tuple[str, str]]) -> list[BusConfig]:
    entries = params.get("bus")
    if not entries:
        lines.append(("warn", "No bus specified"))
        return []
    if not isinstance(entries, list):
        raise ConfigError(f"parameter 'bus' is {reprlib.repr(entries)}: write a list, for example [can0]")
    buses: list[BusConfig] = []
    for entry in entries:
        entry = entry if isinstance(entry, dict) else {"name": entry}
        name = str(entry.get("name", ""))
        if "can" not in name:
            lines.append(("error", f"Unknown bus: '{name}': the name of a CAN bus contains 'can', for example can0"))
            continue
        interface = str(entry.get("interface", params.get("interface") or "socketcan"))
        default = os.path.join(BENCH_DIRECTORY, name) if interface == "slcan" else name
        channel = str(entry.get("channel", params.get("channel") or default)).replace("{bus}", name)
        if any(other.name == name or other.channel == channel for other in buses):
            raise ConfigError(
                f"bus {name} (channel {channel}) is listed twice: give each bus a channel of its own, for example channel: /dev/tty_{{bus}}"
            )
        bitrate = int(_positive(entry.get("bitrate", params.get("bitrate", BITRATE)), f"bitrate of {name}"))
        buses.append(BusConfig(name, interface, channel, bitrate))
    return buses


def _complete(kind: str, name: str, entry: Any, keys: tuple[str, ...], config: Config) -> bool:
    """True if a section has all keys and its bus exists; else an error line names what is missing."""
    missing = [key for key in keys if not isinstance(entry, dict) or key not in entry]
    for key in missing:
        config.lines.append(("error", f"{kind} {name} has no associated {key}: it is left out"))
    if missing:
        return False
    if isinstance(entry["id"], bool) or not isinstance(entry["id"], int):
        config.lines.append(("error", f"{kind} {name}: id is {entry['id']!r}, write a whole number such as 0x201: it is left out"))
        return False
    if entry["bus"] not in [bus.name for bus in config.buses]:
        listed = ", ".join(bus.name for bus in config.buses) or "none"
        config.lines.append(
            ("error", f"{kind} {name} is on bus '{entry['bus']}', which parameter 'bus' does not list (it has {listed}): it is left out")
        )
        return False
    return True


def _add_actuator(config: Config, name: str, entry: Any, coefficients: Mapping[str, Any]) -> None:
    if not _complete("Actuator", name, entry, ("bus", "id", "type"), config):
        return
    type_name, identifier = str(entry["type"]), entry["id"]
    if type_name not in coefficients or not ("rm" in type_name or "cheetah" in type_name):
        raise ConfigError(
            f"Unknown actuator type '{type_name}' of actuator {name}; known types: {', '.join(sorted(map(str, coefficients)))}"
        )
    for other in config.actuators:
        if other.bus == entry["bus"] and other.id == identifier:
            raise ConfigError(
                f"actuators {other.name} and {name} both have id 0x{identifier:X} on {other.bus}: set another id at one of the motors"
            )
    if "rm" in type_name:
        try:
            command_slot(identifier)
        except ValueError as error:
            raise ConfigError(f"actuator {name}: {error}") from None
    config.actuators.append(
        ActuatorConfig(
            name,
            entry["bus"],
            identifier,
            type_name,
            Coefficients.from_params(type_name, coefficients[type_name]),
            bool(entry.get("need_calibration", False)),
            number(entry.get("lp_cutoff_frequency", -1.0), f"actuators/{name}/lp_cutoff_frequency"),
            _positive(entry.get("timeout", SILENCE), f"actuators/{name}/timeout"),
        )
    )


def _triple(value: Any, what: str) -> tuple[float, float, float]:
    if not isinstance(value, (list, tuple)) or len(value) != 3:
        raise ConfigError(f"{what} is {reprlib.repr(value)}: write three numbers")
    x, y, z = (number(entry, what) for entry in value)
    return x, y, z


def _add_imu(config: Config, name: str, entry: Any) -> None:
    if not _complete("IMU", name, entry, ("bus", "id", "frame_id"), config):
        return
    values: dict[str, Any] = {}
    for key, default in (
        (f.name, f.default) for f in ImuConfig.__dataclass_fields__.values() if f.name not in ("name", "bus", "id", "frame_id")
    ):
        given = entry.get(key + "_diagonal", entry.get(key))
        if given is None:
            config.lines.append(("info", f"parameter 'imus/{name}/{key}' is not set: using {default}"))
        else:
            what = f"imus/{name}/{key}"
            values[key] = _triple(given, what) if isinstance(default, tuple) else number(given, what)
    config.imus.append(ImuConfig(name, entry["bus"], entry["id"], str(entry["frame_id"]), **values))
