"""Ways out of the node rm_hw that no test can force from outside: the motors are off before the buses close."""

from types import SimpleNamespace

import pytest
from rm_hw import node


class Robot:
    """A RmRobotHW that fails in the method it is told to."""

    def __init__(self, failing, error):
        self.failing, self.error, self.calls = failing, error, []
        self.config = SimpleNamespace(thread_priority=0, loop_frequency=1000.0, cycle_time_error_threshold=0.001)

    def __getattr__(self, method):
        def call(*_):
            self.calls.append(method)
            if method == self.failing:
                raise self.error

        return call


@pytest.fixture
def run(monkeypatch):
    """main() with a robot instead of motors; returns exit code, calls of the robot, lines of the log."""

    def run(failing, error):
        robot, lines = Robot(failing, error), []
        monkeypatch.setattr(node, "RmRobotHW", lambda: robot)
        monkeypatch.setattr(node, "ControllerManager", lambda hw: SimpleNamespace(update=lambda *_: None, shutdown=lambda: None))
        monkeypatch.setattr(node, "NodeHandle", lambda *_: None)
        monkeypatch.setattr(node, "become_realtime", lambda priority: None)
        for name, value in (
            ("init_node", None),
            ("get_param", ""),
            ("get_name", "/rm_hw"),
            ("on_shutdown", None),
            ("signal_shutdown", None),
        ):
            monkeypatch.setattr(node.rospy, name, lambda *_, value=value, **__: value)
        monkeypatch.setattr(node.rospy, "logfatal", lambda text, *values: lines.append(text % values))
        monkeypatch.setattr(node.signal, "signal", lambda *_: None)
        return node.main(), robot.calls, lines

    return run


@pytest.mark.parametrize("failing", ["read", "write"])
def test_an_exception_in_the_loop_switches_the_motors_off_and_is_one_line(run, failing):
    code, calls, lines = run(failing, OverflowError("too much"))
    assert code == 1
    assert calls[-3:] == [failing, "switch_off", "close"]
    assert len(lines) == 1 and "OverflowError: too much" in lines[0] and "test_node.py" in lines[0]


def test_a_wrong_parameter_ends_it_before_anything_moves(run):
    code, calls, lines = run("init", node.ConfigError("parameter 'rm_hw/bus' is missing"))
    assert (code, calls) == (1, ["init", "switch_off", "close"])
    assert lines == ["rm_hw cannot start: parameter 'rm_hw/bus' is missing"]
