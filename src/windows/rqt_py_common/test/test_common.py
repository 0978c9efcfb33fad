"""Topics, messages and fields, as plugins ask for them."""

import genpy
import pytest
import rosgraph
import rospy
from geometry_msgs.msg import Point, PoseArray
from nav_msgs.msg import Odometry
from python_qt_binding.QtCore import QModelIndex, Qt, Signal
from python_qt_binding.QtTest import QTest
from python_qt_binding.QtWidgets import QLineEdit, QWidget
from rqt_py_common import ini_helper, rosaction, topic_helpers
from rqt_py_common.extended_combo_box import ExtendedComboBox
from rqt_py_common.message_tree_model import MessageTreeModel
from rqt_py_common.plugin_container_widget import PluginContainerWidget
from rqt_py_common.rqt_ros_graph import RqtRosGraph
from rqt_py_common.rqt_roscomm_util import RqtRoscommUtil
from rqt_py_common.topic_completer import TopicCompleter
from rqt_testing.in_process import application, wait_until
from sensor_msgs.msg import JointState


@pytest.fixture(autouse=True)
def app():
    return application()


@pytest.mark.parametrize(
    "name, cls",
    [
        ("float32", float),
        ("uint8", int),
        ("char", int),
        ("bool", bool),
        ("string", str),
        ("time", genpy.Time),
        ("duration", genpy.Duration),
        ("geometry_msgs/Point", Point),
        ("no_such_pkg/Type", None),
        ("nonsense", None),
    ],
)
def test_class_of_a_type(name, cls):
    assert topic_helpers.get_type_class(name) is cls


@pytest.mark.parametrize(
    "message, path, kind",
    [
        (Odometry, "/pose/pose/position/x", (float, False)),
        (Odometry, "pose/covariance", (float, True)),
        (Odometry, "pose/covariance[3]", (float, False)),
        (JointState, "position[0]", (float, False)),
        (JointState, "name", (str, True)),
        (PoseArray, "poses[0]/position/x", (float, False)),
        (Odometry, "header/seq", (int, False)),
        (Odometry, "", (Odometry, False)),
        (Odometry, "nothing", (None, False)),
        (JointState, "position[", (None, False)),
        (Odometry, "header/seq/deeper", (None, False)),
    ],
)
def test_type_of_a_field(message, path, kind):
    assert topic_helpers.get_slot_type(message, path) == kind


def test_fields_of_a_type_are_found():
    deep = topic_helpers.find_slots_by_type_dfs(Odometry, "geometry_msgs/Point")
    assert deep == ["pose/pose/position"] == topic_helpers.find_slots_by_type_dfs(Odometry, Point)
    assert topic_helpers.find_slots_by_type_bfs(PoseArray, "float64")[0] == "poses[]/position/x"


@pytest.fixture
def topics(monkeypatch):
    shown = [["/odom", "nav_msgs/Odometry"], ["/strange", "gone_msgs/Gone"], ["/arm/joint_states", "sensor_msgs/JointState"]]
    monkeypatch.setattr(rospy, "get_published_topics", lambda namespace="/": [list(pair) for pair in shown])
    monkeypatch.setattr(
        topic_helpers,
        "get_topic_type",
        lambda topic: next(((kind, name, None) for name, kind in shown if topic.startswith(name)), (None, None, None)),
    )
    return shown


def test_numeric_fields_of_topics(topics):
    assert topic_helpers.is_slot_numeric("/odom/pose/pose/position/x")[:2] == (True, False)
    assert topic_helpers.is_slot_numeric("/arm/joint_states/position")[:2] == (True, True)
    for wrong in ("/odom", "/odom/child_frame_id", "/strange/x", "/none"):
        numeric, _, text = topic_helpers.is_slot_numeric(wrong)
        assert not numeric and f'"{wrong}" is NOT numeric' in text


def test_completer_offers_topics_and_fields(topics):
    edit = QLineEdit()
    completer = TopicCompleter(edit)
    completer.update_topics()
    edit.setCompleter(completer)
    completer.setCompletionPrefix("/odom/po")
    assert completer.completionCount() == 1 and completer.currentCompletion() == "/odom/pose"
    completer.setCompletionPrefix("/str")
    assert completer.completionCount() == 0  # its type is not installed


def test_a_list_of_topics_that_is_open_stays(topics):
    completer = TopicCompleter()
    completer.update_topics()
    item = completer.model().item(0)
    completer.update_topics()
    assert completer.model().item(0) is item
    topics.append(["/new", "geometry_msgs/Point"])
    completer.update_topics()
    assert completer.model().rowCount() == 3


def test_message_as_a_tree():
    model = MessageTreeModel()
    model.add_message(JointState(position=[1.0, 2.0]), "js", "sensor_msgs/JointState", "/js")
    fields = {model.item(0).child(row).text(): model.item(0).child(row) for row in range(model.item(0).rowCount())}
    assert fields["position"].child(1)._path == "/js/position[1]" and fields["position"].rowCount() == 2
    assert fields["velocity"].rowCount() == 0
    index = fields["position"].child(1).index()
    assert RqtRosGraph.get_full_grn(index) == "/js/position/[1]"
    assert RqtRosGraph.get_lower_grn_dfs(fields["position"].index()) == ["/position/[0]", "/position/[1]"]
    assert model._get_toplevel_items([index, fields["name"].index()]) == [model.item(0)]
    assert RqtRosGraph.get_upper_grn(QModelIndex(), "/x") == "/x"


def test_combo_box_is_searched_by_any_part_and_keeps_its_choice():
    box = ExtendedComboBox()
    box.addItems(["/arm/state", "/base/state", "/camera"])
    box.lineEdit().selectAll()
    QTest.keyClicks(box.lineEdit(), "BASE")
    assert box.filter_model.rowCount() == 1
    box.on_completer_activated("/base/state")
    box.setItems.emit(["/a", "/base/state"])
    wait_until(lambda: box.count() == 2)
    assert box.currentText() == "/base/state"


def test_lists_in_settings():
    assert [ini_helper.pack([]), ini_helper.pack(["a"]), ini_helper.pack(["a", "b"])] == ["", "a", ["a", "b"]]
    assert [ini_helper.unpack(v) for v in ("", None, "a", ["a", "b"])] == [[], [], ["a"], ["a", "b"]]


def test_packages_files_actions():
    assert "rosmon_core" not in dict(RqtRoscommUtil.iterate_packages("launch"))
    assert "actionlib_tutorials/Fibonacci" in rosaction.list_actions("actionlib_tutorials") if _has("actionlib_tutorials") else True
    with pytest.raises(ValueError):
        next(RqtRoscommUtil.iterate_packages(""))
    assert rosaction.get_action_class("actionlib/Test").__name__ == "TestAction"
    assert rosaction.get_action_class("no_such_pkg/Thing") is None


def _has(package):
    import rospkg

    return package in rospkg.RosPack().list()


def test_master_that_is_not_there(monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    assert rosgraph.get_master_uri() == "http://localhost:1" and not RqtRoscommUtil.is_roscore_running()


class Inner(QWidget):
    sig_sysmsg = Signal(str)
    sig_sysprogress = Signal(str)


def test_container_widget_shows_messages():
    inner = Inner()
    outer = PluginContainerWidget(inner)
    inner.sig_sysmsg.emit("something happened")
    inner.sig_sysprogress.emit("40")
    inner.sig_sysprogress.emit("nonsense")
    assert outer._sysmsg_widget.toPlainText() == "something happened" and outer._sysprogress_bar.value() == 40
    assert Qt.Orientation.Vertical == outer._splitter.orientation()
