"""Expressions of every kind mean what they mean in Python; what would never end is refused at once."""

import builtins
import math
from types import SimpleNamespace

import pytest
from noetic_xacro.expressions import bound_symbols, safe_eval


def value(expression):
    """As xacro evaluates it."""
    builtin = vars(builtins)
    symbols = {
        **{
            name: builtin[name]
            for name in (
                "list dict map len str float int bool min max round sorted range abs all any divmod enumerate filter frozenset hash "
                "isinstance issubclass ord repr reversed slice set sum tuple type zip complex"
            ).split()
        },
        "math": SimpleNamespace(**vars(math)),
        "prod": math.prod,
        "lcm": math.lcm,
        "fsum": math.fsum,
        "pi": math.pi,
        "factorial": math.factorial,
        "comb": math.comb,
        "perm": math.perm,
        "name": "arm",
        "d": {"a": [1, 2]},
    }
    bound_symbols(symbols)
    return safe_eval(expression, symbols)


@pytest.mark.parametrize(
    "expression, wanted",
    [
        ("2 ** 10", 1024),
        ("2 ** -1", 0.5),
        ("0.5 ** 3", 0.125),
        ("(-8) ** 2", 64),
        ("1 ** 10 ** 9", 1),
        ("10 ** 300", 10**300),
        ("1 << 20", 1 << 20),
        ("-pi / 2 + 3 * 0.1", -math.pi / 2 + 3 * 0.1),
        ("7 % 3", 1),
        ("'%05.2f m' % pi", "03.14 m"),
        ("'%*d' % (5, 3)", "    3"),
        ("'ab' * 3", "ababab"),
        ("[0] * 6", [0] * 6),
        ("name + '_link'", "arm_link"),
        ("[1] + [2]", [1, 2]),
        ("sum([x * x for x in range(100)])", 328350),
        ("[x for a in range(300) for x in range(300)][-1]", 299),
        ("len(range(5, 100000, 7))", len(range(5, 100000, 7))),
        ("list(range(3, 0, -1))", [3, 2, 1]),
        ("round(2.567, 2)", 2.57),
        ("round(1234, -2)", 1200),
        ("round(5, -10 ** 9)", 0),
        ("factorial(20)", math.factorial(20)),
        ("comb(10, 3)", 120),
        ("f'{pi:.3f} {name!r:>8}'", "3.142    'arm'"),
        ("f'{pi:{4}.{2}}'", " 3.1"),
        ("'{:>6}'.format(name)", "   arm"),
        ("name.replace('r', 'RR').ljust(6)", "aRRm  "),
        ("'-'.join([name, 'x'])", "arm-x"),
        ("'7'.zfill(3)", "007"),
        ("d['a'][1]", 2),
        ("(lambda x: x ** 2)(3)", 9),
        ("1 if name == 'arm' else 9 ** 9 ** 9", 1),
        ("list(map(lambda x: x * 2, [1, 2]))", [2, 4]),
        ("list(filter(lambda x: x % 2, range(6)))", [1, 3, 5]),
        ("sorted(['b', 'a'], key=lambda x: x)", ["a", "b"]),
        ("list(map(str.upper, ['a', 'b']))", ["A", "B"]),
        ("dict(zip('ab', range(2)))", {"a": 0, "b": 1}),
        ("[*range(3), *'ab']", [0, 1, 2, "a", "b"]),
        ("{x: 1 for x in 'ab'}", {"a": 1, "b": 1}),
        ("isinstance([1], list) and type('a') == str and not isinstance(1, (str, list))", True),
        ("max(range(5)), min(3, 2), max([1, 2], key=lambda x: -x)", (4, 2, 1)),
        ("','.join(str(x) for x in range(3))", "0,1,2"),
        ("list(d.items())", [("a", [1, 2])]),
        ("sorted(d.keys()) + list(d)", ["a", "a"]),
        ("'%s %s' % ('a', 1)", "a 1"),
        ("(5).bit_length(), 'abc'[1:], [1, 2, 3][::-1]", (3, "bc", [3, 2, 1])),
        ("prod([2, 3]), lcm(4, 6), sum([[1], [2]], [])", (6, 12, [1, 2])),
        ("list(enumerate('ab'))", [(0, "a"), (1, "b")]),
        ("dict.fromkeys(['a'], 1)", {"a": 1}),
        ("(lambda f: f(f, 10))(lambda f, n: 1 if n < 2 else f(f, n - 1) + f(f, n - 2))", 89),
        ("math.sqrt(4) == 2.0 and math.pi < 4", True),
    ],
)
def test_what_an_expression_means(expression, wanted):
    found = value(expression)
    assert found == wanted and type(found) is type(wanted)


