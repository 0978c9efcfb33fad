"""Perspectives: made, switched, removed, written to files and read from those of upstream."""

import json

import pytest
from python_qt_binding.QtCore import QByteArray
from qt_gui.application import perspective_file
from qt_gui.application.perspective_dialog import PerspectiveDialog
from qt_gui.errors import PerspectiveError
from rqt_testing.in_process import errors, find, open_gui, open_plugin, process_events

EDIT = """
from python_qt_binding.QtWidgets import QLineEdit
class Plugin:
    def __init__(self, context):
        self.edit = QLineEdit()
        self.edit.setObjectName("edit")
        self.edit.setWindowTitle("Edit")
        context.add_widget(self.edit)
    def save_settings(self, plugin_settings, instance_settings):
        instance_settings.set_value("text", self.edit.text())
    def restore_settings(self, plugin_settings, instance_settings):
        self.edit.setText(instance_settings.value("text", ""))
"""
# as upstream writes them, values and all
UPSTREAM = {
    "keys": {},
    "groups": {
        "mainwindow": {
            "keys": {
                "geometry": {
                    "repr(QByteArray.hex)": "QtCore.QByteArray(b'01d9d0cb00030000')",
                    "type": "repr(QByteArray.hex)",
                    "pretty-print": "        ",
                },
                "state": {"repr(QByteArray.hex)": "QtCore.QByteArray(b'000000ff')", "type": "repr(QByteArray.hex)", "pretty-print": "    "},
            },
            "groups": {"toolbar_areas": {"keys": {"MinimizedDockWidgetsToolbar": {"repr": "8", "type": "repr"}}, "groups": {}}},
        },
        "pluginmanager": {
            "keys": {"running-plugins": {"repr": "{'rqt_edit/Plugin': [1, 2]}", "type": "repr"}},
            "groups": {
                "plugin__rqt_edit__Plugin__1": {
                    "keys": {},
                    "groups": {
                        "dock_widget__edit": {
                            "keys": {
                                "dock_widget_title": {"repr": "'My Title'", "type": "repr"},
                                "dockable": {"repr": "'true'", "type": "repr"},
                                "parent": {"repr": "None", "type": "repr"},
                            },
                            "groups": {},
                        },
                        "plugin": {"keys": {"text": {"repr": "u'from a file'", "type": "repr"}}, "groups": {}},
                    },
                }
            },
        },
    },
}


@pytest.fixture
def gui(workspace):
    workspace.make("rqt_edit", EDIT)
    with open_gui(providers=workspace.providers()) as gui:
        yield gui


def running(gui):
    return {str(handler.instance_id()): handler.plugin().edit.text() for handler in gui.plugins.running()}


def test_each_perspective_has_plugins_and_settings_of_its_own(gui):
    gui.plugins.load_plugin("rqt_edit/Plugin")
    gui.plugins.running()[0].plugin().edit.setText("in Default")
    gui.perspectives.create_perspective("other", clone=True)
    assert running(gui) == {"rqt_edit/Plugin#1": "in Default"} and gui.window.windowTitle() == "other - rqt"
    gui.plugins.running()[0].plugin().edit.setText("in other")
    gui.plugins.load_plugin("rqt_edit/Plugin")
    gui.perspectives.create_perspective("empty", clone=False)
    assert running(gui) == {}
    gui.perspectives.switch_perspective("Default")
    assert running(gui) == {"rqt_edit/Plugin#1": "in Default"}
    gui.perspectives.switch_perspective("other")
    assert running(gui) == {"rqt_edit/Plugin#1": "in other", "rqt_edit/Plugin#2": ""}
    assert errors == []


def test_the_last_one_used_is_the_first_of_the_next_window(workspace, tmp_path):
    workspace.make("rqt_edit", EDIT)
    settings = str(tmp_path / "rqt.ini")
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        gui.perspectives.create_perspective("mine/yours", clone=False)
        gui.plugins.load_plugin("rqt_edit/Plugin")
    with open_plugin("rqt_edit", settings=settings, providers=workspace.providers()) as gui:
        assert gui.perspectives.current() == "@rqt_edit__Plugin"
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        assert gui.perspectives.current() == "mine__yours" and list(running(gui)) == ["rqt_edit/Plugin#1"]
        shown = [
            action.text()
            for menu in gui.window.menuBar().actions()
            if menu.text() == "P&erspectives"
            for action in menu.menu().actions()
            if action.isCheckable()
        ]
        assert shown == ["Default", "mine__yours"]  # the hidden one of the plugin alone is not in the menu


