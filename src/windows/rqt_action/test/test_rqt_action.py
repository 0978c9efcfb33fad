"""The browser shows what is installed."""
import pytest
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until


@pytest.fixture
def gui(tmp_path):
    rospy_without_master()
    with open_plugin("rqt_action.action_plugin", settings=str(tmp_path / "rqt.ini")) as gui:
        wait_until(lambda: find(gui, "package_combo").count())
        yield gui
    assert errors == []


def rows(item):
    return [item.child(row).text() for row in range(item.rowCount())]


def test_definition(gui):
    find(gui, "package_combo").setCurrentText("control_msgs")
    find(gui, "message_combo").setCurrentText("GripperCommand")
    find(gui, "add_button").click()
    tree = gui.plugin.widget.tree
    tops = [tree.model_.item(row) for row in range(tree.model_.rowCount())]
    assert [item.text() for item in tops] == [f"control_msgs/GripperCommand {part}" for part in ("Goal", "Result", "Feedback")]
    assert rows(tops[0]) == ["command"]
    tree.selectAll()
    dialog = tree.view_text()
    assert "bool stalled" in find(dialog, "definition_text").toPlainText()
    dialog.close()
    find(gui, "remove_button").click()
    assert tree.model_.rowCount() == 0
