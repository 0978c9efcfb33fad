"""What can be told without a display: RViz is refused in one line, instead of ending the window."""
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


def test_a_second_one_is_refused_and_the_first_is_taken_up_again(monkeypatch):
    monkeypatch.setattr(rviz_plugin, "_made", ["frame"])
    monkeypatch.setattr(rviz_plugin, "_frames", [])
    with pytest.raises(PluginLoadError, match="once in a window"):
        rviz_plugin._take_frame(None, False)
    rviz_plugin._frames.append("frame")
    assert rviz_plugin._take_frame(None, False) == "frame" and rviz_plugin._frames == []
