"""The window and the command, against a master and nodes made up here."""

import socket
import threading
import time
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from rqt_graph import graph_pane, ros_state
from rqt_graph.command import main
from rqt_testing.in_process import application, errors, find, open_plugin, process_events, rospy_without_master, wait_until
from rqt_testing.no_master import NoMaster


class Node:
    """Answers getBusInfo, after a while if told so."""

    def __init__(self, info, delay=0.0):
        self._server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
        self._server.register_function(lambda caller: (time.sleep(delay), [1, "", info])[1], "getBusInfo")
        self.uri = f"http://127.0.0.1:{self._server.server_address[1]}/"
        threading.Thread(target=self._server.serve_forever, args=(0.01,), daemon=True).start()


class Master(NoMaster):
    """Knows a talker and a listener, a dead node, and one that hangs."""

    def __init__(self):
        listener = Node([[1, "/talker", "i", "TCPROS", "/arm/chatter", True]])
        talker = Node([[1, "/listener", "o", "TCPROS", "/arm/chatter", True], [2, "/gone", "o", "TCPROS", "/arm/chatter", False]])
        with socket.socket() as nobody:
            nobody.bind(("127.0.0.1", 0))
            dead = f"http://127.0.0.1:{nobody.getsockname()[1]}/"
        self.uris = {"/talker": talker.uri, "/listener": listener.uri, "/dead": dead, "/hung": Node([], 3).uri}
        super().__init__(
            {
                "getSystemState": [
                    [["/arm/chatter", ["/talker"]], ["/unheard", ["/hung"]]],
                    [["/arm/chatter", ["/listener", "/dead"]]],
                    [["/talker/get_loggers", ["/talker"]]],
                ],
                "getTopicTypes": [["/arm/chatter", "std_msgs/String"]],
            }
        )

    def _dispatch(self, method, parameters):
        if method == "lookupNode":
            uri = self.uris.get(parameters[1])
            return [1, "", uri] if uri else [-1, "unknown", ""]
        return super()._dispatch(method, parameters)


@pytest.fixture(scope="module")
def master():
    return Master().start()


@pytest.fixture
def there(monkeypatch, master):
    rospy_without_master()
    monkeypatch.setenv("ROS_MASTER_URI", master)


def test_dead_and_hung_nodes_are_found_out_at_the_same_time(there):
    start = time.monotonic()
    state = ros_state.read()
    assert time.monotonic() - start < 2.9  # the one that hangs for 3 s is not waited for
    assert state.bad == {"/dead": "DEAD", "/hung": "WONKY"}
    assert state.connections == {("/talker", "/arm/chatter", "/listener")}
    assert state.active == {("/talker", "/arm/chatter", True), ("/listener", "/arm/chatter", False)}
    assert ("/dead", "/arm/chatter", False) in state.registered() and state.services == {"/talker": ["/talker/get_loggers"]}


def drawn(gui):
    return {item.text() for item in gui.plugin.pane.nodes.values()}


def test_graph_is_drawn_and_follows_its_controls(there, tmp_path):
    with open_plugin("rqt_graph", settings=str(tmp_path / "a.ini")) as gui:
        wait_until(lambda: drawn(gui) == {"/talker", "/listener"})
        find(gui, "graph_type_combo_box").setCurrentIndex(1)
        wait_until(lambda: "/arm/chatter" in drawn(gui) and "/arm" in drawn(gui))
        find(gui, "unreachable_check_box").setChecked(False)
        wait_until(lambda: {"/dead", "/hung"} <= drawn(gui))
        assert gui.plugin.pane.nodes["n_/dead"].color().name() == "#ff0000"
        find(gui, "filter_line_edit").setText("/talker")
        wait_until(lambda: drawn(gui) == {"/talker"})
        find(gui, "namespace_cluster_spin_box").setValue(0)
    with open_plugin("rqt_graph", settings=str(tmp_path / "a.ini")) as gui:  # as it was left
        assert find(gui, "filter_line_edit").text() == "/talker" and not find(gui, "unreachable_check_box").isChecked()
        assert find(gui, "graph_type_combo_box").currentText() == "Nodes/Topics (active)"
        assert find(gui, "namespace_cluster_spin_box").value() == 0
    assert errors == []


def test_nodes_that_are_hidden_because_they_were_slow_are_named(there):
    with open_plugin("rqt_graph") as gui:
        line = find(gui, "problem_label")
        wait_until(lambda: "no answer within a second: /hung;" in line.text() and not line.isHidden())
        find(gui, "unreachable_check_box").setChecked(False)
        wait_until(lambda: "n_/hung" in gui.plugin.pane.nodes)
        assert line.isHidden()


