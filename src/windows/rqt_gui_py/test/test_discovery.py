"""Which plugins the window finds, and what it says of those that it cannot take."""

import pytest
from qt_gui.errors import UsageError
from rqt_testing.in_process import errors, open_gui, open_plugin

SIMPLE = """
from python_qt_binding.QtWidgets import QLabel
from rqt_gui_py.plugin import Plugin as Base
class Plugin(Base):
    def __init__(self, context):
        super().__init__(context)
        self.label = QLabel("text of " + __name__)
        self.label.setObjectName("label")
        self.label.setWindowTitle("Simple")
        context.add_widget(self.label)
"""


def test_plugin_of_any_package_is_found_and_in_its_menu(workspace):
    workspace.make("rqt_first", SIMPLE, label="The First")
    with open_gui(providers=workspace.providers()) as gui:
        assert gui.plugins.get_plugins()["rqt_first/Plugin"] == "rqt_first.module.Plugin"
        menus = {action.text(): action.menu() for action in gui.window.menuBar().actions()}
        topics = next(action.menu() for action in menus["&Plugins"].actions() if action.text() == "Topics")
        next(action for action in topics.actions() if action.text() == "The First").trigger()
        assert [str(handler.instance_id()) for handler in gui.plugins.running()] == ["rqt_first/Plugin#1"]
        assert "Close: Simple" in [action.text() for action in menus["&Running"].actions()]
    assert errors == []


def test_plugin_that_was_added_a_moment_ago_is_found(workspace, tmp_path):
    settings = str(tmp_path / "rqt.ini")
    workspace.make("rqt_first", SIMPLE)
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        assert "rqt_second/Plugin" not in gui.plugins.get_plugins()
    workspace.make("rqt_second", SIMPLE)
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        assert "rqt_second/Plugin" in gui.plugins.get_plugins()


def test_names_are_parts_in_any_case_and_must_fit_one(workspace):
    workspace.make("rqt_first", SIMPLE)
    workspace.make("rqt_first_aid", SIMPLE)
    providers = workspace.providers()
    with open_gui(providers=providers) as gui:
        assert gui.choose("FIRST_AID") == "rqt_first_aid/Plugin"
        assert gui.choose("rqt_first") == "rqt_first/Plugin"  # a package's own name is not ambiguous
        with pytest.raises(UsageError, match="multiple plugins matching 'first'"):
            gui.choose("first")
        with pytest.raises(UsageError, match="no plugin matching 'nothing'"):
            gui.choose("nothing")


def test_compiled_plugin_is_refused_by_name_in_one_line(workspace):
    workspace.make("rqt_fast", kind="rqt_fast::Plugin", base="rqt_gui_cpp::Plugin", path="lib/librqt_fast", cls="rqt_fast/Plugin")
    with open_gui(providers=workspace.providers()) as gui:
        assert "rqt_fast/Plugin" not in gui.plugins.get_plugins()
        with pytest.raises(UsageError) as caught:
            gui.choose("rqt_fast")
        assert str(caught.value) == (
            "'rqt_fast/Plugin' of package rqt_fast is a compiled C++ plugin (rqt_fast::Plugin); only Python plugins can be loaded here"
        )
        assert not gui.plugins.load_plugin("rqt_fast/Plugin")
        assert errors == [f"could not load plugin 'rqt_fast/Plugin': {caught.value}"]


@pytest.mark.parametrize(
    "name, break_it, said",
    [
        ("cut_off", lambda p: (p / "plugin.xml").write_text("<library path='src'><class"), "is not XML"),
        ("absent", lambda p: (p / "plugin.xml").unlink(), "No such file"),
        (
            "no_class",
            lambda p: (p / "plugin.xml").write_text((p / "plugin.xml").read_text().replace("no_class.module.Plugin", "x")),
            "is not a Python class",
        ),
        ("manifest", lambda p: (p / "package.xml").write_text("<package><rqt_gui "), "is not XML"),
    ],
)
def test_broken_description_is_a_line_and_leaves_the_others(workspace, name, break_it, said):
    workspace.make("rqt_first", SIMPLE)
    break_it(workspace.make(name, SIMPLE))
    with open_gui(providers=workspace.providers()) as gui:
        assert "rqt_first/Plugin" in gui.plugins.get_plugins()
        assert f"{name}/Plugin" not in gui.plugins.get_plugins()
    assert len(errors) == 1 and said in errors[0] and name in errors[0] and "\n" not in errors[0]


def test_provider_of_a_package_brings_its_plugins(workspace):
    workspace.make(
        "rqt_provider",
        base="rqt_gui_py::PluginProvider",
        cls="Provider",
        code="""
from python_qt_binding.QtWidgets import QLabel
from qt_gui.plugin_descriptor import PluginDescriptor
from qt_gui.plugin_provider import PluginProvider
class Duck:
    def __init__(self, context):
        context.add_widget(QLabel("quack"))
class Provider(PluginProvider):
    def discover(self, discovery_data):
        descriptor = PluginDescriptor("pond/Duck", {"class_type": "pond.Duck"})
        descriptor.set_action_attributes("Duck")
        return [descriptor]
    def load(self, plugin_id, plugin_context):
        return Duck(plugin_context)
""",
    )
    with open_plugin("pond", providers=workspace.providers()) as gui:
        assert type(gui.plugin).__name__ == "Duck"
    assert errors == []


def test_provider_that_raises_leaves_the_others(workspace):
    workspace.make("rqt_first", SIMPLE)
    workspace.make(
        "rqt_provider",
        "class Provider:\n    def __init__(self):\n        raise ValueError('no')",
        base="rqt_gui_py::PluginProvider",
        cls="Provider",
    )
    with open_gui(providers=workspace.providers()) as gui:
        assert "rqt_first/Plugin" in gui.plugins.get_plugins()
    assert len(errors) == 1 and "'rqt_provider/Provider' cannot be loaded: ValueError: no" in errors[0]
