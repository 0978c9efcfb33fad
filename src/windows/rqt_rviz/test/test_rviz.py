"""What can be told without a display: RViz is refused in one line, instead of ending the window."""

import os
import subprocess
import sys
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


def test_a_display_whose_library_is_not_built_is_told(tmp_path):
    """RViz offers what packages declare, and looks for the library only when one is added."""
    (tmp_path / "package.xml").write_text(
        "<package format='2'><name>my_displays</name><version>0.0.1</version><description>d</description><maintainer email='a@b.cd'>a"
        "</maintainer><license>BSD</license><depend>rviz</depend><export><rviz plugin='${prefix}/plugins.xml'/></export></package>"
    )
    (tmp_path / "plugins.xml").write_text(
        "<library path='lib/libmy_displays'><class name='my_displays/Arc' type='my::Arc' base_class_type='rviz::Display'/></library>"
    )
    script = "from unittest import mock; from rqt_rviz.rviz_plugin import TheFrame; TheFrame().take(mock.MagicMock(), False)"
    environment = {**os.environ, "ROS_PACKAGE_PATH": f"{tmp_path}:{os.environ['ROS_PACKAGE_PATH']}", "ROS_HOME": str(tmp_path)}
    ended = subprocess.run([sys.executable, "-c", script], env=environment, capture_output=True, text=True, timeout=120)
    assert "my_displays/Arc of the package my_displays cannot be added" in ended.stderr