def test_removed_perspective_is_forgotten(gui):
    gui.perspectives.create_perspective("other", clone=True)
    gui.perspectives.remove_perspective("other")  # in use: stays
    assert "other" in gui.perspectives.perspectives
    gui.perspectives.switch_perspective("Default")
    gui.perspectives.remove_perspective("other")
    assert gui.perspectives.perspectives == ["Default"]
    assert not [key for key in gui._settings.allKeys() if "other" in key]


def test_upstream_file_is_read(gui, tmp_path):
    path = tmp_path / "lab.perspective"
    path.write_text(json.dumps(UPSTREAM))
    gui.perspectives.import_perspective_from_file(str(path), "lab")
    assert running(gui) == {"rqt_edit/Plugin#1": "from a file", "rqt_edit/Plugin#2": ""}
    assert gui.plugins.running()[0].docks()[0].windowTitle() == "My Title"
    assert errors == []


def test_exported_file_brings_everything_back(gui, tmp_path, workspace):
    path = str(tmp_path / "out.perspective")
    gui.plugins.load_plugin("rqt_edit/Plugin")
    gui.plugins.running()[0].plugin().edit.setText('it\'s "quoted" – ü')
    gui.perspectives.export_perspective_to_file(path)
    data = json.load(open(path))
    assert data["groups"]["pluginmanager"]["keys"]["running-plugins"] == {"repr": "{'rqt_edit/Plugin': [1]}", "type": "repr"}
    assert data["groups"]["mainwindow"]["keys"]["state"]["type"] == "repr(QByteArray.hex)"
    with open_gui(["--perspective-file", path], providers=workspace.providers()) as other:
        assert running(other) == {"rqt_edit/Plugin#1": 'it\'s "quoted" – ü'}
        assert other.perspectives.current() == "@out.perspective"


def change(data, value):
    data["groups"]["pluginmanager"]["keys"]["running-plugins"] = value


@pytest.mark.parametrize(
    "edit, said",
    [
        (lambda d: change(d, {"type": "repr", "repr": "__import__('os').system('touch /tmp/evil')"}), "is not a Python literal"),
        (lambda d: change(d, {"type": "repr", "repr": "(" * 5000}), "is not a Python literal"),
        (lambda d: change(d, {"type": "pickle", "pickle": "x"}), "has no type of repr"),
        (lambda d: change(d, "text"), "has no type of repr"),
        (lambda d: change(d, {"type": "repr(QByteArray.hex)", "repr(QByteArray.hex)": "exit()"}), "is not a Python literal"),
        (lambda d: d.update(keys=[]), "is not an object with keys and groups"),
        (lambda d: d["groups"].update(mainwindow=3), "mainwindow is not an object"),
    ],
)
def test_malformed_file_changes_nothing(gui, tmp_path, edit, said):
    gui.plugins.load_plugin("rqt_edit/Plugin")
    data = json.loads(json.dumps(UPSTREAM))
    edit(data)
    path = tmp_path / "bad.perspective"
    path.write_text(json.dumps(data))
    with pytest.raises(PerspectiveError) as caught:
        gui.perspectives.import_perspective_from_file(str(path), "bad")
    assert said in str(caught.value) and str(path) in str(caught.value) and "\n" not in str(caught.value)
    assert gui.perspectives.perspectives == ["Default"] and list(running(gui)) == ["rqt_edit/Plugin#1"]


@pytest.mark.parametrize(
    "content, said",
    [(b"{", "is not JSON"), (b"\xff\xfe", "is not JSON"), (b"[" * 100000, "is not JSON"), (None, "cannot be read: Is a directory")],
)
def test_file_that_is_none(tmp_path, content, said):
    path = tmp_path / "x.perspective"
    path.mkdir() if content is None else path.write_bytes(content)
    with pytest.raises(PerspectiveError, match=said):
        perspective_file.read(str(path))


