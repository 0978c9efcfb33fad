"""The rules of rates; ros_control's has its tests in realtime_tools, Gazebo's sensors' in gazebo_ros."""

from node_signals.rates import PeriodAdded, Spaced

MS = 1_000_000


def openings(gate, times):
    return [t for t in times if gate.due(t * MS)]


def test_the_period_is_added_so_that_the_mean_rate_holds():
    found = openings(PeriodAdded(30.0), range(0, 10001))
    assert abs(len(found) - 300) <= 1 and {b - a for a, b in zip(found, found[1:])} == {33, 34}


def test_a_period_exactly_is_not_enough_for_a_drive_plugin():
    gate = PeriodAdded(100.0)
    assert openings(gate, (0, 10, 11)) == [11] and gate.elapsed == 0.011


def test_a_long_pause_is_followed_by_no_burst():
    assert openings(PeriodAdded(100.0), (0, 11, 500, 501, 510, 511)) == [11, 500, 511]


def test_a_drive_plugin_without_a_rate_is_due_in_every_step():
    assert openings(PeriodAdded(0.0), (1, 2, 2, 3)) == [2, 3]


def test_spaced_openings_count_from_the_last_one():
    assert openings(Spaced(100.0), (0, 9, 10, 19, 25, 34, 35)) == [0, 10, 25, 35]
    assert openings(Spaced(100.0, strict=True), (0, 9, 10, 11)) == [0, 11]
    assert openings(Spaced(100.0, last_ns=0), (0, 9, 10)) == [10]
    assert openings(Spaced(0.0), (0, 0, 1)) == [0, 0, 1]


def test_ready_does_not_take_the_opening():
    gate = Spaced(100.0)
    assert gate.ready(0) and gate.ready(0) and gate.due(0) and not gate.ready(5 * MS)
    gate.take(5 * MS)
    assert not gate.due(10 * MS)
    gate.reset()
    assert gate.due(10 * MS)


def test_time_that_goes_back_opens_a_spaced_gate_and_restarts_the_other():
    assert openings(Spaced(100.0), (100, 50, 55, 60)) == [100, 50, 60]
    assert openings(PeriodAdded(100.0), (100, 111, 50, 55, 61)) == [111, 61]
