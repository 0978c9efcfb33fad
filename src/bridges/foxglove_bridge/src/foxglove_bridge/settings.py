"""The node's parameters, by upstream's names."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

CAPABILITIES = ("clientPublish", "parameters", "parametersSubscribe", "services", "connectionGraph", "assets")
MESHES = r"package://[-\w]+(/[-\w. %]+)+\.(dae|fbx|glb|gltf|jpe?g|mtl|obj|png|stl|tiff?|urdf|webp|xacro)"
TRIES = 50  # ports, one after the other, where a program finds its own
NOT_HERE = ("tls", "certfile", "keyfile", "use_compression", "send_buffer_limit")


class BridgeError(Exception):
    """Root of this package's errors: one line each."""


class SettingError(BridgeError):
    """A parameter that cannot be used, in one line."""


@dataclass(frozen=True)
class Settings:
    port: int = 8765
    address: str = "127.0.0.1"  # upstream: 0.0.0.0
    topic_whitelist: tuple[str, ...] = (".*",)  # regular expressions of whole names
    service_whitelist: tuple[str, ...] = (".*",)
    param_whitelist: tuple[str, ...] = (".*",)
    client_topic_whitelist: tuple[str, ...] = (".*",)
    asset_uri_allowlist: tuple[str, ...] = (MESHES,)
    capabilities: tuple[str, ...] = CAPABILITIES
    max_update_ms: int = 5000  # ms of wall time, at most, until a new topic is seen
    service_type_retrieval_timeout_ms: int = 250  # ms that a server has to tell the type of its service

    @classmethod
    def read(cls, get: Callable[[str, Any], Any], warn: Callable[[str], None]) -> Settings:
        """The settings by parameters.

        :param get: value of a private parameter, or a default
        :param warn: is told what has no effect, a line each
        :raises SettingError: a value cannot be used
        """
        for name in NOT_HERE:
            if get(name, None) not in (None, False, "", []):
                warn(f"~{name} has no effect here; put a proxy in front of the port for TLS")
        return cls(**{field.name: _checked(field.name, get(field.name, field.default), field.default) for field in fields(cls)})


def _checked(name: str, value: Any, default: Any) -> Any:
    if isinstance(default, tuple):
        words = [value] if isinstance(value, str) else value
        if not isinstance(words, (list, tuple)) or not all(isinstance(word, str) for word in words):
            raise SettingError(f"~{name} should be a list of texts, not {value!r}")
        for word in words if name != "capabilities" else ():
            try:
                re.compile(word)
            except re.error as error:
                raise SettingError(f"~{name}: {word!r} is no regular expression: {error}") from None
        return tuple(words)
    if type(value) is not type(default):
        raise SettingError(f"~{name} should be {'a whole number' if isinstance(default, int) else 'a text'}, not {value!r}")
    if name == "port" and not 0 <= value < 65536 or name.endswith("_ms") and value <= 0:
        raise SettingError(f"~{name} is {value}: out of range")
    return value


def allowed(name: str, patterns: tuple[str, ...]) -> bool:
    """Whether ``name`` fits one of ``patterns``, regular expressions, whole and whatever the case."""
    return any(re.fullmatch(pattern, name, re.IGNORECASE) for pattern in patterns)


def unknown(capabilities: tuple[str, ...]) -> list[str]:
    """Those of ``capabilities`` that there are not."""
    return [name for name in capabilities if name not in CAPABILITIES]
