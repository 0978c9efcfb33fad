"""The window without a master, a node that has died, and what is kept."""

import pytest

from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until  # isort: skip
import rosgraph
from rqt_moveit import moveit_widget, presence
from rqt_moveit.presence import NODES, PARAMETERS, Presence


@pytest.fixture
def looks(monkeypatch):
    rospy_without_master()
    answers = [Presence(dict.fromkeys(NODES, ""), {**dict.fromkeys(PARAMETERS, ""), PARAMETERS[1]: "not set"})]

    def look():
        if isinstance(answers[0], Exception):
            raise answers[0]
        return answers[0]

    monkeypatch.setattr(moveit_widget, "look", look)
    return answers


def words(gui, table):
    view = find(gui, table)
    return [view.item(row, 1).text() for row in range(view.rowCount())]


def test_words_of_upstream_and_a_master_that_goes(looks):
    with open_plugin("rqt_moveit") as gui:
        wait_until(lambda: words(gui, "_view_params") == ["Yes", "No"])
        assert words(gui, "_view_nodes") == ["Running"]
        assert find(gui, "_view_params").item(1, 1).toolTip() == "not set" == find(gui, "status_label").text()
        looks[0] = rosgraph.MasterException("refused")
        find(gui, "_spinbox_refreshrate").setValue(1)
        wait_until(lambda: words(gui, "_view_params") == ["No", "No"] and words(gui, "_view_nodes") == ["Not running"])
        assert "is roscore running? (refused)" in find(gui, "status_label").text()
    assert errors == []


def test_rate_is_kept(looks, tmp_path):
    settings = str(tmp_path / "a.ini")
    with open_plugin("rqt_moveit", settings=settings) as gui:
        assert find(gui, "_spinbox_refreshrate").value() == 5
        find(gui, "_spinbox_refreshrate").setValue(17)
    with open_plugin("rqt_moveit", settings=settings) as gui:
        wait_until(lambda: find(gui, "_spinbox_refreshrate").value() == 17)


def test_a_node_that_died_is_not_there(monkeypatch):
    class Master:
        def __init__(self, _name):
            pass

        def hasParam(self, name):
            return True

        def lookupNode(self, name):
            return "http://127.0.0.1:9/"  # nobody listens at the port discard

    monkeypatch.setattr(presence.rosgraph, "Master", Master)
    seen = presence.look()
    assert "has died" in seen.nodes["/move_group"] and set(seen.parameters.values()) == {""}
