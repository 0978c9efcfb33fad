"""Plugins from their loading to their end, and what those cost that misbehave."""

import pytest
from qt_gui.errors import UsageError
from rqt_testing.in_process import errors, find, open_gui, open_plugin, process_events, wait_until

PLUGIN = """
from python_qt_binding.QtCore import QTimer
from python_qt_binding.QtWidgets import QLabel, QLineEdit, QToolBar
from qt_gui.errors import PluginLoadError
from rqt_gui_py.plugin import Plugin as Base
calls = []
class Plugin(Base):
    def __init__(self, context):
        super().__init__(context)
        calls.append(f"init {context.serial_number()} {context.argv()}")
        self.context = context
        self.edit = QLineEdit("first")
        self.edit.setObjectName("edit")
        self.edit.setWindowTitle("Edit" + (f" ({context.serial_number()})" if context.serial_number() > 1 else ""))
        context.add_widget(self.edit)
        INIT
    def restore_settings(self, plugin_settings, instance_settings):
        calls.append("restore")
        self.edit.setText(instance_settings.value("text", "first"))
        self.common = plugin_settings.value("common")
    def save_settings(self, plugin_settings, instance_settings):
        calls.append("save")
        instance_settings.set_value("text", self.edit.text())
        plugin_settings.set_value("common", "from " + self.edit.text())
        SAVE
    def shutdown_plugin(self):
        calls.append("shutdown")
        SHUTDOWN
    CLASS
"""


def code(init="pass", save="pass", shutdown="pass", more="pass"):
    return PLUGIN.replace("INIT", init).replace("SAVE", save).replace("SHUTDOWN", shutdown).replace("CLASS", more)


def calls():
    import rqt_it.module

    return rqt_it.module.calls


def titles(gui):
    return sorted(dock.windowTitle() for handler in gui.plugins.running() for dock in handler.docks())


def test_order_of_calls_and_arguments(workspace):
    workspace.make("rqt_it", code())
    with open_plugin("rqt_it", argv=["--a", "b"], providers=workspace.providers()):
        assert calls() == ["init 0 ['--a', 'b']", "restore"]
    assert calls()[2:] == ["save", "shutdown"]
    assert errors == []


def test_settings_come_back_per_instance_and_per_plugin(workspace, tmp_path):
    workspace.make("rqt_it", code())
    settings = str(tmp_path / "rqt.ini")
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        for text in ("one", "two"):
            assert gui.plugins.load_plugin("rqt_it/Plugin")
            gui.plugins.running()[-1].plugin().edit.setText(text)
        assert titles(gui) == ["Edit", "Edit (2)"]
    with open_gui(settings=settings, providers=workspace.providers()) as gui:
        assert [handler.plugin().edit.text() for handler in gui.plugins.running()] == ["one", "two"]
        assert gui.plugins.running()[0].plugin().common == "from two"


def test_serial_number_of_a_closed_instance_is_free_again(workspace):
    workspace.make("rqt_it", code())
    with open_gui(providers=workspace.providers()) as gui:
        for _ in range(3):
            gui.plugins.load_plugin("rqt_it/Plugin")
        gui.plugins.unload_plugin("rqt_it/Plugin#2")
        gui.plugins.load_plugin("rqt_it/Plugin")
        assert sorted(str(h.instance_id()) for h in gui.plugins.running()) == [f"rqt_it/Plugin#{n}" for n in (1, 2, 3)]


def test_close_button_of_the_last_dock_closes_the_plugin(workspace):
    workspace.make("rqt_it", code())
    with open_gui(providers=workspace.providers()) as gui:
        gui.plugins.load_plugin("rqt_it/Plugin")
        find(gui, "close_button").click()
        process_events()
        assert gui.plugins.running() == [] and calls()[-2:] == ["save", "shutdown"]
        assert gui.window.findChild(type(gui.window), "edit") is None


