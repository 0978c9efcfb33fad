"""Servers that answer, are dead, refuse; editors; files."""

import math
import threading

import pytest
import rospy
from dynamic_reconfigure.encoding import Config
from rqt_reconfigure import saved_values
from rqt_reconfigure.param_client_widget import ParamClientWidget
from rqt_reconfigure.param_editors import DoubleEditor, make_editor
from rqt_reconfigure.param_widget import ParamWidget
from rqt_testing.in_process import application, errors, find, open_plugin, rospy_without_master, wait_until

ENUM = "{'enum_description': 'size', 'enum': [{'name': 'Small', 'value': 0, 'description': 'tiny'}, {'name': 'Big', 'value': 2}]}"


def param(name, kind, default, lowest="", highest="", method=""):
    return {
        "name": name,
        "type": kind,
        "default": default,
        "min": lowest,
        "max": highest,
        "description": f"about {name}",
        "edit_method": method,
        "level": 0,
    }


def group(name, kind="", parameters=(), groups=(), number=1):
    return {
        "name": name,
        "type": kind,
        "id": number,
        "state": True,
        "parameters": list(parameters),
        "groups": {child["name"]: child for child in groups},
    }


DESCRIPTION = group(
    "Default",
    parameters=[
        param("p", "double", 1.0, 0.0, 10.0),
        param("n", "int", 3, -5, 5),
        param("on", "bool", False, False, True),
        param("text", "str", "hi"),
        param("size", "int", 0, 0, 2, ENUM),
    ],
    groups=[
        group("Limits", "collapse", [param("hard", "double", 0.0, -math.inf, math.inf)], number=2),
        group("Careful", "apply", [param("mode", "int", 0, 0, 9), param("more", "int", 0, 0, 9)], number=3),
        group("One", "tab", [param("a", "bool", True)], number=4),
        group("Two", "tab", [param("b", "bool", True)], number=5),
    ],
)
VALUES = {"p": 2.5, "n": 1, "on": True, "text": "hello", "size": 2, "hard": 0.0, "mode": 1, "more": 0, "a": True, "b": False}


class FakeClient:
    """A server by its node's name: /dead, /silent, /refuses, /slow, or one that obeys."""

    made, gate = [], threading.Event()

    def __init__(self, node, timeout, config_callback):
        if node == "/dead":
            raise rospy.ROSException("timeout exceeded while waiting for service /dead/set_parameters")
        self.node, self.config, self.sent, self.closed, self.callback = node, Config(VALUES), [], False, config_callback
        FakeClient.made.append(self)

    def get_group_descriptions(self, timeout):
        return None if self.node == "/silent" else DESCRIPTION

    def get_configuration(self, timeout):
        return self.config

    def update_configuration(self, values):
        self.sent.append(values)
        if self.node == "/refuses":
            raise rospy.ServiceException("service call failed")
        if self.node == "/slow":
            self.gate.wait(30)
        self.config.update({k: v for k, v in values.items() if k != "groups"})
        return self.config

    def close(self):
        self.closed = True


@pytest.fixture
def client():
    widgets = []

    def make(node="/arm/pid"):
        application()
        widgets.append(ParamClientWidget(node, FakeClient))
        wait_until(lambda: not widgets[-1]._background.busy("connect"))
        return widgets[-1]

    yield make
    FakeClient.gate.set()
    for widget in widgets:
        widget.close_client()


def editors(widget):
    return widget.group.all_editors()


def test_editors_show_and_send(client):
    widget = client()
    fields, server = editors(widget), FakeClient.made[-1]
    assert list(fields) == ["p", "n", "on", "text", "size", "hard", "mode", "more", "a", "b"]
    assert fields["p"].line_edit.text() == "2.5" and fields["p"].slider.value() == 25 and fields["on"].check_box.isChecked()
    assert fields["size"].combo_box.currentText() == "Big (2)" and fields["text"].toolTip() == "about text"
    fields["p"].line_edit.setText("99")
    fields["p"].line_edit.editingFinished.emit()
    wait_until(lambda: server.sent == [{"p": 10.0}])
    for act, sent in (
        (lambda: fields["n"].slider.setValue(-4), {"n": -4}),
        (fields["on"].check_box.click, {"on": False}),
        (lambda: fields["size"].combo_box.activated.emit(0), {"size": 0}),
        (lambda: fields["p"].menu().actions()[0].trigger(), {"p": 1.0}),
        (lambda: fields["text"].menu().actions()[-1].trigger(), {"text": ""}),
    ):
        act()
        wait_until(lambda: server.sent[-1] == sent and not widget._background.busy("send"))
    fields["p"].line_edit.setText("much")
    fields["p"].line_edit.editingFinished.emit()
    assert fields["p"].line_edit.text() == "1" and server.sent[-1] == {"text": ""}


def test_apply_sends_all_at_once(client):
    widget = client()
    fields, server = editors(widget), FakeClient.made[-1]
    fields["mode"].slider.setValue(5)
    fields["more"].slider.setValue(6)
    server.callback(server.config)
    assert server.sent == []
    widget.group.groups[1].apply_button.click()
    wait_until(lambda: server.sent == [{"mode": 5, "more": 6}])


