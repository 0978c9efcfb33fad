"""One row of a table: its range and its type. The server is tested where it is used (control_toolbox, gazebo_ros)."""

import ast

import pytest
from dynamic_parameters import Parameter


@pytest.mark.parametrize(
    "parameter, value, kept",
    [
        (Parameter("p", float, 0.0, -1.0, 1.0), 3, 1.0),
        (Parameter("p", float, 0.0, -1.0, 1.0), -3, -1.0),
        (Parameter("p", float, 0.0), 1e9, 1e9),
        (Parameter("n", int, 0, 0, 10), 7.9, 7),
        (Parameter("n", int, 0), 2**40, 2**31 - 1),
        (Parameter("b", bool, False), 1, True),
        (Parameter("s", str, "", enum={"a": "one"}), "b", "b"),
    ],
)
def test_values_are_brought_into_type_and_range(parameter, value, kept):
    clamped = parameter.clamp(value)
    assert clamped == kept and type(clamped) is parameter.type


@pytest.mark.parametrize(
    "parameter, value", [(Parameter("p", float, 0.0), float("nan")), (Parameter("p", float, 0.0), "fast"), (Parameter("n", int, 0), None)]
)
def test_what_is_no_value_is_refused(parameter, value):
    with pytest.raises((TypeError, ValueError)):
        parameter.clamp(value)


def test_a_menu_for_graphical_tools():
    method = ast.literal_eval(Parameter("m", str, "cone", description="friction", enum={"cone": "one"}).edit_method)
    assert method["enum_description"] == "friction"
    assert [(entry["value"], entry["type"], entry["description"]) for entry in method["enum"]] == [("cone", "str", "one")]
    assert Parameter("m", str, "").edit_method == ""