def test_reload_keeps_settings_and_takes_edited_code(workspace):
    package = workspace.make("rqt_it", code())
    with open_gui(providers=workspace.providers()) as gui:
        gui.plugins.load_plugin("rqt_it/Plugin")
        before = gui.plugins.running()[0].plugin()
        before.edit.setText("kept")
        (package / "src/rqt_it/module.py").write_text(code(init="self.edit.setToolTip('the new code')"))
        find(gui, "reload_button").click()
        process_events()
        after = gui.plugins.running()[0].plugin()
        assert after is not before and after.edit.text() == "kept" and after.edit.toolTip() == "the new code"
    assert errors == []


def test_configuration_button_is_there_for_who_has_one(workspace):
    workspace.make("rqt_it", code(more="def trigger_configuration(self):\n        calls.append('configure')"))
    workspace.make("rqt_other", code())
    with open_plugin("rqt_it", providers=workspace.providers()) as gui:
        assert not find(gui, "configuration_button").isHidden()
        find(gui, "configuration_button").click()
        assert calls()[-1] == "configure"
    with open_plugin("rqt_other", providers=workspace.providers()) as gui:
        assert find(gui, "configuration_button").isHidden()


def test_alone_in_its_window_it_cannot_be_closed_by_itself(workspace):
    workspace.make("rqt_it", code())
    with open_plugin("rqt_it", providers=workspace.providers()) as gui:
        assert find(gui, "close_button").isHidden()
        gui.plugin.context.close_plugin()
        process_events()
        assert gui.plugins.running() and gui.window.menuWidget() is None


@pytest.mark.parametrize(
    "broken, said",
    [
        (dict(init="1 / 0"), "could not load plugin 'rqt_it/Plugin': ZeroDivisionError: division by zero"),
        (dict(init="raise PluginLoadError('it wants a robot')"), "could not load plugin 'rqt_it/Plugin': it wants a robot"),
        (dict(init="raise SystemExit(3)"), "could not load plugin 'rqt_it/Plugin': it ended itself with 3"),
    ],
)
def test_plugin_that_raises_at_its_start_leaves_nothing(workspace, broken, said):
    workspace.make("rqt_it", code(**broken))
    with open_gui(providers=workspace.providers()) as gui:
        assert not gui.plugins.load_plugin("rqt_it/Plugin")
        process_events()
        assert gui.plugins.running() == []
        assert not [d for d in gui.window.findChildren(type(gui.window)) if d.objectName()]
        assert find_names(gui) & {"edit", "close_button"} == set()
        assert len(errors) == 1 and errors[0].startswith(said) and "\n" not in errors[0]
        workspace.make("rqt_it", code())  # corrected, it is loaded without a restart


def find_names(gui):
    from python_qt_binding.QtWidgets import QWidget

    return {widget.objectName() for widget in gui.window.findChildren(QWidget)}


def test_standalone_plugin_that_raises_ends_the_program(workspace):
    workspace.make("rqt_it", code(init="1 / 0"))
    with pytest.raises(UsageError):
        with open_plugin("rqt_it", providers=workspace.providers()):
            pass
    assert len(errors) == 1


def test_import_error_is_a_line(workspace):
    workspace.make("rqt_it", "import no_such_module")
    with open_gui(providers=workspace.providers()) as gui:
        assert not gui.plugins.load_plugin("rqt_it/Plugin")
    assert errors[0].startswith("could not load plugin 'rqt_it/Plugin': ModuleNotFoundError: No module named 'no_such_module'")


