"""Requests, responses, services that fail or hang."""

import threading
from types import SimpleNamespace

import pytest
import rospy
from gazebo_msgs.srv import SetModelState, SetModelStateResponse
from rqt_service_caller import service_caller
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master, wait_until


@pytest.fixture
def calls(monkeypatch):
    class Calls(list):
        answer, gate = SetModelStateResponse(True, "done"), threading.Event()

    def proxy(service, kind):
        def call(request):
            calls.append((service, request))
            if isinstance(calls.answer, Exception):
                raise calls.answer
            if calls.answer is None:
                calls.gate.wait(30)
                return SetModelStateResponse(True, "late")
            return calls.answer

        return call

    calls = Calls()
    monkeypatch.setattr(service_caller.rospy, "ServiceProxy", proxy)
    yield calls
    calls.gate.set()


@pytest.fixture
def gui(calls, tmp_path):
    rospy_without_master()
    with open_plugin("rqt_service_caller", settings=str(tmp_path / "rqt.ini")) as gui:
        gui.plugin.use("/gazebo/set_model_state", SetModelState, "gazebo_msgs/SetModelState")
        yield gui
    assert errors == []


def row(item, *names):
    for name in names:
        item = next(item.child(n) for n in range(item.childCount()) if item.child(n).text(0) == name)
    return item


def request(gui, *names):
    return row(find(gui, "request_tree_widget").topLevelItem(0), "model_state", *names)


def response(gui):
    return find(gui, "response_tree_widget").topLevelItem(0)


def test_called(gui, calls):
    request(gui, "model_name").setText(2, "arm")
    request(gui, "pose", "position", "z").setText(2, "sqrt(4) * pi")
    find(gui, "call_service_button").click()
    wait_until(lambda: response(gui))
    [(service, sent)] = calls
    assert service == "/gazebo/set_model_state" and sent.model_state.model_name == "arm"
    assert sent.model_state.pose.position.z == pytest.approx(6.2831853)
    assert row(response(gui), "status_message").text(2) == "'done'" and row(response(gui), "success").text(2) == "True"


def test_failed(gui, calls):
    calls.answer = rospy.ServiceException("service [/gazebo/set_model_state] unavailable")
    find(gui, "call_service_button").click()
    wait_until(lambda: response(gui))
    assert [response(gui).text(n) for n in range(3)] == ["ERROR", "rospy.ServiceException", "service [/gazebo/set_model_state] unavailable"]


def test_a_service_that_hangs_can_be_left(gui, calls):
    calls.answer = None
    button = find(gui, "call_service_button")
    button.click()
    wait_until(lambda: calls)
    assert button.text() == "Stop waiting"
    button.click()
    assert button.text() == "Call"
    calls.answer = SetModelStateResponse(False, "second")
    button.click()
    wait_until(lambda: response(gui))
    calls.gate.set()
    assert row(response(gui), "status_message").text(2) == "'second'"


def test_wrong_expression(gui, calls):
    request(gui, "pose", "position", "x").setText(2, "far")
    find(gui, "call_service_button").click()
    assert calls == [] and find(gui, "error_label").text().startswith("model_state/pose/position/x: name 'far'")


def test_types_that_cannot_be_imported(gui):
    gui.plugin._show("/odd", "no_package/Odd")
    assert "no_package/Odd" in find(gui, "error_label").text() and "\n" not in find(gui, "error_label").text()
    gui.plugin._show("/dead", None)
    assert find(gui, "error_label").text() == "/dead does not answer; its node may be dead"


def test_kept(calls, tmp_path):
    rospy_without_master()
    settings = str(tmp_path / "kept.ini")
    with open_plugin("rqt_service_caller", settings=settings) as gui:
        gui.plugin.use("/set", SetModelState, "gazebo_msgs/SetModelState")
        request(gui, "model_name").setText(2, "arm")
        gui.plugin.trigger_configuration()
    with open_plugin("rqt_service_caller", settings=settings) as gui:
        gui.plugin.widget.set_services(["/other"])  # it is not there yet
        assert gui.plugin.widget.orientation() == "vertical" and find(gui, "services_combo_box").currentText() == "/set"
        gui.plugin.use("/set", SetModelState, "gazebo_msgs/SetModelState")
        assert request(gui, "model_name").text(2) == "arm"


@pytest.mark.parametrize(
    "kept, wanted", [(1, "horizontal"), (2, "vertical"), ("2", "vertical"), ("vertical", "vertical"), ("", "horizontal")]
)
def test_the_splitter_is_kept_as_qts_number(calls, tmp_path, kept, wanted):
    """As Noetic's rqt_service_caller writes and reads it."""
    rospy_without_master()
    with open_plugin("rqt_service_caller", settings=str(tmp_path / "kept.ini")) as gui:
        values = {"splitter_orientation": kept}
        keeper = SimpleNamespace(value=lambda key, default=None: values.get(key, default), set_value=values.__setitem__)
        gui.plugin.restore_settings(keeper, keeper)
        assert gui.plugin.widget.orientation() == wanted
        gui.plugin.save_settings(keeper, keeper)
        assert values["splitter_orientation"] == {"horizontal": 1, "vertical": 2}[wanted]
