"""Messages that wait for what comes later."""

import queue
import threading

import pytest
from node_signals.held import Held


class Filter:
    """Messages are numbers; those up to ``newest`` are ready."""

    def __init__(self, size):
        self.newest, self.taken, self.gone = 0, queue.Queue(), []
        self.held = Held(size, lambda number: number <= self.newest, self.taken.put, self.gone.append)

    def next(self):
        return self.taken.get(timeout=10)

    def reach(self, newest):
        self.newest = newest
        self.held.look()


@pytest.fixture
def made():
    filters = []
    yield lambda size: filters.append(Filter(size)) or filters[-1]
    for one in filters:
        one.held.close()


def test_what_is_ready_is_taken_at_once(made):
    one = made(1)
    one.reach(5)
    for number in (3, 4, 5):
        one.held.add(number)
        assert one.next() == number
    assert one.gone == []


def test_what_is_not_ready_waits_for_it(made):
    one = made(3)
    for number in (1, 2, 3):
        one.held.add(number)
    one.reach(2)
    assert (one.next(), one.next()) == (1, 2)
    one.held.add(4)
    one.reach(4)
    assert (one.next(), one.next(), one.gone) == (3, 4, [])


def test_the_oldest_goes_when_too_many_wait(made):
    one = made(2)
    for number in (1, 2, 3, 4):
        one.held.add(number)
    assert one.gone == [1, 2]
    one.reach(9)
    assert (one.next(), one.next()) == (3, 4)


def test_the_newer_one_does_not_wait_for_the_older(made):
    one = made(2)
    one.reach(1)
    one.held.add(7)
    one.held.add(1)
    assert one.next() == 1
    one.reach(7)
    assert one.next() == 7


def test_an_error_is_of_one_message_alone(monkeypatch):
    told = queue.Queue()
    monkeypatch.setattr(threading, "excepthook", lambda arguments: told.put(str(arguments.exc_value)))
    taken = queue.Queue()

    def take(message):
        if message == "bad":
            raise ValueError("broken")
        taken.put(message)

    held = Held(1, lambda message: True, take, lambda message: None)
    held.add("bad")
    assert told.get(timeout=10) == "broken"
    held.add("good")
    assert taken.get(timeout=10) == "good"
    held.close()


def test_what_was_forgotten_is_not_taken(made):
    one = made(2)
    one.held.add(1)
    one.held.clear()
    one.reach(5)
    one.held.add(2)
    assert one.next() == 2 and one.taken.empty()
