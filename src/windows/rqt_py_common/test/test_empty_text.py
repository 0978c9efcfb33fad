"""Lists that are empty say so."""

from rqt_testing.in_process import errors, find, open_plugin, process_events, rospy_without_master, wait_until  # isort: skip
import pytest
from python_qt_binding.QtWidgets import QTableWidget, QTreeWidget, QTreeWidgetItem
from rqt_py_common.empty_text import EmptyText
from rqt_testing.in_process import application


@pytest.mark.parametrize("kind", [QTreeWidget, QTableWidget])
def test_the_text_is_there_as_long_as_there_is_nothing_else(kind):
    application()
    errors.clear()
    view = kind()
    text = EmptyText(view, "nothing yet")
    view.resize(300, 200)
    view.show()
    process_events()
    view.resize(320, 240)
    wait_until(lambda: text.label.isVisible() and text.label.size() == view.viewport().size())
    if kind is QTreeWidget:
        view.addTopLevelItem(QTreeWidgetItem(["a"]))
    else:
        view.setRowCount(1)
    assert not text.label.isVisible()
    if kind is QTreeWidget:
        view.clear()
    else:
        view.setRowCount(0)
    assert text.label.isVisible()
    view.close()
    view.deleteLater()
    process_events()
    assert errors == []


@pytest.mark.parametrize(
    "plugin, told",
    [
        ("rqt_console", "No message has come yet"),
        ("rqt_publisher", "Choose a topic above"),
        ("rqt_robot_monitor", "diagnostic_aggregator"),
        ("rqt_rosmon", "mon launch"),
        ("rqt_controller_manager", "start a robot with a controller_manager"),
        ("rqt_logger_level", "Choose a node"),
    ],
)
def test_windows_that_are_empty_speak(plugin, told):
    rospy_without_master()
    from python_qt_binding.QtWidgets import QLabel

    with open_plugin(plugin) as gui:
        texts = [label.text() for label in gui.window.findChildren(QLabel, "empty_text") if label.isVisible()]
        assert any(told in text for text in texts), texts
