"""The node's parameters and options, by upstream's names."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

from rosbridge_library.internal.exceptions import InvalidArgumentException, RosbridgeError
from rosbridge_library.internal.globs import globs

EVERYWHERE = "0.0.0.0"
BELOW = {"port": 65536}
AT_LEAST = {"retry_startup_delay": 0.01}


class SettingError(RosbridgeError):
    """A parameter or option that cannot be used, in one line."""


@dataclass(frozen=True)
class Settings:
    port: int = 9090  # 0: any that is free
    address: str = "127.0.0.1"  # upstream: 0.0.0.0
    certfile: str = ""
    keyfile: str = ""
    retry_startup_delay: float = 5.0  # s, between attempts to listen on the port
    fragment_timeout: float = 600.0  # s that the fragments of a message may take
    delay_between_messages: float = 0.0  # s
    max_message_size: int = 0  # characters of an outgoing message that is not yet cut into fragments; 0: any
    unregister_timeout: float = 10.0  # s that a publisher stays when no client uses it any more
    use_compression: bool = False
    authenticate: bool = False  # by the service /authenticate (package rosauth)
    token_file: str = ""  # a file whose first line is the token that an address needs: ws://localhost:9090/?token=...
    websocket_ping_interval: float = 0.0  # s; 0: none
    websocket_ping_timeout: float = 30.0  # s
    websocket_null_origin: bool = True  # whether pages from files may connect
    topics_glob: tuple[str, ...] = ()  # patterns of the shell; none: all
    services_glob: tuple[str, ...] = ()
    params_glob: tuple[str, ...] = ()
    bson_only_mode: bool = False

    @classmethod
    def read(cls, get: Callable[[str, Any], Any], words: list[str], warn: Callable[[str], None]) -> Settings:
        """The settings by parameters and command line.

        :param get: value of a private parameter, or a default
        :param words: of the command line
        :param warn: is told what has no effect, a line each
        :raises SettingError: a value cannot be used
        """
        parser = argparse.ArgumentParser(prog="rosbridge_websocket", allow_abbrev=False)
        for field in fields(cls):
            if field.default is False:
                parser.add_argument(f"--{field.name}", action="store_true", default=None)
            else:
                parser.add_argument(f"--{field.name}")
        parser.add_argument("--websocket_external_port")
        options, rest = parser.parse_known_args(words)
        if rest:
            warn(f"{' '.join(rest)}: there is no such option")
        if get("binary_encoder", "default") not in ("default", "b64"):
            warn("~binary_encoder has no effect here; bytes are base64, and bytes in bson_only_mode")
        values: dict[str, Any] = {}
        for field in fields(cls):
            value = getattr(options, field.name)
            values[field.name] = _checked(field.name, get(field.name, field.default) if value is None else value, field.default)
        if values["services_glob"]:
            values["services_glob"] += ("/rosapi/*",)  # what a page asks for what there is
        if bool(values["certfile"]) != bool(values["keyfile"]):
            raise SettingError("~certfile and ~keyfile: give both, or none")
        values["address"] = values["address"] or EVERYWHERE
        return cls(**values)

    def token(self) -> str:
        """What :attr:`token_file` has; "" where none is asked for.

        :raises SettingError:
        """
        if not self.token_file:
            return ""
        try:
            with open(self.token_file, encoding="utf-8") as stream:
                token = stream.readline().strip()
        except (OSError, UnicodeDecodeError) as error:
            raise SettingError(
                f"~token_file: {self.token_file} cannot be read: {getattr(error, 'strerror', None) or 'it is no text'}"
            ) from None
        if not token:
            raise SettingError(f"~token_file: the first line of {self.token_file} is empty")
        return token


def _checked(name: str, value: Any, default: Any) -> Any:
    if isinstance(default, tuple):
        try:
            return globs(name, value)
        except InvalidArgumentException as error:
            raise SettingError(str(error)) from None
    if value is None or value == "None":
        return default
    if isinstance(default, bool):
        known = {True: True, False: False, "true": True, "false": False}
        if not isinstance(value, (bool, str)) or value not in known:
            raise SettingError(f"{name} should be true or false, not {value!r}")
        return known[value]
    if isinstance(default, str):
        if not isinstance(value, str):
            raise SettingError(f"{name} should be a text, not {value!r}")
        return value
    kind = type(default)
    try:
        number = kind(value)
    except (TypeError, ValueError, OverflowError):
        number = None
    if number is None or isinstance(value, bool) or isinstance(value, float) and number != value or number != number:
        raise SettingError(f"{name} should be a {'whole ' if kind is int else ''}number, not {value!r}")
    if not AT_LEAST.get(name, 0) <= number < BELOW.get(name, float("inf")):
        raise SettingError(f"{name} is {value}: out of range")
    return number
