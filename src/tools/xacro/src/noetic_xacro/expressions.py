"""``${...}``: Python expressions, as xacro evaluates them, but for what would run for hours or take all memory.

``9**9**9`` is a number of 370 million digits, ``'a' * 10**10`` a text of ten gigabytes: a slip of the keyboard, and roslaunch waits
for ever. Each operation that can make much out of little looks at what it would make first, and all that one expression does is
counted: rounds of loops, calls of lambdas, items that builtins and methods go through or make. No robot comes near the bounds.
"""

from __future__ import annotations

import ast
import functools
import math
import re
from collections.abc import Callable, ItemsView, Iterable, Iterator, KeysView, ValuesView
from types import CodeType
from typing import Any

MOST_BITS = 100_000  # of a whole number: 30 000 digits, of which Python prints 4 300
MOST_ITEMS = 1_000_000  # of a text or a list
MOST_RANGE = 100_000
MOST_ROUNDS = 5_000_000  # of all loops of one expression, and items that its builtins go through
MOST_MADE = 20_000_000  # items and characters that one expression makes
_CALL = 5  # rounds that a call of a lambda counts as: it takes as long
_SEQUENCES = (str, bytes, list, tuple)
_COLLECTIONS = (*_SEQUENCES, dict, set, frozenset)
_GROWING = {"ljust", "rjust", "center", "zfill", "expandtabs", "replace", "join", "extend"}  # methods whose result may be a product
_WIDE = re.compile(r"\d{7}")  # in a format


def _refuse(what: str) -> None:
    raise ValueError(f"{what} is too much for a robot description")


def _shown(value: Any) -> str:
    text = repr(value) if not isinstance(value, int) or value.bit_length() < 200 else f"a number of {value.bit_length()} bits"
    return text if len(text) <= 40 else f"{text[:37]}..."


class _Effort:
    """Counts what one expression does."""

    def __init__(self) -> None:
        self._rounds, self._made = MOST_ROUNDS, MOST_MADE

    def rounds(self, count: int = 1) -> None:
        self._rounds -= count
        if self._rounds < 0:
            _refuse(f"a loop of more than {MOST_ROUNDS} rounds")

    def make(self, value: Any) -> Any:
        """``value``, which was made now."""
        if isinstance(value, _COLLECTIONS):
            self._made -= len(value)
            if self._made < 0:
                _refuse(f"what has more than {MOST_MADE} items or characters")
        return value


_efforts: list[_Effort] = [_Effort()]  # of the expressions that are being evaluated, one for the sake of another


def _spend(count: int) -> None:
    _efforts[-1].rounds(count)


def _made(value: Any) -> Any:
    return _efforts[-1].make(value)