def test_plugins_with_malformed_numbers_are_left_out(gui, tmp_path):
    data = json.loads(json.dumps(UPSTREAM))
    change(data, {"type": "repr", "repr": "{'rqt_edit/Plugin': ['x', 2], 'rqt_gone/Plugin': [1]}"})
    path = tmp_path / "odd.perspective"
    path.write_text(json.dumps(data))
    gui.perspectives.import_perspective_from_file(str(path), "odd")
    assert list(running(gui)) == ["rqt_edit/Plugin#2"]
    assert len(errors) == 2 and "'x' of plugin 'rqt_edit/Plugin' is not a number" in errors[0] and "rqt_gone/Plugin" in errors[1]
    gui.perspectives.save()
    stored = gui.perspectives._perspective_settings.get_settings("pluginmanager").value("running-plugins")
    assert stored == {"rqt_gone/Plugin": [1], "rqt_edit/Plugin": [2]}  # for when its package is back


def test_value_that_no_file_can_hold(tmp_path):
    with pytest.raises(PerspectiveError, match="the setting odd of a plugin is a object"):
        perspective_file.write(str(tmp_path / "x"), {"keys": {"odd": object()}, "groups": {}})
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(PerspectiveError, match="cannot be written"):
        perspective_file.write("/proc/x", {"keys": {}, "groups": {}})


def test_bytes_survive(tmp_path):
    path = str(tmp_path / "x")
    data = {"keys": {"b": QByteArray(bytes(range(256))), "n": None, "l": [1, "a", 2.5, True]}, "groups": {}}
    perspective_file.write(path, data)
    assert perspective_file.read(path) == data


def test_dialog_says_why_a_name_cannot_be(workspace):
    dialog = PerspectiveDialog(None, ["Default"])
    ok = dialog.buttons.buttons()[0]
    for name, usable, problem in (
        ("", False, ""),
        ("a/b", False, "slash"),
        ("@a", False, "hidden"),
        ("Default", False, "exists"),
        ("fine", True, ""),
    ):
        dialog.name_edit.setText(name)
        assert ok.isEnabled() == usable and problem in dialog.problem_label.text()


def test_title_given_by_hand_and_docks_of_containers_come_back(workspace, tmp_path):
    workspace.make("rqt_edit", EDIT)
    settings = str(tmp_path / "rqt.ini")
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        gui.plugins.load_plugin("rqt_edit/Plugin")
        gui.plugins.load_plugin("__DockWidgetContainer")
        dock = gui.plugins.running()[0].docks()[0]
        dock.titleBarWidget().rename("Given")
        dict(dock.other_places())["Move into Container"]()
        assert dock.container().serial_number() == 1 and [t for t, _ in dock.other_places()] == ["Move out of the container"]
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        dock = next(h for h in gui.plugins.running() if "edit" in str(h.instance_id())).docks()[0]
        assert dock.windowTitle() == "Given" and dock.container().serial_number() == 1
        gui.plugins.unload_plugin("__DockWidgetContainer#1")
        process_events()
        assert dock.container() is None and dock.main_window() is gui.window
    assert errors == []


def test_minimised_dock_is_in_the_bar_below(gui):
    gui.plugins.load_plugin("rqt_edit/Plugin")
    dock = gui.plugins.running()[0].docks()[0]
    assert gui.window.minimized.isHidden()
    find(gui, "minimize_button").click()
    assert dock.isHidden() and not gui.window.minimized.isHidden()
    next(a for a in gui.window.minimized.actions() if a.text() == "Edit").trigger()
    assert not dock.isHidden() and gui.window.minimized.isHidden()


