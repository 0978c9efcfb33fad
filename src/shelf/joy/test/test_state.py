"""Events of the kernel make axes and buttons."""

import pytest
from joystick.state import AXIS, BUTTON, INIT, State


def test_axes_are_turned_stretched_and_grow():
    state = State(deadzone=0.2)
    assert not state.take(32767, AXIS | INIT, 2)
    assert state.axes == [0, 0, 0]
    assert not state.take(-32767, AXIS, 1)
    state.take(32767, AXIS, 0)
    state.take(round(0.6 * 32767), AXIS, 2)
    assert state.axes == pytest.approx([-1, 1, -0.5], abs=1e-4)
    state.take(round(0.19 * 32767), AXIS, 2)
    state.take(-32768, AXIS, 1)
    assert state.axes[1:] == [1, 0]


def test_buttons_are_told_at_once():
    state = State()
    assert not state.take(0, BUTTON | INIT, 1) and state.buttons == [0, 0]
    assert state.take(1, BUTTON, 0) and state.buttons == [1, 0]
    assert state.take(0, BUTTON, 0) and state.buttons == [0, 0]


def test_sticky_buttons():
    state = State(sticky=True)
    seen = []
    for value in (1, 0, 1, 0):
        state.take(value, BUTTON, 0)
        seen.append(state.buttons[0])
    assert seen == [1, 1, 0, 0]


def test_the_first_value_of_an_axis_counts_where_it_is_trusted():
    """A trigger that nobody touches: its kernel says -32767, upstream's default_trig_val makes 1 of it."""
    state = State(trust=True)
    assert not state.take(-32767, AXIS | INIT, 2)
    state.take(round(0.05 * 32767), AXIS | INIT, 0)
    assert state.axes == [0, 0, 1]


@pytest.mark.parametrize("deadzone", [-0.1, 1.0, float("nan")])
def test_deadzone_has_a_range(deadzone):
    with pytest.raises(ValueError, match="deadzone must be from 0 to below 1"):
        State(deadzone)
