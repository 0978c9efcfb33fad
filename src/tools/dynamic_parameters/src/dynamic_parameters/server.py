"""See the package docstring for how to use this."""
from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence

import rospy
from dynamic_reconfigure.msg import (BoolParameter, Config, ConfigDescription, DoubleParameter, Group, GroupState,
                                     IntParameter, ParamDescription, StrParameter)
from dynamic_reconfigure.srv import Reconfigure, ReconfigureResponse

#: Python type -> (name on the wire, field of Config, message of one value, lowest, highest)
_TYPES = {
    bool: ("bool", "bools", BoolParameter, False, True),
    int: ("int", "ints", IntParameter, -2**31, 2**31 - 1),
    float: ("double", "doubles", DoubleParameter, float("-inf"), float("inf")),
    str: ("str", "strs", StrParameter, "", ""),
}


@dataclass(frozen=True)
class Parameter:
    """One parameter. ``type`` is bool, int, float or str; ``level`` is or-ed into what the callback gets;
    ``enum`` maps each allowed value to its description and makes graphical tools show a menu."""

    name: str
    type: type
    default: Any
    min: Any = None
    max: Any = None
    description: str = ""
    level: int = 0
    enum: Optional[Mapping[Any, str]] = None

    @property
    def low(self) -> Any:
        return _TYPES[self.type][3] if self.min is None else self.min

    @property
    def high(self) -> Any:
        return _TYPES[self.type][4] if self.max is None else self.max

    def clamp(self, value: Any) -> Any:
        """``value`` as this parameter's type, inside its range.

        :raises ValueError: not convertible.
        """
        value = self.type(value)
        if self.type in (int, float):
            if value != value:
                raise ValueError(f"{self.name} is not a number")
            return min(max(value, self.low), self.high)
        return value

    @property
    def edit_method(self) -> str:
        """Menu entries in the form that graphical tools evaluate."""
        if not self.enum:
            return ""
        kind = _TYPES[self.type][0]
        entries = [{"name": str(value), "type": kind, "value": value, "srcline": 0, "srcfile": "", "cconsttype": "",
                    "ctype": "", "description": text} for value, text in self.enum.items()]
        return repr({"enum_description": self.description, "enum": entries})


class Server:
    """A dynamic_reconfigure server in ``namespace`` (absolute, or relative to the node's namespace, or ``~...``)."""

    def __init__(self, namespace: str, parameters: Sequence[Parameter],
                 callback: Callable[[Dict[str, Any], int], Optional[Mapping[str, Any]]],
                 initial: Optional[Mapping[str, Any]] = None):
        self._ns = rospy.resolve_name(namespace).rstrip("/") + "/"
        self._parameters = {parameter.name: parameter for parameter in parameters}
        self._callback = callback
        self._lock = threading.RLock()
        self._config: Dict[str, Any] = {}
        for parameter in parameters:
            self._config[parameter.name] = self._first_value(parameter, initial or {})
        self._descriptions = rospy.Publisher(self._ns + "parameter_descriptions", ConfigDescription, latch=True,
                                             queue_size=1)
        self._descriptions.publish(self._describe())
        self._updates = rospy.Publisher(self._ns + "parameter_updates", Config, latch=True, queue_size=1)
        self._apply(self._config, -1)
        self._service = rospy.Service(self._ns + "set_parameters", Reconfigure, self._set)

    @property
    def config(self) -> Dict[str, Any]:
        """The current values."""
        with self._lock:
            return dict(self._config)

    def update(self, values: Mapping[str, Any], call_back: bool = False) -> None:
        """Change values from the program's side and tell the clients.

        :param call_back: also call the callback, as for a change by a client.
        """
        with self._lock:
            config = self._merged(values)
            self._apply(config, self._level(config), call_back)

    def shutdown(self) -> None:
        """Withdraw topics and service; the values stay on the parameter server."""
        self._service.shutdown("no longer needed")
        self._descriptions.unregister()
        self._updates.unregister()

    def _first_value(self, parameter: Parameter, initial: Mapping[str, Any]) -> Any:
        value = initial[parameter.name] if parameter.name in initial else rospy.get_param(
            self._ns + parameter.name, parameter.default)
        try:
            return parameter.clamp(value)
        except (TypeError, ValueError):
            rospy.logwarn("parameter %s%s is %r, which is no %s; using %r", self._ns, parameter.name, value,
                          _TYPES[parameter.type][0], parameter.default)
            return parameter.default

    def _merged(self, values: Mapping[str, Any]) -> Dict[str, Any]:
        config = dict(self._config)
        for name, value in values.items():
            if name not in self._parameters:
                rospy.logwarn("dynamic_reconfigure: %s has no parameter '%s'; it has: %s", self._ns.rstrip("/"), name,
                              ", ".join(self._parameters))
                continue
            try:
                config[name] = self._parameters[name].clamp(value)
            except (TypeError, ValueError) as error:
                rospy.logwarn("dynamic_reconfigure: %s%s keeps %r: %s", self._ns, name, config[name], error)
        return config

    def _level(self, config: Mapping[str, Any]) -> int:
        level = 0
        for name, parameter in self._parameters.items():
            if config[name] != self._config[name]:
                level |= parameter.level
        return level

    def _apply(self, config: Dict[str, Any], level: int, call_back: bool = True) -> None:
        if call_back:
            corrected = self._callback(dict(config), level)
            if corrected is not None:
                config = {name: parameter.clamp(corrected[name]) for name, parameter in self._parameters.items()}
        first = level == -1
        for name, value in config.items():
            if first or value != self._config[name]:
                rospy.set_param(self._ns + name, value)
        self._config = config
        self._updates.publish(self._encode(config))

    def _set(self, request: Any) -> ReconfigureResponse:
        values = {entry.name: entry.value for field in ("bools", "ints", "strs", "doubles")
                  for entry in getattr(request.config, field)}
        with self._lock:
            config = self._merged(values)
            if values:
                self._apply(config, self._level(config))
            return ReconfigureResponse(self._encode(self._config))

    def _encode(self, values: Mapping[str, Any]) -> Config:
        message = Config(groups=[GroupState("Default", True, 0, 0)])
        for name, parameter in self._parameters.items():
            _, field, entry, _, _ = _TYPES[parameter.type]
            getattr(message, field).append(entry(name, values[name]))
        return message

    def _describe(self) -> ConfigDescription:
        rows: List[ParamDescription] = [
            ParamDescription(parameter.name, _TYPES[parameter.type][0], parameter.level, parameter.description,
                             parameter.edit_method) for parameter in self._parameters.values()]
        return ConfigDescription(
            groups=[Group("Default", "", rows, 0, 0)],
            max=self._encode({name: parameter.high for name, parameter in self._parameters.items()}),
            min=self._encode({name: parameter.low for name, parameter in self._parameters.items()}),
            dflt=self._encode({name: parameter.default for name, parameter in self._parameters.items()}))
