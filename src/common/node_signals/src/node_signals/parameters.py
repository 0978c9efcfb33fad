"""Parameters of ROS nodes, read with one line for what is wrong with them: the one place where a value is judged.

::

    number("~rate", 10.0, least=0)          a number of the node's own; ParameterError where it is none
    get("~joints", kind=list)               of another kind, and required: there is no default
    of_kind("parameter /a/b", value, int)   a value that has been read already, out of a table say
    number_or("/a/b", value, 1.0)           told, and the default taken
    is_number(value, least=0)               for who has a sentence of his own

YAML's true and false are no numbers here, though Python counts them among them, and NaN is none.
"""

import math
import sys
from collections.abc import Callable
from typing import Any

_KINDS = {float: "a number", int: "a whole number", bool: "true or false", str: "a text", list: "a list", dict: "a map"}
#: In place of a default: the parameter must be there.
REQUIRED = object()


class ParameterError(ValueError):
    """A parameter is missing, of the wrong kind or out of its range; the line says which, what it is and what it must be."""


def is_number(value: Any, least: float = -math.inf, above: float | None = None, finite: bool = True) -> bool:
    """Whether ``value`` is a number of at least ``least`` and, if that is given, greater than ``above``.

    :param finite: False lets infinity pass; NaN never does
    """
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    if not abs(value) <= sys.float_info.max and (finite or value != value or isinstance(value, int)):
        return False
    return value >= least and (above is None or value > above)


def of_kind(where: str, value: Any, kind: type, shown: Callable[[Any], str] = repr) -> Any:
    """``value`` as a ``kind``.

    :param where: what it is the value of, the beginning of the line: ``parameter /arm/rate``
    :param kind: float (whole numbers and infinities accepted), int, bool, str, list or dict
    :param shown: how the value is shown
    :raises ParameterError: it is of another kind
    """
    if kind is float and is_number(value, finite=False):
        return float(value)
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)) or value != value:
        raise ParameterError(f"{where} must be {_KINDS.get(kind, kind.__name__)}, it is {shown(value)}")
    return value


def get(name: str, default: Any = REQUIRED, kind: type | None = None) -> Any:
    """The parameter ``name``, or ``default``.

    :param name: as for rospy.get_param
    :raises ParameterError: it is not there though it has no default, or of another kind than ``kind``
    """
    import rospy  # here: a value that has been read is judged without ROS

    value = rospy.get_param(name, default)
    if value is REQUIRED:
        raise ParameterError(f"parameter {rospy.resolve_name(name)} is not set")
    return value if kind is None or value is default else of_kind(f"parameter {rospy.resolve_name(name)}", value, kind)


def number(name: str, default: float, least: float = -math.inf) -> float:
    """A finite number.

    :param name: as for rospy.get_param
    :param default: where the parameter is not set; checked alike
    :param least: the smallest that is allowed
    :raises ParameterError: it is no number, or too small
    """
    import rospy  # here: a value that has been read is judged without ROS

    value = rospy.get_param(name, default)
    if is_number(value, least):
        return float(value)
    bound = "" if least == -math.inf else f", {least:g} or more"
    raise ParameterError(f"parameter {rospy.resolve_name(name)} must be a number{bound}, but is {value!r:.40}")


def number_or(where: str, value: Any, default: float) -> float:
    """``value`` as a finite number; anything else is told in an ERROR line, and ``default`` taken in its place.

    :param where: the name of the parameter
    """
    if is_number(value):
        return float(value)
    import rospy

    shown = repr(value)
    rospy.logerr(
        "parameter %s is %s, where a number is expected: %g is used", where, shown if len(shown) <= 40 else shown[:37] + "...", default
    )
    return default


def texts(where: str, value: Any, empty: bool = False, shown: Callable[[Any], str] = repr) -> list[str]:
    """``value`` as a list of names.

    :param where: as for :func:`of_kind`
    :param empty: whether it may have none
    :param shown: how the message writes a value that is refused
    :raises ParameterError: it is something else
    """
    if not isinstance(value, list) or not (value or empty) or not all(isinstance(entry, str) for entry in value):
        raise ParameterError(f"{where} must be a {'' if empty else 'non-empty '}list of names, it is {shown(value)}")
    return value