def _whole(value: Any) -> Any:
    """``value``, all of which is gone through: also what is in what is in it, as often as it is there."""
    todo = [value]
    while todo:
        item = todo.pop()
        if isinstance(item, _COLLECTIONS):
            _spend(len(item) if not isinstance(item, (str, bytes)) else len(item) // 64 + 1)
            if isinstance(item, dict):
                todo += [*item.keys(), *item.values()]
            elif not isinstance(item, (str, bytes)):
                todo += [each for each in item if isinstance(each, _COLLECTIONS)]
    return value


def _each(items: Any) -> Any:
    """``items`` for a function that goes through them once."""
    if isinstance(items, _COLLECTIONS):
        _spend(len(items))
        return items
    return _counted(items) if hasattr(items, "__iter__") else items


def _compared(items: Any) -> Any:
    """``items`` for a function that compares them, or what is in them."""
    if not hasattr(items, "__iter__"):
        return items
    return _whole(items if isinstance(items, _COLLECTIONS) else [*_counted(items)])


def _shown_whole(value: Any) -> Any:
    """``value`` for a function that writes all of it."""
    _whole([*_counted(value)] if isinstance(value, (KeysView, ValuesView, ItemsView)) else value)
    return value


def _counted(items: Iterable[Any]) -> Iterator[Any]:
    effort = _efforts[-1]
    for item in items:
        effort.rounds()
        yield item


def _power(a: Any, b: Any) -> Any:
    if isinstance(a, int) and isinstance(b, int) and a.bit_length() > 1 and a.bit_length() * b > MOST_BITS:
        _refuse(f"{_shown(a)} to the power of {_shown(b)}")
    return a**b


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
    return _made(a * b)


def _plus(a: Any, b: Any) -> Any:
    if isinstance(a, _SEQUENCES) and isinstance(b, _SEQUENCES) and len(a) + len(b) > MOST_ITEMS:
        _refuse(f"a {type(a).__name__} of {len(a) + len(b)} items")
    return _made(a + b)


def _modulo(a: Any, b: Any) -> Any:
    if isinstance(a, (str, bytes)):
        _check_format(a, b if isinstance(b, (tuple, list)) and "*" in str(a) else ())
        _check_fields(a.count("%") if isinstance(a, str) else a.count(b"%"), b if isinstance(b, tuple) else (b,))
        return _made(a % b)
    return a % b


def _check_format(text: Any, widths: Iterable[Any]) -> None:
    if _WIDE.search(str(text)) or any(isinstance(w, int) and abs(w) > MOST_ITEMS for w in widths):
        _refuse(f"the width in the format {_shown(text)}")


def _check_fields(count: int, values: Iterable[Any]) -> None:
    """``count`` fields of a format, each of which may show any of the values."""
    largest = max((len(_text(value)) for value in values), default=0)
    if count * largest > 100 * MOST_ITEMS:
        _refuse(f"a format of {count} fields with {largest} characters")


def _text(value: Any) -> str:
    return value if isinstance(value, str) else str(_whole(value))


def _format(spec: Any) -> Any:
    """A format specification of an f-string."""
    _check_format(spec, ())
    return spec


def _member(owner: Any, name: str) -> Any:
    """``owner.name``; methods of texts, lists and numbers look at what they would make."""
    kind = _KINDS.get(owner) if callable(owner) and isinstance(owner, _Kind) else None
    if kind is not None:  # str.upper
        if name in ("fromkeys", "maketrans", "fromhex"):
            return _going_through(getattr(kind, name), _each)
        getattr(kind, name)
        return lambda first, *others, **named: _member(first, name)(*others, **named)
    if isinstance(owner, (*_SEQUENCES, set, frozenset, int)) and callable(getattr(owner, name)):
        return functools.partial(_method, name, owner)
    return getattr(owner, name)


def _method(name: str, owner: Any, *arguments: Any, **named: Any) -> Any:
    if isinstance(owner, int):
        if any(isinstance(x, int) and x > MOST_ITEMS for x in arguments):
            _refuse(f"'{name}' of {_shown(owner)}")
        return getattr(owner, name)(*arguments, **named)
    _spend(len(owner) // 64 + 1 if isinstance(owner, (str, bytes)) else len(owner))
    arguments = tuple(x if isinstance(x, (*_COLLECTIONS, int, float)) or x is None or callable(x) else [*_counted(x)] for x in arguments)
    if isinstance(owner, _SEQUENCES):
        if name == "format":
            _check_format(owner, (*arguments, *named.values()))
            _check_fields(str(owner).count("{"), (*arguments, *named.values()))
        elif name in _GROWING:
            sizes = [abs(x) if isinstance(x, int) else len(x) for x in (owner, *arguments) if isinstance(x, (int, *_COLLECTIONS))]
            if math.prod(max(size, 1) for size in sizes) > 100 * MOST_ITEMS:
                _refuse(f"'{name}' of {_shown(owner)}")
        if name in ("sort", "index", "count", "remove"):
            _whole(owner)
        elif name == "join":
            _check_fields(len(arguments[0]) if arguments else 0, arguments[0] if arguments else ())
    return _made(getattr(owner, name)(*arguments, **named))


def _range(*bounds: int) -> range:
    found = range(*bounds)
    if found and (found[-1] - found[0]) // found.step >= MOST_RANGE:
        _refuse(f"range({', '.join(map(_shown, bounds))})")
    return found


def _round(number: Any, digits: int | None = None) -> Any:
    if isinstance(number, int) and isinstance(digits, int) and digits < -MOST_BITS:
        return 0
    return round(number, digits)


def _sum(items: Any, start: Any = 0) -> Any:
    total = start
    for item in _each(items):
        total = total + item if isinstance(item, float) or type(item) is int is type(total) else _plus(total, item)
    return total


def _product(items: Any, *, start: Any = 1) -> Any:
    total = start
    for item in _each(items):
        total = _times(total, item)
    return total


def _multiple(*numbers: int) -> int:
    total = 1
    for number in _each(numbers):
        total = math.lcm(total, number)
        if total.bit_length() > MOST_BITS:
            _refuse(f"lcm of {len(numbers)} numbers")
    return total


def _zip(*lists: Any, **named: Any) -> Iterator[Any]:
    make = _efforts[-1].make
    for items in zip(*lists, **named):
        yield make(items)


def _map(function: Callable[..., Any], *lists: Any) -> Iterator[Any]:
    return map(function, *lists) if len(lists) < 2 else (function(*items) for items in _zip(*lists))


def _small(function: Callable[..., Any], most: int) -> Callable[..., Any]:
    """Of whole numbers up to ``most``."""

    @functools.wraps(function)
    def bounded(*arguments: Any) -> Any:
        if any(isinstance(x, int) and x > most for x in arguments):
            _refuse(f"{function.__name__}({', '.join(map(_shown, arguments))})")
        return function(*arguments)

    return bounded


def _going_through(function: Callable[..., Any], prepare: Callable[[Any], Any]) -> Callable[..., Any]:
    """A builtin whose arguments are counted."""

    @functools.wraps(function)
    def bounded(*arguments: Any, **named: Any) -> Any:
        return _made(function(*map(prepare, arguments), **named))

    return bounded


class _Kind:
    """A type that xacro offers, as ``list``: what is made by it is counted."""

    def __init__(self, kind: type) -> None:
        self._kind = kind
        self._make = _going_through(kind, _shown_whole if kind is str else _compared if kind in (set, frozenset) else _each)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        return self._make(*arguments, **named)

    def __repr__(self) -> str:
        return repr(self._kind)


_KINDS: dict[Any, type] = {_Kind(kind): kind for kind in (list, tuple, dict, set, frozenset, str)}
_BY_TYPE = {kind: offered for offered, kind in _KINDS.items()}


def _types(kinds: Any) -> Any:
    if isinstance(kinds, tuple):
        return tuple(map(_types, kinds))
    return _KINDS.get(kinds, kinds) if isinstance(kinds, _Kind) else kinds


def _type(value: Any) -> Any:
    return _BY_TYPE.get(type(value), type(value))


_REPLACED: dict[str, Any] = {
    **{kind.__name__: offered for kind, offered in _BY_TYPE.items()},
    **{function.__name__: _going_through(function, _each) for function in (any, all, math.fsum)},
    **{function.__name__: _going_through(function, _compared) for function in (sorted, min, max)},
    **{function.__name__: _going_through(function, _shown_whole) for function in (repr, hash)},
    "range": _range,
    "round": _round,
    "zip": _zip,
    "map": _map,
    "sum": _sum,
    "prod": _product,
    "lcm": _multiple,
    "type": _type,
    "isinstance": lambda value, kinds: isinstance(value, _types(kinds)),
    "issubclass": lambda kind, kinds: issubclass(_types(kind), _types(kinds)),
    "factorial": _small(math.factorial, 3000),
    "comb": _small(math.comb, 3000),
    "perm": _small(math.perm, 3000),
}


_OPERATORS: dict[type, str] = {
    ast.Pow: "__power__",
    ast.LShift: "__shift__",
    ast.Mult: "__times__",
    ast.Add: "__plus__",
    ast.Mod: "__modulo__",
}
_HELPERS: dict[str, Any] = {
    "__power__": _power,
    "__shift__": _shift,
    "__times__": _times,
    "__plus__": _plus,
    "__modulo__": _modulo,
    "__format__": _format,
    "__member__": _member,
    "__rounds__": _counted,
    "__each__": _each,
    "__spend__": _spend,
    "__made__": _made,
    "__whole__": _whole,
}


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
        node.value = self._call("__made__", self._call("__whole__", node.value))
        if node.format_spec is not None:
            spec = ast.FormattedValue(self._call("__format__", node.format_spec), -1, None)
            node.format_spec = ast.JoinedStr([spec])
        return node

    def visit_Attribute(self, node: ast.Attribute) -> ast.AST:
        self.generic_visit(node)
        return self._call("__member__", node.value, ast.Constant(node.attr))

    def visit_Lambda(self, node: ast.Lambda) -> ast.AST:
        self.generic_visit(node)
        counted = ast.Tuple([self._call("__spend__", ast.Constant(_CALL)), node.body], ast.Load())
        node.body = ast.Subscript(counted, ast.Constant(1), ast.Load())
        return node

    def visit_Starred(self, node: ast.Starred) -> ast.AST:
        self.generic_visit(node)
        node.value = self._call("__each__", node.value)
        return node

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        self.generic_visit(node)
        return self._call("__made__", node) if isinstance(node.slice, ast.Slice) else node

    def visit_Compare(self, node: ast.Compare) -> ast.AST:
        self.generic_visit(node)
        node.left = self._call("__whole__", node.left)
        node.comparators = [self._call("__whole__", value) for value in node.comparators]
        return node

    def visit_Set(self, node: ast.Set) -> ast.AST:
        self.generic_visit(node)
        node.elts = [value if isinstance(value, ast.Starred) else self._call("__whole__", value) for value in node.elts]
        return node

    def visit_SetComp(self, node: ast.SetComp) -> ast.AST:
        self.generic_visit(node)
        node.elt = self._call("__whole__", node.elt)
        return node

    def visit_Dict(self, node: ast.Dict) -> ast.AST:
        self.generic_visit(node)
        node.keys = [None if key is None else self._call("__whole__", key) for key in node.keys]
        return node

    def visit_DictComp(self, node: ast.DictComp) -> ast.AST:
        self.generic_visit(node)
        node.key = self._call("__whole__", node.key)
        return node


@functools.lru_cache(4096)
def _compiled(expression: str) -> CodeType:
    tree = ast.parse(expression, "<expression>", "eval")
    names = {node.id if isinstance(node, ast.Name) else node.attr for node in ast.walk(tree) if isinstance(node, (ast.Name, ast.Attribute))}
    hidden = sorted(name for name in names if name.startswith("__"))
    if hidden:
        raise ValueError(f"Use of invalid name(s): {', '.join(hidden)}")
    return compile(ast.fix_missing_locations(_Bounded().visit(tree)), "<expression>", "eval")


def safe_eval(expression: str, symbols: dict[str, Any], local: Any = None) -> Any:
    """Takes the place of ``xacro.safe_eval``: the value of ``expression`` with the names ``symbols``, and ``local`` before them.

    :raises ValueError: a name that begins with two underscores, or a result beyond all reason; and whatever Python has to say.
    """
    code = _compiled(expression.strip())
    symbols.update(_HELPERS, __builtins__={})
    _efforts.append(_Effort())
    try:
        return _whole(eval(code, symbols, local))
    finally:
        _efforts.pop()


def bound_symbols(symbols: dict[str, Any]) -> None:
    """Replaces the functions that xacro offers to expressions and that can make much out of little."""
    spaces = [symbols] + [symbols[space] for space in ("python", "math") if isinstance(symbols.get(space), dict)]
    for space in spaces:
        space.update({name: function for name, function in _REPLACED.items() if name in space})
