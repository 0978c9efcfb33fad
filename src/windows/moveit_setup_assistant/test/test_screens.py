"""How the window looks and what it offers: screens listed from the start, nothing enabled that cannot be done, nothing clipped."""

from pathlib import Path

import numpy as np
import pytest
import rospkg
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtTest import QTest
from python_qt_binding.QtWidgets import (
    QAbstractButton,
    QAbstractSpinBox,
    QComboBox,
    QLabel,
    QLineEdit,
    QMessageBox,
    QPushButton,
    QTabBar,
    QTableWidget,
    QWidget,
)

# MoveIt's own, in its order
TITLES = [
    "Start",
    "Self-Collisions",
    "Virtual Joints",
    "Planning Groups",
    "Robot Poses",
    "End Effectors",
    "Passive Joints",
    "Controllers",
    "Simulation",
    "3D Perception",
    "Author Information",
    "Configuration Files",
]
SIZES = [(900, 700), (1180, 760)]


def usable(user):
    items = [user.window.list.item(row) for row in range(user.window.list.count())]
    assert not any(item.isHidden() for item in items)
    return {item.text(): bool(item.flags() & Qt.ItemIsEnabled) for item in items}


def test_all_screens_are_listed_and_greyed_until_a_robot_is_loaded(user, urdf):
    assert list(usable(user)) == TITLES
    assert [title for title, can in usable(user).items() if can] == ["Start"]
    assert not user.widget("robot_view").isVisible()
    user.load(urdf)
    assert all(usable(user).values()) and user.widget("robot_view").isVisible()


def test_two_large_buttons_begin_and_the_form_follows(user, urdf, tmp_path):
    for name, text in (("start_new", "Create New MoveIt"), ("start_edit", "Edit Existing MoveIt")):
        button = user.widget(name)
        assert button.text().replace("&", "").startswith(text) and button.height() >= 60 and button.width() >= 180
    assert not user.widget("start_path").isVisible() and not user.widget("start_load").isVisible()
    user.click("start_new")
    assert user.widget("start_path").isVisible() and not user.can("start_load")
    user.fill(start_path=str(urdf))
    assert user.can("start_load") and not user.can("start_xacro_args"), "a plain URDF has no arguments"
    macro = tmp_path / "small.urdf.xacro"
    macro.write_text(urdf.read_text())
    user.fill(start_path=str(macro))
    assert user.can("start_load") and user.can("start_xacro_args")
    user.click("start_edit")
    assert user.can("start_load") and not user.can("start_xacro_args"), "the package holds its own"


def test_a_table_offers_what_can_be_done_with_its_rows(user, urdf):
    user.load(urdf)
    user.screen("Virtual Joints")
    buttons = [f"virtual_joints_{which}" for which in ("add", "change", "delete")]
    assert [user.can(name) for name in buttons] == [False, False, False]
    assert "needs a name" in user.widget("virtual_joints_hint").text()
    user.fill(virtual_joints_name="stand_here", virtual_joints_child_link="base")
    assert [user.can(name) for name in buttons] == [True, False, False]
    user.click("virtual_joints_add")
    assert user.rows("virtual_joints_list") == [["stand_here", "base", "world", "fixed"]]
    assert [user.can(name) for name in buttons] == [False, False, True], "the name is taken, nothing is changed, one is marked"
    user.fill(virtual_joints_type="planar")
    assert [user.can(name) for name in buttons] == [False, True, True]
    user.click("virtual_joints_change")
    assert user.rows("virtual_joints_list") == [["stand_here", "base", "world", "planar"]]
    user.click("virtual_joints_delete")
    assert user.rows("virtual_joints_list") == [] and not user.can("virtual_joints_delete")


def test_what_needs_a_group_waits_for_one(user, urdf):
    user.load(urdf)
    user.screen("End Effectors")
    user.fill(end_effectors_name="hand")
    assert not user.can("end_effectors_add") and "Planning Groups" in user.widget("end_effectors_hint").text()
    user.screen("Robot Poses")
    user.fill(poses_name="home")
    assert not user.can("poses_add") and not user.can("poses_animate") and "Planning Groups" in user.widget("poses_hint").text()
    user.screen("Controllers")
    assert not user.can("controllers_auto")
    user.screen("Planning Groups")
    assert not user.can("groups_delete") and not user.can("groups_name")
    user.click("groups_add")
    assert user.can("groups_delete") and user.can("groups_name")
    user.fill(groups_base_link="base", groups_tip_link="inside")
    assert user.rows("groups_list") == [["group", "None", "base to inside"]]
    user.screen("End Effectors")
    user.fill(end_effectors_group="group", end_effectors_parent_link="far")
    assert user.can("end_effectors_add")
    user.screen("Robot Poses")
    user.click("poses_add")
    assert user.rows("poses_list") == [["home", "group"]] and user.can("poses_animate") and not user.can("poses_change")
    user.fill(poses_value_turn=0.3)
    assert user.can("poses_change")
    user.screen("Controllers")
    user.click("controllers_auto")
    assert user.rows("controllers_list") == [["group_controller", "effort_controllers/JointTrajectoryController", "2 joints"]]
    assert not user.can("controllers_auto"), "every group has one now"


