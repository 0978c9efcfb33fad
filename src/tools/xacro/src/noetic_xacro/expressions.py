"""``${...}``: Python expressions, as xacro evaluates them, but for what would run for hours or take all memory.

``9**9**9`` is a number of 370 million digits, ``'a' * 10**10`` a text of ten gigabytes: a slip of the keyboard, and roslaunch waits
for ever. Each operation that can make much out of little looks at what it would make first. No robot comes near the bounds.
"""
from __future__ import annotations

import ast
import functools
import math
import re
from types import CodeType
from typing import Any, Callable, Dict, Iterable, Iterator, Optional

MOST_BITS = 100_000  # of a whole number: 30 000 digits, of which Python prints 4 300
MOST_ITEMS = 1_000_000  # of a text or a list
MOST_RANGE = 100_000
MOST_ROUNDS = 5_000_000  # of all loops of one expression
_SEQUENCES = (str, bytes, list, tuple)
_GROWING = {"ljust", "rjust", "center", "zfill", "expandtabs", "replace", "join", "extend"}  # methods whose result may be a product
_WIDE = re.compile(r"\d{7}")  # in a format


def _refuse(what: str) -> None:
    raise ValueError(f"{what} is too much for a robot description")


def _shown(value: Any) -> str:
    text = repr(value) if not isinstance(value, int) or value.bit_length() < 200 else f"a number of {value.bit_length()} bits"
    return text if len(text) <= 40 else f"{text[:37]}..."


def _power(a: Any, b: Any) -> Any:
    if isinstance(a, int) and isinstance(b, int) and a.bit_length() > 1 and a.bit_length() * b > MOST_BITS:
        _refuse(f"{_shown(a)} to the power of {_shown(b)}")
    return a ** b


def _shift(a: Any, b: Any) -> Any:
    if isinstance(a, int) and isinstance(b, int) and a and a.bit_length() + b > MOST_BITS:
        _refuse(f"{_shown(a)} shifted by {_shown(b)}")
    return a << b


def _times(a: Any, b: Any) -> Any:
    for one, other in ((a, b), (b, a)):
        if isinstance(one, _SEQUENCES) and isinstance(other, int) and len(one) * other > MOST_ITEMS:
            _refuse(f"{_shown(one)} {_shown(other)} times")
    if isinstance(a, int) and isinstance(b, int) and a.bit_length() + b.bit_length() > MOST_BITS:
        _refuse(f"{_shown(a)} times {_shown(b)}")
    return a * b


def _plus(a: Any, b: Any) -> Any:
    if isinstance(a, _SEQUENCES) and isinstance(b, _SEQUENCES) and len(a) + len(b) > MOST_ITEMS:
        _refuse(f"a {type(a).__name__} of {len(a) + len(b)} items")
    return a + b


def _modulo(a: Any, b: Any) -> Any:
    if isinstance(a, (str, bytes)):
        _check_format(a, b if isinstance(b, (tuple, list)) and "*" in str(a) else ())
    return a % b


def _check_format(text: Any, widths: Iterable[Any]) -> None:
    if _WIDE.search(str(text)) or any(isinstance(w, int) and abs(w) > MOST_ITEMS for w in widths):
        _refuse(f"the width in the format {_shown(text)}")


def _format(spec: Any) -> Any:
    """A format specification of an f-string."""
    _check_format(spec, ())
    return spec


def _method(name: str, owner: Any, *arguments: Any, **named: Any) -> Any:
    if isinstance(owner, _SEQUENCES):
        if name == "format":
            _check_format(owner, arguments)
        elif name in _GROWING:
            sizes = [abs(x) if isinstance(x, int) else len(x) for x in (owner, *arguments) if isinstance(x, (int, *_SEQUENCES))]
            if math.prod(max(size, 1) for size in sizes) > 100 * MOST_ITEMS:
                _refuse(f"'{name}' of {_shown(owner)}")
    return getattr(owner, name)(*arguments, **named)


class _Rounds:
    """Counts how often the loops of one expression go round."""

    def __init__(self) -> None:
        self._left = MOST_ROUNDS

    def __call__(self, items: Iterable[Any]) -> Iterator[Any]:
        for item in items:
            self._left -= 1
            if self._left < 0:
                _refuse(f"a loop of more than {MOST_ROUNDS} rounds")
            yield item


