"""What the messages of gamepads mean."""

import math

import pytest
from moveit_ros_visualization.gamepads import PADS, read
from sensor_msgs.msg import Joy

XBOX = (8, 11)


def message(kind, buttons=(), axes=None):
    joy = Joy(axes=[0.0] * kind[0], buttons=[0] * kind[1])
    for number in buttons:
        joy.buttons[number] = 1
    for number, value in (axes or {}).items():
        joy.axes[number] = value
    return joy


@pytest.mark.parametrize("kind", sorted(PADS))
def test_a_pad_at_rest_presses_nothing(kind):
    controls = read(message(kind))
    assert controls.pressed == frozenset() and not controls.stick.any()


@pytest.mark.parametrize("kind", sorted(PADS))
def test_every_button_of_a_pad_is_another_control(kind):
    pad = PADS[kind]
    assert len(set(pad.buttons.values())) == len(pad.buttons)
    for name, number in pad.buttons.items():
        assert read(message(kind, [number])).pressed == {name}
    for name, (axis, least) in pad.axes.items():
        assert read(message(kind, axes={axis: 1.0 if least > 0 else -1.0})).pressed == {name}
    assert {"square", "circle", "L1", "R1"} <= {*pad.buttons, *pad.axes}


def test_an_xbox_pad():
    controls = read(message(XBOX, [2], {0: 0.5, 1: -1.0, 7: 1.0}))
    assert controls.pressed == {"square", "up"} and list(controls.stick) == [0.5, -1.0]


def test_a_stick_that_hardly_moves_or_is_no_number_stands_still():
    assert not read(message(XBOX, axes={0: 0.05, 1: math.nan})).stick.any()


def test_an_unknown_pad_is_none():
    assert read(message((3, 2))) is None