def test_frozen_and_locked_windows(workspace, tmp_path):
    workspace.make("rqt_edit", EDIT)
    settings = str(tmp_path / "rqt.ini")
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        gui.plugins.load_plugin("rqt_edit/Plugin")
    with open_gui(["-l", "-f", "-ht"], settings=settings, providers=workspace.providers()) as gui:
        assert running(gui) and gui.window.menuWidget() is None
        for name in ("close_button", "float_button", "minimize_button", "dockable_button", "help_button", "title_label"):
            assert find(gui, name).isHidden(), name


#: The ids that stand in perspectives saved on Noetic: package and name in the plugin.xml of each of its plugins, and pluginlib's name
#: of those that are compiled there.
NOETIC = (
    "rqt_action/ActionPlugin rqt_bag/Bag rqt_console/Console rqt_controller_manager/ControllerManager rqt_dep/RosPackGraph "
    "rqt_graph/RosGraph rqt_image_view/ImageView rqt_joint_trajectory_controller/JointTrajectoryController rqt_launch/Launch "
    "rqt_logger_level/LoggerLevel rqt_msg/Messages MultiplotPlugin rqt_multiplot/MultiplotPlugin rqt_nav_view/NavigationView "
    "rqt_plot/Plot rqt_pose_view/PoseView rqt_publisher/Publisher rqt_py_console/PyConsole rqt_reconfigure/Param "
    "rqt_robot_monitor/RobotMonitor rqt_robot_steering/RobotSteering rosmon rqt_rosmon/rosmon rqt_runtime_monitor/RuntimeMonitor "
    "rqt_rviz/RViz rqt_service_caller/ServiceCaller rqt_shell/Shell rqt_srv/Services rqt_tf_tree/RosTfTree rqt_top/TOP "
    "rqt_topic/TopicPlugin rqt_web/Web"
).split()


def test_every_plugin_of_noetic_is_found_by_the_name_that_its_perspectives_have(workspace):
    with open_gui(providers=workspace.providers()) as gui:
        assert [name for name in NOETIC if gui.plugins.get_plugin_descriptor(name) is None] == []


@pytest.mark.parametrize(
    "package, name, saved",
    [
        ("rqt_topic", "TopicPlugin", "rqt_topic/Topic"),
        ("rqt_multiplot", "MultiplotPlugin", "MultiplotPlugin"),
        ("rqt_rosmon", "rosmon", "rosmon"),
    ],
)
def test_a_perspective_with_another_name_of_a_plugin_opens_it_with_its_settings(workspace, tmp_path, package, name, saved):
    folder = workspace.make(package, cls=name, kind="plugin_of_this_test.Plugin")
    (folder / "src" / "plugin_of_this_test.py").write_text(EDIT)
    tidy = saved.replace("/", "__")
    text = json.dumps(UPSTREAM).replace("rqt_edit/Plugin", saved).replace("rqt_edit__Plugin", tidy)
    path = tmp_path / "p.perspective"
    path.write_text(text)
    with open_gui(["--perspective-file", str(path)], providers=workspace.providers()) as gui:
        assert running(gui) == {f"{saved}#1": "from a file", f"{saved}#2": ""}
        gui.plugins._reload(f"{saved}#1")
        assert running(gui)[f"{saved}#1"] == "from a file"
    assert errors == []


@pytest.mark.parametrize(
    "saved, told",
    [
        ("rqt_ez_publisher/Ez", "no package of this workspace has it. It is not supplied here .* (OTL/rqt_ez_publisher); rqt --list"),
        ("rqt_of_mine/Plugin", "no package of this workspace has it. Is it built in your workspace, and that sourced"),
        ("rqt_edit/Other", "the package rqt_edit has no such plugin, but rqt_edit/Plugin; "),
    ],
)
def test_one_line_says_why_a_plugin_of_a_perspective_is_not_here(workspace, tmp_path, saved, told):
    workspace.make("rqt_edit", EDIT)
    path = tmp_path / "p.perspective"
    path.write_text(json.dumps(UPSTREAM).replace("rqt_edit/Plugin", saved).replace("[1, 2]", "[1]"))
    with open_gui(["--perspective-file", str(path)], providers=workspace.providers()):
        assert len(errors) == 1 and "\n" not in errors[0]
        assert all(part in errors[0] for part in told.split(" .* ")), errors
