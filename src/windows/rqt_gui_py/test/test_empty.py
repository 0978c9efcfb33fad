"""What a window says while nothing is in it, and while time does not begin."""

import pytest
import rospy
from node_signals import clock_watch
from python_qt_binding.QtWidgets import QLabel
from rqt_testing.in_process import errors, open_gui, open_plugin, process_events
from test_life import PLUGIN, code


@pytest.fixture
def time_at_zero(workspace, monkeypatch):
    """Simulated time, without a clock."""
    rospy.rostime._set_rostime(rospy.Time(0))
    yield
    rospy.rostime.switch_to_wallclock()


def notice(gui):
    return [label.text() for label in gui.window.findChildren(QLabel, "notice") if label.isVisible()]


def watch(gui):
    """The part of the provider that looks at the time."""
    inner = [one for provider in gui.plugins._provider._plugin_providers for one in getattr(provider, "_plugin_providers", [])]
    found = [provider._clock for provider in inner if getattr(provider, "_clock", None) is not None]
    assert len(found) == 1
    return found[0]


def test_a_window_without_plugins_says_where_they_are(workspace):
    workspace.make("rqt_it", code())
    with open_gui(providers=workspace.providers()) as gui:
        assert "The menu Plugins" in gui.window.empty_text()
        gui.plugins.load_plugin("rqt_it/Plugin")
        process_events()
        assert gui.window.empty_text() == ""
        gui.plugins.unload_plugin("rqt_it/Plugin#1")
        process_events()
        assert "The menu Plugins" in gui.window.empty_text()


@pytest.mark.parametrize("standalone", [False, True])
def test_simulated_time_without_a_clock_is_told_until_it_comes(workspace, time_at_zero, standalone):
    workspace.make("rqt_it", code())
    with open_plugin("rqt_it", providers=workspace.providers()) if standalone else open_gui(providers=workspace.providers()) as gui:
        if not standalone:
            gui.plugins.load_plugin("rqt_it/Plugin")
        clock = watch(gui)
        clock.look()
        assert notice(gui) == [], "a clock takes its time to come"
        for _ in range(5):
            clock.look()
        process_events()
        assert notice(gui) == [clock_watch.SENTENCE] and errors == [f"rqt: {clock_watch.SENTENCE}"]
        rospy.rostime._set_rostime(rospy.Time(1.5))
        clock.look()
        process_events()
        assert notice(gui) == [] and not clock._timer.isActive()


def test_with_the_clock_of_the_wall_nobody_looks(workspace):
    workspace.make("rqt_it", code())
    with open_plugin("rqt_it", providers=workspace.providers()) as gui:
        assert not clock_watch.expected() and clock_watch.missing() is None and notice(gui) == []
