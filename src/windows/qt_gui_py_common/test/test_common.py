"""Settings dialog, worker thread and console, as plugins use them."""

import threading

import pytest
from python_qt_binding.QtCore import Qt, QTimer
from python_qt_binding.QtTest import QTest
from qt_gui_py_common.console_text_edit import ConsoleTextEdit
from qt_gui_py_common.simple_settings_dialog import SimpleSettingsDialog
from qt_gui_py_common.worker_thread import WorkerThread
from rqt_testing.in_process import application, wait_until


@pytest.fixture(autouse=True)
def app():
    return application()


def make_dialog():
    dialog = SimpleSettingsDialog(title="Plot Options", description="text")
    dialog.add_exclusive_option_group(
        title="Type", options=[{"title": "A"}, {"title": "B", "selected": True}, {"title": "C", "enabled": False, "description": "no"}]
    )
    dialog.add_checkbox_group(title="Extra", options=[{"title": "x"}, {"title": "y"}], selected_indexes=[1])
    return dialog


def test_dialog_gives_what_each_group_has():
    dialog = make_dialog()
    QTimer.singleShot(0, dialog.accept)
    kind, extra = dialog.get_settings()
    assert kind == {"selected_index": 1, "selected_option": {"title": "B", "selected": True}}
    assert extra == {"selected_indexes": [1], "selected_options": [{"title": "y"}]}


def test_cancelled_dialog_gives_nothing():
    dialog = make_dialog()
    QTimer.singleShot(0, dialog.reject)
    assert dialog.get_settings() == [None, None]


def test_worker_runs_elsewhere_and_ends_here():
    threads = []
    worker = WorkerThread(lambda: threads.append(threading.get_ident()), lambda: threads.append(threading.get_ident()))
    for _ in range(2):  # it can be started again
        del threads[:]
        worker.start()
        wait_until(lambda: len(threads) == 2)
        assert threads[0] != threads[1] == threading.get_ident()


def test_killed_worker_says_nothing():
    go, called = threading.Event(), []
    worker = WorkerThread(go.wait, lambda: called.append(1))
    worker.start()
    QTimer.singleShot(0, go.set)
    worker.kill(patience=1)
    go.set()
    wait_until(lambda: not worker.isRunning())
    application().processEvents()
    assert called == []


class Console(ConsoleTextEdit):
    def __init__(self):
        super().__init__()
        self.executed = []
        self._add_prompt()

    def _exec_code(self, code):
        self.executed.append(code)
        print("out of", code)


def test_console_executes_lines_shows_output_and_has_a_history():
    console = Console()
    for line in ("one", "two"):
        QTest.keyClicks(console, line)
        QTest.keyClick(console, Qt.Key.Key_Return)
    assert console.executed == ["one", "two"]
    assert console.toPlainText() == "$ one\nout of one\n$ two\nout of two\n$ "
    for key, shown in (("Up", "two"), ("Up", "one"), ("Up", "one"), ("Down", "two"), ("Down", "")):
        QTest.keyClick(console, getattr(Qt.Key, f"Key_{key}"))
        assert console.toPlainText().splitlines()[-1] == "$ " + shown


def test_console_keeps_its_prompt_and_what_is_printed():
    console = Console()
    QTest.keyClicks(console, "ab")
    for _ in range(4):
        QTest.keyClick(console, Qt.Key.Key_Backspace)
    assert console.toPlainText() == "$ "
    cursor = console.textCursor()
    cursor.setPosition(0)
    console.setTextCursor(cursor)
    QTest.keyClicks(console, "x")
    assert console.toPlainText() == "$ x"


def test_console_takes_commands_of_several_lines():
    console = Console()
    for line in ("a\\", "b", ""):
        QTest.keyClicks(console, line)
        QTest.keyClick(console, Qt.Key.Key_Return)
    assert console.executed == ["a\\\n    b\n"]
