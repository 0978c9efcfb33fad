"""Rows, menus, a manager that refuses, hangs, and goes away."""

import threading

import pytest
import rospy
from rqt_controller_manager.controller_manager import ControllerManager
from rqt_controller_manager.manager_calls import CallError, ControllerRow
from rqt_testing.in_process import FakeContext, errors, find, open_plugin, rospy_without_master, wait_until


class Calls:
    def __init__(self):
        self.names, self.acts, self.gate, self.error = ["/arm/controller_manager"], [], threading.Event(), None
        self.rows = [
            ControllerRow("joints", "running", "joint_state_controller/JointStateController"),
            ControllerRow(
                "arm",
                "stopped",
                "position_controllers/JointTrajectoryController",
                (("hardware_interface::PositionJointInterface", ("j0", "j1")),),
            ),
            ControllerRow("grip", "uninitialized", "x/Y"),
        ]

    def managers(self):
        return list(self.names)

    def controllers(self, manager):
        if not self.names:
            raise rospy.ServiceException("unavailable")
        return list(self.rows)

    def act(self, manager, name, *steps):
        self.acts.append((manager, name, steps))
        if self.error == "hang":
            self.gate.wait(30)
        elif self.error:
            raise self.error


@pytest.fixture
def plugin():
    calls = Calls()
    context = FakeContext()  # owns the plugin
    plugin = ControllerManager(context, calls)
    wait_until(lambda: plugin.table.rowCount() == 3)
    yield plugin
    calls.gate.set()
    plugin.shutdown_plugin()


def labels(plugin, row):
    return [action.text() for action in plugin.row_menu(row).actions()]


def test_rows_and_menus(plugin):
    assert [plugin.table.item(n, 1).text() for n in range(3)] == ["running", "stopped", "uninitialized"]
    assert [labels(plugin, n) for n in range(3)] == [["Stop", "Stop and Unload"], ["Start again", "Unload"], ["Load", "Load and Start"]]
    plugin.row_menu(2).actions()[1].trigger()
    wait_until(lambda: plugin._calls.acts == [("/arm/controller_manager", "grip", ("load", "start"))])
    wait_until(lambda: plugin.status_label.text() == "")


def test_details(plugin):
    dialog = plugin.show_details(1)
    tree = find(dialog, "resource_tree")
    assert tree.topLevelItem(0).text(0) == "hardware_interface::PositionJointInterface"
    assert [tree.topLevelItem(0).child(n).text(0) for n in range(2)] == ["j0", "j1"]
    dialog.close()


def test_refused(plugin):
    plugin._calls.error = CallError("/arm/controller_manager did not start arm; its log says why")
    plugin.row_menu(1).actions()[0].trigger()
    wait_until(lambda: plugin.status_label.text() == "/arm/controller_manager did not start arm; its log says why")


def test_hung(plugin):
    plugin._calls.error = "hang"
    plugin.row_menu(1).actions()[0].trigger()
    wait_until(lambda: plugin._calls.acts)
    plugin.row_menu(0).actions()[0].trigger()
    assert plugin.status_label.text() == "/arm/controller_manager is still busy with the last request" and len(plugin._calls.acts) == 1
    plugin._calls.rows = plugin._calls.rows[:1]
    plugin.poll()
    wait_until(lambda: plugin.table.rowCount() == 1)


def test_manager_goes_and_comes(plugin):
    names, plugin._calls.names = plugin._calls.names, []
    plugin.poll()
    wait_until(lambda: plugin.table.rowCount() == 0 and plugin.manager_box.count() == 0)
    assert plugin.status_label.text() == "there is no controller manager"
    plugin._calls.names = ["/a/controller_manager"] + names
    plugin.poll()
    wait_until(lambda: plugin.manager_box.currentText() == "/arm/controller_manager" and plugin.table.rowCount() == 3)


def test_in_the_window():
    rospy_without_master()
    with open_plugin("rqt_controller_manager") as gui:
        assert find(gui, "cm_combo").count() == 0
    assert errors == []
