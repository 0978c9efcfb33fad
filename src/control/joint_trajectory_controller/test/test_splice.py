"""Messages to segments; controller time 10.0 is now, the next update comes at 10.1."""

import math

import pytest
from joint_trajectory_controller.segment import Segment, State, stop_segment
from joint_trajectory_controller.splice import INVALID_GOAL, INVALID_JOINTS, Command, InvalidTrajectory, map_joints, splice
from joint_trajectory_controller.tolerances import JointTolerances, StateTolerance

JOINTS = ["a", "b"]
NOW, NEXT = 10.0, 10.1
NEW = [JointTolerances(StateTolerance(0.1), StateTolerance(0.2), 3.0)] * 2


def holding(*positions):
    return [[stop_segment(9.0, position, 0.0, 0.0, None, JointTolerances())] for position in positions]


def moving():
    """Both joints on a line through (10.0, 0.0) at 1/s: segments from 9 to 11 and 11 to 13."""
    return [[Segment(9.0, State(-1.0), 11.0, State(1.0)), Segment(11.0, State(1.0), 13.0, State(3.0))] for _ in JOINTS]


def splice_now(current, message, elapsed=0.0, start=NEXT, continuous=(False, False), goal=None, partial=False):
    command = Command(message, map_joints(message.joint_names, JOINTS, partial), elapsed)
    return splice(current, command, start, NOW, NEXT, continuous, NEW, goal)


@pytest.mark.parametrize(
    "names, partial, text",
    [
        ([], False, "joint_names is empty"),
        ([], True, "joint_names is empty"),
        (["a", "x"], True, "unknown: x"),
        (["a"], False, "missing: b"),
        (["a", "a"], True, "more than once: a"),
        (["a", "b", "c"], True, "unknown: c"),
    ],
)
def test_joint_names_that_do_not_fit(names, partial, text):
    with pytest.raises(InvalidTrajectory, match=text) as error:
        map_joints(names, JOINTS, partial)
    assert error.value.code == INVALID_JOINTS


def test_names_in_another_order():
    assert map_joints(["b", "a"], JOINTS, False) == [1, 0]
    assert map_joints(["b"], JOINTS, True) == [1]


@pytest.mark.parametrize(
    "points, text",
    [
        ([(1.0, [0, 0]), (1.0, [1, 1])], "strictly increasing"),
        ([(2.0, [0, 0]), (1.0, [1, 1])], "strictly increasing"),
        ([(1.0, [])], "0 positions for 2 joints"),
        ([(1.0, [0])], "1 positions for 2 joints"),
        ([(1.0, [0], [0], [0])], "1 positions for 2 joints"),
        ([(1.0, [0, 0]), (2.0, [0, 0, 0])], "Point 1 has 3 positions"),
        ([(1.0, [0, 0, 0]), (2.0, [0, 0])], "Point 1 has 2 positions"),
        ([(1.0, [0, 0, 0], [0, 0])], "2 velocities for 2 joints"),
        ([(1.0, [0, 0], [0])], "1 velocities for 2 joints"),
        ([(1.0, [0, 0], [0, 0], [1])], "1 accelerations for 2 joints"),
        ([(1.0, [0, 1e308])], "positions beyond 1e"),
        ([(1.0, [0, 0], [-1e13, 0])], "velocities beyond 1e"),
        ([(1.0, [0, math.nan])], "not finite"),
        ([(1.0, [0, 0], [math.inf, 0])], "not finite"),
        ([(0.0, [0, 0])], "Dropping all 1 trajectory points"),
        ([(-2.0, [0, 0]), (-1.0, [0, 0])], r"Dropping all 2 trajectory points.* 1.000000s in the past"),
    ],
)
def test_points_that_cannot_be_executed(message, points, text):
    with pytest.raises(InvalidTrajectory, match=text) as error:
        Command(message(JOINTS, *points), [0, 1], 0.0)
    assert error.value.code == INVALID_GOAL


def test_values_beyond_the_named_joints_are_left_out(message):
    command = Command(message(["b"], (1.0, [1.0, math.nan], [0.5, 0.0]), (2.0, [2.0, 5.0])), [1], 0.0)
    assert command.surplus == 1
    assert [state.position for state in command.states[1]] == [1.0, 2.0] and list(command.states) == [1]


def test_points_in_the_past_are_dropped_unread(message):
    command = Command(message(JOINTS, (-1.0, []), (0.0, [1.0]), (1.0, [1.0, 2.0])), [0, 1], 0.0)
    assert command.first == 2


@pytest.mark.parametrize("elapsed, segments", [(0.0, 4), (1.0, 3), (2.5, 2)])
def test_one_segment_per_remaining_point_and_the_one_in_progress(message, elapsed, segments):
    points = message(JOINTS, (1.0, [1, 1]), (2.0, [2, 2]), (3.0, [3, 3]))
    result = splice_now(holding(0.0, 0.0), points, elapsed, start=NEXT - elapsed)
    assert [len(joint) for joint in result] == [segments] * 2


