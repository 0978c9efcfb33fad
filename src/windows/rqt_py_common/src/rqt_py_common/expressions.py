"""Values of message fields from expressions that a user types, such as ``sin(i / 10.0) * 50``.

The text is Python, but only arithmetic, comparisons, lists, and the functions below: it cannot reach files, modules or
other objects, and what would take for ever (``9**9**9``) is an error. ``i`` counts the messages.
"""

import ast
import math
import operator
import random
import time
from collections.abc import Callable
from functools import partial
from types import SimpleNamespace
from typing import Any

import genpy
from genmsg.msgs import parse_type
from qt_gui.errors import WindowError

from rqt_py_common.expression_texts import LONGEST as _LONGEST
from rqt_py_common.expression_texts import METHODS, checked_format

_LARGEST_BITS = 4096  # of a whole number
_INTEGERS = {
    f"{sign}int{bits}": ((0, 2**bits - 1) if sign else (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1))
    for sign in ("", "u")
    for bits in (8, 16, 32, 64)
}
_INTEGERS.update(byte=_INTEGERS["int8"], char=_INTEGERS["uint8"])
_CONVERSIONS: dict[str, Callable[[Any], str]] = {"s": str, "r": repr, "a": ascii}


class ExpressionError(WindowError, ValueError):
    """An expression that has no value of the type that is wanted; one line says why."""


def _guarded_power(base, exponent):
    if isinstance(base, int) and isinstance(exponent, int) and abs(base) > 1 and exponent * base.bit_length() > _LARGEST_BITS:
        raise ExpressionError("the number would be too large")
    return base**exponent


def _guarded_product(left, right):
    for sequence, count in ((left, right), (right, left)):
        if isinstance(sequence, (str, bytes, list, tuple)) and isinstance(count, int):
            if len(sequence) * count > _LONGEST:
                raise ExpressionError(f"more than {_LONGEST} elements")
    return _small(left * right)


def _small(value):
    if isinstance(value, int) and value.bit_length() > _LARGEST_BITS:
        raise ExpressionError("the number would be too large")
    return value


def _guarded_shift(value, bits):
    if isinstance(bits, int) and bits > _LARGEST_BITS:
        raise ExpressionError("the number would be too large")
    return _small(value << bits)


def _limited(function):
    """A function of whole numbers that takes its time for large ones."""

    def call(*arguments):
        if any(isinstance(argument, int) and abs(argument) > 1000 for argument in arguments):
            raise ExpressionError("the number would be too large")
        return function(*arguments)

    return call


def _range(*arguments):
    numbers = range(*arguments)
    if len(numbers) > _LONGEST:
        raise ExpressionError(f"more than {_LONGEST} elements")
    return numbers


def _sum(values, start=0):
    return sum((value + 0 for value in values), start + 0)  # of numbers: lists would grow without bound


def _public(module, *names):
    return {name: getattr(module, name) for name in names}


