import math

import pytest
from node_signals.parameters import ParameterError, is_number, of_kind, texts


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
        (1.5, int, "parameter /a must be a whole number, it is 1.5"),
        (1, bool, "parameter /a must be true or false, it is 1"),
        (math.nan, float, "parameter /a must be a number, it is nan"),
        ({}, list, "parameter /a must be a list, it is {}"),
    ],
)
def test_a_value_of_another_kind(value, kind, line):
    with pytest.raises(ParameterError) as told:
        of_kind("parameter /a", value, kind)
    assert str(told.value) == line


def test_values_of_their_kind():
    assert of_kind("a", 3, float) == 3.0 and type(of_kind("a", 3, float)) is float
    assert of_kind("a", math.inf, float) == math.inf and of_kind("a", ["x"], list) == ["x"]


def test_lists_of_names():
    assert texts("a", ["x", "y"]) == ["x", "y"] and texts("a", [], empty=True) == []
    for value in ([], "x", ["x", 1]):
        with pytest.raises(ParameterError, match="a must be a non-empty list of names, it is"):
            texts("a", value)
