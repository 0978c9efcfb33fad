"""When controllers publish."""

from realtime_tools import RateGate


def openings(gate, times):
    return [time for time in times if gate.due(time)]


def milliseconds(start, stop):
    return [number * 1e-3 for number in range(start, stop)]


def test_mean_rate_is_exact_and_intervals_are_regular():
    found = openings(RateGate(100.0), milliseconds(1, 10001))
    gaps = {round((later - earlier) * 1e3) for earlier, later in zip(found, found[1:])}
    assert gaps == {10} and len(found) in (999, 1000)


def test_rate_that_does_not_divide_the_step():
    assert abs(len(openings(RateGate(30.0), milliseconds(1, 10001))) - 300) <= 1


def test_opens_strictly_after_the_due_time():
    gate = RateGate(10.0)
    assert not gate.due(0.1) and gate.due(0.101)


def test_catches_up_after_a_stall():
    gate = RateGate(100.0)
    assert len(openings(gate, [0.055, 0.056, 0.057, 0.058, 0.059, 0.0595])) == 5


def test_zero_never_opens():
    assert openings(RateGate(0.0), milliseconds(1, 3000)) == [] == openings(RateGate(-5.0), milliseconds(1, 3000))


def test_time_that_goes_back_does_not_silence_it():
    gate = RateGate(100.0)
    openings(gate, milliseconds(1, 60000))
    assert len(openings(gate, milliseconds(1, 1000))) >= 98


def test_a_pause_is_not_made_up_for():
    gate = RateGate(50.0)
    openings(gate, milliseconds(1, 1000))
    gate.resume(61.0)
    found = openings(gate, milliseconds(61001, 62001))
    gaps = {round((later - earlier) * 1e3) for earlier, later in zip(found[1:], found[2:])}
    assert round(found[0], 6) == 61.001 and gaps == {20} and len(found) == 51


def test_a_short_pause_keeps_the_rate():
    gate = RateGate(50.0)
    openings(gate, milliseconds(1, 1003))
    gate.resume(1.004)
    assert [round(time, 6) for time in openings(gate, milliseconds(1005, 1040))] == [1.021]


def test_resuming_a_gate_that_never_opens():
    gate = RateGate(0.0)
    gate.resume(5.0)
    assert openings(gate, milliseconds(5000, 9000)) == []