_MATH = {name: value for name, value in vars(math).items() if not name.startswith("_")}
_MATH.update({name: _limited(_MATH[name]) for name in ("factorial", "comb", "perm") if name in _MATH})
_MATH["pow"] = math.pow
_RANDOM = _public(
    random,
    "random",
    "uniform",
    "randint",
    "randrange",
    "choice",
    "gauss",
    "normalvariate",
    "triangular",
    "betavariate",
    "expovariate",
    "gammavariate",
    "lognormvariate",
    "vonmisesvariate",
    "weibullvariate",
    "paretovariate",
)
_TIME = _public(time, "time", "monotonic", "ctime", "asctime", "gmtime", "localtime", "strftime", "perf_counter", "process_time")
_BUILTINS = dict(
    _public(
        __builtins__ if not isinstance(__builtins__, dict) else SimpleNamespace(**__builtins__),
        "abs",
        "bool",
        "float",
        "int",
        "str",
        "round",
        "min",
        "max",
        "len",
        "sorted",
        "list",
        "tuple",
        "ord",
        "chr",
        "all",
        "any",
        "zip",
        "enumerate",
        "divmod",
        "repr",
        "hex",
        "oct",
        "bin",
    ),
    range=_range,
    sum=_sum,
)
_TIMES = {"Time": genpy.Time, "Duration": genpy.Duration}
#: What a name means. random and time are functions here, as they always were; math, genpy and rospy have members.
NAMES: dict[str, Any] = {
    **_BUILTINS,
    **_MATH,
    **_RANDOM,
    **_TIME,
    **_TIMES,
    "math": SimpleNamespace(**_MATH),
    "genpy": SimpleNamespace(**_TIMES),
    "true": True,
    "false": False,
}
_MEMBERS = {
    SimpleNamespace: None,  # all
    genpy.Time: ("secs", "nsecs", "to_sec", "to_nsec", "is_zero"),
    genpy.Duration: ("secs", "nsecs", "to_sec", "to_nsec", "is_zero"),
    type: ("now", "from_sec"),
    str: ("upper", "lower", "strip", "split", "encode", *METHODS),
}
_BINARY = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: _guarded_product,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: _guarded_power,
    ast.LShift: _guarded_shift,
    ast.RShift: operator.rshift,
    ast.BitAnd: operator.and_,
    ast.BitOr: operator.or_,
    ast.BitXor: operator.xor,
}
_UNARY: dict[type, Callable[[Any], Any]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
    ast.Invert: operator.invert,
}
_COMPARE = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda a, b: a in b,
    ast.NotIn: lambda a, b: a not in b,
}

_COMPUTING = (ast.BinOp, ast.Call, ast.JoinedStr, ast.Compare, ast.IfExp, ast.Subscript, ast.ListComp, ast.BoolOp)


def _rospy_names():
    import rospy

    return {
        "rospy": SimpleNamespace(Time=rospy.Time, Duration=rospy.Duration, get_time=rospy.get_time),
        "Time": rospy.Time,
        "Duration": rospy.Duration,
        "genpy": SimpleNamespace(Time=rospy.Time, Duration=rospy.Duration),
    }  # those that know now()


class Expression:
    """An expression, parsed once and evaluated as often as wanted."""

    def __init__(self, text: str):
        """:raises ExpressionError: if the text is no expression, or one that is not allowed"""
        self.text = text
        if len(text) > 10 * _LONGEST:
            raise ExpressionError("the text is too long")
        try:
            self._tree = ast.parse(text.strip(), mode="eval").body
        except (SyntaxError, ValueError, MemoryError, RecursionError) as error:
            raise ExpressionError(f"not an expression: {getattr(error, 'msg', None) or error}") from error

    def value(self, names: dict[str, Any] | None = None) -> Any:
        """:param names: values of names beside NAMES
        :raises ExpressionError: whatever goes wrong
        """
        try:
            return _Evaluation({**NAMES, **_rospy_names(), **(names or {})}).of(self._tree)
        except ExpressionError:
            raise
        except RecursionError:
            raise ExpressionError("nested too deeply") from None
        except Exception as error:  # of any function that the text calls
            raise ExpressionError(str(error) or type(error).__name__) from error

    def computes(self) -> bool:
        """Whether it does more than name or list values."""
        return any(isinstance(node, _COMPUTING) for node in ast.walk(self._tree))

    def quoted(self, text: str) -> str:
        """The text that it quotes; ``text`` if it quotes none."""
        value = getattr(self._tree, "value", None)
        return value if isinstance(self._tree, ast.Constant) and isinstance(value, str) else text

    def meant(self, known: set[str]) -> bool:
        """Whether it is more than words that look like an expression, such as ``robot/base_link``; ``known``: names with values."""
        nodes = list(ast.walk(self._tree))
        if any(isinstance(node, (ast.Call, ast.JoinedStr)) or isinstance(getattr(node, "value", None), str) for node in nodes):
            return True
        return all(node.id in known for node in nodes if isinstance(node, ast.Name))


