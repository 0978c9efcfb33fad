"""Formulas over axes and buttons."""

import pytest
from joystick.formula import Formula

AXES, BUTTONS = (0.25, -0.5, 1.0), (0, 1)


@pytest.mark.parametrize(
    "text, value",
    [
        ("axes[0]", 0.25),
        ("axes[1] * -2.0", 1.0),
        ("max(axes[1], 0.0)", 0.0),
        ("min(axes[0], axes[1], 0) - 1", -1.5),
        ("(axes[2] - 1.0) * 0.5", 0.0),
        ("abs(axes[1]) / 2", 0.25),
        ("buttons[0] ^ buttons[1]", 1),
        ("-buttons[1]", -1),
        (0.0, 0.0),
    ],
)
def test_values(text, value):
    assert Formula(text).value(AXES, BUTTONS) == value


@pytest.mark.parametrize(
    "text",
    [
        "axes",
        "axes[i]",
        "axes[-1]",
        "keys[0]",
        "open('x')",
        "axes[0].real",
        "2 ** 9",
        "'a'",
        "True",
        "abs()",
        "axes[0",
        "",
        "lambda: 0",
        "1" * 1001,
    ],
)
def test_anything_else_is_refused_with_one_line(text):
    with pytest.raises(ValueError) as told:
        Formula(text)
    assert "\n" not in str(told.value)


def test_what_the_joystick_does_not_have():
    with pytest.raises(IndexError, match=r"asks for axes\[7\], the joystick has 3 axes"):
        Formula("axes[7]").value(AXES, BUTTONS)
    with pytest.raises(ArithmeticError):
        Formula("1 / buttons[0]").value(AXES, BUTTONS)
