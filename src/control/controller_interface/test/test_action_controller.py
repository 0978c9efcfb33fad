"""Which goal is the active one, and what its client hears. The action itself is tested where it is served."""

import threading

import pytest
from controller_interface.action_controller import ActionController


class Goal:
    """Notes what is done to it."""

    def __init__(self, log, name):
        self._log, self.id = log, name

    def accept(self):
        self._log.append((self.id, "accepted"))

    def cancel(self, result=None, text=""):
        self._log.append((self.id, text))


class Holding(ActionController):
    def __init__(self):
        super().__init__()
        self.log = []
        self._lock, self._running, self._goal = threading.Lock(), True, None

    def _hold(self, goal):
        self.log.append("hold")

    def take(self, name):
        goal = Goal(self.log, name)
        with self._lock:
            self._replace(goal, "replaced")
        return goal


@pytest.fixture
def controller():
    return Holding()


def test_a_new_goal_takes_the_place_of_the_old_one(controller):
    first, second = controller.take("a"), controller.take("b")
    assert controller.log == [("a", "accepted"), ("a", "replaced"), ("b", "accepted")]
    assert not controller._release(first) and controller._release(second) and not controller._release(second)


def test_a_goal_is_accepted_before_the_loop_can_finish_it(controller):
    seen = []
    goal = Goal(controller.log, "a")
    goal.accept = lambda: seen.append((controller._lock.locked(), controller._goal))
    with controller._lock:
        controller._replace(goal, "")
    assert seen == [(True, None)] and controller._goal is goal


def test_cancelling_stops_the_joints_only_for_the_active_goal(controller):
    controller.take("a")
    controller._on_cancel("b")
    assert controller.log == [("a", "accepted")]
    controller._on_cancel("a")
    controller._on_cancel("a")
    assert controller.log[1:] == ["hold", ("a", "Cancelled by a client")]


def test_stopping_ends_the_goal(controller):
    controller.take("a")
    controller.stopping(1.0)
    assert controller.log[1:] == [("a", "The controller was stopped")] and not controller._running


def test_a_goal_that_comes_while_the_controller_stops_is_not_left_active(controller):
    controller.stopping(1.0)
    controller.take("a")
    assert controller.log == [("a", "accepted"), ("a", "The controller was stopped")] and controller._goal is None
