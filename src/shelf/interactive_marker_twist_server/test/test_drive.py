"""How fast a drag drives."""

import pytest
from marker_drive.drive import Drive


def test_defaults():
    drive = Drive({})
    assert drive.axes == ["x"]
    assert [drive.linear("x", x) for x in (0.3, 5, -5)] == [0.3, 1, -1]
    assert drive.linear("y", 1) == 0
    assert (drive.angular(0.5), drive.angular(-3)) == (1.1, -2.2)


def test_maps_and_limits():
    drive = Drive(
        {
            "linear_scale": {"x": 2, "y": 0.5},
            "max_positive_linear_velocity": {"x": 3},
            "max_negative_linear_velocity": {"x": -0.2},
            "angular_scale": 1,
            "max_angular_velocity": 0.1,
        }
    )
    assert drive.axes == ["x", "y"]
    assert [drive.linear("x", x) for x in (1, 5, -5)] == [2, 3, -0.2]
    assert drive.linear("y", 1) == 0.5 and drive.angular(1) == 0.1


@pytest.mark.parametrize(
    "parameters, said",
    [
        ({"linear_scale": {"w": 1}}, "linear_scale has an axis 'w'; there are x, y, z"),
        ({"linear_scale": "fast"}, "linear_scale must be a number or a map of x, y, z, but is 'fast'"),
        ({"angular_scale": [1]}, "angular_scale must be a number, but is [1]"),
    ],
)
def test_what_is_wrong_is_said(parameters, said):
    with pytest.raises(ValueError) as error:
        Drive(parameters)
    assert str(error.value) == said
