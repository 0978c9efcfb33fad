"""Python expressions on a message ``m``. No ROS."""

from __future__ import annotations

import importlib
from collections.abc import Iterable
from typing import Any


class ExpressionError(ValueError):
    """An expression that cannot be computed; one line that says which and why."""


def modules(names: Iterable[str]) -> tuple[dict[str, Any], tuple[str, ...]]:
    """:returns: what ``import`` binds, by name; and the names of modules that are not there."""
    bound, absent = {}, []
    for name in names:
        try:
            importlib.import_module(name)
        except ImportError:
            absent.append(name)
            continue
        first = name.split(".")[0]
        bound[first] = importlib.import_module(first)
    return bound, tuple(absent)


def compute(expression: str, m: Any, names: dict[str, Any]) -> Any:
    """Value of ``expression`` where ``m`` is the message and ``names`` are known besides.

    :raises ExpressionError: it has none.
    """
    try:
        return eval(expression, {**names, "m": m})
    except Exception as error:  # whatever people type, a node answers with one line
        raise ExpressionError(f"'{expression}': {type(error).__name__}: {error}") from error


def fill(tree: Any, m: Any) -> Any:
    """``tree`` of dicts and lists with every text that is a Python expression on ``m`` replaced by its value.

    Texts that name what is not there, or are no Python, stay as they are: they are values themselves, a frame for one.

    :raises ExpressionError: an expression on ``m`` fails, for example by a field that the message lacks.
    """
    if isinstance(tree, dict):
        return {key: fill(value, m) for key, value in tree.items()}
    if isinstance(tree, list):
        return [fill(value, m) for value in tree]
    if not isinstance(tree, str):
        return tree
    try:
        return compute(tree, m, {})
    except ExpressionError as error:
        if isinstance(error.__cause__, (NameError, SyntaxError)):
            return tree
        raise