def test_exceptions_in_save_shutdown_and_timers_leave_the_window(workspace):
    timer = "self.timer = QTimer(self); self.timer.timeout.connect(lambda: [][1]); self.timer.start(1)"
    workspace.make("rqt_it", code(init=timer, save="raise KeyError('s')", shutdown="raise OSError('t')"))
    workspace.make("rqt_other", code())
    with open_gui(providers=workspace.providers()) as gui:
        gui.plugins.load_plugin("rqt_it/Plugin")
        gui.plugins.load_plugin("rqt_other/Plugin")
        wait_until(lambda: len(errors) >= 3)
        process_events()
        gui.plugins.unload_plugin("rqt_it/Plugin#1")
        assert [str(h.instance_id()) for h in gui.plugins.running()] == ["rqt_other/Plugin#1"]
    assert [e for e in errors if "IndexError" in e][-1].endswith("(not shown again)") and len(errors) == 5
    assert "fails in save_settings(): KeyError: 's'" in errors[-2] and "fails in shutdown_plugin(): OSError: t" in errors[-1]


def test_widget_and_toolbar_may_come_and_go(workspace):
    workspace.make("rqt_it", code(init="self.bar = QToolBar(); self.bar.setObjectName('bar'); context.add_toolbar(self.bar)"))
    with open_gui(providers=workspace.providers()) as gui:
        gui.plugins.load_plugin("rqt_it/Plugin")
        plugin = gui.plugins.running()[0].plugin()
        plugin.context.remove_widget(plugin.edit)
        process_events()
        assert gui.plugins.running()  # its toolbar is still there
        assert plugin.edit.parent() is None
        plugin.context.add_widget(plugin.edit)
        plugin.edit.setWindowTitle("Another")
        assert titles(gui) == ["Another"]
        plugin.context.remove_widget(plugin.edit)
        plugin.context.remove_toolbar(plugin.bar)
        process_events()
        assert gui.plugins.running() == []


def test_floats_for_whole_numbers_as_python_3_8_took_them(workspace):
    workspace.make(
        "rqt_it",
        code(
            init="""
        from python_qt_binding.QtGui import QColor, QImage, QPainter, QPixmap
        from python_qt_binding.QtWidgets import QProgressBar, QSlider, QSpinBox, QSplitter, QTableWidget
        slider, spin, bar, table = QSlider(), QSpinBox(), QProgressBar(), QTableWidget(2.0, 3.0)
        slider.setValue(7.9); spin.setRange(0., 50.5); spin.setValue(20.7); bar.setValue(30.2); table.setColumnWidth(1, 41.9)
        self.edit.resize(100.5, 20.5); self.edit.setFixedWidth(120.9)
        image = QImage(8.5, 8.5, QImage.Format_RGB32)
        painter = QPainter(image); painter.drawLine(0.5, 1, 2, 3.5); painter.drawText(1.5, 2.5, 'x'); painter.end()
        QTimer.singleShot(1.5, lambda: calls.append('timer'))
        splitter = QSplitter(); splitter.addWidget(slider); splitter.addWidget(spin); splitter.setSizes([1.0, 2.0])
        calls.append([slider.value(), spin.value(), bar.value(), table.columnWidth(1), self.edit.width(), image.width(),
                      QColor(1.9, 2, 3).red()])"""
        ),
    )
    with open_plugin("rqt_it", providers=workspace.providers()):
        assert calls()[1] == [7, 20, 30, 41, 120, 8, 1]
        wait_until(lambda: "timer" in calls())
    assert errors == []


def test_what_is_no_number_is_refused_as_before(workspace):
    from python_qt_binding.QtWidgets import QSlider

    slider = QSlider()
    for wrong in ("7", float("nan"), float("inf"), None):
        with pytest.raises((TypeError, ValueError, OverflowError), match="setValue"):
            slider.setValue(wrong)
    with pytest.raises(TypeError, match="too many arguments"):
        slider.setValue(1, 2.0)


def test_window_of_a_plugin_alone_has_the_size_that_its_widget_was_given(workspace):
    workspace.make("rqt_it", code().replace("context.add_widget", "self.edit.resize(500, 320); context.add_widget"))
    with open_plugin("rqt_it", providers=workspace.providers()) as gui:
        assert gui.window.width() >= 500 and gui.window.height() >= 320
