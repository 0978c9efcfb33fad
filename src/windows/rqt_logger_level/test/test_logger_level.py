"""The three lists, with nodes that answer, hang, and are dead."""

import threading

import pytest
import rospy
from rqt_logger_level.logger_level_widget import LoggerLevelWidget
from rqt_testing.in_process import application, errors, find, open_plugin, rospy_without_master, wait_until


class Nodes:
    def __init__(self):
        self.gate, self.set = threading.Event(), []

    def get_node_names(self):
        return ["/alive", "/dead", "/hung"]

    def get_loggers(self, node):
        if node == "/dead":
            raise rospy.ServiceException("unable to connect to /dead")
        if node == "/hung":
            self.gate.wait()
        return {"ros": "Info", f"ros{node.replace('/', '.')}": "Warn"}

    def set_logger_level(self, node, logger, level):
        self.set.append((node, logger, level))


@pytest.fixture
def nodes():
    nodes = Nodes()
    yield nodes
    nodes.gate.set()


def texts(entries):
    return [entries.item(row).text() for row in range(entries.count())]


def test_click_sets_at_once(nodes):
    application()
    widget = LoggerLevelWidget(nodes)
    widget.refresh_nodes()
    wait_until(lambda: texts(widget.node_list) == ["/alive", "/dead", "/hung"])
    widget.node_list.setCurrentRow(0)
    wait_until(lambda: texts(widget.logger_list) == ["ros", "ros.alive"])
    widget.logger_list.setCurrentRow(1)
    assert widget.level_list.currentItem().text() == "Warn"
    widget.level_list.setCurrentRow(0)
    wait_until(lambda: nodes.set == [("/alive", "ros.alive", "Debug")])
    wait_until(lambda: widget.status_label.text() == "/alive: ros.alive is at Debug")
    widget.logger_list.setCurrentRow(0)
    widget.logger_list.setCurrentRow(1)
    assert widget.level_list.currentItem().text() == "Debug" and len(nodes.set) == 1


def test_dead_and_hung_nodes(nodes):
    application()
    widget = LoggerLevelWidget(nodes)
    widget.refresh_nodes()
    wait_until(lambda: widget.node_list.count())
    widget.node_list.setCurrentRow(2)
    widget.node_list.setCurrentRow(1)
    wait_until(lambda: widget.status_label.text() == "unable to connect to /dead")
    assert not widget.logger_list.count()
    widget.node_list.setCurrentRow(0)
    wait_until(lambda: texts(widget.logger_list) == ["ros", "ros.alive"])
    nodes.gate.set()  # what the hung one says at last is not shown
    widget.refresh_nodes()
    wait_until(lambda: not widget._background.busy("nodes"))
    wait_until(lambda: texts(widget.logger_list) == ["ros", "ros.alive"])
    widget.close_calls()


def test_in_the_window():
    rospy_without_master()
    with open_plugin("rqt_logger_level") as gui:
        find(gui, "refresh_button").click()
    assert errors == []