def test_changes_from_elsewhere(client):
    widget = client()
    FakeClient.made[-1].callback(
        Config(
            {
                **VALUES,
                "p": 7.5,
                "groups": Config(
                    {
                        "id": 0,
                        "parent": 0,
                        "name": "Default",
                        "type": "",
                        "state": True,
                        "parameters": Config({}),
                        "groups": Config(
                            {"Limits": Config({"id": 1, "parent": 0, "name": "Limits", "state": False, "groups": Config({})})}
                        ),
                    }
                ),
            }
        )
    )
    wait_until(lambda: editors(widget)["p"].slider.value() == 75)
    assert not widget.group.groups[0].box.isChecked()


def test_while_a_server_is_busy_the_newest_waits(client):
    FakeClient.gate.clear()
    widget = client("/slow")
    for value in (1, 2, 3):
        editors(widget)["n"].slider.setValue(value + 1)
    server = FakeClient.made[-1]
    wait_until(lambda: server.sent == [{"n": 2}])
    FakeClient.gate.set()
    wait_until(lambda: server.sent == [{"n": 2}, {"n": 4}])


def test_refused_and_dead(client):
    widget = client("/refuses")
    editors(widget)["n"].slider.setValue(5)
    wait_until(lambda: find(widget, "status_label").text() == "/refuses did not take it: service call failed")
    assert editors(widget)["n"].slider.value() == 1
    assert "/dead does not answer: timeout exceeded" in find(client("/dead"), "status_label").text()
    assert "does not describe its parameters" in find(client("/silent"), "status_label").text()


@pytest.mark.parametrize("lowest, highest", [(-math.inf, math.inf), (0.0, math.inf), (-math.inf, 5.0), (-2.0, 3.0), (1.0, 1.0)])
def test_sliders_without_bounds(lowest, highest):
    application()
    editor = DoubleEditor(param("x", "double", 1.0, lowest, highest))
    for value in (1.0, 2.5, -1.0, math.nan, math.inf, -math.inf):
        editor.show_value(value)
        assert 0 <= editor.slider.value() <= 100
    assert (editor._value_at(0), editor._value_at(100)) == (lowest, highest)
    if highest > lowest:
        places = [editor._value_at(place) for place in range(101)]
        assert places == sorted(places) and editor._place_of(places[40]) == 40


def test_descriptions_that_are_odd():
    application()
    assert make_editor(param("x", "matrix", 1)) is None
    assert type(make_editor(param("x", "int", 1, 0, 2, "__import__('os').abort()"))).__name__ == "IntegerEditor"


def test_files(client, tmp_path):
    widget, path = client(), tmp_path / "pid.yaml"
    widget.save(str(path))
    assert path.read_text().startswith("!!python/object/new:dynamic_reconfigure.encoding.Config")
    assert saved_values.load(str(path)) == VALUES
    path.write_text("p: 3.5\nelsewhere: 1\n")
    widget.load(str(path))
    wait_until(lambda: FakeClient.made[-1].sent == [{"p": 3.5}])
    for content in (b"[1, 2]", b"!!python/object/apply:os.system ['true']", b"a: [", b"\xff\xfe\xff"):
        path.write_bytes(content)
        widget.load(str(path))
        assert find(widget, "status_label").text().startswith(f"{path} is no YAML file") and "\n" not in find(widget, "status_label").text()


def test_tree_filter_and_selection():
    application()
    rospy_without_master()
    widget = ParamWidget(["arm/pid", "missing"], lambda node: ParamClientWidget(node, FakeClient))
    widget._background.forget("nodes")  # the master's answer, which is in the test's hands here
    widget.show_nodes(["/arm", "/arm/pid", "/camera", "/dead"])
    assert list(widget.clients) == ["/arm/pid"] and widget.status_label.text() == "no such dynamic_reconfigure server: missing"
    widget.filter_edit.setText("CAM|pid")
    assert [widget._items[node].isHidden() for node in ("/arm", "/arm/pid", "/camera", "/dead")] == [False, False, False, True]
    widget.filter_edit.setText("(")
    widget.filter_edit.setText("")
    widget._items["/dead"].setSelected(True)
    wait_until(lambda: widget._items["/dead"].toolTip(0) == "does not answer")
    find(widget.clients["/arm/pid"], "close_button").click()
    assert list(widget.clients) == ["/dead"]
    widget.show_nodes(["/arm/pid"])
    assert not widget.clients and list(widget._items) == ["/arm/pid"]
    widget.close_all()


def test_in_the_window(tmp_path):
    rospy_without_master()
    with open_plugin("rqt_reconfigure", argv=["/arm/pid"], settings=str(tmp_path / "rqt.ini")) as gui:
        assert gui.plugin.widget._wanted == ["/arm/pid"]
        find(gui, "filter_edit").setText("arm")
    with open_plugin("rqt_reconfigure", settings=str(tmp_path / "rqt.ini")) as gui:
        assert find(gui, "filter_edit").text() == "arm"
    assert errors == []
