import math

import pytest
import rospy
from node_signals.parameters import ParameterError, is_number, of_kind, or_default, texts


@pytest.mark.parametrize(
    "value, number",
    [
        (1, True),
        (-0.5, True),
        (True, False),
        ("1", False),
        (None, False),
        ([1], False),
        (math.nan, False),
        (math.inf, False),
        (10**400, False),
    ],
)
def test_what_is_a_number(value, number):
    assert is_number(value) == number


def test_ranges_of_numbers():
    assert is_number(0, least=0) and not is_number(0, above=0) and not is_number(-1e-9, least=0)
    assert is_number(-math.inf, finite=False) and not is_number(math.nan, finite=False) and not is_number(10**400, finite=False)


@pytest.mark.parametrize(
    "value, kind, line",
    [
        ("fast", float, "parameter /a must be a number, it is 'fast'"),
        (True, int, "parameter /a must be a whole number, it is True"),
        (1, bool, "parameter /a must be true or false, it is 1"),
        (math.nan, float, "parameter /a must be a number, it is nan"),
        ({}, list, "parameter /a must be a list, it is {}"),
    ],
)
def test_a_value_of_another_kind(value, kind, line):
    with pytest.raises(ParameterError) as told:
        of_kind("parameter /a", value, kind)
    assert str(told.value) == line


def test_a_fraction_is_rounded_to_a_whole_number():
    """Down below a half, else up, as roscpp's getParam() of an int does with what is not negative (-1.2 is -2 to its fmod(), a slip)."""
    assert [of_kind("a", value, int) for value in (10.0, 2.4, 2.5, 0.49, -1.2)] == [10, 2, 3, 0, -1]


@pytest.mark.parametrize(
    "value, default, said",
    [
        (1, True, "parameter /a is 1, where true or false is expected: True is used"),
        ("fast", 2.0, "parameter /a is 'fast', where a number is expected: 2.0 is used"),
        (True, 3, "parameter /a is True, where a whole number is expected: 3 is used"),
        (5, "x", "parameter /a is 5, where a text is expected: 'x' is used"),
        (
            "$(arg height)",
            0.5,
            "parameter /a is '$(arg height)' (to <rosparam>, $(arg ...) is text without subst_value='true'), where a number is expected: "
            "0.5 is used",
        ),
    ],
)
def test_what_is_of_another_kind_than_the_default_is_the_default(value, default, said, monkeypatch):
    lines = []
    monkeypatch.setattr(rospy, "logerr", lambda text, *values: lines.append(text % values))
    assert or_default("/a", value, default) == default and lines == [said]


def test_values_of_the_kind_of_a_default():
    assert or_default("/a", 3, 0.5) == 3.0 and or_default("/a", 3.0, 7) == 3 and or_default("/a", False, True) is False
    with pytest.raises(ParameterError, match="/a must be a number, it is nan"):
        or_default("/a", math.nan, 0.5)


def test_values_of_their_kind():
    assert of_kind("a", 3, float) == 3.0 and type(of_kind("a", 3, float)) is float
    assert of_kind("a", math.inf, float) == math.inf and of_kind("a", ["x"], list) == ["x"]


def test_lists_of_names():
    assert texts("a", ["x", "y"]) == ["x", "y"] and texts("a", [], empty=True) == []
    for value in ([], "x", ["x", 1]):
        with pytest.raises(ParameterError, match="a must be a non-empty list of names, it is"):
            texts("a", value)
