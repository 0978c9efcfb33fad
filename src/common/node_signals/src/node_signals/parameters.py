"""Parameters of ROS nodes, read with one line for what is wrong with them: the one place where a value is judged.

::

    number("~rate", 10.0, least=0)          a number of the node's own; ParameterError where it is out of range
    get("~joints", kind=list)               of another kind, and required: there is no default
    of_kind("parameter /a/b", value, int)   a value that has been read already, out of a table say
    number_or("/a/b", value, 1.0)           told, and the default taken
    or_default("/a/b", value, 5)            a value of the default's kind; another is told, and the default taken
    is_number(value, least=0)               for who has a sentence of his own

YAML's true and false are no numbers here, though Python counts them among them, and NaN is none. What is optional and of another kind is
the default, as it is to roscpp's param(), though not in silence; a whole number with a fraction is rounded as there.
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
    if kind is int and isinstance(value, float) and is_number(value):
        return math.floor(value + 0.5)  # as roscpp's getParam() of an int, which takes negative ones down instead
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)) or value != value:
        raise ParameterError(f"{where} must be {_KINDS.get(kind, kind.__name__)}, it is {shown(value)}")
    return value


def get(name: str, default: Any = REQUIRED, kind: type | None = None) -> Any:
    """The parameter ``name``, or ``default``: also where it is of another kind than ``kind``, which is told.

    :param name: as for rospy.get_param
    :raises ParameterError: it has no default and is not there, or of another kind than ``kind``
    """
    import rospy  # here: a value that has been read is judged without ROS

    value = rospy.get_param(name, default)
    if value is REQUIRED:
        raise ParameterError(f"parameter {rospy.resolve_name(name)} is not set")
    if kind is None or value is default:
        return value
    where = rospy.resolve_name(name)
    return of_kind(f"parameter {where}", value, kind) if default is REQUIRED else or_default(where, value, default, kind)


def number(name: str, default: float, least: float = -math.inf) -> float:
    """A finite number.

    :param name: as for rospy.get_param
    :param default: where the parameter is not set, or of another kind, which is told
    :param least: the smallest that is allowed
    :raises ParameterError: it is not finite, or too small
    """
    import rospy  # here: a value that has been read is judged without ROS

    value = rospy.get_param(name, default)
    if is_number(value, least):
        return float(value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return number_or(rospy.resolve_name(name), value, default)
    bound = "" if least == -math.inf else f", {least:g} or more"
    raise ParameterError(f"parameter {rospy.resolve_name(name)} must be a number{bound}, but is {value!r:.40}")


def number_or(where: str, value: Any, default: float) -> float:
    """``value`` as a finite number; anything else is told in an ERROR line, and ``default`` taken in its place.

    :param where: the name of the parameter
    """
    if is_number(value):
        return float(value)
    _tell(where, value, "a number", f"{default:g}")
    return default


def or_default(where: str, value: Any, default: Any, kind: type | None = None) -> Any:
    """``value`` as a ``kind``, else of the kind of ``default``; one of another kind is told in an ERROR line, and ``default`` is taken.

    :param where: the name of the parameter
    :raises ParameterError: it is a number that is none
    """
    kind = kind or type(default)
    try:
        return of_kind(f"parameter {where}", value, kind)
    except ParameterError:
        if value != value:
            raise
    _tell(where, value, _KINDS.get(kind, kind.__name__), f"{default!r:.40}")
    return default


def _tell(where: str, value: Any, wanted: str, used: str) -> None:
    """An ERROR line: a parameter is of another kind than is ``wanted``, and what is ``used``."""
    import rospy

    shown = repr(value)
    hint = " (to <rosparam>, $(arg ...) is text without subst_value='true')" if isinstance(value, str) and "$(" in value else ""
    rospy.logerr(
        "parameter %s is %s%s, where %s is expected: %s is used",
        where,
        shown if len(shown) <= 40 else shown[:37] + "...",
        hint,
        wanted,
        used,
    )


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