class _Evaluation:
    """Walks through a tree; a kind of node without a method here is not allowed."""

    def __init__(self, names: dict[str, Any]):
        self._names = names
        self._steps = 0

    def of(self, node: ast.AST) -> Any:
        self._steps += 1
        if self._steps > 5 * _LONGEST:
            raise ExpressionError("this takes too long")
        method = getattr(self, "_" + type(node).__name__, None)
        if method is None:
            raise ExpressionError(f"{type(node).__name__} is not allowed here")
        return method(node)

    def _Constant(self, node):
        return node.value

    def _Name(self, node):
        if node.id not in self._names:
            raise ExpressionError(f"name '{node.id}' is not defined")
        return self._names[node.id]

    def _Attribute(self, node):
        owner = self.of(node.value)
        kind = next((kind for kind in _MEMBERS if isinstance(owner, kind)), None)
        allowed = _MEMBERS.get(kind, ())
        if (
            kind is None
            or node.attr.startswith("_")
            or allowed is not None
            and node.attr not in allowed
            or kind is type
            and not issubclass(owner, genpy.TVal)
        ):
            raise ExpressionError(f".{node.attr} is not allowed here")
        if kind is str and node.attr in METHODS:
            return partial(METHODS[node.attr], owner)
        return getattr(owner, node.attr)

    def _Call(self, node):
        function = self.of(node.func)
        if not callable(function):
            raise ExpressionError(f"{ast.unparse(node.func)} is not a function")
        return _small(function(*self._elements(node.args), **{word.arg: self.of(word.value) for word in node.keywords if word.arg}))

    def _elements(self, nodes):
        values = []
        for node in nodes:
            values += list(self.of(node.value)) if isinstance(node, ast.Starred) else [self.of(node)]
        return values

    def _JoinedStr(self, node):
        text = "".join(self.of(part) for part in node.values)
        if len(text) > _LONGEST:
            raise ExpressionError(f"more than {_LONGEST} elements")
        return text

    def _FormattedValue(self, node):
        value = self.of(node.value)
        if node.conversion != -1:
            value = _CONVERSIONS[chr(node.conversion)](value)
        return checked_format(value, "" if node.format_spec is None else self.of(node.format_spec))

    def _UnaryOp(self, node):
        return _UNARY[type(node.op)](self.of(node.operand))

    def _BinOp(self, node):
        if type(node.op) not in _BINARY:
            raise ExpressionError("this operator is not allowed here")
        left, right = self.of(node.left), self.of(node.right)
        if isinstance(node.op, ast.Mod) and isinstance(left, (str, bytes)):
            return _format(left, right)
        value = _small(_BINARY[type(node.op)](left, right))
        if isinstance(value, (str, bytes, list, tuple)) and len(value) > _LONGEST:
            raise ExpressionError(f"more than {_LONGEST} elements")
        return value

    def _BoolOp(self, node):
        for value in node.values:
            result = self.of(value)
            if bool(result) is isinstance(node.op, ast.Or):
                break
        return result

    def _Compare(self, node):
        left = self.of(node.left)
        for comparison, right in zip(node.ops, map(self.of, node.comparators)):
            if type(comparison) not in _COMPARE or not _COMPARE[type(comparison)](left, right):
                return False
            left = right
        return True

    def _IfExp(self, node):
        return self.of(node.body if self.of(node.test) else node.orelse)

    def _List(self, node):
        return self._elements(node.elts)

    def _Tuple(self, node):
        return tuple(self._elements(node.elts))

    def _Dict(self, node):
        return {self.of(key): self.of(value) for key, value in zip(node.keys, node.values) if key is not None}

    def _Subscript(self, node):
        return self.of(node.value)[self.of(node.slice)]

    def _Slice(self, node):
        return slice(*(None if part is None else self.of(part) for part in (node.lower, node.upper, node.step)))

    def _ListComp(self, node):
        if len(node.generators) != 1 or not isinstance(node.generators[0].target, ast.Name):
            raise ExpressionError("only [... for name in ...] is allowed here")
        loop, outer, values = node.generators[0], dict(self._names), []
        for element in self.of(loop.iter):
            self._names[loop.target.id] = element
            if all(self.of(test) for test in loop.ifs):
                values.append(self.of(node.elt))
        self._names = outer
        return values


