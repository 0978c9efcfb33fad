"""Lines, blocks, errors, history."""

import pytest
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtTest import QTest
from rqt_testing.in_process import errors, find, open_plugin, rospy_without_master


@pytest.fixture
def console():
    rospy_without_master()
    with open_plugin("rqt_py_console") as gui:
        yield find(gui, "PyConsoleWidget")
    assert errors == []


def enter(console, *lines):
    for line in lines:
        QTest.keyClicks(console, line)
        QTest.keyClick(console, Qt.Key.Key_Return)
    return console.toPlainText().splitlines()


def test_lines_and_blocks(console):
    assert enter(console, "a = 20 + 1", "a * 2")[-2:] == ["42", ">>> "]
    assert enter(console, "for n in range(2):", "    print('n', n)", "")[-4:] == ["... ", "n 0", "n 1", ">>> "]


def test_errors_and_exit_leave_the_window_alive(console):
    assert "ZeroDivisionError: division by zero" in enter(console, "1/0")
    assert "exit() does not end rqt: close the window instead" in enter(console, "exit()")
    assert any("SyntaxError" in line for line in enter(console, "a b"))


def test_history_and_completion(console):
    enter(console, "first = 1", "second = 2")
    QTest.keyClick(console, Qt.Key.Key_Up)
    QTest.keyClick(console, Qt.Key.Key_Up)
    assert console.current_line() == "first = 1"
    console.set_line("print(secon")
    QTest.keyClick(console, Qt.Key.Key_Tab)
    assert console.current_line() == "print(second"


def test_what_is_above_the_prompt_stays(console):
    before = console.toPlainText()
    for _ in range(5):
        QTest.keyClick(console, Qt.Key.Key_Backspace)
    console.selectAll()
    QTest.keyClicks(console, "x")
    assert console.toPlainText() == before + "x"
