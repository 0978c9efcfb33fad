"""The widget with nodes that start, die, hang; the real loader with a real file."""

import threading
from types import SimpleNamespace

import pytest
from rqt_launch import launched_node
from rqt_launch.launch_widget import LaunchWidget
from rqt_launch.launched_node import LaunchError
from rqt_testing.in_process import application, errors, find, open_plugin, rospy_without_master, wait_until


class Node:
    kind, starts = "pkg/type", 0

    def __init__(self, name, respawn=False):
        self.name, self.respawn, self.shown, self.gate = name, respawn, "stopped", threading.Event()

    def state(self):
        return self.shown

    def start(self):
        if self.name == "/missing":
            raise LaunchError("/missing: cannot find node type")
        self.starts += 1
        self.shown = "running"

    def stop(self):
        if self.name == "/hung":
            self.gate.wait(30)
        self.shown = "stopped"

    def due(self, now):
        return self.respawn and self.shown.startswith("died")


@pytest.fixture
def widget():
    application()
    nodes = [Node("/talker"), Node("/missing"), Node("/hung"), Node("/again", respawn=True)]

    def load(package, file, arguments):
        if file == "bad.launch":
            raise LaunchError("demo bad.launch: no such file")
        load.asked = (package, file, arguments)
        return nodes

    fake = SimpleNamespace(
        packages=lambda: ["demo", "other"],
        launch_files=lambda package: ["bad.launch", f"{package}.launch"],
        load=load,
        stop_all=lambda nodes: None,
    )
    widget = LaunchWidget(fake)
    widget.choose({"package": "other", "file": "other.launch", "arguments": "x:=1"})
    wait_until(lambda: widget.file_box.currentText() == "other.launch")
    find(widget, "load_button").click()
    wait_until(lambda: widget.nodes)
    assert load.asked == ("other", "other.launch", "x:=1")
    yield widget
    nodes[2].gate.set()
    widget.close_all()


def states(widget):
    return [widget.table.item(row, 2).text() for row in range(4)]


def test_start_and_stop(widget):
    find(widget, "start_all_button").click()
    wait_until(lambda: states(widget) == ["running", "stopped", "running", "running"])
    assert widget.status_label.text() == "/missing: cannot find node type"
    find(widget, "load_button").click()
    assert widget.status_label.text() == "stop the running nodes first"
    find(widget, "toggle/talker").click()
    wait_until(lambda: states(widget)[0] == "stopped")
    find(widget, "stop_all_button").click()
    wait_until(lambda: states(widget) == ["stopped", "stopped", "running ...", "stopped"])
    assert not find(widget, "toggle/hung").isEnabled()


def test_respawn(widget):
    widget.start([widget.nodes[3]])
    wait_until(lambda: states(widget)[3] == "running")
    widget.nodes[3].shown = "died (exit code 1)"
    wait_until(lambda: states(widget)[3] == "running" and widget.table.item(3, 3).text() == "2")


def test_bad_file(widget):
    widget.choose({"package": "demo", "file": "bad.launch", "arguments": ""})
    find(widget, "load_button").click()
    wait_until(lambda: widget.status_label.text() == "demo bad.launch: no such file")


def test_real_files():
    rospy_without_master()
    assert "turtlesim" in launched_node.packages() and launched_node.launch_files("turtlesim") == ["multisim.launch"]
    assert launched_node.launch_files("no_such_package") == []
    nodes = launched_node.load("turtlesim", "multisim.launch", "")
    assert [(node.name, node.kind, node.state()) for node in nodes] == [
        ("/turtlesim1/sim", "turtlesim/turtlesim_node", "stopped"),
        ("/turtlesim2/sim", "turtlesim/turtlesim_node", "stopped"),
    ]
    for file, said in (("none.launch", "none.launch"), ("../package.xml", "package.xml")):
        with pytest.raises(LaunchError, match=said) as error:
            launched_node.load("turtlesim", file, "")
        assert "\n" not in str(error.value)
    nodes[1].node.type = "draw_square"
    ends = []
    thread = threading.Thread(
        target=lambda: (nodes[1].start(), ends.append(nodes[1].state()), nodes[1].stop(), ends.append(nodes[1].state()))
    )
    thread.start()
    thread.join(60)
    assert ends == ["running", "stopped"] and nodes[1].starts == 1
    nodes[0].node.type = "no_such_node"
    with pytest.raises(LaunchError, match="/turtlesim1/sim: .*no_such_node"):
        nodes[0].start()
    assert nodes[0].state() == "stopped"


def test_in_the_window():
    rospy_without_master()
    with open_plugin("rqt_launch") as gui:
        wait_until(lambda: find(gui, "package_combo").count())
    assert errors == []
