"""Who drives, without ROS."""

import pytest
from velocity_mux.choice import Lock, Source, chosen, lock_priority, read_inputs


def entries(*rows):
    return [dict(zip(("name", "topic", "timeout", "priority"), row)) for row in rows]


def test_the_most_important_of_those_who_speak():
    low, high = read_inputs(entries(("low", "a", 0.5, 10), ("high", "b", 0.5, 90)), Source, "/mux/topics")
    assert chosen([low, high], [], 0.0) is None
    low.stamp = 1.0
    assert chosen([low, high], [], 1.0) is low
    high.stamp = 1.2
    assert chosen([low, high], [], 1.4) is high
    assert chosen([low, high], [], 1.8) is None, "both are silent for longer than 0.5 s"
    low.stamp = 1.8
    assert chosen([low, high], [], 1.8) is low


def test_without_a_timeout_a_source_holds_the_word_and_zero_never_has_it():
    held, lower, zero = read_inputs(entries(("held", "a", 0, 50), ("lower", "b", 0.5, 10), ("zero", "c", 0, 0)), Source, "/p")
    lower.stamp = 5.0
    assert chosen([lower, held], [], 5.0) is held
    assert chosen([zero], [], 5.0) is None


def test_the_clock_set_back_silences():
    (source,) = read_inputs(entries(("s", "a", 0.5, 10)), Source, "/p")
    source.stamp = 100.0
    assert chosen([source], [], 1.0) is None


def test_locks_mask_what_is_below_them():
    (source,) = read_inputs(entries(("s", "a", 0.0, 100)), Source, "/p")
    equal, above, watched = read_inputs(entries(("e", "x", 0.0, 100), ("a", "y", 0.0, 101), ("w", "z", 1.0, 200)), Lock, "/p")
    watched.stamp = 10.0
    locks = [equal, above, watched]
    assert lock_priority(locks, 10.5) == 0
    equal.closed = True
    assert chosen([source], locks, 10.5) is source
    above.closed = True
    assert chosen([source], locks, 10.5) is None
    assert lock_priority(locks, 11.5) == 200, "its publisher has fallen silent"


def test_priorities_are_kept_within_their_range():
    assert [entry.priority for entry in read_inputs(entries(("a", "a", 1, -4), ("b", "b", 1, 900)), Source, "/p")] == [0, 255]


@pytest.mark.parametrize(
    "value, said",
    [
        ("fast", "parameter /mux/topics must be a list of entries with name, topic, timeout and priority, but is 'fast'"),
        ([3], "entry 1 of parameter /mux/topics must have name, topic, timeout and priority, but is 3"),
        ([{"name": "a", "topic": "t"}], "entry 1 of parameter /mux/topics lacks timeout and priority"),
        (entries(("a", "t", "soon", 3)), "entry 1 of parameter /mux/topics: timeout must be seconds, 0 or more, but is 'soon'"),
        (entries(("a", "t", float("nan"), 3)), "entry 1 of parameter /mux/topics: timeout must be seconds, 0 or more, but is nan"),
        (entries(("a", "", 1, 3)), "entry 1 of parameter /mux/topics: topic must be a name, but is ''"),
        (entries(("a", "t", 1, 2.5)), "entry 1 of parameter /mux/topics: priority must be a whole number from 0 to 255, but is 2.5"),
        (entries(("a", "t", 1, 3), ("a", "u", 1, 4)), "parameter /mux/topics names 'a' twice"),
    ],
)
def test_what_is_wrong_is_said(value, said):
    with pytest.raises(ValueError) as error:
        read_inputs(value, Source, "/mux/topics")
    assert str(error.value) == said