@pytest.mark.slow
def test_files_are_saved_and_loaded(there, tmp_path, monkeypatch):
    with open_plugin("rqt_graph") as gui:
        pane = gui.plugin.pane
        wait_until(lambda: drawn(gui))
        for name, begin in (("g.dot", b"digraph"), ("g.svg", b"<?xml"), ("g.png", b"\x89PNG"), ("g.jpg", b"\xff\xd8")):
            pane.save(str(tmp_path / name))
            assert (tmp_path / name).read_bytes().startswith(begin)
        assert errors == []
        (tmp_path / "other.dot").write_text("digraph { one -> two }")
        monkeypatch.setattr(graph_pane.QFileDialog, "getOpenFileName", lambda *_arguments: (str(tmp_path / "other.dot"), ""))
        find(gui, "load_dot_push_button").click()
        wait_until(lambda: drawn(gui) == {"one", "two"})
        find(gui, "quiet_check_box").toggle()  # does not take the file away
        process_events()
        assert drawn(gui) == {"one", "two"}
        (tmp_path / "bad.dot").write_text("digraph { one -> ")
        pane.load_dot(str(tmp_path / "bad.dot"))
        wait_until(lambda: "syntax error" in find(gui, "problem_label").text())
        pane.save("/proc/none.dot")
        assert "cannot write /proc/none.dot" in find(gui, "problem_label").text()
        gui.plugin.refresh()
        wait_until(lambda: drawn(gui) == {"/talker", "/listener"})
        assert "none.dot" not in find(gui, "problem_label").text()


def test_automatic_refresh_sees_a_new_node_without_drawing_the_same_twice(there, monkeypatch):
    monkeypatch.setattr("rqt_graph.ros_graph.PERIOD", 5)
    state = ros_state.State({"/one"})
    reads = []
    monkeypatch.setattr("rqt_graph.ros_graph.read", lambda: (reads.append(1), state)[1])
    with open_plugin("rqt_graph") as gui:
        wait_until(lambda: drawn(gui) == {"/one"})
        times = []
        gui.plugin.pane.drawn.connect(lambda: times.append(1))
        find(gui, "auto_refresh_check_box").setChecked(True)
        state = ros_state.State({"/one", "/two"})
        wait_until(lambda: drawn(gui) == {"/one", "/two"})
        seen = len(reads)
        wait_until(lambda: len(reads) >= seen + 5)
        assert len(times) == 1


def test_results_are_shown_though_work_comes_faster_than_it_is_done():
    from rqt_graph.background import Latest

    application()
    worker, shown = Latest(), []
    worker.done.connect(lambda result, error: (shown.append(result), len(shown) < 4 and worker.run(lambda: "later")))
    for number in range(3):
        worker.run(lambda number=number: number)
    wait_until(lambda: len(shown) >= 4)
    assert shown[:3] == [0, 2, "later"]  # the newest that waited, not the one between


def test_master_that_is_gone_is_told_above_the_graph(there, monkeypatch):
    with open_plugin("rqt_graph") as gui:
        wait_until(lambda: drawn(gui))
        monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
        gui.plugin.refresh()
        wait_until(lambda: "http://localhost:1 does not answer" in find(gui, "problem_label").text())
        assert drawn(gui)  # what was there can still be looked at


def test_completion_goes_on_after_a_comma(there):
    with open_plugin("rqt_graph") as gui:
        wait_until(lambda: drawn(gui))
        edit = find(gui, "filter_line_edit")
        edit.setText("/a,-/tal")
        edit.completer().setCompletionPrefix(edit.text())
        assert edit.completer().currentCompletion() == "/a,-/talker"


@pytest.mark.parametrize("name, begin", [("g.dot", b"digraph"), ("g.svg", b"<?xml"), ("g.png", b"\x89PNG"), ("g.pdf", b"%PDF")])
def test_command_writes_without_a_window(there, tmp_path, monkeypatch, name, begin):
    monkeypatch.delenv("QT_QPA_PLATFORM")
    monkeypatch.delenv("DISPLAY", raising=False)
    path = tmp_path / name
    assert main(["rqt_graph", "--output", str(path), "--type", "all", "--show", "unreachable", "__name:=x"]) == 0
    assert path.read_bytes().startswith(begin)
    if name == "g.dot":
        assert '"n_/dead"' in path.read_text() and '"t_/arm/chatter"' in path.read_text()


def test_command_says_what_is_wrong(there, tmp_path, monkeypatch, capsys):
    assert main(["rqt_graph", "-o", "/proc/g.dot"]) == 1
    assert "cannot write /proc/g.dot" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["rqt_graph", "-o", "g.gif"])
    assert "must be one of .dot, .svg, .png, .pdf" in capsys.readouterr().err
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    assert main(["rqt_graph", f"--output={tmp_path}/g.dot"]) == 1
    assert capsys.readouterr().err == (
        "rqt_graph: the ROS master at http://localhost:1 does not answer; start roscore, or set ROS_MASTER_URI\n"
    )