def _range(*bounds: int) -> range:
    found = range(*bounds)
    if found and (found[-1] - found[0]) // found.step >= MOST_RANGE:
        _refuse(f"range({', '.join(map(_shown, bounds))})")
    return found


def _round(number: Any, digits: Optional[int] = None) -> Any:
    if isinstance(number, int) and isinstance(digits, int) and digits < -MOST_BITS:
        return 0
    return round(number, digits)


def _small(function: Callable[..., Any], most: int) -> Callable[..., Any]:
    """Of whole numbers up to ``most``."""
    @functools.wraps(function)
    def bounded(*arguments: Any) -> Any:
        if any(isinstance(x, int) and x > most for x in arguments):
            _refuse(f"{function.__name__}({', '.join(map(_shown, arguments))})")
        return function(*arguments)
    return bounded


_OPERATORS: Dict[type, str] = {
    ast.Pow: "__power__",
    ast.LShift: "__shift__",
    ast.Mult: "__times__",
    ast.Add: "__plus__",
    ast.Mod: "__modulo__",
}
_HELPERS: Dict[str, Any] = {"__power__": _power, "__shift__": _shift, "__times__": _times, "__plus__": _plus, "__modulo__": _modulo,
                            "__format__": _format, "__method__": _method}


class _Bounded(ast.NodeTransformer):
    """Operators, loops and methods that can make much out of little become calls of the functions above."""

    @staticmethod
    def _call(name: str, *arguments: ast.expr) -> ast.Call:
        return ast.Call(ast.Name(name, ast.Load()), list(arguments), [])

    def visit_BinOp(self, node: ast.BinOp) -> ast.AST:
        self.generic_visit(node)
        name = _OPERATORS.get(type(node.op))
        numbers = all(isinstance(side, ast.Constant) and isinstance(side.value, float) for side in (node.left, node.right))
        return self._call(name, node.left, node.right) if name and not numbers else node

    def visit_comprehension(self, node: ast.comprehension) -> ast.AST:
        self.generic_visit(node)
        node.iter = self._call("__rounds__", node.iter)
        return node

    def visit_FormattedValue(self, node: ast.FormattedValue) -> ast.AST:
        self.generic_visit(node)
        if node.format_spec is not None:
            spec = ast.FormattedValue(self._call("__format__", node.format_spec), -1, None)
            node.format_spec = ast.JoinedStr([spec])
        return node

    def visit_Call(self, node: ast.Call) -> ast.AST:
        self.generic_visit(node)
        if not isinstance(node.func, ast.Attribute) or node.func.attr not in {*_GROWING, "format"}:
            return node
        return ast.Call(ast.Name("__method__", ast.Load()), [ast.Constant(node.func.attr), node.func.value, *node.args], node.keywords)


@functools.lru_cache(4096)
def _compiled(expression: str) -> CodeType:
    tree = ast.parse(expression, "<expression>", "eval")
    names = {node.id if isinstance(node, ast.Name) else node.attr for node in ast.walk(tree) if isinstance(node, (ast.Name, ast.Attribute))}
    hidden = sorted(name for name in names if name.startswith("__"))
    if hidden:
        raise ValueError(f"Use of invalid name(s): {', '.join(hidden)}")
    return compile(ast.fix_missing_locations(_Bounded().visit(tree)), "<expression>", "eval")


def safe_eval(expression: str, symbols: Dict[str, Any], local: Any = None) -> Any:
    """Takes the place of ``xacro.safe_eval``.

    :raises ValueError: a name that begins with two underscores, or a result beyond all reason; and whatever Python has to say.
    """
    code = _compiled(expression.strip())
    symbols.update(_HELPERS, __builtins__={}, __rounds__=_Rounds())
    return eval(code, symbols, local)


def bound_symbols(symbols: Dict[str, Any]) -> None:
    """Replaces the functions that xacro offers to expressions and that can make much out of little."""
    replaced = {"range": _range, "round": _round, "factorial": _small(math.factorial, 3000), "comb": _small(math.comb, 3000),
                "perm": _small(math.perm, 3000)}
    spaces = [symbols] + [symbols[space] for space in ("python", "math") if isinstance(symbols.get(space), dict)]
    for space in spaces:
        space.update({name: function for name, function in replaced.items() if name in space})