def test_points_overtaken_while_the_command_was_being_read_are_dropped(message):
    command = Command(message(JOINTS, (1.0, [1, 1]), (2.0, [2, 2])), [0, 1], 0.0)
    result = splice(holding(0.0, 0.0), command, NEXT - 1.5, NOW, NEXT, (False, False), NEW, None)
    assert [len(joint) for joint in result] == [2, 2]
    assert result[0][-1].end == pytest.approx(NEXT + 0.5) and result[0][-1].end_position == 2


def test_bridge_leads_from_the_running_motion_to_the_first_point(message):
    result = splice_now(moving(), message(JOINTS, (1.0, [5.0, -5.0], [0.5, 0.0])))[0]
    bridge = result[-1]
    assert (bridge.start, bridge.end) == (NEXT, NEXT + 1.0)
    assert bridge.sample(NEXT)[:2] == pytest.approx((0.1, 1.0))
    assert bridge.sample(NEXT + 1.0)[:2] == pytest.approx((5.0, 0.5))


def test_first_point_alone_sets_the_order_of_the_bridge(message):
    line = splice_now(moving(), message(JOINTS, (1.0, [5.0, 5.0])))[0][-1]
    assert line.coefficients[2:] == (0.0, 0.0, 0.0, 0.0)
    quintic = splice_now(moving(), message(JOINTS, (1.0, [5.0, 5.0], [0, 0], [0, 0])))[0][-1]
    assert quintic.coefficients[5] != 0.0


def test_joints_follow_their_own_columns(message):
    result = splice_now(holding(0.0, 0.0), message(["b", "a"], (1.0, [1.0, 2.0]), (2.0, [3.0, 4.0])))
    assert [segment.end_position for segment in result[0][-2:]] == [2.0, 4.0]
    assert [segment.end_position for segment in result[1][-2:]] == [1.0, 3.0]


def test_future_start_lets_the_old_motion_go_on_until_then(message):
    result = splice_now(moving(), message(JOINTS, (0.5, [0.0, 0.0])), elapsed=-2.0, start=NEXT + 2.0)[0]
    assert [segment.start for segment in result] == pytest.approx([9.0, 11.0, 12.1])
    assert result[1].sample(12.0)[0] == pytest.approx(2.0)
    assert result[2].sample(12.1)[0] == pytest.approx(2.1)


def test_what_is_kept_until_the_message_begins_belongs_to_whom_it_did(message):
    """As in upstream's initJointTrajectory: a goal is not watched before it begins."""
    goal = object()
    old = moving()
    result = splice_now(old, message(JOINTS, (1.0, [5.0, 5.0]), (2.0, [6.0, 6.0])), goal=goal)[0]
    assert [segment.goal for segment in result] == [None, goal, goal]
    assert [segment.tolerances == NEW[0] for segment in result] == [False, True, True]


def test_joints_left_out_keep_their_motion(message):
    goal = object()
    old = moving()
    result = splice_now(old, message(["b"], (1.0, [5.0])), goal=goal, partial=True)
    assert [segment.sample(12.5) for segment in result[0]] == [segment.sample(12.5) for segment in old[0]]
    assert all(segment.goal is goal for segment in result[0])
    assert result[1][-1].end_position == 5.0


def test_continuous_joint_takes_the_short_way_and_keeps_the_turns_inside_the_message(message):
    points = message(JOINTS, (1.0, [2 * math.pi + 0.5] * 2), (2.0, [4 * math.pi + 0.5] * 2))
    result = splice_now(holding(0.2, 0.2), points, continuous=(True, False))
    assert [s.end_position for s in result[0][-2:]] == pytest.approx([0.5, 2 * math.pi + 0.5])
    assert result[0][-1].sample(NEXT + 1.0)[0] == pytest.approx(0.5)
    assert [s.end_position for s in result[1][-2:]] == pytest.approx([2 * math.pi + 0.5, 4 * math.pi + 0.5])


def test_point_times_are_kept_for_feedback(message):
    result = splice_now(holding(0.0, 0.0), message(JOINTS, (1.0, [1, 1]), (2.0, [2, 2]), (4.0, [3, 3])))[0]
    assert [segment.point_time for segment in result] == [0.0, 0.0, 1.0, 2.0]


def test_messages_stay_short(message):
    with pytest.raises(InvalidTrajectory, match="^Joints on incoming goal don't match .* unknown: x0, x1,") as error:
        map_joints([f"x{number}" for number in range(10000)], JOINTS, False)
    assert len(str(error.value)) <= 400
