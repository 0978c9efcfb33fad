"""A real shell: what is typed runs, Ctrl-C stops it, exit closes the plugin."""

import os

import pytest
from python_qt_binding.QtCore import Qt
from python_qt_binding.QtTest import QTest
from rqt_testing.in_process import application, errors, find, open_plugin, rospy_without_master, screenshot, wait_until


@pytest.fixture(autouse=True)
def plain_shell(monkeypatch, tmp_path):
    monkeypatch.setenv("SHELL", "/bin/sh")
    monkeypatch.setenv("PS1", "$ ")
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("ENV", raising=False)
    rospy_without_master()


def test_typed(tmp_path, monkeypatch):
    monkeypatch.setenv("COLUMNS", "7")  # of another terminal
    with open_plugin("rqt_shell") as gui:
        shell = find(gui, "ShellWidget")
        wait_until(lambda: shell.text())
        QTest.keyClicks(shell, "echo $((40 + 2)); tput cols; sleep 600")
        QTest.keyClick(shell, Qt.Key.Key_Return)
        wait_until(lambda: "\n42\n" in shell.text())
        wait_until(lambda: f"\n{shell.screen.columns}" in shell.text())
        screenshot(gui, str(tmp_path / "shell.png"))

        def prompt_is_back():  # pressed until it works: one that comes before sleep has begun stops nothing
            if shell.text().endswith("\n$"):
                return True
            QTest.keyClick(shell, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
            QTest.qWait(100)
            return False

        wait_until(prompt_is_back)
        QTest.keyClicks(shell, "printf '\\033[31mred\\033[0m'")
        QTest.keyClick(shell, Qt.Key.Key_Return)
        wait_until(lambda: any(shell.screen.buffer[row][0].fg == "red" for row in range(shell.screen.lines)))
        process = shell._process
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)
    assert errors == []


def test_exit_closes_the_plugin():
    from rqt_shell.terminal_widget import TerminalWidget

    application()
    ended, shell = [], TerminalWidget(["/bin/sh"])
    shell.ended.connect(lambda: ended.append(1))
    shell.send(b"exit\n")
    wait_until(lambda: ended)
    shell.send(b"too late")


def test_odd_output():
    from rqt_shell.terminal_widget import TerminalWidget

    application()
    ended, shell = [], TerminalWidget(["/bin/sh", "-c", "head -c 100000 /dev/urandom; printf '\\033[999;999H\\033[?9999h\\033[38;5;999mx'"])
    shell.ended.connect(lambda: ended.append(1))
    shell.show()
    wait_until(lambda: ended)
    assert errors == []
    shell.close()
