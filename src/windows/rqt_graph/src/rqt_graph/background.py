"""Work in a thread of its own, of which only the newest result counts."""

import threading
from typing import Any

from python_qt_binding.QtCore import QObject, Signal


class Latest(QObject):
    """``run(work)`` calls ``work()`` in a thread and emits ``done(result, None)`` or ``done(None, exception)`` in the thread of
    this object. While one runs, only the newest further one waits; those in between are dropped."""

    done = Signal(object, object)
    _finished = Signal(object, object)

    def __init__(self, parent=None):
        super().__init__(parent)
        self._busy = False
        self._next = None
        self._finished.connect(self._on_finished)

    def run(self, work):
        if self._busy:
            self._next = work
            return
        self._busy = True
        threading.Thread(target=self._work, args=(work,), daemon=True).start()

    def busy(self):
        return self._busy

    def _work(self, work):
        outcome: tuple[Any, Exception | None]
        try:
            outcome = work(), None
        except Exception as error:  # the result of whatever it was is the caller's to judge
            outcome = None, error
        try:
            self._finished.emit(*outcome)
        except RuntimeError:
            pass  # the window is closed

    def _on_finished(self, result, error):
        self._busy = False
        work, self._next = self._next, None
        if work is not None:
            self.run(work)
        self.done.emit(result, error)  # though a newer one is under way: with work that comes all the time nothing would be seen