def _format(text, values):
    if any(width and int(width) > 1000 for width in _widths(text)):
        raise ExpressionError("the text would be too long")
    return text % values


def _widths(text):
    import re

    found = re.findall(r"%[-+ #0]*(\d*|\*)(?:\.(\d*|\*))?", text if isinstance(text, str) else text.decode("latin-1"))
    return [width.replace("*", "9999") for pair in found for width in pair]


def _text_value(text: str, counter: int) -> str:
    """An expression's value as text; plain words, numbers and lists are texts themselves.

    :raises ExpressionError: a call, a format, or an operator between known names or quoted texts has no value
    """
    try:
        expression = Expression(text)
    except ExpressionError:
        return text
    if not expression.computes() and text.strip() != "i":
        return expression.quoted(text)
    try:
        return str(expression.value({"i": counter}))
    except ExpressionError:
        if expression.meant({*NAMES, *_rospy_names(), "i"}):
            raise
        return text  # such as robot/base_link


def field_value(text: str, type_name: str, counter: int = 0) -> Any:
    """The value of a field of a primitive type, or of an array of them.

    :param text: an expression; for a string also the text itself
    :param type_name: as in a message definition: ``float64``, ``uint8[]``, ``string[3]``, ``time``
    :param counter: what ``i`` stands for
    :raises ExpressionError: if there is no such value
    """
    base, is_array, length = parse_type(type_name)
    if base == "string" and not is_array:
        return _text_value(text, counter)
    value = Expression(text).value({"i": counter})
    if not is_array:
        return convert(value, base)
    if base in ("uint8", "char") and isinstance(value, (bytes, bytearray)):
        value = list(value)
    if isinstance(value, (str, bytes, dict)) or not hasattr(value, "__iter__"):
        raise ExpressionError(f"{type_name} takes a list")
    values = [convert(element, base) for element in value]
    if length is not None and len(values) != length:
        raise ExpressionError(f"{type_name} takes {length} values, not {len(values)}")
    return values


def convert(value: Any, base: str) -> Any:
    """``value`` as ``base``, a primitive type of messages, takes it: floats for whole numbers are cut, whole numbers for floats
    widened.

    :raises ExpressionError: if it cannot
    """
    try:
        if base in ("time", "duration"):
            return _time(value, base)
        if base == "string":
            return value if isinstance(value, str) else str(value)
        if base == "bool":
            return bool(value)
        if base in _INTEGERS:
            return _integer(value, base)
        value = float(value)
    except ExpressionError:
        raise
    except (TypeError, ValueError, OverflowError) as error:
        raise ExpressionError(f"{_short(value)} is no {base}") from error
    if base == "float32" and math.isfinite(value) and abs(value) > 3.4028235e38:
        raise ExpressionError(f"{_short(value)} is out of the range of float32")
    return value


def _integer(value, base):
    if isinstance(value, str):
        raise TypeError
    number, (lowest, highest) = int(value), _INTEGERS[base]
    if not lowest <= number <= highest:
        raise ExpressionError(f"{_short(number)} is out of the range of {base}, {lowest} to {highest}")
    return number


def _time(value, base):
    kind = genpy.Time if base == "time" else genpy.Duration
    if isinstance(value, genpy.TVal):
        return kind(value.secs, value.nsecs)
    return kind.from_sec(float(value))


def _short(value) -> str:
    text = repr(value)
    return text if len(text) <= 40 else text[:37] + "..."
