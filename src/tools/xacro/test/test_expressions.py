"""Expressions of every kind mean what they mean in Python; what would never end is refused at once."""
import math

import pytest

from noetic_xacro.expressions import bound_symbols, safe_eval


def value(expression):
    """As xacro evaluates it."""
    symbols = {
        "list": list,
        "sum": sum,
        "len": len,
        "str": str,
        "int": int,
        "range": range,
        "round": round,
        "math": dict(vars(math)),
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
