"""Small formulas over the axes and buttons of a joystick: ``max(axes[2], 0.0) * -1.0``."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Sequence
from typing import cast

_OPERATORS: dict[type, Callable] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.BitXor: operator.xor,
    ast.USub: operator.neg,
}
_FUNCTIONS: dict[str, Callable] = {"abs": abs, "max": max, "min": min}
_LISTS = ("axes", "buttons")
_LONGEST = 1000  # characters


class Formula:
    """One formula. :raises ValueError: it uses something else than numbers, ``axes[i]``, ``buttons[i]``, ``+ - * / ^``,
    ``abs``, ``max`` and ``min``; one line."""

    def __init__(self, text: object):
        self.text = str(text)
        if len(self.text) > _LONGEST:
            raise ValueError(f"a formula of {len(self.text)} characters is too long, {_LONGEST} are possible")
        try:
            self._body = ast.parse(self.text.strip(), mode="eval").body
            self._check(self._body)
        except (SyntaxError, RecursionError):
            raise ValueError(f"'{self.text}' is no formula") from None

    def value(self, axes: Sequence[float], buttons: Sequence[int]) -> float:
        """What it makes of the joystick's ``axes`` and ``buttons``.

        :raises IndexError: the joystick has no such axis or button. :raises ArithmeticError: a division by zero.
        :raises TypeError: ``^`` of numbers that are not whole.
        """
        return self._value(self._body, {"axes": axes, "buttons": buttons})

    def _check(self, node: ast.expr) -> None:
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            return
        if isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
            self._check(node.left)
            self._check(node.right)
        elif isinstance(node, ast.UnaryOp) and type(node.op) in _OPERATORS:
            self._check(node.operand)
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id in _FUNCTIONS and node.args:
            for argument in node.args:
                self._check(argument)
        elif self._item(node) is None:
            raise ValueError(
                f"'{ast.unparse(node)}' in '{self.text}' is not understood: numbers, axes[i], buttons[i], + - * / ^, abs, max and min are"
            )

    @staticmethod
    def _item(node: ast.expr) -> tuple[str, int] | None:
        """("axes", 1) of ``axes[1]``; None of anything else."""
        if (
            isinstance(node, ast.Subscript)
            and isinstance(node.value, ast.Name)
            and node.value.id in _LISTS
            and isinstance(node.slice, ast.Constant)
            and type(node.slice.value) is int
        ):
            return node.value.id, node.slice.value
        return None

    def _value(self, node: ast.expr, lists: dict[str, Sequence[float]]) -> float:
        if isinstance(node, ast.Constant):
            return cast(float, node.value)
        if isinstance(node, ast.BinOp):
            return _OPERATORS[type(node.op)](self._value(node.left, lists), self._value(node.right, lists))
        if isinstance(node, ast.UnaryOp):
            return _OPERATORS[type(node.op)](self._value(node.operand, lists))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            return _FUNCTIONS[node.func.id](*(self._value(argument, lists) for argument in node.args))
        item = self._item(node)
        assert item is not None  # _check lets nothing else through
        name, index = item
        values = lists[name]
        if index >= len(values):
            raise IndexError(f"'{self.text}' asks for {name}[{index}], the joystick has {len(values)} {name}")
        return values[index]
