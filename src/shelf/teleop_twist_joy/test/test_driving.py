"""Which axis drives how fast."""

import pytest
from twist_joy.driving import Driver

AXES = [0.5, 1.0, -0.25, 0.125]


def moved(velocities):
    return {field: value for field, value in velocities.items() if value}


def test_defaults():
    driver = Driver({})
    assert moved(driver.drive(AXES, [1])) == {"x": 0.5, "yaw": 0.25}


def test_letting_go_stops_once():
    driver = Driver({})
    assert moved(driver.drive(AXES, [0])) == {}
    assert driver.drive(AXES, [0]) is None
    assert driver.drive(AXES, [1])["x"] == 0.5
    assert moved(driver.drive(AXES, [0])) == {} and driver.drive(AXES, [0]) is None


def test_turbo_and_maps():
    driver = Driver(
        {
            "enable_button": 4,
            "enable_turbo_button": 5,
            "axis_linear": {"x": 1, "y": 2},
            "scale_linear": {"x": 0.7, "y": 0.4},
            "scale_linear_turbo": {"x": 1.5},
            "axis_angular": {"yaw": 0, "roll": 3},
            "scale_angular": {"yaw": 0.4, "roll": 8},
        }
    )
    assert moved(driver.drive(AXES, [0, 0, 0, 0, 1, 0])) == {"x": 0.7, "y": -0.1, "yaw": 0.2, "roll": 1.0}
    assert moved(driver.drive(AXES, [0, 0, 0, 0, 0, 1])) == {"x": 1.5}
    assert ("Turbo for linear axis %s is scale %f.", ("x", 1.5)) in driver.lines()


def test_no_button_needed():
    assert Driver({"require_enable_button": False}).drive(AXES, [])["x"] == 0.5


def test_scale_of_turning_holds_for_turbo():
    assert Driver({"enable_turbo_button": 0, "scale_angular": 2}).drive(AXES, [1])["yaw"] == 1.0


def test_axes_that_a_joystick_lacks():
    assert moved(Driver({"axis_linear": 17}).drive(AXES, [1])) == {"yaw": 0.25}


@pytest.mark.parametrize(
    "parameters, axes, buttons",
    [
        ({"axis_linear": 1.0, "axis_angular": 2.0, "enable_button": 4.0}, {"x": 1, "yaw": 2}, (4, -1)),
        ({"axis_linear": 0.9, "axis_angular": 1.5, "enable_turbo_button": 5.2}, {"x": 1, "yaw": 2}, (0, 5)),
        ({"axis_linear": {"x": 1.0, "y": 2.9}, "scale_linear": {"x": 1, "y": True}}, {"x": 1, "y": 2, "yaw": 0}, (0, -1)),
        ({"axis_linear": {"x": True}, "scale_linear": {"x": 1.5}}, {"x": 1, "yaw": 0}, (0, -1)),
    ],
)
def test_whole_numbers_with_a_point(parameters, axes, buttons):
    """roscpp's getParam(int) takes the nearest whole number of a double; a map of them (xml_cast) casts each, also from bool."""
    driver = Driver(parameters)
    assert (driver.axes, (driver.enable, driver.turbo)) == (axes, buttons)


@pytest.mark.parametrize(
    "parameters, said",
    [
        ({"enable_button": "A"}, "enable_button must be the number of a button, but is 'A'"),
        ({"enable_turbo_button": float("nan")}, "enable_turbo_button must be the number of a button, but is nan"),
        ({"axis_linear": float("inf")}, "axis_linear must give numbers (axes whole ones), but x is inf"),
        ({"axis_linear": {"x": 1}, "scale_linear": 0.5}, "axis_linear and scale_linear must both be numbers, or both maps like {x: 1}"),
        ({"axis_angular": {"turn": 1}}, "axis_angular has a field 'turn'; there are yaw, pitch, roll"),
        ({"axis_linear": "left"}, "axis_linear must give numbers (axes whole ones), but x is 'left'"),
    ],
)
def test_what_is_wrong_is_said(parameters, said):
    with pytest.raises(ValueError) as error:
        Driver(parameters)
    assert str(error.value) == said
