"""The browser shows what is installed."""
import pytest
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until


@pytest.fixture
def gui(tmp_path):
    rospy_without_master()
    with open_plugin("rqt_msg.messages", settings=str(tmp_path / "rqt.ini")) as gui:
        wait_until(lambda: find(gui, "package_combo").count())
        yield gui
    assert errors == []


def rows(item):
    return [item.child(row).text() for row in range(item.rowCount())]


def test_definition(gui):
    find(gui, "package_combo").setCurrentText("geometry_msgs")
    find(gui, "message_combo").setCurrentText("PoseStamped")
    find(gui, "add_button").click()
    tree = gui.plugin.widget.tree
    tops = [tree.model_.item(row) for row in range(tree.model_.rowCount())]
    assert [item.text() for item in tops] == ["geometry_msgs/PoseStamped"]
    assert rows(tops[0]) == ["header", "pose"]
    tree.selectAll()
    dialog = tree.view_text()
    assert "geometry_msgs/Quaternion orientation" in find(dialog, "definition_text").toPlainText()
    dialog.close()
    find(gui, "remove_button").click()
    assert tree.model_.rowCount() == 0


def test_types_that_are_not_built(gui):
    gui.plugin.widget._types["no_package"] = ["Odd"]
    find(gui, "package_combo").addItem("no_package")
    find(gui, "package_combo").setCurrentText("no_package")
    find(gui, "add_button").click()
    assert "cannot import no_package/Odd" in find(gui, "error_label").text()