@pytest.mark.parametrize(
    "expression",
    [
        "9 ** 9 ** 9",
        "2 ** (10 ** 12)",
        "(-3) ** 10 ** 8",
        "1 << 10 ** 12",
        "10 ** 9000 * 10 ** 9000 * 10 ** 9000 * 10 ** 9000",
        "'a' * 10 ** 10",
        "10 ** 10 * [0]",
        "'a' * 10 ** 6 + 'a'",
        "'%10000000000d' % 1",
        "'%*d' % (10 ** 10, 1)",
        "f'{1:10000000000}'",
        "f'{1:{10 ** 10}}'",
        "'{:10000000000}'.format(1)",
        "'a'.ljust(10 ** 10)",
        "'7'.zfill(10 ** 10)",
        "('a' * 10 ** 6).replace('a', 'b' * 10 ** 6)",
        "('a' * 10 ** 6).join(['b'] * 10 ** 6)",
        "list(range(10 ** 10))",
        "sum([0 for a in range(10 ** 5) for b in range(10 ** 5)])",
        "[l.extend(l) for l in [[0]] for x in range(60)]",
        "factorial(10 ** 8)",
        "comb(10 ** 8, 5 * 10 ** 7)",
        "perm(10 ** 8)",
        "[(x := x * x) for x in [10] for _ in range(60)]",
        "[list(map(lambda x: list(map(lambda y: x, range(90000))), range(90000))), 1][1]",
        "list(filter(lambda x: list(filter(lambda y: True, range(90000))), range(90000)))",
        "sorted(range(90000), key=lambda x: sum(range(90000)))",
        "max(map(lambda x: max(range(90000)), range(90000)))",
        "list(map(list, [range(90000)] * 90000))",
        "list(map(sum, [range(90000)] * 90000))",
        "any(map(all, [[1] * 90000] * 90000)) and list(map(all, [[1] * 90000] * 90000))",
        "list(map(type([]), [range(90000)] * 90000))",
        "list(map(tuple, [range(90000)] * 90000))",
        "[[0] * 10 ** 6 for i in range(10 ** 5)]",
        "['a' * 10 ** 6 for i in range(10 ** 5)]",
        "str([[0] * 10 ** 6] * 10 ** 6)",
        "[[0] * 10 ** 6] * 10 ** 6",
        "f'{[[0] * 10 ** 6] * 10 ** 6}'",
        "'%s' % ([[0] * 10 ** 6] * 10 ** 6,)",
        "'{}'.format([[0] * 10 ** 6] * 10 ** 6)",
        "('{0}' * 10 ** 5).format('a' * 10 ** 5)",
        "[[0] * 10 ** 6] * 10 ** 6 == [[0] * 10 ** 6] * 10 ** 6",
        "1 in [[0] * 10 ** 6] * 10 ** 6",
        "sum([[0] * 10 ** 5] * 10 ** 5, [])",
        "{((0,) * 10 ** 6,) * 10 ** 6}",
        "hash(((0,) * 10 ** 6,) * 10 ** 6)",
        "{x: {y: 1 for y in range(90000)} for x in range(90000)}",
        "[*map(lambda x: [*range(90000)], range(90000))]",
        "list(zip(*[range(90000)] * 90000))",
        "list(map(lambda *x: 0, *[range(90000)] * 90000))",
        "[x[:] for x in [[0] * 10 ** 6] * 10 ** 6]",
        "[l.append(0) for l in [[0]] for x in l]",
        "[l.insert(0, 0) for l in [[0] * 10 ** 6] for x in range(10 ** 5)]",
        "(5).to_bytes(10 ** 10, 'big')",
        "list(map('a'.ljust, [10 ** 10]))",
        "prod([10 ** 9000] * 10 ** 5)",
        "lcm(*range(1, 10 ** 5 + 1)) ** 1000",
        "(lambda f: f(f, 90))(lambda f, n: 1 if n < 2 else f(f, n - 1) + f(f, n - 2))",
        "dict(zip(range(90000), map(lambda x: list(range(90000)), range(90000))))",
        "'a'.join(map(lambda x: 'b' * 10 ** 6, range(10 ** 5)))",
        "sorted([[0] * 10 ** 5, [0] * 10 ** 5] * 10 ** 5)",
        "list(map(lambda x: 'a' * 10 ** 6, range(90000)))",
    ],
)
def test_what_is_too_much_is_refused_at_once(expression):
    with pytest.raises((ValueError, SyntaxError)) as refused:
        value(expression)
    text = str(refused.value)
    assert "\n" not in text and len(text) < 200
    assert isinstance(refused.value, SyntaxError) or "is too much for a robot description" in text


@pytest.mark.parametrize("expression", ["__import__('os')", "name.__class__", "[x.__class__ for x in [1]]", "(lambda: name.__class__)()"])
def test_names_that_are_hidden(expression):
    with pytest.raises(ValueError, match="invalid name"):
        value(expression)
