"""The table, with nodes that a test makes up, and this process as a node."""

import os
import threading

import pytest

from rqt_testing.in_process import errors, find, open_plugin, process_events, rospy_without_master, wait_until  # isort: skip
from xmlrpc.server import SimpleXMLRPCServer

from rqt_top import node_info
from rqt_top.node_info import NodeInfo, NodeUsage


@pytest.fixture
def usages(monkeypatch):
    rospy_without_master()
    listed = [
        NodeUsage("/arm", 11, 5.5, 1.0, 3, "python3 arm", 1 << 20, 2 << 20),
        NodeUsage("/gazebo", 9, 80.0, 10.0, 12, "gzserver", 1 << 20, 2 << 20),
    ]
    monkeypatch.setattr(NodeInfo, "look", lambda self: list(listed))
    return listed


def rows(gui):
    table = find(gui, "TopTable")
    return [
        [table.topLevelItem(i).text(c) for c in range(5)] for i in range(table.topLevelItemCount()) if not table.topLevelItem(i).isHidden()
    ]


def test_table_filter_and_settings(usages, tmp_path):
    settings = str(tmp_path / "a.ini")
    with open_plugin("rqt_top", settings=settings) as gui:
        wait_until(lambda: rows(gui) == [["/arm", "11", "5.50", "1.00", "3"], ["/gazebo", "9", "80.00", "10.00", "12"]])
        find(gui, "TopTable").sortByColumn(1, find(gui, "TopTable").header().sortIndicatorOrder())
        assert [row[1] for row in rows(gui)] == ["9", "11"]  # as numbers
        find(gui, "regex").click()
        find(gui, "filter").setText("^/a")
        assert [row[0] for row in rows(gui)] == ["/arm"]
        find(gui, "filter").setText("(")
        assert "no regular expression" in find(gui, "filter").toolTip()
        find(gui, "filter").setText("gaz")
    with open_plugin("rqt_top", settings=settings) as gui:
        wait_until(lambda: [row[0] for row in rows(gui)] == ["/gazebo"])
        del usages[1]
        wait_until(lambda: find(gui, "TopTable").topLevelItemCount() == 1)
    assert errors == []


def test_kill_asks_the_selected_node(usages, monkeypatch):
    asked = []
    monkeypatch.setattr(NodeInfo, "kill_node", staticmethod(lambda name: not asked.append(name)))
    with open_plugin("rqt_top") as gui:
        wait_until(lambda: len(rows(gui)) == 2)
        find(gui, "TopTable").setCurrentItem(find(gui, "TopTable").topLevelItem(0))
        find(gui, "kill").click()
        wait_until(lambda: asked == ["/arm"])


def test_a_node_of_this_machine_is_found_by_its_address(monkeypatch):
    server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
    server.register_function(lambda caller: [1, "", os.getpid()], "getPid")
    threading.Thread(target=server.serve_forever, daemon=True).start()
    addresses = {"/me": f"http://127.0.0.1:{server.server_address[1]}/", "/dead": "http://127.0.0.1:9/", "/far": "http://192.0.2.1:1/"}

    class Master:
        def __init__(self, _name):
            pass

        def getSystemState(self):
            return [[["/a", ["/me", "/dead"]]], [["/a", ["/far"]]], []]

        def lookupNode(self, name):
            return addresses[name]

    monkeypatch.setattr(node_info.rosgraph, "Master", Master)
    (usage,) = NodeInfo().look()
    assert (usage.name, usage.pid) == ("/me", os.getpid()) and usage.resident > 0 and "pytest" in usage.command
    server.shutdown()
    server.server_close()
    process_events()
