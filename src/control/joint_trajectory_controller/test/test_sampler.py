"""The sampler in C++ answers as Segment does, to the last bit, and leaves to the controller whatever is not ordinary."""

import math
import random

import pytest
from hardware_interface import JointHandle, JointStateHandle, addresses
from joint_trajectory_controller._sampler import Sampler
from joint_trajectory_controller.segment import Segment, State

NAN = math.nan


@pytest.fixture
def one():
    """A sampler of one joint that turns, and the joint's state."""
    state = JointStateHandle("j", 0.0, 0.0)
    sampler = Sampler()
    sampler.add_joint(*addresses(state)[:2], True)
    return sampler, state


def follow(sampler, segment, next_start=math.inf, watched=False, position=0.0, velocity=0.0, joint=0):
    sampler.follow(joint, segment, next_start, watched, position, velocity)


def some_state(dice, order):
    values = [dice.uniform(-3.0, 3.0) for _ in range(3)]
    return State(*values[:order], *[None] * (3 - order))


def test_samples_are_those_of_the_segment_to_the_last_bit():
    dice = random.Random(1)
    states = [JointStateHandle(f"j{i}", dice.uniform(-1, 1), dice.uniform(-1, 1)) for i in range(7)]
    sampler = Sampler()
    for state in states:
        sampler.add_joint(*addresses(state)[:2], False)
    for _ in range(300):
        segments = []
        for joint in range(len(states)):
            start, order = dice.uniform(0.0, 2.0), dice.choice((1, 2, 3))
            end = start + dice.choice((0.0, dice.uniform(0.01, 3.0)))
            segments.append(Segment(start, some_state(dice, order), end, some_state(dice, order)))
            follow(sampler, segments[-1], joint=joint)
        for time in [dice.uniform(-0.5, 6.0) for _ in range(5)] + [segments[0].start, segments[0].end]:
            desired, errors = sampler.quick(time, True, True)
            assert desired == [segment.sample(time) for segment in segments]
            assert errors == [(point[0] - state.position, point[1] - state.velocity) for point, state in zip(desired, states)]
            assert sampler.quick(time, False, False) == (desired, [])


def test_the_next_segment_is_for_the_controller(one):
    sampler, _ = one
    follow(sampler, Segment(0.0, State(0.0), 1.0, State(1.0)), next_start=1.0)
    assert sampler.quick(math.nextafter(1.0, 0.0), False, False) is not None
    assert sampler.quick(1.0, False, False) is None and sampler.quick(NAN, False, False) is None


@pytest.mark.parametrize(
    "measured, watched",
    (((0.6, 0.0), True), ((0.4, 0.0), True), ((0.5, 1.2), True), ((NAN, 0.0), True), ((0.5, NAN), True), ((0.6, 2.0), False)),
)
def test_a_broken_tolerance_is_for_the_controller_while_a_goal_watches(one, measured, watched):
    sampler, state = one
    follow(sampler, Segment(0.0, State(0.0), 1.0, State(1.0)), watched=watched, position=0.09, velocity=0.15)
    state.position, state.velocity = 0.5, 1.0
    assert sampler.quick(0.5, True, False) is not None
    state.position, state.velocity = measured
    assert (sampler.quick(0.5, True, False) is None) is watched
    assert sampler.quick(0.5, False, False) is not None


def test_errors_of_angles_are_the_short_way_round(one):
    sampler, state = one
    follow(sampler, Segment(0.0, State(3.0), 1.0, State(3.0)))
    state.position = -3.0
    assert sampler.quick(0.5, False, True)[1][0][0] == pytest.approx(6.0 - 2.0 * math.pi)


def test_the_end_of_a_goal_is_for_the_controller(one):
    sampler, _ = one
    segment = Segment(0.0, State(0.0), 1.0, State(1.0))
    follow(sampler, segment, watched=True)
    assert sampler.quick(math.nextafter(1.0, 0.0), True, False) is not None
    assert sampler.quick(1.0, True, False) is None and sampler.quick(1.0, False, False) is not None
    follow(sampler, segment, watched=True, next_start=2.0)
    assert sampler.quick(1.5, True, False) is not None


def test_positions_are_written_where_all_cycles_are_ordinary(one):
    sampler, state = one
    handle = JointHandle(state, 7.0)
    sampler.add_command(0, addresses(handle)[0])
    segment = Segment(0.0, State(0.0), 1.0, State(1.0))
    follow(sampler, segment, next_start=1.0)
    assert sampler.quick(0.25, False, False) == ((), ()) and handle.command == 0.25
    assert sampler.quick(0.5, False, True) == ([segment.sample(0.5)], [(0.5, 1.0)]) and handle.command == 0.5
    assert sampler.quick(1.0, False, True) is None and handle.command == 0.5


def test_a_joint_that_is_not_there_is_refused(one):
    sampler, _ = one
    with pytest.raises(IndexError):
        follow(sampler, Segment(0.0, State(0.0), 1.0, State(1.0)), joint=1)
    with pytest.raises(IndexError):
        sampler.add_command(1, addresses(JointHandle(JointStateHandle("j")))[0])
