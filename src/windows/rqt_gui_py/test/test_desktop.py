"""The window as a person uses it: real clicks and keys on a private X server."""

import os

import pytest
from rqt_testing.desktop import Desktop
from rqt_testing.no_master import NoMaster

from conftest import Workspace

EDIT = """
from python_qt_binding.QtWidgets import QLineEdit
from rqt_gui_py.plugin import Plugin as Base
class Plugin(Base):
    def __init__(self, context):
        super().__init__(context)
        self.edit = QLineEdit()
        self.edit.setObjectName("edit" + str(context.serial_number()))
        self.edit.setWindowTitle("Edit %d" % context.serial_number())
        context.add_widget(self.edit)
    def save_settings(self, plugin_settings, instance_settings):
        instance_settings.set_value("text", self.edit.text())
    def restore_settings(self, plugin_settings, instance_settings):
        self.edit.setText(instance_settings.value("text", ""))
"""


@pytest.fixture
def rqt(tmp_path):
    workspace = Workspace(tmp_path / "ws")
    workspace.make("rqt_edit", EDIT, label="The Edit")
    variables = {"ROS_PACKAGE_PATH": f"{workspace.folder}:{os.environ['ROS_PACKAGE_PATH']}", "ROS_MASTER_URI": NoMaster().start()}
    with Desktop("1000x700x24") as desktop:
        yield desktop, lambda *arguments: desktop.run(["rqt", *arguments], **variables)


@pytest.mark.slow
def test_open_from_the_menu_use_minimise_close_and_reopen(rqt):
    desktop, start = rqt
    window = start()
    window.window("Default - rqt")
    window.choose("Plugins", "Topics", "The Edit")
    window.click("edit1")
    desktop.type("typed by hand")
    window.wait(lambda: window.text("edit1") == "typed by hand", "typed text")
    window.choose("Plugins", "Topics", "The Edit")
    window.rect("edit2")
    window.click_text("Running")
    window.click_text("Close: Edit 2")
    window.wait(lambda: window.ask("rect", "edit2") is None, "closed dock")
    window.click("minimize_button")
    window.wait(lambda: window.ask("rect", "edit1") is None, "minimised dock")
    window.click_text("Edit 1")  # in the bar below
    window.rect("edit1")
    window.click("title_label", button=3)
    window.click_text("Rename dock widget")
    window.rect("title_edit")
    desktop.type("My name\n")
    window.wait(lambda: window.text("title_label") == "My name", "new title")
    assert window.end() == 0 and window.output() == ""
    window = start()
    window.window("Default - rqt")
    assert window.text("edit1") == "typed by hand" and window.text("title_label") == "My name"
    window.choose("File", "Quit")
    assert window.process.wait(30) == 0


@pytest.mark.slow
def test_perspective_is_made_and_chosen_by_its_menu(rqt):
    desktop, start = rqt
    window = start()
    window.window("Default - rqt")
    window.choose("Plugins", "Topics", "The Edit")
    window.rect("edit1")
    window.choose("Perspectives", "Create perspective...")
    window.click("perspective_name_edit")
    desktop.type("lab")
    window.click("clone_checkbox", at=(0.05, 0.5))
    window.click_text("OK")
    window.window("lab - rqt")
    window.wait(lambda: window.ask("rect", "edit1") is None, "empty perspective")
    window.choose("Perspectives", "Default")
    window.window("Default - rqt")
    window.rect("edit1")
    assert window.end() == 0 and window.output() == ""


@pytest.mark.slow
def test_dragged_dock_stays_where_it_was_put(rqt):
    desktop, start = rqt
    window = start()
    left, top, width, height = window.window("Default - rqt")[2:]
    for number in (1, 2):
        window.choose("Plugins", "Topics", "The Edit")
        window.rect(f"edit{number}")
    x, y, *_ = begin = window.rect("edit1")
    desktop.drag((x + 80, y - 11), (left + 5, top + height // 2))  # by its title, to the window's left edge
    window.wait(lambda: window.ask("rect", "edit1") not in (None, begin), "dock in another area")
    seen = [None, None]

    def resting():
        seen[:] = seen[1], [window.ask("rect", f"edit{number}") for number in (1, 2)]
        return None not in seen[1] and seen[0] == seen[1]

    window.wait(resting, "docks at rest")
    (first, _, narrow, _), (second, _, wide, _) = placed = seen[1]
    assert first < second and narrow < wide  # an area at the side takes no more than it needs, the other has the rest
    assert window.end() == 0 and window.output() == ""
    window = start()
    window.window("Default - rqt")
    window.wait(lambda: [window.ask("rect", f"edit{number}") for number in (1, 2)] == placed, f"docks at {placed}")
    assert window.end() == 0
