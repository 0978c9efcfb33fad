"""What can be told without a display: RViz is refused in one line, instead of ending the window."""
from unittest import mock

import pytest
from rqt_testing.in_process import FakeContext, application, rospy_without_master  # isort: skip
from qt_gui.errors import PluginLoadError

from rqt_rviz import rviz_plugin


def test_without_an_x_display_it_is_refused():
    rospy_without_master()
    application()
    with pytest.raises(PluginLoadError, match="this window is on 'offscreen'; set DISPLAY"):
        rviz_plugin.RViz(FakeContext([]))


def test_a_window_on_another_qt_is_told_how_to_get_rviz(monkeypatch):
    """As on Debian 13, where RViz is for Qt 6 and rqt on Qt 5."""
    rospy_without_master()
    application()
    monkeypatch.setattr(rviz_plugin.QGuiApplication, "platformName", lambda: "xcb")
    here = rviz_plugin.QWidget.__module__.partition(".")[0]
    other = {"PyQt5": "PyQt6", "PyQt6": "PyQt5"}[here]
    monkeypatch.setattr(rviz_plugin.qt, "package", lambda: other)
    with pytest.raises(PluginLoadError, match=f"RViz is for {other} and this window is on {here}: run rosrun rqt_rviz rqt_rviz"):
        rviz_plugin.RViz(FakeContext([]))
    monkeypatch.setattr(rviz_plugin.qt, "package", lambda: None)
    with pytest.raises(PluginLoadError, match="apt install python3-rviz"):
        rviz_plugin.RViz(FakeContext([]))


def test_a_second_one_is_refused_and_the_first_is_taken_up_again():
    rviz, frame = mock.MagicMock(), rviz_plugin.TheFrame()
    first = frame.take(rviz, False)
    for _ in range(2):
        with pytest.raises(PluginLoadError, match="once in a window"):
            frame.take(rviz, False)
        frame.give_back()
        assert frame.take(rviz, False) is first
    assert rviz.VisualizationFrame.call_count == 1 and first.initialize.called
