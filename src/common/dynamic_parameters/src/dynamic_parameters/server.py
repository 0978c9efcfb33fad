"""See the package docstring for how to use this."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import rosgraph
import rospy
from dynamic_reconfigure.msg import (
    BoolParameter,
    Config,
    ConfigDescription,
    DoubleParameter,
    Group,
    GroupState,
    IntParameter,
    ParamDescription,
    StrParameter,
)
from dynamic_reconfigure.srv import Reconfigure, ReconfigureResponse
from node_signals import master_watch, offers

#: Python type -> (name on the wire, field of Config, message of one value, lowest, highest)
_TYPES = {
    bool: ("bool", "bools", BoolParameter, False, True),
    int: ("int", "ints", IntParameter, -(2**31), 2**31 - 1),
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
    enum: Mapping[Any, str] | None = None

    @property
    def low(self) -> Any:
        return _TYPES[self.type][3] if self.min is None else self.min

    @property
    def high(self) -> Any:
        return _TYPES[self.type][4] if self.max is None else self.max

    def convert(self, value: Any) -> Any:
        """``value`` as this parameter's type, inside its range or not.

        :raises ValueError: not convertible.
        """
        return self.type(value)

    def clamp(self, value: Any) -> Any:
        """``value`` as this parameter's type, inside its range.

        :raises ValueError: not convertible.
        """
        value = self.convert(value)
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
        entries = [
            {
                "name": str(value),
                "type": kind,
                "value": value,
                "srcline": 0,
                "srcfile": "",
                "cconsttype": "",
                "ctype": "",
                "description": text,
            }
            for value, text in self.enum.items()
        ]
        return repr({"enum_description": self.description, "enum": entries})


class Server:
    """A dynamic_reconfigure server in ``namespace`` (absolute, or relative to the node's namespace, or ``~...``).

    :param parameters: what can be set. :param initial: by name, in place of the parameter server's values and the defaults; holds as it
        is, in the range or not.
    :param callback: is given all values and the level of what was changed; it may return others, which then hold.
    :param current: gives the values that are, where they change otherwise, too.
    """

    def __init__(
        self,
        namespace: str,
        parameters: Sequence[Parameter],
        callback: Callable[[dict[str, Any], int], Mapping[str, Any] | None],
        initial: Mapping[str, Any] | None = None,
        current: Callable[[], Mapping[str, Any]] | None = None,
    ):
        self._ns = rospy.resolve_name(namespace).rstrip("/") + "/"
        self._parameters = {parameter.name: parameter for parameter in parameters}
        self._callback = callback
        self._current = current
        self._closed = False
        self._lock = threading.RLock()
        self._config: dict[str, Any] = {}
        for parameter in parameters:
            self._config[parameter.name] = self._first_value(parameter, initial or {})
        self._descriptions = rospy.Publisher(self._ns + "parameter_descriptions", ConfigDescription, latch=True, queue_size=1)
        self._descriptions.publish(self._describe())
        self._updates = rospy.Publisher(self._ns + "parameter_updates", Config, latch=True, queue_size=1)
        self._config = self._called_back(self._config, -1)
        self._store(self._config)
        self._updates.publish(self._encode(self._config))
        self._service = offers.service(self._ns + "set_parameters", Reconfigure, self._set)
        master_watch.on_return(self._restore)

    @property
    def config(self) -> dict[str, Any]:
        """The current values."""
        with self._lock:
            return dict(self._config)

    def update(self, values: Mapping[str, Any], call_back: bool = False) -> None:
        """Change values from the program's side, which are taken as they are, and tell the clients.

        :param call_back: also call the callback, as for a change by a client.
        """
        with self._lock:
            config = self._merged(self._config, values, Parameter.convert)
            if call_back:
                config = self._called_back(config, self._level(self._config, config))
            self._take(config)

    def refresh(self) -> None:
        """Tell the clients what ``current`` says now: the program, or another client of it, has changed something."""
        with self._lock:
            self._take(self._live())

    def shutdown(self) -> None:
        """Withdraw topics and service; the values stay on the parameter server."""
        with self._lock:
            self._closed = True
        self._service.shutdown("no longer needed")
        self._descriptions.unregister()
        self._updates.unregister()

    def _first_value(self, parameter: Parameter, initial: Mapping[str, Any]) -> Any:
        if parameter.name in initial:
            return parameter.convert(initial[parameter.name])  # it is what is, whatever the table allows
        value = rospy.get_param(self._ns + parameter.name, parameter.default)
        try:
            return parameter.clamp(value)
        except (TypeError, ValueError, OverflowError):
            rospy.logwarn(
                "parameter %s%s is %r, which is no %s; using %r",
                self._ns,
                parameter.name,
                value,
                _TYPES[parameter.type][0],
                parameter.default,
            )
            return parameter.default

    def _live(self) -> dict[str, Any]:
        return self._config if self._current is None else dict(self._current())

    def _merged(
        self, config: Mapping[str, Any], values: Mapping[str, Any], take: Callable[[Parameter, Any], Any] = Parameter.clamp
    ) -> dict[str, Any]:
        config = dict(config)
        for name, value in values.items():
            if name not in self._parameters:
                rospy.logwarn(
                    "dynamic_reconfigure: %s has no parameter '%s'; it has: %s", self._ns.rstrip("/"), name, ", ".join(self._parameters)
                )
                continue
            try:
                config[name] = take(self._parameters[name], value)
            except (TypeError, ValueError, OverflowError) as error:
                rospy.logwarn("dynamic_reconfigure: %s%s keeps %r: %s", self._ns, name, config[name], error)
        return config

    def _level(self, before: Mapping[str, Any], config: Mapping[str, Any]) -> int:
        level = 0
        for name, parameter in self._parameters.items():
            if config[name] != before[name]:
                level |= parameter.level
        return level

    def _called_back(self, config: dict[str, Any], level: int) -> dict[str, Any]:
        corrected = self._callback(dict(config), level)
        if corrected is None:
            return config
        return {name: parameter.convert(corrected[name]) for name, parameter in self._parameters.items()}

    def _take(self, config: dict[str, Any]) -> None:
        changed = {name: value for name, value in config.items() if value != self._config[name]}
        self._config = config
        self._store(changed)
        self._updates.publish(self._encode(config))

    def _store(self, values: Mapping[str, Any]) -> None:
        """Keep values on the parameter server, when there is one."""
        try:
            for name, value in values.items():
                rospy.set_param(self._ns + name, value)
        except (OSError, rosgraph.MasterException) as error:
            rospy.logdebug("dynamic_reconfigure: the parameters in %s are not stored: %s", self._ns, error)

    def _restore(self) -> None:
        with self._lock:
            if not self._closed:
                self._store(self._config)

    def _set(self, request: Any) -> ReconfigureResponse:
        values = {entry.name: entry.value for field in ("bools", "ints", "strs", "doubles") for entry in getattr(request.config, field)}
        with self._lock:
            if self._closed:  # a connection that the client has kept
                return ReconfigureResponse(self._encode(self._config))
            try:
                if values:
                    self._change(values)
                elif self._current is not None:
                    self._take(self._live())
            except Exception as error:  # whatever the program raises, the client gets an answer and the program goes on
                reason = str(error) if isinstance(error, ValueError) else f"{type(error).__name__}: {error}"
                rospy.logwarn("dynamic_reconfigure: %s stays as it was: %s", self._ns.rstrip("/"), reason)
                self._updates.publish(self._encode(self._config))
            return ReconfigureResponse(self._encode(self._config))

    def _change(self, values: Mapping[str, Any]) -> None:
        before = self._live()
        wanted = self._merged(before, values)
        config = self._called_back(wanted, self._level(before, wanted))
        self._take(config if self._current is None else self._live())

    def _encode(self, values: Mapping[str, Any]) -> Config:
        message = Config(groups=[GroupState("Default", True, 0, 0)])
        for name, parameter in self._parameters.items():
            _, field, entry, low, high = _TYPES[parameter.type]
            value = values[name]
            getattr(message, field).append(entry(name, min(max(value, low), high) if parameter.type is int else value))
        return message

    def _describe(self) -> ConfigDescription:
        rows: list[ParamDescription] = [
            ParamDescription(parameter.name, _TYPES[parameter.type][0], parameter.level, parameter.description, parameter.edit_method)
            for parameter in self._parameters.values()
        ]
        return ConfigDescription(
            groups=[Group("Default", "", rows, 0, 0)],
            max=self._encode({name: parameter.high for name, parameter in self._parameters.items()}),
            min=self._encode({name: parameter.low for name, parameter in self._parameters.items()}),
            dflt=self._encode({name: parameter.default for name, parameter in self._parameters.items()}),
        )