def test_a_solvers_numbers_wait_for_a_solver_and_moves_for_marked_names(user, package):
    user.open(package)
    user.screen("Planning Groups")
    assert user.can("groups_timeout")
    user.fill(groups_solver="None")
    assert not user.can("groups_timeout") and not user.can("groups_file")
    for name in ("groups_joints_add", "groups_joints_remove"):
        assert not user.can(name)
    user.mark("groups_joints_available", "swinging")
    assert user.can("groups_joints_add") and not user.can("groups_joints_remove")
    user.click("groups_joints_add")
    assert not user.can("groups_joints_add"), "it has gone to the right"


def test_simulation_and_files_offer_what_is_there(user, urdf, tmp_path):
    user.load(urdf)
    user.screen("Simulation")
    assert not user.can("simulation_copy") and not user.can("simulation_remove")
    user.click("simulation_generate")
    assert user.can("simulation_copy")
    user.click("simulation_remove")
    assert not user.can("simulation_remove")
    user.screen("Configuration Files")
    assert not user.can("files_generate") and "folder" in user.widget("files_hint").text()
    user.fill(files_folder=str(tmp_path / "small_moveit_config"))
    assert not user.can("files_generate") and "e-mail" in user.widget("files_hint").text()
    user.screen("Author Information")
    user.fill(author_name="Ada", author_email="ada@example.org")
    user.screen("Configuration Files")
    assert user.can("files_generate") and ["new", "package.xml", "name and dependencies"] in user.rows("files_list")


def test_a_folder_is_looked_at_while_it_is_typed(user, package, tmp_path):
    user.open(package)
    user.screen("Configuration Files")
    assert user.can("files_generate")
    user.widget("files_folder").setText("/")
    user.wait(lambda: not user.can("files_generate"), "a look at the folder")
    user.widget("files_folder").setText(str(tmp_path / "other_moveit_config"))
    user.wait(lambda: user.can("files_generate"), "a look at the folder")


def test_while_pairs_are_looked_for_there_is_a_bar_and_a_way_to_stop(user, urdf):
    user.load(urdf)
    user.screen("Self-Collisions")
    assert not user.widget("collisions_progress").isVisible()
    user.fill(collisions_trials=100000)
    user.click("collisions_generate")
    assert user.widget("collisions_progress").isVisible() and not user.can("collisions_trials")
    assert user.widget("collisions_generate").text() == "&Stop"
    user.click("collisions_generate")
    user.wait(lambda: user.can("collisions_trials"), "the end")
    assert not user.widget("collisions_progress").isVisible()


@pytest.fixture
def answers(monkeypatch):
    """What was asked, and the answer that is given next."""
    found = {"asked": [], "next": QMessageBox.Cancel}

    def question(_parent, title, *_):
        found["asked"].append(title)
        return found["next"]

    monkeypatch.setattr(QMessageBox, "question", question)
    return found


def test_exit_asks_only_when_something_would_be_lost(user, package, answers):
    user.open(package)
    for title in TITLES[:-1]:
        user.screen(title)  # to look is not to change
    assert not user.window.session.is_changed()
    user.screen("Author Information")
    user.fill(author_name="Grace")
    user.screen("Configuration Files")
    assert user.widget("files_exit").text().replace("&", "") == "Exit Setup Assistant"
    user.click("files_exit")
    assert answers["asked"] == ["Exit Setup Assistant"] and user.window.isVisible()
    user.click("files_generate")
    assert user.said().startswith("Wrote"), user.said()
    user.click("files_exit")
    assert len(answers["asked"]) == 1 and not user.window.isVisible(), "all is written: no question"


def test_what_was_typed_but_not_yet_taken_counts_and_may_be_thrown_away(user, package, answers):
    user.open(package)
    user.screen("3D Perception")
    user.fill(perception_kind="Point Cloud")
    answers["next"] = QMessageBox.Ok
    user.window.close()
    assert answers["asked"] == ["Exit Setup Assistant"] and not user.window.isVisible()


def test_other_files_are_loaded_over_changes_only_when_that_is_wanted(user, package, urdf, answers):
    user.open(package)
    user.screen("Planning Groups")
    user.click("groups_delete")
    user.screen("Start")
    user.load(urdf)
    assert answers["asked"] == ["Load other files"] and len(user.window.session.config.semantics.groups) == 1
    answers["next"] = QMessageBox.Ok
    user.click("start_load")
    assert user.window.session.config.semantics.groups == []


def test_a_signal_ends_it_without_a_question(user, package, answers):
    user.open(package)
    user.screen("Planning Groups")
    user.click("groups_delete")
    user.window.interrupted()
    assert answers["asked"] == [] and not user.window.isVisible()


def drawn(user):
    """(columns, rows, picture's size): where the picture is not as in its corner."""
    QTest.qWait(20)
    user.wait(lambda: not user.window.view._timer.isActive(), "picture")
    image = user.window.view.picture()
    pointer = image.bits()
    pointer.setsize(image.sizeInBytes())
    pixels = np.frombuffer(bytes(pointer), np.uint8).reshape(image.height(), image.bytesPerLine())
    rgb = pixels[:, : 3 * image.width()].reshape(image.height(), image.width(), 3).astype(int)
    rows, columns = np.nonzero(np.abs(rgb - rgb[0, 0]).max(axis=2) > 8)
    return columns, rows, (image.width(), image.height())


