"""Ctrl-C in a window's process."""

import os
import signal

import pytest

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

from python_qt_binding.QtCore import QTimer  # noqa: E402
from python_qt_binding.QtWidgets import QApplication  # noqa: E402
from qt_gui.application.interrupts import Interrupts  # noqa: E402


@pytest.fixture
def app():
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    yield QApplication.instance() or QApplication([])
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_what_a_signal_interrupts_is_finished_first(app, number):
    called = []

    def end():
        called.append("end")
        app.quit()

    def busy():
        os.kill(os.getpid(), number)
        for _ in range(100):  # by its end Python has run its handler of the signal
            pass
        called.append("busy")

    interrupts = Interrupts(end)
    QTimer.singleShot(0, busy)
    QTimer.singleShot(20_000, app.quit)
    app.exec_()
    interrupts.stop()
    assert called[:2] == ["busy", "end"] and interrupts.fired


def test_a_signal_before_the_loop_ends_it(app):
    interrupts = Interrupts(app.quit)
    os.kill(os.getpid(), signal.SIGINT)
    QTimer.singleShot(20_000, lambda: app.exit(7))
    assert app.exec_() == 0
    interrupts.stop()
