"""Classes of messages and services by the names of their types."""

from __future__ import annotations

import functools
from typing import Any

import roslib.message

from rosbridge_library.internal.exceptions import RosbridgeError


class InvalidTypeStringException(RosbridgeError):
    """No "package/Type"."""


class InvalidPackageException(RosbridgeError):
    """A package that is not here, or that does not define the type."""


def get_message_class(typestring: str) -> Any:
    """
    :param typestring: "package/Type"; more slashes than that do no harm
    :raises InvalidTypeStringException: it is none
    :raises InvalidPackageException: nothing here defines it
    """
    return _loaded(_normal(typestring), False)


def get_service_class(typestring: str) -> Any:
    """The class of the service ``typestring``, as :func:`get_message_class`."""
    return _loaded(_normal(typestring), True)


def get_message_instance(typestring: str) -> Any:
    """An empty message of the type ``typestring``, as :func:`get_message_class`."""
    return get_message_class(typestring)()


def get_service_instance(typestring: str) -> Any:
    """An object of the service class ``typestring``, as :func:`get_message_class`."""
    return get_service_class(typestring)()


def get_service_request_instance(typestring: str) -> Any:
    """An empty request of the service ``typestring``, as :func:`get_message_class`."""
    return get_service_class(typestring)._request_class()


def get_service_response_instance(typestring: str) -> Any:
    """An empty response of the service ``typestring``, as :func:`get_message_class`."""
    return get_service_class(typestring)._response_class()


def _normal(typestring: str) -> str:
    words = [word for word in typestring.split("/") if word] if isinstance(typestring, str) else []
    if len(words) != 2:
        raise InvalidTypeStringException(f"{typestring!r} is no type; types are written package/Type, as std_msgs/String")
    return "/".join(words)


@functools.cache  # errors are not kept: a package may be built in between
def _loaded(name: str, service: bool) -> Any:
    try:
        kind = (roslib.message.get_service_class if service else roslib.message.get_message_class)(name)
    except Exception as error:  # whatever a broken package raises when it is imported
        raise InvalidPackageException(f"{name} cannot be imported: {' '.join(str(error).split())}") from None
    if kind is None:
        raise InvalidPackageException(
            f"no package here defines the {'service' if service else 'message'} {name}; is its workspace built and sourced?"
        )
    return kind
