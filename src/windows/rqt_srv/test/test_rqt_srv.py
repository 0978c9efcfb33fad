"""The browser shows what is installed."""
import pytest
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until


@pytest.fixture
def gui(tmp_path):
    rospy_without_master()
    with open_plugin("rqt_srv.services", settings=str(tmp_path / "rqt.ini")) as gui:
        wait_until(lambda: find(gui, "package_combo").count())
        yield gui
    assert errors == []


def rows(item):
    return [item.child(row).text() for row in range(item.rowCount())]


def test_definition(gui):
    find(gui, "package_combo").setCurrentText("nav_msgs")
    find(gui, "message_combo").setCurrentText("GetPlan")
    find(gui, "add_button").click()
    tree = gui.plugin.widget.tree
    tops = [tree.model_.item(row) for row in range(tree.model_.rowCount())]
    assert [item.text() for item in tops] == ["nav_msgs/GetPlan Request", "nav_msgs/GetPlan Response"]
    assert rows(tops[0]) == ["start", "goal", "tolerance"]
    tree.selectAll()
    dialog = tree.view_text()
    assert "float32 tolerance" in find(dialog, "definition_text").toPlainText()
    dialog.close()
    find(gui, "remove_button").click()
    assert tree.model_.rowCount() == 0
