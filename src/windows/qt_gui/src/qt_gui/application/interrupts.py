"""Ctrl-C and SIGTERM close the window at once; Qt's event loop would let Python see them only at its next own work."""

import signal
import socket

from python_qt_binding.QtCore import QObject, QSocketNotifier


class Interrupts(QObject):
    """From its creation on a signal has the event loop call ``on_interrupt()``; a second one ends the process the hard way.

    Never the signal's handler itself: Python runs that in whatever Qt has called it for, an event filter in the midst of painting
    among others, and windows that lose their docks there crash.
    """

    def __init__(self, on_interrupt, parent=None):
        super().__init__(parent)
        self._reading, self._writing = socket.socketpair()
        for end in (self._reading, self._writing):
            end.setblocking(False)
        self._notifier = QSocketNotifier(self._reading.fileno(), QSocketNotifier.Type.Read, self)
        self._notifier.activated.connect(self._wake)
        self._on_interrupt = on_interrupt
        self.fired = False  # a signal has come
        self._wakeup_before = signal.set_wakeup_fd(self._writing.fileno(), warn_on_full_buffer=False)
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._on_signal)

    def _wake(self, *_):
        try:
            self._reading.recv(64)  # being Python code, this lets the handler below run
        except BlockingIOError:
            pass
        if self.fired:
            self._on_interrupt()

    def _on_signal(self, number, _frame):
        for each in (signal.SIGINT, signal.SIGTERM):
            signal.signal(each, signal.SIG_DFL)
        self.fired = True

    def stop(self):
        """Give up the hold on Python's wake-up descriptor."""
        signal.set_wakeup_fd(self._wakeup_before)
        self._notifier.setEnabled(False)
        self._reading.close()
        self._writing.close()
