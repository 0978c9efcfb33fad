"""Actuator types: factors between bus counts and SI units."""

from __future__ import annotations

import reprlib
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from typing import Any

from node_signals.parameters import ParameterError, is_number


class ConfigError(ParameterError):
    """Something in the configuration is wrong; one line: which parameter, what, and what to write instead."""


def number(value: Any, what: str) -> float:
    """``value`` as a float.

    :param what: name of the parameter, for the message.
    :raises ConfigError: it is no number, or not finite.
    """
    if not is_number(value):
        raise ConfigError(f"{what} is {reprlib.repr(value)}: write a number")
    return float(value)


@dataclass(frozen=True)
class Coefficients:
    """One row of ``actuator_coefficient``.

    :ivar act2pos: rad per encoder count
    :ivar act2vel: rad/s per rpm (or per count, for ``cheetah``)
    :ivar act2effort: Nm per count
    :ivar effort2act: counts per Nm
    :ivar max_out: largest magnitude of a command, counts; 0 leaves the limit to the frame
    :ivar counts_per_turn: counts that one turn of the encoder is worth
    :ivar act2pos_offset: rad; likewise the other offsets in their unit
    """

    act2pos: float
    act2vel: float
    act2effort: float
    effort2act: float
    max_out: float
    pos2act: float = 0.0
    vel2act: float = 0.0
    act2pos_offset: float = 0.0
    act2vel_offset: float = 0.0
    act2effort_offset: float = 0.0
    kp2act: float = 0.0
    kd2act: float = 0.0
    counts_per_turn: float = 8192.0

    @classmethod
    def from_params(cls, type_name: str, params: Mapping[str, Any]) -> Coefficients:
        """Coefficients of the actuator type ``type_name`` from ``params``, the mapping below its name.

        :raises ConfigError: a required factor is missing or a value is no number.
        """
        if not isinstance(params, Mapping):
            raise ConfigError(f"actuator_coefficient/{type_name} is {reprlib.repr(params)}: write a mapping of factors")
        values = {}
        for field in fields(cls):
            if field.name not in params:
                if field.default is MISSING:
                    raise ConfigError(
                        f"actuator_coefficient/{type_name} has no '{field.name}': add it, or load rm_hw/config/actuator_coefficient.yaml"
                    )
                continue
            values[field.name] = number(params[field.name], f"actuator_coefficient/{type_name}/{field.name}")
        return cls(**values)