def check_filled(user):
    columns, rows, (width, height) = drawn(user)
    assert 0 < columns.min() and columns.max() < width - 1 and 0 < rows.min() and rows.max() < height - 1, "all of it is seen"
    assert max(np.ptp(columns), np.ptp(rows)) >= min(width, height) / 2
    assert max(np.ptp(columns) / width, np.ptp(rows) / height) > 0.7, "of the side that is filled first"


@pytest.mark.parametrize("size", SIZES)
def test_the_robot_fills_its_view(user, package, size):
    user.window.resize(*size)
    user.open(package)
    check_filled(user)
    user.window.resize(size[0] + 300, size[1])
    check_filled(user)
    user.screen("Robot Poses")
    user.fill(poses_group="wing")
    user.fill(poses_value_swinging=1.5)
    columns, rows, (width, height) = drawn(user)
    assert 0 < columns.min() and columns.max() < width - 1 and 0 < rows.min() and rows.max() < height - 1, "a bar that swings out"


def test_shapes_are_drawn_as_the_boxes_say(user, package):
    user.open(package)
    assert len(drawn(user)[0]), "links without a visual show what they collide with"
    user.click("view_visual")
    assert not len(drawn(user)[0])
    user.click("view_collision")
    assert len(drawn(user)[0])


SCROLLED = {"files_list", "controllers_list"}  # long paths, long names of plugins: a bar below the table


TICK = 16  # pixels, of a box before a text


def clipped_cells(table):
    name, room = table.objectName(), table.fontMetrics().horizontalAdvance
    if name not in SCROLLED and table.horizontalScrollBar().isVisible():
        yield f"{name} is scrolled"
    for column in range(table.columnCount()):
        items = [table.horizontalHeaderItem(column), *(table.item(row, column) for row in range(table.rowCount()))]
        least = max(room(item.text()) + (TICK if item.data(Qt.CheckStateRole) is not None else 0) for item in items)
        if least > table.columnWidth(column):
            yield f"{name}: column {column} is {table.columnWidth(column)} wide of {least}"


def clipped(window):
    """What does not show all of its text, one line each."""
    found = []
    for widget in window.findChildren(QWidget):
        if not widget.isVisible() or isinstance(widget.parent(), (QComboBox, QAbstractSpinBox)):
            continue
        wanted = {}
        if isinstance(widget, QLabel) and widget.wordWrap():
            wanted = {"height": widget.heightForWidth(widget.width())}
        elif isinstance(widget, QPushButton):  # its hint is wider than a short text
            text = widget.fontMetrics().size(Qt.TextShowMnemonic, widget.text())
            wanted = {"width": text.width() + 8, "height": text.height() + 6}
        elif isinstance(widget, (QLabel, QAbstractButton)):
            wanted = {"width": widget.sizeHint().width(), "height": widget.sizeHint().height()}
        elif isinstance(widget, (QLineEdit, QComboBox, QAbstractSpinBox)):
            wanted = {"height": widget.minimumSizeHint().height()}
        elif isinstance(widget, QTabBar):
            wanted = {"width": max(widget.tabRect(index).right() for index in range(widget.count()))}
        elif isinstance(widget, QTableWidget):
            found += clipped_cells(widget)
        for side, least in wanted.items():
            if getattr(widget, side)() < least:
                text = widget.text() if hasattr(widget, "text") else ""
                found.append(f"{type(widget).__name__} {widget.objectName()} '{text}': {side} {getattr(widget, side)()} of {least}")
    return found


def check_clipped(user, size):
    for title in [user.window.list.item(row).text() for row in range(12)] if user.window.session.config else ["Start"]:
        user.screen(title)
        QTest.qWait(1)
        assert (user.window.width(), user.window.height()) == size, title
        assert clipped(user.window) == [], title


@pytest.mark.parametrize("size", SIZES)
def test_nothing_is_clipped_while_nothing_is_loaded(user, size):
    user.window.resize(*size)
    check_clipped(user, size)
    for name in ("start_new", "start_edit"):
        user.click(name)
        check_clipped(user, size)


@pytest.mark.slow
@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("which", ["small", "myur5_moveit_config"])
def test_nothing_is_clipped(user, request, which, size):
    user.window.resize(*size)
    user.open(request.getfixturevalue("package") if which == "small" else Path(rospkg.RosPack().get_path(which)))
    check_clipped(user, size)
    check_filled(user)
    user.screen("3D Perception")
    for kind in ("Point Cloud", "Depth Map"):
        user.fill(perception_kind=kind)
        QTest.qWait(1)
        assert clipped(user.window) == []
    user.screen("Planning Groups")
    tabs = user.widget("groups_members")
    for index in range(tabs.count()):
        tabs.setCurrentIndex(index)
        QTest.qWait(1)
        assert clipped(user.window) == []
